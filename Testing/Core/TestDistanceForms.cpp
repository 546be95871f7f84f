// SPDX-License-Identifier: BSD-3-Clause
#include "OnlyTarget.h"
#include "Oracle.h"
#include "Shapes.h"

#include "footpoint/search/distance_form-inl.h"
#include "footpoint/search/distance_forms.h"

#include <gtest/gtest.h>

using footpoint::Curve;
using footpoint::DistanceForms;
using footpoint::KnotVector;
using footpoint::Piece;
using footpoint::PieceShape;
using footpoint::PieceSide;
using footpoint::Surface;
using footpoint::Vector3;
using footpoint::HWY_NAMESPACE::distance_form;
using footpoint::HWY_NAMESPACE::halve;
using footpoint::HWY_NAMESPACE::is_convex;
using footpoint::HWY_NAMESPACE::PieceQuery;
using footpoint::HWY_NAMESPACE::Slopes;
using footpoint::HWY_NAMESPACE::slopes_of;
using oracle::Real;

namespace
{

const std::array<std::array<bool, 2>, 2> kNoneSpecial{};

/// What a rounding is, in units of which PieceShape counts.
constexpr Real kRounding = 0x1p-53L;

DistanceForms forms_of(const Surface& surface)
{
  DistanceForms forms;
  forms.add(0, surface, Vector3::Zero(), kNoneSpecial);
  return forms;
}

DistanceForms forms_of(const Curve& curve)
{
  DistanceForms forms;
  forms.add(0, curve, Vector3::Zero(), kNoneSpecial);
  return forms;
}

/// Coefficient (m, n) of Q, Wx, Wy, Wz and W2 of a piece, from its net in long double.
std::array<Real, 5> products_of(const Piece& piece, int m, int n)
{
  const PieceShape& shape = *piece.shape;
  const auto binomial = [](int of, int k)
  {
    Real result = 1.0L;
    for (int i = 1; i <= k; ++i)
    {
      result = result * (of - k + i) / i;
    }
    return result;
  };
  const int p = shape.degree[0];
  const int q = shape.degree[1];
  const auto control = [&](int i, int j, int k) -> Real
  { return piece.net[(i * (q + 1) + j) * 4 + k]; };
  std::array<Real, 5> sums{};
  for (int i = std::max(0, m - p); i <= std::min(p, m); ++i)
  {
    for (int j = std::max(0, n - q); j <= std::min(q, n); ++j)
    {
      const Real factor = binomial(p, i) * binomial(p, m - i) * binomial(q, j) *
        binomial(q, n - j) / (binomial(2 * p, m) * binomial(2 * q, n));
      const Real w = control(i, j, 3);
      sums[4] += factor * w * control(m - i, n - j, 3);
      for (int k = 0; k < 3; ++k)
      {
        sums[0] += factor * control(i, j, k) * control(m - i, n - j, k);
        sums[1 + k] += factor * w * control(m - i, n - j, k);
      }
    }
  }
  return sums;
}

/// Calls visit(k, products) for number k of a form and the coefficients of the products there.
template <class Visit>
void for_each_coefficient(const Piece& piece, const Visit& visit)
{
  const PieceShape& shape = *piece.shape;
  for (int m = 0; m < shape.rows; ++m)
  {
    for (int n = 0; n < shape.stride; ++n)
    {
      // Padded by the last one.
      visit(m * shape.stride + n, products_of(piece, m, std::min(n, shape.columns - 1)));
    }
  }
}

/// Every coefficient of all forms of a piece: the largest difference over what
/// Documentation/CertifiedSearch.md allows, (W2 coefficient) × roundings × reach^(2, 1, 0).
double coefficient_error(const Piece& piece)
{
  const PieceShape& shape = *piece.shape;
  Real worst = 0.0L;
  for_each_coefficient(piece,
    [&](int k, const std::array<Real, 5>& products)
    {
      for (int form = 0; form < shape.number_of_forms; ++form)
      {
        const Real value = piece.forms[form * shape.form_size + k];
        const Real size = form == 0 ? piece.reach * piece.reach : form == 4 ? 1.0L : piece.reach;
        const Real allowed = products[4] * shape.roundings * kRounding * size;
        EXPECT_TRUE(std::isfinite(value));
        worst = std::max(worst, std::abs(value - products[form]) / allowed);
      }
    });
  return static_cast<double>(worst);
}

/// The distance form of a piece for a query as far from it as its size times a power of ten, the
/// largest difference over what is allowed: (W2 coefficient) × roundings × what the terms are at
/// the most.
double distance_form_error(shapes::Random& random, const Piece& piece)
{
  const PieceShape& shape = *piece.shape;
  const double far = piece.reach * std::pow(10.0, random.uniform(-2.0, 3.0));
  const Vector3 p = far * random.vector(-1.0, 1.0);
  PieceQuery query;
  query.piece = &piece;
  query.index = 0;
  std::copy_n(p.data(), 3, query.p);
  const double constant = far * far * random.uniform(-1.0, 1.0);
  std::vector<double> form(shape.form_size, NAN);
  const double least = distance_form(query, constant, form.data());
  EXPECT_EQ(least, *std::min_element(form.begin(), form.end()));
  Real worst = 0.0L;
  for_each_coefficient(piece,
    [&](int k, const std::array<Real, 5>& products)
    {
      Real expected = products[0] + constant * products[4];
      for (int i = 0; i < 3; ++i)
      {
        expected -= 2.0L * p(i) * products[1 + i];
      }
      const Real size = piece.reach * (piece.reach + 4.0L * p.norm()) + std::abs(constant);
      const Real allowed = products[4] * shape.roundings * kRounding * size;
      EXPECT_TRUE(std::isfinite(form[k]));
      worst = std::max(worst, std::abs(form[k] - expected) / allowed);
    });
  return static_cast<double>(worst);
}

double coefficient_error(const DistanceForms& forms)
{
  double worst = 0.0;
  for (const Piece& piece : forms.pieces())
  {
    worst = std::max(worst, coefficient_error(piece));
  }
  return worst;
}

/// How far corners of pieces are from the geometry, by its size.
double corner_error(const DistanceForms& forms, const Surface& surface)
{
  double worst = 0.0;
  for (const Piece& piece : forms.pieces())
  {
    const Vector3 corner = Vector3(piece.net[0], piece.net[1], piece.net[2]) / piece.net[3] +
      Vector3(piece.origin[0], piece.origin[1], piece.origin[2]);
    const Vector3 expected = surface.point({ piece.lower[0], piece.lower[1] });
    worst = std::max(worst, (corner - expected).norm() / surface.size());
  }
  return worst;
}

Surface random_surface(int p, int q, bool rational)
{
  shapes::Random random(17);
  const int nu = p + 3;
  const int nv = q + 4;
  const footpoint::Points net =
    footpoint::Points::NullaryExpr(3, nu * nv, [&]() { return random.uniform(-1.0, 1.0); });
  const Eigen::VectorXd weights = Eigen::VectorXd::NullaryExpr(
    rational ? nu * nv : 0, [&]() { return random.uniform(0.5, 2.0); });
  return Surface(KnotVector(p, shapes::clamped_knots(p, nu - p), "KnotsU"),
    KnotVector(q, shapes::clamped_knots(q, nv - q), "KnotsV"), net, weights);
}

Curve random_curve(int degree, bool rational)
{
  shapes::Random random(18);
  const int poles = degree + 3;
  const footpoint::Points net =
    footpoint::Points::NullaryExpr(3, poles, [&]() { return random.uniform(-1.0, 1.0); });
  const Eigen::VectorXd weights = Eigen::VectorXd::NullaryExpr(
    rational ? poles : 0, [&]() { return random.uniform(0.5, 2.0); });
  return Curve(
    KnotVector(degree, shapes::clamped_knots(degree, poles - degree), "KnotsU"), net, weights);
}

constexpr std::array<std::array<int, 2>, 5> kDegrees{ { { 1, 1 }, { 3, 3 }, { 2, 5 }, { 6, 4 },
  { 1, 12 } } };

TEST(DistanceForms, CoefficientsAreThoseOfTheNetWithinTheirBound)
{
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets())
  {
    SCOPED_TRACE(hwy::TargetName(target));
    const OnlyTarget only(target);
    for (const bool rational : { false, true })
    {
      // Rows of one vector, of several, and with a last one that is not full.
      for (const std::array<int, 2>& degree : kDegrees)
      {
        EXPECT_LE(coefficient_error(forms_of(random_surface(degree[0], degree[1], rational))), 1.0)
          << "degrees " << degree[0] << " and " << degree[1] << (rational ? ", rational" : "");
      }
    }
  }
  EXPECT_LE(coefficient_error(forms_of(shapes::circle())), 1.0);
  EXPECT_LE(coefficient_error(forms_of(shapes::parabola())), 1.0);
}

