// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// The examples and tables of the paper on orthogonal projection of points onto planar curves, and
/// its formulas as they are printed, in absolute coordinates.

#include "Shapes.h"

#include "footpoint/solvers/local_solver.h"

#include <array>

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

Example first_example();
Example second_example();

/// The bare iteration of the paper: parameters clamped to the domain, |Δt| < tolerance as the end.
SolverOptions bare_options(Method method, double tolerance, int limit = 100);

// === The formulas as printed: Q from absolute coordinates

double cross(const Vector3& a, const Vector3& b);

/// Tangent, normal and curvature with sign, eqs. (7) and (8).
struct PlaneFrame
{
  Vector3 c, first, t, n;
  double curvature;
};

PlaneFrame plane_frame(const Curve& curve, const Frame<1>& frame);

/// Eqs. (24) and (25), Q and c(0) absolute.
Parameter<1> step_to(const Vector3& q, const PlaneFrame& f);

/// The step that gives the published column: s of eq. (4), which is a parameter already, divided by
/// |c'| once more as if it were an arc length. |c'|² in model units is no pure number: the step is
/// too short by |c'|, 7 in the first example, 500 in the second.
Step<1> printed_first_order(const Curve& curve, const Vector3& p);

/// Eqs. (9) to (13).
Step<1> printed_circle_step(const Curve& curve, const Vector3& p);

/// Eqs. (23), (22) without the change of curvature, (24) and (25).
Step<1> printed_method_1(const Curve& curve, const Vector3& p);

/// Eqs. (20), (22), (24), (25), (30). Table 3 came from something better than this: absolute
/// coordinates fail at 1e-12 here, too.
Step<1> printed_method_3(const Curve& curve, const Vector3& p);

} // namespace paper
