// SPDX-License-Identifier: BSD-3-Clause
#include "Boundaries.h"

#include "footpoint/grids/boundary.h"
#include "footpoint/grids/boundary_crossing.h"
#include "footpoint/grids/grid_faces.h"
#include "footpoint/grids/transfinite.h"

#include <algorithm>
#include <limits>
#include <numeric>

using namespace boundaries;
using footpoint::assemble_sides;
using footpoint::Boundary;
using footpoint::BoundaryDefect;
using footpoint::BoundaryOptions;
using footpoint::kBottom;
using footpoint::kLeft;
using footpoint::kRight;
using footpoint::kTop;

namespace
{

const BoundaryOptions kForced = []
{
  BoundaryOptions options;
  options.force_corner_match = true;
  return options;
}();

/// All orders and directions of the polylines.
void for_all_ways(const std::vector<Points>& polylines,
  const std::function<void(const std::vector<Points>&, const std::vector<int>&, int)>& check)
{
  std::vector<int> order(polylines.size());
  std::iota(order.begin(), order.end(), 0);
  do
  {
    for (int mask = 0; mask < 1 << polylines.size(); ++mask)
    {
      std::vector<Points> given;
      for (std::size_t k = 0; k < order.size(); ++k)
      {
        const Points& polyline = polylines[order[k]];
        given.push_back((mask >> k) & 1 ? reversed(polyline) : polyline);
      }
      check(given, order, mask);
    }
  } while (std::next_permutation(order.begin(), order.end()));
}

void expect_one_patch(const std::vector<Points>& polylines, const BoundaryOptions& options = {})
{
  const Boundary expected = assemble_sides(polylines, {}, options);
  int ways = 0;
  for_all_ways(polylines,
    [&](const std::vector<Points>& given, const std::vector<int>&, int)
    {
      expect_same(assemble_sides(given, {}, options), expected);
      ++ways;
    });
  EXPECT_EQ(ways, polylines.size() == 4 ? 384 : 48);
}

std::vector<Points> mapped(
  std::vector<Points> sides, const std::function<Vector3(const Vector3&)>& map)
{
  for (Points& side : sides)
  {
    for (Eigen::Index i = 0; i < side.cols(); ++i)
    {
      side.col(i) = map(side.col(i));
    }
  }
  return sides;
}

} // namespace

TEST(Boundary, AllOrdersAndDirectionsGiveOnePatch)
{
  const std::vector<Points> quad = scalene_quad();
  const Boundary expected = assemble_sides(quad);
  for (int role = 0; role < 4; ++role)
  {
    EXPECT_TRUE(expected.sides[role] == quad[role]) << "natural roles " << role;
    EXPECT_EQ(expected.reports[role].input, role);
    EXPECT_FALSE(expected.reports[role].reversed);
  }
  for_all_ways(quad,
    [&](const std::vector<Points>& given, const std::vector<int>& order, int mask)
    {
      const Boundary boundary = assemble_sides(given);
      expect_same(boundary, expected);
      for (int k = 0; k < 4; ++k)
      {
        EXPECT_EQ(boundary.reports[order[k]].input, k);
        EXPECT_EQ(boundary.reports[order[k]].reversed, ((mask >> k) & 1) != 0);
      }
    });
}

TEST(Boundary, OnePatchForSymmetricAndStandingBoundaries)
{
  expect_one_patch(unit_square());
  const auto tilted = [](double angle)
  {
    return mapped(unit_square(),
      [angle](const Vector3& p) -> Vector3
      { return Eigen::AngleAxisd(angle, Vector3::UnitZ()) * p; });
  };
  expect_one_patch(tilted(M_PI / 4));
  expect_one_patch(tilted(1.0));
  const auto standing =
    mapped(unit_square(), [](const Vector3& p) { return Vector3(p.x(), 7.0, p.y()); });
  expect_one_patch(standing);
  EXPECT_TRUE(assemble_sides(standing).sides[kBottom] == standing[0]); // +x and +z, seen along +y
  const auto sideways =
    mapped(unit_square(), [](const Vector3& p) { return Vector3(7.0, p.x(), p.y()); });
  expect_one_patch(sideways);
  EXPECT_TRUE(assemble_sides(sideways).sides[kLeft] == sideways[3]); // +y and +z, seen along −x
}

