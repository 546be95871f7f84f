// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Named geometries that several tests use; closed forms stand in the comments. Letters with a
/// number (C1, S5, …) are those of the table of hard cases.

#include "OracleNearest.h"

#include "footpoint/splines/curve.h"
#include "footpoint/splines/surface.h"

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <random>
#include <vector>

namespace shapes
{

using footpoint::Curve;
using footpoint::KnotVector;
using footpoint::Points;
using footpoint::Surface;
using footpoint::Vector3;

// === Building blocks

/// Random numbers that are the same on every platform.
class Random
{
public:
  explicit Random(std::uint64_t seed)
    : Engine(seed)
  {
  }
  double uniform(double low, double high)
  {
    return low + (high - low) * static_cast<double>(this->Engine() >> 11) * 0x1p-53;
  }
  int integer(int low, int high)
  {
    return low + static_cast<int>(this->Engine() % static_cast<std::uint64_t>(high - low + 1));
  }
  Vector3 vector(double low, double high)
  {
    const double x = this->uniform(low, high);
    const double y = this->uniform(low, high);
    return { x, y, this->uniform(low, high) };
  }
  /// 10^x with x uniform in [−decades, decades].
  double magnitude(double decades) { return std::pow(10.0, this->uniform(-decades, decades)); }

private:
  std::mt19937_64 Engine;
};

inline Points points(std::initializer_list<Vector3> columns)
{
  Points all(3, static_cast<Eigen::Index>(columns.size()));
  Eigen::Index i = 0;
  for (const Vector3& column : columns)
  {
    all.col(i++) = column;
  }
  return all;
}

/// Clamped on [start, end] with equal spans.
inline std::vector<double> clamped_knots(
  int degree, int spans, double start = 0.0, double end = 1.0)
{
  std::vector<double> knots(degree + 1, start);
  for (int i = 1; i < spans; ++i)
  {
    knots.push_back(start + (end - start) * i / spans);
  }
  knots.insert(knots.end(), degree + 1, end);
  return knots;
}

/// Equally spaced without repetition: domain [0, spans].
inline std::vector<double> uniform_knots(int degree, int spans)
{
  std::vector<double> knots;
  for (int i = -degree; i <= spans + degree; ++i)
  {
    knots.push_back(i);
  }
  return knots;
}

/// Random spans, repetitions up to degree + 1 inside; the ends are clamped, or have some (perhaps
/// repeated) knots outside the domain. Multiples of 2^−20, so that differences of knots are exact.
inline std::vector<double> random_knots(Random& random, int degree, int spans, bool clamped)
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

/// A full or partial circle of unit radius as rational quadratic arcs of equal angle.
struct Arcs
{
  std::vector<double> knots; ///< the domain is [0, angle in degrees]
  Points points;             ///< in the plane z = 0, from (1, 0, 0) counter-clockwise
  Eigen::VectorXd weights;
};

inline Arcs unit_arcs(double degrees, int arcs)
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

inline Curve polynomial_curve(int degree, std::vector<double> knots, const Points& net)
{
  return Curve(KnotVector(degree, std::move(knots), "KnotsU"), net);
}

// === Curves

/// C1, C2: (t, t²) for t in [−1, 1]; local parameter t + 1.
inline Curve parabola()
{
  return polynomial_curve(
    2, { -1, -1, -1, 1, 1, 1 }, points({ { -1, 1, 0 }, { 0, -1, 0 }, { 1, 1, 0 } }));
}

/// C3: degree 1 through (0,0), (1,1), (2,0), knots 0, 1, 2.
inline Curve tent()
{
  return polynomial_curve(1, { 0, 0, 1, 2, 2 }, points({ { 0, 0, 0 }, { 1, 1, 0 }, { 2, 0, 0 } }));
}

/// C4: a closed cubic Bézier curve whose seam (0,0) is a corner.
inline Curve closed_with_corner()
{
  return polynomial_curve(
    3, { 0, 0, 0, 0, 1, 1, 1, 1 }, points({ { 0, 0, 0 }, { 4, 3, 0 }, { -4, 3, 0 }, { 0, 0, 0 } }));
}

/// C5: (t³, 0).
inline Curve stalled_line()
{
  return polynomial_curve(
    3, { 0, 0, 0, 0, 1, 1, 1, 1 }, points({ { 0, 0, 0 }, { 0, 0, 0 }, { 0, 0, 0 }, { 1, 0, 0 } }));
}

/// C6, C7: a rational circle in the plane z = centre.z, domain [0, 360] (not proportional to the
/// angle inside the four arcs).
inline Curve circle(double radius = 10.0, const Vector3& centre = Vector3::Zero())
{
  const Arcs arcs = unit_arcs(360.0, 4);
  return Curve(KnotVector(2, arcs.knots, "KnotsU"),
    Points((radius * arcs.points).colwise() + centre), arcs.weights);
}

/// C8: the line (t, 0) on [0, 1] and, after a gap, (t, 1) on [1, 2].
inline Curve line_with_gap()
{
  return polynomial_curve(
    1, { 0, 0, 1, 1, 2, 2 }, points({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 2, 1, 0 } }));
}

/// C9: closed and smooth, a cubic stored unclamped over `n` poles (n + 3 with the repeated ones) on
/// the circle of radius 1; the first and last poles differ.
inline Curve periodic(int n = 8)
{
  Points net(3, n + 3);
  for (int i = 0; i < n + 3; ++i)
  {
    const double angle = 2.0 * std::acos(-1.0) * (i % n) / n;
    net.col(i) = Vector3(std::cos(angle), std::sin(angle), 0.0);
  }
  return polynomial_curve(3, uniform_knots(3, n), net);
}

