// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/grids/structured_points.h"

#include <cstdint>
#include <vector>

namespace footpoint
{

/// How a cell (i, j) with the corners n00, n10, n11, n01 is cut in two triangles.
enum class TriangleStyle
{
  AlignLeft,  ///< (n00, n10, n01), (n10, n11, n01)
  AlignRight, ///< (n00, n10, n11), (n00, n11, n01)
  UnionJack   ///< AlignLeft where i + j is even, else AlignRight
};

/// Point indices of all quads (n00, n10, n11, n01), i fastest.
std::vector<std::array<std::int64_t, 4>> quads(const Grid& grid);

/// Point indices of all triangles, two a cell.
std::vector<std::array<std::int64_t, 3>> triangles(const Grid& grid, TriangleStyle style);

/// Unit normals at the points: the area-weighted normals of the adjacent quads, added up. Where
/// they cancel or have no area the normal of the whole grid; where that has none either (all points
/// on a line) zero, never NaN.
Points point_normals(const Grid& grid);

/// (s, t) = (i / (nu − 1), j / (nv − 1)) of each point.
Eigen::Matrix<double, 2, Eigen::Dynamic> texture_coordinates(const Grid& grid);

} // namespace footpoint
