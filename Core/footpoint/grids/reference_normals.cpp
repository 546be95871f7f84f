// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/grids/cell_shape.h"
#include "footpoint/grids/grid_quality.h"

#include <Eigen/Eigenvalues>

#include <queue>
#include <vector>

namespace footpoint
{
namespace
{

/// Distance from the plane, relative to the size, up to which points count as planar.
constexpr double kPlanar = 1e-9;

/// Normals of the cells with twice their areas as lengths, and how far each is from having no
/// direction.
struct CellNormals
{
  std::array<int, 2> count; ///< cells along each direction
  Points areas;
  Points directions;           ///< unit, or zero
  Eigen::VectorXd reliability; ///< |sine| between the diagonals
};

CellNormals cell_normals(const Grid& grid)
{
  CellNormals cells;
  cells.count = { { std::max(0, grid.count[0] - 1), std::max(0, grid.count[1] - 1) } };
  const Eigen::Index size = Eigen::Index(cells.count[0]) * cells.count[1];
  cells.areas.setZero(3, size);
  cells.directions.setZero(3, size);
  cells.reliability.setZero(size);
  for (int j = 0; j < cells.count[1]; ++j)
  {
    for (int i = 0; i < cells.count[0]; ++i)
    {
      const QuadCorners p = quad_corners(grid, i, j);
      const Eigen::Index k = i + Eigen::Index(cells.count[0]) * j;
      const Vector3 first = p[2] - p[0];
      const Vector3 second = p[3] - p[1];
      const Vector3 area = first.cross(second);
      cells.areas.col(k) = area;
      if (area.norm() > 0.0)
      {
        cells.directions.col(k) = area.normalized();
        cells.reliability(k) = area.norm() / (first.norm() * second.norm());
      }
    }
  }
  return cells;
}

/// A border between a cell that is oriented and one that is not.
struct Border
{
  double agreement;
  Eigen::Index from, to;
  bool operator<(const Border& other) const { return this->agreement < other.agreement; }
};

template <class Visit>
void for_neighbours(const std::array<int, 2>& count, Eigen::Index cell, const Visit& visit)
{
  const Eigen::Index i = cell % count[0];
  const Eigen::Index j = cell / count[0];
  if (i > 0)
  {
    visit(cell - 1);
  }
  if (i + 1 < count[0])
  {
    visit(cell + 1);
  }
  if (j > 0)
  {
    visit(cell - count[0]);
  }
  if (j + 1 < count[1])
  {
    visit(cell + count[0]);
  }
}

/// Flips directions so that neighbours agree, the most parallel neighbours first (Prim's tree).
void orient_directions(CellNormals& cells)
{
  std::vector<bool> done(std::size_t(cells.directions.cols()), false);
  std::priority_queue<Border> borders;
  auto reach = [&](Eigen::Index cell)
  {
    done[std::size_t(cell)] = true;
    for_neighbours(cells.count, cell,
      [&](Eigen::Index next)
      {
        if (!done[std::size_t(next)])
        {
          const double parallel =
            std::abs(cells.directions.col(cell).dot(cells.directions.col(next)));
          borders.push({ parallel * cells.reliability(next), cell, next });
        }
      });
  };
  Eigen::Index start = 0;
  cells.reliability.maxCoeff(&start);
  reach(start);
  while (!borders.empty())
  {
    const Border border = borders.top();
    borders.pop();
    if (done[std::size_t(border.to)])
    {
      continue;
    }
    if (cells.reliability(border.to) == 0.0)
    {
      cells.directions.col(border.to) = cells.directions.col(border.from);
    }
    else if (cells.directions.col(border.to).dot(cells.directions.col(border.from)) < 0.0)
    {
      cells.directions.col(border.to) *= -1.0;
    }
    reach(border.to);
  }
}

/// Mean over a cell and its up to eight neighbours.
Vector3 mean_direction(const CellNormals& cells, int i, int j)
{
  Vector3 sum = Vector3::Zero();
  for (int n = std::max(0, j - 1); n <= std::min(cells.count[1] - 1, j + 1); ++n)
  {
    for (int m = std::max(0, i - 1); m <= std::min(cells.count[0] - 1, i + 1); ++m)
    {
      sum += cells.directions.col(m + Eigen::Index(cells.count[0]) * n);
    }
  }
  return sum;
}

} // namespace

Plane fit_plane(const Points& points)
{
  if (points.cols() == 0)
  {
    return { true, Vector3::UnitZ() };
  }
  const Vector3 low = points.rowwise().minCoeff();
  const Vector3 extent = points.rowwise().maxCoeff() - low;
  for (int axis = 2; axis >= 0; --axis)
  {
    if (extent(axis) == 0.0)
    {
      return { true, Vector3::Unit(axis) };
    }
  }
  const Points centred = (points.colwise() - (low + 0.5 * extent)) / extent.maxCoeff();
  const Vector3 mean = centred.rowwise().mean();
  const Points spread = centred.colwise() - mean;
  const Eigen::Matrix3d covariance = spread * spread.transpose();
  const Vector3 normal =
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvectors().col(0).normalized();
  const double distance = (normal.transpose() * spread).cwiseAbs().maxCoeff();
  return { distance <= kPlanar, normal };
}

Points reference_normals(const Grid& grid)
{
  CellNormals cells = cell_normals(grid);
  const Plane plane = fit_plane(grid.points);
  if (plane.planar || cells.directions.cols() == 0)
  {
    // The cells' areas sum up to the one that the boundary encloses.
    const double sense = cells.areas.rowwise().sum().dot(plane.normal) < 0.0 ? -1.0 : 1.0;
    return (sense * plane.normal).replicate(1, cells.areas.cols());
  }
  orient_directions(cells);
  const double sense = cells.areas.cwiseProduct(cells.directions).sum() < 0.0 ? -1.0 : 1.0;
  Points result(3, cells.areas.cols());
  for (int j = 0; j < cells.count[1]; ++j)
  {
    for (int i = 0; i < cells.count[0]; ++i)
    {
      const Vector3 mean = mean_direction(cells, i, j);
      result.col(i + Eigen::Index(cells.count[0]) * j) =
        sense * (mean.norm() > 0.0 ? mean.normalized() : plane.normal);
    }
  }
  return result;
}

} // namespace footpoint
