// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/solvers/descent.h"

namespace footpoint
{
namespace
{

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

} // namespace

template <int N>
typename Descent<N>::Candidate Descent<N>::leave()
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

template <int N>
typename Descent<N>::Candidate Descent<N>::cross_border() const
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

template <int N>
bool Descent<N>::descends(const Frame<N>& frame) const
{
  Descent ahead(this->Geometry, this->Query, this->Options, this->Propose);
  ahead.Current = frame;
  ahead.Lambda = this->Options.initial_lambda;
  ahead.Radius = this->Radius;
  const Candidate next = ahead.step();
  return next && this->lower(*next);
}

template <int N>
typename Descent<N>::Candidate Descent<N>::turn_at_pole()
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

template <int N>
std::optional<typename Descent<N>::Place> Descent<N>::pole(int i) const
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

template <int N>
typename Descent<N>::Candidate Descent<N>::steepest_column(const Place& pole, int across) const
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

template <int N>
Eigen::Matrix<bool, N, 1> Descent<N>::nearly_free() const
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

template <int N>
typename Descent<N>::Curvatures Descent<N>::curvatures(const StepSettings<N>& settings) const
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

template <int N>
typename Descent<N>::Candidate Descent<N>::escape_saddle(
  const StepSettings<N>& settings, const Curvatures& curvatures) const
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

template <int N>
typename Descent<N>::Candidate Descent<N>::sharpen(
  const StepSettings<N>& settings, const Curvatures& curvatures) const
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
  const bool far = (this->Current.jet.first * unsure).norm() > kSharpening * this->Geometry.size();
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
    look_at(
      ahead.arrive(solve_scaled<N>(ahead.Current.hessian(), ahead.Current.gradient, there), moved));
  }
  return best;
}

template <int N>
typename Descent<N>::Candidate Descent<N>::probe(const Parameter<N>& direction) const
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
    if (!this->may_be_lower_after(-part * reach * direction) &&
      !this->may_be_lower_after(part * reach * direction))
    {
      continue;
    }
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

template typename Descent<1>::Candidate Descent<1>::leave();
template typename Descent<2>::Candidate Descent<2>::leave();

} // namespace footpoint
