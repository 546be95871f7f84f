// SPDX-License-Identifier: BSD-3-Clause
#include "Boundaries.h"
#include "InThreads.h"

#include "footpoint/grids/transfinite.h"
#include "footpoint/grids/transfinite_kernel.h"
#include "footpoint/splines/curve.h"

#include <memory>

using namespace boundaries;
using footpoint::assemble_sides;
using footpoint::Blend;
using footpoint::Boundary;
using footpoint::BoundaryDefect;
using footpoint::BoundaryOptions;
using footpoint::Execution;
using footpoint::Grid;
using footpoint::GridParametrization;
using footpoint::kBottom;
using footpoint::kLeft;
using footpoint::kRight;
using footpoint::kTop;
using footpoint::midpoint_subdivision;
using footpoint::OutputMemory;
using footpoint::Ribbons;
using footpoint::transfinite_grid;
using footpoint::transfinite_kernel;
using footpoint::TransfiniteOptions;
using footpoint::TransfiniteResult;

namespace
{

const BoundaryOptions kStrict = []
{
  BoundaryOptions options;
  options.strict = true;
  return options;
}();

Boundary boundary_of(const std::function<Vector3(double, double)>& map, int nu = 21, int nv = 21)
{
  return assemble_sides(border(map, nu, nv), {}, kStrict);
}

TransfiniteOptions own_samples(
  GridParametrization parametrization = GridParametrization::Uniform, Blend blend = Blend::Bilinear)
{
  return { { { 0, 0 } }, parametrization, blend };
}

void expect_map(
  const Grid& grid, const std::function<Vector3(double, double)>& map, double tolerance)
{
  for (int j = 0; j < grid.count[1]; ++j)
  {
    for (int i = 0; i < grid.count[0]; ++i)
    {
      const Vector3 expected = map(i / (grid.count[0] - 1.0), j / (grid.count[1] - 1.0));
      ASSERT_LE((grid.points.col(grid.index(i, j)) - expected).norm(), tolerance) << i << ' ' << j;
    }
  }
}

void expect_border(const Grid& grid, const std::array<Points, 4>& sides)
{
  const int nu = grid.count[0];
  const int nv = grid.count[1];
  for (int i = 0; i < nu; ++i)
  {
    EXPECT_TRUE(grid.points.col(grid.index(i, 0)) == sides[kBottom].col(i)) << i;
    EXPECT_TRUE(grid.points.col(grid.index(i, nv - 1)) == sides[kTop].col(i)) << i;
  }
  for (int j = 0; j < nv; ++j)
  {
    EXPECT_TRUE(grid.points.col(grid.index(0, j)) == sides[kLeft].col(j)) << j;
    EXPECT_TRUE(grid.points.col(grid.index(nu - 1, j)) == sides[kRight].col(j)) << j;
  }
}

/// A map without symmetry that no blend reproduces.
Vector3 wavy(double s, double t)
{
  return { s + 0.2 * std::sin(3 * t) * s, t + 0.1 * std::cos(4 * s), std::exp(s * t) + s * s * t };
}

/// Numbers that grow by the factor 1.5 from 0 to 1.
double growing(double t, int cells)
{
  return (std::pow(1.5, t * cells) - 1.0) / (std::pow(1.5, cells) - 1.0);
}

} // namespace

TEST(Transfinite, ClosedForms)
{
  const auto bilinear = [](double s, double t) { return Vector3(s, t, s * t); };
  expect_map(transfinite_grid(boundary_of(bilinear)).grid, bilinear, 1e-15);

  const auto squares = [](double s, double t) { return Vector3(s, t, s * s * t * t); };
  const Grid grid = transfinite_grid(boundary_of(squares)).grid;
  EXPECT_NEAR(grid.points(2, grid.index(10, 10)), 0.0, 1e-16); // the surface has 1/16
  expect_map(
    grid, [](double s, double t) { return Vector3(s, t, t * s * s + s * t * t - s * t); }, 1e-15);

  const auto swan = [](double u, double v)
  { return Vector3(u * (1 + 2 * v - 2 * v * v), v * (1 - 3 * u + 3 * u * u), 0); };
  expect_map(transfinite_grid(boundary_of(swan)).grid, swan, 1e-15);
}

