// SPDX-License-Identifier: BSD-3-Clause
#include "Oracle.h"
#include "Shapes.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

using footpoint::GeometryDefect;
using footpoint::GeometryError;
using footpoint::Jet;
using footpoint::KnotVector;
using footpoint::Parameter;
using footpoint::Points;
using footpoint::Side;
using footpoint::Sides;
using footpoint::Surface;
using footpoint::Vector3;
using oracle::Real;

namespace
{

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

using Place = Parameter<2>;

Jet<2> jet(const Surface& surface, const Place& t, Side u = Side::Right, Side v = Side::Right)
{
  return surface.jet(t, { u, v }, 2);
}

/// Point at parameters of the surface's own domain.
Vector3 place(const Surface& surface, double u, double v)
{
  return surface.point(surface.to_local({ u, v })) + surface.centre();
}

Place random_place(const Surface& surface, shapes::Random& random)
{
  const double u = random.uniform(0.0, surface.direction(0).length);
  return { u, random.uniform(0.0, surface.direction(1).length) };
}

std::array<Real, 2> own_parameters(const Surface& surface, const Place& t)
{
  return { static_cast<Real>(surface.direction(0).origin) + t[0],
    static_cast<Real>(surface.direction(1).origin) + t[1] };
}

void expect_near(const Vector3& a, const Vector3& b, double tolerance)
{
  EXPECT_LE((a - b).norm(), tolerance) << a.transpose() << " against " << b.transpose();
}

template <class Make>
void expect_refused(const Make& make, GeometryDefect defect, const std::string& message)
{
  try
  {
    make();
    FAIL() << "accepted; expected: " << message;
  }
  catch (const GeometryError& error)
  {
    EXPECT_EQ(error.what(), message);
    EXPECT_EQ(error.defect(), defect);
  }
}

double point_error(const Surface& surface, const oracle::Spline<2>& judge, shapes::Random& random,
  const Vector3& centre)
{
  double worst = 0.0;
  for (int i = 0; i < 40; ++i)
  {
    const Place t = random_place(surface, random);
    const oracle::Vector error =
      surface.point(t).cast<Real>() + centre.cast<Real>() - judge.point(own_parameters(surface, t));
    worst = std::max(worst, static_cast<double>(error.norm()) / surface.size());
  }
  return worst;
}

/// Compares all derivatives with differences, relative to the scale of each.
void expect_derivatives(const Surface& surface, const oracle::Spline<2>& judge, const Place& t,
  const Sides<2>& sides, double tolerance, Real step = 0.02L)
{
  static constexpr int kOrders[5][2] = { { 1, 0 }, { 0, 1 }, { 2, 0 }, { 1, 1 }, { 0, 2 } };
  const Jet<2> here = surface.jet(t, sides, 2);
  Eigen::Matrix<double, 3, 5> columns;
  columns << here.first, here.second;
  std::array<int, 2> span;
  std::array<double, 2> length;
  for (int i = 0; i < 2; ++i)
  {
    const KnotVector& knots = surface.knots(i);
    span[i] = knots.find_span(t[i], sides[i]);
    length[i] = knots.local_knots()[span[i] + 1] - knots.local_knots()[span[i]];
  }
  for (int k = 0; k < 5; ++k)
  {
    const std::array<int, 2> orders{ { kOrders[k][0], kOrders[k][1] } };
    const Vector3 exact =
      oracle::derivative<2>(judge, span, own_parameters(surface, t), orders, step).cast<double>();
    const double scale =
      surface.size() / (std::pow(length[0], orders[0]) * std::pow(length[1], orders[1]));
    EXPECT_LE((columns.col(k) - exact).norm(), tolerance * std::max(scale, exact.norm()))
      << "orders " << orders[0] << ", " << orders[1] << " at " << t.transpose() << ", degrees "
      << surface.knots(0).degree() << ", " << surface.knots(1).degree();
  }
}

} // namespace