TEST(DistanceForms, FormsOfQueriesAreWithinTheirBound)
{
  shapes::Random random(31);
  std::vector<DistanceForms> all;
  for (const bool rational : { false, true })
  {
    for (const std::array<int, 2>& degree : kDegrees)
    {
      all.push_back(forms_of(random_surface(degree[0], degree[1], rational)));
    }
    all.push_back(forms_of(random_surface(2, 2, rational)));
    all.push_back(forms_of(random_surface(4, 30, rational)));
    for (const int degree : { 1, 3, 30 })
    {
      all.push_back(forms_of(random_curve(degree, rational)));
    }
  }
  for (const DistanceForms& forms : all)
  {
    const std::size_t step = 1 + forms.pieces().size() / 4;
    for (std::size_t k = 0; k < forms.pieces().size(); k += step)
    {
      const Piece& piece = forms.pieces()[k];
      EXPECT_LE(distance_form_error(random, piece), 1.0)
        << "degrees " << piece.shape->degree[0] << " and " << piece.shape->degree[1]
        << (piece.shape->rational ? ", rational" : "");
    }
  }
}

/// Coefficients of a polynomial as a form has them, where reads a few numbers beyond either end may
/// go.
struct Coefficients
{
  static constexpr int kBeside = 16;

  const PieceShape& shape;
  std::vector<double> numbers;

