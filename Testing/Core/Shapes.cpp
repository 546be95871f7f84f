// SPDX-License-Identifier: BSD-3-Clause

#include "Shapes.h"

#include <cmath>
#include <utility>

namespace shapes
{

Random::Random(std::uint64_t seed)
  : Engine(seed)
{
}

double Random::uniform(double low, double high)
{
  return low + (high - low) * static_cast<double>(this->Engine() >> 11) * 0x1p-53;
}

int Random::integer(int low, int high)
{
  return low + static_cast<int>(this->Engine() % static_cast<std::uint64_t>(high - low + 1));
}

Vector3 Random::vector(double low, double high)
{
  const double x = this->uniform(low, high);
  const double y = this->uniform(low, high);
  return { x, y, this->uniform(low, high) };
}

// === Building blocks

double Random::magnitude(double decades)
{
  return std::pow(10.0, this->uniform(-decades, decades));
}

Points points(std::initializer_list<Vector3> columns)
{
  Points all(3, static_cast<Eigen::Index>(columns.size()));
  Eigen::Index i = 0;
  for (const Vector3& column : columns)
  {
    all.col(i++) = column;
  }
  return all;
}

std::vector<double> clamped_knots(int degree, int spans, double start, double end)
{
  std::vector<double> knots(degree + 1, start);
  for (int i = 1; i < spans; ++i)
  {
    knots.push_back(start + (end - start) * i / spans);
  }
  knots.insert(knots.end(), degree + 1, end);
  return knots;
}

std::vector<double> uniform_knots(int degree, int spans)
{
  std::vector<double> knots;
  for (int i = -degree; i <= spans + degree; ++i)
  {
    knots.push_back(i);
  }
  return knots;
}

std::vector<double> random_knots(Random& random, int degree, int spans, bool clamped)
{
  std::vector<double> knots;
  const auto step = [&](double low, double high)
  { return std::round(random.uniform(low, high) * 0x1p20) * 0x1p-20; };
  double at = step(-1.0, 1.0);
  const auto outside = [&](int count)
  {
    for (int i = 0; i < count; ++i)
    {
      at += i % 3 == 2 ? 0.0 : step(0.1, 1.0);
      knots.push_back(at);
    }
  };
  const int before = clamped ? 0 : random.integer(1, degree);
  const int after = clamped ? 0 : random.integer(1, degree);
  outside(before);
  for (int i = 0; i <= spans; ++i)
  {
    const int most = random.integer(0, 2) == 0 ? degree + 1 : 1;
    const int inside = random.integer(1, most);
    at += step(0.2, 1.0);
    const int multiplicity = i == 0 ? degree + 1 - before
      : i == spans                  ? degree + 1 - after
                                    : inside;
    knots.insert(knots.end(), multiplicity, at);
  }
  at += 0.125;
  outside(after);
  return knots;
}

Arcs unit_arcs(double degrees, int arcs)
{
  const double half = degrees / arcs / 2.0; // in degrees
  const double radian = std::acos(-1.0) / 180.0;
  Arcs all{ {}, Points(3, 2 * arcs + 1), Eigen::VectorXd(2 * arcs + 1) };
  for (int i = 0; i <= 2 * arcs; ++i)
  {
    const bool corner = i % 2 == 1;
    const double angle = std::fmod(i * half, 360.0);  // full circles close exactly
    const bool right = std::fmod(angle, 90.0) == 0.0; // no 6e-17 where a 0 is meant
    const Vector3 unit(std::cos(angle * radian), std::sin(angle * radian), 0.0);
    const double weight = std::cos(half * radian);
    all.points.col(i) = right ? Vector3(unit.array().round()) : unit;
    all.points.col(i) *= corner ? 1.0 / weight : 1.0;
    all.weights[i] = corner ? weight : 1.0;
  }
  for (int i = 0; i <= arcs; ++i)
  {
    all.knots.insert(all.knots.end(), i == 0 || i == arcs ? 3 : 2, degrees * i / arcs);
  }
  return all;
}

Curve polynomial_curve(int degree, std::vector<double> knots, const Points& net)
{
  return Curve(KnotVector(degree, std::move(knots), "KnotsU"), net);
}

// === Curves

Curve parabola()
{
  return polynomial_curve(
    2, { -1, -1, -1, 1, 1, 1 }, points({ { -1, 1, 0 }, { 0, -1, 0 }, { 1, 1, 0 } }));
}

Curve tent()
{
  return polynomial_curve(1, { 0, 0, 1, 2, 2 }, points({ { 0, 0, 0 }, { 1, 1, 0 }, { 2, 0, 0 } }));
}

Curve closed_with_corner()
{
  return polynomial_curve(
    3, { 0, 0, 0, 0, 1, 1, 1, 1 }, points({ { 0, 0, 0 }, { 4, 3, 0 }, { -4, 3, 0 }, { 0, 0, 0 } }));
}

Curve stalled_line()
{
  return polynomial_curve(
    3, { 0, 0, 0, 0, 1, 1, 1, 1 }, points({ { 0, 0, 0 }, { 0, 0, 0 }, { 0, 0, 0 }, { 1, 0, 0 } }));
}

Curve circle(double radius, const Vector3& centre)
{
  const Arcs arcs = unit_arcs(360.0, 4);
  return Curve(KnotVector(2, arcs.knots, "KnotsU"),
    Points((radius * arcs.points).colwise() + centre), arcs.weights);
}

Curve line_with_gap()
{
  return polynomial_curve(
    1, { 0, 0, 1, 1, 2, 2 }, points({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 2, 1, 0 } }));
}

