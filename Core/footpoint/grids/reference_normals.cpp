// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/grids/reference_normals.h"

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

/// Points that fit_plane takes at a time, so that it needs no copy of all.
constexpr Eigen::Index kBlock = 1024;

/// Normals of cells, and how far each is from having no direction.
struct CellNormals
{
  Points areas;                ///< with twice the cells' areas as lengths
  Points directions;           ///< unit, or zero
  Eigen::VectorXd reliability; ///< |sine| between the diagonals

  explicit CellNormals(Eigen::Index size)
    : areas(Points::Zero(3, size))
    , directions(Points::Zero(3, size))
    , reliability(Eigen::VectorXd::Zero(size))
  {
  }
};

/// Cells along each direction.
std::array<int, 2> cell_count(const GridView& grid)
{
  return { { std::max(0, grid.count[0] - 1), std::max(0, grid.count[1] - 1) } };
}

/// The normals of row j of cells.
void compute_row(const GridView& grid, int j, CellNormals& row)
{
  for (int i = 0; i + 1 < grid.count[0]; ++i)
  {
    const QuadCorners p = quad_corners(grid, i, j);
    const Vector3 first = p[2] - p[0];
    const Vector3 second = p[3] - p[1];
    const Vector3 area = first.cross(second);
    const bool has_area = area.norm() > 0.0;
    row.areas.col(i) = area;
    row.directions.col(i) = has_area ? area.normalized() : Vector3(Vector3::Zero());
    row.reliability(i) = has_area ? area.norm() / (first.norm() * second.norm()) : 0.0;
  }
}

/// The sum of all areas: twice the one that the boundary encloses.
Vector3 whole_area(const GridView& grid)
{
  Vector3 sum = Vector3::Zero();
  for (int j = 0; j + 1 < grid.count[1]; ++j)
  {
    for (int i = 0; i + 1 < grid.count[0]; ++i)
    {
      const QuadCorners p = quad_corners(grid, i, j);
      sum += (p[2] - p[0]).cross(p[3] - p[1]);
    }
  }
  return sum;
}