  /// \param value of coefficient (i, j)
  template <class Value>
  Coefficients(const PieceShape& of, const Value& value)
    : shape(of)
    , numbers(of.form_size + 2 * kBeside, 0.0)
  {
    for (int i = 0; i < of.rows; ++i)
    {
      for (int j = 0; j < of.stride; ++j)
      {
        this->data()[i * of.stride + j] = value(i, std::min(j, of.columns - 1));
      }
    }
  }

  double* data() { return this->numbers.data() + kBeside; }

  double least() { return *std::min_element(this->data(), this->data() + this->shape.form_size); }

  /// By de Casteljau's algorithm.
  Real at(Real u, Real v)
  {
    const auto point = [](std::vector<Real> line, Real t)
    {
      for (std::size_t left = line.size() - 1; left > 0; --left)
      {
        for (std::size_t k = 0; k < left; ++k)
        {
          line[k] += t * (line[k + 1] - line[k]);
        }
      }
      return line[0];
    };
    std::vector<Real> along_u;
    for (int i = 0; i < this->shape.rows; ++i)
    {
      const double* row = this->data() + i * this->shape.stride;
      along_u.push_back(point(std::vector<Real>(row, row + this->shape.columns), v));
    }
    return point(along_u, u);
  }
};

TEST(DistanceForms, HalvesAreThePolynomialItself)
{
  shapes::Random random(41);
  for (const std::array<int, 2>& degree : kDegrees)
  {
    const PieceShape shape(degree[0], degree[1], false);
    for (const int direction : { 0, 1 })
    {
      const Eigen::MatrixXd numbers = Eigen::MatrixXd::NullaryExpr(
        shape.rows, shape.columns, [&]() { return random.uniform(-1.0, 1.0); });
      const Coefficients whole(shape, [&](int i, int j) { return numbers(i, j); });
      Coefficients before = whole;
      Coefficients lower = whole;
      Coefficients upper = whole;
      const std::array<double, 2> least = halve(shape, lower.data(), direction, upper.data());
      EXPECT_EQ(least[0], lower.least());
      EXPECT_EQ(least[1], upper.least());
      for (int k = 0; k < shape.form_size; ++k)
      {
        const int last = k / shape.stride * shape.stride + shape.columns - 1;
        EXPECT_EQ(lower.data()[k], lower.data()[std::min(k, last)]);
        EXPECT_EQ(upper.data()[k], upper.data()[std::min(k, last)]);
      }
      for (int k = 0; k < 20; ++k)
      {
        std::array<Real, 2> at{ { random.uniform(0.0, 1.0), random.uniform(0.0, 1.0) } };
        const Real low = lower.at(at[0], at[1]);
        const Real high = upper.at(at[0], at[1]);
        at[direction] *= 0.5L;
        EXPECT_NEAR(static_cast<double>(low - before.at(at[0], at[1])), 0.0, 4e-15);
        at[direction] += 0.5L;
        EXPECT_NEAR(static_cast<double>(high - before.at(at[0], at[1])), 0.0, 4e-15);
      }
    }
  }
}

