// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/trims/trim_region.h"

#include "footpoint/common/errors.h"
#include "footpoint/splines/validation.h"
#include "footpoint/trims/arc_bounds.h"
#include "footpoint/trims/boundary_parts.h"
#include "footpoint/trims/loop_area.h"
#include "footpoint/trims/loop_chain.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace footpoint
{

namespace
{

/// How far beside the middle of an arc a region that no whole cell lies in is looked for, in
/// roundings of the plane: a thinner one has no inside that could be told from its boundary.
constexpr double kBesideArc = 4.0;

/// Rays run along u only where that makes them meet clearly fewer arcs.
constexpr double kLongerAlong = 2.0;

/// Areas of loops that differ by less, as a fraction, are equal: far above the rounding of
/// integration.
constexpr double kSameArea = 1e-9;

/// Which way rays run: a is the coordinate they are parted by, b the one they run along.
struct RayPlane
{
  int a;
  int b;
  /// +1 where (a, b) is (u, v), −1 where it is (v, u): swapping them turns left into right.
  int orientation;
};

RayPlane choose_rays(const std::vector<LoopChain>& chains, const TrimPlane& plane)
{
  std::array<int, 2> winds{ { -1, -1 } };
  for (std::size_t k = 0; k < chains.size(); ++k)
  {
    for (int i = 0; i < 2; ++i)
    {
      if (chains[k].turns[i] != 0 && winds[i] < 0)
      {
        winds[i] = static_cast<int>(k);
      }
    }
  }
  if (winds[0] >= 0 && winds[1] >= 0)
  {
    throw GeometryError(GeometryDefect::Format,
      "trim loop " + std::to_string(winds[0]) + " runs around the surface in u and trim loop " +
        std::to_string(winds[1]) + " in v; loops that run around both ways bound no region");
  }
  const RayPlane along_v{ 0, 1, 1 };
  const RayPlane along_u{ 1, 0, -1 };
  if (winds[0] >= 0 || winds[1] >= 0)
  {
    return winds[1] >= 0 ? along_u : along_v;
  }
  // Rays along v meet as many arcs as the arcs are long in u: think of a comb with teeth along u.
  std::array<double, 2> extent{ { 0.0, 0.0 } };
  for (const LoopChain& chain : chains)
  {
    for (const ChainArc& arc : chain.arcs)
    {
      for (int i = 0; i < 2; ++i)
      {
        extent[i] += std::abs(arc.end[1][i] - arc.end[0][i]) / plane.length(i);
      }
    }
  }
  const bool free = !plane.closed(0) && !plane.closed(1);
  return free && extent[0] > kLongerAlong * extent[1] ? along_u : along_v;
}

/// Copies of a loop along b, as numbers of periods, that reach into the domain.
std::vector<int> copies(const LoopChain& chain, int b, const TrimPlane& plane)
{
  if (!plane.closed(b) || chain.arcs.empty())
  {
    return { 0 };
  }
  double low = chain.arcs.front().end[0][b];
  double high = low;
  for (const ChainArc& arc : chain.arcs)
  {
    low = std::min(low, arc.end[1][b]);
    high = std::max(high, arc.end[1][b]);
  }
  const double length = plane.length(b);
  std::vector<int> found;
  for (int k = static_cast<int>(std::floor(-high / length)); low + k * length < length; ++k)
  {
    if (high + k * length > 0.0)
    {
      found.push_back(k);
    }
  }
  return found;
}

/// The winding number that has to be added so that the left side of the outermost loop is 1.
int base_winding(const std::vector<LoopChain>& chains, const RayPlane& rays, const TrimPlane& plane)
{
  struct Height
  {
    double at;
    int turns; ///< +1 keeps what lies above it
  };
  std::vector<Height> heights;                   // of the loops that run around the surface
  std::array<double, 2> largest{ { 0.0, 0.0 } }; // of counter-clockwise, of clockwise loops
  for (const LoopChain& chain : chains)
  {
    if (chain.arcs.empty())
    {
      continue;
    }
    const int turns = chain.turns[rays.a];
    const double b0 = chain.arcs.front().end[0][rays.b];
    const double area = area_below(chain, rays.a, rays.b, b0);
    if (turns != 0)
    {
      for (const int copy : copies(chain, rays.b, plane))
      {
        heights.push_back(
          { b0 + area / (turns * plane.length(rays.a)) + copy * plane.length(rays.b),
            turns * rays.orientation });
      }
    }
    else
    {
      const bool clockwise = area * rays.orientation > 0.0;
      largest[clockwise] = std::max(largest[clockwise], std::abs(area));
    }
  }
  if (heights.empty())
  {
    return largest[1] > (1.0 + kSameArea) * largest[0] ? 1 : 0;
  }
  std::sort(
    heights.begin(), heights.end(), [](const Height& a, const Height& b) { return a.at < b.at; });
  return heights.front().turns > 0 ? 0 : 1;
}

/// Where the middle of an arc's coordinate i lies, in periods; along the seam on the side whose
/// region the arc keeps.
double period_of(const ChainArc& arc, int i, double length)
{
  const double start = arc.end[0][i];
  const double end = arc.end[1][i];
  const double period = std::floor((0.5 * start + 0.5 * end) / length);
  if (start != end || start != period * length)
  {
    return period;
  }
  const int other = 1 - i;
  const bool ascending = arc.end[1][other] > arc.end[0][other];
  return ascending == (i == 0) ? period - 1.0 : period;
}

/// Shifts the arcs of a loop into the domain, along one direction.
void shift_into_domain(LoopChain& chain, int i, const TrimPlane& plane)
{
  if (!plane.closed(i))
  {
    return;
  }
  const double length = plane.length(i);
  for (ChainArc& arc : chain.arcs)
  {
    const double period = period_of(arc, i, length);
    if (period != 0.0)
    {
      shift(arc, i, -period * length);
      for (int which = 0; which < 2; ++which)
      {
        const double at = arc.end[which][i];
        place_end(arc, which, i, plane.snapped(i, at));
      }
    }
  }
  // Coming round, the end differs from the start by the rounding of a period.
  double start = chain.arcs.empty() ? 0.0 : chain.arcs.front().end[0][i];
  for (auto arc = chain.arcs.rbegin(); chain.turns[i] != 0 && arc != chain.arcs.rend(); ++arc)
  {
    if (std::abs(arc->end[1][i] - start) > plane.rounding(i))
    {
      break; // on the seam
    }
    if (arc->end[0][i] != arc->end[1][i])
    {
      place_end(*arc, 1, i, start);
      break;
    }
    make_constant(*arc, i, start);
  }
}

IndexedArc indexed(const ChainArc& arc, const RayPlane& rays, double by)
{
  IndexedArc result{ arc.arc.control, {}, rays.orientation };
  result.control.row(0) = arc.arc.control.row(rays.a);
  result.control.row(1) = arc.arc.control.row(rays.b) + by * arc.arc.control.row(2);
  for (int which = 0; which < 2; ++which)
  {
    result.end[which] = { arc.end[which][rays.a], arc.end[which][rays.b] + by };
  }
  return result;
}

} // namespace

TrimRegion::TrimRegion(const std::vector<TrimLoop>& loops, const Surface& surface, double tolerance)
  : Plane(surface)
{
  if (loops.empty())
  {
    throw GeometryError(GeometryDefect::Format, "a trimmed face needs at least one loop");
  }
  const TrimPlane& plane = this->Plane;
  const double largest_gap = std::max(tolerance, kLargestGap * surface.size());
  std::vector<LoopChain> chains;
  for (std::size_t k = 0; k < loops.size(); ++k)
  {
    chains.push_back(make_chain(loops[k], static_cast<int>(k), surface, plane, largest_gap));
    this->LargestGap = std::max(this->LargestGap, chains.back().largest_gap);
  }
  const RayPlane rays = choose_rays(chains, plane);
  const int base = base_winding(chains, rays, plane);

  std::vector<IndexedArc> arcs;
  std::vector<ChainArc> in_domain;
  for (LoopChain& chain : chains)
  {
    const std::vector<int> all_copies = copies(chain, rays.b, plane);
    shift_into_domain(chain, rays.a, plane);
    for (const ChainArc& arc : chain.arcs)
    {
      for (const int copy : all_copies)
      {
        arcs.push_back(indexed(arc, rays, copy * plane.length(rays.b)));
      }
    }
    shift_into_domain(chain, rays.b, plane);
    for (ChainArc& arc : chain.arcs)
    {
      arc.arc.inside_domain = true;
      for (int i = 0; i < 2; ++i)
      {
        arc.arc.inside_domain =
          arc.arc.inside_domain && plane.inside(i, arc.end[0][i]) && plane.inside(i, arc.end[1][i]);
      }
      in_domain.push_back(std::move(arc));
    }
  }
  this->Swapped = rays.a == 1;
  this->Index = WindingIndex(arcs, { { plane.length(rays.a), plane.length(rays.b) } },
    { { plane.rounding(rays.a), plane.rounding(rays.b) } }, base);
  this->Cells = KeptCells(this->Index);
  this->add_arcs(std::move(in_domain));
  if (!this->keeps_something())
  {
    throw GeometryError(
      GeometryDefect::Format, "the " + std::to_string(loops.size()) + " trim loops keep nothing");
  }
}

/// Cut where they meet others, with what each of them bounds.
void TrimRegion::add_arcs(std::vector<ChainArc> arcs)
{
  const TrimPlane& plane = this->Plane;
  const auto winding = [&](Eigen::Vector2d place)
  {
    for (int i = 0; i < 2; ++i)
    {
      if (plane.closed(i) && !plane.inside(i, place[i]))
      {
        place[i] += place[i] < 0.0 ? plane.length(i) : -plane.length(i);
      }
    }
    return this->Index.winding(this->clamped(0, place[this->Swapped ? 1 : 0]),
      this->clamped(1, place[this->Swapped ? 0 : 1]));
  };
  std::vector<BoundaryPart> parts = cut_at_contacts(std::move(arcs), plane);
  for (BoundaryPart& part : parts)
  {
    if (part.arc.arc.inside_domain)
    {
      part.arc.arc.bounds = bounds_of(part, plane, winding);
    }
  }
  settle_short_parts(parts, plane);
  for (BoundaryPart& part : parts)
  {
    const ArcBounds bounds = part.arc.arc.bounds;
    if (part.overlapped && (bounds == ArcBounds::Inside || bounds == ArcBounds::Outside))
    {
      this->Passed.push_back({ part.arc, bounds == ArcBounds::Inside });
    }
    this->Arcs.push_back(std::move(part.arc.arc));
  }
}

bool TrimRegion::keeps_near_passed(double a, double b) const
{
  const Eigen::Vector2d place(this->Swapped ? b : a, this->Swapped ? a : b);
  const auto near = std::find_if(this->Passed.begin(), this->Passed.end(),
    [&](const PassedStretch& stretch) { return passes(stretch.arc, this->Plane, place); });
  return near == this->Passed.end() ? this->Index.winding(a, b) > 0 : near->kept;
}

TrimRegion::Cover TrimRegion::cover(
  const std::array<double, 2>& lower, const std::array<double, 2>& upper) const
{
  const int first = this->Swapped ? 1 : 0;
  const std::array<double, 2> low{ { this->clamped(0, lower[first]),
    this->clamped(1, lower[1 - first]) } };
  const std::array<double, 2> high{ { this->clamped(0, upper[first]),
    this->clamped(1, upper[1 - first]) } };
  KeptCells::Answer answer = this->Cells.cover(low, high);
  if (!answer.known && !this->Index.crossed(low, high))
  {
    const int winding =
      this->Index.winding(0.5 * low[0] + 0.5 * high[0], 0.5 * low[1] + 0.5 * high[1]);
    answer.state = winding > 0 ? KeptCells::State::Inside : KeptCells::State::Outside;
  }
  switch (answer.state)
  {
    case KeptCells::State::Inside:
      return Cover::Inside;
    case KeptCells::State::Outside:
      return Cover::Outside;
    default:
      return Cover::Crossed;
  }
}

/// Either a whole cell is kept, or what is kept is so thin that it shows beside the arcs only.
bool TrimRegion::keeps_something() const
{
  if (this->Cells.any_inside())
  {
    return true;
  }
  const double beside = kBesideArc * this->Index.margin()[1];
  for (std::size_t k = 0; k < this->Index.size(); ++k)
  {
    const Eigen::Vector2d middle = this->Index.point(k, 0.5);
    for (const double b : { middle[1] - beside, middle[1] + beside })
    {
      if (middle[0] >= 0.0 && middle[0] <= this->Index.length()[0] && b >= 0.0 &&
        b <= this->Index.length()[1] && this->Index.winding(middle[0], b) > 0)
      {
        return true;
      }
    }
  }
  return false;
}

} // namespace footpoint
