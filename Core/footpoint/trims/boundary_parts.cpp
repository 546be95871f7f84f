// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/trims/boundary_parts.h"

#include "footpoint/trims/arc_cell.h"
#include "footpoint/trims/arc_contacts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace footpoint
{
namespace
{

using Point2 = Eigen::Vector2d;

/// Lengths are in units of kContact of the plane's rounding. Contacts that are nearer to each other,
/// or to the end of an arc, are one.
constexpr double kOnePlace = 8.0;

/// Beside an arc by so much is looked what is kept: beyond the rounding of the winding number, and,
/// where several arcs run along one stretch, beyond all of them.
constexpr double kBeside = 2.0;
constexpr double kBesideAll = 4.0;

/// So near to an arc the rounding of the winding number may count it or not.
constexpr double kNear = 2.0;

/// Pairs of parts that are compared for two arcs, and for all of a region: about 20 ms and 0.5 s.
constexpr int kStepsOfPair = 1 << 15;
constexpr int kStepsOfRegion = 1 << 20;

/// Where a part is looked at, as fractions of it, until this many places have told the same.
constexpr double kPlaces[] = { 0.5, 0.25, 0.75, 0.375, 0.625, 0.125, 0.875, 0.0625, 0.9375 };
constexpr int kAgreeing = 3;

Point2 unit_of(const TrimPlane& plane)
{
  return { kContact * plane.rounding(0), kContact * plane.rounding(1) };
}

bool is_constant(const ChainArc& arc, int i)
{
  return arc.end[0][i] == arc.end[1][i];
}

/// A stretch of an arc that another one shares.
struct Stretch
{
  double lower;
  double upper;
  bool same_way;
  bool earlier; ///< the other arc is
};

struct Cut
{
  double fraction;
  Point2 at;
};

/// What is known about an arc when all pairs have been compared.
struct Marks
{
  std::vector<Cut> cuts;
  std::vector<Stretch> stretches;
  bool complete = true;
};

class Cutter
{
public:
  Cutter(std::vector<ChainArc> arcs, const TrimPlane& plane)
    : Arcs(std::move(arcs))
    , Plane(plane)
    , Unit(unit_of(plane))
    , Marked(this->Arcs.size())
  {
  }

  /// Compares all arcs whose boxes meet: a sweep along the direction in which they are shorter.
  void compare_all()
  {
    std::vector<std::size_t> order;
    std::array<double, 2> extent{ { 0.0, 0.0 } };
    for (std::size_t k = 0; k < this->Arcs.size(); ++k)
    {
      if (this->Arcs[k].arc.inside_domain)
      {
        order.push_back(k);
        for (int i = 0; i < 2; ++i)
        {
          extent[i] += (this->upper(k, i) - this->lower(k, i)) / this->Plane.length(i);
        }
      }
    }
    const int i = extent[0] <= extent[1] ? 0 : 1;
    std::sort(order.begin(), order.end(),
      [&](std::size_t a, std::size_t b) { return this->lower(a, i) < this->lower(b, i); });
    std::vector<std::size_t> open;
    for (const std::size_t k : order)
    {
      const double reach = kOnePlace * this->Unit[i];
      open.erase(std::remove_if(open.begin(), open.end(),
                   [&](std::size_t other)
                   { return this->upper(other, i) + reach < this->lower(k, i); }),
        open.end());
      for (const std::size_t other : open)
      {
        const int j = 1 - i;
        const double beside = kOnePlace * this->Unit[j];
        if (this->lower(other, j) <= this->upper(k, j) + beside &&
          this->lower(k, j) <= this->upper(other, j) + beside)
        {
          this->compare(std::min(k, other), std::max(k, other));
        }
      }
      open.push_back(k);
    }
  }

  std::vector<BoundaryPart> parts()
  {
    std::vector<BoundaryPart> result;
    for (std::size_t k = 0; k < this->Arcs.size(); ++k)
    {
      this->append_parts(k, result);
    }
    return result;
  }

private:
  double lower(std::size_t k, int i) const
  {
    return std::min(this->Arcs[k].end[0][i], this->Arcs[k].end[1][i]);
  }
  double upper(std::size_t k, int i) const
  {
    return std::max(this->Arcs[k].end[0][i], this->Arcs[k].end[1][i]);
  }

  double apart(const Point2& a, const Point2& b) const
  {
    return (a - b).cwiseQuotient(this->Unit).norm();
  }

  void compare(std::size_t a, std::size_t b)
  {
    const int allowed = std::min(kStepsOfPair, this->StepsLeft);
    int steps = allowed;
    const ArcContacts contacts = arc_contacts(this->Arcs[a], this->Arcs[b], this->Plane, steps);
    this->StepsLeft -= allowed - std::max(steps, 0);
    if (!contacts.complete)
    {
      this->Marked[a].complete = false;
      this->Marked[b].complete = false;
    }
    for (const ArcTouch& touch : contacts.touches)
    {
      this->cut(a, b, touch.at);
    }
    for (const ArcOverlap& overlap : contacts.overlaps)
    {
      for (int end = 0; end < 2; ++end)
      {
        this->cut(
          a, b, { { overlap.range[0][end], overlap.range[1][overlap.same_way ? end : 1 - end] } });
      }
      this->Marked[a].stretches.push_back(
        { overlap.range[0][0], overlap.range[0][1], overlap.same_way, false });
      this->Marked[b].stretches.push_back(
        { overlap.range[1][0], overlap.range[1][1], overlap.same_way, true });
    }
  }

  /// Cuts two arcs in the same point, but for those that end there.
  void cut(std::size_t a, std::size_t b, const std::array<double, 2>& fractions)
  {
    const Point2 at = this->place(a, b, fractions);
    for (int k = 0; k < 2; ++k)
    {
      const std::size_t arc = k == 0 ? a : b;
      std::vector<Cut>& cuts = this->Marked[arc].cuts;
      const bool at_end = this->apart(this->Arcs[arc].end[0], at) <= kOnePlace ||
        this->apart(this->Arcs[arc].end[1], at) <= kOnePlace;
      const bool known = std::any_of(cuts.begin(), cuts.end(),
        [&](const Cut& other) { return this->apart(other.at, at) <= kOnePlace; });
      if (!at_end && !known)
      {
        cuts.push_back({ fractions[k], at });
      }
    }
  }

  /// Where two arcs meet: an end of one of them, or where others meet there, or on the line on which
  /// one of them lies.
  Point2 place(std::size_t a, std::size_t b, const std::array<double, 2>& fractions)
  {
    Point2 at = arc_jet(this->Arcs[a].arc, fractions[0], 0).col(0);
    for (const std::size_t arc : { a, b })
    {
      for (const Point2& end : this->Arcs[arc].end)
      {
        if (this->apart(end, at) <= kOnePlace)
        {
          return end;
        }
      }
    }
    for (const Point2& known : this->Places)
    {
      if (this->apart(known, at) <= kOnePlace)
      {
        return known;
      }
    }
    for (int i = 0; i < 2; ++i)
    {
      for (const std::size_t arc : { a, b })
      {
        at[i] = is_constant(this->Arcs[arc], i) ? this->Arcs[arc].end[0][i] : at[i];
      }
    }
    this->Places.push_back(at);
    return at;
  }

  void append_parts(std::size_t k, std::vector<BoundaryPart>& result)
  {
    ChainArc& whole = this->Arcs[k];
    Marks& marks = this->Marked[k];
    std::sort(marks.cuts.begin(), marks.cuts.end(),
      [](const Cut& one, const Cut& other) { return one.fraction < other.fraction; });
    std::vector<double> fractions;
    for (const Cut& cut : marks.cuts)
    {
      fractions.push_back(cut.fraction);
    }
    std::vector<ChainArc> arcs = footpoint::cut(whole, fractions);
    for (std::size_t n = 0; n + 1 < arcs.size(); ++n)
    {
      for (int i = 0; i < 2; ++i)
      {
        const auto [low, high] = std::minmax(arcs[n].end[0][i], whole.end[1][i]);
        const double at = std::clamp(marks.cuts[n].at[i], low, high);
        place_end(arcs[n], 1, i, at);
        place_end(arcs[n + 1], 0, i, at);
      }
      arcs[n].arc.vertex[1] = true;
      arcs[n + 1].arc.vertex[0] = true;
    }
    fractions.insert(fractions.begin(), 0.0);
    fractions.push_back(1.0);
    for (std::size_t n = 0; n < arcs.size(); ++n)
    {
      BoundaryPart part;
      part.arc = std::move(arcs[n]);
      part.complete = marks.complete;
      const double middle = 0.5 * fractions[n] + 0.5 * fractions[n + 1];
      for (const Stretch& stretch : marks.stretches)
      {
        if (stretch.lower < middle && middle < stretch.upper)
        {
          part.overlapped = true;
          part.jump += stretch.same_way ? 1 : -1;
          part.repeated = part.repeated || (stretch.same_way && stretch.earlier);
        }
      }
      result.push_back(std::move(part));
    }
  }

  std::vector<ChainArc> Arcs;
  const TrimPlane& Plane;
  Point2 Unit;
  std::vector<Marks> Marked;
  std::vector<Point2> Places; ///< at which arcs were cut
  int StepsLeft = kStepsOfRegion;
};

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

std::vector<BoundaryPart> cut_at_contacts(std::vector<ChainArc> arcs, const TrimPlane& plane)
{
  Cutter cutter(std::move(arcs), plane);
  cutter.compare_all();
  return cutter.parts();
}

ArcBounds bounds_of(const BoundaryPart& part, const TrimPlane& plane,
  const std::function<int(const Eigen::Vector2d& place)>& winding)
{
  const Point2 unit = unit_of(plane);
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

bool passes(const ChainArc& arc, const TrimPlane& plane, const Eigen::Vector2d& place)
{
  const Point2 reach = kNear * unit_of(plane);
  for (int i = 0; i < 2; ++i)
  {
    const auto [low, high] = std::minmax(arc.end[0][i], arc.end[1][i]);
    if (!(place[i] >= low - reach[i] && place[i] <= high + reach[i]))
    {
      return false;
    }
  }
  // As far along the arc as the place, in either coordinate, since an arc may turn back in one of them.
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