/// Quadratic polynomials, some of them saddles: what is called convex or monotone has to be so, and
/// most of what is has to be called so.
TEST(DistanceForms, SignsOfDerivativesOfQuadraticPolynomials)
{
  shapes::Random random(42);
  const PieceShape shape(3, 3, false);
  const Real n = shape.rows - 1.0L;
  int convex = 0;
  int called_convex = 0;
  int monotone = 0;
  int called_monotone = 0;
  for (int round = 0; round < 2000; ++round)
  {
    const double a = random.uniform(0.0, 1.0);
    const double c = random.uniform(0.0, 1.0);
    const double b = random.uniform(-1.0, 1.0);
    const double u = random.uniform(-0.5, 1.5);
    const double v = random.uniform(-0.5, 1.5);
    // a (u − u0)² + 2 b (u − u0)(v − v0) + c (v − v0)² in Bernstein form.
    const auto square = [&](int i, double at)
    { return i * (i - 1.0) / (n * (n - 1.0L)) - 2.0L * at * i / n + at * at; };
    Coefficients f(shape, [&](int i, int j)
      { return static_cast<double>(
          a * square(i, u) + 2.0 * b * (i / n - u) * (j / n - v) + c * square(j, v)); });
    const bool is = a * c > b * b;
    const bool called = is_convex(shape, f.data(), 0.0);
    convex += is;
    called_convex += called;
    EXPECT_TRUE(is || !called || a * c > b * b - 1e-12) << a << ' ' << b << ' ' << c;

    // The slope along a direction is linear: its extremes are at the corners.
    std::array<bool, 2> rises{ { true, true } };
    std::array<bool, 2> falls{ { true, true } };
    for (int corner = 0; corner < 4; ++corner)
    {
      const double x = corner / 2 - u;
      const double y = corner % 2 - v;
      const std::array<double, 2> slope{ { a * x + b * y, b * x + c * y } };
      for (int i = 0; i < 2; ++i)
      {
        rises[i] = rises[i] && slope[i] > -1e-12;
        falls[i] = falls[i] && slope[i] < 1e-12;
      }
    }
    const Slopes slopes = slopes_of(shape, f.data(), 0.0);
    monotone += rises[0] || falls[0] || rises[1] || falls[1];
    called_monotone += slopes.monotone >= 0;
    if (slopes.monotone >= 0)
    {
      EXPECT_TRUE(slopes.end == 0 ? rises[slopes.monotone] : falls[slopes.monotone]);
    }
  }
  EXPECT_GE(called_convex, convex * 9 / 10);
  EXPECT_GE(called_monotone, monotone * 9 / 10);
  EXPECT_GT(convex, 300);
  EXPECT_GT(monotone, 300);
}

