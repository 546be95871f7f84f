// SPDX-License-Identifier: BSD-3-Clause
#include "Shapes.h"

#include "footpoint/splines/knot_vector.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

using footpoint::GeometryDefect;
using footpoint::GeometryError;
using footpoint::KnotVector;
using footpoint::Side;

namespace
{

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

void expect_refused(
  int degree, std::vector<double> knots, GeometryDefect defect, const std::string& message)
{
  try
  {
    KnotVector(degree, std::move(knots), "KnotsU");
    FAIL() << "accepted; expected: " << message;
  }
  catch (const GeometryError& error)
  {
    EXPECT_EQ(error.what(), message);
    EXPECT_EQ(error.defect(), defect);
  }
}

} // namespace

TEST(KnotVector, RefusalsNameArrayIndexAndValue)
{
  expect_refused(
    0, { 0, 1 }, GeometryDefect::Degree, "KnotsU has the degree 0; it must be 1 to 30");
  expect_refused(31, std::vector<double>(80), GeometryDefect::Degree,
    "KnotsU has the degree 31; it must be 1 to 30");
  expect_refused(3, { 0, 0, 0, 0, 1, 1, 1 }, GeometryDefect::Count,
    "KnotsU holds 7 knots; degree 3 needs at least 8");
  expect_refused(3, {}, GeometryDefect::Count, "KnotsU holds 0 knots; degree 3 needs at least 8");
  expect_refused(1, { 0, 0, -kNaN, 1 }, GeometryDefect::NotFinite, "KnotsU[2] = nan is not finite");
  expect_refused(
    1, { 0, 0, 1, kInfinity }, GeometryDefect::NotFinite, "KnotsU[3] = inf is not finite");
  expect_refused(1, { -1e308, -1e308, 1e308, 1e308 }, GeometryDefect::NotFinite,
    "KnotsU[3] = 1e+308 minus KnotsU[0] = -1e+308 is not finite");
  expect_refused(3, { 0, 0, 0, 0, 0.25, 0.4, 0.5, 0.3, 1, 1, 1, 1 }, GeometryDefect::Decreasing,
    "KnotsU[7] = 0.3 is smaller than KnotsU[6] = 0.5");
  expect_refused(2, { 0, 0, 0, 0.5, 0.5, 0.5, 0.5, 1, 1, 1 }, GeometryDefect::Multiplicity,
    "KnotsU[3] = 0.5 is repeated 4 times; degree 2 allows 3");
  expect_refused(1, { 0, 1, 1, 2 }, GeometryDefect::EmptyDomain,
    "the domain from KnotsU[1] = 1 to KnotsU[2] = 1 is empty");
  expect_refused(2, { 7, 7, 7, 7, 7, 7 }, GeometryDefect::EmptyDomain,
    "the domain from KnotsU[2] = 7 to KnotsU[3] = 7 is empty");
}

TEST(KnotVector, LargestDegreeIsAccepted)
{
  const KnotVector knots(30, shapes::clamped_knots(30, 3));
  EXPECT_EQ(knots.number_of_control_points(), 33);
  EXPECT_EQ(knots.name(), "Knots");
}

TEST(KnotVector, DomainOfUnclampedKnotsIsBetweenTheInnerOnes)
{
  const KnotVector knots(2, { 1, 2, 3, 5, 5, 8, 9, 10 });
  EXPECT_EQ(knots.number_of_control_points(), 5);
  EXPECT_EQ(knots.domain_start(), 3);
  EXPECT_EQ(knots.domain_end(), 8);
  EXPECT_EQ(knots.length(), 5);
  EXPECT_EQ(knots.local_knots(), (std::vector<double>{ -2, -1, 0, 2, 2, 5, 6, 7 }));
}

TEST(KnotVector, DistinctKnotsCountRepetitionsOfTheWholeVector)
{
  // The start of the domain is a double knot of which one lies before the domain.
  const KnotVector knots(2, { 0, 1, 1, 2, 2, 2, 4, 5, 5, 6 });
  const auto& distinct = knots.distinct_knots();
  ASSERT_EQ(distinct.size(), 4u);
  const std::vector<double> at{ 0, 1, 3, 4 };
  const std::vector<double> parameter{ 1, 2, 4, 5 };
  const std::vector<int> multiplicity{ 2, 3, 1, 2 };
  for (std::size_t i = 0; i < distinct.size(); ++i)
  {
    EXPECT_EQ(distinct[i].at, at[i]);
    EXPECT_EQ(distinct[i].parameter, parameter[i]);
    EXPECT_EQ(distinct[i].multiplicity, multiplicity[i]);
  }
}

