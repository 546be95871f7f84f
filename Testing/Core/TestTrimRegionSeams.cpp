// SPDX-License-Identifier: BSD-3-Clause
#include "TrimArcChecks.h"

#include "footpoint/common/errors.h"

#include <gtest/gtest.h>

#include <functional>

namespace
{

using footpoint::GeometryError;
using footpoint::TrimRegion;
using footpoint::Vector3;
using Cover = TrimRegion::Cover;
using namespace trims;

/// u in [0, period] around the z axis, v in [0, 2] along it.
Surface cylinder(bool swapped = false, double period = 360.0)
{
  shapes::Arcs arcs = shapes::unit_arcs(360.0, 4);
  for (double& knot : arcs.knots)
  {
    knot *= period / 360.0;
  }
  const Eigen::Index count = arcs.points.cols();
  Points points(3, 2 * count);
  Eigen::VectorXd weights(2 * count);
  for (Eigen::Index j = 0; j < 2; ++j)
  {
    for (Eigen::Index i = 0; i < count; ++i)
    {
      const Eigen::Index k = swapped ? 2 * i + j : count * j + i;
      points.col(k) = arcs.points.col(i) + Vector3(0.0, 0.0, 2.0 * j);
      weights[k] = arcs.weights[i];
    }
  }
  const KnotVector around(2, arcs.knots);
  const KnotVector along(1, { 0.0, 0.0, 2.0, 2.0 });
  return swapped ? Surface(along, around, points, weights)
                 : Surface(around, along, points, weights);
}

using Expected = std::function<bool(double, double)>;

/// Random points and boxes, the arcs' structure, and the middle of the domain's borders.
void expect_region(
  const std::vector<TrimLoop>& loops, const Surface& surface, const Expected& expected)
{
  const TrimRegion region(loops, surface, 0.0);
  check_arcs(region, loops, surface);
  const double length_u = surface.direction(0).length;
  const double length_v = surface.direction(1).length;
  shapes::Random random(1);
  for (int k = 0; k < 20000; ++k)
  {
    const double u = length_u * (k % 10 == 0 ? random.integer(0, 1) : random.uniform(0.0, 1.0));
    const double v = length_v * (k % 10 == 1 ? random.integer(0, 1) : random.uniform(0.0, 1.0));
    // On a seam the point just inside the domain stands for the one on it.
    const double inner_u = std::clamp(u, 1e-9 * length_u, (1.0 - 1e-9) * length_u);
    const double inner_v = std::clamp(v, 1e-9 * length_v, (1.0 - 1e-9) * length_v);
    ASSERT_EQ(region.contains(u, v), expected(inner_u, inner_v)) << u << " " << v;

    const double size = random.uniform(0.0, 0.1);
    const std::array<double, 2> low{ { u, v } };
    const std::array<double, 2> high{ { std::min(u + size * length_u, length_u),
      std::min(v + size * length_v, length_v) } };
    const Cover cover = region.cover(low, high);
    for (int corner = 0; corner < 16 && cover != Cover::Crossed; ++corner)
    {
      const double at_u = low[0] + (high[0] - low[0]) * (corner % 4 * 0.3 + 0.05);
      const double at_v = low[1] + (high[1] - low[1]) * (corner / 4 * 0.3 + 0.05);
      if (high[0] > low[0] && high[1] > low[1])
      {
        ASSERT_EQ(expected(at_u, at_v), cover == Cover::Inside) << u << " " << v << " " << size;
      }
    }
  }
}

/// A curve that runs once around at height v + wave, from u0 to u1 in the circles' parameter.
TrimLoop around(double u0, double u1, double v, double wave = 0.0)
{
  const int spans = 6;
  const int degree = 3;
  Points points = Points::Zero(3, spans + degree);
  const KnotVector knots(degree, shapes::clamped_knots(degree, spans));
  const Eigen::Index last = points.cols() - 1;
  for (Eigen::Index i = 0; i <= last; ++i)
  {
    const double t = knots.greville(static_cast<int>(i));
    points.col(i) << u0 + (u1 - u0) * t, v + (i == 0 || i == last ? 0.0 : wave * (i % 2 ? 1 : -1)),
      0.0;
  }
  TrimLoop loop;
  loop.curves.push_back(std::make_shared<Curve>(knots, points));
  return loop;
}

TrimLoop swapped(const TrimLoop& loop)
{
  TrimLoop result;
  for (const CurvePointer& curve : loop.curves)
  {
    Points points = curve->local_control_points().colwise() + curve->centre();
    points.row(0).swap(points.row(1));
    result.curves.push_back(std::make_shared<Curve>(curve->knots(), points, curve->weights()));
  }
  return reversed(result); // exchanging u and v turns left into right
}

bool band(double, double v)
{
  return v > 0.5 && v < 1.5;
}

TEST(TrimRegionSeams, BandOfACylinder)
{
  const Surface tube = cylinder();
  ASSERT_TRUE(tube.direction(0).closed);
  const double turn = tube.direction(0).length;
  for (const double start : { 0.0, 0.3, -0.7, 0.123456789, 3.1, -2.9 })
  {
    SCOPED_TRACE(start);
    const TrimLoop bottom = around(start * turn, (start + 1.0) * turn, 0.5);
    const TrimLoop top = around((0.4 - start) * turn, (-0.6 - start) * turn, 1.5);
    expect_region({ bottom, top }, tube, band);
    expect_region({ top, bottom }, tube, band);
    // Everything but the band; below one loop; above one.
    expect_region(
      { reversed(bottom), reversed(top) }, tube, [](double u, double v) { return !band(u, v); });
    expect_region({ reversed(bottom) }, tube, [](double, double v) { return v < 0.5; });
    expect_region({ bottom }, tube, [](double, double v) { return v > 0.5; });
    // A hole across the seam.
    TrimLoop hole = rectangle(-0.1 * turn, 0.8, 0.1 * turn, 1.2);
    expect_region({ bottom, reversed(hole), top }, tube,
      [&](double u, double v)
      { return band(u, v) && !((u < 0.1 * turn || u > 0.9 * turn) && v > 0.8 && v < 1.2); });
  }
}

/// Rays straight through the points where arcs meet, the one where the loop closes among them: they
/// differ by rounding when periods of 0.7 are taken off.
TEST(TrimRegionSeams, RaysThroughEndsOfArcs)
{
  const Surface tube = cylinder(false, 0.7);
  const double turn = tube.direction(0).length;
  shapes::Random random(12);
  for (int trial = 0; trial < 300; ++trial)
  {
    const double start = random.uniform(-3.0, 3.0);
    const TrimRegion region(
      { around(start * turn, (start + 1.0) * turn, 0.5), around(turn, 0.0, 1.5) }, tube, 0.0);
    for (const footpoint::TrimArc& arc : region.arcs())
    {
      const double end = arc.control(0, arc.control.cols() - 1);
      for (const double u :
        { arc.control(0, 0), std::nextafter(end, 0.0), end, std::nextafter(end, 2.0 * turn) })
      {
        // Near the loops, where rays are needed.
        for (const double v : { 0.5 - 1e-6, 0.5 + 1e-6, 1.5 - 1e-6, 1.5 + 1e-6 })
        {
          ASSERT_EQ(region.contains(u, v), band(u, v)) << start << " " << u << " " << v;
        }
      }
    }
  }
}

TEST(TrimRegionSeams, BandWithSeamEdges)
{
  const Surface tube = cylinder();
  const double turn = tube.direction(0).length;
  expect_region({ rectangle(0.0, 0.5, turn, 1.5) }, tube, band);
  // Each curve in a period of its own: the seam's second run is written at the first one's place.
  TrimLoop loop = rectangle(0.0, 0.5, turn, 1.5);
  loop.curves[1] = polyline({ { 0.0, 0.5 }, { 0.0, 1.5 } });
  loop.curves[2] = polyline({ { 2.0 * turn, 1.5 }, { turn, 1.5 } });
  expect_region({ loop }, tube, band);
}

TEST(TrimRegionSeams, WavyBandNeedsTheArcsThemselves)
{
  const Surface tube = cylinder();
  const double turn = tube.direction(0).length;
  const TrimLoop bottom = around(0.3 * turn, 1.3 * turn, 0.6, 0.5);
  const TrimLoop top = around(1.1 * turn, 0.1 * turn, 1.4, 0.5);
  const auto height = [&](const TrimLoop& loop, double u)
  {
    const Curve& curve = *loop.curves[0];
    const double start = de_boor(curve, 3, 0.0L)[0];
    const double end = de_boor(curve, curve.knots().number_of_control_points() - 1, 1.0L)[0];
    double t = (u - start) / (end - start); // u is linear in t: its control points are Greville's
    t -= std::floor(t);
    return static_cast<double>(
      de_boor(curve, curve.knots().find_span(t, footpoint::Side::Right), t)[1]);
  };
  expect_region({ bottom, top }, tube,
    [&](double u, double v) { return v > height(bottom, u) && v < height(top, u); });
}

TEST(TrimRegionSeams, LoopsAcrossTheSeam)
{
  const Surface tube = cylinder();
  const double turn = tube.direction(0).length;
  for (const double shift : { 0.0, -turn, 2.0 * turn })
  {
    expect_region({ rectangle(0.8 * turn + shift, 0.5, 1.25 * turn + shift, 1.5) }, tube,
      [&](double u, double v) { return band(u, v) && (u > 0.8 * turn || u < 0.25 * turn); });
    expect_region({ reversed(rectangle(0.8 * turn + shift, 0.5, 1.25 * turn + shift, 1.5)) }, tube,
      [&](double u, double v) { return !(band(u, v) && (u > 0.8 * turn || u < 0.25 * turn)); });
  }
}

/// Loops that run around in v need rays along u.
TEST(TrimRegionSeams, CylinderClosedInV)
{
  const Surface tube = cylinder(true);
  ASSERT_TRUE(tube.direction(1).closed);
  const double turn = tube.direction(1).length;
  const TrimLoop bottom = around(0.3 * turn, 1.3 * turn, 0.5);
  const TrimLoop top = around(1.1 * turn, 0.1 * turn, 1.5);
  const TrimLoop hole = reversed(rectangle(-0.1 * turn, 0.8, 0.1 * turn, 1.2));
  expect_region({ swapped(bottom), swapped(top), swapped(hole) }, tube,
    [&](double u, double v)
    { return band(v, u) && !((v < 0.1 * turn || v > 0.9 * turn) && u > 0.8 && u < 1.2); });
  expect_region({ swapped(reversed(bottom)), swapped(reversed(top)) }, tube,
    [](double u, double v) { return !band(v, u); });
  expect_region({ swapped(rectangle(0.8 * turn, 0.5, 1.25 * turn, 1.5)) }, tube,
    [&](double u, double v) { return band(v, u) && (v > 0.8 * turn || v < 0.25 * turn); });
}

TEST(TrimRegionSeams, Torus)
{
  const Surface torus = shapes::torus(3.0, 1.0);
  ASSERT_TRUE(torus.direction(0).closed && torus.direction(1).closed);
  const double lu = torus.direction(0).length;
  const double lv = torus.direction(1).length;
  for (const double start : { 0.0, 0.35, 0.9 })
  {
    for (const double low : { 0.2, 0.7, 1.7 })
    {
      SCOPED_TRACE(std::to_string(start) + " " + std::to_string(low));
      const double high = low + 0.5;
      const auto inside = [](double at, double from, double to)
      { return at - from - std::floor(at - from) < to - from; };
      // Around in u, then around in v, wavy enough to cross the seam to and fro.
      const TrimLoop bottom = around(start * lu, (start + 1.0) * lu, low * lv);
      const TrimLoop top = around((start + 1.2) * lu, (start + 0.2) * lu, high * lv);
      expect_region(
        { bottom, top }, torus, [&](double, double v) { return inside(v / lv, low, high); });
      expect_region({ reversed(bottom), reversed(top) }, torus,
        [&](double, double v) { return !inside(v / lv, low, high); });
      const TrimLoop left = swapped(around(start * lv, (start + 1.0) * lv, low * lu));
      const TrimLoop right = swapped(around((start + 1.2) * lv, (start + 0.2) * lv, high * lu));
      expect_region(
        { left, right }, torus, [&](double u, double) { return inside(u / lu, low, high); });
      // A rectangle, and a hole, that may lie across both seams.
      const TrimLoop window = rectangle(low * lu, start * lv, high * lu, (start + 0.4) * lv);
      const auto in_window = [&](double u, double v)
      { return inside(u / lu, low, high) && inside(v / lv, start, start + 0.4); };
      expect_region({ window }, torus, in_window);
      expect_region(
        { reversed(window) }, torus, [&](double u, double v) { return !in_window(u, v); });
      try
      {
        const TrimRegion region({ bottom, left }, torus, 0.0);
        FAIL() << "loops around both ways were accepted";
      }
      catch (const GeometryError& error)
      {
        EXPECT_NE(std::string(error.what())
                    .find("trim loop 0 runs around the surface in u and "
                          "trim loop 1 in v"),
          std::string::npos)
          << error.what();
      }
    }
  }
}

TEST(TrimRegionSeams, WavesAcrossTheSeamOfATorus)
{
  const Surface torus = shapes::torus(3.0, 1.0);
  const double lu = torus.direction(0).length;
  const double lv = torus.direction(1).length;
  const TrimLoop bottom = around(0.0, lu, 0.0, 0.2 * lv);
  const TrimLoop top = around(lu, 0.0, 0.5 * lv);
  expect_region({ bottom, top }, torus,
    [&](double u, double v)
    {
      const Curve& curve = *bottom.curves[0];
      const double t = u / lu;
      const double wave = static_cast<double>(
        de_boor(curve, curve.knots().find_span(t, footpoint::Side::Right), t)[1]);
      return (v < 0.5 * lv && v > wave) || v > lv + wave;
    });
}

/// At a pole a gap in (u, v) is none in space.
TEST(TrimRegionSeams, GapsAtPoles)
{
  const Surface sphere = shapes::sphere();
  int pole = sphere.direction(1).collapsed[1] ? 1 : -1;
  ASSERT_EQ(pole, 1);
  const double lu = sphere.direction(0).length;
  const double lv = sphere.direction(1).length;
  const double u0 = sphere.direction(0).origin;
  const double v0 = sphere.direction(1).origin;
  const auto line = [&](double ua, double va, double ub, double vb) {
    return polyline({ { u0 + ua * lu, v0 + va * lv }, { u0 + ub * lu, v0 + vb * lv } });
  };
  // A cap without its degenerate edge, and a wedge.
  const TrimLoop cap{ { line(0, 0.7, 1, 0.7), line(1, 0.7, 1, 1), line(0, 1, 0, 0.7) } };
  const TrimLoop wedge{ { line(0.2, 0.7, 0.6, 0.7), line(0.6, 0.7, 0.6, 1),
    line(0.2, 1, 0.2, 0.7) } };
  expect_region({ cap }, sphere, [&](double, double v) { return v > 0.7 * lv; });
  expect_region({ wedge }, sphere,
    [&](double u, double v) { return v > 0.7 * lv && u > 0.2 * lu && u < 0.6 * lu; });
  EXPECT_LT(TrimRegion({ wedge }, sphere, 0.0).largest_gap(), 1e-12 * sphere.size());
}

} // namespace
