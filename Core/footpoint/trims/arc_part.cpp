// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/trims/arc_part.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace footpoint
{
namespace
{

using Point2 = Eigen::Vector2d;
using Control = Eigen::Matrix<double, 3, Eigen::Dynamic>;

ArcPart part_of(Control control, double lower, double upper)
{
  ArcPart part{ std::move(control), lower, upper, {}, 0.0 };
  part.points = part.control.topRows<2>().array().rowwise() / part.control.row(2).array();
  const Point2 chord = part.end() - part.start();
  const double length = chord.norm();
  for (Eigen::Index k = 1; k + 1 < part.points.cols(); ++k)
  {
    const Point2 to = part.points.col(k) - part.start();
    const double off =
      length > 0.0 ? std::abs(chord[0] * to[1] - chord[1] * to[0]) / length : to.norm();
    part.bulge = std::max(part.bulge, off);
  }
  return part;
}

/// Whether the control points are apart along a direction.
bool are_apart(const ArcPart& a, const ArcPart& b, const Point2& direction)
{
  const double length = direction.norm();
  if (!(length > 0.0))
  {
    return false;
  }
  const Point2 from = a.start();
  const Point2 along = direction / length;
  const auto extent = [&](const Eigen::Matrix2Xd& points)
  {
    std::array<double, 2> result{ { INFINITY, -INFINITY } };
    for (Eigen::Index k = 0; k < points.cols(); ++k)
    {
      const double at = along.dot(points.col(k) - from);
      result = { { std::min(result[0], at), std::max(result[1], at) } };
    }
    return result;
  };
  const std::array<double, 2> of_a = extent(a.points);
  const std::array<double, 2> of_b = extent(b.points);
  return of_a[0] > of_b[1] + kApart || of_b[0] > of_a[1] + kApart;
}

} // namespace

ArcPart whole_arc(const ChainArc& arc, const Eigen::Vector2d& unit)
{
  Control control = arc.arc.control;
  control.row(0) /= unit[0];
  control.row(1) /= unit[1];
  return part_of(std::move(control), 0.0, 1.0);
}

std::array<ArcPart, 2> halves(const ArcPart& part)
{
  Control left = part.control;
  Control right = part.control; // overwritten from the front by de Casteljau's columns
  const Eigen::Index degree = right.cols() - 1;
  for (Eigen::Index level = 1; level <= degree; ++level)
  {
    for (Eigen::Index j = 0; j <= degree - level; ++j)
    {
      right.col(j) = 0.5 * (right.col(j) + right.col(j + 1));
    }
    left.col(level) = right.col(0);
  }
  const double middle = 0.5 * (part.lower + part.upper);
  return { { part_of(std::move(left), part.lower, middle),
    part_of(std::move(right), middle, part.upper) } };
}

bool are_apart(const ArcPart& a, const ArcPart& b)
{
  const Point2 chord_a = a.end() - a.start();
  const Point2 chord_b = b.end() - b.start();
  return are_apart(a, b, Point2(1, 0)) || are_apart(a, b, Point2(0, 1)) ||
    are_apart(a, b, Point2(-chord_a[1], chord_a[0])) ||
    are_apart(a, b, Point2(-chord_b[1], chord_b[0]));
}

bool only_join(const Eigen::Matrix2Xd& a, const Eigen::Matrix2Xd& b)
{
  // The angles of each from its first direction; monotone arcs span a quarter at most.
  const auto span = [](const Eigen::Matrix2Xd& points, std::array<Point2, 2>& ends)
  {
    bool found = false;
    for (Eigen::Index k = 1; k < points.cols(); ++k)
    {
      const Point2 to = points.col(k) - points.col(0);
      if (to.norm() <= kOnePlace)
      {
        continue;
      }
      const Point2 way = to.normalized();
      const auto turn = [&](const Point2& from) { return from[0] * way[1] - from[1] * way[0]; };
      ends[0] = !found || turn(ends[0]) < 0.0 ? way : ends[0];
      ends[1] = !found || turn(ends[1]) > 0.0 ? way : ends[1];
      found = true;
    }
    return found;
  };
  std::array<Point2, 2> of_a;
  std::array<Point2, 2> of_b;
  if (!span(a, of_a) || !span(b, of_b))
  {
    return false;
  }
  const Point2 middle_a = of_a[0] + of_a[1];
  const Point2 middle_b = of_b[0] + of_b[1];
  const auto angle = [](const Point2& p, const Point2& q)
  { return std::atan2(std::abs(p[0] * q[1] - p[1] * q[0]), p.dot(q)); };
  constexpr double kLeastAngle = 1e-6;
  return angle(middle_a, middle_b) >
    angle(middle_a, of_a[0]) + angle(middle_b, of_b[0]) + kLeastAngle;
}

Point2 point_at(const ArcPart& part, double t)
{
  Control points = part.control;
  for (Eigen::Index left = points.cols() - 1; left > 0; --left)
  {
    for (Eigen::Index k = 0; k < left; ++k)
    {
      points.col(k) = (1.0 - t) * points.col(k) + t * points.col(k + 1);
    }
  }
  return points.col(0).head<2>() / points(2, 0);
}

} // namespace footpoint