TEST(Boundary, CornerGapsAreMergedSnappedOrRefused)
{
  for (const double gap : { 1e-9, 1e-4, 0.1 })
  {
    std::vector<Points> quad = scalene_quad();
    const double size = 3.9;
    quad[1].col(0) += Vector3(gap * size, 0.0, 0.0);
    if (gap < 1e-8)
    {
      expect_one_patch(quad);
      const Boundary boundary = assemble_sides(quad);
      EXPECT_NEAR(boundary.corner_gaps[1], gap * size, 1e-3 * gap * size);
      EXPECT_TRUE(boundary.sides[kBottom].col(6) == boundary.sides[kRight].col(0));
    }
    else if (gap < 1e-3)
    {
      expect_refused([&] { assemble_sides(quad); }, BoundaryDefect::Gap,
        "bottom (polyline 0) and right (polyline 1) are 0.00039 (9.96e-05 of the size) apart at "
        "C10");
      expect_refused([&] { assemble_sides(quad); }, BoundaryDefect::Gap, "ForceCornerMatch");
      expect_one_patch(quad, kForced);
      const Boundary boundary = assemble_sides(quad, {}, kForced);
      EXPECT_NEAR(boundary.corner_gaps[1], gap * size, 1e-12);
      EXPECT_NEAR(
        (boundary.sides[kBottom].col(6) - quad[0].col(6)).norm(), 0.5 * gap * size, 1e-12);
    }
    else
    {
      expect_refused([&] { assemble_sides(quad, {}, kForced); }, BoundaryDefect::Gap,
        "bottom (polyline 0) and right (polyline 1) are 0.39 (0.");
      expect_refused([&] { assemble_sides(quad, {}, kForced); }, BoundaryDefect::Gap,
        "apart at C10; CornerTolerance allows 0.001 of the size");
    }
  }
}

TEST(Boundary, EdgesWithoutLength)
{
  std::vector<Points> quad = scalene_quad();
  quad[2] = Points(quad[3].col(3).replicate(1, 6));
  quad[1] = line(quad[0].col(6), quad[3].col(3), 5);
  const Boundary collapsed = assemble_sides(quad);
  EXPECT_TRUE(collapsed.collapsed);
  expect_one_patch(quad);
  EXPECT_EQ(collapsed.sides[kTop].cols(), 6);
  EXPECT_TRUE(collapsed.sides[kTop].col(0) == collapsed.sides[kTop].col(5));

  std::vector<Points> adjacent = unit_square();
  adjacent[1] = Points(Vector3(1, 0, 0).replicate(1, 5));
  adjacent[2] = Points(Vector3(1, 0, 0).replicate(1, 5));
  adjacent[3] = sampled(5, [](double t) { return Vector3(t, t * (1 - t), 0); });
  expect_refused(
    [&] { assemble_sides(adjacent); }, BoundaryDefect::Degenerate, "sides without length");

  const std::vector<Points> opposite{ line({ 0, 0, 0 }, { 1, 0, 0 }, 5),
    Points(Vector3(1, 0, 0).replicate(1, 5)),
    sampled(5, [](double t) { return Vector3(t, t * (1 - t), 0); }),
    Points(Vector3(0, 0, 0).replicate(1, 5)) };
  expect_refused(
    [&] { assemble_sides(opposite); }, BoundaryDefect::Degenerate, "sides without length");
  expect_refused([&] { assemble_sides(std::vector<Points>(4, Points::Zero(3, 2))); },
    BoundaryDefect::Degenerate, "all points of the boundary are one");
}

