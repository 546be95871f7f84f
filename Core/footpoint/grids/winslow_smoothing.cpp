// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/grids/winslow_smoothing.h"

#include "footpoint/grids/index_transfer.h"
#include "footpoint/grids/sliding_sides.h"
#include "footpoint/grids/winslow_step.h"

#include <cmath>

namespace footpoint
{
namespace
{

/// Grids with fewer points along a direction are not coarsened any more.
constexpr int kCoarsest = 17;

/// Residual against the start's at which a coarse grid is good enough as a start for the next.
constexpr double kCoarseTolerance = 1e-4;

/// Picard steps are taken down to this residual, or until there were so many; Newton's method could
/// end in a folded solution of the difference equations when it starts far away.
constexpr double kPicardTolerance = 1e-2;
constexpr int kPicardSteps = 30;

/// Picard steps after a Newton step that did not help, and halvings of a step before it is given
/// up.
constexpr int kRecoverySteps = 3;
constexpr int kBacktracks = 5;

/// With sliding sides, steps of which none may raise the residual. Where points have far to go
/// along a side it stalls; Picard steps then start again and go over the hill.
constexpr int kDescents = 25;

/// Part of the residual that a full step must take away.
constexpr double kLeastGain = 0.05;

/// The iteration on one grid.
class LevelSolver
{
public:
  LevelSolver(const Grid& grid, ControlField control, const SampledSurface& surface,
    const Execution& execution, const SlidingSides* sides = nullptr)
    : Equations(grid.count, std::move(control), sides != nullptr)
    , Surface(surface)
    , Run(execution)
    , Sides(sides)
    , NumberOnSides(std::size_t(grid.points.cols()), -1)
  {
    for (std::size_t k = 0; sides && k < sides->points().size(); ++k)
    {
      this->NumberOnSides[std::size_t(sides->points()[k].point)] = int(k);
    }
    this->Current = this->place_all(grid.points, sides ? sides->start() : Eigen::VectorXd());
  }

  double residual() const { return this->Current.norm; }
  const Points& points() const { return this->Current.points; }
  int iterations() const { return this->Iterations; }
  double rounding() const { return this->Equations.rounding(this->Current.points); }

  /// Starts from other points, if they are better or solve the same equations with the sides fixed.
  void restart(const Points& points)
  {
    WinslowState state = this->place_all(points, this->Current.along_sides);
    if (state.norm < this->Current.norm || this->Sides)
    {
      this->Current = std::move(state);
    }
  }

  /// Iterates until the residual is at most `target`; keeps the best points.
  bool solve(double target, int maximum_iterations, int picard_steps)
  {
    const double start = this->Current.norm;
    WinslowState best = this->Current;
    WinslowStep step(this->Equations, this->Sides != nullptr);
    int picard_left = picard_steps;
    const WinslowState first = this->Current;
    bool guarded = this->Sides != nullptr;
    while (best.norm > target && this->Iterations < maximum_iterations)
    {
      const double done = std::log(best.norm / start) / std::log(target / start);
      if (!this->Run.proceed(std::clamp(done, 0.0, 1.0)))
      {
        break;
      }
      ++this->Iterations;
      const bool near = this->Current.norm <= kPicardTolerance * start;
      if (guarded)
      {
        // From the solution with the sides fixed Newton's method may start at once.
        const bool fell =
          this->descend(step.newton(this->Current)) || this->descend(step.picard(this->Current));
        best = this->Current;
        if (!fell || (!near && this->Iterations >= kDescents))
        {
          guarded = false;
          picard_left = kPicardSteps;
          this->Current = first;
        }
        continue;
      }
      if (picard_left > 0 && !near)
      {
        --picard_left;
        this->follow(step.picard(this->Current));
      }
      else if (!this->descend(step.newton(this->Current)))
      {
        picard_left = kRecoverySteps;
        this->follow(step.picard(this->Current));
      }
      if (!std::isfinite(this->Current.norm))
      {
        break;
      }
      if (this->Current.norm < best.norm)
      {
        best = this->Current;
      }
    }
    this->Current = std::move(best);
    return this->Current.norm <= target;
  }

private:
  /// The points on the surface, with the residual there.
  WinslowState place_all(const Points& points, const Eigen::VectorXd& along_sides) const
  {
    WinslowState state;
    state.points = points;
    state.along_sides = along_sides;
    const auto& unknowns = this->Equations.unknowns();
    state.places.resize(unknowns.size());
    this->Run.parallel_for(std::int64_t(unknowns.size()),
      [&](std::int64_t begin, std::int64_t end)
      {
        for (std::int64_t k = begin; k < end; ++k)
        {
          const Eigen::Index point = unknowns[std::size_t(k)];
          const int side = this->NumberOnSides[std::size_t(point)];
          state.places[std::size_t(k)] = side >= 0
            ? this->side_place(side, along_sides(side))
            : WinslowPlace{ this->Surface.project(points.col(point)) };
          state.points.col(point) = state.places[std::size_t(k)].point;
        }
      });
    state.residual = this->Equations.residual(state.points, state.places);
    state.norm = state.residual.norm();
    return state;
  }

