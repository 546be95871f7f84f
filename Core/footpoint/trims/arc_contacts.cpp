// SPDX-License-Identifier: BSD-3-Clause
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

/// A part is straight where its control points are no farther from its chord, in contact_unit().
constexpr double kStraight = 0.25;

/// The fraction of an arc at which coordinate i is that of a point, as far as the arc reaches.
double fraction_beside(const ChainArc& arc, int i, double along)
{
  const double ascending = arc.end[1][i] >= arc.end[0][i] ? 1.0 : -1.0;
  if (ascending * (along - arc.end[0][i]) <= 0.0)
  {
    return 0.0;
  }
  return ascending * (along - arc.end[1][i]) >= 0.0 ? 1.0 : fraction_at(arc, i, along);
}

class Comparison
{
public:
  Comparison(const ChainArc& a, const ChainArc& b, const TrimPlane& plane, int& steps)
    : Arcs{ { &a, &b } }
    , Unit(contact_unit(plane))
    , Whole{ { whole_arc(a, this->Unit), whole_arc(b, this->Unit) } }
    , Steps(steps)
  {
  }

  ArcContacts run()
  {
    if (are_apart(this->Whole[0], this->Whole[1]))
    {
      return {};
    }
    if (this->join())
    {
      return {};
    }
    if (!this->overlap())
    {
      this->search();
    }
    return std::move(this->Contacts);
  }

private:
  /// A contact of two straight parts.
  struct Meeting
  {
    std::array<double, 2> at;
    std::array<double, 2> lower; ///< fractions of the arcs between which the parts lie
    std::array<double, 2> upper;
    double distance;
  };

  /// Whether the arcs only join, end to end.
  bool join() const
  {
    for (int k = 0; k < 4; ++k)
    {
      const int end[2] = { k % 2, k / 2 };
      if (this->Arcs[0]->end[end[0]] != this->Arcs[1]->end[end[1]])
      {
        continue;
      }
      Eigen::Matrix2Xd points[2];
      for (int i = 0; i < 2; ++i)
      {
        points[i] = end[i] == 0 ? this->Whole[i].points
                                : Eigen::Matrix2Xd(this->Whole[i].points.rowwise().reverse());
      }
      if (only_join(points[0], points[1]))
      {
        return true;
      }
    }
    return false;
  }

  /// Looks for a stretch that both share: it ends where one of them does.
  bool overlap()
  {
    std::vector<std::array<double, 2>>& common = this->Ends;
    for (int i = 0; i < 2; ++i)
    {
      for (int end = 0; end < 2; ++end)
      {
        const Point2 at = end == 0 ? this->Whole[i].start() : this->Whole[i].end();
        std::array<double, 2> place;
        place[i] = end;
        place[1 - i] = this->beside(1 - i, at);
        if (this->distance(1 - i, place[1 - i], at) <= 1.0)
        {
          common.push_back(place);
        }
      }
    }
    if (common.size() < 2)
    {
      return false;
    }
    const auto ends = std::minmax_element(common.begin(), common.end());
    const std::array<double, 2> first = *ends.first;
    const std::array<double, 2> last = *ends.second;
    const Point2 from = point_at(this->Whole[0], first[0]);
    const Point2 to = point_at(this->Whole[0], last[0]);
    if ((to - from).norm() <= kOnePlace)
    {
      return false;
    }
    const auto samples =
      (this->Whole[0].points.cols() - 1) * (this->Whole[1].points.cols() - 1) + 1;
    for (Eigen::Index k = 1; k <= samples; ++k)
    {
      const double part = static_cast<double>(k) / static_cast<double>(samples + 1);
      const Point2 at = point_at(this->Whole[0], first[0] + part * (last[0] - first[0]));
      if (this->distance(1, this->beside(1, at), at) > 1.0)
      {
        return false;
      }
    }
    const bool same_way = last[1] > first[1];
    const auto [low, high] = std::minmax(first[1], last[1]);
    this->Contacts.overlaps.push_back(
      { { { { { first[0], last[0] } }, { { low, high } } } }, same_way });
    return true;
  }

  /// The fraction of an arc at which it is near a point: as far as it along u or along v, whichever
  /// brings it nearer, since an arc may turn back in one of them.
  double beside(int i, const Point2& at) const
  {
    double best = 0.0;
    double nearest = INFINITY;
    for (int k = 0; k < 2; ++k)
    {
      const double t = fraction_beside(*this->Arcs[i], k, at[k] * this->Unit[k]);
      const double distance = this->distance(i, t, at);
      best = distance < nearest ? t : best;
      nearest = std::min(nearest, distance);
    }
    return best;
  }

  /// Of a point from an arc at a fraction of it.
  double distance(int i, double t, const Point2& at) const
  {
    return (point_at(this->Whole[i], t) - at).norm();
  }

