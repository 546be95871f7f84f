// SPDX-License-Identifier: BSD-3-Clause

// The judge is judged by closed forms alone.

#include "OracleNearest.h"
#include "OracleShapes.h"
#include "Shapes.h"

#include <gtest/gtest.h>

using footpoint::Curve;
using footpoint::Surface;
using oracle::Foot;
using oracle::Nearest;
using oracle::Real;
using oracle::Vector;

namespace
{

constexpr Real kTolerance = 1e-15L; // of the size

} // namespace

TEST(Oracle, DerivativesOfAPolynomial)
{
  // t³ and 1 − t³ on [0, 2]: Bézier ordinates of t³ are 0, 0, 0, 8.
  const oracle::Spline<1> cubic({ { 3 } }, { { { 0, 0, 0, 0, 2, 2, 2, 2 } } },
    shapes::points({ { 0, 1, 0 }, { 0, 1, 0 }, { 0, 1, 0 }, { 8, -7, 0 } }));
  EXPECT_LE((cubic.point({ 1.5L }) - Vector(3.375L, -2.375L, 0)).norm(), 1e-18L);
  const Vector direction(1, -1, 0);
  EXPECT_LE(
    (oracle::derivative<1>(cubic, { 3 }, { 1.5L }, { 1 }) - 6.75L * direction).norm(), 1e-15L);
  EXPECT_LE(
    (oracle::derivative<1>(cubic, { 3 }, { 1.5L }, { 2 }) - 9.0L * direction).norm(), 1e-12L);
  EXPECT_LE(
    (oracle::derivative<1>(cubic, { 3 }, { 1.5L }, { 3 }) - 6.0L * direction).norm(), 1e-9L);
}

TEST(Oracle, SidesOfAGap)
{
  const oracle::Spline<1> line = shapes::spline_of(shapes::line_with_gap());
  EXPECT_EQ(line.point({ 1.0L }, { true }), Vector(1, 0, 0));
  EXPECT_EQ(line.point({ 1.0L }, { false }), Vector(1, 1, 0));
}

TEST(Oracle, NearestOnCurves)
{
  // C1 (fourth-order minimum), C2
  const Nearest<1> parabola(shapes::spline_of(shapes::parabola()));
  EXPECT_NEAR(parabola(Vector(0, 0.5L, 0)).distance, 0.5L, kTolerance);
  EXPECT_NEAR(parabola(Vector(0, 1, 0)).distance, std::sqrt(0.75L), kTolerance);
  EXPECT_NEAR(std::abs(parabola(Vector(0, 1, 0)).parameter[0]), std::sqrt(0.5L), 1e-9L);
  // C3: the kink
  const Foot<1> kink = Nearest<1>(shapes::spline_of(shapes::tent()))(Vector(1, 2, 0));
  EXPECT_NEAR(kink.distance, 1.0L, kTolerance);
  EXPECT_EQ(kink.parameter[0], 1.0L);
  // C4: the seam
  EXPECT_NEAR(
    Nearest<1>(shapes::spline_of(shapes::closed_with_corner()))(Vector(0, -1, 0)).distance, 1.0L,
    kTolerance);
  // C5
  const Foot<1> stalled =
    Nearest<1>(shapes::spline_of(shapes::stalled_line()))(Vector(0.001L, 1, 0));
  EXPECT_NEAR(stalled.distance, 1.0L, kTolerance);
  EXPECT_NEAR(stalled.point[0], 0.001L, 1e-9L);
  // C6: off and on the curve
  const Nearest<1> circle(shapes::spline_of(shapes::circle()));
  EXPECT_NEAR(circle(Vector(3, 4, 0)).distance, 5.0L, 10.0L * kTolerance);
  EXPECT_LE(circle(Vector(6, -8, 0)).distance, 10.0L * kTolerance);
  // C8: the two sides of the gap
  const Nearest<1> gap(shapes::spline_of(shapes::line_with_gap()));
  EXPECT_NEAR(gap(Vector(1, 0.9L, 0)).distance, 0.1L, kTolerance);
  EXPECT_NEAR(gap(Vector(1, 0.1L, 0)).distance, 0.1L, kTolerance);
}

