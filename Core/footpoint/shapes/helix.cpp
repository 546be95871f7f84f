// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/shapes/shape_checks.h"
#include "footpoint/shapes/shapes.h"

#include <algorithm>

namespace footpoint
{

namespace
{

constexpr double kPi = 3.14159265358979323846;
constexpr double kMostTurns = 1000.0;

using Quartic = std::array<double, 5>;

/// Bernstein coefficients of the product of two quadratic polynomials.
Quartic product(const std::array<double, 3>& a, const std::array<double, 3>& b)
{
  return { { a[0] * b[0], 0.5 * (a[0] * b[1] + a[1] * b[0]),
    (a[0] * b[2] + 4.0 * a[1] * b[1] + a[2] * b[0]) / 6.0, 0.5 * (a[1] * b[2] + a[2] * b[1]),
    a[2] * b[2] } };
}

} // namespace

// With X, Y, W of the rational quadratic arc |θ| ≤ α, the heights of an arc of degree 4 over W²
// that are odd in θ are f = a sin θ + b sin θ cos θ = a Y/W + b X Y/W²; f(α) = α and f'(α) = 1 make
// neighbouring arcs tangent. The derivative of f − θ is 2b cos²θ + a cos θ − (1 + b), which is zero
// at α and where cos θ is the other root; so the deviation, zero at 0 and ±α, is largest there.
double helix_deviation(double rise, double half_angle)
{
  const double s = std::sin(half_angle);
  const double c = std::cos(half_angle);
  const double a = (s * c - half_angle * std::cos(2.0 * half_angle)) / (s * s * s);
  const double b = (half_angle * c - s) / (s * s * s);
  const double root = std::clamp(-(1.0 + b) / (2.0 * b * c), c, 1.0);
  const double angle = std::acos(root);
  return std::abs(rise * (a * std::sin(angle) + b * std::sin(angle) * root - angle));
}

Curve helix(double radius, double height, double turns, double tolerance)
{
  check_length("Radius", radius);
  check_length("Height", height);
  if (!(turns > 0.0 && turns <= kMostTurns))
  {
    throw ShapeError("Turns = " + to_text(turns) + "; more than 0 and at most " +
      to_text(kMostTurns) + " are needed");
  }
  check_range("HelixTolerance", tolerance, 1e-10, 1.0);
  const double angle = 2.0 * kPi * turns;
  const double rise = height / angle;

  // === Arcs of 120 degrees at most, about as few as keep the tolerance
  int arcs = static_cast<int>(std::ceil(angle / (2.0 * kPi / 3.0)));
  while (helix_deviation(rise, 0.5 * angle / arcs) > tolerance * radius)
  {
    arcs += std::max(1, arcs / 64);
  }
  const double alpha = 0.5 * angle / arcs;

  // === One arc about θ = 0, and its copies
  const double c = std::cos(alpha);
  const double s = std::sin(alpha);
  const std::array<double, 3> w{ { 1.0, c, 1.0 } };
  const Quartic weights = product(w, w);
  const Quartic x = product({ { c, 1.0, c } }, w);
  const Quartic y = product({ { -s, 0.0, s } }, w);
  // 4 w1/w0 (z1 − z0) is the derivative of the angle, 2 sin α, as neighbours are tangent.
  const double slope = 0.5 * s / c;
  const Quartic z{ { -alpha, -alpha + slope, 0.0, alpha - slope, alpha } };

  Points points(3, 4 * arcs + 1);
  Eigen::VectorXd all_weights(4 * arcs + 1);
  std::vector<double> knots(5, 0.0);
  for (int arc = 0; arc < arcs; ++arc)
  {
    const double middle = (2 * arc + 1) * alpha;
    for (int i = 0; i < 5; ++i)
    {
      const double px = x[i] / weights[i];
      const double py = y[i] / weights[i];
      points.col(4 * arc + i) << radius * (std::cos(middle) * px - std::sin(middle) * py),
        radius * (std::sin(middle) * px + std::cos(middle) * py),
        rise * (middle + z[i]) - 0.5 * height;
      all_weights[4 * arc + i] = weights[i];
    }
    knots.insert(knots.end(), arc + 1 < arcs ? 4 : 5, (arc + 1.0) / arcs);
  }
  return Curve(KnotVector(4, std::move(knots), "KnotsU"), points, all_weights);
}

} // namespace footpoint
