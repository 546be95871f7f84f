// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/trims/boundary_parts.h"
#include "footpoint/trims/trim_plane.h"

#include <functional>
#include <vector>

namespace footpoint
{

/// What a part bounds.
/// \param winding number of a place (u, v), which may lie beyond a border of the domain by a few
///                roundings
/// \pre the part lies inside the domain
ArcBounds bounds_of(const BoundaryPart& part, const TrimPlane& plane,
  const std::function<int(const Eigen::Vector2d& place)>& winding);

/// Settles what undecided parts are that are no longer than kOnePlace, as lines over gaps of
/// rounding's size: nothing beside them tells. They are the ends of their neighbours in the loop,
/// and edges if one of these is. \pre bounds_of() has been told for each part inside the domain
void settle_short_parts(std::vector<BoundaryPart>& parts, const TrimPlane& plane);

/// Whether an arc passes through a place, up to twice kContact. \pre monotone
bool passes(const ChainArc& arc, const TrimPlane& plane, const Eigen::Vector2d& place);

} // namespace footpoint
