// SPDX-License-Identifier: BSD-3-Clause
#include "Boundaries.h"

#include "footpoint/grids/boundary.h"
#include "footpoint/grids/transfinite.h"

#include <algorithm>
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
    return sampled(points + 1,
      [&](double t) -> Vector3
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
  expect_refused(
    [] {
      split_loop(line({ 0, 0, 0 }, { 1, 0, 0 }));
    },
    BoundaryDefect::Count, "loop 0 has 2 points");
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
std::pair<Points, std::vector<std::array<int, 2>>> shuffled_segments(
  const std::vector<Points>& loops)
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
  const auto sides =
    border([](double s, double t) { return Vector3(s + 0.1 * t * t, t, 0.2 * s * t); }, 401, 301);
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
    "2 closed loops (32 points through point " + std::to_string(chains.loop_ids[0][0]) +
      "; 16 points through point " + std::to_string(chains.loop_ids[1][0]) +
      ") where one loop is expected");

  Points fork(3, 5);
  fork.transpose() << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 2, 2, 0;
  const std::vector<std::vector<int>> forked{ { 0, 1 }, { 1, 2 }, { 2, 3 }, { 3, 0 }, { 2, 4 } };
  expect_refused([&] { assemble_boundary(fork, forked); }, BoundaryDefect::Branch,
    "3 segments meet at point 2 (1, 1, 0), from points 1, 3, 4; a boundary does not fork");
  auto crossed = forked;
  crossed.push_back({ 0, 2 });
  crossed.push_back({ 1, 4 });
  expect_refused([&] { assemble_boundary(fork, crossed); }, BoundaryDefect::Branch,
    "3 segments meet at point 0 (0, 0, 0), from points 1, 3, 2; so they do at 2 more points: 1, 2");
  Points apart(3, 10);
  apart << Eigen::RowVectorXd::LinSpaced(10, 0, 9), Eigen::MatrixXd::Zero(2, 10);
  expect_refused(
    [&] {
      assemble_boundary(apart, { { 0, 1 }, { 2, 3 }, { 4, 5 }, { 6, 7 }, { 8, 9 } });
    },
    BoundaryDefect::Count,
    "0 closed loops and 5 open chains (2 points from point 0 to 1; 2 points from point 2 to 3; ");
  expect_refused(
    [&] {
      assemble_boundary(fork, { { 0, 1 }, { 1, 2, 3, 4 } });
    },
    BoundaryDefect::Gap, "its ends, points 0 and 4, are 2.83 (1 of the size) apart");
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
  expect_refused(
    [&] {
      assemble_boundary(loop, { { 0, 99 } });
    },
    BoundaryDefect::Count, "polyline 0 names the point 99");
}
