// SPDX-License-Identifier: BSD-3-Clause

#include "LoopOracle.h"

#include "OracleShapes.h"

#include <algorithm>
#include <cmath>

namespace oracle
{

LoopCurve::LoopCurve(const footpoint::Curve& curve)
  : Spline(std::make_shared<FastSpline<1>>(shapes::spline_of(curve)))
{
}

LoopCurve::LoopCurve(const Place& from, const Place& to)
  : From(from)
  , To(to)
{
}

std::vector<Real> LoopCurve::breaks() const
{
  return this->Spline ? this->Spline->breaks(0) : std::vector<Real>{ 0.0L, 1.0L };
}

Place LoopCurve::at(Real t) const
{
  if (!this->Spline)
  {
    return { { this->From[0] + t * (this->To[0] - this->From[0]),
      this->From[1] + t * (this->To[1] - this->From[1]) } };
  }
  const Vector value = this->Spline->point({ { t } }, { { t >= this->Spline->upper(0) } });
  return { { value[0], value[1] } };
}

LoopOracle::LoopOracle(const std::vector<footpoint::TrimLoop>& loops, const Place& width)
  : Width(width)
{
  for (const footpoint::TrimLoop& loop : loops)
  {
    this->add(loop);
  }
  this->fill_slabs();
}

bool LoopOracle::keeps(const Place& at) const
{
  if (!(at[1] >= this->Low[1] && at[1] <= this->High[1]))
  {
    return false;
  }
  int winding = 0;
  for (const std::size_t k : this->Slabs[this->slab(at[1])])
  {
    winding += this->crossings(this->Sides[k], at, kDeepest);
  }
  return winding > 0;
}

Real LoopOracle::distance(const Place& at) const
{
  Real best = INFINITY;
  for (const Side& side : this->Sides)
  {
    if (this->distance_to_chord(side, at) - side.bulge < best)
    {
      this->refine_distance(side, at, best, kDeepest);
    }
  }
  return best;
}

bool LoopOracle::keeps_beside_loops(const Place& at, Real within) const
{
  for (const Side& side : this->Sides)
  {
    if (this->distance_to_chord(side, at) - side.bulge > within)
    {
      continue;
    }
    Place before = side.end[0];
    for (int k = 1; k <= kLooks; ++k)
    {
      const Real t = side.t[0] + (side.t[1] - side.t[0]) * k / kLooks;
      const Place here = this->Curves[side.curve].at(t);
      Place way;
      Place off;
      for (int i = 0; i < 2; ++i)
      {
        way[i] = (here[i] - before[i]) / this->Width[i];
        off[i] = (here[i] - at[i]) / this->Width[i];
      }
      before = here;
      const Real length = std::hypot(way[0], way[1]);
      if (!(length > 0) || std::hypot(off[0], off[1]) > within)
      {
        continue;
      }
      const Real by = kBesideLoop / length;
      if (this->keeps({ { here[0] - by * way[1] * this->Width[0],
            here[1] + by * way[0] * this->Width[1] } }) ||
        this->keeps(
          { { here[0] + by * way[1] * this->Width[0], here[1] - by * way[0] * this->Width[1] } }))
      {
        return true;
      }
    }
  }
  return false;
}

LoopOracle::Side LoopOracle::side(
  std::size_t curve, Real t0, Real t1, const Place& from, const Place& to) const
{
  Side result{ curve, { t0, t1 }, { from, to }, 0.0L };
  if (!this->Curves[curve].is_gap())
  {
    for (const Real part : { 0.25L, 0.5L, 0.75L })
    {
      const Place there = this->Curves[curve].at(t0 + part * (t1 - t0));
      result.bulge = std::max(result.bulge, 4.0L * this->distance_to_chord(result, there));
    }
  }
  return result;
}

void LoopOracle::add(const footpoint::TrimLoop& loop)
{
  const int number = this->Loops.empty() ? 0 : this->Loops.back() + 1;
  const std::size_t first = this->Curves.size();
  for (const auto& curve : loop.curves)
  {
    this->Curves.emplace_back(*curve);
    this->Loops.push_back(number);
  }
  const std::size_t count = this->Curves.size() - first;
  for (std::size_t k = 0; k < count; ++k)
  {
    const LoopCurve& next = this->Curves[first + (k + 1) % count];
    const LoopCurve& here = this->Curves[first + k];
    const Place end = here.at(here.breaks().back());
    const Place start = next.at(next.breaks().front());
    if (end != start)
    {
      this->Curves.emplace_back(end, start);
      this->Loops.push_back(number);
    }
  }
  for (std::size_t k = first; k < this->Curves.size(); ++k)
  {
    const std::vector<Real> breaks = this->Curves[k].breaks();
    const int parts = this->Curves[k].is_gap() ? 1 : kOfSpan;
    Place from = this->Curves[k].at(breaks.front());
    for (std::size_t s = 0; s + 1 < breaks.size(); ++s)
    {
      Real before = breaks[s];
      for (int part = 1; part <= parts; ++part)
      {
        const Real t =
          part == parts ? breaks[s + 1] : breaks[s] + (breaks[s + 1] - breaks[s]) * part / parts;
        const Place to = this->Curves[k].at(t);
        this->Sides.push_back(this->side(k, before, t, from, to));
        from = to;
        before = t;
      }
    }
  }
}

void LoopOracle::fill_slabs()
{
  this->Low = { { INFINITY, INFINITY } };
  this->High = { { -INFINITY, -INFINITY } };
  for (const Side& one : this->Sides)
  {
    for (int i = 0; i < 2; ++i)
    {
      const Real bulge = one.bulge * this->Width[i];
      this->Low[i] = std::min(this->Low[i], std::min(one.end[0][i], one.end[1][i]) - bulge);
      this->High[i] = std::max(this->High[i], std::max(one.end[0][i], one.end[1][i]) + bulge);
    }
  }
  this->Slabs.resize(kSlabs);
  for (std::size_t k = 0; k < this->Sides.size(); ++k)
  {
    const Side& one = this->Sides[k];
    const Real bulge = one.bulge * this->Width[1];
    const std::size_t last = this->slab(std::max(one.end[0][1], one.end[1][1]) + bulge);
    for (std::size_t s = this->slab(std::min(one.end[0][1], one.end[1][1]) - bulge); s <= last; ++s)
    {
      this->Slabs[s].push_back(k);
    }
  }
}

std::size_t LoopOracle::slab(Real v) const
{
  const Real part = (v - this->Low[1]) / (this->High[1] - this->Low[1]);
  return static_cast<std::size_t>(
    std::clamp<Real>(part * kSlabs, 0.0L, static_cast<Real>(kSlabs - 1)));
}

Real LoopOracle::distance_to_chord(const Side& one, const Place& at) const
{
  Real length = 0;
  Real along = 0;
  Place way;
  Place to;
  for (int i = 0; i < 2; ++i)
  {
    way[i] = (one.end[1][i] - one.end[0][i]) / this->Width[i];
    to[i] = (at[i] - one.end[0][i]) / this->Width[i];
    length += way[i] * way[i];
    along += way[i] * to[i];
  }
  const Real part = length > 0 ? std::clamp<Real>(along / length, 0, 1) : 0;
  return std::hypot(to[0] - part * way[0], to[1] - part * way[1]);
}

std::array<LoopOracle::Side, 2> LoopOracle::halves(const Side& one) const
{
  const Real middle = (one.t[0] + one.t[1]) / 2;
  const Place there = this->Curves[one.curve].at(middle);
  return { { this->side(one.curve, one.t[0], middle, one.end[0], there),
    this->side(one.curve, middle, one.t[1], there, one.end[1]) } };
}

int LoopOracle::crossings(const Side& one, const Place& at, int deeper) const
{
  const Place& a = one.end[0];
  const Place& b = one.end[1];
  // The chord stands for the curve unless the point may be between the two.
  const Real bulge = one.bulge * this->Width[0];
  const bool beside = at[0] < std::min(a[0], b[0]) - bulge || at[0] > std::max(a[0], b[0]) + bulge;
  if (!beside && deeper > 0 && one.bulge > kRounding &&
    this->distance_to_chord(one, at) <= one.bulge)
  {
    const std::array<Side, 2> both = this->halves(one);
    return this->crossings(both[0], at, deeper - 1) + this->crossings(both[1], at, deeper - 1);
  }
  if ((a[1] <= at[1]) == (b[1] <= at[1]))
  {
    return 0;
  }
  const Real side = (b[0] - a[0]) * (at[1] - a[1]) - (at[0] - a[0]) * (b[1] - a[1]);
  const bool upwards = b[1] > a[1];
  return (upwards ? side > 0 : side < 0) ? (upwards ? 1 : -1) : 0;
}

void LoopOracle::refine_distance(const Side& one, const Place& at, Real& best, int deeper) const
{
  const Real to_chord = this->distance_to_chord(one, at);
  if (to_chord - one.bulge >= best)
  {
    return;
  }
  if (deeper == 0 || one.bulge <= kRounding)
  {
    best = std::min(best, to_chord);
    return;
  }
  const std::array<Side, 2> both = this->halves(one);
  const bool second = this->distance_to_chord(both[1], at) < this->distance_to_chord(both[0], at);
  this->refine_distance(both[second ? 1 : 0], at, best, deeper - 1);
  this->refine_distance(both[second ? 0 : 1], at, best, deeper - 1);
}

} // namespace oracle
