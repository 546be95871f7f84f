// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/common/execution.h"
#include "footpoint/grids/structured_points.h"

namespace footpoint
{

enum class Smoothing
{
  None,
  /// Winslow, only on grids with folds; cells that stay folded are freed one by one (untangling.h).
  /// Kept only if there are fewer folds afterwards.
  Auto,
  Laplacian, ///< guarded: no step that makes a fold or worsens one
  Winslow    ///< elliptic: A. M. Winslow (1966); in space on the surface that the grid samples
};

/// Spacing that the elliptic equations are made to keep.
enum class ControlFunctions
{
  None,
  ThomasMiddlecoff ///< P. D. Thomas and J. F. Middlecoff (1980): from the spacing along the sides
};

/// What the points of the sides may do.
enum class SmoothingBoundary
{
  Fixed,
  Sliding ///< along the polyline of their side, to where grid lines meet it at a right angle;
          ///< corners stay
};

struct SmoothingOptions
{
  Smoothing method = Smoothing::Auto;
  int maximum_iterations = 100;
  /// Winslow: the residual of the equations against that of the start, at which they count as
  /// solved. Laplacian: the largest move against the grid's size, at which nothing moves any more.
  double tolerance = 1e-10;
  ControlFunctions control = ControlFunctions::None;
  SmoothingBoundary boundary = SmoothingBoundary::Fixed;
};

struct SmoothingResult
{
  Grid grid;
  bool changed = false; ///< false: `grid` is the input bit for bit
  bool converged =
    false; ///< the equations are solved to the tolerance (Laplacian: nothing moves any more)
  bool cancelled = false;
  int iterations = 0;    ///< on the grid itself; coarser ones, which give the start, not counted
  double residual = 0.0; ///< as `tolerance` means it
  std::int64_t folds_before = 0;
  std::int64_t folds_after = 0;
};

/// Smooths a grid. The corners and, unless they slide, the sides stay bit for bit; a grid that is
/// not finite and one whose smoothing was cancelled come back as they were. `converged` and
/// `folds_after` say whether it succeeded.
SmoothingResult smooth(
  const Grid& grid, const SmoothingOptions& options = {}, const Execution& execution = {});

} // namespace footpoint
