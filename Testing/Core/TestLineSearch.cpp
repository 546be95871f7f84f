// SPDX-License-Identifier: BSD-3-Clause

// All meetings of a line with the geometry, against closed forms and against sign changes along the
// line.

#include "Inversion.h"
#include "OracleShapes.h"

#include <algorithm>
#include <cmath>
#include <functional>

using namespace inversion;
using footpoint::KnotVector;
using footpoint::Surface;

namespace
{

/// Where a function changes its sign, by samples and bisection; less than a sample apart unseen.
std::vector<double> roots(
  const std::function<double(double)>& f, double from, double to, int samples)
{
  std::vector<double> result;
  for (int k = 0; k < samples; ++k)
  {
    double low = from + (to - from) * k / samples;
    double high = from + (to - from) * (k + 1) / samples;
    const bool rising = f(low) <= 0.0;
    if ((f(high) <= 0.0) == rising)
    {
      continue;
    }
    for (int i = 0; i < 80; ++i)
    {
      const double middle = 0.5 * (low + high);
      ((f(middle) <= 0.0) == rising ? low : high) = middle;
    }
    result.push_back(low);
  }
  return result;
}

/// The distances of all meetings, and what they should be.
void expect_distances(const PointInverter& inverter, const Vector3& query,
  std::vector<double> expected, double tolerance)
{
  std::transform(expected.begin(), expected.end(), expected.begin(),
    [](double along) { return std::abs(along); });
  std::sort(expected.begin(), expected.end());
  const std::vector<Foot> feet = inverter.find_all(query);
  ASSERT_EQ(feet.size(), expected.size()) << query.transpose();
  const Vector3 line = inverter.options().fixed_direction;
  for (std::size_t k = 0; k < feet.size(); ++k)
  {
    EXPECT_NEAR(feet[k].distance, expected[k], tolerance);
    EXPECT_TRUE(feet[k].isolated);
    EXPECT_LE((feet[k].point - query).cross(line).norm(), tolerance);
  }
}

/// One meeting with a continuum, at a distance.
void expect_continuum(
  const Model& model, const Vector3& line, const Vector3& query, double distance)
{
  const std::vector<Foot> feet = PointInverter(model, along(line)).find_all(query);
  ASSERT_EQ(feet.size(), 1u) << query.transpose();
  EXPECT_FALSE(feet[0].isolated);
  EXPECT_NEAR(feet[0].distance, distance, 1e-9);
}

} // namespace

TEST(LineSearch, RandomLinesThroughATorus)
{
  shapes::Random random(41);
  int most = 0;
  for (int k = 0; k < 200; ++k)
  {
    const Vector3 query = random.vector(-4, 4);
    const Vector3 line = random.vector(-1, 1).normalized();
    const auto f = [&](double t)
    {
      const Vector3 p = query + t * line;
      const double to_tube = std::hypot(p.x(), p.y()) - 3.0;
      return to_tube * to_tube + p.z() * p.z() - 1.0;
    };
    const std::vector<double> expected = roots(f, -20.0, 20.0, 20000);
    most = std::max(most, static_cast<int>(expected.size()));
    const PointInverter inverter(model_of(shapes::torus()), along(line));
    expect_distances(inverter, query, expected, 1e-9);
  }
  EXPECT_EQ(most, 4);
}

TEST(LineSearch, RandomLinesThroughBumps)
{
  // The net lies over a regular grid, but x(u) is no identity near the clamped ends: both are
  // evaluated by the oracle.
  const Surface surface = shapes::bumpy(12, 5, 0.15);
  const oracle::Spline<2> exact = shapes::spline_of(surface);
  const auto parameter = [&](double x)
  {
    oracle::Real low = 0.0L;
    oracle::Real high = 1.0L;
    for (int i = 0; i < 60; ++i)
    {
      const oracle::Real middle = 0.5L * (low + high);
      (exact.point({ middle, 0.5L })[0] < x ? low : high) = middle;
    }
    return low;
  };
  shapes::Random random(42);
  std::size_t most = 0;
  for (int k = 0; k < 20; ++k)
  {
    const Vector3 from(0.0, random.uniform(0.1, 0.9), random.uniform(-0.08, 0.08));
    const Vector3 to(1.0, random.uniform(0.1, 0.9), random.uniform(-0.08, 0.08));
    const Vector3 line = (to - from).normalized();
    const double length = (to - from).norm();
    const auto f = [&](double t)
    {
      const Vector3 p = from + t * line;
      return static_cast<double>(p.z() - exact.point({ parameter(p.x()), parameter(p.y()) })[2]);
    };
    const std::vector<double> expected = roots(f, 1e-9, length - 1e-9, 400);
    most = std::max(most, expected.size());
    expect_distances(PointInverter(model_of(surface), along(line)), from, expected, 1e-9);
  }
  EXPECT_GE(most, 4u);
}

