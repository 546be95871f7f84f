// SPDX-License-Identifier: BSD-3-Clause
#include "TrimArcChecks.h"
#include "TrimFaces.h"

#include <gtest/gtest.h>

namespace
{

using footpoint::TrimRegion;
using Cover = TrimRegion::Cover;
using namespace trims;

/// A closed spline through random control points, mostly with crossings of itself.
TrimLoop random_loop(shapes::Random& random, int degree)
{
  const int spans = random.integer(3, 8);
  Points points = Points::Zero(3, degree + spans);
  Eigen::VectorXd weights(points.cols());
  for (Eigen::Index i = 0; i < points.cols(); ++i)
  {
    points.col(i).head<2>() << random.uniform(-0.2, 1.2), random.uniform(-0.2, 1.2);
    weights[i] = random.integer(0, 1) == 0 ? 1.0 : random.uniform(0.1, 10.0);
  }
  points.rightCols(1) = points.col(0);
  weights[weights.size() - 1] = weights[0];
  if (random.integer(0, 1) == 0)
  {
    weights.setOnes();
  }
  TrimLoop loop;
  loop.curves.push_back(std::make_shared<Curve>(
    KnotVector(degree, shapes::clamped_knots(degree, spans)), points, weights));
  return loop;
}

TEST(TrimRegionFuzz, RandomClosedSplines)
{
  shapes::Random random(1);
  int judged = 0;
  int inside = 0;
  int undecided = 0;
  for (int trial = 0; trial < 450; ++trial)
  {
    const Surface surface = flat(0.0, 1.0, 0.0, 1.0, random.integer(1, 4));
    const std::vector<TrimLoop> loops{ random_loop(random, 1 + trial % 9) };
    const std::vector<RealPoint> polygon = polygon_of(loops[0], 48);
    // Which side of a figure of eight is its inside is a matter of taste.
    const double signed_area = static_cast<double>(area(polygon));
    if (std::abs(signed_area) < 1e-2)
    {
      continue;
    }
    SCOPED_TRACE("trial " + std::to_string(trial));
    const TrimRegion region(loops, surface, 0.0);
    check_arcs(region, loops, surface);
    const int base = signed_area < 0.0 ? 1 : 0;
    for (int k = 0; k < 300; ++k)
    {
      const double u = random.uniform(0.0, 1.0);
      const double v = random.uniform(0.0, 1.0);
      const View seen = view(polygon, u, v);
      if (seen.distance > 4e-3L)
      {
        ASSERT_EQ(region.contains(u, v), seen.winding + base > 0) << u << " " << v;
        // A box without the curve has one answer; it may be left open, but seldom.
        const double half = 0.7 * (static_cast<double>(seen.distance) - 4e-3);
        const Cover cover = region.cover({ std::max(u - half, 0.0), std::max(v - half, 0.0) },
          { std::min(u + half, 1.0), std::min(v + half, 1.0) });
        if (cover == Cover::Crossed)
        {
          ++undecided; // so many arcs near that the search for one was given up
        }
        else
        {
          ASSERT_EQ(cover, seen.winding + base > 0 ? Cover::Inside : Cover::Outside);
        }
        ++judged;
        inside += region.contains(u, v) ? 1 : 0;
      }
    }
  }
  EXPECT_GT(judged, 100000);
  EXPECT_LT(undecided, judged / 1000);
  EXPECT_GT(inside, judged / 10);
  EXPECT_LT(inside, judged * 9 / 10);
}

/// On a line through the domain the answers change where the curve crosses it, and nowhere else.
TEST(TrimRegionFuzz, AnswersChangeAtTheCurveOnly)
{
  shapes::Random random(2);
  for (int trial = 0; trial < 120; ++trial)
  {
    const Surface surface = flat();
    const std::vector<TrimLoop> loops{ random_loop(random, 1 + trial % 9) };
    const std::vector<RealPoint> polygon = polygon_of(loops[0], 400);
    const TrimRegion region(loops, surface, 0.0);
    const Point2 from(random.uniform(0.0, 1.0), random.uniform(0.0, 1.0));
    const Point2 to(random.uniform(0.0, 1.0), random.uniform(0.0, 1.0));
    for (int k = 0; k < 400; ++k)
    {
      Point2 low = from + (to - from) * (k / 400.0);
      Point2 high = from + (to - from) * ((k + 1) / 400.0);
      const bool kept = region.contains(low[0], low[1]);
      if (kept == region.contains(high[0], high[1]))
      {
        continue;
      }
      for (int halving = 0; halving < 60; ++halving)
      {
        const Point2 middle = 0.5 * (low + high);
        (region.contains(middle[0], middle[1]) == kept ? low : high) = middle;
      }
      // Within the polygon's own error: 400 sides a span.
      ASSERT_LT(view(polygon, low[0], low[1]).distance, 5e-4L) << trial << " " << k;
    }
  }
}

TEST(TrimRegionFuzz, RealFaces)
{
  const std::vector<RealFace> faces = real_faces();
  if (faces.empty())
  {
    GTEST_SKIP() << "FOOTPOINT_SHARED_DATA names no folder with json/*.jsonl";
  }
  ASSERT_GT(faces.size(), 200u);
  shapes::Random random(3);
  int judged = 0;
  for (const RealFace& face : faces)
  {
    SCOPED_TRACE(face.name);
    const TrimRegion region(face.loops, *face.surface, 0.0);
    check_arcs(region, face.loops, *face.surface);
    EXPECT_LT(region.largest_gap(), 2e-3 * face.surface->size());

    const footpoint::Direction& along_u = face.surface->direction(0);
    const footpoint::Direction& along_v = face.surface->direction(1);
    const RealPoint scale{ { along_u.length, along_v.length } };
    std::vector<std::vector<RealPoint>> polygons;
    Real green = 0;
    for (const TrimLoop& loop : face.loops)
    {
      polygons.push_back(polygon_of(loop, 24));
      green += area(polygons.back()) / (scale[0] * scale[1]);
    }
    const int side = 100;
    int kept = 0;
    for (int k = 0; k < side * side; ++k)
    {
      const double u = along_u.length * (k % side + random.uniform(0.0, 1.0)) / side;
      const double v = along_v.length * (k / side + random.uniform(0.0, 1.0)) / side;
      const bool contained = region.contains(u, v);
      kept += contained ? 1 : 0;
      if (k % 500 == 250)
      {
        int winding = 0;
        Real nearest = 1;
        for (const std::vector<RealPoint>& polygon : polygons)
        {
          const View seen = view(polygon, u + along_u.origin, v + along_v.origin, scale);
          winding += seen.winding;
          nearest = std::min(nearest, seen.distance);
        }
        if (nearest > 2e-3L)
        {
          ASSERT_EQ(contained, winding > 0) << u << " " << v;
          ++judged;
        }
      }
    }
    // One point in each of 10,000 cells: the boundary's cells alone scatter, by less than 0.5 %.
    EXPECT_NEAR(kept / static_cast<double>(side * side), static_cast<double>(green), 1e-2);
  }
  EXPECT_GT(judged, 3000);
}

} // namespace
