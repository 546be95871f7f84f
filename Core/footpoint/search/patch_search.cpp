// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/search/patch_search_of.h"

#include "footpoint/solvers/foot_conditions.h"
#include "footpoint/splines/curve.h"
#include "footpoint/splines/surface.h"

#include <cmath>

namespace footpoint
{
namespace
{

/// Geometry that is no spline has no boxes: a dense grid takes the place of the cells.
constexpr SeedOptions kDenseSeeds{ 31, 16 };

Box box_around(const Points& points)
{
  return { points.rowwise().minCoeff(), points.rowwise().maxCoeff() };
}

/// The box of the control points of a geometry that is a spline; an empty one of another.
Box control_box(const ParametricCurve& geometry)
{
  const auto* curve = dynamic_cast<const Curve*>(&geometry);
  return curve ? box_around(curve->local_control_points()) : Box{};
}

Box control_box(const ParametricSurface& geometry)
{
  const auto* surface = dynamic_cast<const Surface*>(&geometry);
  return surface ? box_around(surface->local_control_points()) : Box{};
}

} // namespace

template <int N>
PatchParts<N>::PatchParts(std::shared_ptr<const ParametricGeometry<N>> geometry,
  int seed_resolution, const Box& bounds)
  : Shared(std::move(geometry))
  , Bounds(bounds.empty() ? control_box(*this->Shared) : bounds)
  , Spline(!this->Bounds.empty())
  , Seeds(*this->Shared, SeedOptions{ seed_resolution, 1 })
  , Dense(*this->Shared, this->Spline ? SeedOptions{ 2, 1 } : kDenseSeeds)
{
  if (!this->Spline)
  {
    this->Bounds = this->Dense.box();
  }
}

template <int N>
PatchFoot PatchSearchOf<N>::lift(const Vector3& point, const LocalFoot<N>& foot) const
{
  PatchFoot result;
  result.local.template head<N>() = foot.parameter;
  result.sides.template head<N>() = foot.sides;
  result.parameter.template head<N>() = this->Geometry.to_domain(foot.parameter);
  result.offset = foot.point - this->local(point);
  result.point = this->Geometry.centre() + foot.point;
  result.distance = foot.distance;
  result.converged = foot.converged;
  result.type = foot.type;
  result.iterations = foot.iterations;
  return result;
}

/// From the given start, then from samples.
template <int N>
void PatchSearchOf<N>::search(
  const PatchQuery& query, const std::function<void(const PatchFoot&)>& found) const
{
  auto from = [&](const Parameter<N>& t)
  {
    PatchStart start{ Parameter<2>::Zero() };
    start.local.template head<N>() = t;
    this->search_from(query, start, found);
  };
  const Parameter<N> given = this->Geometry.to_local(query.start.head<N>());
  const bool has_start = given.allFinite();
  if (has_start)
  {
    from(given);
  }
  if (query.search == Search::Local && has_start)
  {
    return;
  }
  const bool dense = query.search == Search::Global;
  const SeededSearch<N>& seeds = dense ? this->Dense : this->Seeds;
  if (query.sought != Sought::Minimum && query.search != Search::Local)
  {
    // Maxima and intersections need not be near a sampled minimum.
    for (Eigen::Index k = 0; k < seeds.number_of_samples(); ++k)
    {
      from(seeds.parameter(k));
    }
    return;
  }
  const int count =
    query.search == Search::Local ? 1 : (dense ? kDenseSeeds.number_of_seeds : this->NumberOfSeeds);
  for (const Parameter<N>& seed : seeds.seeds(this->local(query.point), count))
  {
    from(seed);
  }
}

template <int N>
void PatchSearchOf<N>::minimum(const PatchQuery& query, const PatchStart& start,
  const std::function<void(const PatchFoot&)>& found) const
{
  found(this->lift(query.point,
    this->Seeds.find_from(
      this->local(query.point), Parameter<N>(start.local.head<N>()), this->nearby(start))));
}

template <int N>
void PatchSearchOf<N>::orthogonal_foot(const PatchQuery& query, const PatchStart& start,
  const std::function<void(const PatchFoot&)>& found) const
{
  const Vector3 at = this->local(query.point);
  const Parameter<N> t = start.local.head<N>();
  if (!start.simple)
  {
    const LocalFoot<N> minimum = this->Seeds.find_from(at, t, this->nearby(start));
    if (is_orthogonal<N>(this->Geometry, at, minimum, this->Solver))
    {
      found(this->lift(query.point, minimum));
    }
  }
  if (const auto foot = find_orthogonal_foot<N>(this->Geometry, at, t, this->Solver))
  {
    found(this->lift(query.point, *foot));
  }
}

template <int N>
PatchFoot PatchSearchOf<N>::refine(const Vector3& point, const PatchFoot& foot) const
{
  SolverOptions solver = this->Solver;
  solver.safeguards = true;
  solver.method = Method::Newton;
  const LocalFoot<N> found = find_local_foot<N>(
    this->Geometry, this->local(point), Parameter<N>(foot.local.head<N>()), solver);
  const Vector3 query = this->local(point);
  const FootConditions<N> conditions(this->Geometry, this->Solver);
  const Frame<N> here =
    make_frame<N>(this->Geometry, query, foot.local.head<N>(), foot.sides.head<N>());
  const Frame<N> there = make_frame<N>(this->Geometry, query, found.parameter, found.sides);
  const double tie = tie_tolerance(foot.distance, this->Geometry.size());
  if (found.distance < foot.distance ||
    (found.distance <= foot.distance + tie && conditions.excess(there) < conditions.excess(here)))
  {
    PatchFoot result = this->lift(point, found);
    result.iterations += foot.iterations;
    return result;
  }
  PatchFoot result = foot;
  result.type = conditions.classify(here, query);
  return result;
}

template <int N>
PatchFoot PatchSearchOf<N>::classified(const Vector3& point, const PatchFoot& foot) const
{
  const Vector3 query = this->local(point);
  const FootConditions<N> conditions(this->Geometry, this->Solver);
  PatchFoot result = foot;
  result.type = conditions.classify(
    make_frame<N>(this->Geometry, query, foot.local.head<N>(), foot.sides.head<N>()), query);
  return result;
}

template <int N>
bool PatchSearchOf<N>::near(const PatchFoot& foot, const PatchStart& start,
  const Parameter<2>& lower, const Parameter<2>& upper) const
{
  if (foot.type == FootType::Degenerate)
  {
    const Vector3 from = this->Geometry.point(Parameter<N>(start.local.head<N>()));
    return (foot.point - this->Geometry.centre() - from).norm() <= start.reach;
  }
  bool result = true;
  for (int i = 0; i < N; ++i)
  {
    const Direction& direction = this->Geometry.direction(i);
    const double apart = std::abs(foot.local(i) - 0.5 * (lower(i) + upper(i)));
    const double across = direction.closed ? direction.length - apart : apart;
    result = result && std::min(apart, across) <= upper(i) - lower(i);
  }
  return result;
}

template <int N>
bool PatchSearchOf<N>::same(const PatchFoot& a, const PatchFoot& b) const
{
  const double apart = (a.offset - b.offset).norm();
  // A pole has many parameters, and a gap one parameter for two points.
  const bool poles = a.type == FootType::Degenerate && b.type == FootType::Degenerate;
  if (poles && apart <= kSamePoint * this->Geometry.size())
  {
    return true;
  }
  for (int i = 0; i < N; ++i)
  {
    const Direction& direction = this->Geometry.direction(i);
    const double difference = std::abs(a.local(i) - b.local(i));
    const double across = direction.closed ? direction.length - difference : difference;
    if (std::min(difference, across) > kSameParameter * direction.length)
    {
      return false;
    }
  }
  return !this->is_left_of_gap(a, b) && !this->is_left_of_gap(b, a);
}

template <int N>
std::unique_ptr<PatchSearch> make_patch_search(
  std::shared_ptr<const ParametricGeometry<N>> geometry, const SolverOptions& solver,
  const SeedOptions& seeding, const Box& bounds)
{
  auto parts =
    std::make_shared<const PatchParts<N>>(std::move(geometry), seeding.resolution, bounds);
  return std::make_unique<PatchSearchOf<N>>(std::move(parts), solver, seeding.number_of_seeds);
}

template class PatchSearchOf<1>;
template class PatchSearchOf<2>;
template std::unique_ptr<PatchSearch> make_patch_search<1>(
  std::shared_ptr<const ParametricCurve>, const SolverOptions&, const SeedOptions&, const Box&);
template std::unique_ptr<PatchSearch> make_patch_search<2>(
  std::shared_ptr<const ParametricSurface>, const SolverOptions&, const SeedOptions&, const Box&);

} // namespace footpoint
