// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/grids/grid_faces.h"

#include "footpoint/grids/cell_shape.h"

#include <limits>

namespace footpoint
{

namespace
{

/// Twice the vector area of a quad is the cross product of its diagonals. Below the rounding of
/// that product (of the coordinates, where the grid is far from the origin) it has no direction.
Vector3 vector_area(const QuadCorners& quad, double coordinate_rounding)
{
  const Vector3 first = quad[2] - quad[0];
  const Vector3 second = quad[3] - quad[1];
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

void fill_point_normals(const GridView& grid, Eigen::Ref<Points> normals)
{
  const int nu = grid.count[0];
  const int nv = grid.count[1];
  normals.setZero();
  if (nu < 2 || nv < 2)
  {
    return;
  }
  const double coordinate_rounding =
    2.0 * std::numeric_limits<double>::epsilon() * grid.points.cwiseAbs().maxCoeff();
  Vector3 whole = Vector3::Zero();
  double whole_area = 0.0;
  // Sums of areas about the points of the row in hand and of the next one.
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(nu);
  Eigen::VectorXd next_areas = Eigen::VectorXd::Zero(nu);

  for (int j = 0; j < nv; ++j)
  {
    // === Add the areas up
    for (int i = 0; j + 1 < nv && i + 1 < nu; ++i)
    {
      const Vector3 area = vector_area(quad_corners(grid, i, j), coordinate_rounding);
      const double size = area.norm();
      for (const int step : { 0, 1 })
      {
        normals.col(grid.index(i + step, j)) += area;
        normals.col(grid.index(i + step, j + 1)) += area;
        areas[i + step] += size;
        next_areas[i + step] += size;
      }
      whole += area;
      whole_area += size;
    }

    // === Make unit vectors of those of a finished row; zero: has none
    for (int i = 0; i < nu; ++i)
    {
      auto normal = normals.col(grid.index(i, j));
      const double length = normal.norm();
      if (length > kCancelled * areas[i])
      {
        normal /= length;
      }
      else
      {
        normal.setZero();
      }
    }
    areas.swap(next_areas);
    next_areas.setZero();
  }

  const bool has_normal = whole.norm() > kCancelled * whole_area;
  const Vector3 substitute = has_normal ? Vector3(whole / whole.norm()) : Vector3(Vector3::Zero());
  for (Eigen::Index point = 0; point < normals.cols(); ++point)
  {
    if (normals.col(point).isZero(0.0))
    {
      normals.col(point) = substitute;
    }
  }
}

Points point_normals(const GridView& grid)
{
  Points normals(3, grid.points.cols());
  fill_point_normals(grid, normals);
  return normals;
}

void fill_texture_coordinates(
  const std::array<int, 2>& count, Eigen::Ref<Eigen::Matrix<double, 2, Eigen::Dynamic>> coordinates)
{
  Eigen::Index point = 0;
  for (int j = 0; j < count[1]; ++j)
  {
    for (int i = 0; i < count[0]; ++i)
    {
      coordinates(0, point) = static_cast<double>(i) / (count[0] - 1);
      coordinates(1, point) = static_cast<double>(j) / (count[1] - 1);
      ++point;
    }
  }
}

} // namespace footpoint
