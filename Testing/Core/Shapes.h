// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Named geometries that several tests use; closed forms stand in the comments. Letters with a
/// number (C1, S5, …) are those of the table of hard cases.

#include "footpoint/splines/curve.h"
#include "footpoint/splines/surface.h"

#include <array>
#include <cstdint>
#include <initializer_list>
#include <random>
#include <type_traits>
#include <vector>

namespace oracle
{
template <int N>
class Spline; // Oracle.h
} // namespace oracle

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
  explicit Random(std::uint64_t seed);
  double uniform(double low, double high);
  int integer(int low, int high);
  Vector3 vector(double low, double high);
  /// 10^x with x uniform in [−decades, decades].
  double magnitude(double decades);

private:
  std::mt19937_64 Engine;
};

Points points(std::initializer_list<Vector3> columns);

/// Clamped on [start, end] with equal spans.
std::vector<double> clamped_knots(int degree, int spans, double start = 0.0, double end = 1.0);

/// Equally spaced without repetition: domain [0, spans].
std::vector<double> uniform_knots(int degree, int spans);

/// Random spans, repetitions up to degree + 1 inside; the ends are clamped, or have some (perhaps
/// repeated) knots outside the domain. Multiples of 2^−20, so that differences of knots are exact.
std::vector<double> random_knots(Random& random, int degree, int spans, bool clamped);

/// A full or partial circle of unit radius as rational quadratic arcs of equal angle.
struct Arcs
{
  std::vector<double> knots; ///< the domain is [0, angle in degrees]
  Points points;             ///< in the plane z = 0, from (1, 0, 0) counter-clockwise
  Eigen::VectorXd weights;
};

Arcs unit_arcs(double degrees, int arcs);

Curve polynomial_curve(int degree, std::vector<double> knots, const Points& net);

// === Curves

/// C1, C2: (t, t²) for t in [−1, 1]; local parameter t + 1.
Curve parabola();

/// C3: degree 1 through (0,0), (1,1), (2,0), knots 0, 1, 2.
Curve tent();

/// C4: a closed cubic Bézier curve whose seam (0,0) is a corner.
Curve closed_with_corner();

/// C5: (t³, 0).
Curve stalled_line();

/// C6, C7: a rational circle in the plane z = centre.z, domain [0, 360] (not proportional to the
/// angle inside the four arcs).
Curve circle(double radius = 10.0, const Vector3& centre = Vector3::Zero());

/// C8: the line (t, 0) on [0, 1] and, after a gap, (t, 1) on [1, 2].
Curve line_with_gap();

/// C9: closed and smooth, a cubic stored unclamped over `n` poles (n + 3 with the repeated ones) on
/// the circle of radius 1; the first and last poles differ.
Curve periodic(int n = 8);

/// C9: unclamped; first and last pole are the same, the curve is open all the same.
Curve open_with_matching_poles();

// === Surfaces

/// The tensor product of a profile (columns (radius, 0, z), run along v) turned about z: the circle
/// runs along u.
Surface revolve(const std::vector<double>& knots_v, int degree_v, const Points& profile,
  const Eigen::VectorXd& weights, double degrees = 360.0, int arcs = 4);

/// S1: z = x·y over [−1, 1]².
Surface saddle();

/// S2: about the z axis from z = −10 to 10; u is in degrees (exact at multiples of 90), v is z.
Surface cylinder(double radius = 10.0, double degrees = 270.0, int arcs = 3);

/// S3: the plane x = 0 over 0 ≤ y, z ≤ 10 with y = u, z = v.
Surface square();

/// S4: (u(1 − v), uv, 0); the side u = 0 collapses to the origin.
Surface triangle();

/// S5: v runs from the south pole to the north pole, domain [0, 360] x [−90, 90].
Surface sphere(double radius = 1.0);

/// S6: axis z, domain [0, 360]²; v = 0 is the outer equator.
Surface torus(double major = 3.0, double minor = 1.0);

/// S7: (u², u³, v) for u in [−1, 1], v in [0, 1].
Surface cusp();

/// S8: a helicoid strip, radius from 0.5 (v = 0) to 1 (v = 1), z = pitch · u for u turns. The turn
/// is an unclamped cubic with 64 spans a turn whose knots lie on the helix to 1e-16, between them
/// to 1e-7; half turns about the radial line through a knot map it onto itself (ends apart).
Surface helical_ribbon(int turns = 7, double pitch = 0.25);

/// An n x n bicubic net over the unit square, heights random in ±height (1 / n by default).
Surface bumpy(int n, std::uint64_t seed, double height = -1.0);

// === Random geometry with the arrays it was made of

template <int N>
struct Arrays
{
  std::array<int, N> degrees;
  std::array<std::vector<double>, N> knots;
  Points points;
  Eigen::VectorXd weights; ///< empty: polynomial

  /// As the oracle sees it.
  oracle::Spline<N> spline() const;
  std::conditional_t<N == 1, Curve, Surface> geometry() const;
};

/// \param decades weights between 10^−decades and 10^decades; 0: polynomial
template <int N>
Arrays<N> random_arrays(
  Random& random, const std::array<int, N>& degrees, int spans, bool clamped, double decades);

} // namespace shapes