TEST(KnotVector, KnotsOneUlpApartAreTwo)
{
  const double above = std::nextafter(1.0, 2.0);
  const KnotVector knots(1, { 0, 0, 1, above, 2, 2 });
  EXPECT_EQ(knots.distinct_knots().size(), 4u);
  EXPECT_EQ(knots.find_span(1.0, Side::Right), 2);
  EXPECT_EQ(knots.find_span(above, Side::Left), 2);
}

TEST(KnotVector, KnotsThatTheSubtractionMergesAreOne)
{
  const KnotVector knots(1, { -1, -1, 1e-20, 2e-20, 3e-20, 1, 1 });
  ASSERT_EQ(knots.distinct_knots().size(), 3u);
  EXPECT_EQ(knots.distinct_knots()[1].multiplicity, 2); // more cannot be: degree + 1
  double values[2];
  knots.basis(knots.find_span(1.0, Side::Left), 1.0, 0, values);
  EXPECT_EQ(values[0] + values[1], 1.0);
}

TEST(KnotVector, SpansAreFoundOnEitherSide)
{
  // Indices                    0  1  2  3  4  5  6  7  8  9
  const KnotVector knots(2, { 0, 0, 0, 1, 1, 1, 3, 4, 4, 4 });
  EXPECT_EQ(knots.find_span(0.5, Side::Left), 2);
  EXPECT_EQ(knots.find_span(0.5, Side::Right), 2);
  EXPECT_EQ(knots.find_span(1.0, Side::Left), 2);
  EXPECT_EQ(knots.find_span(1.0, Side::Right), 5);
  EXPECT_EQ(knots.find_span(3.0, Side::Left), 5);
  EXPECT_EQ(knots.find_span(3.0, Side::Right), 6);
  // At and beyond the ends there is only one side.
  for (const Side side : { Side::Left, Side::Right })
  {
    EXPECT_EQ(knots.find_span(0.0, side), 2);
    EXPECT_EQ(knots.find_span(-7.0, side), 2);
    EXPECT_EQ(knots.find_span(4.0, side), 6);
    EXPECT_EQ(knots.find_span(9.0, side), 6);
    EXPECT_EQ(knots.find_span(kInfinity, side), 6);
    EXPECT_EQ(knots.find_span(-kInfinity, side), 2);
    EXPECT_EQ(knots.find_span(kNaN, side), 2);
  }
}

TEST(KnotVector, SpansOfUnclampedKnotsStayInTheDomain)
{
  const KnotVector knots(2, { 1, 2, 3, 3, 5, 8, 8, 10 });
  EXPECT_EQ(knots.find_span(-2.0, Side::Left), 3); // [3, 3] has no length
  EXPECT_EQ(knots.find_span(0.0, Side::Right), 3);
  EXPECT_EQ(knots.find_span(5.0, Side::Right), 4); // 8 is the end; what follows is outside
  EXPECT_EQ(knots.find_span(7.0, Side::Right), 4);
  // The domain ends with the second of two equal knots; [8, 8] has no length either.
  const KnotVector repeated(1, { 1, 2, 5, 8, 8, 10 });
  for (const Side side : { Side::Left, Side::Right })
  {
    EXPECT_EQ(repeated.find_span(6.0, side), 2);
    EXPECT_EQ(repeated.find_span(7.0, side), 2);
  }
}

TEST(KnotVector, BasisSumsToOneAndDerivativesToZero)
{
  shapes::Random random(1);
  for (int degree = 1; degree <= 30; ++degree)
  {
    const KnotVector knots(degree, shapes::random_knots(random, degree, 5, degree % 2 == 0));
    for (int i = 0; i < 20; ++i)
    {
      const double t = random.uniform(0.0, knots.length());
      double values[4 * 31];
      knots.basis(knots.find_span(t, Side::Right), t, 3, values);
      for (int order = 0; order <= 3; ++order)
      {
        const Eigen::Map<Eigen::VectorXd> row(values + order * (degree + 1), degree + 1);
        const double scale = row.cwiseAbs().maxCoeff();
        EXPECT_NEAR(row.sum(), order == 0 ? 1.0 : 0.0, 1e-14 * std::max(1.0, scale))
          << "degree " << degree << " order " << order;
        if (order == 0)
        {
          EXPECT_GE(row.minCoeff(), 0.0);
        }
      }
    }
  }
}