TEST(LineSearch, LinesThatLieInTheGeometryCountOnce)
{
  // Generators of a cylinder, lines in a plane, a ruling of z = xy, a straight curve: the nearest
  // of their points, where the line enters or at the query itself.
  expect_continuum(model_of(shapes::cylinder()), { 0, 0, 1 }, { 10, 0, 20 }, 10.0);
  expect_continuum(model_of(shapes::cylinder()), { 0, 0, 1 }, { 10, 0, 5 }, 0.0);
  const double root = std::sqrt(50.0);
  expect_continuum(model_of(shapes::cylinder()), { 0, 0, 1 }, { root, root, -13 }, 3.0);
  expect_continuum(model_of(shapes::square()), { 0, 1, 0 }, { 0, -3, 4 }, 3.0);
  expect_continuum(model_of(shapes::square()), { 0, 1, 0.7 }, { 0, -3, -1 }, std::hypot(3.0, 2.1));
  expect_continuum(model_of(shapes::square()), { 0, 1, 0.7 }, { 0, 5, 5 }, 0.0);
  expect_continuum(model_of(shapes::square()), { 0, 1, 0 }, { 0, -3, 0 }, 3.0);
  expect_continuum(model_of(shapes::saddle()), { 1, 0, 0.5 }, { -5, 0.5, -2.5 }, std::hypot(4, 2));
  expect_continuum(model_of(shapes::stalled_line()), { 1, 0, 0 }, { -1, 0, 0 }, 1.0);
  // Beside the generator there is nothing.
  EXPECT_TRUE(
    PointInverter(model_of(shapes::cylinder()), along({ 0, 0, 1 })).find_all({ 0, 0, 5 }).empty());
}

TEST(LineSearch, LinesThatTouchCountOnce)
{
  const auto check = [](const Surface& surface, const Vector3& line, const Vector3& query,
                       const std::vector<double>& expected)
  {
    const std::vector<Foot> feet = PointInverter(model_of(surface), along(line)).find_all(query);
    ASSERT_EQ(feet.size(), expected.size()) << query.transpose();
    for (std::size_t k = 0; k < feet.size(); ++k)
    {
      EXPECT_TRUE(feet[k].isolated);
      EXPECT_NEAR(feet[k].distance, expected[k], 1e-4); // a touch is as long as that
    }
  };
  const double root = std::sqrt(0.5);
  check(shapes::cylinder(), { 0, 1, 0 }, { 10, 3, 5 }, { 3.0 });
  check(shapes::cylinder(), { 0, 1, 1 }, { 10, 1, 5 }, { std::sqrt(2.0) });
  check(shapes::sphere(), { 1, 0, 0 }, { -3, 0, 1 }, { 3.0 });
  check(shapes::sphere(), { 1, 0, 0 }, { -3, root, root }, { 3.0 });
  check(shapes::torus(), { 1, 0, 0 }, { 0, 0, 1 }, { 3.0, 3.0 });
  // A little inside there are two, a little outside there is none.
  check(shapes::sphere(), { 1, 0, 0 }, { -3, 0.6, 0.799999 },
    { 3.0 - std::sqrt(1.0 - 0.36 - 0.799999 * 0.799999),
      3.0 + std::sqrt(1.0 - 0.36 - 0.799999 * 0.799999) });
  check(shapes::sphere(), { 1, 0, 0 }, { -3, 0.6, 0.800001 }, {});
}

TEST(LineSearch, PolesSeamsCornersAndEdges)
{
  const PointInverter sphere(model_of(shapes::sphere()), along({ 0, 0, 1 }));
  expect_distances(sphere, { 0, 0, 3 }, { 2.0, 4.0 }, 1e-9);
  const PointInverter torus(model_of(shapes::torus()), along({ 1, 0, 0 }));
  expect_distances(torus, { 0, 0, 0 }, { 2.0, 2.0, 4.0, 4.0 }, 1e-9);
  const PointInverter square(model_of(shapes::square()), along({ 1, 0, 0 }));
  expect_distances(square, { 5, 0, 0 }, { 5.0 }, 1e-9);
  expect_distances(square, { 5, 0, 3 }, { 5.0 }, 1e-9);
  expect_distances(square, { 5, -1e-6, 3 }, {}, 1e-9);
}

TEST(LineSearch, LinesThroughCurves)
{
  const PointInverter circle(model_of(shapes::circle()), along({ 1, 0, 0 }));
  expect_distances(circle, { 0, 6, 0 }, { 8.0, 8.0 }, 1e-9);
  expect_distances(circle, { 0, 6, 1e-6 }, {}, 1e-9);
  expect_distances(circle, { 0, 11, 0 }, {}, 1e-9);
}

TEST(LineSearch, NothingBeyondTheMaximumDistance)
{
  InversionOptions options = along({ 1, 0, 0 });
  options.maximum_distance = 3.0;
  const PointInverter torus(model_of(shapes::torus()), options);
  expect_distances(torus, { 0, 0, 0.5 }, { 3.0 - std::sqrt(0.75), 3.0 - std::sqrt(0.75) }, 1e-9);
}
