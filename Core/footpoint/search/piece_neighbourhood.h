// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/common/execution.h"
#include "footpoint/search/distance_forms.h"

#include <array>
#include <cstdint>

namespace footpoint
{

/// A piece with the pieces of its patch that go on smoothly from it, and how near a query has to be
/// for a foot on the piece to be the nearest point of all of them together.
///
/// Let Δ be the way from the foot to another point S of the block, in parameters in which the block
/// is measured about as in space, m a number with |S − foot| ≥ m |Δ|, and K a bound of the second
/// derivatives. Where r = foot − P is orthogonal to the surface,
///
///   |S − P|² − |r|² = |S − foot|² + 2 (S − foot)·r ≥ (m² − K |r|) |Δ|²,
///
/// which is not negative for |r| ≤ m² / K (Documentation/CertifiedSearch.md, "Blocks").
struct PieceNeighbourhood
{
  /// 3 (i + 1) + (j + 1): one piece on by i along u and j along v; −1: none that fits.
  std::array<std::int32_t, 9> pieces;
  std::uint16_t block; ///< which of them belong to the block, one bit each
  /// |S − P|² falls below |r|² by no more than this times the square of what is left of the
  /// gradient.
  float square_factor;
  /// Rounding of the gradient, a part of the coordinates.
  float rounding;
  /// Distance up to which the foot is the nearest of the block: nine tenths of what the derivation
  /// allows, so that the rest bounds what a gradient left over does. Negative: nothing is known.
  double limit;
  /// |S − f|² ≥ metric[0] Δu² + 2 metric[1] Δu Δv + metric[2] Δv² for two points S, f of the piece
  /// itself that are Δ apart in its parameters. Zeros: nothing is known.
  std::array<double, 3> metric;
  /// Length of the parameters' units, inverse: |Δ·gradient| ≤ |Δ| Σ_i inverse_speed[i]
  /// |gradient_i|.
  std::array<double, 2> inverse_speed;

  /// The piece beside this one along direction i.
  std::int32_t beside(int i, int end) const
  {
    return this->pieces[i == 0 ? (end == 0 ? 1 : 7) : (end == 0 ? 3 : 5)];
  }

  /// Whether the block goes on beyond a side.
  bool continues(int i, int end) const
  {
    constexpr std::uint16_t kSides[2][2] = { { 0x007, 0x1c0 }, { 0x049, 0x124 } };
    return (this->block & kSides[i][end]) != 0;
  }
};

/// One for each piece. Models so large or so small that squares of their distances are beyond all
/// bounds have no blocks, and neither have pieces whose derivatives vanish beside the model.
/// \param execution whose threads share the pieces if there are many
AlignedVector<PieceNeighbourhood> find_neighbourhoods(
  const AlignedVector<Piece>& pieces, const Execution& execution = {});

} // namespace footpoint
