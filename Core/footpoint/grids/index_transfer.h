// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/grids/structured_points.h"

namespace footpoint
{

/// The grid at other counts ≥ 2: cubic in the index; samples that are met stay bit for bit.
Grid resampled(const Grid& grid, const std::array<int, 2>& count);

} // namespace footpoint
