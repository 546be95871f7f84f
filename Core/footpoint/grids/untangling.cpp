// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/grids/untangling.h"

#include "footpoint/grids/cell_shape.h"
#include "footpoint/grids/grid_quality.h"
#include "footpoint/grids/sampled_surface.h"

#include <cmath>

namespace footpoint
{
namespace
{

constexpr int kPasses = 30;
constexpr int kDirections = 8;
constexpr int kHalvings = 8; ///< of the search's step, which starts at half the longest edge

constexpr int kSearches = 40; ///< rounds about a point

/// Points this many lines away from a folded cell may move too.
constexpr int kMargin = 1;

std::vector<Eigen::Index> points_about(const Grid& grid, const GridQuality<2>& quality)
{
  std::vector<bool> chosen(std::size_t(grid.points.cols()), false);
  const int cells = grid.count[0] - 1;
  for (Eigen::Index cell = 0; cell < quality.folded.size(); ++cell)
  {
    if (!quality.folded(cell))
    {
      continue;
    }
    const int i = int(cell % cells);
    const int j = int(cell / cells);
    for (int n = std::max(1, j - kMargin); n <= std::min(grid.count[1] - 2, j + 1 + kMargin); ++n)
    {
      for (int m = std::max(1, i - kMargin); m <= std::min(grid.count[0] - 2, i + 1 + kMargin); ++m)
      {
        chosen[std::size_t(grid.index(m, n))] = true;
      }
    }
  }
  std::vector<Eigen::Index> result;
  for (std::size_t k = 0; k < chosen.size(); ++k)
  {
    if (chosen[k])
    {
      result.push_back(Eigen::Index(k));
    }
  }
  return result;
}

/// The least Jacobian of the cells about a point: in the plane a concave function of the point's
/// place (the scaled one is not), so that a local search finds its maximum.
double worst_about(const Grid& grid, const Points& normals, double noise, Eigen::Index point)
{
  double worst = std::numeric_limits<double>::infinity();
  for (const CornerQuality& cell : cells_about(grid, normals, noise, point))
  {
    worst = std::min(worst, cell.jacobian);
  }
  return worst;
}

/// Searches the tangent plane for a better place of a point.
void improve(Grid& grid, const Points& normals, double noise, const SampledSurface& surface,
  Eigen::Index point)
{
  const Eigen::Index n = grid.count[0];
  double step = 0.0;
  for (const Eigen::Index other : { point - 1, point + 1, point - n, point + n })
  {
    step = std::max(step, 0.5 * (grid.points.col(other) - grid.points.col(point)).norm());
  }
  double best = worst_about(grid, normals, noise, point);
  SurfacePlace place = surface.project(grid.points.col(point));
  Vector3 kept = grid.points.col(point);
  int halving = 0;
  for (int search = 0; search < kSearches && halving < kHalvings; ++search)
  {
    SurfacePlace better = place;
    const double before = best;
    for (int k = 0; k < kDirections; ++k)
    {
      const double angle = 2.0 * EIGEN_PI * k / kDirections;
      const Eigen::Vector2d along(std::cos(angle), std::sin(angle));
      const SurfacePlace trial = surface.project(place.point + step * place.tangents * along);
      grid.points.col(point) = trial.point;
      const double quality = worst_about(grid, normals, noise, point);
      if (quality > best)
      {
        best = quality;
        better = trial;
        kept = trial.point;
      }
    }
    place = better;
    if (best == before)
    {
      step *= 0.5;
      ++halving;
    }
  }
  grid.points.col(point) = kept;
}

} // namespace

Grid untangled(const Grid& grid, const Execution& execution)
{
  const SampledSurface surface(grid);
  const double noise = coordinate_noise(grid.points);
  Grid current = grid;
  Grid best = grid;
  GridQuality<2> quality = grid_quality(grid);
  std::int64_t fewest = quality.folded_count;
  for (int pass = 0; pass < kPasses && fewest > 0; ++pass)
  {
    const Points normals = reference_normals(current);
    const std::vector<Eigen::Index> points = points_about(current, quality);
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      if (!execution.proceed((pass + double(k) / double(points.size())) / kPasses))
      {
        return best;
      }
      improve(current, normals, noise, surface, points[k]);
    }
    quality = grid_quality(current);
    if (quality.folded_count < fewest)
    {
      fewest = quality.folded_count;
      best = current;
    }
  }
  return best;
}

} // namespace footpoint
