// SPDX-License-Identifier: BSD-3-Clause

#include "TrimOracle.h"

#include <algorithm>
#include <cmath>

namespace trims
{

RealPoint de_boor(const Curve& curve, int span, Real t)
{
  const int p = curve.knots().degree();
  const std::vector<double>& knots = curve.knots().local_knots();
  std::vector<std::array<Real, 3>> d(p + 1);
  for (int j = 0; j <= p; ++j)
  {
    const int i = span - p + j;
    const Real w = curve.rational() ? curve.weights()[i] : 1.0;
    for (int k = 0; k < 2; ++k)
    {
      d[j][k] = w * (static_cast<Real>(curve.local_control_points()(k, i)) + curve.centre()[k]);
    }
    d[j][2] = w;
  }
  for (int r = 1; r <= p; ++r)
  {
    for (int j = p; j >= r; --j)
    {
      const Real low = knots[span - p + j];
      const Real alpha = (t - low) / (static_cast<Real>(knots[span + 1 + j - r]) - low);
      for (int k = 0; k < 3; ++k)
      {
        d[j][k] = (1 - alpha) * d[j - 1][k] + alpha * d[j][k];
      }
    }
  }
  return { { d[p][0] / d[p][2], d[p][1] / d[p][2] } };
}

std::vector<RealPoint> polygon_of(const TrimLoop& loop, int samples)
{
  std::vector<RealPoint> corners;
  for (const CurvePointer& curve : loop.curves)
  {
    const std::vector<double>& knots = curve->knots().local_knots();
    const int p = curve->knots().degree();
    const int count = p == 1 ? 1 : samples;
    for (int span = p; span < curve->knots().number_of_control_points(); ++span)
    {
      for (int k = 0; k <= count && knots[span] < knots[span + 1]; ++k)
      {
        const Real t = knots[span] + (static_cast<Real>(knots[span + 1]) - knots[span]) * k / count;
        corners.push_back(de_boor(*curve, span, t));
      }
    }
  }
  return corners;
}

View view(const std::vector<RealPoint>& corners, Real u, Real v, const RealPoint& scale)
{
  Real angle = 0;
  Real nearest = 1e30L;
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    const RealPoint& a = corners[i];
    const RealPoint& b = corners[(i + 1) % corners.size()];
    const Real ax = (a[0] - u) / scale[0];
    const Real ay = (a[1] - v) / scale[1];
    const Real bx = (b[0] - u) / scale[0];
    const Real by = (b[1] - v) / scale[1];
    angle += std::atan2(ax * by - ay * bx, ax * bx + ay * by);
    const Real dx = bx - ax;
    const Real dy = by - ay;
    const Real length = dx * dx + dy * dy;
    const Real t =
      length > 0 ? std::clamp(-(ax * dx + ay * dy) / length, Real(0), Real(1)) : Real(0);
    nearest = std::min(nearest, std::hypot(ax + t * dx, ay + t * dy));
  }
  return { static_cast<int>(std::lround(angle / (2 * std::acos(Real(-1))))), nearest };
}

Real area(const std::vector<RealPoint>& corners)
{
  Real sum = 0;
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    const RealPoint& a = corners[i];
    const RealPoint& b = corners[(i + 1) % corners.size()];
    sum += (a[0] - corners[0][0]) * (b[1] - corners[0][1]) -
      (a[1] - corners[0][1]) * (b[0] - corners[0][0]);
  }
  return sum / 2;
}

RealPoint on_arc(const footpoint::TrimArc& arc, Real t)
{
  std::vector<std::array<Real, 3>> d(arc.control.cols());
  for (std::size_t j = 0; j < d.size(); ++j)
  {
    for (int k = 0; k < 3; ++k)
    {
      d[j][k] = arc.control(k, static_cast<Eigen::Index>(j));
    }
  }
  for (std::size_t last = d.size() - 1; last > 0; --last)
  {
    for (std::size_t j = 0; j < last; ++j)
    {
      for (int k = 0; k < 3; ++k)
      {
        d[j][k] = (1 - t) * d[j][k] + t * d[j + 1][k];
      }
    }
  }
  return { { d[0][0] / d[0][2], d[0][1] / d[0][2] } };
}

} // namespace trims
