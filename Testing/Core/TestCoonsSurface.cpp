// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/grids/coons_surface.h"

#include "footpoint/splines/piecewise_polynomial.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace footpoint;

namespace
{

std::vector<double> clamped(int degree, const std::vector<double>& inner)
{
  std::vector<double> knots(degree + 1, 0.0);
  knots.insert(knots.end(), inner.begin(), inner.end());
  knots.insert(knots.end(), degree + 1, 1.0);
  return knots;
}

/// An arc of the unit circle from angle a to b as rational quadratic.
Curve arc(double a, double b)
{
  Points points(3, 3);
  const double half = 0.5 * (b - a);
  points.col(0) << std::cos(a), std::sin(a), 0.0;
  points.col(1) << std::cos(a + half) / std::cos(half), std::sin(a + half) / std::cos(half), 0.0;
  points.col(2) << std::cos(b), std::sin(b), 0.0;
  return Curve(KnotVector(2, clamped(2, {})), points, Eigen::Vector3d(1.0, std::cos(half), 1.0));
}

Vector3 at(const Curve& curve, double t)
{
  return curve.centre() + curve.point(Parameter<1>(t * curve.direction(0).length));
}

/// The definition, evaluated directly.
Vector3 blend(const std::array<Curve, 4>& c, double s, double t)
{
  return (1 - t) * at(c[0], s) + t * at(c[2], s) + (1 - s) * at(c[3], t) + s * at(c[1], t) -
    (1 - s) * (1 - t) * at(c[0], 0) - s * (1 - t) * at(c[0], 1) - (1 - s) * t * at(c[2], 0) -
    s * t * at(c[2], 1);
}

double largest_difference(const Surface& surface, const std::array<Curve, 4>& curves)
{
  double largest = 0.0;
  for (int i = 0; i <= 20; ++i)
  {
    for (int j = 0; j <= 20; ++j)
    {
      const Vector3 point = surface.centre() + surface.point(Parameter<2>(i / 20.0, j / 20.0));
      largest = std::max(largest, (point - blend(curves, i / 20.0, j / 20.0)).norm());
    }
  }
  return largest;
}

/// A random curve between two points; the weights of its ends are 1.
Curve random_curve(std::mt19937& generator, const Vector3& from, const Vector3& to, int degree,
  const std::vector<double>& inner, bool rational, double origin = 0.0, double length = 1.0)
{
  std::uniform_real_distribution<double> uniform(-0.3, 0.3);
  std::uniform_real_distribution<double> weight(0.3, 3.0);
  std::vector<double> knots = clamped(degree, inner);
  for (double& knot : knots)
  {
    knot = origin + length * knot;
  }
  const int count = static_cast<int>(knots.size()) - degree - 1;
  Points points(3, count);
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(count);
  for (int i = 0; i < count; ++i)
  {
    const double t = i / (count - 1.0);
    points.col(i) = (1 - t) * from + t * to;
    if (i > 0 && i + 1 < count)
    {
      points.col(i) += Vector3(uniform(generator), uniform(generator), uniform(generator));
      weights(i) = weight(generator);
    }
  }
  return Curve(KnotVector(degree, knots), points, rational ? weights : Eigen::VectorXd());
}

} // namespace

TEST(CoonsSurface, DiskOfFourArcsHasBidegreeThreeAndIsExact)
{
  const double q = std::acos(-1.0) / 4.0;
  const std::array<Curve, 4> curves{ arc(5 * q, 7 * q), arc(-q, q), arc(3 * q, q),
    arc(5 * q, 3 * q) };
  const Surface surface = coons_surface(curves);
  EXPECT_EQ(surface.knots(0).degree(), 3);
  EXPECT_EQ(surface.knots(1).degree(), 3);
  EXPECT_LE(largest_difference(surface, curves), 1e-13 * surface.size());
  // Its centre is the circle's, by symmetry.
  EXPECT_LE((surface.centre() + surface.point(Parameter<2>(0.5, 0.5))).norm(), 1e-14);
}