TEST(Transfinite, ScalesAndOffset)
{
  for (const double scale : { 1e-12, 1.0, 1e12 })
  {
    const auto map = [scale](double s, double t) -> Vector3
    { return scale * Vector3(s, t, s * t); };
    expect_map(transfinite_grid(boundary_of(map)).grid, map, 1e-15 * scale);
  }
  const auto far = [](double s, double t) { return Vector3(1e8 + s, -1e8 + t, 1e8 + s * t); };
  expect_map(transfinite_grid(boundary_of(far)).grid, far, 4e-8); // two units in the last place
}

TEST(Transfinite, SonisParameters)
{
  // The unit square, spaced differently on facing sides: s_b = .5, s_t = .6, t_l = t_r = .3.
  Points bottom(3, 3), top(3, 3), left(3, 3);
  bottom.transpose() << 0, 0, 0, .5, 0, 0, 1, 0, 0;
  top.transpose() << 0, 1, 0, .6, 1, 0, 1, 1, 0;
  left.transpose() << 0, 0, 0, 0, .3, 0, 0, 1, 0;
  Points right = left;
  right.row(0).setOnes();
  const Boundary square = assemble_sides({ bottom, right, top, left }, {}, kStrict);
  const TransfiniteResult blended =
    transfinite_grid(square, own_samples(GridParametrization::ArcLengthBlended));
  EXPECT_NEAR(blended.arc_length_u[4], 0.53, 1e-15);
  EXPECT_NEAR(blended.arc_length_v[4], 0.3, 1e-15);
  EXPECT_LE((blended.grid.points.col(4) - Vector3(0.53, 0.3, 0)).norm(), 1e-15);
  EXPECT_EQ(blended.arc_length_u[1], 0.5);
  EXPECT_EQ(blended.arc_length_u[7], 0.6);

  // Both pairs differ: the lines between facing points cross at Soni's point.
  right(1, 1) = 0.5;
  const TransfiniteResult crossed =
    transfinite_grid(assemble_sides({ bottom, right, top, left }, {}, kStrict),
      own_samples(GridParametrization::ArcLengthBlended));
  const double s = (.5 + .3 * .1) / (1 - .1 * .2);
  EXPECT_LE((crossed.grid.points.col(4) - Vector3(s, .3 + .2 * s, 0)).norm(), 1e-15);

  const TransfiniteResult recorded =
    transfinite_grid(square, own_samples(GridParametrization::ArcLengthRecorded));
  EXPECT_TRUE(recorded.grid.points == transfinite_grid(square, own_samples()).grid.points);
  EXPECT_TRUE(recorded.arc_length_u == blended.arc_length_u);
  EXPECT_EQ(transfinite_grid(square).arc_length_u.size(), 0);
}

TEST(Transfinite, BorderIsTheSidesBitForBit)
{
  const Boundary boundary = boundary_of(wavy, 17, 12);
  for (const auto parametrization : { GridParametrization::Uniform,
         GridParametrization::ArcLengthRecorded, GridParametrization::ArcLengthBlended })
  {
    for (const Blend blend : { Blend::Bilinear, Blend::Bicubic })
    {
      expect_border(
        transfinite_grid(boundary, own_samples(parametrization, blend)).grid, boundary.sides);
    }
  }
}

TEST(Transfinite, GeneralAndHoistedFormAgree)
{
  const Boundary boundary = boundary_of(wavy, 17, 12);
  const Grid hoisted = transfinite_grid(boundary, own_samples()).grid;
  const Grid general =
    transfinite_grid(boundary, own_samples(GridParametrization::ArcLengthRecorded)).grid;
  EXPECT_TRUE(hoisted.points == general.points);
}

TEST(Transfinite, UnequalCounts)
{
  const auto plane = [](double s, double t) { return Vector3(s, t, 0); };
  std::vector<Points> sides = border(plane, 5, 2);
  sides[2] = line({ 0, 1, 0 }, { 1, 1, 0 }, 37);
  sides[1] = line({ 1, 0, 0 }, { 1, 1, 0 }, 1001);
  const Boundary boundary = assemble_sides(sides);
  const Grid grid = transfinite_grid(boundary, own_samples()).grid;
  EXPECT_EQ(grid.count[0], 37);
  EXPECT_EQ(grid.count[1], 1001);
  expect_map(grid, plane, 1e-15);
  const Grid given = transfinite_grid(boundary, { { { 9, 0 } } }).grid;
  EXPECT_EQ(given.count[0], 9);
  expect_map(given, plane, 1e-15);
}

