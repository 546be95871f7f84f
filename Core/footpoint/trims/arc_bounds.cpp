// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/trims/arc_bounds.h"

#include "footpoint/trims/arc_cell.h"
#include "footpoint/trims/arc_contacts.h"
#include "footpoint/trims/arc_part.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace footpoint
{
namespace
{

using Point2 = Eigen::Vector2d;

/// Lengths are in contact_unit().

/// Beside an arc by so much is looked what is kept: beyond the rounding of the winding number, and,
/// where several arcs run along one stretch, beyond all of them.
constexpr double kBeside = 2.0;
constexpr double kBesideAll = 4.0;

/// So near to an arc the rounding of the winding number may count it or not.
constexpr double kNear = 2.0;

/// Where a part is looked at, as fractions of it, until this many places have told the same.
constexpr double kPlaces[] = { 0.5, 0.25, 0.75, 0.375, 0.625, 0.125, 0.875, 0.0625, 0.9375 };
constexpr int kAgreeing = 3;

bool is_constant(const ChainArc& arc, int i)
{
  return arc.end[0][i] == arc.end[1][i];
}

/// To the left of an arc, one unit long.
Point2 left_of(const ChainArc& arc, double fraction, const Point2& unit)
{
  const Eigen::Matrix<double, 2, 4> jet = arc_jet(arc.arc, fraction, 1);
  Point2 along = jet.col(1).cwiseQuotient(unit);
  if (!(along.norm() > 0.0))
  {
    along = (arc.end[1] - arc.end[0]).cwiseQuotient(unit);
  }
  return Point2(-along[1], along[0]).normalized().cwiseProduct(unit);
}

/// The coordinate along whose border of the domain an arc runs, −1: none.
int border_of(const ChainArc& arc, const TrimPlane& plane)
{
  for (int i = 0; i < 2; ++i)
  {
    if (is_constant(arc, i) && (arc.end[0][i] == 0.0 || arc.end[0][i] == plane.length(i)))
    {
      return i;
    }
  }
  return -1;
}

} // namespace

ArcBounds bounds_of(const BoundaryPart& part, const TrimPlane& plane,
  const std::function<int(const Eigen::Vector2d& place)>& winding)
{
  const Point2 unit = contact_unit(plane);
  const ArcBounds edge = part.repeated ? ArcBounds::Repeated : ArcBounds::Face;
  const int border = border_of(part.arc, plane);
  if (border >= 0)
  {
    Point2 place = arc_jet(part.arc.arc, 0.5, 0).col(0);
    place[border] += part.arc.end[0][border] == 0.0 ? kBeside * unit[border]
                                                    : -kBeside * unit[border];
    return winding(place) > 0 ? edge : ArcBounds::Outside;
  }
  const double beside = part.overlapped ? kBesideAll : kBeside;
  int agreeing = 0;
  bool left_kept = false;
  bool right_kept = false;
  for (const double fraction : kPlaces)
  {
    const Point2 place = arc_jet(part.arc.arc, fraction, 0).col(0);
    const Point2 left = left_of(part.arc, fraction, unit);
    const int left_winding = winding(place + beside * left);
    const int right_winding = winding(place - beside * left);
    if (left_winding - right_winding != part.jump)
    {
      continue; // other arcs are as near as that
    }
    const bool first = agreeing == 0;
    if (!first && (left_kept != (left_winding > 0) || right_kept != (right_winding > 0)))
    {
      return ArcBounds::Undecided;
    }
    left_kept = left_winding > 0;
    right_kept = right_winding > 0;
    // A strip between arcs along one stretch that is thinner than they are known to be the same.
    for (const double between : { -1.0, -0.5, 0.5, 1.0 })
    {
      if (part.overlapped && !left_kept && !right_kept && winding(place + between * left) > 0)
      {
        return ArcBounds::Undecided;
      }
    }
    if (++agreeing == kAgreeing)
    {
      break;
    }
  }
  if (agreeing == 0 || !part.complete)
  {
    return ArcBounds::Undecided;
  }
  if (left_kept != right_kept)
  {
    return left_kept ? edge : ArcBounds::Repeated; // by one that runs the other way
  }
  return left_kept ? ArcBounds::Inside : ArcBounds::Outside;
}

void settle_short_parts(std::vector<BoundaryPart>& parts, const TrimPlane& plane)
{
  const Point2 unit = contact_unit(plane);
  const auto is_short = [&](const BoundaryPart& part)
  {
    return part.complete && part.arc.arc.inside_domain &&
      part.arc.arc.bounds == ArcBounds::Undecided &&
      (part.arc.end[1] - part.arc.end[0]).cwiseQuotient(unit).norm() <= kOnePlace;
  };
  for (std::size_t first = 0, end = 0; first < parts.size(); first = end)
  {
    while (end < parts.size() && parts[end].arc.arc.loop == parts[first].arc.arc.loop)
    {
      ++end;
    }
    const std::size_t count = end - first;
    std::vector<std::size_t> found;
    std::vector<ArcBounds> settled;
    for (std::size_t k = 0; k < count; ++k)
    {
      if (!is_short(parts[first + k]))
      {
        continue;
      }
      // The nearest parts before and behind it that are known.
      ArcBounds result = ArcBounds::Undecided;
      for (const std::size_t step : { std::size_t(1), count - 1 })
      {
        std::size_t other = (k + step) % count;
        while (other != k && is_short(parts[first + other]))
        {
          other = (other + step) % count;
        }
        const TrimArc& arc = parts[first + other].arc.arc;
        const ArcBounds bounds = arc.inside_domain ? arc.bounds : ArcBounds::Outside;
        const bool counts = bounds == ArcBounds::Face || result == ArcBounds::Undecided;
        result = counts && bounds != ArcBounds::Undecided ? bounds : result;
      }
      found.push_back(first + k);
      settled.push_back(result);
    }
    for (std::size_t k = 0; k < found.size(); ++k)
    {
      parts[found[k]].arc.arc.bounds = settled[k];
    }
  }
}

bool passes(const ChainArc& arc, const TrimPlane& plane, const Eigen::Vector2d& place)
{
  const Point2 reach = kNear * contact_unit(plane);
  for (int i = 0; i < 2; ++i)
  {
    const auto [low, high] = std::minmax(arc.end[0][i], arc.end[1][i]);
    if (!(place[i] >= low - reach[i] && place[i] <= high + reach[i]))
    {
      return false;
    }
  }
  // As far along the arc as the place, in either coordinate, since an arc may turn back in one of
  // them.
  for (int i = 0; i < 2; ++i)
  {
    const bool ascending = arc.end[1][i] > arc.end[0][i];
    const bool before = ascending ? place[i] <= arc.end[0][i] : place[i] >= arc.end[0][i];
    const bool behind = ascending ? place[i] >= arc.end[1][i] : place[i] <= arc.end[1][i];
    const Point2 at = before ? arc.end[0]
      : behind               ? arc.end[1]
                             : Point2(arc_jet(arc.arc, fraction_at(arc, i, place[i]), 0).col(0));
    if ((at - place).cwiseQuotient(reach).norm() <= 1.0)
    {
      return true;
    }
  }
  return false;
}

} // namespace footpoint