Curve periodic(int n)
{
  Points net(3, n + 3);
  for (int i = 0; i < n + 3; ++i)
  {
    const double angle = 2.0 * std::acos(-1.0) * (i % n) / n;
    net.col(i) = Vector3(std::cos(angle), std::sin(angle), 0.0);
  }
  return polynomial_curve(3, uniform_knots(3, n), net);
}

Curve open_with_matching_poles()
{
  return polynomial_curve(2, uniform_knots(2, 3),
    points({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 0, 0, 0 } }));
}

// === Surfaces

Surface revolve(const std::vector<double>& knots_v, int degree_v, const Points& profile,
  const Eigen::VectorXd& weights, double degrees, int arcs)
{
  const Arcs turn = unit_arcs(degrees, arcs);
  const Eigen::Index nu = turn.points.cols();
  Points net(3, nu * profile.cols());
  Eigen::VectorXd all(net.cols());
  for (Eigen::Index j = 0; j < profile.cols(); ++j)
  {
    for (Eigen::Index i = 0; i < nu; ++i)
    {
      net.col(j * nu + i) = Vector3(
        profile(0, j) * turn.points(0, i), profile(0, j) * turn.points(1, i), profile(2, j));
      all[j * nu + i] = turn.weights[i] * weights[j];
    }
  }
  return Surface(
    KnotVector(2, turn.knots, "KnotsU"), KnotVector(degree_v, knots_v, "KnotsV"), net, all);
}

Surface saddle()
{
  return Surface(KnotVector(1, { -1, -1, 1, 1 }, "KnotsU"),
    KnotVector(1, { -1, -1, 1, 1 }, "KnotsV"),
    points({ { -1, -1, 1 }, { 1, -1, -1 }, { -1, 1, -1 }, { 1, 1, 1 } }));
}

Surface cylinder(double radius, double degrees, int arcs)
{
  return revolve({ -10, -10, 10, 10 }, 1, points({ { radius, 0, -10 }, { radius, 0, 10 } }),
    Eigen::Vector2d(1, 1), degrees, arcs);
}

Surface square()
{
  return Surface(KnotVector(1, { 0, 0, 10, 10 }, "KnotsU"),
    KnotVector(1, { 0, 0, 10, 10 }, "KnotsV"),
    points({ { 0, 0, 0 }, { 0, 10, 0 }, { 0, 0, 10 }, { 0, 10, 10 } }));
}

Surface triangle()
{
  return Surface(KnotVector(1, { 0, 0, 1, 1 }, "KnotsU"), KnotVector(1, { 0, 0, 1, 1 }, "KnotsV"),
    points({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 0, 0 }, { 0, 1, 0 } }));
}

Surface sphere(double radius)
{
  const double half = std::sqrt(0.5);
  Eigen::VectorXd weights(5);
  weights << 1, half, 1, half, 1;
  return revolve({ -90, -90, -90, 0, 0, 90, 90, 90 }, 2,
    radius * points({ { 0, 0, -1 }, { 1, 0, -1 }, { 1, 0, 0 }, { 1, 0, 1 }, { 0, 0, 1 } }),
    weights);
}