/// Whether all cells have directions that agree with those of their neighbours: then no tree is
/// needed to make them agree.
bool directions_agree(const GridView& grid)
{
  const std::array<int, 2> count = cell_count(grid);
  CellNormals row(count[0]);
  CellNormals before(count[0]);
  for (int j = 0; j < count[1]; ++j)
  {
    compute_row(grid, j, row);
    for (int i = 0; i < count[0]; ++i)
    {
      const Vector3 direction = row.directions.col(i);
      if (!(row.reliability(i) > 0.0) ||
        (i > 0 && !(direction.dot(row.directions.col(i - 1)) >= 0.0)) ||
        (j > 0 && !(direction.dot(before.directions.col(i)) >= 0.0)))
      {
        return false;
      }
    }
    std::swap(row, before);
  }
  return true;
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
void orient_directions(const std::array<int, 2>& count, CellNormals& cells)
{
  std::vector<bool> done(std::size_t(cells.directions.cols()), false);
  std::priority_queue<Border> borders;
  auto reach = [&](Eigen::Index cell)
  {
    done[std::size_t(cell)] = true;
    for_neighbours(count, cell,
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

/// The directions of all cells, made to agree, and the sense of the boundary against them.
Points agreed_directions(const GridView& grid, double& sense)
{
  const std::array<int, 2> count = cell_count(grid);
  const Eigen::Index size = Eigen::Index(count[0]) * count[1];
  CellNormals cells(size);
  CellNormals row(count[0]);
  for (int j = 0; j < count[1]; ++j)
  {
    compute_row(grid, j, row);
    const Eigen::Index first = Eigen::Index(count[0]) * j;
    cells.areas.middleCols(first, count[0]) = row.areas;
    cells.directions.middleCols(first, count[0]) = row.directions;
    cells.reliability.segment(first, count[0]) = row.reliability;
  }
  orient_directions(count, cells);
  sense = cells.areas.cwiseProduct(cells.directions).sum() < 0.0 ? -1.0 : 1.0;
  return std::move(cells.directions);
}

/// Mean over a cell and its up to eight neighbours.
/// \param rows the directions of the rows j − 1, j, j + 1, as far as there are such
Vector3 mean_direction(const std::vector<const Points*>& rows, int i)
{
  Vector3 sum = Vector3::Zero();
  for (const Points* row : rows)
  {
    for (int m = std::max(0, i - 1); m <= std::min(int(row->cols()) - 1, i + 1); ++m)
    {
      sum += row->col(m);
    }
  }
  return sum;
}

} // namespace

Plane fit_plane(const Eigen::Ref<const Points>& points)
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
  const auto for_blocks = [&](const auto& visit)
  {
    for (Eigen::Index first = 0; first < points.cols(); first += kBlock)
    {
      const auto block = points.middleCols(first, std::min(kBlock, points.cols() - first));
      visit(Points((block.colwise() - (low + 0.5 * extent)) / extent.maxCoeff()));
    }
  };
  Vector3 mean = Vector3::Zero();
  for_blocks([&](const Points& centred) { mean += centred.rowwise().sum(); });
  mean /= static_cast<double>(points.cols());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for_blocks(
    [&](const Points& centred)
    {
      const Points spread = centred.colwise() - mean;
      covariance += spread * spread.transpose();
    });
  const Vector3 normal =
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvectors().col(0).normalized();
  bool planar = true;
  for_blocks(
    [&](const Points& centred)
    {
      const Points spread = centred.colwise() - mean;
      planar = planar && (normal.transpose() * spread).cwiseAbs().maxCoeff() <= kPlanar;
    });
  return { planar, normal };
}

void for_reference_normals(
  const GridView& grid, const std::function<void(int, const Points&)>& visit)
{
  const std::array<int, 2> count = cell_count(grid);
  if (count[0] == 0 || count[1] == 0)
  {
    return;
  }
  const Plane plane = fit_plane(grid.points);
  if (plane.planar)
  {
    const double sense = whole_area(grid).dot(plane.normal) < 0.0 ? -1.0 : 1.0;
    const Points normals = (sense * plane.normal).replicate(1, count[0]);
    for (int j = 0; j < count[1]; ++j)
    {
      visit(j, normals);
    }
    return;
  }

  // === Directions, row by row: as they are or, where they do not agree, out of the tree
  double sense = 1.0;
  const Points agreed = directions_agree(grid) ? Points() : agreed_directions(grid, sense);
  CellNormals row(count[0]);
  const auto directions = [&](int j) -> Points
  {
    if (agreed.size() > 0)
    {
      return agreed.middleCols(Eigen::Index(count[0]) * j, count[0]);
    }
    compute_row(grid, j, row);
    return row.directions;
  };

  // === Means over three rows
  std::array<Points, 3> window; // row j in place j % 3
  window[0] = directions(0);
  Points normals(3, count[0]);
  for (int j = 0; j < count[1]; ++j)
  {
    std::vector<const Points*> rows;
    if (j > 0)
    {
      rows.push_back(&window[std::size_t(j - 1) % 3]);
    }
    rows.push_back(&window[std::size_t(j) % 3]);
    if (j + 1 < count[1])
    {
      window[std::size_t(j + 1) % 3] = directions(j + 1);
      rows.push_back(&window[std::size_t(j + 1) % 3]);
    }
    for (int i = 0; i < count[0]; ++i)
    {
      const Vector3 mean = mean_direction(rows, i);
      normals.col(i) = sense * (mean.norm() > 0.0 ? mean.normalized() : plane.normal);
    }
    visit(j, normals);
  }
}

Points reference_normals(const GridView& grid)
{
  const std::array<int, 2> count = cell_count(grid);
  Points result(3, Eigen::Index(count[0]) * count[1]);
  for_reference_normals(grid,
    [&](int j, const Points& normals)
    { result.middleCols(Eigen::Index(count[0]) * j, count[0]) = normals; });
  return result;
}

} // namespace footpoint
