// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/grids/grid_quality.h"

#include "footpoint/grids/cell_shape.h"
#include "footpoint/grids/reference_normals.h"

#include <Eigen/LU>

#include <vector>

namespace footpoint
{
namespace
{

template <int N>
GridQuality<N> empty_quality(Eigen::Index cells)
{
  GridQuality<N> result;
  result.scaled_jacobian.setZero(cells);
  result.measure.setZero(cells);
  result.skew.setZero(cells);
  result.aspect_ratio.setZero(cells);
  result.folded.setConstant(cells, false);
  return result;
}

/// A collapsed corner counts as 0.
double worst_corner(const CornerQuality& corners)
{
  return corners.collapsed ? std::min(0.0, corners.scaled_jacobian) : corners.scaled_jacobian;
}

template <int N>
void record_corners(GridQuality<N>& result, Eigen::Index cell, const CornerQuality& corners)
{
  result.scaled_jacobian(cell) = worst_corner(corners);
  result.folded(cell) = corners.folded;
  result.folded_count += corners.folded ? 1 : 0;
  result.minimum_scaled_jacobian =
    std::min(result.minimum_scaled_jacobian, corners.scaled_jacobian);
}

/// Largest |cosine| between any two of the axes; one without length is skewed to nothing.
double largest_cosine(const std::vector<Vector3>& axes)
{
  double result = 0.0;
  for (std::size_t a = 0; a < axes.size(); ++a)
  {
    for (std::size_t b = 0; b < a; ++b)
    {
      const double lengths = axes[a].norm() * axes[b].norm();
      result = std::max(result, lengths > 0.0 ? std::abs(axes[a].dot(axes[b])) / lengths : 0.0);
    }
  }
  return std::min(1.0, result);
}

struct EdgeRange
{
  double shortest = std::numeric_limits<double>::infinity();
  double longest = 0.0;

  void add(double length)
  {
    this->shortest = std::min(this->shortest, length);
    this->longest = std::max(this->longest, length);
  }
  double ratio() const
  {
    return this->shortest > 0.0 ? this->longest / this->shortest
                                : std::numeric_limits<double>::infinity();
  }
};

double quad_area(const QuadCorners& p, const Vector3& normal)
{
  const int first = (p[2] - p[0]).squaredNorm() <= (p[3] - p[1]).squaredNorm() ? 0 : 1;
  auto triangle = [&](int a, int b, int c)
  {
    const Vector3 area = 0.5 * (p[b] - p[a]).cross(p[c] - p[a]);
    return area.dot(normal) < 0.0 ? -area.norm() : area.norm();
  };
  return triangle(first, first + 1, first + 2) + triangle(first, first + 2, (first + 3) % 4);
}

/// Corners of a hexahedron: bit d of the number is the step along direction d.
using HexCorners = std::array<Vector3, 8>;

HexCorners hex_corners(const VolumeGrid& grid, int i, int j, int k)
{
  HexCorners result;
  for (int c = 0; c < 8; ++c)
  {
    result[c] = grid.points.col(grid.index(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2)));
  }
  return result;
}

CornerQuality hex_quality(const HexCorners& p, double noise)
{
  CornerQuality result;
  for (int c = 0; c < 8; ++c)
  {
    Eigen::Matrix3d edges;
    for (int d = 0; d < 3; ++d)
    {
      edges.col(d) = (c >> d & 1) ? p[c] - p[c ^ (1 << d)] : p[c ^ (1 << d)] - p[c];
    }
    const Vector3 lengths = edges.colwise().norm();
    const double faces =
      lengths(0) * lengths(1) + lengths(1) * lengths(2) + lengths(2) * lengths(0);
    add_corner(result, edges.determinant(), lengths.prod(), noise * faces);
  }
  return result;
}

/// Mean edge vector along a direction.
Vector3 principal_axis(const HexCorners& p, int direction)
{
  Vector3 sum = Vector3::Zero();
  for (int c = 0; c < 8; ++c)
  {
    sum += (c >> direction & 1) ? p[c] : Vector3(-p[c]);
  }
  return 0.25 * sum;
}

/// Volume of the trilinear cell: 2³ Gauss points are exact for its Jacobian, of degree 2 per
/// direction.
double hex_volume(const HexCorners& p)
{
  double volume = 0.0;
  const double gauss = 0.5 / std::sqrt(3.0);
  for (int point = 0; point < 8; ++point)
  {
    Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();
    for (int c = 0; c < 8; ++c)
    {
      Vector3 weight;
      for (int d = 0; d < 3; ++d)
      {
        const double t = 0.5 + ((point >> d & 1) ? gauss : -gauss);
        weight(d) = (c >> d & 1) ? t : 1.0 - t;
      }
      for (int d = 0; d < 3; ++d)
      {
        const double slope = (c >> d & 1) ? 1.0 : -1.0;
        jacobian.col(d) += slope * weight((d + 1) % 3) * weight((d + 2) % 3) * p[c];
      }
    }
    volume += jacobian.determinant() / 8.0;
  }
  return volume;
}

} // namespace

