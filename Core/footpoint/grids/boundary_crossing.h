// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/common/types.h"

namespace footpoint
{

/// Whether a closed polyline in a plane (to 1e-9 of its size) passes through itself. Touching, and
/// running along itself as the two banks of a cut do, is not passing through.
/// \param loop #n points; the first follows the last
/// \return false for loops that lie in no plane
bool crosses_itself(const Points& loop);

} // namespace footpoint