Surface torus(double major, double minor)
{
  const Arcs tube = unit_arcs(360.0, 4);
  Points profile(3, tube.points.cols());
  profile.row(0) = (minor * tube.points.row(0)).array() + major;
  profile.row(1).setZero();
  profile.row(2) = minor * tube.points.row(1);
  return revolve(tube.knots, 2, profile, tube.weights);
}

Surface cusp()
{
  // Blossoms of t² and t³ on [−1, 1].
  Points net(3, 8);
  const double third = 1.0 / 3.0;
  for (int j = 0; j < 2; ++j)
  {
    net.col(4 * j + 0) = Vector3(1, -1, j);
    net.col(4 * j + 1) = Vector3(-third, 1, j);
    net.col(4 * j + 2) = Vector3(-third, -1, j);
    net.col(4 * j + 3) = Vector3(1, 1, j);
  }
  return Surface(KnotVector(3, { -1, -1, -1, -1, 1, 1, 1, 1 }, "KnotsU"),
    KnotVector(1, { 0, 0, 1, 1 }, "KnotsV"), net);
}

Surface helical_ribbon(int turns, double pitch)
{
  const int spans = 64;
  const double step = 2.0 * std::acos(-1.0) / spans;
  const double shrink = 3.0 / (2.0 + std::cos(step)); // knots: (P₋ + 4P + P₊) / 6
  const int nu = spans * turns + 3;
  Points net(3, 2 * nu);
  for (int j = 0; j < 2; ++j)
  {
    for (int i = 0; i < nu; ++i)
    {
      const double radius = (0.5 + 0.5 * j) * shrink;
      const int phase = (i - 1 + spans) % spans;
      net.col(j * nu + i) = Vector3(
        radius * std::cos(phase * step), radius * std::sin(phase * step), pitch * (i - 1) / spans);
    }
  }
  std::vector<double> knots;
  for (int i = -3; i <= spans * turns + 3; ++i)
  {
    knots.push_back(static_cast<double>(i) / spans);
  }
  return Surface(KnotVector(3, knots, "KnotsU"), KnotVector(1, { 0, 0, 1, 1 }, "KnotsV"), net);
}

Surface bumpy(int n, std::uint64_t seed, double height)
{
  Random random(seed);
  height = height < 0.0 ? 1.0 / n : height;
  const std::vector<double> knots = clamped_knots(3, n - 3);
  Points net(3, n * n);
  for (int j = 0; j < n; ++j)
  {
    for (int i = 0; i < n; ++i)
    {
      net.col(j * n + i) = Vector3(i / (n - 1.0), j / (n - 1.0), random.uniform(-height, height));
    }
  }
  return Surface(KnotVector(3, knots, "KnotsU"), KnotVector(3, knots, "KnotsV"), net);
}

// === Random geometry with the arrays it was made of

template <int N>
std::conditional_t<N == 1, Curve, Surface> Arrays<N>::geometry() const
{
  if constexpr (N == 1)
  {
    return Curve(KnotVector(degrees[0], knots[0], "KnotsU"), points, weights);
  }
  else
  {
    return Surface(KnotVector(degrees[0], knots[0], "KnotsU"),
      KnotVector(degrees[1], knots[1], "KnotsV"), points, weights);
  }
}

template <int N>
Arrays<N> random_arrays(
  Random& random, const std::array<int, N>& degrees, int spans, bool clamped, double decades)
{
  Arrays<N> arrays;
  arrays.degrees = degrees;
  Eigen::Index count = 1;
  for (int i = 0; i < N; ++i)
  {
    arrays.knots[i] = random_knots(random, degrees[i], spans, clamped);
    count *= static_cast<Eigen::Index>(arrays.knots[i].size()) - degrees[i] - 1;
  }
  arrays.points.resize(3, count);
  arrays.weights.resize(decades > 0.0 ? count : 0);
  for (Eigen::Index i = 0; i < count; ++i)
  {
    arrays.points.col(i) = random.vector(-1.0, 1.0);
    if (decades > 0.0)
    {
      arrays.weights[i] = random.magnitude(decades);
    }
  }
  return arrays;
}

template Curve Arrays<1>::geometry() const;
template Surface Arrays<2>::geometry() const;
template Arrays<1> random_arrays<1>(Random&, const std::array<int, 1>&, int, bool, double);
template Arrays<2> random_arrays<2>(Random&, const std::array<int, 2>&, int, bool, double);

} // namespace shapes