TEST(Surface, RefusalsNameArrayIndexAndValue)
{
  const KnotVector u(2, { 0, 0, 0, 1, 1, 1 }, "KnotsU");
  const KnotVector v(1, { 0, 0, 1, 2, 3, 3 }, "KnotsV");
  const Points net = Points::Random(3, 12);
  expect_refused([&] { Surface(u, v, net.leftCols(11)); }, GeometryDefect::Count,
    "KnotsU and KnotsV need 3 x 4 = 12 control points; there are 11");
  Points bad = net;
  bad(2, 7) = kNaN;
  expect_refused([&] { Surface(u, v, bad); }, GeometryDefect::NotFinite,
    "control point 7 has the coordinate nan");
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(12);
  expect_refused([&] { Surface(u, v, net, weights.head(5)); }, GeometryDefect::Count,
    "RationalWeights holds 5 values; there are 12 control points");
  weights[3] = -1e-300;
  expect_refused([&] { Surface(u, v, net, weights); }, GeometryDefect::Weight,
    "RationalWeights[3] = -1e-300 is not positive");
  weights[3] = std::numeric_limits<double>::infinity();
  expect_refused([&] { Surface(u, v, net, weights); }, GeometryDefect::NotFinite,
    "RationalWeights[3] = inf is not finite");
}

TEST(Surface, SaddleHasItsClosedForm)
{
  const Surface surface = shapes::saddle();
  for (int j = 0; j <= 8; ++j)
  {
    for (int i = 0; i <= 8; ++i)
    {
      const double x = i / 4.0 - 1.0;
      const double y = j / 4.0 - 1.0;
      EXPECT_EQ(place(surface, x, y), Vector3(x, y, x * y));
      const Jet<2> here = jet(surface, { x + 1.0, y + 1.0 });
      EXPECT_EQ(here.first.col(0), Vector3(1, 0, y));
      EXPECT_EQ(here.first.col(1), Vector3(0, 1, x));
      EXPECT_EQ(here.second.col(0), Vector3(0, 0, 0));
      EXPECT_EQ(here.second.col(1), Vector3(0, 0, 1));
      EXPECT_EQ(here.second.col(2), Vector3(0, 0, 0));
    }
  }
}

TEST(Surface, CuspHasItsClosedForm)
{
  const Surface surface = shapes::cusp();
  for (int i = 0; i <= 20; ++i)
  {
    const double u = i / 10.0 - 1.0;
    const double v = i / 20.0;
    const Jet<2> here = jet(surface, { u + 1.0, v });
    expect_near(here.point + surface.centre(), { u * u, u * u * u, v }, 1e-15);
    expect_near(here.first.col(0), { 2 * u, 3 * u * u, 0 }, 1e-14);
    expect_near(here.second.col(0), { 2, 6 * u, 0 }, 1e-13);
  }
}

TEST(Surface, SphereAndItsDerivatives)
{
  const Surface surface = shapes::sphere(2.0);
  for (int j = 0; j <= 36; ++j)
  {
    for (int i = 0; i <= 36; ++i)
    {
      const Jet<2> here = jet(surface, { 10.0 * i, 5.0 * j });
      const Vector3 p = here.point + surface.centre();
      EXPECT_NEAR(p.norm(), 2.0, 6e-15);
      // |S|² = r², differentiated once and twice.
      EXPECT_LE((here.first.transpose() * p).norm(), 1e-15);
      EXPECT_NEAR(p.dot(here.second.col(0)) + here.first.col(0).squaredNorm(), 0.0, 1e-16);
      EXPECT_NEAR(p.dot(here.second.col(1)) + here.first.col(0).dot(here.first.col(1)), 0.0, 1e-16);
      EXPECT_NEAR(p.dot(here.second.col(2)) + here.first.col(1).squaredNorm(), 0.0, 1e-16);
    }
  }
}

TEST(Surface, TorusIsRound)
{
  const Surface surface = shapes::torus();
  shapes::Random random(21);
  for (int i = 0; i < 1000; ++i)
  {
    const Vector3 p = surface.point(random_place(surface, random)) + surface.centre();
    EXPECT_NEAR(std::hypot(std::hypot(p[0], p[1]) - 3.0, p[2]), 1.0, 6e-15);
  }
}

