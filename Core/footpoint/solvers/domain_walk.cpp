// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/solvers/domain_walk.h"

#include <algorithm>
#include <cmath>

namespace footpoint
{
namespace
{

std::vector<Break>::const_iterator find_break(const Direction& direction, double t)
{
  return std::lower_bound(direction.breaks.begin(), direction.breaks.end(), t,
    [](const Break& line, double value) { return line.at < value; });
}

double wrap(double t, double length)
{
  const double wrapped = t - length * std::floor(t / length);
  return wrapped >= length ? 0.0 : wrapped;
}

} // namespace

template <int N>
DomainWalk<N>::DomainWalk(const ParametricGeometry<N>& geometry)
  : Geometry(geometry)
{
}

template <int N>
bool DomainWalk<N>::is_break(int i, double t) const
{
  const Direction& direction = this->Geometry.direction(i);
  const auto line = find_break(direction, t);
  return line != direction.breaks.end() && line->at == t;
}

template <int N>
typename DomainWalk<N>::Place DomainWalk<N>::place_at(
  const Parameter<N>& t, const Parameter<N>& came_along) const
{
  Place place{ t, Sides<N>::Constant(Side::Right) };
  for (int i = 0; i < N; ++i)
  {
    const double length = this->Geometry.direction(i).length;
    // Who arrives at a line from below still belongs to the piece below.
    if (t(i) >= length || (t(i) > 0.0 && came_along(i) > 0.0))
    {
      place.sides(i) = Side::Left;
    }
  }
  return place;
}

template <int N>
typename DomainWalk<N>::Place DomainWalk<N>::enter(Parameter<N> t) const
{
  for (int i = 0; i < N; ++i)
  {
    const Direction& direction = this->Geometry.direction(i);
    if (direction.closed && (t(i) < 0.0 || t(i) > direction.length))
    {
      t(i) = wrap(t(i), direction.length);
    }
    t(i) = std::min(std::max(t(i), 0.0), direction.length);
  }
  return this->place_at(t, Parameter<N>::Zero());
}

template <int N>
bool DomainWalk<N>::at_lower_border(const Place& place, int i) const
{
  return place.sides(i) == Side::Right && this->is_break(i, place.t(i));
}

template <int N>
bool DomainWalk<N>::at_upper_border(const Place& place, int i) const
{
  return place.sides(i) == Side::Left && this->is_break(i, place.t(i));
}

template <int N>
bool DomainWalk<N>::on_boundary(const Place& place, int i) const
{
  const Direction& direction = this->Geometry.direction(i);
  const double t = place.t(i);
  if (t == 0.0 || t == direction.length)
  {
    return !direction.closed;
  }
  const auto line = find_break(direction, t);
  return line != direction.breaks.end() && line->at == t && line->gap;
}

template <int N>
bool DomainWalk<N>::on_collapsed_side(const Place& place, int i) const
{
  const Direction& direction = this->Geometry.direction(i);
  return (place.t(i) == 0.0 && direction.collapsed[0]) ||
    (place.t(i) == direction.length && direction.collapsed[1]);
}

template <int N>
double DomainWalk<N>::border_ahead(const Place& place, int i, bool up) const
{
  const double from = place.t(i);
  if (up ? this->at_upper_border(place, i) : this->at_lower_border(place, i))
  {
    return from;
  }
  const auto at_or_after = find_break(this->Geometry.direction(i), from);
  if (!up)
  {
    return std::prev(at_or_after)->at;
  }
  return at_or_after->at == from ? std::next(at_or_after)->at : at_or_after->at;
}

template <int N>
typename DomainWalk<N>::Move DomainWalk<N>::move(const Place& place, const Parameter<N>& step) const
{
  Move result;
  Parameter<N> t = place.t + step;
  result.moved = step;
  for (int i = 0; i < N; ++i)
  {
    const Direction& direction = this->Geometry.direction(i);
    if (step(i) == 0.0)
    {
      continue;
    }
    const double border = this->border_ahead(place, i, step(i) > 0.0);
    const bool passes = step(i) > 0.0 ? t(i) > border : t(i) < border;
    const bool open_end = !direction.closed && (border == 0.0 || border == direction.length);
    result.crosses = result.crosses || (passes && !open_end);
    if (t(i) < 0.0 || t(i) > direction.length)
    {
      if (direction.closed)
      {
        t(i) = wrap(t(i), direction.length);
      }
      else
      {
        t(i) = std::min(std::max(t(i), 0.0), direction.length);
        result.moved(i) = t(i) - place.t(i);
      }
    }
  }
  result.place = this->place_at(t, step);
  for (int i = 0; i < N; ++i)
  {
    if (step(i) == 0.0)
    {
      result.place.sides(i) = place.sides(i);
    }
  }
  return result;
}

template <int N>
typename DomainWalk<N>::Move DomainWalk<N>::move_to_border(
  const Place& place, const Parameter<N>& step) const
{
  // The fraction of the step up to the nearest border of the piece; on a border it slides along it.
  double fraction = 1.0;
  int first = -1;
  double stop = 0.0;
  Parameter<N> slid = step;
  for (int i = 0; i < N; ++i)
  {
    if (step(i) == 0.0)
    {
      continue;
    }
    const double border = this->border_ahead(place, i, step(i) > 0.0);
    if (border == place.t(i))
    {
      slid(i) = 0.0;
      continue;
    }
    const double part = (border - place.t(i)) / step(i);
    if (part < fraction)
    {
      fraction = part;
      first = i;
      stop = border;
    }
  }
  Move result = this->move(place, fraction * slid);
  if (first >= 0)
  {
    result.place.t(first) = stop;
    result.place.sides(first) = step(first) > 0.0 ? Side::Left : Side::Right;
    result.moved(first) = stop - place.t(first);
  }
  result.crosses = false;
  return result;
}

template <int N>
std::vector<typename DomainWalk<N>::Place> DomainWalk<N>::neighbours(const Place& place) const
{
  std::vector<Place> places{ place };
  for (int i = 0; i < N; ++i)
  {
    const Direction& direction = this->Geometry.direction(i);
    const double t = place.t(i);
    const bool at_end = t == 0.0 || t == direction.length;
    if (!this->is_break(i, t) || (at_end && !direction.closed))
    {
      continue;
    }
    const std::size_t count = places.size();
    for (std::size_t k = 0; k < count; ++k)
    {
      Place other = places[k];
      other.sides(i) = other.sides(i) == Side::Left ? Side::Right : Side::Left;
      if (at_end)
      {
        other.t(i) = t == 0.0 ? direction.length : 0.0;
      }
      places.push_back(other);
    }
  }
  places.erase(places.begin());
  return places;
}

template class DomainWalk<1>;
template class DomainWalk<2>;

} // namespace footpoint