TEST(Transfinite, OpposedGrowthRatios)
{
  const auto sides = [](int cells) -> std::vector<Points>
  {
    const auto along = [cells](double t) { return growing(t, cells); };
    const auto against = [cells](double t) { return 1.0 - growing(1.0 - t, cells); };
    return { sampled(cells + 1, [&](double t) { return Vector3(along(t), 0, 0); }),
      sampled(cells + 1, [&](double t) { return Vector3(1, against(t), 0); }),
      sampled(cells + 1, [&](double t) { return Vector3(against(t), 1, 0); }),
      sampled(cells + 1, [&](double t) { return Vector3(0, along(t), 0); }) };
  };
  const Boundary boundary = assemble_sides(sides(20), {}, kStrict);
  const TransfiniteResult blended =
    transfinite_grid(boundary, own_samples(GridParametrization::ArcLengthBlended));
  EXPECT_TRUE(blended.grid.points.allFinite());
  for (Eigen::Index at = 0; at < blended.grid.points.cols(); ++at)
  {
    // In the unit square arc lengths are coordinates, and blending must give them back.
    EXPECT_NEAR(blended.grid.points(0, at), blended.arc_length_u[at], 1e-14);
    EXPECT_NEAR(blended.grid.points(1, at), blended.arc_length_v[at], 1e-14);
  }
  const Grid even = transfinite_grid(
    boundary, { { { 21, 21 } }, GridParametrization::ArcLengthResampled, Blend::Bilinear })
                      .grid;
  expect_map(
    even, [](double s, double t) { return Vector3(s, t, 0); }, 1e-14);
}

TEST(Transfinite, RepeatedPointsAndCollapsedSides)
{
  std::vector<Points> sides = border(wavy, 6, 6);
  sides[0].col(2) = sides[0].col(3);
  sides[3].col(1) = sides[3].col(0);
  const std::vector<Points> triangle{ sampled(9, [](double t) { return Vector3(t, 0, t * t); }),
    line({ 1, 0, 1 }, { 0.5, 1, 0 }, 9), line({ 0.5, 1, 0 }, { 0, 0, 0 }, 5) };
  for (const auto parametrization :
    { GridParametrization::Uniform, GridParametrization::ArcLengthRecorded,
      GridParametrization::ArcLengthResampled, GridParametrization::ArcLengthBlended })
  {
    for (const Blend blend : { Blend::Bilinear, Blend::Bicubic })
    {
      const auto options = own_samples(parametrization, blend);
      EXPECT_TRUE(transfinite_grid(assemble_sides(sides), options).grid.points.allFinite());
      const Grid grid = transfinite_grid(assemble_sides(triangle), options).grid;
      EXPECT_TRUE(grid.points.allFinite());
      for (int i = 0; i < 9; ++i)
      {
        EXPECT_TRUE(grid.points.col(grid.index(i, 8)) == Vector3(0.5, 1, 0));
      }
    }
  }
}

TEST(Transfinite, ResolutionsAreRefused)
{
  const Boundary boundary = boundary_of(wavy);
  expect_refused(
    [&] {
      transfinite_grid(boundary, { { { 1, 1 } } });
    },
    BoundaryDefect::Resolution, "Resolution[0] = 1; a grid has at least 2 points");
  expect_refused(
    [&] {
      transfinite_grid(boundary, { { { 5, 1 } } });
    },
    BoundaryDefect::Resolution, "Resolution[1] = 1");
  expect_refused(
    [&] {
      transfinite_grid(boundary, { { { -3, 5 } } });
    },
    BoundaryDefect::Resolution, "Resolution[0] = -3");
  EXPECT_EQ(transfinite_grid(boundary, { { { 2, 2 } } }).grid.points.cols(), 4);
}

TEST(Transfinite, KernelIsTheSameForAllMemoryAndThreads)
{
  // Odd counts, so that every other row begins between two pairs; large enough to be streamed.
  const Boundary boundary = boundary_of(wavy, 601, 603);
  const std::size_t size = 3 * 601 * 603;
  std::vector<double> fresh(size + 1), streamed(size + 1), shifted(size + 1), threaded(size + 1);
  transfinite_kernel(boundary.sides, fresh.data());
  transfinite_kernel(boundary.sides, streamed.data(), OutputMemory::Written);
  transfinite_kernel(boundary.sides, shifted.data() + 1, OutputMemory::Written);
  transfinite_kernel(boundary.sides, threaded.data(), OutputMemory::Written, in_threads(2));
  EXPECT_TRUE(fresh == streamed);
  EXPECT_TRUE(std::equal(fresh.begin(), fresh.begin() + size, shifted.begin() + 1));
  EXPECT_TRUE(fresh == threaded);
  for (const int nu : { 2, 3, 4, 5 })
  {
    const Boundary narrow = boundary_of(wavy, nu, 120000);
    std::vector<double> plain(3 * nu * 120000), past(plain.size());
    transfinite_kernel(narrow.sides, plain.data());
    transfinite_kernel(narrow.sides, past.data(), OutputMemory::Written);
    EXPECT_TRUE(plain == past) << nu;
  }
}

