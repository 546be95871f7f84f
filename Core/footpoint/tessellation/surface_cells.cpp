// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/tessellation/surface_cells.h"

#include "footpoint/model/evaluation.h"

#include <algorithm>
#include <cmath>

namespace footpoint
{
namespace
{

/// A box that needs no more parts than this in a direction is divided evenly: halves of it would
/// have nearly the same bounds.
constexpr int kFewParts = 3;

/// Beyond these parts in a direction the exact number does not matter, halving comes first.
constexpr int kManyParts = 16;

/// Where normals turn by more the triangles are no graph.
constexpr double kHalfTurn = 1.0;
constexpr double kSteep = 1e6;

/// Halving ends here whatever the bounds are: cells are at the rounding of parameters then.
constexpr int kDeepest = 60;

class Division
{
public:
  Division(const SurfaceBounds& bounds, const TrimRegion* region, const SamplingRule& rule)
    : Bounds(bounds)
    , Region(region)
    , Rule(rule)
  {
  }

  void divide(const ParameterBox& box, int depth)
  {
    if (this->Region &&
      this->Region->cover({ { box.lower[0], box.lower[1] } }, { { box.upper[0], box.upper[1] } }) ==
        TrimRegion::Cover::Outside)
    {
      return;
    }
    const auto spans = this->Bounds.spans(box);
    const bool several = spans[0][1] > spans[0][0] || spans[1][1] > spans[1][0];
    if (!this->Rule.adaptive && !several)
    {
      this->Cells.push_back({ box, { { this->Rule.resolution, this->Rule.resolution } } });
      return;
    }
    const std::array<int, 2> count = this->Rule.adaptive
      ? this->parts(box)
      : std::array<int, 2>{ { static_cast<int>(spans[0][1] - spans[0][0]) + 1,
          static_cast<int>(spans[1][1] - spans[1][0]) + 1 } };
    const int most = std::max(count[0], count[1]);
    if (this->Rule.adaptive && (most == 1 || depth >= kDeepest || (!several && most <= kFewParts)))
    {
      this->Cells.push_back({ box, count });
      return;
    }
    const int direction = count[0] >= count[1] ? 0 : 1;
    const double at = this->middle(box, direction);
    ParameterBox half = box;
    half.upper[direction] = at;
    this->divide(half, depth + 1);
    half = box;
    half.lower[direction] = at;
    this->divide(half, depth + 1);
  }

  std::vector<SurfaceCells> Cells;

private:
  /// A knot line near the middle, else the middle.
  double middle(const ParameterBox& box, int i) const
  {
    const std::vector<double>& knots = this->Bounds.knots(i);
    const double low = box.lower[i];
    const double high = box.upper[i];
    const double centre = low + 0.5 * (high - low);
    const auto above = std::lower_bound(knots.begin(), knots.end(), centre);
    double best = centre;
    double distance = high - low;
    for (auto knot = above == knots.begin() ? above : above - 1; knot != knots.end(); ++knot)
    {
      if (*knot > low && *knot < high && std::abs(*knot - centre) < distance)
      {
        best = *knot;
        distance = std::abs(*knot - centre);
      }
      if (*knot >= high || knot > above)
      {
        break;
      }
    }
    return best;
  }

  /// How normals turn over a box, at samples.
  struct Turns
  {
    std::array<double, 2> angle{ { 0.0, 0.0 } };  ///< along u, along v
    std::array<double, 2> length{ { 0.0, 0.0 } }; ///< of the box in space
    Vector3 up;                                   ///< the normal in the middle
    bool graph = true;                            ///< no sample is without a normal
  };