TEST(Surface, CylinderKeepsItsAngle)
{
  const Surface surface = shapes::cylinder();
  expect_near(place(surface, 0, 5), { 10, 0, 5 }, 1e-14);
  expect_near(place(surface, 90, -5), { 0, 10, -5 }, 1e-14);
  expect_near(place(surface, 270, 10), { 0, -10, 10 }, 1e-14);
  expect_near(place(surface, 45, 0), { 10 * std::sqrt(0.5), 10 * std::sqrt(0.5), 0 }, 1e-14);
}

TEST(Surface, HelicalRibbonIsAHelicoid)
{
  const Surface surface = shapes::helical_ribbon();
  EXPECT_EQ(surface.direction(0).origin, 0.0);
  EXPECT_EQ(surface.direction(0).length, 7.0);
  for (int i = 0; i <= 64 * 7 * 3; ++i)
  {
    const double u = i / 192.0;
    const Vector3 p = place(surface, u, 0.5);
    const double angle = 2.0 * std::acos(-1.0) * u;
    expect_near(
      p, { 0.75 * std::cos(angle), 0.75 * std::sin(angle), 0.25 * u }, i % 3 == 0 ? 1e-14 : 2e-7);
  }
}

TEST(Surface, PointsEqualTheOraclesAtAllDegreesKnotsAndWeights)
{
  shapes::Random random(22);
  for (int degree = 1; degree <= 30; ++degree)
  {
    for (const double decades : { 0.0, 3.0, 6.0 })
    {
      const auto arrays = shapes::random_arrays<2>(
        random, { degree, 1 + (7 * degree) % 20 }, 3, degree % 2 == 0, decades);
      const Surface surface = arrays.geometry();
      EXPECT_LE(point_error(surface, arrays.spline(), random, surface.centre()), 4e-15)
        << "degree " << degree << " decades " << decades;
    }
  }
}

TEST(Surface, DerivativesEqualDifferences)
{
  shapes::Random random(23);
  for (int degree = 1; degree <= 20; ++degree)
  {
    for (const double decades : { 0.0, 3.0, 6.0 })
    {
      const auto arrays = shapes::random_arrays<2>(
        random, { degree, 1 + (3 * degree) % 20 }, 2, degree % 2 == 0, decades);
      const Surface surface = arrays.geometry();
      for (int i = 0; i < 4; ++i)
      {
        Place t;
        for (int k = 0; k < 2; ++k)
        {
          const std::vector<double>& spans = surface.direction(k).spans;
          const int span = (i >> k) & 1;
          t[k] = spans[span] + random.uniform(0.2, 0.8) * (spans[span + 1] - spans[span]);
        }
        expect_derivatives(surface, arrays.spline(), t, { Side::Right, Side::Right }, 1e-8);
      }
    }
  }
}

TEST(Surface, OneSidedJetsWhereKnotLinesCross)
{
  shapes::Random random(24);
  for (int degree = 1; degree <= 6; ++degree)
  {
    const auto arrays = shapes::random_arrays<2>(random, { degree, 7 - degree }, 3, false, 0.5);
    const Surface surface = arrays.geometry();
    for (const double u : surface.direction(0).spans)
    {
      for (const double v : surface.direction(1).spans)
      {
        for (const Side side_u : { Side::Left, Side::Right })
        {
          for (const Side side_v : { Side::Left, Side::Right })
          {
            expect_derivatives(
              surface, arrays.spline(), { u, v }, { side_u, side_v }, 1e-8, 0.004L);
          }
        }
      }
    }
  }
}

