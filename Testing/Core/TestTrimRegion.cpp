// SPDX-License-Identifier: BSD-3-Clause
#include "TrimArcChecks.h"

#include <gtest/gtest.h>

namespace
{

using footpoint::TrimRegion;
using Cover = TrimRegion::Cover;
using namespace trims;

TEST(TrimRegion, CircleInClosedForm)
{
  const Surface surface = flat(0.0, 1.0, 0.0, 1.0, 3);
  const std::vector<TrimLoop> loops{ circle(0.5, 0.4, 0.3) };
  const TrimRegion region(loops, surface, 0.0);
  check_arcs(region, loops, surface);
  const TrimRegion hole({ reversed(loops[0]) }, surface, 0.0);
  shapes::Random random(1);
  for (int k = 0; k < 100000; ++k)
  {
    const double u = random.uniform(0.0, 1.0);
    const double v = random.uniform(0.0, 1.0);
    const double distance = std::hypot(u - 0.5, v - 0.4) - 0.3;
    if (std::abs(distance) > 1e-14)
    {
      ASSERT_EQ(region.contains(u, v), distance < 0.0) << u << " " << v;
      ASSERT_EQ(hole.contains(u, v), distance > 0.0) << u << " " << v;
    }
  }
}

TEST(TrimRegion, PointsBesideACircle)
{
  const TrimRegion region({ circle(0.5, 0.4, 0.3) }, flat(), 0.0);
  shapes::Random random(2);
  for (int k = 0; k < 20000; ++k)
  {
    const double angle = k < 16 ? k * std::acos(-1.0) / 8 : random.uniform(-4.0, 4.0);
    for (const double offset : { 1e-12, -1e-12, 1e-6, -1e-6 })
    {
      const double u = 0.5 + (0.3 + offset) * std::cos(angle);
      const double v = 0.4 + (0.3 + offset) * std::sin(angle);
      ASSERT_EQ(region.contains(u, v), offset < 0.0) << angle << " " << offset;
    }
  }
}

/// Below the graph of a random rational spline, closed by three lines.
TEST(TrimRegion, PointsBesideGraphsOfSplines)
{
  shapes::Random random(3);
  const Surface surface = flat(-1.0, 2.0, 0.0, 1.0, 4);
  for (int trial = 0; trial < 60; ++trial)
  {
    const int degree = 1 + trial % 9;
    const int spans = random.integer(1, 4);
    const KnotVector knots(degree, shapes::clamped_knots(degree, spans));
    Points points = Points::Zero(3, degree + spans);
    Eigen::VectorXd weights(points.cols());
    for (Eigen::Index i = 0; i < points.cols(); ++i)
    {
      // From large to small u, so that the loop is counter-clockwise.
      points(0, i) = 1.5 -
        2.0 * (i + (i == 0 || i + 1 == points.cols() ? 0.0 : random.uniform(-0.4, 0.4))) /
          (points.cols() - 1.0);
      points(1, i) = random.uniform(0.3, 0.9);
      weights[i] = trial % 2 == 0 ? 1.0 : random.uniform(0.2, 5.0);
    }
    const auto graph = std::make_shared<Curve>(knots, points, weights);
    const Point2 right = points.col(0).head<2>();
    const Point2 left = points.rightCols(1).topRows<2>();
    TrimLoop loop;
    loop.curves = { graph, polyline({ left, { left[0], 0.1 } }),
      polyline({ { left[0], 0.1 }, { right[0], 0.1 } }), polyline({ { right[0], 0.1 }, right }) };
    const TrimRegion region({ loop }, surface, 0.0);
    check_arcs(region, { loop }, surface);
    for (int k = 0; k < 300; ++k)
    {
      const double t = random.uniform(0.0, 1.0);
      const RealPoint p = de_boor(*graph, knots.find_span(t, footpoint::Side::Right), t);
      const double u = static_cast<double>(p[0]) + 1.0;
      const double v = static_cast<double>(p[1]);
      for (const double offset : { 1e-12, 1e-8, 0.05 })
      {
        ASSERT_TRUE(region.contains(u, v - offset)) << trial << " " << t << " " << offset;
        ASSERT_FALSE(region.contains(u, v + offset)) << trial << " " << t << " " << offset;
      }
    }
  }
}

TEST(TrimRegion, NestedLoops)
{
  const Surface surface = flat();
  // In any order: an island in a hole.
  const std::vector<TrimLoop> loops{ reversed(circle(0.5, 0.5, 0.1)), circle(0.5, 0.5, 0.4),
    circle(0.5, 0.5, 0.2), reversed(circle(0.5, 0.5, 0.3)) };
  const TrimRegion region(loops, surface, 0.0);
  const TrimRegion holes(
    { reversed(circle(0.3, 0.3, 0.2)), reversed(circle(0.7, 0.7, 0.15)) }, surface, 0.0);
  shapes::Random random(4);
  for (int k = 0; k < 50000; ++k)
  {
    const double u = random.uniform(0.0, 1.0);
    const double v = random.uniform(0.0, 1.0);
    const double r = std::hypot(u - 0.5, v - 0.5);
    ASSERT_EQ(region.contains(u, v), (r > 0.1 && r < 0.2) || (r > 0.3 && r < 0.4)) << u << " " << v;
    ASSERT_EQ(holes.contains(u, v),
      std::hypot(u - 0.3, v - 0.3) > 0.2 && std::hypot(u - 0.7, v - 0.7) > 0.15);
  }
}

/// Loops along the whole border keep everything, the border's points included.
TEST(TrimRegion, WholeDomain)
{
  const Surface surface = flat(2.0, 5.0, -1.0, 1.0, 4);
  for (const double rounding : { 0.0, 1e-13, -1e-16 })
  {
    const std::vector<TrimLoop> loops{ rectangle(
      2.0 - rounding, -1.0 - rounding, 5.0 + rounding, 1.0 + rounding) };
    const TrimRegion region(loops, surface, 0.0);
    check_arcs(region, loops, surface);
    EXPECT_EQ(region.arcs().size(), 16u); // four spans a side
    for (const footpoint::TrimArc& arc : region.arcs())
    {
      EXPECT_TRUE(arc.inside_domain);
    }
    for (const double u : { 0.0, 0.75, 1.0, 3.0 })
    {
      for (const double v : { 0.0, 0.5, 1.9, 2.0 })
      {
        EXPECT_TRUE(region.contains(u, v)) << u << " " << v;
      }
    }
    EXPECT_EQ(region.cover({ 0.0, 0.0 }, { 3.0, 2.0 }), Cover::Inside);
  }
}

TEST(TrimRegion, LoopsLeaveTheDomain)
{
  const Surface surface = flat(0.0, 1.0, 0.0, 1.0, 2);
  const std::vector<TrimLoop> loops{ circle(0.9, 0.95, 0.3) };
  const TrimRegion region(loops, surface, 0.0);
  check_arcs(region, loops, surface);
  int outside = 0;
  for (const footpoint::TrimArc& arc : region.arcs())
  {
    outside += arc.inside_domain ? 0 : 1;
  }
  EXPECT_GT(outside, 0);
  EXPECT_LT(outside, static_cast<int>(region.arcs().size()));
  shapes::Random random(5);
  for (int k = 0; k < 50000; ++k)
  {
    const double u = random.uniform(0.0, 1.0);
    const double v = random.uniform(0.0, 1.0);
    ASSERT_EQ(region.contains(u, v), std::hypot(u - 0.9, v - 0.95) < 0.3);
  }
}

TEST(TrimRegion, DegenerateAndTouchingLoops)
{
  const Surface surface = flat();
  // A curve of no length between two others, and one run through twice.
  TrimLoop loop = rectangle(0.2, 0.2, 0.8, 0.8);
  loop.curves.insert(loop.curves.begin() + 2, polyline({ { 0.8, 0.8 }, { 0.8, 0.8 } }));
  for (const std::vector<TrimLoop>& loops :
    { std::vector<TrimLoop>{ loop }, { loop, loop }, { loop, rectangle(0.2, 0.2, 0.5, 0.8) } })
  {
    const TrimRegion region(loops, surface, 0.0);
    check_arcs(region, loops, surface);
    const std::size_t cuts = loops.size() == 2 && loops[1].curves.size() == 4u
      ? 2u // of the first loop, at the corners of the second one on its sides
      : 0u;
    EXPECT_EQ(region.arcs().size(), 4u * loops.size() + cuts);
    EXPECT_TRUE(region.contains(0.3, 0.3));
    EXPECT_TRUE(region.contains(0.7, 0.7));
    EXPECT_FALSE(region.contains(0.1, 0.2));
    EXPECT_FALSE(region.contains(0.9, 0.8));
  }
  // Two squares that share a corner, and a hole that shares a side with its outer loop.
  const TrimRegion touching(
    { rectangle(0.1, 0.1, 0.5, 0.5), rectangle(0.5, 0.5, 0.9, 0.9) }, surface, 0.0);
  const TrimRegion side(
    { rectangle(0.1, 0.1, 0.9, 0.9), reversed(rectangle(0.5, 0.1, 0.9, 0.6)) }, surface, 0.0);
  shapes::Random random(7);
  for (int k = 0; k < 20000; ++k)
  {
    const double u = random.uniform(0.0, 1.0);
    const double v = random.uniform(0.0, 1.0);
    const bool first = u > 0.1 && u < 0.5 && v > 0.1 && v < 0.5;
    ASSERT_EQ(touching.contains(u, v), first || (u > 0.5 && u < 0.9 && v > 0.5 && v < 0.9));
    ASSERT_EQ(
      side.contains(u, v), u > 0.1 && u < 0.9 && v > 0.1 && v < 0.9 && !(u > 0.5 && v < 0.6));
  }
}

/// (t², t³) for t in [−1, 1]: the cusp's tip is a turning point of u and v at once.
TEST(TrimRegion, Cusp)
{
  const double third = 1.0 / 3.0;
  Points points(3, 4);
  points << 1, -third, -third, 1, /**/ -1, 1, -1, 1, /**/ 0, 0, 0, 0;
  TrimLoop loop;
  loop.curves = { std::make_shared<Curve>(KnotVector(3, { -1, -1, -1, -1, 1, 1, 1, 1 }), points),
    polyline({ { 1.0, 1.0 }, { 1.0, -1.0 } }) };
  const Surface surface = flat(-1.0, 2.0, -2.0, 2.0);
  const std::vector<TrimLoop> loops{ reversed(loop) };
  const TrimRegion region(loops, surface, 0.0);
  check_arcs(region, loops, surface);
  EXPECT_EQ(region.arcs().size(), 3u);
  shapes::Random random(8);
  for (int k = 0; k < 20000; ++k)
  {
    const double u = random.uniform(-0.5, 1.5);
    const double v = random.uniform(-1.2, 1.2);
    ASSERT_EQ(region.contains(u + 1.0, v + 2.0), u < 1.0 && std::cbrt(v * v) < u) << u << " " << v;
  }
}

TEST(TrimRegion, LongPolylines)
{
  // The star-shaped polygon with corners at radius 0.3 and 0.4 in turn, against its sectors.
  const int count = 10000;
  const double step = 2.0 * std::acos(-1.0) / count;
  std::vector<Point2> corners;
  for (int i = 0; i <= count; ++i)
  {
    const double radius = i % 2 == 0 ? 0.3 : 0.4;
    corners.emplace_back(
      0.5 + radius * std::cos(i % count * step), 0.5 + radius * std::sin(i % count * step));
  }
  TrimLoop loop;
  loop.curves.push_back(polyline(corners));
  const Surface surface = flat();
  const TrimRegion region({ loop }, surface, 0.0);
  EXPECT_EQ(region.arcs().size(), static_cast<std::size_t>(count));
  shapes::Random random(9);
  for (int k = 0; k < 100000; ++k)
  {
    const double angle = random.uniform(0.0, count * step);
    const double radius = random.uniform(0.25, 0.45);
    const Point2 p(0.5 + radius * std::cos(angle), 0.5 + radius * std::sin(angle));
    const int sector = std::min(static_cast<int>(angle / step), count - 1);
    const Point2 side = corners[sector + 1] - corners[sector];
    const Point2 to = p - corners[sector];
    const double cross = (side[0] * to[1] - side[1] * to[0]) / side.norm();
    if (std::abs(cross) > 1e-12)
    {
      ASSERT_EQ(region.contains(p[0], p[1]), cross > 0.0) << angle << " " << radius;
    }
  }
}

TEST(TrimRegion, ScalesOfTheDomain)
{
  struct Domain
  {
    double u0, u1, v0, v1;
    double noise; ///< of parameters against the domain's length
  };
  for (const Domain& domain :
    { Domain{ 1e6, 1e6 + 1, -1e6, -1e6 + 1, 1e-9 }, { 0.0, 1e-8, 0.0, 1e-8, 1e-14 },
      { 0.0, 1.0, 0.0, 1e8, 1e-14 }, { 5.0, 5.0 + 1e-8, 0.0, 1e8, 1e-6 } })
  {
    const Surface surface = flat(domain.u0, domain.u1, domain.v0, domain.v1, 3);
    const double length_u = surface.direction(0).length;
    const double length_v = surface.direction(1).length;
    // The unit circle's control points are stretched.
    const Curve unit = *circle(0.5, 0.5, 0.4).curves[0];
    Points points = unit.local_control_points().colwise() + unit.centre();
    points.row(0) = points.row(0).array() * length_u + domain.u0;
    points.row(1) = points.row(1).array() * length_v + domain.v0;
    TrimLoop loop;
    loop.curves.push_back(std::make_shared<Curve>(unit.knots(), points, unit.weights()));
    const TrimRegion region({ loop }, surface, 0.0);
    EXPECT_EQ(region.largest_gap(), 0.0);
    shapes::Random random(10);
    for (int k = 0; k < 20000; ++k)
    {
      const double angle = random.uniform(0.0, 6.3);
      const double radius =
        0.4 + random.uniform(-0.1, 0.1) * std::pow(10.0, -random.integer(0, 10));
      if (std::abs(radius - 0.4) > domain.noise)
      {
        ASSERT_EQ(region.contains(length_u * (0.5 + radius * std::cos(angle)),
                    length_v * (0.5 + radius * std::sin(angle))),
          radius < 0.4)
          << length_u << " " << angle << " " << radius - 0.4;
      }
    }
  }
}

TEST(TrimRegion, CoverIsCertain)
{
  const Surface surface = flat();
  const TrimRegion region({ circle(0.5, 0.5, 0.4), reversed(circle(0.4, 0.5, 0.2)) }, surface, 0.0);
  shapes::Random random(11);
  std::array<int, 3> counts{ { 0, 0, 0 } };
  for (int k = 0; k < 50000; ++k)
  {
    const double u = random.uniform(0.0, 1.0);
    const double v = random.uniform(0.0, 1.0);
    const double size = 0.2 * std::pow(10.0, -random.uniform(0.0, 6.0));
    const std::array<double, 2> low{ { std::max(u - size, 0.0), std::max(v - size, 0.0) } };
    const std::array<double, 2> high{ { std::min(u + size, 1.0), std::min(v + size, 1.0) } };
    const Cover cover = region.cover(low, high);
    ++counts[static_cast<int>(cover)];
    // Nearest and farthest point of the box from the circles' centres, in closed form.
    const auto reaches = [&](double cu, double cv, double radius)
    {
      const double du = std::max({ low[0] - cu, cu - high[0], 0.0 });
      const double dv = std::max({ low[1] - cv, cv - high[1], 0.0 });
      const double fu = std::max(cu - low[0], high[0] - cu);
      const double fv = std::max(cv - low[1], high[1] - cv);
      const double nearest = std::hypot(du, dv) - radius;
      return nearest > 1e-13 ? -1 : std::hypot(fu, fv) - radius < -1e-13 ? 1 : 0;
    };
    const int outer = reaches(0.5, 0.5, 0.4);
    const int hole = reaches(0.4, 0.5, 0.2);
    const Cover expected = outer < 0 || hole > 0 ? Cover::Outside
      : outer > 0 && hole < 0                    ? Cover::Inside
                                                 : Cover::Crossed;
    ASSERT_EQ(cover, expected) << u << " " << v << " " << size;
  }
  EXPECT_GT(*std::min_element(counts.begin(), counts.end()), 2000);
}

} // namespace