  WinslowPlace side_place(int number, double at) const
  {
    const SlidingPoint& which = this->Sides->points()[std::size_t(number)];
    WinslowPlace place;
    place.point = this->Sides->point(which, at);
    place.tangents << this->Sides->point_derivative(which, at), Vector3::Zero();
    place.curvature.setZero();
    place.side_tangent = this->Sides->tangent(which, at);
    place.side_turn = this->Sides->tangent_derivative(which, at);
    return place;
  }

  /// The part of a step that belongs to the points of the sides, as arc lengths.
  Eigen::VectorXd slide(const Eigen::VectorXd& step) const
  {
    Eigen::VectorXd result(this->Current.along_sides.size());
    const auto& unknowns = this->Equations.unknowns();
    for (std::size_t k = 0; k < unknowns.size(); ++k)
    {
      const int side = this->NumberOnSides[std::size_t(unknowns[k])];
      if (side >= 0)
      {
        result(side) = step(2 * Eigen::Index(k));
      }
    }
    return result;
  }

  /// How much of a step may be taken: less than 1 where points of the sides would come too near
  /// each other.
  double largest_fraction(const Eigen::VectorXd& step) const
  {
    return this->Sides ? this->Sides->allowed(this->Current.along_sides, this->slide(step)) : 1.0;
  }

  WinslowState moved(const Eigen::VectorXd& step, double fraction) const
  {
    Points points = this->Current.points;
    Eigen::VectorXd along = this->Current.along_sides;
    if (this->Sides)
    {
      along += fraction * this->slide(step);
    }
    const auto& unknowns = this->Equations.unknowns();
    for (std::size_t k = 0; k < unknowns.size(); ++k)
    {
      points.col(unknowns[k]) +=
        fraction * this->Current.places[k].tangents * step.segment<2>(2 * Eigen::Index(k));
    }
    return this->place_all(points, along);
  }

  /// A step whether the residual falls or not.
  void follow(const Eigen::VectorXd& step)
  {
    this->Current = this->moved(step, this->largest_fraction(step));
  }

  /// A step, halved until the residual falls; false if it never does.
  bool descend(const Eigen::VectorXd& step)
  {
    double fraction = this->largest_fraction(step);
    for (int k = 0; k < kBacktracks; ++k, fraction *= 0.5)
    {
      WinslowState next = this->moved(step, fraction);
      if (next.norm < (1.0 - kLeastGain * fraction) * this->Current.norm)
      {
        this->Current = std::move(next);
        return true;
      }
    }
    return false;
  }

