// SPDX-License-Identifier: BSD-3-Clause

#include "FaceOracle.h"

#include "OracleShapes.h"

#include <algorithm>
#include <utility>

namespace oracle
{

FaceOracle::FaceOracle(
  const footpoint::Surface& surface, const std::vector<footpoint::TrimLoop>& loops)
  : Spline(shapes::spline_of(surface))
{
  for (int i = 0; i < 2; ++i)
  {
    this->Lower[i] = this->Spline.lower(i);
    this->Upper[i] = this->Spline.upper(i);
    this->Width[i] = this->Upper[i] - this->Lower[i];
  }
  this->Loops = std::make_shared<LoopOracle>(
    loops.empty() ? std::vector<footpoint::TrimLoop>{ this->domain() } : loops, this->Width);
  this->add_inside();
  this->add_rims();
  this->InsideTree = SampleTree(points_of(this->Inside));
  this->RimTree = SampleTree(points_of(this->Rims));
}

Vector FaceOracle::point(const Place& at) const
{
  FastSpline<2>::Parameters t;
  FastSpline<2>::Sides left;
  for (int i = 0; i < 2; ++i)
  {
    t[i] = std::clamp(at[i], this->Lower[i], this->Upper[i]);
    left[i] = t[i] >= this->Upper[i];
  }
  return this->Spline.point(t, left);
}

Eigen::Vector3d FaceOracle::normal(const Place& at) const
{
  std::array<Vector, 2> way;
  for (int i = 0; i < 2; ++i)
  {
    std::array<Place, 2> there{ { at, at } };
    there[0][i] = std::max(at[i] - kDifference * this->Width[i], this->Lower[i]);
    there[1][i] = std::min(at[i] + kDifference * this->Width[i], this->Upper[i]);
    way[i] = (this->point(there[1]) - this->point(there[0])) / this->Width[i];
  }
  return way[0].cross(way[1]).normalized().cast<double>();
}

double FaceOracle::size() const
{
  Eigen::Vector3d low = Eigen::Vector3d::Constant(INFINITY);
  Eigen::Vector3d high = -low;
  for (const auto* samples : { &this->Inside, &this->Rims })
  {
    for (const Sample& sample : *samples)
    {
      low = low.cwiseMin(sample.point);
      high = high.cwiseMax(sample.point);
    }
  }
  return (high - low).norm();
}

double FaceOracle::rough(const Eigen::Vector3d& query) const
{
  double best = INFINITY;
  for (const std::size_t k : this->InsideTree.nearest(query, 1))
  {
    best = std::min(best, (this->Inside[k].point - query).norm());
  }
  for (const std::size_t k : this->RimTree.nearest(query, 1))
  {
    best = std::min(best, (this->Rims[k].point - query).norm());
  }
  return best;
}

bool FaceOracle::keeps_about(const Place& at) const
{
  return this->Loops->keeps(at) || this->Loops->keeps_beside_loops(at, kAbout);
}

FaceOracle::Found FaceOracle::nearest(const Eigen::Vector3d& query) const
{
  const Vector p = query.cast<Real>();
  Found best;
  for (const std::size_t k : this->RimTree.nearest(query, kDescents))
  {
    const Found here = this->slide(this->Rims[k], p);
    best = here.distance < best.distance ? here : best;
  }
  if (best.distance < INFINITY)
  {
    const Found here = this->descend(best, p);
    best = this->better(here, best) ? here : best;
  }
  for (const std::size_t k : this->InsideTree.nearest(query, kDescents))
  {
    const Place& at = this->Inside[k].at;
    const Found here = this->descend({ (this->point(at) - p).norm(), at }, p);
    best = this->better(here, best) ? here : best;
  }
  return best;
}

footpoint::TrimLoop FaceOracle::domain() const
{
  return trims::rectangle(static_cast<double>(this->Lower[0]), static_cast<double>(this->Lower[1]),
    static_cast<double>(this->Upper[0]), static_cast<double>(this->Upper[1]));
}

std::vector<Eigen::Vector3d> FaceOracle::points_of(const std::vector<Sample>& samples)
{
  std::vector<Eigen::Vector3d> points;
  for (const Sample& sample : samples)
  {
    points.push_back(sample.point);
  }
  return points;
}

std::vector<Real> FaceOracle::steps(int i) const
{
  const Real low = std::max(this->Lower[i], this->Loops->lower()[i]);
  const Real high = std::min(this->Upper[i], this->Loops->upper()[i]);
  std::vector<Real> ends{ low };
  for (const Real at : this->Spline.breaks(i))
  {
    if (at > low && at < high)
    {
      ends.push_back(at);
    }
  }
  ends.push_back(high);
  const int spans = static_cast<int>(ends.size()) - 1;
  const int fewest = this->Spline.degree(i) + 1;
  const int parts =
    std::clamp(kOfDomain / spans + 1, std::min(fewest, kMostOfDomain / spans + 1), kOfDomain);
  std::vector<Real> all{ low };
  for (int s = 0; s < spans; ++s)
  {
    for (int k = 1; k <= parts; ++k)
    {
      all.push_back(ends[s] + (ends[s + 1] - ends[s]) * k / parts);
    }
  }
  return all;
}

void FaceOracle::add_inside()
{
  const std::vector<Real> us = this->steps(0);
  const std::vector<Real> vs = this->steps(1);
  for (const Real v : vs)
  {
    for (const Real u : us)
    {
      const Place at{ { u, v } };
      if (this->Loops->keeps(at))
      {
        this->Inside.push_back({ at, this->point(at).cast<double>() });
      }
    }
  }
  for (int i = 0; i < 2; ++i)
  {
    this->Cell[i] = (this->Loops->upper()[i] - this->Loops->lower()[i]) / kOfDomain;
  }
}

void FaceOracle::add_rims()
{
  std::size_t spans = 0;
  for (const LoopCurve& curve : this->Loops->curves())
  {
    spans += curve.breaks().size() - 1;
  }
  const int parts =
    std::clamp(static_cast<int>(kMostOnRims / std::max<std::size_t>(spans, 1)), 4, kOfSpan);
  for (std::size_t c = 0; c < this->Loops->curves().size(); ++c)
  {
    const LoopCurve& curve = this->Loops->curves()[c];
    const std::vector<Real> breaks = curve.breaks();
    for (std::size_t s = 0; s + 1 < breaks.size(); ++s)
    {
      for (int k = 0; k <= parts; ++k)
      {
        const Real t =
          k == parts ? breaks[s + 1] : breaks[s] + (breaks[s + 1] - breaks[s]) * k / parts;
        const Place at = curve.at(t);
        if (this->in_domain(at))
        {
          this->Rims.push_back({ at, this->point(at).cast<double>(), c, t });
        }
      }
    }
  }
}

bool FaceOracle::in_domain(const Place& at) const
{
  bool inside = true;
  for (int i = 0; i < 2; ++i)
  {
    const Real beyond = kBeyond * this->Width[i];
    inside = inside && at[i] >= this->Lower[i] - beyond && at[i] <= this->Upper[i] + beyond;
  }
  return inside;
}

bool FaceOracle::better(const Found& here, const Found& best) const
{
  return here.distance < best.distance && this->is_kept_beside(here.at);
}

bool FaceOracle::is_kept_beside(const Place& at) const
{
  for (int k = 0; k < kLooks; ++k)
  {
    // Not along u or v, on lines that are run through there and back.
    const Real angle = 2.0L * std::acos(-1.0L) * (k + 0.37L) / kLooks;
    const Place there{ { at[0] + kBeside * std::cos(angle) * this->Width[0],
      at[1] + kBeside * std::sin(angle) * this->Width[1] } };
    bool inside = true;
    for (int i = 0; i < 2; ++i)
    {
      inside = inside && there[i] > this->Lower[i] && there[i] < this->Upper[i];
    }
    if (inside && this->Loops->keeps(there))
    {
      return true;
    }
  }
  return false;
}

Place FaceOracle::moved(const Place& at, Real du, Real dv) const
{
  return { { std::clamp(at[0] + du, this->Lower[0], this->Upper[0]),
    std::clamp(at[1] + dv, this->Lower[1], this->Upper[1]) } };
}

FaceOracle::Found FaceOracle::descend(Found best, const Vector& p) const
{
  const auto squared = [&](const Place& at) { return (this->point(at) - p).squaredNorm(); };
  bool blocked = false;
  for (int iteration = 0; iteration < 20; ++iteration)
  {
    // === Gradient and Hessian in parts of the domain, at a place off its border
    Place c;
    Place off;
    for (int i = 0; i < 2; ++i)
    {
      const Real h = kDifference * this->Width[i];
      c[i] = std::clamp(best.at[i], this->Lower[i] + h, this->Upper[i] - h);
      off[i] = (best.at[i] - c[i]) / this->Width[i];
    }
    Real f[3][3];
    for (int a = 0; a < 3; ++a)
    {
      for (int b = 0; b < 3; ++b)
      {
        f[a][b] = squared({ { c[0] + (a - 1) * kDifference * this->Width[0],
          c[1] + (b - 1) * kDifference * this->Width[1] } });
      }
    }
    const Real h = kDifference;
    Real g[2] = { (f[2][1] - f[0][1]) / (2 * h), (f[1][2] - f[1][0]) / (2 * h) };
    const Real uu = (f[2][1] - 2 * f[1][1] + f[0][1]) / (h * h);
    const Real vv = (f[1][2] - 2 * f[1][1] + f[1][0]) / (h * h);
    const Real uv = (f[2][2] - f[2][0] - f[0][2] + f[0][0]) / (4 * h * h);
    g[0] += uu * off[0] + uv * off[1];
    g[1] += uv * off[0] + vv * off[1];
    // === The step, along the border where it leads out
    bool held[2];
    for (int i = 0; i < 2; ++i)
    {
      held[i] =
        (best.at[i] <= this->Lower[i] && g[i] > 0) || (best.at[i] >= this->Upper[i] && g[i] < 0);
    }
    Real step[2] = { 0, 0 };
    const Real determinant = uu * vv - uv * uv;
    if (!held[0] && !held[1] && uu > 0 && determinant > 1e-12L * uu * vv)
    {
      step[0] = (uv * g[1] - vv * g[0]) / determinant;
      step[1] = (uv * g[0] - uu * g[1]) / determinant;
    }
    else
    {
      const Real second[2] = { std::abs(uu), std::abs(vv) };
      for (int i = 0; i < 2; ++i)
      {
        step[i] = held[i] || !(second[i] > 0) ? 0 : -g[i] / second[i];
      }
    }
    const Real length = std::hypot(step[0], step[1]);
    if (!(length > 1e-13L))
    {
      return best;
    }
    const Real scale = std::min<Real>(1, 0.1L / length);
    // === As far along it as is better and kept
    bool better = false;
    for (Real part = scale; part * length > 1e-13L && !better; part /= 4)
    {
      const Place there =
        this->moved(best.at, part * step[0] * this->Width[0], part * step[1] * this->Width[1]);
      const Real distance = std::sqrt(squared(there));
      if (distance < best.distance)
      {
        const bool kept = this->Loops->keeps(there);
        blocked = blocked || !kept;
        if (kept)
        {
          best = { distance, there };
          better = true;
        }
      }
    }
    if (!better)
    {
      break;
    }
  }
  // Loops are slid along by themselves.
  return blocked ? best : this->search_pattern(best, p);
}

FaceOracle::Found FaceOracle::search_pattern(Found best, const Vector& p) const
{
  Real step = 1;
  for (int move = 0; move < kMoves && step > kFinest; ++move)
  {
    bool better = false;
    for (int k = 0; k < 8 && !better; ++k)
    {
      const Place there = this->moved(
        best.at, kWays[k][0] * step * this->Cell[0], kWays[k][1] * step * this->Cell[1]);
      const Real distance = (this->point(there) - p).norm();
      if (distance < best.distance && this->Loops->keeps(there))
      {
        best = { distance, there };
        better = true;
      }
    }
    step = better ? step : step / 2;
  }
  return best;
}

FaceOracle::Found FaceOracle::slide(const Sample& from, const Vector& p) const
{
  const LoopCurve& curve = this->Loops->curves()[from.curve];
  const std::vector<Real> breaks = curve.breaks();
  const Real length = breaks.back() - breaks.front();
  const Real spans = static_cast<Real>(breaks.size() - 1);
  Real t = from.t;
  Found best{ (this->point(from.at) - p).norm(), from.at };
  Real step = length / (spans * kOfSpan);
  const Real finest = kFinest * step;
  for (int move = 0; move < kMoves && step > finest; ++move)
  {
    bool better = false;
    for (const Real sign : { 1.0L, -1.0L })
    {
      const Real there = std::clamp<Real>(t + sign * step, breaks.front(), breaks.back());
      const Place at = curve.at(there);
      const Real distance = this->in_domain(at) ? (this->point(at) - p).norm() : INFINITY;
      if (distance < best.distance)
      {
        best = { distance, at };
        t = there;
        better = true;
        break;
      }
    }
    step = better ? step : step / 2;
  }
  return this->is_kept_beside(best.at) ? best : Found{};
}

ModelOracle::ModelOracle(std::vector<FaceOracle> faces)
  : Faces(std::move(faces))
{
}

ModelOracle::Found ModelOracle::nearest(const Eigen::Vector3d& query) const
{
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t f = 0; f < this->Faces.size(); ++f)
  {
    order.emplace_back(this->Faces[f].rough(query), f);
  }
  const std::size_t count = std::min(kFaces, order.size());
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end());
  Found best;
  for (std::size_t k = 0; k < count; ++k)
  {
    const FaceOracle::Found here = this->Faces[order[k].second].nearest(query);
    if (here.distance < best.distance)
    {
      best = { here.distance, order[k].second, here.at };
    }
  }
  return best;
}

} // namespace oracle
