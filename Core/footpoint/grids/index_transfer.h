// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/grids/structured_points.h"

namespace footpoint
{

/// The grid at other counts ≥ 2: bilinear in the index, the corners bit for bit.
Grid resampled(const Grid& grid, const std::array<int, 2>& count);

} // namespace footpoint
