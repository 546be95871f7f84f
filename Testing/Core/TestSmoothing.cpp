// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/grids/smoothing.h"

#include "footpoint/grids/grid_quality.h"
#include "footpoint/grids/untangling.h"
#include "footpoint/splines/curve.h"

#include "GridShapes.h"
#include "SlowBuild.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>

using footpoint::ControlFunctions;
using footpoint::Curve;
using footpoint::Execution;
using footpoint::Grid;
using footpoint::grid_quality;
using footpoint::KnotVector;
using footpoint::Parameter;
using footpoint::Points;
using footpoint::Side;
using footpoint::Sides;
using footpoint::smooth;
using footpoint::Smoothing;
using footpoint::SmoothingBoundary;
using footpoint::SmoothingOptions;
using footpoint::SmoothingResult;
using footpoint::Vector3;
using grid_shapes::Domain;
using grid_shapes::mapped;
using grid_shapes::transfinite;

namespace
{

SmoothingOptions by(Smoothing method)
{
  SmoothingOptions options;
  options.method = method;
  return options;
}

bool on_border(const Grid& grid, Eigen::Index k)
{
  const Eigen::Index i = k % grid.count[0];
  const Eigen::Index j = k / grid.count[0];
  return i == 0 || j == 0 || i == grid.count[0] - 1 || j == grid.count[1] - 1;
}

void expect_same_border(const Grid& a, const Grid& b)
{
  for (Eigen::Index k = 0; k < a.points.cols(); ++k)
  {
    ASSERT_TRUE(!on_border(a, k) || a.points.col(k) == b.points.col(k)) << k;
  }
}

/// Winslow with the figures of the table of 21×21 grids.
void expect_winslow(const Domain& domain, double minimum)
{
  const Grid grid = transfinite(domain, 21, 21);
  const SmoothingResult result = smooth(grid, by(Smoothing::Winslow));
  EXPECT_TRUE(result.converged);
  EXPECT_LE(result.residual, 1e-10);
  EXPECT_LE(result.iterations, 30);
  EXPECT_EQ(result.folds_after, 0);
  EXPECT_NEAR(grid_quality(result.grid).minimum_scaled_jacobian, minimum, 6e-5);
  EXPECT_EQ(result.grid.points.row(2).cwiseAbs().maxCoeff(), 0.0);
  expect_same_border(grid, result.grid);
}

/// Unguarded: every point the mean of its neighbours, until that holds.
Grid plain_laplace(Grid grid)
{
  for (int sweep = 0; sweep < 2000; ++sweep)
  {
    for (Eigen::Index k = 0; k < grid.points.cols(); ++k)
    {
      if (!on_border(grid, k))
      {
        const Points& p = grid.points;
        const Eigen::Index n = grid.count[0];
        const Vector3 mean = 0.25 * (p.col(k - 1) + p.col(k + 1) + p.col(k - n) + p.col(k + n));
        grid.points.col(k) = mean;
      }
    }
  }
  return grid;
}

/// Residual of Winslow's equations at a point, relative to its terms.
double winslow_error(const Grid& grid)
{
  double worst = 0.0;
  const Eigen::Index n = grid.count[0];
  for (Eigen::Index k = 0; k < grid.points.cols(); ++k)
  {
    if (on_border(grid, k))
    {
      continue;
    }
    auto p = [&](int i, int j) -> Vector3 { return grid.points.col(k + i + n * j); };
    const Vector3 u = (p(1, 0) - p(-1, 0)) / 2;
    const Vector3 v = (p(0, 1) - p(0, -1)) / 2;
    const Vector3 uu = p(1, 0) - 2 * p(0, 0) + p(-1, 0);
    const Vector3 vv = p(0, 1) - 2 * p(0, 0) + p(0, -1);
    const Vector3 uv = (p(1, 1) - p(1, -1) - p(-1, 1) + p(-1, -1)) / 4;
    const Vector3 r = v.squaredNorm() * uu - 2 * u.dot(v) * uv + u.squaredNorm() * vv;
    const double lengths = u.norm() * v.norm() * (u.norm() + v.norm());
    worst = std::max(worst, r.norm() / lengths);
  }
  return worst;
}

/// The numbers of an array that follows a key, brackets disregarded.
std::vector<double> numbers_after(const std::string& text, const std::string& key, std::size_t& at)
{
  at = text.find('"' + key + '"', at);
  std::vector<double> result;
  if (at == std::string::npos)
  {
    return result;
  }
  at = text.find('[', at);
  int depth = 0;
  do
  {
    const char c = text[at];
    depth += c == '[' ? 1 : c == ']' ? -1 : 0;
    if (c == '-' || (c >= '0' && c <= '9'))
    {
      char* end = nullptr;
      result.push_back(std::strtod(text.c_str() + at, &end));
      at = std::size_t(end - text.c_str());
    }
    else
    {
      ++at;
    }
  } while (depth > 0);
  return result;
}

/// Four cubic curves head to tail, as the sides of a domain.
Domain read_loop(const std::string& text)
{
  std::vector<Domain::Side> curves;
  std::size_t at = text.find("\"curves\"", text.find("\"cornerGapRel\""));
  while (curves.size() < 4)
  {
    const std::vector<double> knots = numbers_after(text, "knots", at);
    const std::vector<double> poles = numbers_after(text, "cp", at);
    const Eigen::Map<const Eigen::Matrix4Xd> columns(
      poles.data(), 4, Eigen::Index(poles.size() / 4));
    auto curve = std::make_shared<Curve>(KnotVector(3, knots), columns.topRows<3>());
    curves.push_back([curve](double t) -> Vector3
      { return curve->jet(Parameter<1>(t), Sides<1>(Side::Left), 0).point + curve->centre(); });
  }
  return { curves[0], [=](double s) { return curves[2](1 - s); },
    [=](double t) { return curves[3](1 - t); }, curves[1] };
}

Vector3 lifted(const Vector3& p)
{
  return Vector3(p(0), p(1), 0.4 * std::sin(2 * p(0)) * std::cos(1.5 * p(1)));
}

} // namespace