TEST(Bicubic, ReproducesWhatCubicTangentsDetermine)
{
  // With the tangents of u²v² the patch is u²v², 1/16 at the centre; so is every bicubic.
  const auto map = [](double s, double t)
  { return Vector3(s + 0.1 * s * s * s * t, t - 0.2 * t * t * s, s * s * t * t); };
  const auto ds = [](double s, double t)
  { return Vector3(1 + 0.3 * s * s * t, -0.2 * t * t, 2 * s * t * t); };
  const auto dt = [](double s, double t)
  { return Vector3(0.1 * s * s * s, 1 - 0.4 * t * s, 2 * s * s * t); };
  Ribbons ribbons;
  ribbons.tangents[kBottom] = sampled(21, [&](double s) { return dt(s, 0); });
  ribbons.tangents[kTop] = sampled(21, [&](double s) { return dt(s, 1); });
  ribbons.tangents[kLeft] = sampled(21, [&](double t) { return ds(0, t); });
  ribbons.tangents[kRight] = sampled(21, [&](double t) { return ds(1, t); });
  const auto options = own_samples(GridParametrization::Uniform, Blend::Bicubic);
  const TransfiniteResult implied = transfinite_grid(boundary_of(map), options, &ribbons);
  expect_map(implied.grid, map, 1e-13);
  EXPECT_LE(implied.twist_incompatibility, 1e-12);

  const auto twist = [](double s, double t) { return Vector3(0.3 * s * s, -0.4 * t, 4 * s * t); };
  ribbons.twists = { { twist(0, 0), twist(1, 0), twist(1, 1), twist(0, 1) } };
  ribbons.given_twists = true;
  expect_map(transfinite_grid(boundary_of(map), options, &ribbons).grid, map, 1e-13);
  ribbons.tangents[kTop] = Points::Zero(3, 7);
  expect_refused([&] { transfinite_grid(boundary_of(map), options, &ribbons); },
    BoundaryDefect::Count, "role 2 has 7 tangents; the grid has 21 points");
}

TEST(Bicubic, EstimatedTangentsReproduceBilinearBlends)
{
  // u²v + uv² is its own bilinear blend; tangents and twists estimated from the border are its own.
  const auto map = [](double s, double t) { return Vector3(s, t, s * s * t + s * t * t); };
  const TransfiniteResult result =
    transfinite_grid(boundary_of(map), own_samples(GridParametrization::Uniform, Blend::Bicubic));
  expect_map(result.grid, map, 1e-13);
  EXPECT_LE(result.twist_incompatibility, 1e-12);
}

TEST(Bicubic, IncompatibleTwistsAreMeasuredAndTangentsStillMet)
{
  const auto plane = [](double s, double t) { return Vector3(s, t, 0); };
  const int count = 401;
  Ribbons ribbons;
  ribbons.tangents[kBottom] =
    sampled(count, [](double s) { return Vector3(0, 1, 2 * s * (1 - s)); });
  ribbons.tangents[kTop] = sampled(count, [](double) { return Vector3(0, 1, 0); });
  ribbons.tangents[kLeft] = sampled(count, [](double t) { return Vector3(1, 0, -t * (1 - t)); });
  ribbons.tangents[kRight] = sampled(count, [](double) { return Vector3(1, 0, 0); });
  const TransfiniteResult result = transfinite_grid(boundary_of(plane, count, count),
    own_samples(GridParametrization::Uniform, Blend::Bicubic), &ribbons);
  // C00: 2 against −1, relative to 2.
  EXPECT_NEAR(result.twist_incompatibility, 1.5, 1e-9);
  const Grid& grid = result.grid;
  const double step = 1.0 / (count - 1);
  const int near = count / 8;
  const auto height = [&](int i, int j) { return grid.points(2, grid.index(i, j)); };
  const auto slope = [&](int i, int j, int di, int dj)
  {
    return (-11 * height(i, j) + 18 * height(i + di, j + dj) - 9 * height(i + 2 * di, j + 2 * dj) +
             2 * height(i + 3 * di, j + 3 * dj)) /
      (6 * step);
  };
  EXPECT_NEAR(slope(near, 0, 0, 1), ribbons.tangents[kBottom](2, near), 1e-4);
  EXPECT_NEAR(slope(0, near, 1, 0), ribbons.tangents[kLeft](2, near), 1e-4);
}

