// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/grids/smoothing.h"

namespace footpoint
{

/// Moves each point in turn to the mean of its four neighbours (in space: brought back onto the
/// surface that the grid sampled), sliding ones to where the grid line from inside meets their side
/// at a right angle. A move that folds a cell, or worsens the worst corner of a folded one, is
/// halved and then refused. One iteration moves every point once. \return grid, convergence,
/// iterations, and as residual the last largest move against the grid's size;
///         folds are not counted
SmoothingResult laplacian_smoothing(
  const Grid& grid, const SmoothingOptions& options, const Execution& execution);

} // namespace footpoint