  void search()
  {
    std::vector<std::array<ArcPart, 2>> stack{ this->Whole };
    std::vector<Meeting> meetings;
    while (!stack.empty())
    {
      const std::array<ArcPart, 2> pair = std::move(stack.back());
      stack.pop_back();
      if (are_apart(pair[0], pair[1]))
      {
        continue;
      }
      if (--this->Steps < 0)
      {
        this->Contacts.complete = false;
        break;
      }
      if (pair[0].bulge <= kStraight && pair[1].bulge <= kStraight)
      {
        meetings.push_back(this->meet(pair));
        continue;
      }
      const int which = pair[0].bulge >= pair[1].bulge ? 0 : 1;
      for (ArcPart& half : halves(pair[which]))
      {
        stack.push_back(pair);
        stack.back()[which] = std::move(half);
      }
    }
    this->merge(std::move(meetings));
  }

  /// Where two straight parts are nearest to each other.
  Meeting meet(const std::array<ArcPart, 2>& pair) const
  {
    const Point2 p = pair[0].end() - pair[0].start();
    const Point2 q = pair[1].end() - pair[1].start();
    const Point2 between = pair[1].start() - pair[0].start();
    const double cross = p[0] * q[1] - p[1] * q[0];
    const double s = (between[0] * q[1] - between[1] * q[0]) / cross;
    const double r = (between[0] * p[1] - between[1] * p[0]) / cross;
    std::array<Point2, 2> at{ { pair[0].start(), pair[1].start() } };
    // Of lines that are nearly parallel s and r may be far off.
    const bool crossing = s >= 0.0 && s <= 1.0 && r >= 0.0 && r <= 1.0;
    if (crossing)
    {
      at = { { pair[0].start() + s * p, pair[1].start() + r * q } };
    }
    if (!crossing || !((at[1] - at[0]).norm() <= kStraight))
    {
      double nearest = INFINITY;
      for (int k = 0; k < 4; ++k)
      {
        const int i = k / 2; // an end of this one, the other one beside it
        const Point2 end = k % 2 == 0 ? pair[i].start() : pair[i].end();
        const Point2 way = i == 0 ? q : p;
        const Point2 from = pair[1 - i].start();
        const double length = way.squaredNorm();
        const double part =
          length > 0.0 ? std::clamp((end - from).dot(way) / length, 0.0, 1.0) : 0.0;
        const Point2 other = from + part * way;
        if ((other - end).norm() < nearest)
        {
          nearest = (other - end).norm();
          at[i] = end;
          at[1 - i] = other;
        }
      }
    }
    Meeting meeting;
    for (int i = 0; i < 2; ++i)
    {
      meeting.lower[i] = pair[i].lower;
      meeting.upper[i] = pair[i].upper;
      meeting.at[i] = std::clamp(this->beside(i, at[i]), pair[i].lower, pair[i].upper);
    }
    meeting.distance = (at[1] - at[0]).norm();
    return meeting;
  }

  /// Parts side by side that meet are one contact: where they are nearest.
  void merge(std::vector<Meeting> meetings)
  {
    const auto are_neighbours = [](const Meeting& a, const Meeting& b)
    {
      for (int i = 0; i < 2; ++i)
      {
        if (a.lower[i] > b.upper[i] || b.lower[i] > a.upper[i])
        {
          return false;
        }
      }
      return true;
    };
    while (!meetings.empty())
    {
      std::vector<Meeting> group{ meetings.back() };
      meetings.pop_back();
      Meeting best = group.front();
      for (std::size_t k = 0; k < group.size(); ++k)
      {
        for (std::size_t other = meetings.size(); other-- > 0;)
        {
          if (are_neighbours(group[k], meetings[other]))
          {
            group.push_back(meetings[other]);
            best = meetings[other].distance < best.distance ? meetings[other] : best;
            meetings.erase(meetings.begin() + static_cast<std::ptrdiff_t>(other));
          }
        }
      }
      if (best.distance > kApart)
      {
        continue;
      }
      // Arcs that touch are one point over a stretch: the end of one of them, if it is there.
      for (const std::array<double, 2>& end : this->Ends)
      {
        const bool here = std::any_of(group.begin(), group.end(),
          [&](const Meeting& meeting)
          {
            return meeting.lower[0] <= end[0] && end[0] <= meeting.upper[0] &&
              meeting.lower[1] <= end[1] && end[1] <= meeting.upper[1];
          });
        best.at = here ? end : best.at;
      }
      this->Contacts.touches.push_back({ best.at });
    }
  }

  std::array<const ChainArc*, 2> Arcs;
  Point2 Unit;
  std::array<ArcPart, 2> Whole;
  int& Steps;
  std::vector<std::array<double, 2>> Ends; ///< of one arc on the other, as fractions of both
  ArcContacts Contacts;
};

} // namespace

ArcContacts arc_contacts(
  const ChainArc& a, const ChainArc& b, const TrimPlane& plane, int& steps)
{
  return Comparison(a, b, plane, steps).run();
}

} // namespace footpoint
