// SPDX-License-Identifier: BSD-3-Clause
/// How loops are put together from curves: gaps, rounding, what is refused.
#include "TrimArcChecks.h"

#include "footpoint/common/errors.h"

#include <gtest/gtest.h>

namespace
{

using footpoint::GeometryDefect;
using footpoint::GeometryError;
using footpoint::TrimRegion;
using namespace trims;

void expect_refused(const std::vector<TrimLoop>& loops, const Surface& surface,
  const std::vector<std::string>& words, double tolerance = 0.0)
{
  try
  {
    const TrimRegion region(loops, surface, tolerance);
    FAIL() << "accepted, with " << region.arcs().size() << " arcs";
  }
  catch (const GeometryError& error)
  {
    EXPECT_EQ(error.defect(), GeometryDefect::Format);
    for (const std::string& word : words)
    {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  }
}

TEST(TrimLoopChain, GapsAreClosedByLines)
{
  const Surface surface = flat();
  TrimLoop loop = rectangle(0.2, 0.2, 0.8, 0.8);
  loop.curves[1] = polyline({ { 0.8, 0.21 }, { 0.79, 0.8 } });
  const TrimRegion region({ loop }, surface, 0.0);
  EXPECT_NEAR(region.largest_gap(), 0.01, 1e-15);
  int bridges = 0;
  for (const footpoint::TrimArc& arc : region.arcs())
  {
    bridges += arc.closes_gap ? 1 : 0;
    EXPECT_EQ(arc.vertex[0] && arc.vertex[1], true);
  }
  EXPECT_EQ(bridges, 2);
  // The second line over a gap runs back over the first hundredth of the next curve.
  ASSERT_EQ(region.arcs().size(), 7u);
  for (std::size_t k = 0; k < 7; ++k)
  {
    const bool twice = k == 3 || k == 4;
    EXPECT_EQ(region.arcs()[k].bounds,
      twice ? footpoint::ArcBounds::Outside : footpoint::ArcBounds::Face);
  }
  check_arcs(region, { loop }, surface);
  EXPECT_FALSE(region.contains(0.795, 0.79));
  EXPECT_TRUE(region.contains(0.785, 0.79));

  loop.curves[2] = polyline({ { 0.75, 0.8 }, { 0.2, 0.8 } });
  expect_refused({ rectangle(0.4, 0.4, 0.5, 0.5), loop }, surface,
    { "curve 1 of trim loop 1", "gap of 0.04", "0.02828" });
  EXPECT_NEAR(TrimRegion({ loop }, surface, 0.05).largest_gap(), 0.04, 1e-15);
}

TEST(TrimLoopChain, RoundingBetweenCurvesIsNoGap)
{
  const Surface surface = flat();
  TrimLoop loop = rectangle(0.2, 0.3, 0.8, 0.7);
  const double e = 2e-16;
  loop.curves[1] = polyline({ { 0.8 + 2 * e, 0.3 - e }, { 0.8 + e, 0.7 } });
  const TrimRegion region({ loop }, surface, 0.0);
  EXPECT_EQ(region.arcs().size(), 4u);
  EXPECT_EQ(region.largest_gap(), 0.0);
  // The line along v stays one: no arc of rounding's width.
  EXPECT_EQ(region.arcs()[1].control(0, 0), region.arcs()[1].control(0, 1));
}

/// A line along u with rounding noise is constant in v.
TEST(TrimLoopChain, NoiseDoesNotCutLines)
{
  shapes::Random random(6);
  const int degree = 5;
  Points points = Points::Zero(3, degree + 3);
  for (Eigen::Index i = 0; i < points.cols(); ++i)
  {
    points.col(i) << 0.1 + 0.8 * i / 7.0, 0.3 + random.uniform(-1e-16, 1e-16), 0.0;
  }
  TrimLoop loop = polygon({ { 0.1, 0.3 }, { 0.9, 0.3 }, { 0.5, 0.9 } });
  loop.curves[0] =
    std::make_shared<Curve>(KnotVector(degree, shapes::clamped_knots(degree, 3)), points);
  const TrimRegion region({ loop }, flat(), 0.0);
  EXPECT_EQ(region.arcs().size(), 5u);
  for (int k = 0; k < 3; ++k)
  {
    EXPECT_EQ(
      region.arcs()[k].control.row(1).minCoeff(), region.arcs()[k].control.row(1).maxCoeff());
  }
}

TEST(TrimLoopChain, Refusals)
{
  const Surface surface = flat();
  expect_refused({}, surface, { "at least one loop" });
  expect_refused({ rectangle(0.1, 0.1, 0.9, 0.9), TrimLoop() }, surface, { "trim loop 1" });
  TrimLoop missing = rectangle(0.1, 0.1, 0.9, 0.9);
  missing.curves[2] = nullptr;
  expect_refused({ missing }, surface, { "curve 2 of trim loop 0", "missing" });
  TrimLoop raised = rectangle(0.1, 0.1, 0.9, 0.9);
  raised.curves[1] = std::make_shared<Curve>(
    KnotVector(1, { 0, 0, 1, 1 }), shapes::points({ { 0.9, 0.1, 0.0 }, { 0.9, 0.9, 0.25 } }));
  expect_refused({ raised }, surface, { "control point 1 of curve 1 of trim loop 0", "0.25" });
  // There and back; a loop beside the domain; a hole as large as its outer loop, or as the domain.
  const TrimLoop back{ { polyline({ { 0.1, 0.2 }, { 0.8, 0.9 } }),
    polyline({ { 0.8, 0.9 }, { 0.1, 0.2 } }) } };
  expect_refused({ back }, surface, { "keep nothing" });
  expect_refused({ rectangle(1.1, 0.1, 1.9, 0.9) }, surface, { "keep nothing" });
  expect_refused({ circle(0.5, 0.5, 0.3), reversed(circle(0.5, 0.5, 0.3)) }, surface,
    { "2 trim loops keep nothing" });
  expect_refused({ reversed(rectangle(0.0, 0.0, 1.0, 1.0)) }, surface, { "keep nothing" });
}

} // namespace