TEST(Smoothing, winslow_reproduces_the_table)
{
  expect_winslow(grid_shapes::swan(), 0.3235);
  expect_winslow(grid_shapes::half_annulus(), 0.9652);
  expect_winslow(grid_shapes::horseshoe(), 0.2324);
  expect_winslow(grid_shapes::disk(), 0.0785);
}

TEST(Smoothing, plain_laplace_folds_what_the_guarded_one_leaves_valid)
{
  const Domain domains[] = { grid_shapes::swan(), grid_shapes::half_annulus(),
    grid_shapes::horseshoe(), grid_shapes::disk() };
  const std::int64_t plain[] = { 60, 116, 116, 0 };
  for (int k = 0; k < 4; ++k)
  {
    const Grid grid = transfinite(domains[k], 21, 21);
    const Grid laplace = plain_laplace(grid);
    EXPECT_EQ(grid_quality(laplace).folded_count, plain[k]) << k;
    const SmoothingResult guarded = smooth(grid, by(Smoothing::Laplacian));
    EXPECT_LE(guarded.folds_after, guarded.folds_before) << k;
    EXPECT_GE(grid_quality(guarded.grid).minimum_scaled_jacobian,
      std::min(-1e-12, grid_quality(grid).minimum_scaled_jacobian))
      << k;
    expect_same_border(grid, guarded.grid);
  }
  const Grid swan = plain_laplace(transfinite(domains[0], 21, 21));
  EXPECT_NEAR(grid_quality(swan).minimum_scaled_jacobian, -1.0, 5e-3);
}

TEST(Smoothing, winslow_solves_its_equations)
{
  const Grid grid = transfinite(grid_shapes::horseshoe(), 34, 23);
  EXPECT_GT(winslow_error(grid), 1e-2);
  EXPECT_LT(winslow_error(smooth(grid, by(Smoothing::Winslow)).grid), 1e-9);
}

