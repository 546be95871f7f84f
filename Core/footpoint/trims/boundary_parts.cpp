// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/trims/boundary_parts.h"

#include "footpoint/trims/arc_cell.h"
#include "footpoint/trims/arc_contacts.h"
#include "footpoint/trims/arc_part.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace footpoint
{
namespace
{

using Point2 = Eigen::Vector2d;

/// Pairs of parts that are compared for two arcs, and for all of a region: about 10 ms and half a
/// second.
constexpr int kStepsOfPair = 1 << 13;
constexpr int kStepsOfRegion = 1 << 18;

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
    , Unit(contact_unit(plane))
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

  /// Where two arcs meet: an end of one of them, or where others meet there, or on the line on
  /// which one of them lies.
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

} // namespace

std::vector<BoundaryPart> cut_at_contacts(std::vector<ChainArc> arcs, const TrimPlane& plane)
{
  Cutter cutter(std::move(arcs), plane);
  cutter.compare_all();
  return cutter.parts();
}

} // namespace footpoint