/// u² + 2 b u v + v²: all second differences along a direction are D, all mixed ones M, so the
/// matrices stay positive definite up to the error e where n (n − 1) (D − e) = n² (|M| + e).
TEST(DistanceForms, ConvexityHasRoomForTheErrorThatIsNamed)
{
  const PieceShape shape(3, 3, false);
  const double n = shape.rows - 1;
  for (const double b : { -0.5, 0.0, 0.3 })
  {
    Coefficients f(shape,
      [&](int i, int j)
      { return (i * (i - 1.0) + j * (j - 1.0)) / (n * (n - 1.0)) + 2.0 * b * i * j / (n * n); });
    const double second = 2.0 / (n * (n - 1.0));
    const double mixed = 2.0 * std::abs(b) / (n * n);
    const double critical = ((n - 1.0) * second - n * mixed) / (2.0 * n - 1.0);
    EXPECT_TRUE(is_convex(shape, f.data(), 0.999 * critical)) << b;
    EXPECT_FALSE(is_convex(shape, f.data(), 1.001 * critical)) << b;
  }
  // Of a curve there is one direction.
  const PieceShape line(0, 3, false);
  Coefficients f(line, [&](int, int j) { return j * (j - 1.0); });
  EXPECT_TRUE(is_convex(line, f.data(), 1.999));
  EXPECT_FALSE(is_convex(line, f.data(), 2.001));
  // Slopes: the first differences are 0, 2, 4, …
  EXPECT_EQ(slopes_of(line, f.data(), 0.001).monotone, -1);
  Coefficients steep(line, [&](int, int j) { return j * (j + 1.0); });
  EXPECT_EQ(slopes_of(line, steep.data(), 1.999).monotone, 1);
  EXPECT_EQ(slopes_of(line, steep.data(), 2.001).monotone, -1);
}

/// Random coefficients about those of a bowl, of several degrees: the second derivatives differ
/// from place to place, and what is called convex has to be so at samples, with room for the error
/// that was named.
TEST(DistanceForms, WhatIsCalledConvexIsConvex)
{
  shapes::Random random(43);
  for (const std::array<int, 2>& degree :
    std::array<std::array<int, 2>, 4>{ { { 2, 2 }, { 3, 3 }, { 1, 2 }, { 2, 5 } } })
  {
    const PieceShape shape(degree[0], degree[1], false);
    const int n = shape.rows - 1;
    const int m = shape.columns - 1;
    int called = 0;
    int rounds = 0;
    for (; rounds < 1000; ++rounds)
    {
      const double noise = std::pow(10.0, random.uniform(-4.0, -0.5)) / (n * n + m * m);
      const Eigen::MatrixXd numbers = Eigen::MatrixXd::NullaryExpr(
        n + 1, m + 1, [&]() { return noise * random.uniform(-1.0, 1.0); });
      const double twist = random.uniform(-1.0, 1.0);
      const auto value = [&](int i, int j)
      {
        const double u = static_cast<double>(i) / n - 0.4;
        const double v = static_cast<double>(j) / m - 0.6;
        return u * u + 2.0 * twist * u * v + v * v + numbers(i, j);
      };
      Coefficients f(shape, value);
      const double error = 0.25 * noise * random.uniform(0.0, 1.0);
      if (!is_convex(shape, f.data(), error))
      {
        continue;
      }
      ++called;
      EXPECT_TRUE(is_convex(shape, f.data(), 0.0));
      // Derivatives have the differences of coefficients as their own, so a coefficient that is off
      // by a quarter of what a second difference may be off has to leave it convex.
      Coefficients moved(shape, [&](int i, int j)
        { return value(i, j) + 0.25 * error * ((i + j) % 2 == 0 ? 1.0 : -1.0); });
      for (Coefficients* each : { &f, &moved })
      {
        for (int k = 0; k < 16; ++k)
        {
          constexpr Real kStep = 0x1p-12L;
          const Real u = kStep + (1.0L - 2.0L * kStep) * (k / 4) / 3.0L;
          const Real v = kStep + (1.0L - 2.0L * kStep) * (k % 4) / 3.0L;
          const auto at = [&](int i, int j) { return each->at(u + i * kStep, v + j * kStep); };
          const Real uu = at(1, 0) - 2.0L * at(0, 0) + at(-1, 0);
          const Real vv = at(0, 1) - 2.0L * at(0, 0) + at(0, -1);
          const Real uv = 0.25L * (at(1, 1) - at(1, -1) - at(-1, 1) + at(-1, -1));
          // Differences are off by their step squared.
          const Real room = 1e-6L * (uu + vv) * (uu + vv);
          EXPECT_GT(uu, 0.0L);
          EXPECT_GT(uu * vv - uv * uv, -room)
            << degree[0] << ' ' << degree[1] << ", twist " << twist;
        }
      }
    }
    EXPECT_GT(called, rounds / 10);
    EXPECT_LT(called, rounds);
  }
}