TEST(Smoothing, auto_mends_the_swan_and_leaves_valid_grids_alone)
{
  for (const int n : { 11, 21, 40, 65 })
  {
    const SmoothingResult swan = smooth(transfinite(grid_shapes::swan(), n, n));
    EXPECT_GT(swan.folds_before, 0);
    EXPECT_EQ(swan.folds_after, 0) << n;
    EXPECT_TRUE(swan.changed);
  }
  for (const Domain& domain : { grid_shapes::half_annulus(), grid_shapes::horseshoe() })
  {
    const Grid grid = transfinite(domain, 21, 21);
    const SmoothingResult result = smooth(grid);
    EXPECT_FALSE(result.changed);
    EXPECT_TRUE(result.converged);
    EXPECT_EQ(result.grid.points, grid.points);
  }
}

TEST(Smoothing, auto_mends_the_butterfly)
{
  const char* folder = std::getenv("FOOTPOINT_SHARED_DATA");
  std::ifstream file(std::string(folder ? folder : "") + "/coons/gismo__butterfly_bdry.xml.json");
  if (!folder || !file)
  {
    GTEST_SKIP()
      << "FOOTPOINT_SHARED_DATA names no folder with coons/gismo__butterfly_bdry.xml.json";
  }
  std::stringstream text;
  text << file.rdbuf();
  const Domain butterfly = read_loop(text.str());
  for (const int n : { 21, 41, 65 })
  {
    const Grid grid = transfinite(butterfly, n, n);
    const SmoothingResult result = smooth(grid);
    EXPECT_GT(result.folds_before, 0) << n;
    EXPECT_EQ(result.folds_after, 0) << n;
    EXPECT_TRUE(result.converged) << n;
    expect_same_border(grid, result.grid);
  }
}

TEST(Smoothing, auto_keeps_a_grid_that_cannot_be_mended)
{
  // A figure eight: the sides cross.
  Domain crossed = grid_shapes::swan();
  crossed.top = [](double s) { return Vector3(1 - s, 1, 0); };
  crossed.left = [](double t) { return Vector3(t, t, 0); };
  crossed.right = [](double t) { return Vector3(1 - t, t, 0); };
  const Grid grid = transfinite(crossed, 21, 21);
  const SmoothingResult result = smooth(grid);
  EXPECT_GT(result.folds_after, 0);
  EXPECT_LE(result.folds_after, result.folds_before);
}

TEST(Smoothing, solves_large_grids_in_seconds)
{
  const int n = kSlowBuild ? 129 : 257;
  const Grid grid = transfinite(grid_shapes::swan(), n, n);
  const auto start = std::chrono::steady_clock::now();
  const SmoothingResult result = smooth(grid, by(Smoothing::Winslow));
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  RecordProperty("seconds", std::to_string(seconds.count()));
  EXPECT_TRUE(result.converged);
  EXPECT_LE(result.residual, 1e-10);
  EXPECT_LE(result.iterations, 10);
  EXPECT_EQ(result.folds_after, 0);
}

TEST(Smoothing, solves_large_grids_in_space_in_few_steps)
{
  const int n = kSlowBuild ? 65 : 129;
  const Grid grid = mapped(transfinite(grid_shapes::swan(), n, n), lifted);
  const auto start = std::chrono::steady_clock::now();
  const SmoothingResult result = smooth(grid, by(Smoothing::Winslow));
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  RecordProperty("seconds", std::to_string(seconds.count()));
  EXPECT_TRUE(result.converged);
  EXPECT_LE(result.residual, 1e-10);
  EXPECT_LE(result.iterations, 10);
  EXPECT_EQ(result.folds_after, 0);
}

TEST(Smoothing, does_not_depend_on_units_and_place)
{
  const Grid grid = transfinite(grid_shapes::swan(), 21, 21);
  const Grid expected = smooth(grid, by(Smoothing::Winslow)).grid;
  for (const double scale : { 1e-12, 1e12 })
  {
    auto scaled = [&](const Vector3& p) -> Vector3 { return scale * p; };
    const SmoothingResult result = smooth(mapped(grid, scaled), by(Smoothing::Winslow));
    EXPECT_TRUE(result.converged);
    EXPECT_LE((result.grid.points / scale - expected.points).norm(), 1e-9);
  }
  const Eigen::Matrix3d turn =
    Eigen::AngleAxisd(1.1, Vector3(1, -2, 0.5).normalized()).toRotationMatrix();
  const Vector3 offset(1e5, -1e5, 3e4);
  auto moved = [&](const Vector3& p) -> Vector3 { return turn * p + offset; };
  const SmoothingResult result = smooth(mapped(grid, moved), by(Smoothing::Winslow));
  EXPECT_TRUE(result.converged);
  EXPECT_LE((result.grid.points - mapped(expected, moved).points).norm(), 1e-7);
}

