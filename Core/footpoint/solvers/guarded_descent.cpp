// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/solvers/descent.h"

namespace footpoint
{
namespace
{

/// A step has to win this part of what the gradient promises (L. Armijo 1966).
constexpr double kSufficientDecrease = 1e-4;

/// Halvings (or fourfold dampings) of one step before the fall-backs are tried.
constexpr int kBacktracks = 12;

/// A method that has not brought the residual down to a hundredth in so many iterations hands over
/// to Newton's steps for as many: without curvature convergence is linear, as slow as the query is
/// near a centre of curvature.
constexpr int kPatience = 10;

} // namespace

template <int N>
LocalFoot<N> Descent<N>::descend()
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
    const bool short_step = !settled && this->step_is_small() && this->stays(next->t);
    this->Current = *next;
    ++this->Iterations;
    this->Radius = std::min(2.0 * this->Radius, this->Options.trust_radius * this->Geometry.size());
    if (short_step)
    {
      return this->finish(Termination::SmallStep);
    }
  }
}

template <int N>
bool Descent<N>::step_is_small() const
{
  return this->LastStep <= this->Options.step_tolerance * this->Geometry.size();
}

template <int N>
bool Descent<N>::stays(const Parameter<N>& t) const
{
  for (int i = 0; i < N; ++i)
  {
    const double part = std::abs(t(i) - this->Current.t(i)) / this->Geometry.direction(i).length;
    if (part > this->Options.step_tolerance)
    {
      return false;
    }
  }
  return true;
}

template <int N>
LocalFoot<N> Descent<N>::settle_or_stagnate(bool settled)
{
  if (settled)
  {
    return this->finish(Termination::ZeroCosine);
  }
  return this->finish(this->step_is_small() ? Termination::SmallStep : Termination::Stagnation);
}

template <int N>
typename Descent<N>::Candidate Descent<N>::step()
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

template <int N>
typename Descent<N>::Candidate Descent<N>::proposed_step(const StepSettings<N>& settings)
{
  const Parameter<N> step = this->Propose(this->Current, settings);
  return this->shortened(this->limited(this->descending(step, settings)));
}

template <int N>
typename Descent<N>::Candidate Descent<N>::newton_step(const StepSettings<N>& settings)
{
  return this->shortened(
    this->limited(solve_scaled<N>(this->Current.hessian(), this->Current.gradient, settings)));
}

template <int N>
Parameter<N> Descent<N>::steepest(const StepSettings<N>& settings) const
{
  Parameter<N> step =
    -settings.scale.cwiseProduct(settings.scale).cwiseProduct(this->Current.gradient);
  for (int i = 0; i < N; ++i)
  {
    step(i) = settings.free(i) ? step(i) : 0.0;
  }
  return step;
}

template <int N>
Parameter<N> Descent<N>::descending(const Parameter<N>& step, const StepSettings<N>& settings) const
{
  if (!step.allFinite())
  {
    return this->steepest(settings);
  }
  return step.dot(this->Current.gradient) > 0.0 ? Parameter<N>(-step) : step;
}

template <int N>
Parameter<N> Descent<N>::limited(const Parameter<N>& step) const
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

template <int N>
Frame<N> Descent<N>::arrive(const Parameter<N>& step, Parameter<N>& moved) const
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

template <int N>
bool Descent<N>::may_be_lower_after(const Parameter<N>& step) const
{
  const auto is_lower_at = [this](const Place& place)
  {
    const double distance =
      (this->Geometry.jet(place.t, place.sides, 0).point - this->Query).norm();
    return this->is_lower(0.5 * distance * distance);
  };
  const auto move = this->Conditions.walk().move(this->place(), step);
  return is_lower_at(move.place) ||
    (move.crosses &&
      is_lower_at(this->Conditions.walk().move_to_border(this->place(), step).place));
}

template <int N>
bool Descent<N>::accepts(const Frame<N>& frame, const Parameter<N>& moved) const
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

template <int N>
typename Descent<N>::Candidate Descent<N>::shortened(Parameter<N> step)
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

template <int N>
typename Descent<N>::Candidate Descent<N>::damped_step(StepSettings<N> settings)
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

template <int N>
typename Descent<N>::Candidate Descent<N>::isocurve_step(const StepSettings<N>& settings)
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

template LocalFoot<1> Descent<1>::descend();
template LocalFoot<2> Descent<2>::descend();
template typename Descent<1>::Candidate Descent<1>::step();
template typename Descent<2>::Candidate Descent<2>::step();
template bool Descent<1>::may_be_lower_after(const Parameter<1>&) const;
template bool Descent<2>::may_be_lower_after(const Parameter<2>&) const;
template Frame<1> Descent<1>::arrive(const Parameter<1>&, Parameter<1>&) const;
template Frame<2> Descent<2>::arrive(const Parameter<2>&, Parameter<2>&) const;

} // namespace footpoint
