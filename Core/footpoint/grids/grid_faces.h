// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/grids/structured_points.h"

#include <cstdint>

namespace footpoint
{

/// How a cell (i, j) with the corners n00, n10, n11, n01 is cut in two triangles.
enum class TriangleStyle
{
  AlignLeft,  ///< (n00, n10, n01), (n10, n11, n01)
  AlignRight, ///< (n00, n10, n11), (n00, n11, n01)
  UnionJack   ///< AlignLeft where i + j is even, else AlignRight
};

/// Calls visit({n00, n10, n11, n01}) with the point indices of each quad, i fastest.
/// \param count points along each direction
template <class Visit>
void for_quads(const std::array<int, 2>& count, const Visit& visit)
{
  using Quad = std::array<std::int64_t, 4>;
  for (int j = 0; j + 1 < count[1]; ++j)
  {
    for (int i = 0; i + 1 < count[0]; ++i)
    {
      const std::int64_t n00 = i + std::int64_t(count[0]) * j;
      visit(Quad{ { n00, n00 + 1, n00 + 1 + count[0], n00 + count[0] } });
    }
  }
}

/// Calls visit with the point indices of each triangle, two a cell.
template <class Visit>
void for_triangles(const std::array<int, 2>& count, TriangleStyle style, const Visit& visit)
{
  using Triangle = std::array<std::int64_t, 3>;
  for_quads(count,
    [&](const std::array<std::int64_t, 4>& quad)
    {
      const auto [n00, n10, n11, n01] = quad;
      const bool even = (n00 % count[0] + n00 / count[0]) % 2 == 0;
      if (style == TriangleStyle::AlignLeft || (style == TriangleStyle::UnionJack && even))
      {
        visit(Triangle{ { n00, n10, n01 } });
        visit(Triangle{ { n10, n11, n01 } });
      }
      else
      {
        visit(Triangle{ { n00, n10, n11 } });
        visit(Triangle{ { n00, n11, n01 } });
      }
    });
}

/// Unit normals at the points: the area-weighted normals of the adjacent quads, added up. Where
/// they cancel or have no area the normal of the whole grid; where that has none either (all points
/// on a line) zero, never NaN.
/// \param normals receives one a point; memory besides is that of two rows
void fill_point_normals(const GridView& grid, Eigen::Ref<Points> normals);

/// The same in memory of their own.
Points point_normals(const GridView& grid);

/// (s, t) = (i / (nu − 1), j / (nv − 1)) of each point.
/// \param count       points along each direction
/// \param coordinates receives one column a point, i fastest
void fill_texture_coordinates(const std::array<int, 2>& count,
  Eigen::Ref<Eigen::Matrix<double, 2, Eigen::Dynamic>> coordinates);

} // namespace footpoint