TEST(Smoothing, on_a_cylinder_is_the_rolled_planar_result)
{
  // Second order (winslow_equations.h says why not better). The swan's solution has corners that
  // the coarse grids do not resolve: its ratios, .44 at 41 lines and .28 at 81, come down to 1/4;
  // the half-annulus has it at once.
  const Domain domains[] = { grid_shapes::swan(), grid_shapes::half_annulus() };
  const double ratios[2][2] = { { 0.45, 0.29 }, { 0.26, 0.26 } };
  for (int domain = 0; domain < 2; ++domain)
  {
    double before = 0.0;
    for (int k = 0; k < (kSlowBuild ? 2 : 3); ++k)
    {
      const int n = 1 + (20 << k);
      const Grid flat = transfinite(domains[domain], n, n);
      const Grid planar = smooth(flat, by(Smoothing::Winslow)).grid;
      const SmoothingResult result =
        smooth(mapped(flat, grid_shapes::rolled), by(Smoothing::Winslow));
      EXPECT_TRUE(result.converged);
      EXPECT_EQ(result.folds_after, 0);
      const Points difference = result.grid.points - mapped(planar, grid_shapes::rolled).points;
      const double error = difference.colwise().norm().maxCoeff();
      EXPECT_LT(error, k == 0 ? 4e-4 : ratios[domain][k - 1] * before) << domain << ", " << n;
      before = error;
    }
  }
}

TEST(Smoothing, stays_on_the_surface_that_the_grid_samples)
{
  double errors[2];
  for (int k = 0; k < 2; ++k)
  {
    const int n = k == 0 ? 21 : 41;
    const Grid grid = mapped(transfinite(grid_shapes::swan(), n, n), lifted);
    const SmoothingResult result = smooth(grid);
    EXPECT_GT(result.folds_before, 0);
    EXPECT_EQ(result.folds_after, 0);
    EXPECT_TRUE(result.converged);
    expect_same_border(grid, result.grid);
    const Points difference = result.grid.points - mapped(result.grid, lifted).points;
    errors[k] = difference.colwise().norm().maxCoeff();
  }
  EXPECT_LT(errors[0], 5e-3);
  EXPECT_LT(errors[1], 0.25 * errors[0]);
}

TEST(Smoothing, laplacian_in_space_stays_on_the_surface)
{
  const Grid grid = mapped(transfinite(grid_shapes::horseshoe(), 21, 21),
    [](const Vector3& p) -> Vector3 { return grid_shapes::rolled(p / 4); });
  SmoothingOptions options = by(Smoothing::Laplacian);
  options.maximum_iterations = 15;
  const SmoothingResult result = smooth(grid, options);
  EXPECT_EQ(result.folds_after, 0);
  EXPECT_TRUE(result.changed);
  for (Eigen::Index k = 0; k < grid.points.cols(); ++k)
  {
    EXPECT_NEAR(std::hypot(result.grid.points(0, k), result.grid.points(2, k)), 2.0, 2e-3);
  }
}

TEST(Smoothing, control_functions_keep_the_spacing_of_the_sides)
{
  Domain rectangle;
  auto growing = [](double t) { return std::expm1(4 * t) / std::expm1(4.0); };
  rectangle.bottom = [](double s) { return Vector3(3 * s, 0, 0); };
  rectangle.top = [](double s) { return Vector3(3 * s, 1, 0); };
  rectangle.left = [=](double t) { return Vector3(0, growing(t), 0); };
  rectangle.right = [=](double t) { return Vector3(3, growing(t), 0); };
  const Grid grid = transfinite(rectangle, 15, 21);
  SmoothingOptions options = by(Smoothing::Winslow);
  options.control = ControlFunctions::ThomasMiddlecoff;
  const SmoothingResult kept = smooth(grid, options);
  EXPECT_TRUE(kept.converged);
  EXPECT_LE((kept.grid.points - grid.points).cwiseAbs().maxCoeff(), 1e-12);
  const SmoothingResult evened = smooth(grid, by(Smoothing::Winslow));
  EXPECT_GE((evened.grid.points - grid.points).cwiseAbs().maxCoeff(), 0.1);

  // On a curved domain the first layer off the wall stays thin.
  Domain ring = grid_shapes::half_annulus();
  ring.left = [=](double t) { return Vector3(-1 - growing(t), 0, 0); };
  ring.right = [=](double t) { return Vector3(1 + growing(t), 0, 0); };
  const SmoothingResult layers = smooth(transfinite(ring, 31, 21), options);
  EXPECT_TRUE(layers.converged);
  EXPECT_EQ(layers.folds_after, 0);
  const double first = layers.grid.points.col(layers.grid.index(15, 1)).norm() - 1;
  EXPECT_NEAR(first / growing(0.05), 1.0, 0.35);
}

