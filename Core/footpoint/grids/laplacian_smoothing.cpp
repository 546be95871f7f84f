// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/grids/laplacian_smoothing.h"

#include "footpoint/grids/cell_shape.h"
#include "footpoint/grids/grid_quality.h"
#include "footpoint/grids/sampled_surface.h"
#include "footpoint/grids/sliding_sides.h"

namespace footpoint
{
namespace
{

constexpr int kHalvings = 3; ///< of a move, before it is refused

/// The grid under way, and the normals against which its cells count as folded.
class GuardedMoves
{
public:
  explicit GuardedMoves(const Grid& grid)
    : Current(grid)
    , Noise(coordinate_noise(grid.points))
  {
    this->renew_normals();
  }

  const Grid& grid() const { return this->Current; }
  void renew_normals() { this->Normals = reference_normals(this->Current); }

  /// Moves a point unless a cell about it suffers.
  bool move(Eigen::Index point, const Vector3& to)
  {
    const std::vector<CornerQuality> before = this->cells_about(point);
    const Vector3 from = this->Current.points.col(point);
    this->Current.points.col(point) = to;
    const std::vector<CornerQuality> after = this->cells_about(point);
    for (std::size_t k = 0; k < before.size(); ++k)
    {
      const bool worse = after[k].folded &&
        (!before[k].folded || after[k].scaled_jacobian < before[k].scaled_jacobian);
      const bool collapses = after[k].collapsed && !before[k].collapsed;
      if (worse || collapses)
      {
        this->Current.points.col(point) = from;
        return false;
      }
    }
    return true;
  }

private:
  std::vector<CornerQuality> cells_about(Eigen::Index point) const
  {
    return footpoint::cells_about(this->Current, this->Normals, this->Noise, point);
  }

  Grid Current;
  double Noise;
  Points Normals;
};

/// Moves every inner point once; returns the largest move.
double sweep_inside(GuardedMoves& moves, const SampledSurface& surface)
{
  const std::array<int, 2> count = moves.grid().count;
  double largest = 0.0;
  for (int j = 1; j + 1 < count[1]; ++j)
  {
    for (int i = 1; i + 1 < count[0]; ++i)
    {
      const Eigen::Index k = moves.grid().index(i, j);
      const Points& p = moves.grid().points;
      const Vector3 mean =
        0.25 * (p.col(k - 1) + p.col(k + 1) + p.col(k - count[0]) + p.col(k + count[0]));
      const Vector3 from = p.col(k);
      double fraction = 1.0;
      for (int halving = 0; halving <= kHalvings; ++halving, fraction *= 0.5)
      {
        const Vector3 to = surface.project(from + fraction * (mean - from)).point;
        if (moves.move(k, to))
        {
          largest = std::max(largest, (to - from).norm());
          break;
        }
      }
    }
  }
  return largest;
}

/// Moves every sliding point once; returns the largest move.
double sweep_sides(GuardedMoves& moves, const SlidingSides& sides, Eigen::VectorXd& at)
{
  double largest = 0.0;
  for (std::size_t k = 0; k < sides.points().size(); ++k)
  {
    const SlidingPoint& which = sides.points()[k];
    const Eigen::Index n = Eigen::Index(k);
    const Points& p = moves.grid().points;
    const double move = sides.tangent(which, at(n)).dot(p.col(which.inner) - p.col(which.point));
    const std::array<double, 2> limits = sides.limits(at, n);
    const double to = at(n) + std::clamp(move, limits[0], limits[1]);
    if (moves.move(which.point, sides.point(which, to)))
    {
      largest = std::max(largest, std::abs(to - at(n)));
      at(n) = to;
    }
  }
  return largest;
}

} // namespace

SmoothingResult laplacian_smoothing(
  const Grid& grid, const SmoothingOptions& options, const Execution& execution)
{
  SmoothingResult result;
  result.grid = grid;
  if (grid.points.cols() == 0 || std::min(grid.count[0], grid.count[1]) < 2)
  {
    result.converged = true;
    return result;
  }
  const SampledSurface surface(grid);
  const SlidingSides sides(grid);
  Eigen::VectorXd at = sides.start();
  const double size = (grid.points.rowwise().maxCoeff() - grid.points.rowwise().minCoeff()).norm();
  GuardedMoves moves(grid);
  std::int64_t folds = find_folds(grid).count;
  while (!result.converged && result.iterations < options.maximum_iterations)
  {
    if (!execution.proceed(result.iterations / double(options.maximum_iterations)))
    {
      result.cancelled = true;
      break;
    }
    double largest = sweep_inside(moves, surface);
    if (options.boundary == SmoothingBoundary::Sliding)
    {
      largest = std::max(largest, sweep_sides(moves, sides, at));
    }
    ++result.iterations;
    if (!surface.planar())
    {
      // In space the normals move with the points: the guard holds for those at the sweep's start
      // only.
      const std::int64_t now = find_folds(moves.grid()).count;
      if (now > folds)
      {
        break;
      }
      folds = now;
      moves.renew_normals();
    }
    result.grid = moves.grid();
    result.residual = size > 0.0 ? largest / size : 0.0;
    result.converged = result.residual <= options.tolerance;
  }
  return result;
}

} // namespace footpoint
