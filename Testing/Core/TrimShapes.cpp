// SPDX-License-Identifier: BSD-3-Clause

#include "TrimShapes.h"

#include <cmath>

namespace trims
{

Surface flat(double u0, double u1, double v0, double v1, int spans)
{
  const std::vector<double> knots_u = shapes::clamped_knots(1, spans, u0, u1);
  const std::vector<double> knots_v = shapes::clamped_knots(1, spans, v0, v1);
  Points points(3, (spans + 1) * (spans + 1));
  for (int j = 0; j <= spans; ++j)
  {
    for (int i = 0; i <= spans; ++i)
    {
      points.col(j * (spans + 1) + i) << knots_u[i + 1], knots_v[j + 1], 0.0;
    }
  }
  return Surface(KnotVector(1, knots_u), KnotVector(1, knots_v), points);
}

CurvePointer polyline(const std::vector<Point2>& corners)
{
  const int count = static_cast<int>(corners.size());
  Points points = Points::Zero(3, count);
  for (int i = 0; i < count; ++i)
  {
    points.col(i).head<2>() = corners[i];
  }
  return std::make_shared<Curve>(KnotVector(1, shapes::clamped_knots(1, count - 1)), points);
}

TrimLoop polygon(const std::vector<Point2>& corners)
{
  TrimLoop loop;
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    loop.curves.push_back(polyline({ corners[i], corners[(i + 1) % corners.size()] }));
  }
  return loop;
}

TrimLoop rectangle(double u0, double v0, double u1, double v1)
{
  return polygon({ { u0, v0 }, { u1, v0 }, { u1, v1 }, { u0, v1 } });
}

CurvePointer reversed(const Curve& curve)
{
  std::vector<double> knots = curve.knots().knots();
  const double sum = knots.front() + knots.back();
  std::vector<double> backwards;
  for (auto knot = knots.rbegin(); knot != knots.rend(); ++knot)
  {
    backwards.push_back(sum - *knot);
  }
  const Points points = curve.local_control_points().colwise() + curve.centre();
  return std::make_shared<Curve>(KnotVector(curve.knots().degree(), backwards),
    points.rowwise().reverse(), curve.weights().reverse());
}

TrimLoop reversed(const TrimLoop& loop)
{
  TrimLoop result;
  for (auto curve = loop.curves.rbegin(); curve != loop.curves.rend(); ++curve)
  {
    result.curves.push_back(reversed(**curve));
  }
  return result;
}

TrimLoop circle(double u, double v, double radius)
{
  const double w = std::sqrt(0.5);
  Points points(3, 9);
  Eigen::VectorXd weights(9);
  const double x[9] = { 1, 1, 0, -1, -1, -1, 0, 1, 1 };
  const double y[9] = { 0, 1, 1, 1, 0, -1, -1, -1, 0 };
  for (int i = 0; i < 9; ++i)
  {
    points.col(i) << u + radius * x[i], v + radius * y[i], 0.0;
    weights[i] = i % 2 == 0 ? 1.0 : w;
  }
  TrimLoop loop;
  loop.curves.push_back(std::make_shared<Curve>(
    KnotVector(2, { 0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4 }), points, weights));
  return loop;
}

} // namespace trims