TEST(Smoothing, sliding_sides_meet_grid_lines_at_right_angles)
{
  // A half-annulus whose facing sides are spaced differently: sliding brings the polar grid back.
  Domain skewed = grid_shapes::half_annulus();
  const auto outer = skewed.top;
  skewed.top = [=](double s) { return outer(s + 0.25 * s * (1 - s)); };
  const Grid grid = transfinite(skewed, 25, 13);
  SmoothingOptions options = by(Smoothing::Winslow);
  options.boundary = SmoothingBoundary::Sliding;
  const SmoothingResult result = smooth(grid, options);
  EXPECT_TRUE(result.converged);
  EXPECT_EQ(result.folds_after, 0);
  for (const int corner : { 0, 24, 25 * 12, 25 * 13 - 1 })
  {
    EXPECT_EQ(result.grid.points.col(corner), grid.points.col(corner));
  }
  double worst = 0.0;
  for (int i = 0; i < 25; ++i)
  {
    const Vector3 inner = result.grid.points.col(grid.index(i, 0));
    const Vector3 outer_point = result.grid.points.col(grid.index(i, 12));
    EXPECT_NEAR(inner.norm(), 1.0, 3e-3);
    EXPECT_NEAR(outer_point.norm(), 2.0, 6.7e-3); // the widest chord is 2 (1 − cos 4.65°) inside
    worst = std::max(worst, std::abs(inner.cross(outer_point)(2)) / 2);
  }
  EXPECT_LT(worst, 2e-2);

  options.method = Smoothing::Laplacian;
  const SmoothingResult laplacian = smooth(grid, options);
  EXPECT_EQ(laplacian.folds_after, 0);
  EXPECT_EQ(laplacian.grid.points.col(24), grid.points.col(24));
  EXPECT_NE(laplacian.grid.points.col(grid.index(12, 12)), grid.points.col(grid.index(12, 12)));
}

TEST(Smoothing, can_be_cancelled_and_reports_progress)
{
  const Grid grid = transfinite(grid_shapes::swan(), 81, 81);
  for (const Smoothing method : { Smoothing::Winslow, Smoothing::Laplacian })
  {
    double last = 0.0;
    int calls = 0;
    Execution execution;
    execution.proceed = [&](double fraction)
    {
      EXPECT_GE(fraction, last);
      EXPECT_LE(fraction, 1.0);
      last = fraction;
      return ++calls < 4;
    };
    const SmoothingResult result = smooth(grid, by(method), execution);
    EXPECT_TRUE(result.cancelled);
    EXPECT_FALSE(result.changed);
    EXPECT_FALSE(result.converged);
    EXPECT_EQ(result.grid.points, grid.points);
    EXPECT_EQ(calls, 4);
  }
}

