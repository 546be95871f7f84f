// SPDX-License-Identifier: BSD-3-Clause
#include "Boundaries.h"

#include "footpoint/grids/boundary.h"
#include "footpoint/grids/boundary_crossing.h"
#include "footpoint/grids/grid_faces.h"
#include "footpoint/grids/transfinite.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>

using namespace boundaries;
using footpoint::assemble_boundary;
using footpoint::assemble_sides;
using footpoint::Boundary;
using footpoint::BoundaryDefect;
using footpoint::BoundaryOptions;
using footpoint::chain_segments;
using footpoint::Chains;
using footpoint::kBottom;
using footpoint::kLeft;
using footpoint::kRight;
using footpoint::kTop;
using footpoint::split_loop;

namespace
{

const BoundaryOptions kForced = []
{
  BoundaryOptions options;
  options.force_corner_match = true;
  return options;
}();

void expect_same(const Boundary& a, const Boundary& b)
{
  for (int role = 0; role < 4; ++role)
  {
    ASSERT_EQ(a.sides[role].cols(), b.sides[role].cols()) << role;
    EXPECT_TRUE(a.sides[role] == b.sides[role]) << role;
    EXPECT_EQ(a.corner_gaps[role], b.corner_gaps[role]) << role;
  }
}

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

std::vector<Points> unit_square(int count = 5)
{
  return border([](double s, double t) { return Vector3(s, t, 0.0); }, count, count);
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
        "bottom (polyline 0) and right (polyline 1) are 0.00039 (9.96e-05 of the size) apart at C10");
      expect_refused([&] { assemble_sides(quad); }, BoundaryDefect::Gap, "ForceCornerMatch");
      expect_one_patch(quad, kForced);
      const Boundary boundary = assemble_sides(quad, {}, kForced);
      EXPECT_NEAR(boundary.corner_gaps[1], gap * size, 1e-12);
      EXPECT_NEAR((boundary.sides[kBottom].col(6) - quad[0].col(6)).norm(), 0.5 * gap * size, 1e-12);
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
  expect_refused([&] { assemble_sides({ quad[0], quad[1], reversed(quad[2]), quad[3] }, {}, strict); },
    BoundaryDefect::Gap, "top (polyline 2) and right (polyline 1)");
  expect_refused([&] { assemble_sides(quad, { 0, 2, 1, 3 }); }, BoundaryDefect::Gap, "apart at");
  expect_refused([&] { assemble_sides(quad, { 0, 0, 1, 3 }); }, BoundaryDefect::Count,
    "BoundaryRole[1] = 0 was given to polyline 0 already");
  expect_refused(
    [&] { assemble_sides(quad, { 0, 4, 1, 3 }); }, BoundaryDefect::Count, "BoundaryRole[1] = 4");
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
    Points points = sampled(33, [z](double t)
      { return Vector3(std::cos(2 * M_PI * t), std::sin(2 * M_PI * t), z); });
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
  const auto far = mapped(quad, [](const Vector3& p) -> Vector3
    { return p + Vector3(1e8, -1e8, 1e8); });
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
    return sampled(41, [=](double t)
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
  loop.transpose() << 0, 0, 0, 4, 0, 0, 4, 2, 0, 3, 2, 0, 1.3, 2, 0, 1, 2, 0, 2, 2, 0, 4, 2, 0, 0, 4, 0;
  EXPECT_FALSE(footpoint::crosses_itself(loop));
}

TEST(Boundary, CollinearPointsGiveNoNaN)
{
  const Boundary flat = assemble_sides({ line({ 0, 0, 0 }, { 3, 0, 0 }), line({ 3, 0, 0 }, { 4, 0, 0 }),
    line({ 1, 0, 0 }, { 4, 0, 0 }), line({ 0, 0, 0 }, { 1, 0, 0 }) });
  const auto grid = footpoint::transfinite_grid(flat).grid;
  EXPECT_TRUE(grid.points.allFinite());
  EXPECT_TRUE(footpoint::point_normals(grid) == Points::Zero(3, 441));
}

TEST(Loop, StartSenseAndRepetitionMakeNoDifference)
{
  const std::vector<Points> quad = scalene_quad();
  const Points loop = loop_of(quad);
  const Boundary expected = assemble_sides(quad);
  for (Eigen::Index start = 0; start < loop.cols(); ++start)
  {
    Points turned(3, loop.cols());
    turned << loop.rightCols(loop.cols() - start), loop.leftCols(start);
    Points closed(3, loop.cols() + 1);
    closed << turned, turned.col(0);
    for (const Points& given : { turned, closed, reversed(turned), reversed(closed) })
    {
      expect_same(split_loop(given), expected);
    }
  }
  const Boundary forwards = split_loop(loop);
  EXPECT_FALSE(forwards.reports[kBottom].reversed);
  EXPECT_TRUE(forwards.reports[kTop].reversed);
  EXPECT_TRUE(split_loop(reversed(loop)).reports[kBottom].reversed);
  EXPECT_EQ(forwards.guessed_corners, 0);
}

TEST(Loop, CornersByIds)
{
  const Points loop = loop_of(unit_square(5)); // 16 points, corners 0 4 8 12
  BoundaryOptions options;
  options.corner_ids = { 4, 8, 12, 0 };
  const Boundary along = split_loop(loop, options);
  EXPECT_TRUE(along.sides[kBottom] == line({ 1, 0, 0 }, { 1, 1, 0 }, 5));
  EXPECT_TRUE(along.sides[kLeft] == line({ 1, 0, 0 }, { 0, 0, 0 }, 5));
  options.corner_ids = { 0, 12, 8, 4 };
  const Boundary against = split_loop(loop, options);
  EXPECT_TRUE(against.sides[kBottom] == line({ 0, 0, 0 }, { 0, 1, 0 }, 5));
  EXPECT_TRUE(against.reports[kBottom].reversed);
  options.corner_ids = { 0, 8, 4, 12 };
  expect_refused([&] { split_loop(loop, options); }, BoundaryDefect::Corners, "in the order");
  options.corner_ids = { 0, 4, 8, 16 };
  expect_refused([&] { split_loop(loop, options); }, BoundaryDefect::Corners, "corner id 16");
  options.corner_ids = { 0, 4, 8 };
  expect_refused([&] { split_loop(loop, options); }, BoundaryDefect::Corners, "3 corner ids");
}

TEST(Loop, WithoutCornersWithThreeAndWithFive)
{
  const auto polygon = [](int corners, int points)
  {
    return sampled(points + 1, [&](double t) -> Vector3
             {
               const double along = t * corners;
               const double k = std::floor(along);
               const auto corner = [&](double i)
               {
                 const double angle = 2 * M_PI * (i / corners) + 0.3;
                 return Vector3(std::cos(angle), std::sin(angle), 1.0);
               };
               return corner(k) + (along - k) * (corner(k + 1) - corner(k));
             })
      .leftCols(points)
      .eval();
  };
  const Boundary circle = split_loop(polygon(80, 80));
  EXPECT_EQ(circle.guessed_corners, 4);
  for (const Points& side : circle.sides)
  {
    EXPECT_EQ(side.cols(), 21);
  }
  EXPECT_LT((circle.sides[kBottom].col(0) - Vector3(-M_SQRT1_2, -M_SQRT1_2, 1)).norm(), 0.05);

  const Boundary triangle = split_loop(polygon(3, 30));
  EXPECT_TRUE(triangle.collapsed);
  EXPECT_EQ(triangle.guessed_corners, 0);

  const Boundary pentagon = split_loop(polygon(5, 50));
  EXPECT_EQ(pentagon.guessed_corners, 0);
  Eigen::Index total = 0;
  for (const Points& side : pentagon.sides)
  {
    total += side.cols() - 1;
    EXPECT_EQ((side.cols() - 1) % 10, 0);
  }
  EXPECT_EQ(total, 50);

  Points house(3, 5); // the apex of the roof is the bluntest of five corners
  house.transpose() << 0, 0, 0, 2, 0, 0, 2, 1, 0, 1, 1.4, 0, 0, 1, 0;
  EXPECT_EQ(split_loop(house).sides[kTop].cols(), 3);

  // A lens has two corners; each of its arcs is cut in the middle.
  Points lens(3, 40);
  for (int i = 0; i < 20; ++i)
  {
    const double x = i / 20.0;
    lens.col(i) << x, -x * (1 - x), 0;
    lens.col(20 + i) << 1 - x, x * (1 - x), 0;
  }
  const Boundary cut = split_loop(lens);
  EXPECT_EQ(cut.guessed_corners, 2);
  for (const Points& side : cut.sides)
  {
    EXPECT_EQ(side.cols(), 11);
  }
  expect_refused([] { split_loop(line({ 0, 0, 0 }, { 1, 0, 0 })); }, BoundaryDefect::Count,
    "loop 0 has 2 points");
}

TEST(Loop, RepeatedPointsAreNoCorners)
{
  Points loop = loop_of(unit_square(5));
  Points doubled(3, 2 * loop.cols());
  for (Eigen::Index i = 0; i < loop.cols(); ++i)
  {
    doubled.col(2 * i) = loop.col(i);
    doubled.col(2 * i + 1) = loop.col(i);
  }
  const Boundary boundary = split_loop(doubled);
  EXPECT_EQ(boundary.guessed_corners, 0);
  EXPECT_TRUE(boundary.sides[kRight].col(0) == Vector3(1, 0, 0));
  EXPECT_TRUE(footpoint::transfinite_grid(boundary).grid.points.allFinite());
}

namespace
{

/// The segments of loops in random order and direction, with points repeated at random.
std::pair<Points, std::vector<std::array<int, 2>>> shuffled_segments(const std::vector<Points>& loops)
{
  std::mt19937 random(5);
  std::vector<Points> ends;
  for (const Points& loop : loops)
  {
    for (Eigen::Index i = 0; i < loop.cols(); ++i)
    {
      Points segment(3, 2);
      segment << loop.col(i), loop.col((i + 1) % loop.cols());
      ends.push_back(random() % 2 != 0 ? reversed(segment) : segment);
    }
  }
  std::shuffle(ends.begin(), ends.end(), random);
  std::vector<std::array<int, 2>> segments;
  for (int k = 0; k < static_cast<int>(ends.size()); ++k)
  {
    segments.push_back({ { 2 * k, 2 * k + 1 } });
  }
  return { joined(ends), segments };
}

std::vector<std::vector<int>> lines_of(const std::vector<std::array<int, 2>>& segments)
{
  std::vector<std::vector<int>> lines;
  for (const auto& segment : segments)
  {
    lines.push_back({ segment[0], segment[1] });
  }
  return lines;
}

} // namespace

TEST(Segments, ShuffledFeatureEdgesBecomeSides)
{
  const auto sides = border([](double s, double t)
    { return Vector3(s + 0.1 * t * t, t, 0.2 * s * t); }, 401, 301);
  const auto [points, segments] = shuffled_segments({ loop_of(sides) });
  EXPECT_EQ(segments.size(), 1400u);
  expect_same(assemble_boundary(points, lines_of(segments)), assemble_sides(sides));
}

TEST(Segments, LoopsChainsAndForks)
{
  const Points small = loop_of(unit_square(5));
  Points large = loop_of(unit_square(9));
  large *= 3.0;
  large.row(0).array() += 5.0;
  const auto [points, segments] = shuffled_segments({ small, large });
  const Chains chains = chain_segments(points, segments);
  ASSERT_EQ(chains.loops.size(), 2u);
  EXPECT_TRUE(chains.open.empty());
  EXPECT_EQ(chains.loops[0].cols(), 32);
  EXPECT_EQ(chains.loops[1].cols(), 16);
  EXPECT_TRUE(chains.loops[1].col(0) == Vector3(0, 0, 0));
  EXPECT_TRUE(chains.loops[1].col(1) == Vector3(0, 0.25, 0));
  const auto lines = lines_of(segments);
  expect_refused([&, &p = points] { assemble_boundary(p, lines); }, BoundaryDefect::Loops,
    "2 closed loops (of 32, 16 points)");

  Points fork(3, 5);
  fork.transpose() << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 2, 2, 0;
  const std::vector<std::vector<int>> forked{ { 0, 1 }, { 1, 2 }, { 2, 3 }, { 3, 0 }, { 2, 4 } };
  expect_refused([&] { assemble_boundary(fork, forked); }, BoundaryDefect::Branch,
    "3 segments meet at point 2 (1, 1, 0)");
  expect_refused([&] { assemble_boundary(fork, { { 0, 1 }, { 1, 2, 3, 4 } }); }, BoundaryDefect::Gap,
    "its ends, points 0 and 4, are 2.83 (1 of the size) apart");
  const Chains repeated = chain_segments(fork, { { { 0, 1 } }, { { 1, 0 } }, { { 1, 1 } } });
  ASSERT_EQ(repeated.open.size(), 1u);
  EXPECT_EQ(repeated.open_ids[0], (std::vector<int>{ 0, 1 }));
}

TEST(Segments, OneClosedLineAndItsCornerIds)
{
  const Points loop = loop_of(unit_square(5));
  std::vector<int> ids(16);
  std::iota(ids.begin(), ids.end(), 0);
  std::rotate(ids.begin(), ids.begin() + 6, ids.end());
  ids.push_back(ids.front());
  expect_same(assemble_boundary(loop, { ids }), split_loop(loop));
  BoundaryOptions options;
  options.corner_ids = { 8, 12, 0, 4 };
  const Boundary turned = assemble_boundary(loop, { ids }, {}, options);
  EXPECT_TRUE(turned.sides[kBottom].col(0) == Vector3(1, 1, 0));
  expect_refused([&] { assemble_boundary(loop, { { 0, 99 } }); }, BoundaryDefect::Count,
    "polyline 0 names the point 99");
}