TEST(Boundary, ThreeEdgesInAllOrders)
{
  const Vector3 a(0, 0, 0), b(2, 0.1, 0.3), c(0.8, 1.5, 0);
  const std::vector<Points> triangle{ line(a, b, 5), line(b, c, 4), line(c, a, 7) };
  expect_one_patch(triangle);
  const Boundary boundary = assemble_sides(triangle);
  EXPECT_TRUE(boundary.collapsed);
  EXPECT_TRUE(boundary.sides[kBottom] == triangle[0]);
  EXPECT_EQ(boundary.reports[kTop].input, -1);
  EXPECT_TRUE(boundary.sides[kTop].col(0) == c && boundary.sides[kTop].col(1) == c);
  const Boundary by_role = assemble_sides(triangle, { kTop, kRight, kLeft });
  EXPECT_EQ(by_role.reports[kBottom].input, -1);
  EXPECT_EQ(by_role.reports[kTop].input, 0);
  std::vector<Points> open = triangle;
  open[0].col(0).y() -= 0.3;
  expect_refused([&] { assemble_sides(open); }, BoundaryDefect::Gap,
    "bottom (polyline 0) and left (polyline 2) are 0.3");
}

TEST(Boundary, RolesAndStrictness)
{
  const std::vector<Points> quad = scalene_quad();
  const std::vector<Points> turned{ reversed(quad[1]), quad[2], quad[3], reversed(quad[0]) };
  const Boundary boundary = assemble_sides(turned, { kBottom, kRight, kTop, kLeft });
  for (int role = 0; role < 4; ++role)
  {
    EXPECT_EQ(boundary.reports[role].input, role);
  }
  const Boundary one_role = assemble_sides(quad, { -1, kBottom, -1, -1 });
  EXPECT_EQ(one_role.reports[kBottom].input, 1);
  BoundaryOptions strict;
  strict.strict = true;
  expect_same(assemble_sides(quad, {}, strict), assemble_sides(quad));
  expect_refused(
    [&] {
      assemble_sides({ quad[0], quad[1], reversed(quad[2]), quad[3] }, {}, strict);
    },
    BoundaryDefect::Gap, "top (polyline 2) and right (polyline 1)");
  expect_refused([&] { assemble_sides(quad, { 0, 2, 1, 3 }); }, BoundaryDefect::Gap, "apart at");
  expect_refused(
    [&] {
      assemble_sides(quad, { 0, 0, 1, 3 });
    },
    BoundaryDefect::Count, "BoundaryRole[1] = 0 was given to polyline 0 already");
  expect_refused(
    [&] {
      assemble_sides(quad, { 0, 4, 1, 3 });
    },
    BoundaryDefect::Count, "BoundaryRole[1] = 4");
}

TEST(Boundary, BadPolylinesAreNamed)
{
  std::vector<Points> quad = scalene_quad();
  quad[2](1, 3) = std::numeric_limits<double>::quiet_NaN();
  expect_refused([&] { assemble_sides(quad); }, BoundaryDefect::NotFinite,
    "point 3 of polyline 2 has the coordinate nan");
  quad[2] = Points(3, 1);
  expect_refused([&] { assemble_sides(quad); }, BoundaryDefect::Count, "polyline 2 has 1 point;");
  quad[2] = Points(3, 0);
  expect_refused([&] { assemble_sides(quad); }, BoundaryDefect::Count, "polyline 2 has 0 points;");
  quad = scalene_quad();
  quad[3] = line(quad[0].col(6), quad[0].col(0), 9); // another sampling, other direction
  expect_refused([&] { assemble_sides(quad); }, BoundaryDefect::Duplicate,
    "polyline 0 and polyline 3 are the same edge");
  expect_refused([] { assemble_sides({}); }, BoundaryDefect::Count, "there are 0 polylines");
}

