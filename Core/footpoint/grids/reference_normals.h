// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/grids/structured_points.h"

#include <functional>

namespace footpoint
{

/// The normals of `reference_normals` (grid_quality.h), row of cells by row of cells: visit(j,
/// normals) for j = 0, 1, …, with one normal a cell. Keeps three rows, unless the tree is needed.
void for_reference_normals(
  const GridView& grid, const std::function<void(int, const Points&)>& visit);

} // namespace footpoint
