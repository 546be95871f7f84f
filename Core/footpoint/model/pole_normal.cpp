// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/model/pole_normal.h"

#include "footpoint/model/evaluation.h"

#include <cmath>

namespace footpoint
{
namespace
{

/// Into how many wedges a collapsed side is divided.
constexpr int kPoleWedges = 16;

/// How far from a pole is looked whether the face surrounds it, as a fraction of the domain.
constexpr double kBesidePole = 1e-6;

/// So near a collapsed side, as a fraction of the domain, a foot is at the pole.
constexpr double kAtPole = 1e-9;

} // namespace

Sides<2> sides_at(const Surface& surface, const Parameter<2>& at)
{
  Sides<2> sides;
  for (int i = 0; i < 2; ++i)
  {
    sides(i) = at(i) >= surface.direction(i).length ? Side::Left : Side::Right;
  }
  return sides;
}

Vector3 pole_fan(const Surface& surface, const Parameter<2>& from, int around, double way)
{
  Vector3 sum = Vector3::Zero();
  Vector3 before = Vector3::Zero();
  for (int k = 0; k <= kPoleWedges; ++k)
  {
    Parameter<2> at = from;
    at(around) += way * k / kPoleWedges;
    const Jet<2> jet = surface.jet(at, sides_at(surface, at), 1);
    const Vector3 here = jet.first.col(1 - around).normalized();
    if (k > 0)
    {
      at(around) -= 0.5 * way / kPoleWedges;
      sum += std::atan2(before.cross(here).norm(), before.dot(here)) *
        unit_normal(surface, at, sides_at(surface, at));
    }
    before = here;
  }
  return sum;
}

Vector3 pole_normal(const Face& face, const Parameter<2>& parameter)
{
  const auto* surface = face.patches.size() == 1
    ? dynamic_cast<const Surface*>(face.patches.front().surface.get())
    : nullptr;
  for (int around = 0; surface && around < 2; ++around)
  {
    const Direction& turn = surface->direction(around);
    const Direction& out = surface->direction(1 - around);
    const double fraction = (parameter(1 - around) - out.origin) / out.length;
    const int end = fraction > 0.5;
    if (std::abs(fraction - end) > kAtPole || !turn.closed || !out.collapsed[end])
    {
      continue;
    }
    Parameter<2> from = Parameter<2>::Zero();
    from(1 - around) = end ? out.length : 0.0;
    for (int k = 0; face.region && k < kPoleWedges; ++k)
    {
      Parameter<2> beside = from;
      beside(around) = turn.length * (k + 0.5) / kPoleWedges;
      beside(1 - around) = (end ? 1.0 - kBesidePole : kBesidePole) * out.length;
      if (!face.region->contains(beside(0), beside(1)))
      {
        return Vector3::Zero();
      }
    }
    const Vector3 fan = pole_fan(*surface, from, around, turn.length);
    return face.reversed ? Vector3(-fan) : fan;
  }
  return Vector3::Zero();
}

} // namespace footpoint