GridQuality<2> grid_quality(const GridView& grid)
{
  const int across = std::max(0, grid.count[0] - 1);
  GridQuality<2> result = empty_quality<2>(Eigen::Index(across) * std::max(0, grid.count[1] - 1));
  const double noise = coordinate_noise(grid.points);
  for_reference_normals(grid,
    [&](int j, const Points& normals)
    {
      for (int i = 0; i < across; ++i)
      {
        const Eigen::Index cell = i + Eigen::Index(across) * j;
        const QuadCorners p = quad_corners(grid, i, j);
        record_corners(result, cell, corner_quality(p, normals.col(i), noise));
        result.measure(cell) = quad_area(p, normals.col(i));
        result.skew(cell) =
          largest_cosine({ p[1] - p[0] + p[2] - p[3], p[2] - p[1] + p[3] - p[0] });
        EdgeRange edges;
        for (int k = 0; k < 4; ++k)
        {
          edges.add((p[(k + 1) % 4] - p[k]).norm());
        }
        result.aspect_ratio(cell) = edges.ratio();
      }
    });
  return result;
}

Folds find_folds(const GridView& grid, double* scaled_jacobian, int* folded)
{
  Folds result;
  const double noise = coordinate_noise(grid.points);
  for_reference_normals(grid,
    [&](int j, const Points& normals)
    {
      for (int i = 0; i + 1 < grid.count[0]; ++i)
      {
        const CornerQuality corners =
          corner_quality(quad_corners(grid, i, j), normals.col(i), noise);
        const std::ptrdiff_t cell = i + std::ptrdiff_t(grid.count[0] - 1) * j;
        if (scaled_jacobian)
        {
          scaled_jacobian[cell] = worst_corner(corners);
        }
        if (folded)
        {
          folded[cell] = corners.folded ? 1 : 0;
        }
        result.count += corners.folded ? 1 : 0;
        result.minimum_scaled_jacobian =
          std::min(result.minimum_scaled_jacobian, corners.scaled_jacobian);
      }
    });
  return result;
}

GridQuality<3> grid_quality(const VolumeGrid& grid)
{
  std::array<int, 3> cells;
  for (int d = 0; d < 3; ++d)
  {
    cells[d] = std::max(0, grid.count[d] - 1);
  }
  GridQuality<3> result = empty_quality<3>(Eigen::Index(cells[0]) * cells[1] * cells[2]);
  const double noise = coordinate_noise(grid.points);
  for (Eigen::Index cell = 0; cell < result.measure.size(); ++cell)
  {
    const HexCorners p = hex_corners(grid, int(cell % cells[0]), int(cell / cells[0] % cells[1]),
      int(cell / (Eigen::Index(cells[0]) * cells[1])));
    record_corners(result, cell, hex_quality(p, noise));
    // Relative to a corner: far from the origin the products would cancel.
    HexCorners local = p;
    std::for_each(local.begin(), local.end(), [&p](Vector3& corner) { corner -= p[0]; });
    result.measure(cell) = hex_volume(local);
    result.skew(cell) = largest_cosine(
      { principal_axis(local, 0), principal_axis(local, 1), principal_axis(local, 2) });
    EdgeRange edges;
    for (int c = 0; c < 8; ++c)
    {
      for (int d = 0; d < 3; ++d)
      {
        edges.add((p[c] - p[c ^ (1 << d)]).norm());
      }
    }
    result.aspect_ratio(cell) = edges.ratio();
  }
  return result;
}

} // namespace footpoint
