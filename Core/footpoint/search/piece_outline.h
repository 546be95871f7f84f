// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/search/aligned_array.h"
#include "footpoint/search/piece_neighbourhood.h"

#include <cstdint>
#include <vector>

namespace footpoint
{

/// The plane that touches a piece in its middle, for a first guess of a foot's parameters:
/// t = ½ + rows · (P − point). A curve has its tangent in the second row, zero in the first.
struct TangentPlane
{
  double point[3]; ///< from the piece's origin
  double rows[2][3];
};

/// What tells that a piece holds nothing near a query, without its forms: with c the piece's middle,
/// r = c − P, x_k the control points from c on and a_k as below,
///
///   |S − P|² = |r|² + 2 r·(S − c) + |S − c|² ≥ |r|² + min_k (2 r·x_k + a_k),
///
/// where |S − c|² is at least the square form A of the way in the parameters
/// (PieceNeighbourhood::metric) and a_k are its Bernstein coefficients, for rational pieces times
/// min w / w_k: w (2 r·(S − c) + |S − c|²) ≥ Σ B_k w_k (2 r·x_k + a_k) is a mean of the bracket.
///
/// In single precision: its rounding is accounted for, and is far below what matters here.
struct PieceOutline
{
  static constexpr int kWidth = 8;   ///< numbers come in multiples of this
  static constexpr int kCorners = 4; ///< (u, v) = (0, 0), (0, 1), (1, 0), (1, 1)

  double middle[3];     ///< c, in the model's centred coordinates
  const float* numbers; ///< x, y, z and a of all k; then x, y, z and |x|² of the corners
  std::int32_t count;   ///< of k; 0: the piece is too large or too small for single precision
  float longest;        ///< of the magnitudes of all x, y and z …
  float greatest;       ///< … and of all a and |x|²
};

/// The outlines of all pieces.
class PieceOutlines
{
public:
  PieceOutlines() = default;
  PieceOutlines(const AlignedVector<Piece>& pieces, const AlignedVector<TangentPlane>& planes,
    const AlignedVector<PieceNeighbourhood>& neighbourhoods);

  const PieceOutline& operator[](std::int32_t piece) const { return this->Outlines[piece]; }

private:
  AlignedVector<PieceOutline> Outlines;
  AlignedArray<float> Numbers;
};

} // namespace footpoint