TEST(Transfinite, SidesFromExactCurves)
{
  using footpoint::Curve;
  using footpoint::KnotVector;
  using Pointer = std::shared_ptr<const footpoint::ParametricCurve>;
  Points arc(3, 3);
  arc.transpose() << 1, 0, 0, 1, 1, 0, 0, 1, 0;
  const Pointer quarter = std::make_shared<Curve>(
    KnotVector(2, { 2, 2, 2, 5, 5, 5 }), arc, Eigen::Vector3d(1, M_SQRT1_2, 1));
  Points ends(3, 2);
  ends.transpose() << 0, 0, 7, 3, 0, 7;
  const Pointer straight = std::make_shared<Curve>(KnotVector(1, { 0, 0, 1, 1 }), ends);
  const auto sides =
    footpoint::sample_sides({ { quarter, straight, quarter, straight } }, { { 9, 4 } });
  EXPECT_EQ(sides[kBottom].cols(), 9);
  EXPECT_EQ(sides[kRight].cols(), 4);
  EXPECT_LE((sides[kBottom].col(4) - Vector3(M_SQRT1_2, M_SQRT1_2, 0)).norm(), 1e-15);
  EXPECT_LE((sides[kRight].col(1) - Vector3(1, 0, 7)).norm(), 1e-15);
  for (Eigen::Index i = 0; i < 9; ++i)
  {
    EXPECT_NEAR(sides[kTop].col(i).norm(), 1.0, 1e-15);
  }
  EXPECT_TRUE(sides[kBottom].col(8) == Vector3(0, 1, 0));
  expect_refused(
    [&] {
      footpoint::sample_sides({ { quarter, straight, quarter, straight } }, { { 0, 4 } });
    },
    BoundaryDefect::Resolution, "Resolution[0] = 0");
}

TEST(MidpointSubdivision, PatchesShareTheirLinesAndFillThePolygon)
{
  for (const int n : { 3, 5, 6 })
  {
    std::vector<Points> sides;
    const auto corner = [n](int k)
    { return Vector3(std::cos(2 * M_PI * k / n), std::sin(2 * M_PI * k / n), 0.5); };
    for (int k = 0; k < n; ++k)
    {
      sides.push_back(line(corner(k), corner(k + 1), 4 + k));
    }
    const int cells = 6;
    const std::vector<Grid> grids = midpoint_subdivision(sides, cells);
    ASSERT_EQ(static_cast<int>(grids.size()), n);
    double area = 0.0;
    for (int k = 0; k < n; ++k)
    {
      const Grid& grid = grids[k];
      const Grid& next = grids[(k + 1) % n];
      for (int i = 0; i <= cells; ++i)
      {
        EXPECT_TRUE(grid.points.col(grid.index(cells, i)) == next.points.col(next.index(i, cells)));
      }
      EXPECT_LE((grid.points.col(grid.index(cells, cells)) - Vector3(0, 0, 0.5)).norm(), 1e-15);
      EXPECT_LE((grid.points.col(0) - corner(k)).norm(), 1e-15);
      for (int j = 0; j < cells; ++j)
      {
        for (int i = 0; i < cells; ++i)
        {
          const Vector3 first =
            grid.points.col(grid.index(i + 1, j + 1)) - grid.points.col(grid.index(i, j));
          const Vector3 second =
            grid.points.col(grid.index(i, j + 1)) - grid.points.col(grid.index(i + 1, j));
          const double cell = 0.5 * first.cross(second).z();
          EXPECT_GT(cell, 0.0);
          area += cell;
        }
      }
    }
    EXPECT_NEAR(area, 0.5 * n * std::sin(2 * M_PI / n), 1e-14);
  }
  expect_refused(
    []
    {
      midpoint_subdivision({ line({ 0, 0, 0 }, { 1, 0, 0 }), line({ 1, 0, 0 }, { 0, 1, 0 }),
                             line({ 0, 2, 0 }, { 0, 0, 0 }) },
        3);
    },
    BoundaryDefect::Gap, "the end of side 1 and the start of side 2 are 1 (");
}
