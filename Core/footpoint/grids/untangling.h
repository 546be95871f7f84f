// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/common/execution.h"
#include "footpoint/grids/structured_points.h"

namespace footpoint
{

/// Frees single folded cells: moves the inner points about them, each to where the least Jacobian
/// of the cells about it is largest (max–min by local search, after L. Freitag and P. Plassmann,
/// "Local optimization-based simplicial mesh untangling and improvement", 2000), in space on the
/// surface that the grid samples. The rest of the grid and the sides stay bit for bit. Asked
/// whether to go on before every point. \return the grid with the fewest folds that was met; never
/// more than before. Cancelled: the same, of what was done
Grid untangled(const Grid& grid, const Execution& execution = {});

} // namespace footpoint