TEST(KnotVector, BasisOfBezierKnotsIsBernsteins)
{
  const int degree = 20;
  const KnotVector knots(degree, shapes::clamped_knots(degree, 1, 0.0, 3.0));
  for (const double t : { 0.0, 1e-9, 0.1, 1.5, 2.875, 3.0 - 0x1p-39, 3.0 })
  {
    const long double x = t / 3.0L;
    const long double y = (3.0L - t) / 3.0L;
    double values[21];
    knots.basis(degree, t, 0, values);
    long double binomial = 1.0L;
    for (int i = 0; i <= degree; ++i)
    {
      const long double exact = binomial * std::pow(x, i) * std::pow(y, degree - i);
      // Relative accuracy of each value: needed where weights differ by many decades.
      EXPECT_NEAR(values[i], static_cast<double>(exact), 2e-15 * static_cast<double>(exact)) << i;
      binomial = binomial * (degree - i) / (i + 1);
    }
  }
}

TEST(KnotVector, ClampedEndsInterpolateExactly)
{
  for (int degree = 1; degree <= 30; ++degree)
  {
    for (int length = 1; length <= 50; ++length) // 49 · (1 / 49) is not 1
    {
      const KnotVector knots(degree, shapes::clamped_knots(degree, 1, 0.0, length));
      double values[31];
      knots.basis(knots.find_span(0.0, Side::Right), 0.0, 0, values);
      EXPECT_EQ(values[0], 1.0);
      EXPECT_EQ(values[1], 0.0);
      knots.basis(knots.find_span(length, Side::Left), length, 0, values);
      EXPECT_EQ(values[degree], 1.0);
      EXPECT_EQ(values[degree - 1], 0.0);
    }
  }
}

TEST(KnotVector, DerivativesAboveTheDegreeAreZero)
{
  const KnotVector knots(1, { 0, 0, 2, 2 });
  double values[8];
  std::fill_n(values, 8, 7.0);
  knots.basis(1, 0.5, 3, values);
  const std::vector<double> expected{ 0.75, 0.25, -0.5, 0.5, 0, 0, 0, 0 };
  EXPECT_EQ(std::vector<double>(values, values + 8), expected);
}

TEST(KnotVector, BasisIsContinuedOutsideItsSpan)
{
  const KnotVector knots(2, { 0, 0, 0, 1, 2, 2, 2 });
  double values[3];
  knots.basis(2, 1.5, 0, values);                      // the polynomials of [0, 1] at 1.5
  EXPECT_NEAR(values[0], 0.25, 1e-15);                 // (1 − t)²
  EXPECT_NEAR(values[1], 2 * 1.5 - 1.5 * 2.25, 1e-15); // 2t − 3t²/2
  EXPECT_NEAR(values[2], 1.125, 1e-15);                // t²/2
}

TEST(KnotVector, GrevilleAbscissasReproduceTheIdentity)
{
  shapes::Random random(2);
  for (const int degree : { 1, 2, 5, 12 })
  {
    const KnotVector knots(degree, shapes::random_knots(random, degree, 4, false));
    for (int i = 0; i <= 16; ++i)
    {
      const double t = knots.length() * i / 16;
      const int span = knots.find_span(t, Side::Right);
      double values[31];
      knots.basis(span, t, 0, values);
      double sum = 0.0;
      for (int j = 0; j <= degree; ++j)
      {
        sum += values[j] * knots.greville(span - degree + j);
      }
      EXPECT_NEAR(sum, t, 1e-14 * knots.length());
    }
  }
}

TEST(KnotVector, FarDomainHasTheBasisOfItsTwin)
{
  shapes::Random random(3);
  std::vector<double> far{ 1e6, 1e6, 1e6, 1e6 };
  for (int i = 1; i < 9; ++i)
  {
    far.push_back(1e6 + i / 9.0);
  }
  far.insert(far.end(), 4, 1e6 + 1);
  std::vector<double> near;
  for (const double knot : far)
  {
    near.push_back(knot - 1e6);
  }
  const KnotVector a(3, far);
  const KnotVector b(3, near);
  for (int i = 0; i < 100; ++i)
  {
    const double t = random.uniform(0.0, 1.0);
    double x[16];
    double y[16];
    a.basis(a.find_span(t, Side::Right), t, 3, x);
    b.basis(b.find_span(t, Side::Right), t, 3, y);
    EXPECT_EQ(std::vector<double>(x, x + 16), std::vector<double>(y, y + 16));
  }
}
