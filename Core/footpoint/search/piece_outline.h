// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/common/execution.h"
#include "footpoint/search/aligned_array.h"
#include "footpoint/search/distance_forms.h"

#include <cstdint>

namespace footpoint
{

/// What tells that a piece holds nothing near a query, without its forms: with c the piece's
/// origin, r = c − P, x_k the control points from c on and R_k = w_k B_k / w the rational basis,
///
///   |S − P|² = |r|² + 2 r·(S − c) + |S − c|² ≥ Σ R_k (|r|² + 2 r·x_k + a_k),
///
/// a mean of the brackets, and so not below the least of them. Σ B_k w_k a_k is w |S − c|² brought
/// down to the degree of the piece: interpolated at Chebyshev's nodes, and lowered by the multiple
/// of w for which all coefficients of w² |S − c|² − w Σ B_k w_k a_k, of twice the degree, are seen
/// to be positive. Directions of degree one are raised to two first, so that the square of the way
/// along them is kept.
///
/// In single precision: its rounding is accounted for, and is far below what matters here.
struct PieceOutline
{
  static constexpr int kWidth = 8;   ///< numbers come in multiples of this
  static constexpr int kCorners = 4; ///< (u, v) = (0, 0), (0, 1), (1, 0), (1, 1)

  double origin[3];     ///< c, in the model's centred coordinates
  double unit;          ///< of length for all that follows: a power of two near the piece's size
  double inverse_unit;
  /// x, y, z, a and, of rational pieces, w of all k, rows of the control net one after the other;
  /// then x, y, z and |x|² of the corners.
  const float* numbers;
  std::int32_t count; ///< of k, with padding; 0: squares of the piece's size are out of range
  float longest;      ///< of the magnitudes of all x, y and z …
  float greatest;     ///< … and of all a and |x|²

  /// Where the numbers of the corners begin.
  const float* corners(bool rational) const
  {
    return this->numbers + (rational ? 5 : 4) * this->count;
  }
};

/// The outlines of all pieces.
class PieceOutlines
{
public:
  PieceOutlines() = default;
  /// \param execution whose threads share the pieces if there are many
  explicit PieceOutlines(const AlignedVector<Piece>& pieces, const Execution& execution = {});

  const PieceOutline& operator[](std::int32_t piece) const { return this->Outlines[piece]; }

private:
  AlignedVector<PieceOutline> Outlines;
  AlignedArray<float> Numbers;
};

} // namespace footpoint
