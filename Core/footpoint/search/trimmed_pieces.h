// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/splines/bezier.h"
#include "footpoint/trims/trim_region.h"

#include <array>
#include <cstddef>
#include <vector>

namespace footpoint
{

/// The pieces of a trimmed surface of which the region keeps something, cut for the search like
/// those of whole surfaces (cut_pieces).
std::vector<BezierPiece<2>> kept_pieces(
  const Surface& surface, const TrimRegion& region, std::size_t few_pieces);

/// Whether the region keeps all of a box of local parameters.
bool keeps_all(
  const TrimRegion& region, const std::array<double, 2>& lower, const std::array<double, 2>& upper);

/// A point of a box of local parameters that the region keeps: the one nearest to the middle of a
/// few, else a point of an arc of the boundary; NaN where there is none.
std::array<double, 2> kept_point(
  const TrimRegion& region, const std::array<double, 2>& lower, const std::array<double, 2>& upper);

} // namespace footpoint
