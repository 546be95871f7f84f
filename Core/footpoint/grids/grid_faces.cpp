// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/grids/grid_faces.h"

#include <algorithm>
#include <limits>

namespace footpoint
{

namespace
{

/// Twice the vector area of a quad is the cross product of its diagonals. Below the rounding of
/// that product (of the coordinates, where the grid is far from the origin) it has no direction.
Vector3 vector_area(
  const Points& points, const std::array<std::int64_t, 4>& quad, double coordinate_rounding)
{
  const Vector3 first = points.col(quad[2]) - points.col(quad[0]);
  const Vector3 second = points.col(quad[3]) - points.col(quad[1]);
  const Vector3 product = first.cross(second);
  const double noise =
    64.0 * std::numeric_limits<double>::epsilon() * first.norm() * second.norm() +
    coordinate_rounding * (first.norm() + second.norm());
  if (!(product.norm() > noise))
  {
    return Vector3::Zero();
  }
  return 0.5 * product;
}

/// Areas that cancel leave no more than this fraction of their sum.
constexpr double kCancelled = 1e-12;

} // namespace

std::vector<std::array<std::int64_t, 4>> quads(const Grid& grid)
{
  std::vector<std::array<std::int64_t, 4>> cells;
  cells.reserve(static_cast<std::size_t>(std::max(grid.count[0] - 1, 0)) *
    static_cast<std::size_t>(std::max(grid.count[1] - 1, 0)));
  for (int j = 0; j + 1 < grid.count[1]; ++j)
  {
    for (int i = 0; i + 1 < grid.count[0]; ++i)
    {
      cells.push_back({ { grid.index(i, j), grid.index(i + 1, j), grid.index(i + 1, j + 1),
        grid.index(i, j + 1) } });
    }
  }
  return cells;
}

std::vector<std::array<std::int64_t, 3>> triangles(const Grid& grid, TriangleStyle style)
{
  std::vector<std::array<std::int64_t, 3>> cells;
  const auto all = quads(grid);
  cells.reserve(2 * all.size());
  const int width = grid.count[0] - 1;
  for (std::size_t cell = 0; cell < all.size(); ++cell)
  {
    const auto [n00, n10, n11, n01] = all[cell];
    const std::size_t parity = (cell % width + cell / width) % 2;
    if (style == TriangleStyle::AlignLeft || (style == TriangleStyle::UnionJack && parity == 0))
    {
      cells.push_back({ { n00, n10, n01 } });
      cells.push_back({ { n10, n11, n01 } });
    }
    else
    {
      cells.push_back({ { n00, n10, n11 } });
      cells.push_back({ { n00, n11, n01 } });
    }
  }
  return cells;
}

Points point_normals(const Grid& grid)
{
  Points normals = Points::Zero(3, grid.points.cols());
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(grid.points.cols());
  Vector3 whole = Vector3::Zero();
  double whole_area = 0.0;
  const double coordinate_rounding = grid.points.cols() == 0
    ? 0.0
    : 2.0 * std::numeric_limits<double>::epsilon() * grid.points.cwiseAbs().maxCoeff();

  // === Add the areas up
  for (const auto& quad : quads(grid))
  {
    const Vector3 area = vector_area(grid.points, quad, coordinate_rounding);
    const double size = area.norm();
    for (const std::int64_t point : quad)
    {
      normals.col(point) += area;
      areas[point] += size;
    }
    whole += area;
    whole_area += size;
  }

  // === Make unit vectors of them
  const bool has_normal = whole.norm() > kCancelled * whole_area;
  const Vector3 substitute = has_normal ? Vector3(whole / whole.norm()) : Vector3(Vector3::Zero());
  for (Eigen::Index point = 0; point < normals.cols(); ++point)
  {
    const double length = normals.col(point).norm();
    if (length > kCancelled * areas[point])
    {
      normals.col(point) /= length;
    }
    else
    {
      normals.col(point) = substitute;
    }
  }
  return normals;
}

Eigen::Matrix<double, 2, Eigen::Dynamic> texture_coordinates(const Grid& grid)
{
  Eigen::Matrix<double, 2, Eigen::Dynamic> coordinates(2, grid.points.cols());
  for (int j = 0; j < grid.count[1]; ++j)
  {
    for (int i = 0; i < grid.count[0]; ++i)
    {
      coordinates(0, grid.index(i, j)) = static_cast<double>(i) / (grid.count[0] - 1);
      coordinates(1, grid.index(i, j)) = static_cast<double>(j) / (grid.count[1] - 1);
    }
  }
  return coordinates;
}

} // namespace footpoint
