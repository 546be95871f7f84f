// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/grids/transfinite.h"

namespace footpoint
{

/// Four sides with all that a bicubically blended patch meets on them (S. A. Coons 1967).
struct BicubicBoundary
{
  std::array<Points, 4> sides;    ///< sampled like the grid's border
  std::array<Points, 4> tangents; ///< across the sides, sampled alike
  /// Twists at C00, C10, C11, C01: that of bottom's or top's tangents, that of left's or right's.
  std::array<std::array<Vector3, 2>, 4> twists;
  double twist_incompatibility = 0.0;
};

/// Completes what is not given.
/// \param ribbons may be null
/// \throw BoundaryError (Count)
BicubicBoundary complete_ribbons(const std::array<Points, 4>& sides, const Ribbons* ribbons);

/// The patch at the grid point (i, j), which blends with the parameters (s, t).
Vector3 bicubic_point(
  const BicubicBoundary& boundary, Eigen::Index i, Eigen::Index j, double s, double t);

} // namespace footpoint