TEST(Oracle, NearestOnSurfaces)
{
  const auto distance = [](const Surface& surface, const Vector& query)
  { return Nearest<2>(shapes::spline_of(surface))(query).distance; };
  // S1 to S8
  EXPECT_NEAR(distance(shapes::saddle(), Vector(0, 0, 1.5L)), std::sqrt(2.0L), kTolerance);
  const Real root = std::sqrt(2.0L);
  EXPECT_NEAR(distance(shapes::cylinder(), Vector(root, -root, 5)),
    std::sqrt(2.0L + (10.0L - root) * (10.0L - root)), 10.0L * kTolerance);
  EXPECT_NEAR(
    distance(shapes::square(), Vector(5, 5, 100)), std::sqrt(8125.0L), 100.0L * kTolerance);
  EXPECT_NEAR(distance(shapes::triangle(), Vector(-1, -1, 1)), std::sqrt(3.0L), kTolerance);
  EXPECT_NEAR(distance(shapes::sphere(), Vector(0, 0, 2)), 1.0L, kTolerance);
  EXPECT_NEAR(distance(shapes::sphere(), Vector(1e-9L, 0, 2)), 1.0L + 2.5e-19L, kTolerance);
  EXPECT_NEAR(distance(shapes::torus(), Vector(3, 0, 0)), 1.0L, 4.0L * kTolerance);
  EXPECT_NEAR(distance(shapes::torus(), Vector(0, 0, 0)), 2.0L, 4.0L * kTolerance);
  EXPECT_NEAR(distance(shapes::torus(), Vector(3, 3, 2)),
    std::hypot(3.0L * root - 3.0L, 2.0L) - 1.0L, 4.0L * kTolerance);
  EXPECT_NEAR(distance(shapes::cusp(), Vector(-1, 0, 0.5L)), 1.0L, kTolerance);
  // S8: halfway between two turns, above a knot; nudged, the foot changes to the nearer turn.
  const Nearest<2> ribbon(shapes::spline_of(shapes::helical_ribbon()));
  const Real up = ribbon(Vector(0.75L, 0, 0.875L + 1e-6L)).parameter[0];
  const Real down = ribbon(Vector(0.75L, 0, 0.875L - 1e-6L)).parameter[0];
  EXPECT_NEAR(up - down, 1.0L, 0.1L);
}

TEST(Oracle, PiecesAreTheSpline)
{
  // Feet are sought on Bézier pieces and then evaluated on the spline: distance zero if they agree.
  shapes::Random random(45);
  for (int k = 0; k < 20; ++k)
  {
    const std::array<int, 2> degrees{ { random.integer(1, 9), random.integer(1, 9) } };
    const bool clamped = random.integer(0, 1) == 0;
    const oracle::Spline<2> spline =
      shapes::random_arrays<2>(random, degrees, 2, clamped, 1.0).spline();
    const std::vector<int> u = spline.spans(0);
    const std::vector<int> v = spline.spans(1);
    const Nearest<2> nearest(spline);
    for (int i = 0; i < 5; ++i)
    {
      const Real s = random.uniform(0, 1);
      const Real t = random.uniform(0, 1);
      const Vector query =
        spline.point({ (1.0L - s) * spline.knot(0, u.back()) + s * spline.knot(0, u.back() + 1),
          (1.0L - t) * spline.knot(1, v.back()) + t * spline.knot(1, v.back() + 1) });
      EXPECT_LE(nearest(query).distance, kTolerance) << degrees[0] << " x " << degrees[1];
    }
  }
}

TEST(Oracle, NearestOnTheSurfaceIsZero)
{
  const Surface surface = shapes::bumpy(12, 41);
  const oracle::Spline<2> spline = shapes::spline_of(surface);
  const Nearest<2> nearest(spline);
  shapes::Random random(42);
  for (int i = 0; i < 20; ++i)
  {
    const Vector query = spline.point({ random.uniform(0, 1), random.uniform(0, 1) });
    EXPECT_LE(nearest(query).distance, kTolerance);
  }
}

TEST(Oracle, NearestIsNeverFartherThanAFineGrid)
{
  const oracle::Spline<2> spline = shapes::spline_of(shapes::bumpy(10, 43, 0.3));
  const Nearest<2> nearest(spline);
  shapes::Random random(44);
  std::vector<Vector> grid;
  for (int j = 0; j <= 200; ++j)
  {
    for (int i = 0; i <= 200; ++i)
    {
      grid.push_back(spline.point({ i / 200.0L, j / 200.0L }, { i == 200, j == 200 }));
    }
  }
  for (int i = 0; i < 40; ++i)
  {
    const Vector query = random.vector(-0.3, 1.3).cast<Real>();
    Real best = 1e9L;
    for (const Vector& point : grid)
    {
      best = std::min(best, (point - query).norm());
    }
    const Foot<2> foot = nearest(query);
    EXPECT_LE(foot.distance, best);
    EXPECT_GE(foot.distance, best - 0.01L);
    EXPECT_NEAR((spline.point(foot.parameter) - query).norm(), foot.distance, kTolerance);
  }
}
