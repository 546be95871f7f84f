// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/model/edge_feet.h"

#include <cmath>

namespace footpoint
{
namespace
{

/// So near an end of an edge, as a fraction of its length, the foot is the end.
constexpr double kAtEnd = 1e-12;

/// How far into the face is looked, as a fraction of its domain, in how many directions, and the
/// cosine by which the distance has to decrease.
constexpr double kIntoFace = 1e-5;
constexpr int kDirections = 32;
constexpr double kDecrease = 1e-4;

bool is_on_open_side(const Surface& surface, const Parameter<2>& at)
{
  bool result = false;
  for (int i = 0; i < 2; ++i)
  {
    const Direction& direction = surface.direction(i);
    const bool at_side = at(i) <= 0.0 || at(i) >= direction.length;
    result = result || (at_side && !direction.closed);
  }
  return result;
}

FootType type_on_face(const EdgeCurve& edge, const PatchFoot& foot)
{
  if (foot.type == FootType::Kink)
  {
    return FootType::Vertex;
  }
  const double length = edge.direction(0).length;
  const bool at_start = foot.local(0) <= kAtEnd * length;
  const bool at_end = foot.local(0) >= (1.0 - kAtEnd) * length;
  if (edge.direction(0).closed || (!at_start && !at_end))
  {
    return FootType::Edge;
  }
  // Where a trim curve was cut it goes on, over a seam or not at all.
  const bool vertex = at_start ? edge.arcs().front().vertex[0] : edge.arcs().back().vertex[1];
  const Parameter<2> at = edge.surface_parameter(at_start ? 0.0 : length);
  return vertex || is_on_open_side(edge.surface(), at) ? FootType::Vertex : FootType::Edge;
}

} // namespace

PatchFoot on_surface(const EdgeCurve& edge, const PatchFoot& foot)
{
  PatchFoot result = foot;
  const Side side = foot.sides(0);
  result.local = edge.surface_parameter(foot.local(0), side);
  result.parameter = edge.surface().to_domain(result.local);
  result.sides = Sides<2>::Constant(Side::Right);
  for (int i = 0; i < 2; ++i)
  {
    result.sides(i) =
      result.local(i) >= edge.surface().direction(i).length ? Side::Left : Side::Right;
  }
  result.type = type_on_face(edge, foot);
  return result;
}

bool is_minimum_on_face(const EdgeCurve& edge, const TrimRegion& region, const PatchFoot& foot)
{
  const Surface& surface = edge.surface();
  const PatchFoot here = on_surface(edge, foot);
  const Jet<2> jet = surface.jet(here.local, here.sides, 1);
  const double pi = std::acos(-1.0);
  for (int k = 0; k < kDirections; ++k)
  {
    const double angle = 2.0 * pi * (k + 0.5) / kDirections;
    Parameter<2> step(std::cos(angle) * surface.direction(0).length,
      std::sin(angle) * surface.direction(1).length);
    const Vector3 way = jet.first * step;
    const double decrease = -foot.offset.dot(way);
    if (decrease <= kDecrease * foot.distance * way.norm())
    {
      continue;
    }
    const Parameter<2> there = here.local + kIntoFace * step;
    bool inside = true;
    for (int i = 0; i < 2; ++i)
    {
      inside = inside && there(i) >= 0.0 && there(i) <= surface.direction(i).length;
    }
    if (inside && region.contains(there(0), there(1)))
    {
      return false;
    }
  }
  return true;
}

} // namespace footpoint
