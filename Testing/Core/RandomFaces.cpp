// SPDX-License-Identifier: BSD-3-Clause

#include "RandomFaces.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace trims
{

CurvePointer moved(const Surface& surface, const Curve& curve)
{
  Points points = curve.local_control_points().colwise() + curve.centre();
  for (int i = 0; i < 2; ++i)
  {
    const footpoint::Direction& direction = surface.direction(i);
    for (Eigen::Index k = 0; k < points.cols(); ++k)
    {
      points(i, k) = points(i, k) == 1.0 ? direction.origin + direction.length
                                         : direction.origin + direction.length * points(i, k);
    }
  }
  return std::make_shared<Curve>(curve.knots(), points, curve.weights());
}

TrimLoop moved(const Surface& surface, const TrimLoop& loop)
{
  TrimLoop result;
  for (const CurvePointer& curve : loop.curves)
  {
    result.curves.push_back(moved(surface, *curve));
  }
  return result;
}

TrimLoop wave(double u, double v, double radius, int waves, double depth)
{
  const int count = 8 * waves;
  Points points = Points::Zero(3, count + 3);
  for (int k = 0; k < count + 3; ++k)
  {
    const double angle = 2.0 * std::acos(-1.0) * k / count;
    const double r = radius * (1.0 + depth * std::cos(waves * angle));
    points.col(k).head<2>() << u + r * std::cos(angle), v + r * std::sin(angle);
  }
  TrimLoop loop;
  loop.curves.push_back(
    std::make_shared<Curve>(KnotVector(3, shapes::uniform_knots(3, count)), points));
  return loop;
}

RandomFaces::RandomFaces(std::uint64_t seed)
  : Random(seed)
{
}

footpoint::Face RandomFaces::face(std::string& name)
{
  const Kind kind = static_cast<Kind>(this->Random.integer(0, 4));
  const auto surface = std::make_shared<Surface>(this->surface(kind, name));
  footpoint::Face face;
  face.patches.push_back({ nullptr, surface });
  for (const TrimLoop& loop : this->loops(kind, name))
  {
    face.loops.push_back(moved(*surface, loop));
  }
  footpoint::trim(face);
  return face;
}

Surface RandomFaces::surface(Kind kind, std::string& name)
{
  const int degrees[2] = { this->Random.integer(1, 6), this->Random.integer(1, 6) };
  const int spans[2] = { this->Random.integer(1, 5), this->Random.integer(1, 5) };
  int count[2] = { degrees[0] + spans[0], degrees[1] + spans[1] };
  if (kind == Kind::Closed)
  {
    count[0] = std::max(count[0], 5);
  }
  const double height = this->Random.uniform(0.0, 0.6);
  Points net(3, count[0] * count[1]);
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(net.cols());
  const double pi = std::acos(-1.0);
  for (int j = 0; j < count[1]; ++j)
  {
    for (int i = 0; i < count[0]; ++i)
    {
      const int at = j * count[0] + i;
      const double u = i / (count[0] - 1.0);
      const double v = j / (count[1] - 1.0);
      const double jitter = 0.3;
      Vector3 point(u + jitter / count[0] * this->Random.uniform(-1, 1),
        v + jitter / count[1] * this->Random.uniform(-1, 1), height * this->Random.uniform(-1, 1));
      if (kind == Kind::Closed)
      {
        const double radius = 0.4 + 0.3 * height * this->Random.uniform(-1, 1);
        point = Vector3(radius * std::cos(2 * pi * u), radius * std::sin(2 * pi * u), v);
      }
      if (kind == Kind::Pole)
      {
        point = j == 0 ? Vector3(0.5, 0, 0) : point;
      }
      if (kind == Kind::Stretched)
      {
        point = Vector3(100.0, 1.0, 1.0).cwiseProduct(point);
      }
      net.col(at) = point;
      if (kind == Kind::Rational)
      {
        weights[at] = this->Random.magnitude(1.0);
      }
    }
    if (kind == Kind::Closed)
    {
      net.col(j * count[0] + count[0] - 1) = net.col(j * count[0]);
    }
  }
  const double start = kind == Kind::Stretched ? 1000.0 : 0.0;
  name = "surface of kind " + std::to_string(static_cast<int>(kind)) + ", degrees " +
    std::to_string(degrees[0]) + " " + std::to_string(degrees[1]);
  return Surface(KnotVector(degrees[0],
                   shapes::clamped_knots(degrees[0], count[0] - degrees[0], start, start + 3)),
    KnotVector(degrees[1], shapes::clamped_knots(degrees[1], count[1] - degrees[1])), net, weights);
}

TrimLoop RandomFaces::star(double u, double v, double radius)
{
  std::vector<Point2> corners;
  const int count = this->Random.integer(3, 12);
  for (int k = 0; k < count; ++k)
  {
    const double angle = 2.0 * std::acos(-1.0) * (k + this->any(0, 0.8)) / count;
    const double r = radius * this->any(0.4, 1.0);
    corners.push_back({ u + r * std::cos(angle), v + r * std::sin(angle) });
  }
  return polygon(corners);
}

std::vector<TrimLoop> RandomFaces::loops(Kind kind, std::string& name)
{
  const int choice = this->Random.integer(0, kind == Kind::Closed ? 8 : 7);
  name += ", loops of kind " + std::to_string(choice);
  const TrimLoop all = rectangle(0, 0, 1, 1);
  const double u = this->any(0.4, 0.6);
  const double v = this->any(0.4, 0.6);
  switch (choice)
  {
    case 0:
      return { wave(u, v, this->any(0.1, 0.3), this->Random.integer(1, 8), this->any(0, 0.3)) };
    case 1:
      return { this->star(u, v, 0.4) };
    case 2: // a hole
      return { all, reversed(wave(u, v, this->any(0.05, 0.3), this->Random.integer(1, 5), 0.2)) };
    case 3: // islands in holes
      return { all, reversed(circle(u, v, 0.3)), circle(u, v, 0.2), reversed(circle(u, v, 0.1)),
        circle(u, v, this->any(0.01, 0.08)) };
    case 4: // a hole that touches the border of the domain, and one that touches it
      return { all, reversed(circle(0.25, v, 0.25)), reversed(circle(0.625, v, 0.125)) };
    case 5: // a gap that is closed
    {
      TrimLoop loop = this->star(u, v, 0.4);
      const Points points =
        loop.curves[0]->local_control_points().colwise() + loop.curves[0]->centre();
      loop.curves[0] = polyline({ points.col(0).head<2>(),
        Point2(points.col(1).head<2>()) + Point2(this->any(-1, 1), this->any(-1, 1)) * 1e-5 });
      return { loop };
    }
    case 6: // many holes
    {
      std::vector<TrimLoop> result{ rectangle(0.05, 0.03, 0.98, 0.9) };
      for (int k = 0; k < 9; ++k)
      {
        result.push_back(
          reversed(circle(0.2 + 0.3 * (k % 3), 0.2 + 0.25 * (k / 3), this->any(0.01, 0.1))));
      }
      return result;
    }
    case 7: // a strip
    {
      const double low = this->any(0.1, 0.9);
      return { rectangle(0.02, low, 0.9, low + std::pow(10.0, this->any(-5, -1.5))) };
    }
    default: // a hole over the seam, cut by it
    {
      const double r = this->any(0.05, 0.3);
      return { polygon({ { 0, 0 }, { 1, 0 }, { 1, v - r }, { 1 - r, v }, { 1, v + r }, { 1, 1 },
        { 0, 1 }, { 0, v + r }, { r, v }, { 0, v - r } }) };
    }
  }
}

} // namespace trims