TEST(Surface, GapsAreOpenOnTheirLineOnly)
{
  // Two squares, side by side in u, the second lifted by 1.
  const Surface surface(KnotVector(1, { 0, 0, 1, 1, 2, 2 }), KnotVector(1, { 0, 0, 1, 1 }),
    shapes::points({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 0, 1 }, { 2, 0, 1 }, //
      { 0, 1, 0 }, { 1, 1, 0 }, { 1, 1, 1 }, { 2, 1, 1 } }));
  const Vector3& centre = surface.centre();
  EXPECT_EQ(jet(surface, { 1, 0.5 }, Side::Left).point + centre, Vector3(1, 0.5, 0));
  EXPECT_EQ(jet(surface, { 1, 0.5 }, Side::Right).point + centre, Vector3(1, 0.5, 1));
  ASSERT_EQ(surface.direction(0).breaks.size(), 3u);
  EXPECT_TRUE(surface.direction(0).breaks[1].gap);
  EXPECT_EQ(surface.direction(1).breaks.size(), 2u);
}

TEST(Surface, FarDomainIsItsTwinBitForBit)
{
  shapes::Random random(25);
  auto arrays = shapes::random_arrays<2>(random, { 3, 2 }, 5, true, 6.0);
  auto far = arrays;
  for (int k = 0; k < 2; ++k)
  {
    for (std::size_t i = 0; i < far.knots[k].size(); ++i)
    {
      far.knots[k][i] = 1e6 + arrays.knots[k][i] / 3.0; // rounds …
      arrays.knots[k][i] = far.knots[k][i] - 1e6;       // … and this is exact
    }
  }
  const Surface a = arrays.geometry();
  const Surface b = far.geometry();
  for (int i = 0; i < 200; ++i)
  {
    const Place t = random_place(a, random);
    EXPECT_EQ(jet(a, t).point, jet(b, t).point);
    EXPECT_EQ(jet(a, t).second, jet(b, t).second);
  }
}

TEST(Surface, FarAwayNothingIsLostBeyondTheInput)
{
  shapes::Random random(26);
  auto arrays = shapes::random_arrays<2>(random, { 3, 3 }, 4, true, 1.0);
  const Vector3 offset(1e7, 1e7 / 3, -1e7);
  arrays.points.colwise() += offset;
  const Surface surface = arrays.geometry();
  arrays.points.colwise() -= offset; // the rounded control points, moved back exactly
  EXPECT_LE(point_error(surface, arrays.spline(), random, surface.centre() - offset), 4e-15);
}

TEST(Surface, OfOnePointEvaluates)
{
  const Vector3 point(0.1, -0.2, 1e9 / 7);
  const Surface surface(KnotVector(2, shapes::clamped_knots(2, 2)),
    KnotVector(3, shapes::clamped_knots(3, 1)), point.replicate(1, 16));
  EXPECT_EQ(surface.size(), 0.0);
  EXPECT_EQ(place(surface, 0.3, 0.7), point);
  EXPECT_EQ(surface.direction(0).speed, 0.0);
  EXPECT_EQ(jet(surface, { 0.3, 0.7 }).second, (Eigen::Matrix3d::Zero()));
}

TEST(Surface, SpeedsAreMeansPerDirection)
{
  // (u, 1e8·v) over domains of length 1; the lengths of domains count.
  const Surface surface(KnotVector(1, { 0, 0, 1, 1 }), KnotVector(1, { 5, 5, 5.5, 5.5 }),
    shapes::points({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1e8, 0 }, { 1, 1e8, 0 } }));
  EXPECT_NEAR(surface.direction(0).speed, 1.0, 1e-14);
  EXPECT_NEAR(surface.direction(1).speed, 2e8, 1e-6);
  // Of the saddle: mean of 1 + y² over [−1, 1] is 4/3.
  EXPECT_NEAR(shapes::saddle().direction(0).speed, std::sqrt(4.0 / 3.0), 1e-14);
}

TEST(Surface, WithManyPointsIsSetUpQuickly)
{
  const Surface surface = shapes::bumpy(200, 27); // a quadratic algorithm would take minutes
  EXPECT_EQ(surface.direction(0).spans.size(), 198u);
  EXPECT_NEAR(surface.direction(0).speed, surface.direction(1).speed, 0.1);
}