TEST(CoonsSurface, BilinearSaddleIsReproduced)
{
  auto line = [](const Vector3& a, const Vector3& b)
  {
    Points points(3, 2);
    points << a, b;
    return Curve(KnotVector(1, { 0, 0, 1, 1 }), points);
  };
  const Vector3 c00(0, 0, 0), c10(1, 0, 0), c01(0, 1, 0), c11(1, 1, 1);
  const std::array<Curve, 4> curves{ line(c00, c10), line(c10, c11), line(c01, c11),
    line(c00, c01) };
  const Surface surface = coons_surface(curves);
  EXPECT_EQ(surface.knots(0).degree(), 1);
  EXPECT_FALSE(surface.rational());
  const Vector3 middle = surface.centre() + surface.point(Parameter<2>(0.3, 0.6));
  EXPECT_NEAR(middle.z(), 0.18, 1e-15);
}

TEST(CoonsSurface, DegreesKnotsDomainsAndWeightsMayDiffer)
{
  std::mt19937 generator(7);
  const Vector3 c00(0, 0, 0), c10(2, 0, 0.5), c01(-0.2, 1.5, 0), c11(1.8, 1.7, -0.4);
  for (int k = 0; k < 40; ++k)
  {
    const bool rational = k % 2 == 1;
    const std::array<Curve, 4> curves{ random_curve(generator, c00, c10, 3, { 0.25, 0.5, 0.5 },
                                         rational, -3.0, 7.0),
      random_curve(generator, c10, c11, 2, { 0.4 }, false),
      random_curve(generator, c01, c11, 1 + k % 5, { 0.3, 0.7 }, rational && k % 4 == 1),
      random_curve(generator, c00, c01, 4, {}, k % 3 == 1, 1e3, 1.0) };
    const Surface surface = coons_surface(curves);
    ASSERT_LE(largest_difference(surface, curves), 1e-13 * surface.size()) << "case " << k;
  }
}

TEST(CoonsSurface, GapIsRefusedWithSidesAndDistance)
{
  auto line = [](const Vector3& a, const Vector3& b)
  {
    Points points(3, 2);
    points << a, b;
    return Curve(KnotVector(1, { 0, 0, 1, 1 }), points);
  };
  const std::array<Curve, 4> curves{ line({ 0, 0, 0 }, { 1, 0, 0 }),
    line({ 1, 0.25, 0 }, { 1, 1, 0 }), line({ 0, 1, 0 }, { 1, 1, 0 }),
    line({ 0, 0, 0 }, { 0, 1, 0 }) };
  try
  {
    coons_surface(curves);
    FAIL() << "a gap of a quarter was accepted";
  }
  catch (const BoundaryError& error)
  {
    EXPECT_EQ(error.defect(), BoundaryDefect::Gap);
    EXPECT_NE(std::string(error.what()).find("the end of bottom and the start of right are 0.25"),
      std::string::npos)
      << error.what();
  }
}

TEST(PiecewisePolynomial, ElevationRefinementAndProductKeepTheFunction)
{
  std::mt19937 generator(3);
  const Curve curve =
    random_curve(generator, Vector3(0, 0, 0), Vector3(1, 2, 3), 3, { 0.2, 0.6, 0.6, 0.6 }, true);
  const PiecewisePolynomial whole = PiecewisePolynomial::homogeneous(curve);
  const PiecewisePolynomial weight = whole.rows(3, 1);
  const PiecewisePolynomial squared = whole.times(weight); // (w²·C, w²): the same curve
  EXPECT_EQ(squared.degree(), 6);
  const KnotVector knots = common_knots(squared, weight, 7);
  EXPECT_EQ(knots.degree(), 7);
  const Eigen::MatrixXd control = squared.control_points(knots);
  Points points = control.topRows(3);
  for (Eigen::Index i = 0; i < points.cols(); ++i)
  {
    points.col(i) /= control(3, i);
  }
  const Curve again(knots, points, control.row(3).transpose());
  for (int k = 0; k <= 50; ++k)
  {
    ASSERT_LE((at(again, k / 50.0) - at(curve, k / 50.0)).norm(), 1e-13) << k;
  }
}