TEST(Boundary, TheSeamOfATubeMayBeGivenTwice)
{
  const auto ring = [](double z)
  {
    Points points = sampled(
      33, [z](double t) { return Vector3(std::cos(2 * M_PI * t), std::sin(2 * M_PI * t), z); });
    points.col(32) = points.col(0);
    return points;
  };
  const Points seam = line({ 1, 0, 0 }, { 1, 0, 2 }, 5);
  const Boundary tube = assemble_sides({ ring(0), seam, ring(2), seam });
  EXPECT_FALSE(tube.collapsed);
  const Vector3 middle =
    footpoint::transfinite_grid(tube, { { { 0, 0 } } }).grid.points.col(33 * 2 + 8);
  EXPECT_NEAR(std::hypot(middle.x(), middle.y()), 1.0, 1e-14);
}

TEST(Boundary, ScalesAndOffsets)
{
  const std::vector<Points> quad = scalene_quad();
  for (const double scale : { 1e-12, 1e12 })
  {
    const auto scaled = mapped(quad, [scale](const Vector3& p) -> Vector3 { return scale * p; });
    expect_one_patch(scaled);
    EXPECT_TRUE(assemble_sides(scaled).sides[kBottom] == scaled[0]);
  }
  const auto far =
    mapped(quad, [](const Vector3& p) -> Vector3 { return p + Vector3(1e8, -1e8, 1e8); });
  expect_one_patch(far);
  std::vector<Points> jittered = far; // two units in the last place are rounding there
  jittered[1](0, 0) = std::nextafter(std::nextafter(jittered[1](0, 0), 2e8), 2e8);
  EXPECT_NEAR(assemble_sides(jittered).corner_gaps[1], 3e-8, 1e-8);
}

TEST(Boundary, SelfCrossingIsDiagnosed)
{
  EXPECT_FALSE(assemble_sides(scalene_quad()).self_crossing); // not planar
  EXPECT_FALSE(assemble_sides(unit_square(21)).self_crossing);
  const Vector3 a(0, 0, 3), b(1, 0, 3), c(1, 1, 3), d(0, 1, 3);
  for (const int count : { 2, 20, 21 }) // of odd counts the crossing is a point of both sides
  {
    const std::vector<Points> bow{ line(a, b, count), line(b, d, count), line(c, d, count),
      line(a, c, count) };
    EXPECT_TRUE(assemble_sides(bow).self_crossing) << count;
  }
  const auto wave = [](double from, double to, double height)
  {
    return sampled(41,
      [=](double t)
      { return Vector3(t, from + t * (to - from) + height * std::sin(2 * M_PI * t), 0); });
  };
  const auto box = [&](double height) -> std::vector<Points>
  {
    return { wave(0, 0, 0.0), line({ 1, 0, 0 }, { 1, 1, 0 }), wave(1, 1, height),
      line({ 0, 0, 0 }, { 0, 1, 0 }) };
  };
  EXPECT_FALSE(assemble_sides(box(0.9)).self_crossing);
  EXPECT_TRUE(assemble_sides(box(1.5)).self_crossing);
}

TEST(Boundary, BanksOfACutAreNoCrossing)
{
  // A plate with a slit that is sampled differently on its two banks, as around an airfoil's wake.
  Points loop(3, 9);
  loop.transpose() << 0, 0, 0, 4, 0, 0, 4, 2, 0, 3, 2, 0, 1.3, 2, 0, 1, 2, 0, 2, 2, 0, 4, 2, 0, 0,
    4, 0;
  EXPECT_FALSE(footpoint::crosses_itself(loop));
}

TEST(Boundary, CollinearPointsGiveNoNaN)
{
  const Boundary flat =
    assemble_sides({ line({ 0, 0, 0 }, { 3, 0, 0 }), line({ 3, 0, 0 }, { 4, 0, 0 }),
      line({ 1, 0, 0 }, { 4, 0, 0 }), line({ 0, 0, 0 }, { 1, 0, 0 }) });
  const auto grid = footpoint::transfinite_grid(flat).grid;
  EXPECT_TRUE(grid.points.allFinite());
  EXPECT_TRUE(footpoint::point_normals(grid) == Points::Zero(3, 441));
}
