// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/grids/smoothing.h"

#include "footpoint/grids/grid_quality.h"
#include "footpoint/grids/laplacian_smoothing.h"
#include "footpoint/grids/untangling.h"
#include "footpoint/grids/winslow_smoothing.h"

namespace footpoint
{
namespace
{

/// Of the work of Auto, what the elliptic equations take; freeing single cells takes the rest.
constexpr double kSmoothingPart = 0.8;

SmoothingResult unchanged(const Grid& grid, std::int64_t folds)
{
  SmoothingResult result;
  result.grid = grid;
  result.folds_before = folds;
  result.folds_after = folds;
  return result;
}

} // namespace

SmoothingResult smooth(
  const Grid& grid, const SmoothingOptions& options, const Execution& execution)
{
  const std::int64_t folds = find_folds(grid).count;
  const bool automatic = options.method == Smoothing::Auto;
  if (options.method == Smoothing::None || (automatic && folds == 0) || !grid.points.allFinite())
  {
    SmoothingResult result = unchanged(grid, folds);
    result.converged = grid.points.allFinite();
    return result;
  }
  // Untangling may have to follow: the last part of the progress is its own.
  const double first_part = automatic ? kSmoothingPart : 1.0;
  const Execution first = part_of(execution, 0.0, first_part);
  SmoothingResult result = options.method == Smoothing::Laplacian
    ? laplacian_smoothing(grid, options, first)
    : winslow_smoothing(grid, options, first);
  result.folds_before = folds;
  result.folds_after = find_folds(result.grid).count;
  if (automatic && !result.cancelled && result.folds_after > 0)
  {
    // Where sides turn within a cell, differences do not see it, and the solution may fold there.
    Execution second = execution;
    second.proceed = [&](double fraction)
    {
      result.cancelled =
        result.cancelled || !execution.proceed(first_part + (1.0 - first_part) * fraction);
      return !result.cancelled;
    };
    result.grid = untangled(result.grid, second);
    result.folds_after = find_folds(result.grid).count;
  }
  if (result.cancelled || (automatic && result.folds_after >= folds))
  {
    result.grid = grid;
    result.folds_after = folds;
  }
  result.converged = result.converged && !result.cancelled;
  result.changed = result.grid.points != grid.points;
  return result;
}

} // namespace footpoint
