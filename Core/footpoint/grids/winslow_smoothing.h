// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/grids/smoothing.h"

namespace footpoint
{

/// Solves Winslow's equations (winslow_equations.h) with the sides fixed: coarser grids give the
/// start, Picard steps come near, Newton steps finish; each step is a sparse LU factorization or
/// BiCGSTAB on top of one. \return grid, convergence, iterations on the grid itself, and residual;
/// folds are not counted.
///         Not converged: the best grid that was met.
SmoothingResult winslow_smoothing(
  const Grid& grid, const SmoothingOptions& options, const Execution& execution);

} // namespace footpoint
