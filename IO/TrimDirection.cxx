// SPDX-License-Identifier: BSD-3-Clause
#include "TrimDirection.h"

#include "SplineBlocks.h"

#include "footpoint/splines/curve.h"

#include <algorithm>

namespace footpoint::files
{

namespace
{

/// Corners on each span between knots; the area need only have the right sign.
constexpr int kSamples = 8;

void append_samples(std::vector<Vector3>& polygon, const Spline& spline)
{
  if (spline.knots[0].empty())
  {
    for (std::size_t i = 0; i < spline.number_of_points(); ++i)
    {
      polygon.emplace_back(
        spline.points[3 * i], spline.points[3 * i + 1], spline.points[3 * i + 2]);
    }
    return;
  }
  const Curve curve = make_curve(spline);
  const std::vector<DistinctKnot>& knots = curve.knots().distinct_knots();
  for (std::size_t k = 1; k < knots.size(); ++k)
  {
    for (int i = 0; i < kSamples; ++i)
    {
      const double fraction = static_cast<double>(i) / (kSamples - 1);
      const double t = knots[k - 1].at + fraction * (knots[k].at - knots[k - 1].at);
      polygon.push_back(curve.centre() + curve.point(Parameter<1>(t)));
    }
  }
}

} // namespace

bool is_counter_clockwise(const std::vector<Spline>& loop)
{
  std::vector<Vector3> polygon;
  for (const Spline& spline : loop)
  {
    append_samples(polygon, spline);
  }
  double area = 0.0;
  const Vector3 origin = polygon.front();
  for (std::size_t i = 1; i < polygon.size(); ++i)
  {
    const Vector3 a = polygon[i - 1] - origin;
    const Vector3 b = polygon[i] - origin;
    area += a[0] * b[1] - a[1] * b[0];
  }
  return area > 0.0;
}

std::vector<Spline> reversed(const std::vector<Spline>& loop)
{
  std::vector<Spline> result(loop.rbegin(), loop.rend());
  for (Spline& spline : result)
  {
    std::vector<double> points;
    for (std::size_t i = spline.number_of_points(); i-- > 0;)
    {
      points.insert(
        points.end(), { spline.points[3 * i], spline.points[3 * i + 1], spline.points[3 * i + 2] });
    }
    spline.points = std::move(points);
    std::reverse(spline.weights.begin(), spline.weights.end());
    std::vector<double>& knots = spline.knots[0];
    if (!knots.empty())
    {
      const double sum = knots.front() + knots.back();
      std::reverse(knots.begin(), knots.end());
      for (double& knot : knots)
      {
        knot = sum - knot;
      }
    }
  }
  return result;
}

std::vector<Spline> domain_border(const Spline& surface)
{
  const auto start = [&](int direction)
  { return surface.knots[direction][static_cast<std::size_t>(surface.degree[direction])]; };
  const auto end = [&](int direction) { return surface.knots[direction][surface.size(direction)]; };
  Spline border;
  border.dimension = 1;
  border.points = { start(0), start(1), 0, end(0), start(1), 0, end(0), end(1), 0, start(0), end(1),
    0, start(0), start(1), 0 };
  return { border };
}

} // namespace footpoint::files