TEST(DistanceForms, PiecesOfALargeNetAreItsSpans)
{
  const Surface sheet = shapes::bumpy(40, 1);
  const DistanceForms forms = forms_of(sheet);
  ASSERT_EQ(forms.pieces().size(), 37U * 37U);
  ASSERT_EQ(forms.boxes().size(), forms.pieces().size());
  EXPECT_LT(corner_error(forms, sheet), 1e-15);
  // First direction fastest, as the spans of the knots.
  EXPECT_EQ(forms.pieces()[1].lower[0], forms.pieces()[0].upper[0]);
  EXPECT_EQ(forms.pieces()[1].lower[1], forms.pieces()[0].lower[1]);
  EXPECT_EQ(forms.pieces()[37].lower[1], forms.pieces()[0].upper[1]);
  EXPECT_EQ(forms.pieces()[0].sides[0][0], PieceSide::Boundary);
  EXPECT_EQ(forms.pieces()[0].sides[0][1], PieceSide::Smooth);
}

TEST(DistanceForms, PiecesOfASmallNetAreCut)
{
  const Surface sheet = random_surface(3, 3, false);
  const DistanceForms forms = forms_of(sheet);
  EXPECT_GT(forms.pieces().size(), 12U); // 3 x 4 spans
  EXPECT_LT(corner_error(forms, sheet), 1e-15);
}

TEST(DistanceForms, UnevenWeightsAreCutOnALargeNetToo)
{
  const Surface even = shapes::bumpy(40, 1);
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(40 * 40);
  weights(20 * 40 + 20) = 1e3;
  const Surface uneven(even.knots(0), even.knots(1), even.local_control_points(), weights);
  const DistanceForms forms = forms_of(uneven);
  EXPECT_GT(forms.pieces().size(), 37U * 37U);
  EXPECT_LT(corner_error(forms, uneven), 1e-14);
  // What is within reach of the weight alone: the other spans are whole.
  EXPECT_LT(forms.pieces().size(), 2 * 37U * 37U);

  weights.setConstant(7.0);
  weights(0) = 8.0;
  const Surface mild(even.knots(0), even.knots(1), even.local_control_points(), weights);
  EXPECT_EQ(forms_of(mild).pieces().size(), 37U * 37U);
  EXPECT_LE(coefficient_error(forms_of(mild)), 1.0);
}

TEST(DistanceForms, BreaksInsideAreSpecialSides)
{
  // C0 at a knot in the first direction.
  const Surface sheet(KnotVector(2, { 0, 0, 0, 1, 1, 2, 2, 2 }, "KnotsU"),
    KnotVector(1, { 0, 0, 1, 1 }, "KnotsV"),
    shapes::points({ { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 1 }, { 3, 0, 0 }, { 4, 0, 0 }, { 0, 1, 0 },
      { 1, 1, 0 }, { 2, 1, 1 }, { 3, 1, 0 }, { 4, 1, 0 } }));
  const DistanceForms forms = forms_of(sheet);
  for (const Piece& piece : forms.pieces())
  {
    for (int end = 0; end < 2; ++end)
    {
      const double at = end == 0 ? piece.lower[0] : piece.upper[0];
      const PieceSide expected = at == 1.0 ? PieceSide::Special
        : at == 0.0 || at == 2.0           ? PieceSide::Boundary
                                           : PieceSide::Smooth;
      EXPECT_EQ(piece.sides[0][end], expected) << "at " << at;
    }
  }
}

} // namespace
