// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/search/distance_forms.h"

#include <array>

namespace footpoint
{

/// Bounds of the derivatives of S over a piece.
struct PieceDerivatives
{
  /// For each coordinate the middles of the intervals of S_u and of S_v, then half their widths.
  using Box = std::array<Eigen::Array4d, 3>;
  Box box;
  double second[3]; ///< bounds of |S_uu|, |S_uv|, |S_vv|
};

/// What the derivatives of several pieces are told in, so that they go together and no square of
/// theirs is beyond all bounds, whatever the model's size.
struct DerivativeUnits
{
  double length; ///< a factor of all lengths, a power of two
  std::array<double, 2>
    width; ///< of the local parameters that make one of those of the derivatives
};

/// From the differences of control points. A curve's first direction has derivatives of zero.
/// \pre the piece is not rational; RationalDerivatives bounds those that are
PieceDerivatives piece_derivatives(const Piece& piece, const DerivativeUnits& units);

} // namespace footpoint
