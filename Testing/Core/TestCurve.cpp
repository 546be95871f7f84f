// SPDX-License-Identifier: BSD-3-Clause
#include "Oracle.h"
#include "Shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>

using footpoint::Curve;
using footpoint::GeometryDefect;
using footpoint::GeometryError;
using footpoint::Jet;
using footpoint::KnotVector;
using footpoint::Parameter;
using footpoint::Points;
using footpoint::Side;
using footpoint::Sides;
using footpoint::Vector3;
using oracle::Real;

namespace
{

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

Jet<1> jet(const Curve& curve, double t, int order = 3, Side side = Side::Right)
{
  return curve.jet(Parameter<1>(t), Sides<1>(side), order);
}

Vector3 place(const Curve& curve, double t, Side side = Side::Right)
{
  return jet(curve, t, 0, side).point + curve.centre();
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

/// Largest distance of the point at many parameters from the oracle's, relative to the size.
double point_error(
  const Curve& curve, const oracle::Spline<1>& judge, shapes::Random& random, const Vector3& centre)
{
  double worst = 0.0;
  for (int i = 0; i < 60; ++i)
  {
    const double t = i == 0 ? 0.0
      : i == 1              ? curve.knots().length()
                            : random.uniform(0.0, curve.knots().length());
    const Real parameter = static_cast<Real>(curve.knots().domain_start()) + t;
    const oracle::Vector error = jet(curve, t, 0).point.cast<Real>() + centre.cast<Real>() -
      judge.point({ parameter }, { i == 1 });
    worst = std::max(worst, static_cast<double>(error.norm()) / curve.size());
  }
  return worst;
}

/// Compares all derivatives at t with differences, relative to the largest scale of each order.
void expect_derivatives(const Curve& curve, const oracle::Spline<1>& judge, double t, Side side,
  double tolerance, Real step = 0.02L)
{
  const int span = curve.knots().find_span(t, side);
  const double length = curve.knots().local_knots()[span + 1] - curve.knots().local_knots()[span];
  const Jet<1> here = jet(curve, t, 3, side);
  const Vector3 columns[3] = { here.first, here.second, here.third };
  const Real parameter = static_cast<Real>(curve.knots().domain_start()) + t;
  double scale = curve.size() / length;
  for (int order = 1; order <= 3; ++order, scale *= curve.knots().degree() / length)
  {
    const Vector3 exact =
      oracle::derivative<1>(judge, { span }, { parameter }, { order }, step).cast<double>();
    EXPECT_LE((columns[order - 1] - exact).norm(), tolerance * std::max(scale, exact.norm()))
      << "order " << order << " at " << t << " of degree " << curve.knots().degree();
  }
}

} // namespace

TEST(Curve, RefusalsNameArrayIndexAndValue)
{
  const KnotVector cubic(3, { 0, 0, 0, 0, 1, 1, 1, 1 }, "KnotsU");
  const KnotVector longer(3, { 0, 0, 0, 0, 0.5, 1, 1, 1, 1 }, "KnotsU");
  const Points four = Points::Random(3, 4);
  expect_refused([&] { Curve(longer, four); }, GeometryDefect::Count,
    "KnotsU holds 9 knots; degree 3 and 4 control points need 8");
  expect_refused([&] { Curve(cubic, Points(3, 0)); }, GeometryDefect::Count,
    "KnotsU holds 8 knots; degree 3 and 0 control points need 4");
  Points five = Points::Random(3, 5);
  five(1, 4) = kNaN;
  expect_refused([&] { Curve(longer, five); }, GeometryDefect::NotFinite,
    "control point 4 has the coordinate nan");
  five(1, 4) = -std::numeric_limits<double>::infinity();
  expect_refused([&] { Curve(longer, five); }, GeometryDefect::NotFinite,
    "control point 4 has the coordinate -inf");
  expect_refused([&] { Curve(cubic, four, Eigen::Vector3d(1, 1, 1)); }, GeometryDefect::Count,
    "RationalWeights holds 3 values; there are 4 control points");
  expect_refused([&] { Curve(cubic, four, Eigen::Vector4d(1, 1, 1, -1)); }, GeometryDefect::Weight,
    "RationalWeights[3] = -1 is not positive");
  expect_refused([&] { Curve(cubic, four, Eigen::Vector4d(1, 0, 1, -1)); }, GeometryDefect::Weight,
    "RationalWeights[1] = 0 is not positive");
  expect_refused([&] { Curve(cubic, four, Eigen::Vector4d(1, 1, kNaN, 1)); },
    GeometryDefect::NotFinite, "RationalWeights[2] = nan is not finite");
}

TEST(Curve, ParabolaHasItsClosedForm)
{
  const Curve curve = shapes::parabola();
  for (int i = 0; i <= 64; ++i)
  {
    const double t = i / 32.0;
    const double x = t - 1.0;
    const Jet<1> here = jet(curve, t);
    expect_near(here.point + curve.centre(), { x, x * x, 0 }, 1e-15);
    expect_near(here.first, { 1, 2 * x, 0 }, 1e-14);
    expect_near(here.second, { 0, 2, 0 }, 1e-13);
    expect_near(here.third, { 0, 0, 0 }, 0.0);
  }
}

TEST(Curve, StalledLineHasItsClosedForm)
{
  const Curve curve = shapes::stalled_line();
  for (const double t : { 0.0, 1e-3, 0.1, 0.7, 1.0 })
  {
    const Jet<1> here = jet(curve, t);
    expect_near(here.point + curve.centre(), { t * t * t, 0, 0 }, 3e-16);
    expect_near(here.first, { 3 * t * t, 0, 0 }, 1e-15);
    expect_near(here.second, { 6 * t, 0, 0 }, 1e-14);
    expect_near(here.third, { 6, 0, 0 }, 1e-14);
  }
}

TEST(Curve, CircleIsRoundToRounding)
{
  const double radius = 10.0;
  const Curve curve = shapes::circle(radius);
  EXPECT_TRUE(curve.rational());
  for (int i = 0; i <= 1000; ++i)
  {
    const Jet<1> here = jet(curve, 0.36 * i);
    const Vector3 p = here.point + curve.centre();
    EXPECT_NEAR(p.norm(), radius, 4e-15 * radius);
    EXPECT_NEAR(p.dot(here.first), 0.0, 1e-14 * radius * here.first.norm());
    // |C|² = r² differentiated twice and thrice.
    EXPECT_NEAR(p.dot(here.second) + here.first.squaredNorm(), 0.0, 1e-14);
    EXPECT_NEAR(p.dot(here.third) + 3.0 * here.first.dot(here.second), 0.0, 1e-14);
  }
}

TEST(Curve, EqualWeightsAreDropped)
{
  const KnotVector knots(2, { 0, 0, 0, 1, 1, 1 });
  const Points net = Points::Random(3, 3);
  const Curve weighted(knots, net, Eigen::Vector3d(0.3, 0.3, 0.3));
  EXPECT_FALSE(weighted.rational());
  EXPECT_EQ(weighted.weights().size(), 0);
  EXPECT_EQ(jet(weighted, 0.4).third, jet(Curve(knots, net), 0.4).third);
  const Eigen::Vector3d unequal(0.3, 0.3, 0.31);
  EXPECT_EQ(Curve(knots, net, unequal).weights(), unequal);
}

TEST(Curve, PointsEqualTheOraclesAtAllDegreesKnotsAndWeights)
{
  shapes::Random random(11);
  double worst = 0.0;
  for (int degree = 1; degree <= 30; ++degree)
  {
    for (const double decades : { 0.0, 3.0, 6.0 })
    {
      const auto arrays = shapes::random_arrays<1>(random, { degree }, 5, degree % 2 == 0, decades);
      const Curve curve = arrays.geometry();
      worst = std::max(worst, point_error(curve, arrays.spline(), random, curve.centre()));
    }
  }
  EXPECT_LE(worst, 4e-15);
}

TEST(Curve, DerivativesEqualDifferences)
{
  shapes::Random random(12);
  for (int degree = 1; degree <= 20; ++degree)
  {
    for (const double decades : { 0.0, 3.0, 6.0 })
    {
      const auto arrays = shapes::random_arrays<1>(random, { degree }, 3, degree % 2 == 0, decades);
      const Curve curve = arrays.geometry();
      const std::vector<double>& spans = curve.direction(0).spans;
      for (std::size_t i = 0; i + 1 < spans.size(); ++i)
      {
        const double t = spans[i] + random.uniform(0.2, 0.8) * (spans[i + 1] - spans[i]);
        expect_derivatives(curve, arrays.spline(), t, Side::Right, 1e-9);
      }
    }
  }
}

TEST(Curve, OneSidedJetsAtEveryKnot)
{
  shapes::Random random(13);
  for (int degree = 1; degree <= 12; ++degree)
  {
    for (const double decades : { 0.0, 0.5 })
    {
      const auto arrays = shapes::random_arrays<1>(random, { degree }, 5, false, decades);
      const Curve curve = arrays.geometry();
      const std::vector<double>& spans = curve.direction(0).spans;
      for (std::size_t i = 0; i < spans.size(); ++i)
      {
        for (const Side side : { Side::Left, Side::Right })
        {
          expect_derivatives(curve, arrays.spline(), spans[i], side, 1e-8, 0.004L);
          const bool left = i > 0 && (side == Side::Left || i + 1 == spans.size());
          const Vector3 exact =
            arrays.spline().point({ curve.direction(0).knots[i] }, { left }).cast<double>();
          expect_near(place(curve, spans[i], side), exact, 3e-15 * curve.size());
        }
      }
    }
  }
}

TEST(Curve, TentHasTwoTangentsAtItsKink)
{
  const Curve curve = shapes::tent();
  EXPECT_EQ(place(curve, 1.0, Side::Left), Vector3(1, 1, 0));
  EXPECT_EQ(place(curve, 1.0, Side::Right), Vector3(1, 1, 0));
  EXPECT_EQ(jet(curve, 1.0, 3, Side::Left).first, Vector3(1, 1, 0));
  EXPECT_EQ(jet(curve, 1.0, 3, Side::Right).first, Vector3(1, -1, 0));
  EXPECT_EQ(jet(curve, 1.0, 3, Side::Right).third, Vector3(0, 0, 0));
  const auto& breaks = curve.direction(0).breaks;
  ASSERT_EQ(breaks.size(), 3u);
  EXPECT_EQ(breaks[1].at, 1.0);
  EXPECT_FALSE(breaks[1].gap);
}

TEST(Curve, GapHasTwoEnds)
{
  const Curve curve = shapes::line_with_gap();
  EXPECT_EQ(place(curve, 1.0, Side::Left), Vector3(1, 0, 0));
  EXPECT_EQ(place(curve, 1.0, Side::Right), Vector3(1, 1, 0));
  const auto& breaks = curve.direction(0).breaks;
  ASSERT_EQ(breaks.size(), 3u);
  EXPECT_FALSE(breaks[0].gap);
  EXPECT_TRUE(breaks[1].gap);
  EXPECT_FALSE(breaks[2].gap);
}

TEST(Curve, BreaksAreKnotsOfMultiplicityDegreeAndMore)
{
  // Cubic: single, double, triple (C0) and quadruple (gap) knots inside.
  const Curve curve = shapes::polynomial_curve(
    3, { 5, 5, 5, 5, 6, 7, 7, 8, 8, 8, 9, 9, 9, 9, 10, 10, 10, 10 }, Points::Random(3, 14));
  const footpoint::Direction& u = curve.direction(0);
  EXPECT_EQ(u.origin, 5.0);
  EXPECT_EQ(u.length, 5.0);
  EXPECT_EQ(u.spans, (std::vector<double>{ 0, 1, 2, 3, 4, 5 }));
  EXPECT_EQ(u.knots, (std::vector<double>{ 5, 6, 7, 8, 9, 10 }));
  ASSERT_EQ(u.breaks.size(), 4u);
  const double at[] = { 0, 3, 4, 5 };
  const bool gap[] = { false, false, true, false };
  for (int i = 0; i < 4; ++i)
  {
    EXPECT_EQ(u.breaks[i].at, at[i]);
    EXPECT_EQ(u.breaks[i].gap, gap[i]);
  }
}

TEST(Curve, FarDomainIsItsTwinBitForBit)
{
  shapes::Random random(14);
  auto arrays = shapes::random_arrays<1>(random, { 4 }, 6, true, 3.0);
  auto far = arrays;
  for (std::size_t i = 0; i < far.knots[0].size(); ++i)
  {
    far.knots[0][i] = 1e6 + arrays.knots[0][i] / 3.0; // rounds …
    arrays.knots[0][i] = far.knots[0][i] - 1e6;       // … and this is exact
  }
  const Curve a = arrays.geometry();
  const Curve b = far.geometry();
  for (int i = 0; i < 200; ++i)
  {
    const double t = random.uniform(0.0, a.knots().length());
    EXPECT_EQ(jet(a, t).point, jet(b, t).point);
    EXPECT_EQ(jet(a, t).third, jet(b, t).third);
  }
}

TEST(Curve, FarAwayNothingIsLostBeyondTheInput)
{
  shapes::Random random(15);
  for (const Vector3& offset : { Vector3(1e7, -1e7, 1e7), Vector3(3e7 / 7, 1e7, 0) })
  {
    auto arrays = shapes::random_arrays<1>(random, { 3 }, 6, true, 1.0);
    arrays.points.colwise() += offset;
    const Curve curve = arrays.geometry();
    // The rounded control points, moved back exactly.
    arrays.points.colwise() -= offset;
    EXPECT_LE(point_error(curve, arrays.spline(), random, curve.centre() - offset), 4e-15);
    arrays.points.colwise() += offset;
    EXPECT_EQ(Points(curve.local_control_points().colwise() + curve.centre()), arrays.points);
  }
}

TEST(Curve, CentreLiesNearTheMiddleOfTheBox)
{
  shapes::Random random(16);
  for (const double scale : { 1e-170, 1e-3, 1.0, 1e5, 1e170 })
  {
    auto arrays = shapes::random_arrays<1>(random, { 3 }, 6, true, 0.0);
    arrays.points.colwise() += random.vector(-10.0, 10.0);
    arrays.points *= scale;
    const Curve curve = arrays.geometry();
    const Points& net = arrays.points;
    const Vector3 extent = net.rowwise().maxCoeff() - net.rowwise().minCoeff();
    EXPECT_NEAR(curve.size(), extent.stableNorm(), 1e-15 * curve.size());
    EXPECT_LE(curve.local_control_points().cwiseAbs().maxCoeff(), 0.7 * curve.size());
    EXPECT_GT(curve.direction(0).speed, 0.1 * curve.size());
    EXPECT_LT(curve.direction(0).speed, 10.0 * curve.size());
  }
}

TEST(Curve, NearTheOriginControlPointsStayAsTheyAre)
{
  const Points net =
    shapes::points({ { -1, -0.3, 0.1 }, { 1e-17, 0.4, 1e-20 }, { 1.1, 0.1, -0.3 } });
  const Curve curve = shapes::polynomial_curve(2, { 0, 0, 0, 1, 1, 1 }, net);
  EXPECT_EQ(curve.centre(), Vector3(0, 0, 0));
  EXPECT_EQ(curve.local_control_points(), net);
}

TEST(Curve, OfOnePointEvaluates)
{
  const Vector3 point(7.1, 1e7 / 3, -2e-300);
  const Curve curve =
    shapes::polynomial_curve(3, shapes::clamped_knots(3, 2), point.replicate(1, 5));
  EXPECT_EQ(curve.size(), 0.0);
  EXPECT_EQ(curve.direction(0).speed, 0.0);
  EXPECT_EQ(place(curve, 0.3), point);
  EXPECT_EQ(jet(curve, 0.3).third, Vector3(0, 0, 0));
}

TEST(Curve, KnotsReturnUnchangedFromLocalParameters)
{
  shapes::Random random(17);
  int roundings = 0;
  for (int i = 0; i < 200; ++i)
  {
    std::vector<double> knots;
    for (int k = 0; k < 6; ++k)
    {
      knots.push_back(random.uniform(-1.0, 1.0) * random.magnitude(2.0));
    }
    std::sort(knots.begin(), knots.end());
    const Curve curve = shapes::polynomial_curve(1, knots, Points::Random(3, 4));
    for (int k = 1; k < 5; ++k)
    {
      const double local = curve.to_local(Parameter<1>(knots[k]))[0];
      EXPECT_EQ(local, curve.direction(0).spans[k - 1]);
      EXPECT_EQ(curve.to_domain(Parameter<1>(local))[0], knots[k]);
      roundings += local + knots[1] != knots[k];
      // From beside a knot rounding never leads across it.
      const double before = curve.to_domain(Parameter<1>(std::nextafter(local, -1e9)))[0];
      const double after = curve.to_domain(Parameter<1>(std::nextafter(local, 1e9)))[0];
      EXPECT_LE(k == 1 ? -100.0 : before, knots[k]);
      EXPECT_GE(k == 4 ? 100.0 : after, knots[k]);
    }
  }
  EXPECT_GT(roundings, 20); // else the above says nothing
}

TEST(Curve, ParametersOutsideTheDomainAreNotClamped)
{
  const Curve curve =
    shapes::polynomial_curve(1, { 0.5, 0.5, 2, 2 }, shapes::points({ { 0, 0, 0 }, { 1, 0, 0 } }));
  EXPECT_EQ(curve.to_domain(Parameter<1>(100.0))[0], 100.5);
  EXPECT_EQ(curve.to_domain(Parameter<1>(-1.0))[0], -0.5);
  EXPECT_EQ(curve.to_local(Parameter<1>(-3.0))[0], -3.5);
  EXPECT_EQ(curve.to_local(Parameter<1>(7.0))[0], 6.5);
}

TEST(Curve, SpeedIsTheMeanOfTheDerivative)
{
  const Curve line =
    shapes::polynomial_curve(1, { 2, 2, 6, 6 }, shapes::points({ { 0, 0, 0 }, { 0, 8, 0 } }));
  EXPECT_NEAR(line.direction(0).speed, 2.0, 1e-15);
  // ∫ 1 + 4x² over [−1, 1], halved: 1 + 4/3
  EXPECT_NEAR(shapes::parabola().direction(0).speed, std::sqrt(7.0 / 3.0), 1e-14);
  // Spans count by their length: speed 1 over a length of 3, speed 7 over 1.
  const Curve uneven = shapes::polynomial_curve(
    1, { 0, 0, 3, 4, 4 }, shapes::points({ { 0, 0, 0 }, { 3, 0, 0 }, { 10, 0, 0 } }));
  EXPECT_NEAR(uneven.direction(0).speed, std::sqrt((3.0 + 49.0) / 4.0), 1e-14);
  // Of many spans a selection stands for all: (t², 0) on [0, 1] has the mean of 4t², 4/3.
  Points many(3, 101);
  for (int i = 0; i <= 100; ++i)
  {
    many.col(i) = Vector3(i * i / 1e4, 0, 0);
  }
  const Curve growing = shapes::polynomial_curve(1, shapes::clamped_knots(1, 100), many);
  EXPECT_NEAR(growing.direction(0).speed, std::sqrt(4.0 / 3.0), 0.05);
}
