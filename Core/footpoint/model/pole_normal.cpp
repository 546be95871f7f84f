// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/model/pole_normal.h"

#include "footpoint/model/evaluation.h"

#include <algorithm>
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

/// Whether a face holds all that is beside the pole.
bool is_surrounded(const Face& face, const Surface& surface, int around, int end)
{
  if (!face.region)
  {
    return true;
  }
  for (int k = 0; k < kPoleWedges; ++k)
  {
    Parameter<2> beside;
    beside(around) = surface.direction(around).length * (k + 0.5) / kPoleWedges;
    beside(1 - around) =
      (end == 0 ? kBesidePole : 1.0 - kBesidePole) * surface.direction(1 - around).length;
    if (!face.region->contains(beside(0), beside(1)))
    {
      return false;
    }
  }
  return true;
}

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

PoleNormals::PoleNormals(const Model& model)
{
  for (std::size_t k = 0; k < model.size(); ++k)
  {
    const Face& face = model[k];
    const auto* surface = face.patches.size() == 1
      ? dynamic_cast<const Surface*>(face.patches.front().surface.get())
      : nullptr;
    for (int around = 0; surface && around < 2; ++around)
    {
      const Direction& turn = surface->direction(around);
      const Direction& out = surface->direction(1 - around);
      for (int end = 0; end < 2; ++end)
      {
        if (turn.closed && out.collapsed[end] && is_surrounded(face, *surface, around, end))
        {
          Parameter<2> from = Parameter<2>::Zero();
          from(1 - around) = end == 0 ? 0.0 : out.length;
          const Vector3 fan = pole_fan(*surface, from, around, turn.length);
          this->Poles.push_back({ static_cast<int>(k), 1 - around, out.origin + from(1 - around),
            kAtPole * out.length, face.reversed ? Vector3(-fan) : fan });
        }
      }
    }
  }
}

Vector3 PoleNormals::at(int face, const Parameter<2>& parameter) const
{
  auto pole = std::lower_bound(this->Poles.begin(), this->Poles.end(), face,
    [](const Pole& one, int number) { return one.face < number; });
  for (; pole != this->Poles.end() && pole->face == face; ++pole)
  {
    if (std::abs(parameter(pole->across) - pole->at) <= pole->tolerance)
    {
      return pole->normal;
    }
  }
  return Vector3::Zero();
}

} // namespace footpoint
