// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/solvers/local_solver.h"

#include "footpoint/solvers/foot_conditions.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace footpoint
{
namespace
{

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

/// A step has to win this part of what the gradient promises (L. Armijo 1966).
constexpr double kSufficientDecrease = 1e-4;

/// Halvings (or fourfold dampings) of one step before the fall-backs are tried.
constexpr int kBacktracks = 12;

/// A method that has not brought the residual down to a hundredth in so many iterations hands over
/// to Newton's steps for as many: without curvature convergence is linear, as slow as the query is
/// near a centre of curvature.
constexpr int kPatience = 10;

/// Scaled eigenvalues of the Hessian below this leave a direction in which the second derivative
/// says nothing, so that finite steps have to tell a minimum from a saddle.
constexpr double kFlatEigenvalue = 1e-6;

/// A step that is longer in space than this part of the size is no refinement of a flat minimum.
constexpr double kSharpening = 1e-3;

/// Cosine between r and S_i below which a border does not hold a foot that can leave it by a finite
/// step: what a step along such a slope wins is less than the rounding of E.
constexpr double kFlatSlope = 1e-6;

/// Starts again from another column of a collapsed side, at the most.
constexpr int kPoleRestarts = 4;

template <int N>
class Descent
{
public:
  Descent(const ParametricGeometry<N>& geometry, const Vector3& query, const SolverOptions& options,
    const Step<N>& step)
    : Geometry(geometry)
    , Query(query)
    , Options(options)
    , Propose(step)
    , Conditions(geometry, options)
    , Order(options.safeguards ? derivative_order(options.method) : 3)
  {
  }

  LocalFoot<N> run(const Parameter<N>& start)
  {
    this->Current = this->frame_at(this->Conditions.walk().enter(start));
    this->Iterations = 1;
    this->Lambda = this->Options.initial_lambda;
    this->Radius = std::min(this->Options.first_trust_radius, this->Options.trust_radius) *
      this->Geometry.size();
    return this->Options.safeguards ? this->descend() : this->iterate();
  }

private:
  using Walk = DomainWalk<N>;
  using Place = typename Walk::Place;

  /// What ends a search for a lower point: the frame found, or nothing.
  using Candidate = std::optional<Frame<N>>;

  using Curvatures = Eigen::SelfAdjointEigenSolver<typename Frame<N>::Matrix>;

  Frame<N> frame_at(const Place& place) const
  {
    return make_frame<N>(this->Geometry, this->Query, place.t, place.sides, this->Order);
  }

  Place place() const { return { this->Current.t, this->Current.sides }; }

  /// Rounding of E = ½|r|², from eight roundings of each coordinate.
  double energy_noise() const
  {
    const double error = 8.0 * kEpsilon * (this->Geometry.size() + this->Current.distance);
    return error * (this->Current.distance + error);
  }

  bool lower(const Frame<N>& frame) const
  {
    return frame.energy() < this->Current.energy() - this->energy_noise();
  }

  StepSettings<N> settings(const Eigen::Matrix<bool, N, 1>& free) const
  {
    StepSettings<N> result;
    result.free = free;
    result.lambda = this->Lambda;
    result.descend = this->Options.safeguards;
    result.scale = Parameter<N>::Ones();
    for (int i = 0; i < N && this->Options.column_scaling; ++i)
    {
      const double slowest = kStalledSpeed * this->Geometry.direction(i).speed;
      const double speed = std::max(this->Current.speed(i), slowest);
      result.scale(i) = speed > 0.0 ? 1.0 / speed : 1.0;
    }
    return result;
  }

  // === The guarded descent ===

  LocalFoot<N> descend()
  {
    while (true)
    {
      if (this->Current.distance <= this->Options.point_tolerance * this->Geometry.size())
      {
        return this->finish(Termination::PointCoincidence);
      }
      const double residual = this->Conditions.residuals(this->Current).maxCoeff();
      const bool settled = residual <= this->Conditions.tolerance(this->Current);
      if (this->Iterations % kPatience == 0)
      {
        this->Slow = residual > 0.01 * this->Checkpoint;
        this->Checkpoint = residual;
      }
      Candidate next = settled ? this->leave() : this->step();
      if (!next)
      {
        return this->settle_or_stagnate(settled);
      }
      if (this->Iterations >= this->Options.maximum_iterations)
      {
        return this->finish(Termination::IterationLimit);
      }
      const bool short_step = !settled && this->step_is_small() && !this->stalled();
      this->Current = *next;
      ++this->Iterations;
      this->Radius =
        std::min(2.0 * this->Radius, this->Options.trust_radius * this->Geometry.size());
      if (short_step)
      {
        return this->finish(Termination::SmallStep);
      }
    }
  }

  bool step_is_small() const
  {
    return this->LastStep <= this->Options.step_tolerance * this->Geometry.size();
  }

  /// Where the parametrization stands still a short way in space may be a long one in parameters.
  bool stalled() const
  {
    bool any = false;
    for (int i = 0; i < N; ++i)
    {
      any = any || this->Conditions.stalled(this->Current, i);
    }
    return any;
  }

  LocalFoot<N> settle_or_stagnate(bool settled)
  {
    if (settled)
    {
      return this->finish(Termination::ZeroCosine);
    }
    return this->finish(this->step_is_small() ? Termination::SmallStep : Termination::Stagnation);
  }

  /// A lower point reached by the method's step or, where that is rejected, by its fall-backs.
  Candidate step()
  {
    const StepSettings<N> settings = this->settings(this->Conditions.free(this->Current));
    if (!this->Slow)
    {
      const bool damped = this->Options.method == Method::LevenbergMarquardt;
      if (Candidate next = damped ? this->damped_step(settings) : this->proposed_step(settings))
      {
        return next;
      }
    }
    if (this->Slow || this->Options.method != Method::Newton)
    {
      if (Candidate next = this->newton_step(settings))
      {
        return next;
      }
    }
    if (N == 2 && this->Options.isocurve_fallback)
    {
      if (Candidate next = this->isocurve_step(settings))
      {
        return next;
      }
    }
    return this->shortened(this->limited(this->steepest(settings)));
  }

  Candidate proposed_step(const StepSettings<N>& settings)
  {
    const Parameter<N> step = this->Propose(this->Current, settings);
    return this->shortened(this->limited(this->descending(step, settings)));
  }

  Candidate newton_step(const StepSettings<N>& settings)
  {
    return this->shortened(
      this->limited(solve_scaled<N>(this->Current.hessian(), this->Current.gradient, settings)));
  }

  /// −scale² g: steepest descent in scaled parameters.
  Parameter<N> steepest(const StepSettings<N>& settings) const
  {
    Parameter<N> step =
      -settings.scale.cwiseProduct(settings.scale).cwiseProduct(this->Current.gradient);
    for (int i = 0; i < N; ++i)
    {
      step(i) = settings.free(i) ? step(i) : 0.0;
    }
    return step;
  }

  /// A geometric step leads uphill beyond the centre of curvature: then it is turned round.
  Parameter<N> descending(const Parameter<N>& step, const StepSettings<N>& settings) const
  {
    if (!step.allFinite())
    {
      return this->steepest(settings);
    }
    return step.dot(this->Current.gradient) > 0.0 ? Parameter<N>(-step) : step;
  }

  /// The step within the trust radius; near a pole, where the tangent plane degenerates and the
  /// quadratic model with it, within a quarter of it.
  Parameter<N> limited(const Parameter<N>& step) const
  {
    double radius = this->Radius;
    if constexpr (N == 2)
    {
      const Vector3 normal = this->Current.jet.first.col(0).cross(this->Current.jet.first.col(1));
      const bool degenerate = normal.norm() <=
        kStalledSpeed * this->Geometry.direction(0).speed * this->Geometry.direction(1).speed;
      radius *= degenerate ? 0.25 : 1.0;
    }
    const double length = (this->Current.jet.first * step).norm();
    double factor = length > radius ? radius / length : 1.0;
    for (int i = 0; i < N; ++i)
    {
      // Half a period at the most: a whole one would lead back to where it started.
      const Direction& direction = this->Geometry.direction(i);
      const double longest = direction.closed ? 0.5 * direction.length : direction.length;
      factor = std::min(factor, std::abs(step(i)) > longest ? longest / std::abs(step(i)) : 1.0);
    }
    return factor * step;
  }

  /// The better of the full step and, where it crosses a border of the piece, the border itself.
  Frame<N> arrive(const Parameter<N>& step, Parameter<N>& moved) const
  {
    const auto move = this->Conditions.walk().move(this->place(), step);
    Frame<N> frame = this->frame_at(move.place);
    moved = move.moved;
    if (move.crosses)
    {
      const auto stop = this->Conditions.walk().move_to_border(this->place(), step);
      const Frame<N> border = this->frame_at(stop.place);
      if (this->Options.stop_at_borders || border.energy() < frame.energy())
      {
        frame = border;
        moved = stop.moved;
      }
    }
    return frame;
  }

  /// Enough decrease; or, where E is equal to rounding, smaller residuals, first those above their
  /// floor.
  bool accepts(const Frame<N>& frame, const Parameter<N>& moved) const
  {
    const double promised = std::max(0.0, -this->Current.gradient.dot(moved));
    const double won = this->Current.energy() - frame.energy();
    const double noise = this->energy_noise();
    if (won > noise)
    {
      return won >= kSufficientDecrease * promised;
    }
    if (won < -noise)
    {
      return false;
    }
    const double excess = this->Conditions.excess(this->Current);
    return (excess > 1.0 && this->Conditions.excess(frame) < 0.9 * excess) ||
      this->Conditions.residuals(frame, this->Current.speed).maxCoeff() <
      0.9 * this->Conditions.residuals(this->Current).maxCoeff();
  }

  Candidate shortened(Parameter<N> step)
  {
    // Speeds that change leave the trust region even where their first order does not.
    const double reach = 2.0 * this->Radius;
    for (int k = 0; k < kBacktracks; ++k)
    {
      this->LastStep = (this->Current.jet.first * step).norm();
      Parameter<N> moved;
      const Frame<N> frame = this->arrive(step, moved);
      if ((frame.r - this->Current.r).norm() <= reach && this->accepts(frame, moved))
      {
        return frame;
      }
      step *= 0.5;
    }
    return {};
  }

  /// Levenberg–Marquardt: λ × ¼ on success, × 4 on failure.
  Candidate damped_step(StepSettings<N> settings)
  {
    for (int k = 0; k < kBacktracks; ++k)
    {
      settings.lambda = this->Lambda;
      const Parameter<N> step = this->limited(this->Propose(this->Current, settings));
      this->LastStep = (this->Current.jet.first * step).norm();
      Parameter<N> moved;
      const Frame<N> frame = this->arrive(step, moved);
      const double predicted =
        -this->Current.gradient.dot(moved) - 0.5 * moved.dot(this->Current.metric() * moved);
      const double actual = this->Current.energy() - frame.energy();
      const bool good = actual > 0.25 * predicted;
      const bool accepted = this->accepts(frame, moved);
      this->Lambda = good ? std::max(0.25 * this->Lambda, this->Options.minimum_lambda)
                          : std::min(4.0 * this->Lambda, this->Options.maximum_lambda);
      if (accepted)
      {
        return frame;
      }
    }
    return {};
  }

  /// One Newton step along u, then one along v.
  Candidate isocurve_step(const StepSettings<N>& settings)
  {
    const Frame<N> start = this->Current;
    Candidate reached;
    for (int i = 0; i < N; ++i)
    {
      StepSettings<N> single = settings;
      for (int k = 0; k < N; ++k)
      {
        single.free(k) = settings.free(k) && k == i;
      }
      if (Candidate next = this->newton_step(single))
      {
        reached = next;
        this->Current = *next;
      }
    }
    this->Current = start;
    return reached;
  }

  // === A stationary point that is no minimum ===

  /// A way on from a frame that meets the conditions on its own piece: over a border, out of a
  /// saddle, along a collapsed side, or to the middle of a flat minimum.
  Candidate leave()
  {
    if (Candidate next = this->cross_border())
    {
      return next;
    }
    if (Candidate next = this->turn_at_pole())
    {
      return next;
    }
    const StepSettings<N> nearly = this->settings(this->nearly_free());
    if (Candidate next = this->escape_saddle(nearly, this->curvatures(nearly)))
    {
      return next;
    }
    const StepSettings<N> free = this->settings(this->Conditions.free(this->Current));
    return this->sharpen(free, this->curvatures(free));
  }

  /// The neighbouring piece in which the descent is steepest, if any.
  Candidate cross_border() const
  {
    Candidate steepest;
    double rate = 0.0;
    for (const Place& neighbour : this->Conditions.walk().neighbours(this->place()))
    {
      const Frame<N> frame = this->frame_at(neighbour);
      const double residual = this->Conditions.residuals(frame).maxCoeff();
      // The other side of a gap is another point, and a minimum of its own.
      const bool continues =
        (frame.r - this->Current.r).norm() <= kClosureTolerance * this->Geometry.size();
      if (continues && this->Conditions.excess(frame) > 1.0 && residual > rate &&
        this->descends(frame))
      {
        rate = residual;
        steepest = frame;
      }
    }
    return steepest;
  }

  /// Whether a step into the piece of a frame that lies where the current one does leads down: a
  /// residual alone may be the rounding of a seam, and would be handed to and fro.
  bool descends(const Frame<N>& frame) const
  {
    Descent ahead(this->Geometry, this->Query, this->Options, this->Propose);
    ahead.Current = frame;
    ahead.Lambda = this->Options.initial_lambda;
    ahead.Radius = this->Radius;
    const Candidate next = ahead.step();
    return next && this->lower(*next);
  }

  /// At a pole the parameter along the collapsed side is free: the column in which descent is
  /// steepest.
  Candidate turn_at_pole()
  {
    if constexpr (N == 2)
    {
      for (int i = 0; i < N && this->PoleRestarts < kPoleRestarts; ++i)
      {
        if (const std::optional<Place> pole = this->pole(i))
        {
          ++this->PoleRestarts;
          if (Candidate column = this->steepest_column(*pole, i))
          {
            return column;
          }
        }
      }
    }
    return {};
  }

  /// The place on a collapsed side of direction i that the current point is on, or a rounding off.
  std::optional<Place> pole(int i) const
  {
    const Direction& direction = this->Geometry.direction(i);
    const int end = this->Current.t(i) > 0.5 * direction.length ? 1 : 0;
    if (!direction.collapsed[end] || !this->Conditions.stalled(this->Current, 1 - i))
    {
      return {};
    }
    Place place = this->place();
    place.t(i) = end == 0 ? 0.0 : direction.length;
    place.sides(i) = end == 0 ? Side::Right : Side::Left;
    const Vector3 apart = this->frame_at(place).r - this->Current.r;
    const bool near = apart.norm() <= kClosureTolerance * this->Geometry.size();
    return near ? std::make_optional(place) : std::nullopt;
  }

  Candidate steepest_column(const Place& pole, int across) const
  {
    const int along = 1 - across;
    const std::vector<double>& spans = this->Geometry.direction(along).spans;
    // Eight columns a span, and no fewer than 32 in all: a pole of revolution has four spans.
    const int per_span = std::max<int>(8, 32 / static_cast<int>(spans.size() - 1));
    Candidate best;
    double rate = this->Conditions.floor(this->Current, across);
    for (std::size_t k = 0; k + 1 < spans.size(); ++k)
    {
      for (int j = 0; j < per_span; ++j)
      {
        Place column = pole;
        column.t(along) = spans[k] + (spans[k + 1] - spans[k]) * j / per_span;
        column.sides(along) = Side::Right;
        const Frame<N> frame = this->frame_at(column);
        const double residual = this->Conditions.residuals(frame)(across);
        // In the plane of symmetry of a query a step may overshoot to an equal distance; then a
        // column beside it serves.
        if (residual > rate && this->descends(frame))
        {
          rate = residual;
          best = frame;
        }
      }
    }
    return best;
  }

  /// The free directions and those in which next to nothing presses against a border: there, too, E
  /// may curve downwards (a saddle on a knot line, and a point beside one).
  Eigen::Matrix<bool, N, 1> nearly_free() const
  {
    Eigen::Matrix<bool, N, 1> result = this->Conditions.free(this->Current);
    const double flat = kFlatSlope * this->Current.distance;
    for (int i = 0; i < N; ++i)
    {
      const double slope = std::abs(this->Current.gradient(i));
      result(i) = result(i) || slope <= flat * this->Current.speed(i);
    }
    return result;
  }

  /// Principal curvatures of E over the free directions, in scaled parameters; held ones count 1.
  Curvatures curvatures(const StepSettings<N>& settings) const
  {
    typename Frame<N>::Matrix scaled =
      settings.scale.asDiagonal() * this->Current.hessian() * settings.scale.asDiagonal();
    for (int i = 0; i < N; ++i)
    {
      if (!settings.free(i))
      {
        scaled.row(i).setZero();
        scaled.col(i).setZero();
        scaled(i, i) = 1.0;
      }
    }
    Curvatures result;
    result.computeDirect(scaled);
    return result;
  }

  /// Finite steps along directions in which E does not curve upwards, and along those that stall.
  Candidate escape_saddle(const StepSettings<N>& settings, const Curvatures& curvatures) const
  {
    for (int k = 0; k < N; ++k)
    {
      if (curvatures.eigenvalues()(k) >= kFlatEigenvalue)
      {
        continue;
      }
      const Parameter<N> direction = settings.scale.cwiseProduct(curvatures.eigenvectors().col(k));
      if (Candidate next = this->probe(direction))
      {
        return next;
      }
    }
    for (int i = 0; i < N; ++i)
    {
      if (settings.free(i) && this->Conditions.stalled(this->Current, i))
      {
        if (Candidate next = this->probe(Parameter<N>::Unit(i)))
        {
          return next;
        }
      }
    }
    return {};
  }

  /// Where E is flat the residual vanishes long before the place is found, and a Newton step leads
  /// only 1/m of the way to a root of multiplicity m of the gradient (E. Schröder 1870): m times
  /// the step is tried, with one step more to get back to the bottom of a bent valley.
  Candidate sharpen(const StepSettings<N>& settings, const Curvatures& curvatures) const
  {
    Parameter<N> sure = Parameter<N>::Zero();
    Parameter<N> unsure = Parameter<N>::Zero();
    for (int k = 0; k < N; ++k)
    {
      const Parameter<N> direction = settings.scale.cwiseProduct(curvatures.eigenvectors().col(k));
      const double slope = settings.free.select(direction, 0.0).dot(this->Current.gradient);
      const double curvature = std::abs(curvatures.eigenvalues()(k));
      const Parameter<N> step =
        curvature > 0.0 ? Parameter<N>(-slope / curvature * direction) : Parameter<N>::Zero();
      (is_noticeable<N>(step, this->Geometry) ? unsure : sure) += step;
    }
    const bool far =
      (this->Current.jet.first * unsure).norm() > kSharpening * this->Geometry.size();
    Candidate best;
    if (unsure.isZero() || far)
    {
      return best;
    }
    double least = 0.1 * this->Conditions.residuals(this->Current).maxCoeff();
    const double highest = this->Current.energy() + this->energy_noise();
    auto look_at = [&](const Frame<N>& frame)
    {
      const double residual = this->Conditions.residuals(frame).maxCoeff();
      if (residual <= least && frame.energy() <= highest)
      {
        least = residual;
        best = frame;
      }
    };
    for (const double multiplicity : { 1.0, 3.0, 5.0 })
    {
      Descent ahead = *this;
      Parameter<N> moved;
      ahead.Current = this->arrive(sure + multiplicity * unsure, moved);
      look_at(ahead.Current);
      const StepSettings<N> there = ahead.settings(this->Conditions.free(ahead.Current));
      look_at(ahead.arrive(
        solve_scaled<N>(ahead.Current.hessian(), ahead.Current.gradient, there), moved));
    }
    return best;
  }

  /// The lower of the ends of ever shorter steps forth and back; equal ones: back.
  Candidate probe(const Parameter<N>& direction) const
  {
    double reach = std::numeric_limits<double>::infinity();
    for (int i = 0; i < N; ++i)
    {
      const double component = std::abs(direction(i));
      if (component > 0.0)
      {
        reach = std::min(reach, this->Geometry.direction(i).length / component);
      }
    }
    for (double part = 0.1; part > 1e-7 && std::isfinite(reach); part *= 0.1)
    {
      Parameter<N> moved;
      const Frame<N> back = this->arrive(-part * reach * direction, moved);
      const Frame<N> forth = this->arrive(part * reach * direction, moved);
      const Frame<N>& best = forth.energy() < back.energy() - this->energy_noise() ? forth : back;
      if (this->lower(best))
      {
        return best;
      }
    }
    return {};
  }

  // === The bare iteration of the literature ===

  LocalFoot<N> iterate()
  {
    Frame<N> best = this->Current;
    Termination termination = Termination::IterationLimit;
    while (this->Iterations < this->Options.maximum_iterations)
    {
      if (this->Current.distance <= this->Options.point_tolerance * this->Geometry.size())
      {
        termination = Termination::PointCoincidence;
        break;
      }
      if (this->Conditions.residuals(this->Current).maxCoeff() <=
        this->Options.cosine_tolerance * this->Current.distance)
      {
        termination = Termination::ZeroCosine;
        break;
      }
      const StepSettings<N> settings = this->settings(Eigen::Matrix<bool, N, 1>::Constant(true));
      const Parameter<N> step = this->Propose(this->Current, settings);
      if (!step.allFinite())
      {
        termination = Termination::Stagnation;
        break;
      }
      const auto move = this->Conditions.walk().move(this->place(), step);
      const bool small = this->small(move.moved);
      this->Current = this->frame_at(move.place);
      ++this->Iterations;
      best = this->Current.energy() <= best.energy() ? this->Current : best;
      if (small)
      {
        termination = Termination::SmallStep;
        break;
      }
    }
    this->Current = best;
    return this->finish(termination);
  }

  bool small(const Parameter<N>& moved) const
  {
    bool by_parameter = true;
    for (int i = 0; i < N; ++i)
    {
      by_parameter = by_parameter &&
        std::abs(moved(i)) < this->Options.parameter_tolerance * this->Geometry.direction(i).length;
    }
    return by_parameter ||
      (this->Current.jet.first * moved).norm() <=
      this->Options.step_tolerance * this->Geometry.size();
  }

  // === The result ===

  LocalFoot<N> finish(Termination termination) const
  {
    LocalFoot<N> foot;
    foot.parameter = this->Current.t;
    foot.sides = this->Current.sides;
    foot.point = this->Current.jet.point;
    foot.distance = this->Current.distance;
    foot.residual = this->Conditions.residuals(this->Current).maxCoeff();
    foot.iterations = this->Iterations;
    foot.termination = termination;
    const bool coincides = termination == Termination::PointCoincidence;
    const bool can_end = termination != Termination::IterationLimit;
    foot.converged = coincides || (can_end && this->Conditions.excess(this->Current) <= 1.0);
    foot.type = this->Conditions.classify(this->Current, this->Query);
    // One point, two parameters: a seam is reported at the start of its direction.
    for (int i = 0; i < N; ++i)
    {
      const Direction& direction = this->Geometry.direction(i);
      if (direction.closed && foot.parameter(i) == direction.length)
      {
        foot.parameter(i) = 0.0;
        foot.sides(i) = Side::Right;
      }
    }
    return foot;
  }

  const ParametricGeometry<N>& Geometry;
  const Vector3& Query;
  const SolverOptions& Options;
  const Step<N>& Propose;
  FootConditions<N> Conditions;
  int Order;
  Frame<N> Current;
  int Iterations = 0;
  int PoleRestarts = 0;
  double Lambda = 0.0;
  double LastStep = 0.0;
  double Checkpoint =
    std::numeric_limits<double>::infinity(); ///< residual kPatience iterations ago
  bool Slow = false;
  double Radius = 0.0; ///< of the trust region, in model units
};

} // namespace

template <int N>
LocalFoot<N> find_local_foot(const ParametricGeometry<N>& geometry, const Vector3& query,
  const Parameter<N>& start, const SolverOptions& options, const Step<N>& step)
{
  return Descent<N>(geometry, query, options, step).run(start);
}

template <int N>
LocalFoot<N> find_local_foot(const ParametricGeometry<N>& geometry, const Vector3& query,
  const Parameter<N>& start, const SolverOptions& options)
{
  return find_local_foot<N>(geometry, query, start, options, make_step<N>(options.method));
}

template LocalFoot<1> find_local_foot<1>(const ParametricGeometry<1>&, const Vector3&,
  const Parameter<1>&, const SolverOptions&, const Step<1>&);
template LocalFoot<2> find_local_foot<2>(const ParametricGeometry<2>&, const Vector3&,
  const Parameter<2>&, const SolverOptions&, const Step<2>&);
template LocalFoot<1> find_local_foot<1>(
  const ParametricGeometry<1>&, const Vector3&, const Parameter<1>&, const SolverOptions&);
template LocalFoot<2> find_local_foot<2>(
  const ParametricGeometry<2>&, const Vector3&, const Parameter<2>&, const SolverOptions&);

} // namespace footpoint