  WinslowEquations Equations;
  const SampledSurface& Surface;
  const Execution& Run;
  const SlidingSides* Sides;
  std::vector<int> NumberOnSides; ///< of each grid point, −1: does not slide
  WinslowState Current;
  int Iterations = 0;
};

ControlField control_field(const Grid& grid, ControlFunctions control)
{
  return control == ControlFunctions::ThomasMiddlecoff ? thomas_middlecoff(grid) : ControlField();
}

/// Solved on a coarser grid (and there again from a coarser one): a start for this one.
Grid start_from_coarse(const Grid& grid, const SmoothingOptions& options,
  const SampledSurface& surface, const Execution& execution)
{
  const std::array<int, 2> count = { { (grid.count[0] + 1) / 2, (grid.count[1] + 1) / 2 } };
  const Grid coarse = resampled(grid, count);
  const bool coarsest = std::min(count[0], count[1]) < 2 * kCoarsest;
  const Grid start = coarsest ? coarse : start_from_coarse(coarse, options, surface, execution);
  LevelSolver solver(coarse, control_field(coarse, options.control), surface, execution);
  const double target = std::max(kCoarseTolerance * solver.residual(), solver.rounding());
  solver.restart(start.points);
  solver.solve(target, options.maximum_iterations, coarsest ? kPicardSteps : 0);
  const Grid change = resampled({ count, solver.points() - coarse.points }, grid.count);
  return { grid.count, grid.points + change.points };
}

} // namespace

SmoothingResult winslow_smoothing(
  const Grid& grid, const SmoothingOptions& options, const Execution& execution)
{
  SmoothingResult result;
  result.grid = grid;
  if (std::min(grid.count[0], grid.count[1]) < 3)
  {
    result.converged = true;
    return result;
  }
  // === In units of the size and about the middle, so that no power of the lengths overflows
  const Vector3 low = grid.points.rowwise().minCoeff();
  const Vector3 extent = grid.points.rowwise().maxCoeff() - low;
  const double size = extent.norm();
  const Vector3 middle = low + 0.5 * extent;
  if (!(size > 0.0))
  {
    result.converged = true;
    return result;
  }
  const Grid scaled{ grid.count, (grid.points.colwise() - middle) / size };
  const SampledSurface surface(scaled);

  // Once cancelled, on whichever grid, all of it is; a fraction that was told is never taken back.
  bool cancelled = false;
  double told = 0.0;
  auto ask = [&](double fraction)
  {
    told = std::max(told, fraction);
    cancelled = cancelled || !execution.proceed(told);
    return !cancelled;
  };
  Execution guarded = execution;
  guarded.proceed = ask;
  LevelSolver solver(scaled, control_field(scaled, options.control), surface, guarded);
  const double initial = solver.residual();
  const double target = std::max(options.tolerance * initial, solver.rounding());
  if (initial <= target)
  {
    result.converged = true;
    result.residual = 0.0;
    return result;
  }
  const bool coarsens = std::min(grid.count[0], grid.count[1]) >= 2 * kCoarsest;
  if (coarsens)
  {
    // Their share of the work is small: they only ask whether to go on.
    Execution quiet = execution;
    quiet.proceed = [&ask](double) { return ask(0.0); };
    solver.restart(start_from_coarse(scaled, options, surface, quiet).points);
  }
  result.converged = solver.solve(target, options.maximum_iterations, coarsens ? 0 : kPicardSteps);
  result.cancelled = cancelled;
  result.iterations = solver.iterations();
  result.residual = solver.residual() / initial;
  Points solved = solver.points();
  if (options.boundary == SmoothingBoundary::Sliding && !cancelled)
  {
    const SlidingSides sides(scaled);
    LevelSolver slider(scaled, control_field(scaled, options.control), surface, guarded, &sides);
    const double slid = slider.residual();
    slider.restart(solved);
    result.converged = slider.solve(
      std::max(options.tolerance * slid, slider.rounding()), options.maximum_iterations, 0);
    result.cancelled = cancelled;
    result.iterations += slider.iterations();
    result.residual = slider.residual() / slid;
    solved = slider.points();
  }
  for (Eigen::Index k = 0; k < solved.cols(); ++k)
  {
    // What did not move stays bit for bit.
    if (solved.col(k) != scaled.points.col(k))
    {
      result.grid.points.col(k) = middle + size * solved.col(k);
    }
  }
  return result;
}

} // namespace footpoint
