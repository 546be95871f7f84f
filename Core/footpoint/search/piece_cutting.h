// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/splines/bezier.h"

#include <vector>

namespace footpoint
{

/// Whether the weights of a piece differ so much that it is cut even where there are many pieces.
template <int N>
bool has_uneven_weights(const BezierPiece<N>& piece);

/// Cuts the pieces of a patch in halves until they are good for a search: their weights of one
/// order of magnitude, and, while there are fewer than `few_pieces`, their control nets nearly
/// straight.
///
/// Their order stays. What happens to a patch of few_pieces pieces or more of even weights:
/// nothing.
template <int N>
std::vector<BezierPiece<N>> cut_pieces(std::vector<BezierPiece<N>> pieces, std::size_t few_pieces);

} // namespace footpoint
