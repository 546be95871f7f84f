// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/search/stationary_search.h"

#include "footpoint/solvers/foot_conditions.h"

namespace footpoint
{
namespace
{

/// Halvings of one step before the start is given up.
constexpr int kBacktracks = 12;

/// Columns of a collapsed side in which r is held against the tangent.
constexpr int kPoleColumns = 32;

template <int N>
StepSettings<N> newton_settings(const Frame<N>& frame, const ParametricGeometry<N>& geometry)
{
  StepSettings<N> settings;
  settings.free.setConstant(true);
  settings.descend = false;
  for (int i = 0; i < N; ++i)
  {
    const double speed = std::max(frame.speed(i), kStalledSpeed * geometry.direction(i).speed);
    settings.scale(i) = speed > 0.0 ? 1.0 / speed : 1.0;
  }
  return settings;
}

/// Tangential part of r per direction, borders disregarded.
template <int N>
double slope(const Frame<N>& frame, const StepSettings<N>& settings)
{
  return settings.scale.cwiseProduct(frame.gradient).norm();
}

/// Whether r is orthogonal to S_i; where S_i vanishes, to the direction in which S leaves.
template <int N>
bool is_orthogonal_along(const Frame<N>& frame, int i, const FootConditions<N>& conditions)
{
  Vector3 tangent = frame.jet.first.col(i);
  if (conditions.stalled(frame, i))
  {
    tangent = frame.jet.second.col(i == 0 ? 0 : 2);
  }
  return std::abs(frame.r.dot(tangent)) <= conditions.floor(frame, i) * tangent.norm();
}

} // namespace

template <int N>
std::optional<LocalFoot<N>> find_orthogonal_foot(const ParametricGeometry<N>& geometry,
  const Vector3& query, const Parameter<N>& start, const SolverOptions& options)
{
  const FootConditions<N> conditions(geometry, options);
  const auto& walk = conditions.walk();
  auto frame_at = [&](const typename DomainWalk<N>::Place& place)
  { return make_frame<N>(geometry, query, place.t, place.sides); };
  Frame<N> frame = frame_at(walk.enter(start));
  int iterations = 1;
  // Takes the step if it makes the slope smaller than the given part of what it is.
  auto take = [&](const Parameter<N>& step, double part)
  {
    const auto move = walk.move({ frame.t, frame.sides }, step);
    const Frame<N> next = frame_at(move.place);
    const bool better = slope<N>(next, newton_settings<N>(next, geometry)) <
      part * slope<N>(frame, newton_settings<N>(frame, geometry));
    frame = better ? next : frame;
    return better;
  };
  for (bool moved = true; moved && iterations < options.maximum_iterations; iterations += moved)
  {
    const StepSettings<N> settings = newton_settings<N>(frame, geometry);
    Parameter<N> step = solve_scaled<N>(frame.hessian(), frame.gradient, settings);
    moved = false;
    if (slope<N>(frame, settings) <= conditions.tolerance(frame))
    {
      // A multiple root is found to a small slope long before its place is known (E. Schröder
      // 1870).
      moved = is_noticeable<N>(step, geometry) && (take(step, 0.1) || take(3.0 * step, 0.1));
      continue;
    }
    for (int k = 0; k < kBacktracks && !moved; ++k, step *= 0.5)
    {
      moved = take(step, 1.0 - 1e-4);
    }
  }
  LocalFoot<N> foot;
  foot.parameter = frame.t;
  foot.sides = frame.sides;
  foot.point = frame.jet.point;
  foot.distance = frame.distance;
  foot.residual = conditions.residuals(frame).maxCoeff();
  foot.iterations = iterations;
  foot.converged = true;
  foot.termination = Termination::ZeroCosine;
  foot.type = conditions.classify(frame, query);
  return is_orthogonal<N>(geometry, query, foot, options) ? std::make_optional(foot) : std::nullopt;
}

template <int N>
bool is_orthogonal(const ParametricGeometry<N>& geometry, const Vector3& query,
  const LocalFoot<N>& foot, const SolverOptions& options)
{
  const FootConditions<N> conditions(geometry, options);
  const typename DomainWalk<N>::Place place{ foot.parameter, foot.sides };
  std::vector<typename DomainWalk<N>::Place> places = conditions.walk().neighbours(place);
  places.push_back(place);
  if constexpr (N == 2)
  {
    for (int i = 0; i < N; ++i)
    {
      for (int k = 0; k < kPoleColumns && conditions.walk().on_collapsed_side(place, i); ++k)
      {
        places.push_back(place);
        places.back().t(1 - i) = geometry.direction(1 - i).length * k / kPoleColumns;
        places.back().sides(1 - i) = Side::Right;
      }
    }
  }
  for (const auto& other : places)
  {
    const Frame<N> frame = make_frame<N>(geometry, query, other.t, other.sides);
    for (int i = 0; i < N; ++i)
    {
      // Along a collapsed side there is no direction to be orthogonal to.
      const bool at_pole = N == 2 && conditions.walk().on_collapsed_side(place, 1 - i);
      if (!at_pole && !is_orthogonal_along<N>(frame, i, conditions))
      {
        return false;
      }
    }
  }
  return true;
}

template std::optional<LocalFoot<1>> find_orthogonal_foot<1>(
  const ParametricGeometry<1>&, const Vector3&, const Parameter<1>&, const SolverOptions&);
template std::optional<LocalFoot<2>> find_orthogonal_foot<2>(
  const ParametricGeometry<2>&, const Vector3&, const Parameter<2>&, const SolverOptions&);
template bool is_orthogonal<1>(
  const ParametricGeometry<1>&, const Vector3&, const LocalFoot<1>&, const SolverOptions&);
template bool is_orthogonal<2>(
  const ParametricGeometry<2>&, const Vector3&, const LocalFoot<2>&, const SolverOptions&);

} // namespace footpoint
