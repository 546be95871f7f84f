// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/common/types.h"

#include <vector>

namespace footpoint
{

/// For each point the index of the first point within `distance` of it (itself, if there is none
/// before); merged points stand for those within reach of them only, not for chains of near points.
std::vector<int> merge_points(const Points& points, double distance);

} // namespace footpoint