/// C9: unclamped; first and last pole are the same, the curve is open all the same.
inline Curve open_with_matching_poles()
{
  return polynomial_curve(2, uniform_knots(2, 3),
    points({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 0, 0, 0 } }));
}

// === Surfaces

/// The tensor product of a profile (columns (radius, 0, z), run along v) turned about z: the circle
/// runs along u.
inline Surface revolve(const std::vector<double>& knots_v, int degree_v, const Points& profile,
  const Eigen::VectorXd& weights, double degrees = 360.0, int arcs = 4)
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

/// S1: z = x·y over [−1, 1]².
inline Surface saddle()
{
  return Surface(KnotVector(1, { -1, -1, 1, 1 }, "KnotsU"),
    KnotVector(1, { -1, -1, 1, 1 }, "KnotsV"),
    points({ { -1, -1, 1 }, { 1, -1, -1 }, { -1, 1, -1 }, { 1, 1, 1 } }));
}

/// S2: about the z axis from z = −10 to 10; u is in degrees (exact at multiples of 90), v is z.
inline Surface cylinder(double radius = 10.0, double degrees = 270.0, int arcs = 3)
{
  return revolve({ -10, -10, 10, 10 }, 1, points({ { radius, 0, -10 }, { radius, 0, 10 } }),
    Eigen::Vector2d(1, 1), degrees, arcs);
}

/// S3: the plane x = 0 over 0 ≤ y, z ≤ 10 with y = u, z = v.
inline Surface square()
{
  return Surface(KnotVector(1, { 0, 0, 10, 10 }, "KnotsU"),
    KnotVector(1, { 0, 0, 10, 10 }, "KnotsV"),
    points({ { 0, 0, 0 }, { 0, 10, 0 }, { 0, 0, 10 }, { 0, 10, 10 } }));
}

/// S4: (u(1 − v), uv, 0); the side u = 0 collapses to the origin.
inline Surface triangle()
{
  return Surface(KnotVector(1, { 0, 0, 1, 1 }, "KnotsU"), KnotVector(1, { 0, 0, 1, 1 }, "KnotsV"),
    points({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 0, 0 }, { 0, 1, 0 } }));
}

/// S5: v runs from the south pole to the north pole, domain [0, 360] x [−90, 90].
inline Surface sphere(double radius = 1.0)
{
  const double half = std::sqrt(0.5);
  Eigen::VectorXd weights(5);
  weights << 1, half, 1, half, 1;
  return revolve({ -90, -90, -90, 0, 0, 90, 90, 90 }, 2,
    radius * points({ { 0, 0, -1 }, { 1, 0, -1 }, { 1, 0, 0 }, { 1, 0, 1 }, { 0, 0, 1 } }),
    weights);
}

/// S6: axis z, domain [0, 360]²; v = 0 is the outer equator.
inline Surface torus(double major = 3.0, double minor = 1.0)
{
  const Arcs tube = unit_arcs(360.0, 4);
  Points profile(3, tube.points.cols());
  profile.row(0) = (minor * tube.points.row(0)).array() + major;
  profile.row(1).setZero();
  profile.row(2) = minor * tube.points.row(1);
  return revolve(tube.knots, 2, profile, tube.weights);
}

/// S7: (u², u³, v) for u in [−1, 1], v in [0, 1].
inline Surface cusp()
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

/// S8: a helicoid strip, radius from 0.5 (v = 0) to 1 (v = 1), z = pitch · u for u turns. The turn
/// is an unclamped cubic with 64 spans a turn whose knots lie on the helix to 1e-16, between them
/// to 1e-7; half turns about the radial line through a knot map it onto itself (ends apart).
inline Surface helical_ribbon(int turns = 7, double pitch = 0.25)
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

/// An n x n bicubic net over the unit square, heights random in ±height (1 / n by default).
inline Surface bumpy(int n, std::uint64_t seed, double height = -1.0)
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
struct Arrays
{
  std::array<int, N> degrees;
  std::array<std::vector<double>, N> knots;
  Points points;
  Eigen::VectorXd weights; ///< empty: polynomial

  oracle::Spline<N> spline() const { return { degrees, knots, points, weights }; }
  auto geometry() const
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
};

/// \param decades weights between 10^−decades and 10^decades; 0: polynomial
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

// === The oracle's view of a geometry

inline oracle::Spline<1> spline_of(const Curve& curve)
{
  return { { { curve.knots().degree() } }, { { curve.knots().knots() } },
    curve.local_control_points().colwise() + curve.centre(), curve.weights() };
}

inline oracle::Spline<2> spline_of(const Surface& surface)
{
  return { { { surface.knots(0).degree(), surface.knots(1).degree() } },
    { { surface.knots(0).knots(), surface.knots(1).knots() } },
    surface.local_control_points().colwise() + surface.centre(), surface.weights() };
}

/// The same in local coordinates of space (parameters stay the domain's): loses no digit far away.
inline oracle::Spline<1> local_spline_of(const Curve& curve)
{
  return { { { curve.knots().degree() } }, { { curve.knots().knots() } },
    curve.local_control_points(), curve.weights() };
}

inline oracle::Spline<2> local_spline_of(const Surface& surface)
{
  return { { { surface.knots(0).degree(), surface.knots(1).degree() } },
    { { surface.knots(0).knots(), surface.knots(1).knots() } }, surface.local_control_points(),
    surface.weights() };
}

} // namespace shapes
