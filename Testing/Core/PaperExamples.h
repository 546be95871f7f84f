// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// The examples and tables of the paper on orthogonal projection of points onto planar curves, and
/// its formulas as they are printed, in absolute coordinates.

#include "Shapes.h"

#include "footpoint/solvers/local_solver.h"

#include <array>
#include <cmath>
#include <string>

namespace paper
{

using footpoint::Curve;
using footpoint::Frame;
using footpoint::Method;
using footpoint::Parameter;
using footpoint::SolverOptions;
using footpoint::Step;
using footpoint::StepSettings;
using footpoint::Vector3;

constexpr int kColumns = 6;
constexpr int kRows = 11; ///< starts 0, 0.1, … 1

constexpr std::array<const char*, kColumns> kNames = { "N-R", "Hu's", "1st", "M1", "M2", "M3" };
constexpr std::array<Method, kColumns> kMethods = { Method::Newton, Method::CurvatureCircle,
  Method::FirstOrder, Method::SecondOrder1, Method::SecondOrder2, Method::SecondOrder3 };

constexpr std::array<double, 3> kTolerances = { 1e-4, 1e-8, 1e-12 };

using Table = std::array<std::array<const char*, kColumns>, kRows>;

/// Tables 1, 2 and 3: iterations from each start; x: no convergence within 100.
constexpr std::array<Table, 3> kPublished = { {
  { {
    { "5", "5", "19", "6", "6", "6" },
    { "4", "5", "15", "5", "5", "5" },
    { "3", "3", "8", "3", "3", "3" },
    { "4", "5", "21", "5", "5", "5" },
    { "4", "5", "26", "5", "5", "7" },
    { "6", "6", "30", "6", "6", "7" },
    { "x", "5", "32", "9", "9", "7" },
    { "13", "6", "34", "11", "11", "x" },
    { "x", "6", "38", "10", "10", "x" },
    { "6", "6", "58", "9", "9", "x" },
    { "x", "7", "x", "8", "8", "x" },
  } },
  { {
    { "6", "6", "42", "7", "7", "7" },
    { "5", "6", "39", "6", "6", "6" },
    { "4", "4", "32", "4", "4", "4" },
    { "5", "6", "44", "6", "6", "6" },
    { "5", "6", "49", "6", "6", "8" },
    { "7", "7", "53", "7", "7", "7" },
    { "x", "6", "56", "10", "10", "8" },
    { "14", "7", "58", "12", "12", "x" },
    { "x", "7", "62", "11", "11", "x" },
    { "7", "7", "82", "10", "10", "x" },
    { "x", "8", "x", "9", "9", "x" },
  } },
  { {
    { "7", "x", "66", "x", "8", "7" },
    { "6", "x", "63", "x", "7", "6" },
    { "5", "x", "55", "x", "5", "5" },
    { "6", "x", "68", "x", "6", "6" },
    { "6", "x", "73", "x", "7", "8" },
    { "7", "x", "77", "x", "7", "8" },
    { "x", "x", "79", "x", "11", "9" },
    { "15", "x", "82", "x", "13", "x" },
    { "x", "x", "86", "x", "12", "x" },
    { "8", "x", "x", "x", "11", "x" },
    { "x", "x", "x", "x", "10", "x" },
  } },
} };

/// A curve, a query and the foot that is looked for.
struct Example
{
  Curve curve;
  Vector3 query; ///< absolute
  double foot;   ///< parameter; both domains are [0, 1]
};

inline Example first_example()
{
  return { shapes::polynomial_curve(3, { 0, 0, 0, 0, 1, 1, 1, 1 },
             shapes::points({ { -2, 0, 0 }, { 0, 3, 0 }, { 2, -7, 0 }, { 6, 0, 0 } })),
    { 0, 2, 0 }, 0.20301655993621742 };
}

inline Example second_example()
{
  return { shapes::polynomial_curve(3, { 0, 0, 0, 0, 0.2, 0.4, 0.6, 0.8, 1, 1, 1, 1 },
             shapes::points({ { 100, 100, 0 }, { 140, 196, 0 }, { 200, 240, 0 }, { 260, 164, 0 },
               { 340, 164, 0 }, { 400, 240, 0 }, { 460, 196, 0 }, { 500, 100, 0 } })),
    { 310, 200, 0 }, 0.54652 };
}

/// The bare iteration of the paper: parameters clamped to the domain, |Δt| < tolerance as the end.
inline SolverOptions bare_options(Method method, double tolerance, int limit = 100)
{
  SolverOptions options;
  options.method = method;
  options.safeguards = false;
  options.point_tolerance = 0.0;
  options.cosine_tolerance = 0.0;
  options.step_tolerance = 0.0;
  options.parameter_tolerance = tolerance;
  options.maximum_iterations = limit;
  return options;
}

// === The formulas as printed: Q from absolute coordinates

inline double cross(const Vector3& a, const Vector3& b)
{
  return a.x() * b.y() - a.y() * b.x();
}

/// Tangent, normal and curvature with sign, eqs. (7) and (8).
struct PlaneFrame
{
  Vector3 c, first, t, n;
  double curvature;
};

inline PlaneFrame plane_frame(const Curve& curve, const Frame<1>& frame)
{
  const Vector3 first = frame.jet.first;
  const double speed = first.norm();
  const Vector3 t = first / speed;
  return { frame.jet.point + curve.centre(), first, t, Vector3(-t.y(), t.x(), 0.0),
    cross(first, frame.jet.second) / (speed * speed * speed) };
}

/// Eqs. (24) and (25), Q and c(0) absolute.
inline Parameter<1> step_to(const Vector3& q, const PlaneFrame& f)
{
  const double speed = f.first.norm();
  const double square =
    2.0 * std::abs(cross(f.first, q - f.c)) / (std::abs(f.curvature) * speed * speed * speed);
  return Parameter<1>(std::copysign(std::sqrt(square), f.first.dot(q - f.c)));
}

/// The step that gives the published column: s of eq. (4), which is a parameter already, divided by
/// |c'| once more as if it were an arc length. |c'|² in model units is no pure number: the step is
/// too short by |c'|, 7 in the first example, 500 in the second.
inline Step<1> printed_first_order(const Curve& curve, const Vector3& p)
{
  return [&curve, p](const Frame<1>& frame, const StepSettings<1>&)
  {
    const PlaneFrame f = plane_frame(curve, frame);
    return Parameter<1>((p - f.c).dot(f.t) / f.first.squaredNorm());
  };
}

/// Eqs. (9) to (13).
inline Step<1> printed_circle_step(const Curve& curve, const Vector3& p)
{
  return [&curve, p](const Frame<1>& frame, const StepSettings<1>&)
  {
    const PlaneFrame f = plane_frame(curve, frame);
    const Vector3 o = f.c + f.n / f.curvature;
    const double e = 1.0 - 1.0 / (std::abs(f.curvature) * (p - o).norm());
    return step_to(p * (1.0 - e) + o * e, f);
  };
}

/// Eqs. (23), (22) without the change of curvature, (24) and (25).
inline Step<1> printed_method_1(const Curve& curve, const Vector3& p)
{
  return [&curve, p](const Frame<1>& frame, const StepSettings<1>&)
  {
    const PlaneFrame f = plane_frame(curve, frame);
    const double k = f.curvature;
    const double s = (p - f.c).dot(f.t) / (1.0 - k * (p - f.c).dot(f.n));
    const Vector3 q = f.c + s * f.t + 0.5 * k * s * s * f.n - k * k * s * s * s / 6.0 * f.t;
    return step_to(q, f);
  };
}

/// Eqs. (20), (22), (24), (25), (30). Table 3 came from something better than this: absolute
/// coordinates fail at 1e-12 here, too.
inline Step<1> printed_method_3(const Curve& curve, const Vector3& p)
{
  return [&curve, p](const Frame<1>& frame, const StepSettings<1>&)
  {
    const PlaneFrame f = plane_frame(curve, frame);
    const double k = f.curvature;
    const double speed = f.first.norm();
    const double rate = (cross(f.first, frame.jet.third) / (speed * speed * speed) -
                          3.0 * k * f.first.dot(frame.jet.second) / (speed * speed)) /
      speed;
    const double along = (p - f.c).dot(f.t);
    const double across = (p - f.c).dot(f.n);
    const double a = 0.5 * rate * across - 0.5 * k * k * along;
    const double b = k * across - 1.0;
    const double root = std::sqrt(b * b - 4.0 * a * along);
    const double one = (-b + root) / (2.0 * a);
    const double other = (-b - root) / (2.0 * a);
    const double s = std::abs(one) < std::abs(other) ? one : other;
    const Vector3 q =
      f.c + s * f.t + 0.5 * k * s * s * f.n + s * s * s / 6.0 * (rate * f.n - k * k * f.t);
    return step_to(q, f);
  };
}

} // namespace paper