  /// The least numbers of even parts with which the bounds hold, and the angles.
  std::array<int, 2> parts(const ParameterBox& box) const
  {
    const Parameter<2> extent = box.extent();
    DerivativeBounds bounds = this->Bounds.over(box);
    if (bounds.second.chord(extent) <= this->Rule.tolerance && !(this->Rule.angle > 0.0))
    {
      return { { 1, 1 } };
    }
    const Turns turns = this->turns(box);
    bounds = this->Bounds.over(box, turns.up);
    const auto off = [&](int n, int m)
    {
      // Twice the angle from the middle of a cell to its corners: samples may miss something.
      const double angle = std::hypot(turns.angle[0] / n, turns.angle[1] / m);
      const Parameter<2> cell(extent[0] / n, extent[1] / m);
      return off_triangles(bounds.second.chord(cell), bounds.height.chord(cell),
        turns.graph && angle < kHalfTurn ? std::tan(angle) : kSteep, this->Rule.tolerance);
    };
    const auto enough = [&](int n, int m) { return off(n, m) <= 1.0; };
    std::array<int, 2> best{ { kManyParts, kManyParts } };
    if (!enough(kManyParts, kManyParts))
    {
      const double u = bounds.second.uu * extent[0] * extent[0];
      const double v = bounds.second.vv * extent[1] * extent[1];
      const bool along_u = u > v || (u == v && bounds.u * extent[0] >= bounds.v * extent[1]);
      best = { { along_u ? kManyParts : 1, along_u ? 1 : kManyParts } };
      return best;
    }
    int m = kManyParts;
    for (int n = 1; n <= kManyParts && n <= best[0] * best[1]; ++n)
    {
      while (m > 1 && enough(n, m - 1))
      {
        --m;
      }
      // Of equal products the nearer one.
      if (enough(n, m) &&
        (n * m < best[0] * best[1] ||
          (n * m == best[0] * best[1] && off(n, m) < off(best[0], best[1]))))
      {
        best = { { n, m } };
      }
    }
    if (this->Rule.angle > 0.0)
    {
      // The diagonal of a cell turns by what both sides turn; short sides are not divided.
      const auto turn = [&](int i)
      { return turns.length[i] > this->Rule.tolerance ? turns.angle[i] / best[i] : 0.0; };
      while (
        std::hypot(turn(0), turn(1)) > this->Rule.angle && std::max(best[0], best[1]) < kManyParts)
      {
        ++best[turn(0) >= turn(1) ? 0 : 1];
      }
    }
    return best;
  }

  Turns turns(const ParameterBox& box) const
  {
    const Surface& surface = this->Bounds.surface();
    const Parameter<2> extent = box.extent();
    Vector3 normals[3][3];
    Vector3 points[3][3];
    Turns turns;
    for (int j = 0; j < 3; ++j)
    {
      for (int i = 0; i < 3; ++i)
      {
        const Parameter<2> at = box.lower + Parameter<2>(0.5 * i, 0.5 * j).cwiseProduct(extent);
        const Sides<2> sides(i == 2 ? Side::Left : Side::Right, j == 2 ? Side::Left : Side::Right);
        normals[j][i] = unit_normal(surface, at, sides);
        points[j][i] = surface.jet(at, sides, 0).point;
        turns.graph = turns.graph && !normals[j][i].isZero();
      }
    }
    turns.up = normals[1][1];
    for (int k = 0; k < 3; ++k)
    {
      std::array<double, 2> along{ { 0.0, 0.0 } };
      for (int i = 0; i < 2; ++i)
      {
        const double u = 2.0 * angle_between(normals[k][i], normals[k][i + 1]);
        const double v = 2.0 * angle_between(normals[i][k], normals[i + 1][k]);
        turns.angle[0] = std::max(turns.angle[0], u);
        turns.angle[1] = std::max(turns.angle[1], v);
        along[0] += (points[k][i] - points[k][i + 1]).norm();
        along[1] += (points[i][k] - points[i + 1][k]).norm();
      }
      turns.length[0] = std::max(turns.length[0], along[0]);
      turns.length[1] = std::max(turns.length[1], along[1]);
    }
    return turns;
  }

  const SurfaceBounds& Bounds;
  const TrimRegion* Region;
  const SamplingRule& Rule;
};

} // namespace

double angle_between(const Vector3& a, const Vector3& b)
{
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

std::vector<SurfaceCells> divide(
  const SurfaceBounds& bounds, const TrimRegion* region, const SamplingRule& rule)
{
  Division division(bounds, region, rule);
  const std::vector<Break>& u = bounds.surface().direction(0).breaks;
  const std::vector<Break>& v = bounds.surface().direction(1).breaks;
  for (std::size_t j = 0; j + 1 < v.size(); ++j)
  {
    for (std::size_t i = 0; i + 1 < u.size(); ++i)
    {
      division.divide({ { u[i].at, v[j].at }, { u[i + 1].at, v[j + 1].at } }, 0);
    }
  }
  return std::move(division.Cells);
}

} // namespace footpoint
