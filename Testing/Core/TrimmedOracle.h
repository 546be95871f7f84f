// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// The nearest point of a trimmed face by brute force in long double, sharing no code with the search:
/// dense samples of what polygons through the loops keep and of the loops themselves, then a pattern
/// search about the best of them. What it finds is a point of the face (within the polygons' distance
/// from the loops), so no foot may be farther.

#include "Shapes.h"
#include "TrimShapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace trims
{

using Real = long double;
using Real2 = std::array<Real, 2>;
using Real3 = Eigen::Matrix<Real, 3, 1>;

class TrimmedOracle
{
public:
  /// \param loops in the domain of the surface \param resolution samples along a direction
  TrimmedOracle(const Surface& surface, const std::vector<TrimLoop>& loops, int resolution = 60)
    : Spline(shapes::spline_of(surface))
  {
    for (int i = 0; i < 2; ++i)
    {
      this->Lower[i] = surface.direction(i).origin;
      this->Width[i] = surface.direction(i).length;
    }
    for (const TrimLoop& loop : loops)
    {
      this->add(loop);
    }
    for (int i = 0; i <= resolution; ++i)
    {
      for (int j = 0; j <= resolution; ++j)
      {
        const Real2 at{ { this->Lower[0] + this->Width[0] * i / resolution,
          this->Lower[1] + this->Width[1] * j / resolution } };
        if (this->keeps(at))
        {
          this->Inside.push_back({ at, this->point(at) });
        }
      }
    }
    this->Cell = 1.0L / resolution;
  }

  Real3 point(const Real2& at) const
  {
    typename oracle::Spline<2>::Parameters t;
    for (int i = 0; i < 2; ++i)
    {
      t[i] = std::clamp(at[i], this->Lower[i], this->Lower[i] + this->Width[i]);
    }
    const auto value = this->Spline.point(t);
    return { value[0], value[1], value[2] };
  }

  /// Whether the polygons keep a point: the winding number by crossings of a ray.
  bool keeps(const Real2& at) const
  {
    int winding = 0;
    for (const std::vector<Real2>& polygon : this->Polygons)
    {
      for (std::size_t k = 0; k + 1 < polygon.size(); ++k)
      {
        const Real2& a = polygon[k];
        const Real2& b = polygon[k + 1];
        if ((a[1] <= at[1]) == (b[1] <= at[1]))
        {
          continue;
        }
        const Real side =
          (b[0] - a[0]) * (at[1] - a[1]) - (at[0] - a[0]) * (b[1] - a[1]);
        if (b[1] > a[1] ? side > 0 : side < 0)
        {
          winding += b[1] > a[1] ? 1 : -1;
        }
      }
    }
    return winding > 0;
  }

  /// How far a point of the parameter plane is from the polygons, in parts of the domain.
  Real distance_to_loops(const Real2& at) const
  {
    Real best = INFINITY;
    for (const std::vector<Real2>& polygon : this->Polygons)
    {
      for (std::size_t k = 0; k + 1 < polygon.size(); ++k)
      {
        Real length = 0;
        Real along = 0;
        Real2 way;
        Real2 to;
        for (int i = 0; i < 2; ++i)
        {
          way[i] = (polygon[k + 1][i] - polygon[k][i]) / this->Width[i];
          to[i] = (at[i] - polygon[k][i]) / this->Width[i];
          length += way[i] * way[i];
          along += way[i] * to[i];
        }
        const Real part = length > 0 ? std::clamp<Real>(along / length, 0, 1) : 0;
        best = std::min(best, std::hypot(to[0] - part * way[0], to[1] - part * way[1]));
      }
    }
    return best;
  }

  /// Distance of the nearest point that is found.
  Real nearest(const footpoint::Vector3& query) const
  {
    const Real3 p = query.cast<Real>();
    Real best = INFINITY;
    for (const std::size_t k : best_of(this->Inside, p))
    {
      best = std::min(best, this->descend(this->Inside[k].at, p));
    }
    for (const std::size_t k : best_of(this->Rims, p))
    {
      best = std::min(best, this->slide(this->Rims[k], p));
    }
    return best;
  }

private:
  struct Sample
  {
    Real2 at;
    Real3 point;
    std::size_t curve = 0;
    Real t = 0;
  };
  struct LoopCurve
  {
    oracle::Spline<1> spline;
    Real origin;
    Real length;

    Real2 place(Real t) const
    {
      const auto value = this->spline.point({ { this->origin + t } }, { { t == this->length } });
      return { { value[0], value[1] } };
    }
  };
  static constexpr int kOfCurve = 256;
  static constexpr std::size_t kDescents = 4;
  static constexpr Real kBesideLoop = 1e-4L;

  void add(const TrimLoop& loop)
  {
    std::vector<Real2> polygon;
    for (const CurvePointer& curve : loop.curves)
    {
      this->Curves.push_back({ shapes::spline_of(*curve), curve->direction(0).origin,
        curve->direction(0).length });
      const std::vector<double>& spans = curve->direction(0).spans;
      for (std::size_t s = 0; s + 1 < spans.size(); ++s)
      {
        for (int k = 0; k <= kOfCurve; ++k)
        {
          const Real t = spans[s] + (spans[s + 1] - spans[s]) * static_cast<Real>(k) / kOfCurve;
          const Real2 at = this->Curves.back().place(t);
          polygon.push_back(at);
          if (this->in_domain(at))
          {
            this->Rims.push_back({ at, this->point(at), this->Curves.size() - 1, t });
          }
        }
      }
    }
    polygon.push_back(polygon.front());
    this->Polygons.push_back(std::move(polygon));
  }

  bool in_domain(const Real2& at) const
  {
    bool inside = true;
    for (int i = 0; i < 2; ++i)
    {
      inside = inside && at[i] >= this->Lower[i] && at[i] <= this->Lower[i] + this->Width[i];
    }
    return inside;
  }

  template <class Samples>
  static std::vector<std::size_t> best_of(const Samples& samples, const Real3& p)
  {
    std::vector<std::pair<Real, std::size_t>> order;
    for (std::size_t k = 0; k < samples.size(); ++k)
    {
      order.emplace_back((samples[k].point - p).squaredNorm(), k);
    }
    const std::size_t count = std::min(kDescents, order.size());
    std::partial_sort(order.begin(), order.begin() + count, order.end());
    std::vector<std::size_t> result;
    for (std::size_t k = 0; k < count; ++k)
    {
      result.push_back(order[k].second);
    }
    return result;
  }

  /// Pattern search inside the polygons.
  Real descend(Real2 at, const Real3& p) const
  {
    Real best = (this->point(at) - p).norm();
    for (Real step = this->Cell; step > 1e-11L;)
    {
      bool better = false;
      for (int k = 0; k < 8; ++k)
      {
        static const int kWays[8][2] = { { 1, 0 }, { -1, 0 }, { 0, 1 }, { 0, -1 }, { 1, 1 },
          { -1, -1 }, { 1, -1 }, { -1, 1 } };
        const Real2 there{ { at[0] + kWays[k][0] * step * this->Width[0],
          at[1] + kWays[k][1] * step * this->Width[1] } };
        if (!this->in_domain(there) || !this->keeps(there))
        {
          continue;
        }
        const Real distance = (this->point(there) - p).norm();
        if (distance < best)
        {
          best = distance;
          at = there;
          better = true;
          break;
        }
      }
      step = better ? step : step / 2;
    }
    // Beside a loop the polygon may keep what the loop does not.
    return this->distance_to_loops(at) > kBesideLoop ? best : INFINITY;
  }

  /// The same along a loop curve.
  Real slide(const Sample& from, const Real3& p) const
  {
    const LoopCurve& curve = this->Curves[from.curve];
    const Real length = curve.length;
    Real t = from.t;
    Real best = (from.point - p).norm();
    for (Real step = length / kOfCurve; step > 1e-12L * length;)
    {
      bool better = false;
      for (const Real sign : { 1.0L, -1.0L })
      {
        const Real there = std::clamp<Real>(t + sign * step, 0, length);
        const Real2 at = curve.place(there);
        const Real distance = this->in_domain(at) ? (this->point(at) - p).norm() : INFINITY;
        if (distance < best)
        {
          best = distance;
          t = there;
          better = true;
          break;
        }
      }
      step = better ? step : step / 2;
    }
    return best;
  }

  oracle::Spline<2> Spline;
  Real2 Lower;
  Real2 Width;
  Real Cell;
  std::vector<LoopCurve> Curves;
  std::vector<std::vector<Real2>> Polygons;
  std::vector<Sample> Inside;
  std::vector<Sample> Rims;
};

} // namespace trims
