// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/model/evaluation.h"

#include "footpoint/solvers/foot_conditions.h"

#include <algorithm>
#include <cmath>

namespace footpoint
{
namespace
{

/// Sine of the angle between S_u and S_v below which their product is rounding.
constexpr double kParallel = 1e-9;

/// How far inside the domain the normal is taken where even its derivative vanishes.
constexpr double kInside = 1e-4;

/// A power of two that makes a surface about as large as 1: products of derivatives of a very small
/// or large one would leave the range of numbers; nothing is rounded by it.
double unit_scale(const ParametricSurface& surface)
{
  const double size = surface.size();
  return size > 0.0 && std::isfinite(size) ? std::ldexp(1.0, -std::ilogb(size)) : 1.0;
}

/// S_u × S_v where it is more than rounding, else zero.
/// \param jet, scale of the surface times scale
Vector3 regular_normal(const ParametricSurface& surface, const Jet<2>& jet, double scale)
{
  const Vector3 u = jet.first.col(0);
  const Vector3 v = jet.first.col(1);
  const bool stalled = u.norm() <= kStalledSpeed * (surface.direction(0).speed * scale) ||
    v.norm() <= kStalledSpeed * (surface.direction(1).speed * scale);
  const Vector3 normal = u.cross(v);
  const bool parallel = normal.norm() <= kParallel * u.norm() * v.norm();
  return stalled || parallel ? Vector3(Vector3::Zero()) : Vector3(normal.normalized());
}

/// Derivative of S_u × S_v along a parametric direction.
Vector3 normal_derivative(const Jet<2>& jet, const Parameter<2>& along)
{
  const Vector3 u = jet.second.col(0) * along(0) + jet.second.col(1) * along(1);
  const Vector3 v = jet.second.col(1) * along(0) + jet.second.col(2) * along(1);
  return u.cross(jet.first.col(1)) + jet.first.col(0).cross(v);
}

/// The directions of the parameter plane that lead inside, away from the nearer end (a foot at a
/// pole may be a rounding off it); the likeliest first.
std::array<Parameter<2>, 3> inward(const ParametricSurface& surface, const Parameter<2>& t)
{
  std::array<Parameter<2>, 3> result;
  std::array<bool, 2> collapsed;
  for (int i = 0; i < 2; ++i)
  {
    const Direction& direction = surface.direction(i);
    const bool upper = t(i) > 0.5 * direction.length;
    result[i] = Parameter<2>::Unit(i) * (upper ? -direction.length : direction.length);
    collapsed[i] = direction.collapsed[upper ? 1 : 0];
  }
  // Across a collapsed side first: along it nothing changes.
  if (collapsed[1] && !collapsed[0])
  {
    std::swap(result[0], result[1]);
  }
  result[2] = result[0] + result[1];
  return result;
}

template <int N>
const ParametricGeometry<N>& geometry_of(const Patch& patch)
{
  if constexpr (N == 1)
  {
    return *patch.curve;
  }
  else
  {
    return *patch.surface;
  }
}

/// How far a parameter lies outside the domain of a patch, in units of that domain.
template <int N>
double outside(const ParametricGeometry<N>& geometry, const Parameter<2>& parameter)
{
  double largest = 0.0;
  for (int i = 0; i < N; ++i)
  {
    const Direction& direction = geometry.direction(i);
    const double local = parameter(i) - direction.origin;
    largest = std::max({ largest, -local / direction.length, local / direction.length - 1.0 });
  }
  return largest;
}

template <int N>
Evaluation evaluate_patch(const Patch& patch, const Parameter<2>& parameter, bool reversed)
{
  const ParametricGeometry<N>& geometry = geometry_of<N>(patch);
  const Parameter<N> local = geometry.to_local(parameter.head<N>());
  Evaluation result;
  for (int i = 0; i < N; ++i)
  {
    const Direction& direction = geometry.direction(i);
    result.clamped =
      result.clamped || (!direction.closed && (local(i) < 0.0 || local(i) > direction.length));
  }
  const auto place = DomainWalk<N>(geometry).enter(local);
  result.point = geometry.centre() + geometry.jet(place.t, place.sides, 0).point;
  if constexpr (N == 1)
  {
    result.on_curve = true;
    result.direction = unit_tangent(geometry, place.t, place.sides);
  }
  else
  {
    result.direction = mean_normal(geometry, place.t, place.sides) * (reversed ? -1.0 : 1.0);
  }
  return result;
}

} // namespace

Vector3 unit_tangent(const ParametricCurve& curve, const Parameter<1>& t, const Sides<1>& sides)
{
  const Vector3 first = curve.jet(t, sides, 1).first;
  const Direction& direction = curve.direction(0);
  if (first.norm() > kStalledSpeed * direction.speed)
  {
    return first.normalized();
  }
  const Jet<1> jet = curve.jet(t, sides, 3);
  // C(t + h) − C(t) = h² C''/2 + h³ C'''/6: with rising t an odd term keeps its sign, the even one
  // points away from the cusp on both sides and the right one is taken.
  const double scale = direction.speed / direction.length;
  const bool second = jet.second.norm() > kStalledSpeed * scale;
  const Vector3 leaving = second ? Vector3(jet.second) : Vector3(jet.third);
  const double sign = second && sides(0) == Side::Left ? -1.0 : 1.0;
  return leaving.norm() > 0.0 ? Vector3(sign * leaving.normalized()) : Vector3(Vector3::Zero());
}

Vector3 unit_normal(const ParametricSurface& surface, const Parameter<2>& t, const Sides<2>& sides)
{
  const double scale = unit_scale(surface);
  Jet<2> jet = surface.jet(t, sides, 1);
  jet.first *= scale;
  const Vector3 normal = regular_normal(surface, jet, scale);
  if (!normal.isZero())
  {
    return normal;
  }
  jet = surface.jet(t, sides, 2);
  jet.first *= scale;
  jet.second *= scale;
  const double area = (surface.direction(0).speed * scale) * (surface.direction(1).speed * scale);
  for (const Parameter<2>& along : inward(surface, t))
  {
    const Vector3 derivative = normal_derivative(jet, along);
    if (derivative.norm() > kStalledSpeed * area)
    {
      return derivative.normalized();
    }
  }
  for (const Parameter<2>& along : inward(surface, t))
  {
    Jet<2> inside = surface.jet(t + kInside * along, sides, 1);
    inside.first *= scale;
    const Vector3 nearby = regular_normal(surface, inside, scale);
    if (!nearby.isZero())
    {
      return nearby;
    }
  }
  return Vector3::Zero();
}

Vector3 mean_normal(const ParametricSurface& surface, const Parameter<2>& t, const Sides<2>& sides)
{
  const DomainWalk<2> walk(surface);
  const DomainWalk<2>::Place place{ t, sides };
  Vector3 sum = unit_normal(surface, t, sides);
  const std::vector<DomainWalk<2>::Place> neighbours = walk.neighbours(place);
  if (neighbours.empty())
  {
    return sum;
  }
  const Vector3 point = surface.jet(t, sides, 0).point;
  for (const DomainWalk<2>::Place& neighbour : neighbours)
  {
    // At a gap the other side is another point, with a normal of its own.
    const Vector3 other = surface.jet(neighbour.t, neighbour.sides, 0).point;
    if ((other - point).norm() <= kClosureTolerance * surface.size())
    {
      sum += unit_normal(surface, neighbour.t, neighbour.sides);
    }
  }
  const double length = sum.norm();
  return length > kParallel ? Vector3(sum / length) : unit_normal(surface, t, sides);
}

Evaluation evaluate(const Face& face, const Parameter<2>& parameter)
{
  auto distance = [&parameter](const Patch& patch)
  {
    return patch.curve ? outside<1>(*patch.curve, parameter)
                       : outside<2>(*patch.surface, parameter);
  };
  const auto patch = std::min_element(face.patches.begin(), face.patches.end(),
    [&](const Patch& a, const Patch& b) { return distance(a) < distance(b); });
  return patch->curve ? evaluate_patch<1>(*patch, parameter, face.reversed)
                      : evaluate_patch<2>(*patch, parameter, face.reversed);
}

} // namespace footpoint
