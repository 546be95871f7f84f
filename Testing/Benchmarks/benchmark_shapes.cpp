// SPDX-License-Identifier: BSD-3-Clause
#include "benchmark_shapes.h"

#include <cmath>

namespace inversion_benchmark
{
namespace
{

using footpoint::Curve;
using footpoint::KnotVector;
using footpoint::Surface;
using shapes::clamped_knots;

const double kPi = std::acos(-1.0);

Shape surface_shape(const std::string& name, Surface surface, Family family = Family::Low,
  std::function<Vector3(Random&)> centre = {})
{
  Shape shape;
  shape.name = name;
  shape.family = family;
  shape.surface = std::make_shared<Surface>(std::move(surface));
  shape.centre = std::move(centre);
  return shape;
}

/// A clamped net whose control point (i, j) stands at place(i / (nu − 1), j / (nv − 1)).
template <class Place>
Points net_of(int nu, int nv, const Place& place)
{
  Points net(3, nu * nv);
  for (int j = 0; j < nv; ++j)
  {
    for (int i = 0; i < nu; ++i)
    {
      net.col(j * nu + i) = place(i / (nu - 1.0), j / (nv - 1.0));
    }
  }
  return net;
}

template <class Place>
Surface clamped(int degree_u, int degree_v, int nu, int nv, const Place& place,
  const Eigen::VectorXd& weights = {})
{
  return Surface(KnotVector(degree_u, clamped_knots(degree_u, nu - degree_u), "KnotsU"),
    KnotVector(degree_v, clamped_knots(degree_v, nv - degree_v), "KnotsV"), net_of(nu, nv, place),
    weights);
}

/// Random heights over the unit square.
auto bumps(Random& random, double height)
{
  return [&random, height](double x, double y)
  { return Vector3(x, y, random.uniform(-height, height)); };
}

/// Bicubic with C1 (multiplicity 2) and C0 (multiplicity 3) lines, by turns, in both directions.
Surface creased()
{
  std::vector<double> knots(4, 0.0);
  const int spans = 12;
  for (int k = 1; k < spans; ++k)
  {
    knots.insert(knots.end(), 1 + k % 3, static_cast<double>(k) / spans);
  }
  knots.insert(knots.end(), 4, 1.0);
  const int n = static_cast<int>(knots.size()) - 4;
  Random random(11);
  return Surface(KnotVector(3, knots, "KnotsU"), KnotVector(3, knots, "KnotsV"),
    net_of(n, n, bumps(random, 0.03)));
}

Eigen::VectorXd random_weights(Random& random, int count, double decades)
{
  return Eigen::VectorXd::NullaryExpr(count, [&]() { return random.magnitude(decades); });
}

Surface weighted(int n, std::uint64_t seed, double decades)
{
  Random random(seed);
  const Eigen::VectorXd weights = random_weights(random, n * n, decades);
  return clamped(3, 3, n, n, bumps(random, 1.0 / n), weights);
}

/// A half hull, bow at x = 1: sections round to the keel, finer towards the bow, 20 x 12.
Surface hull()
{
  return clamped(3, 3, 20, 12,
    [](double u, double v)
    {
      const double breadth = 0.15 * (1.0 - std::pow(u, 3)) * (0.6 + 0.4 * std::sqrt(u + 0.05));
      const double angle = 0.5 * kPi * v;
      const double fullness = 0.4 + 0.6 * std::sin(kPi * std::min(1.0, 0.2 + u));
      return Vector3(u + 0.05 * v * u * u, breadth * std::pow(std::sin(angle), fullness),
        -0.12 * std::cos(angle) * (1.0 - 0.3 * std::pow(u, 6)));
    });
}

/// Folded back on itself three times, the layers close together.
Surface folded()
{
  return clamped(3, 3, 40, 12,
    [](double u, double v)
    {
      const double way = 6.0 * kPi * u;
      return Vector3(0.5 * std::sin(way), v, 0.25 * u + 0.02 * std::cos(way));
    });
}

/// Two hundred times as long as it is wide, slightly twisted.
Surface strip()
{
  return clamped(3, 3, 60, 4,
    [](double u, double v)
    {
      const double twist = 2.0 * kPi * u;
      const double across = (v - 0.5) / 200.0;
      return Vector3(u, across * std::cos(twist), across * std::sin(twist) + 0.02 * u * (1.0 - u));
    });
}

/// A closed tube along a wave: the seam in u closes with a corner of tangents only to rounding.
Surface wavy_tube()
{
  const int around = 24;
  std::vector<double> knots_u = shapes::uniform_knots(3, around);
  const int nv = 40;
  Points net(3, (around + 3) * nv);
  for (int j = 0; j < nv; ++j)
  {
    for (int i = 0; i < around + 3; ++i)
    {
      const double angle = 2.0 * kPi * (i % around) / around;
      const double along = j / (nv - 1.0);
      const double radius = 0.1 * (1.0 + 0.3 * std::sin(15.0 * along + 2.0 * angle));
      net.col(j * (around + 3) + i) = Vector3(
        along, radius * std::cos(angle), radius * std::sin(angle) + 0.1 * std::sin(6.0 * along));
    }
  }
  return Surface(
    KnotVector(3, knots_u, "KnotsU"), KnotVector(3, clamped_knots(3, nv - 3), "KnotsV"), net);
}

/// A quarter of the sphere's meridian, from the equator to the north pole: a half sphere.
Surface cap()
{
  const double half = std::sqrt(0.5);
  return shapes::revolve({ 0, 0, 0, 90, 90, 90 }, 2,
    shapes::points({ { 1, 0, 0 }, { 1, 0, 1 }, { 0, 0, 1 } }), Eigen::Vector3d(1, half, 1));
}

Surface cone()
{
  return shapes::revolve(
    { 0, 0, 1, 1 }, 1, shapes::points({ { 0, 0, 2 }, { 1, 0, 0 } }), Eigen::Vector2d(1, 1));
}

Surface disk()
{
  return shapes::revolve(
    { 0, 0, 1, 1 }, 1, shapes::points({ { 0, 0, 0 }, { 1, 0, 0 } }), Eigen::Vector2d(1, 1));
}

// === Distances in closed form, of those shapes that have one

using Real = long double;

Real to_sphere(const Vector3& p)
{
  return std::abs(p.cast<Real>().norm() - 1);
}

Real to_cap(const Vector3& p)
{
  const Real around = std::hypot<Real>(p.x(), p.y());
  return p.z() >= 0 ? to_sphere(p) : std::hypot<Real>(around - 1, p.z());
}

Real to_torus(const Vector3& p)
{
  const Real around = std::hypot<Real>(p.x(), p.y());
  return std::abs(std::hypot<Real>(around - 3, p.z()) - 1);
}

Real to_disk(const Vector3& p)
{
  return std::hypot<Real>(std::max<Real>(std::hypot<Real>(p.x(), p.y()) - 1, 0), p.z());
}

/// Three quarters of a cylinder of radius 10, open where x > 0 > y.
Real to_cylinder(const Vector3& p)
{
  const Real x = p.x();
  const Real y = p.y();
  const Real above = std::max<Real>(std::abs(static_cast<Real>(p.z())) - 10, 0);
  const Real across = x > 0 && y < 0 ? std::min(std::hypot(x - 10, y), std::hypot(x, y + 10))
                                     : std::abs(std::hypot(x, y) - 10);
  return std::hypot(across, above);
}

Real to_plane(const Vector3& p)
{
  const auto beyond = [](Real at) { return std::max<Real>(std::max<Real>(-at, at - 10), 0); };
  return std::hypot(static_cast<Real>(p.x()), std::hypot(beyond(p.y()), beyond(p.z())));
}

/// A random walk in space that stays smooth: cubic, `poles` control points.
Shape wandering_curve(const std::string& name, int poles, double decades)
{
  Random random(31);
  Points net(3, poles);
  Vector3 at = Vector3::Zero();
  Vector3 way = Vector3::UnitX();
  for (int i = 0; i < poles; ++i)
  {
    net.col(i) = at;
    way = (way + random.vector(-0.5, 0.5)).normalized();
    at += 0.05 * way;
  }
  Shape shape;
  shape.name = name;
  shape.family = Family::Other;
  shape.curve = std::make_shared<Curve>(KnotVector(3, clamped_knots(3, poles - 3), "KnotsU"), net,
    decades > 0.0 ? random_weights(random, poles, decades) : Eigen::VectorXd());
  return shape;
}

Points model_points(const footpoint::Surface& s)
{
  return s.local_control_points().colwise() + s.centre();
}

} // namespace

double Shape::size() const
{
  return this->surface ? this->surface->size() : this->curve->size();
}

Points Shape::control_points() const
{
  return this->surface
    ? model_points(*this->surface)
    : Points(this->curve->local_control_points().colwise() + this->curve->centre());
}

std::size_t Shape::pieces() const
{
  const auto spans = [](const KnotVector& knots) { return knots.distinct_knots().size() - 1; };
  return this->surface ? spans(this->surface->knots(0)) * spans(this->surface->knots(1))
                       : spans(this->curve->knots());
}

Shape bumpy_sheet(int n)
{
  return surface_shape("bumpy" + std::to_string(n), shapes::bumpy(n, 1));
}

std::vector<Shape> all_shapes()
{
  const auto on_axis = [](double reach)
  { return [reach](Random& random) { return Vector3(0, 0, random.uniform(-reach, reach)); }; };
  const auto origin = [](Random&) { return Vector3(Vector3::Zero()); };
  const auto torus_centres = [](Random& random)
  {
    const double angle = random.uniform(0.0, 2.0 * kPi);
    return random.integer(0, 1) == 0 ? Vector3(3.0 * std::cos(angle), 3.0 * std::sin(angle), 0.0)
                                     : Vector3(0.0, 0.0, random.uniform(-2.0, 2.0));
  };
  Random random(5);
  std::vector<Shape> all;
  const auto add = [&all](Shape shape, std::function<Real(const Vector3&)> distance)
  {
    shape.distance = std::move(distance);
    all.push_back(std::move(shape));
  };
  all.push_back(bumpy_sheet(40));
  all.push_back(bumpy_sheet(8));
  all.push_back(bumpy_sheet(200));
  all.push_back(surface_shape("creased", creased()));
  all.push_back(surface_shape("degree2x3", clamped(2, 3, 16, 12, bumps(random, 0.1))));
  all.push_back(
    surface_shape("degree5x5", clamped(5, 5, 12, 12, bumps(random, 0.1)), Family::High));
  all.push_back(
    surface_shape("degree7x7", clamped(7, 7, 14, 14, bumps(random, 0.1)), Family::High));
  add(surface_shape("sphere", shapes::sphere(), Family::Low, origin), to_sphere);
  add(surface_shape("torus", shapes::torus(), Family::Low, torus_centres), to_torus);
  add(surface_shape("cylinder", shapes::cylinder(), Family::Low, on_axis(10.0)), to_cylinder);
  all.push_back(surface_shape("cone", cone(), Family::Low, on_axis(1.0)));
  add(surface_shape("cap", cap(), Family::Low, origin), to_cap);
  add(surface_shape("disk", disk()), to_disk);
  all.push_back(surface_shape("rational20", weighted(20, 21, 0.3)));
  all.push_back(surface_shape("weights", weighted(10, 22, 2.0)));
  all.push_back(surface_shape("hull", hull()));
  all.push_back(surface_shape("folded", folded()));
  all.push_back(surface_shape("strip", strip()));
  all.push_back(surface_shape("saddle", shapes::saddle()));
  all.push_back(surface_shape("tube", wavy_tube()));
  add(surface_shape("plane", shapes::square()), to_plane);
  all.push_back(surface_shape("triangle", shapes::triangle()));
  all.push_back(surface_shape("helicoid", shapes::helical_ribbon()));
  all.push_back(surface_shape("cusp", shapes::cusp()));
  all.push_back(wandering_curve("curve200", 200, 0.0));
  all.push_back(wandering_curve("curve200weights", 200, 0.5));
  return all;
}

} // namespace inversion_benchmark
