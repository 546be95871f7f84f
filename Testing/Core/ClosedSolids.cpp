// SPDX-License-Identifier: BSD-3-Clause

#include "ClosedSolids.h"

#include <cmath>
#include <memory>

namespace solids
{

Face plane(const Vector3& o, const Vector3& a, const Vector3& b, const std::vector<TrimLoop>& loops,
  double low, double high)
{
  const std::vector<double> knots{ low, low, high, high };
  footpoint::Points points(3, 4);
  points.col(0) = o + low * a + low * b;
  points.col(1) = o + high * a + low * b;
  points.col(2) = o + low * a + high * b;
  points.col(3) = o + high * a + high * b;
  Face face;
  face.patches.push_back({ nullptr,
    std::make_shared<Surface>(
      footpoint::KnotVector(1, knots), footpoint::KnotVector(1, knots), points) });
  face.loops = loops;
  footpoint::trim(face);
  return face;
}

Face whole(const Surface& surface, bool reversed)
{
  Face face;
  face.patches.push_back({ nullptr, std::make_shared<Surface>(surface) });
  face.reversed = reversed;
  return face;
}

Model prism(const std::vector<Point2>& corners, double height)
{
  Model faces;
  const Vector3 x = Vector3::UnitX();
  const Vector3 y = Vector3::UnitY();
  const Vector3 z = Vector3::UnitZ();
  faces.push_back(plane(height * z, x, y, { trims::polygon(corners) }));
  std::vector<Point2> swapped;
  for (auto corner = corners.rbegin(); corner != corners.rend(); ++corner)
  {
    swapped.push_back({ corner->y(), corner->x() });
  }
  faces.push_back(plane(Vector3::Zero(), y, x, { trims::polygon(swapped) }));
  for (std::size_t k = 0; k < corners.size(); ++k)
  {
    const Point2& from = corners[k];
    const Point2 way = corners[(k + 1) % corners.size()] - from;
    faces.push_back(plane(Vector3(from.x(), from.y(), 0), Vector3(way.x(), way.y(), 0), z,
      { trims::rectangle(0, 0, 1, height) }));
  }
  return faces;
}

std::vector<Vector3> edges_of_prism(const std::vector<Point2>& corners, double height)
{
  std::vector<Vector3> targets;
  for (std::size_t k = 0; k < corners.size(); ++k)
  {
    const Point2& a = corners[k];
    const Point2 b = 0.3 * a + 0.7 * corners[(k + 1) % corners.size()];
    for (const double z : { 0.0, height })
    {
      targets.emplace_back(a.x(), a.y(), z);
      targets.emplace_back(b.x(), b.y(), z);
    }
    targets.emplace_back(a.x(), a.y(), 0.4 * height);
  }
  return targets;
}

Solid box(const char* name, double a, double b, double c)
{
  const std::vector<Point2> corners{ { 0, 0 }, { a, 0 }, { a, b }, { 0, b } };
  return { name, prism(corners, c),
    [=](const Vector3& p)
    { return p.x() > 0 && p.x() < a && p.y() > 0 && p.y() < b && p.z() > 0 && p.z() < c; },
    edges_of_prism(corners, c), Vector3(a, b, c).norm() };
}

Solid l_shape()
{
  const std::vector<Point2> corners{ { 0, 0 }, { 2, 0 }, { 2, 1 }, { 1, 1 }, { 1, 2 }, { 0, 2 } };
  return { "L-shape", prism(corners, 1.0),
    [](const Vector3& p)
    {
      return p.x() > 0 && p.y() > 0 && p.x() < 2 && p.y() < 2 && p.z() > 0 && p.z() < 1 &&
        (p.x() < 1 || p.y() < 1);
    },
    edges_of_prism(corners, 1.0), 3.0 };
}

Solid cylinder()
{
  Model faces{ whole(shapes::revolve({ 0, 0, 2, 2 }, 1,
                 shapes::points({ { 1, 0, 0 }, { 1, 0, 2 } }), Eigen::Vector2d(1, 1))),
    plane(Vector3(0, 0, 2), Vector3::UnitX(), Vector3::UnitY(), { trims::circle(0, 0, 1) }),
    plane(Vector3::Zero(), Vector3::UnitY(), Vector3::UnitX(), { trims::circle(0, 0, 1) }) };
  std::vector<Vector3> targets;
  for (const double angle : { 0.0, 0.3, 1.0, 2.5, 4.0 })
  {
    targets.emplace_back(std::cos(angle), std::sin(angle), 0.0);
    targets.emplace_back(std::cos(angle), std::sin(angle), 2.0);
  }
  targets.emplace_back(1, 0, 1); // the seam
  return { "cylinder", faces,
    [](const Vector3& p) { return p.head<2>().norm() < 1 && p.z() > 0 && p.z() < 2; }, targets,
    3.5 };
}

Solid cone()
{
  Model faces{ whole(shapes::revolve({ 0, 0, 1, 1 }, 1,
                 shapes::points({ { 1, 0, 0 }, { 0, 0, 1.5 } }), Eigen::Vector2d(1, 1))),
    plane(Vector3::Zero(), Vector3::UnitY(), Vector3::UnitX(), { trims::circle(0, 0, 1) }) };
  return { "cone", faces,
    [](const Vector3& p) { return p.z() > 0 && p.head<2>().norm() < 1 - p.z() / 1.5; },
    { { 0, 0, 1.5 }, { 1, 0, 0 }, { 0.6, 0.8, 0 }, { 0.5, 0, 0.75 }, { -1, 0, 0 } }, 3.0 };
}

Solid box_with_hole()
{
  const std::vector<Point2> corners{ { -2, -2 }, { 2, -2 }, { 2, 2 }, { -2, 2 } };
  Model faces = prism(corners, 1.0);
  for (int k = 0; k < 2; ++k)
  {
    faces[k].loops.push_back(trims::reversed(trims::circle(0, 0, 1)));
    footpoint::trim(faces[k]);
  }
  faces.push_back(whole(shapes::revolve({ 0, 0, 1, 1 }, 1,
                          shapes::points({ { 1, 0, 0 }, { 1, 0, 1 } }), Eigen::Vector2d(1, 1)),
    true));
  std::vector<Vector3> targets = edges_of_prism(corners, 1.0);
  for (const double angle : { 0.0, 0.7, 3.0, 5.0 })
  {
    targets.emplace_back(std::cos(angle), std::sin(angle), 0.0);
    targets.emplace_back(std::cos(angle), std::sin(angle), 1.0);
  }
  return { "box with a hole", faces,
    [](const Vector3& p)
    {
      return std::abs(p.x()) < 2 && std::abs(p.y()) < 2 && p.z() > 0 && p.z() < 1 &&
        p.head<2>().norm() > 1;
    },
    targets, 5.7 };
}

Solid sphere_octant()
{
  const auto quarter = [](const Vector3& a, const Vector3& b)
  {
    TrimLoop loop;
    const footpoint::Points arc = shapes::points({ { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } });
    Eigen::VectorXd weights(3);
    weights << 1, std::sqrt(0.5), 1;
    loop.curves = { trims::polyline({ { 0, 0 }, { 1, 0 } }),
      std::make_shared<footpoint::Curve>(
        footpoint::KnotVector(2, { 0, 0, 0, 1, 1, 1 }), arc, weights),
      trims::polyline({ { 0, 1 }, { 0, 0 } }) };
    return plane(Vector3::Zero(), a, b, { loop });
  };
  Eigen::VectorXd weights(3);
  weights << 1, std::sqrt(0.5), 1;
  const Vector3 x = Vector3::UnitX();
  const Vector3 y = Vector3::UnitY();
  const Vector3 z = Vector3::UnitZ();
  Model faces{ whole(shapes::revolve({ 0, 0, 0, 1, 1, 1 }, 2,
                 shapes::points({ { 1, 0, 0 }, { 1, 0, 1 }, { 0, 0, 1 } }), weights, 90.0, 1)),
    quarter(y, x), quarter(z, y), quarter(x, z) };
  const double s = std::sqrt(0.5);
  return { "sphere octant", faces,
    [](const Vector3& p) { return p.minCoeff() > 0 && p.norm() < 1; },
    { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { s, s, 0 }, { 0, s, s }, { s, 0, s },
      { 0.5, 0, 0 }, { 0, 0.3, 0 }, { 0, 0, 0.8 } },
    1.8 };
}

std::vector<Solid> all()
{
  return { box("box", 1, 2, 3), box("thin plate", 3, 2, 1e-3), l_shape(), cylinder(), cone(),
    box_with_hole(), sphere_octant() };
}

} // namespace solids