TEST(Smoothing, sliding_takes_tens_of_steps_in_the_plane_and_in_space)
{
  Domain skewed = grid_shapes::half_annulus();
  const auto outer = skewed.top;
  skewed.top = [=](double s) { return outer(s + 0.25 * s * (1 - s)); };
  SmoothingOptions options = by(Smoothing::Winslow);
  options.boundary = SmoothingBoundary::Sliding;
  double before = 0.0;
  for (const int n : { 25, 49 })
  {
    const Grid flat = transfinite(skewed, n, (n + 1) / 2);
    const SmoothingResult plane = smooth(flat, options);
    const SmoothingResult space = smooth(mapped(flat, grid_shapes::rolled), options);
    for (const SmoothingResult& result : { plane, space })
    {
      EXPECT_TRUE(result.converged) << n;
      EXPECT_LE(result.residual, 1e-10);
      EXPECT_LE(result.iterations, 25) << n;
      EXPECT_EQ(result.folds_after, 0);
    }
    // The rolled grid is the planar one, rolled, up to chords for arcs: second order.
    const Points difference = space.grid.points - mapped(plane.grid, grid_shapes::rolled).points;
    const double error = difference.colwise().norm().maxCoeff();
    EXPECT_LT(error, n == 25 ? 6e-3 : 0.3 * before) << n;
    before = error;
  }
}

TEST(Smoothing, untangling_can_be_cancelled_and_reports_progress)
{
  // The sides cross, so that untangling goes on to its last pass.
  Domain crossed = grid_shapes::swan();
  crossed.top = [](double s) { return Vector3(1 - s, 1, 0); };
  crossed.left = [](double t) { return Vector3(t, t, 0); };
  crossed.right = [](double t) { return Vector3(1 - t, t, 0); };
  const Grid grid = transfinite(crossed, 21, 21);
  double last = 0.0;
  int calls = 0;
  Execution execution;
  execution.proceed = [&](double fraction)
  {
    EXPECT_GE(fraction, last);
    EXPECT_LE(fraction, 1.0);
    last = fraction;
    ++calls;
    return true;
  };
  EXPECT_FALSE(smooth(grid, {}, execution).cancelled);
  EXPECT_GT(last, 0.95);
  const int all = calls;

  // Its share of the progress begins where that of Winslow's equations ends, at 0.8.
  calls = 0;
  execution.proceed = [&](double fraction)
  {
    ++calls;
    return fraction < 0.85;
  };
  const SmoothingResult result = smooth(grid, {}, execution);
  EXPECT_TRUE(result.cancelled);
  EXPECT_FALSE(result.changed);
  EXPECT_FALSE(result.converged);
  EXPECT_EQ(result.grid.points, grid.points);
  EXPECT_LT(calls, all);

  calls = 0;
  execution.proceed = [&](double) { return ++calls < 3; };
  const Grid stopped = footpoint::untangled(grid, execution);
  EXPECT_EQ(calls, 3);
  EXPECT_LE(grid_quality(stopped).folded_count, grid_quality(grid).folded_count);
}

TEST(Smoothing, says_when_iterations_run_out)
{
  SmoothingOptions options = by(Smoothing::Winslow);
  options.maximum_iterations = 1;
  EXPECT_FALSE(smooth(transfinite(grid_shapes::swan(), 21, 21), options).converged);
}

TEST(Smoothing, degenerate_grids_come_back)
{
  for (const Smoothing method : { Smoothing::Auto, Smoothing::Laplacian, Smoothing::Winslow })
  {
    for (const std::array<int, 2> count :
      { std::array<int, 2>{ { 2, 2 } }, { { 2, 9 } }, { { 9, 2 } }, { { 1, 5 } }, { { 3, 3 } } })
    {
      const Grid point{ count, Points::Constant(3, count[0] * count[1], 2.5) };
      EXPECT_EQ(smooth(point, by(method)).grid.points, point.points);
      const Grid line{ count,
        Vector3(1, 2, 3) * Eigen::RowVectorXd::LinSpaced(count[0] * count[1], 0, 1) };
      EXPECT_TRUE(smooth(line, by(method)).grid.points.allFinite());
      Grid broken = line;
      broken.points(1, 0) = std::numeric_limits<double>::quiet_NaN();
      EXPECT_FALSE(smooth(broken, by(method)).changed);
    }
    EXPECT_EQ(smooth(Grid(), by(method)).grid.points.size(), 0);
  }
  // A collapsed side.
  Domain fan = grid_shapes::half_ring(0, 0, 1, 1);
  const SmoothingResult result = smooth(transfinite(fan, 21, 21), by(Smoothing::Winslow));
  EXPECT_TRUE(result.converged);
  EXPECT_EQ(result.folds_after, 0);
}
