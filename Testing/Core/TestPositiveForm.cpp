// SPDX-License-Identifier: BSD-3-Clause

/// What is called positive has to be, and most of what is has to be called so: polynomials in
/// Bernstein form whose sign is known or is sampled in long double.

#include "BlockJudge.h"
#include "RandomPieces.h"
#include "SlowBuild.h"

#include "footpoint/search/positive_form-inl.h"

using footpoint::HWY_NAMESPACE::PositiveForm;
using namespace blocks;

namespace
{

constexpr int kShare = kSlowBuild ? 8 : 1;

/// Coefficients of degree (n, m).
struct Polynomial
{
  int n;
  int m;
  std::vector<double> coefficients;

  Polynomial(int degree, int other_degree)
    : n(degree)
    , m(other_degree)
    , coefficients((n + 1) * (m + 1), 0.0)
  {
  }
  double& operator()(int i, int j) { return this->coefficients[i * (this->m + 1) + j]; }
  double operator()(int i, int j) const { return this->coefficients[i * (this->m + 1) + j]; }
  Real at(const Pair& t) const
  {
    const Basis u(this->n, t[0]);
    const Basis v(this->m, t[1]);
    Real sum = 0.0L;
    for (int i = 0; i <= this->n; ++i)
    {
      for (int j = 0; j <= this->m; ++j)
      {
        sum += u.value[i] * v.value[j] * (*this)(i, j);
      }
    }
    return sum;
  }
  double greatest() const
  {
    double result = 0.0;
    for (const double each : this->coefficients)
    {
      result = std::max(result, std::abs(each));
    }
    return result;
  }
};

template <int N, int M, int Width>
bool is_positive(const Polynomial& form, const std::array<double, 2>& t)
{
  using Form = PositiveForm<N, M, Width>;
  // Memory that ends where it may end and holds nothing that was set before.
  std::vector<double> memory(
    Form::size_of_memory(form.n, form.m), std::numeric_limits<double>::quiet_NaN());
  Form proof(form.n, form.m, t, memory.data());
  for (int i = 0; i <= form.n; ++i)
  {
    for (int j = 0; j < proof.stride(); ++j)
    {
      memory[i * proof.stride() + j] = form(i, std::min(j, form.m));
    }
  }
  return proof.is_positive(form.greatest(), 16);
}

/// a (u − t₀)² + 2 b (u − t₀)(v − t₁) + c (v − t₁)² + what is left.
Polynomial square_form(int n, int m, const std::array<double, 3>& abc,
  const std::array<double, 2>& t, double constant)
{
  Polynomial result(n, m);
  const auto square = [](int k, int degree, double at)
  {
    return degree < 2 ? 0.0
                      : k * (k - 1.0) / (degree * (degree - 1.0)) - 2.0 * at * k / degree + at * at;
  };
  for (int i = 0; i <= n; ++i)
  {
    for (int j = 0; j <= m; ++j)
    {
      const double du = n > 0 ? static_cast<double>(i) / n - t[0] : 0.0;
      const double dv = static_cast<double>(j) / m - t[1];
      result(i, j) = abc[0] * square(i, n, t[0]) + 2.0 * abc[1] * du * dv +
        abc[2] * square(j, m, t[1]) + constant;
    }
  }
  return result;
}

} // namespace

TEST(PositiveForm, SquareForms)
{
  Random random(11);
  int called = 0;
  int rounds = 0;
  for (int round = 0; round < 4000 / kShare; ++round)
  {
    const int n = random.integer(0, 5) == 0 ? 0 : random.integer(2, 8);
    const int m = random.integer(2, 8);
    const double a = random.magnitude(2.0);
    const double c = random.magnitude(2.0);
    const double part = random.uniform(-0.95, 0.95);
    const double b = n > 0 ? part * std::sqrt(a * c) : 0.0;
    const std::array<double, 2> t{ { n > 0 ? random.uniform(0.0, 1.0) : 0.0,
      random.uniform(0.0, 1.0) } };
    const double small = 1e-10 * (a + c);
    const Polynomial above = square_form(n, m, { { a, b, c } }, t, small);
    const Polynomial below = square_form(n, m, { { a, b, c } }, t, -small);
    const Polynomial saddle = square_form(
      n, m, { { a, n > 0 ? std::copysign(1.5, part) * std::sqrt(a * c) : 0.0, c } }, t, small);
    ++rounds;
    called += is_positive<-1, -1, 4>(above, t);
    EXPECT_FALSE((is_positive<-1, -1, 4>(below, t)));
    // A saddle is negative beside its middle, unless too little of that is in the square.
    if (n > 0 && t[0] > 0.1 && t[0] < 0.9 && t[1] > 0.1 && t[1] < 0.9)
    {
      EXPECT_FALSE((is_positive<-1, -1, 8>(saddle, t)));
    }
  }
  EXPECT_GT(called, 0.95 * rounds);
}

TEST(PositiveForm, RandomFormsAreNotNegativeWhereTheyAreCalledPositive)
{
  int called = 0;
  int positive = 0;
  int rounds = 0;
  for (int seed = 0; seed < 4000 / kShare; ++seed)
  {
    Random random(seed);
    const int n = random.integer(0, 4) == 0 ? 0 : random.integer(2, 6);
    const int m = random.integer(2, 6);
    const std::array<double, 2> t{ { n > 0 ? random.uniform(0.0, 1.0) : 0.0,
      random.uniform(0.0, 1.0) } };
    // A bowl at t, and something as large that is rough, mostly with its gradient taken away there.
    const double rough = random.magnitude(2.0);
    Polynomial form = square_form(
      n, m, { { 1.0, random.uniform(-0.7, 0.7), random.uniform(0.5, 2.0) } }, t, 0.0);
    for (double& each : form.coefficients)
    {
      each += rough * random.uniform(-0.3, 0.3);
    }
    // So that it just touches zero on a grid of samples, and then a little more or less.
    Real least = std::numeric_limits<Real>::infinity();
    std::array<double, 2> at = t;
    constexpr int kSamples = 40;
    for (int i = 0; i <= kSamples; ++i)
    {
      for (int j = 0; j <= kSamples; ++j)
      {
        const Pair place{ { n > 0 ? i / Real(kSamples) : 0.0L, j / Real(kSamples) } };
        const Real value = form.at(place);
        if (value < least)
        {
          least = value;
          at = { { static_cast<double>(place[0]), static_cast<double>(place[1]) } };
        }
      }
    }
    const Real shift = random.uniform(-0.02, 0.05);
    for (double& each : form.coefficients)
    {
      each += static_cast<double>(shift - least);
    }
    const bool is_called = is_positive<-1, -1, 4>(form, at);
    EXPECT_TRUE(!is_called || shift > 0.0L) << "seed " << seed;
    EXPECT_EQ(is_called, (is_positive<-1, -1, 8>(form, at)));
    ++rounds;
    positive += shift > 0.01L;
    called += is_called && shift > 0.01L;
  }
  EXPECT_GT(called, 0.8 * positive);
  EXPECT_GT(positive, 0.3 * rounds);
}

TEST(PositiveForm, FixedDegreesAnswerTheSame)
{
  Random random(3);
  for (int round = 0; round < 400; ++round)
  {
    const std::array<double, 2> t{ { random.uniform(0.0, 1.0), random.uniform(0.0, 1.0) } };
    const Polynomial form = square_form(6, 6,
      { { 1.0, random.uniform(-1.1, 1.1), random.magnitude(1.0) } }, t,
      random.uniform(-1e-3, 1e-3));
    EXPECT_EQ((is_positive<6, 6, 8>(form, t)), (is_positive<-1, -1, 8>(form, t)));
    const Polynomial narrow = square_form(6, 2,
      { { 1.0, random.uniform(-1.1, 1.1), random.magnitude(1.0) } }, t,
      random.uniform(-1e-3, 1e-3));
    EXPECT_EQ((is_positive<6, 2, 8>(narrow, t)), (is_positive<-1, -1, 4>(narrow, t)));
    const Polynomial line = square_form(0, 6, { { 0.0, 0.0, 1.0 } }, { { 0.0, t[1] } },
      random.uniform(-1e-3, 1e-3));
    EXPECT_EQ((is_positive<0, 6, 8>(line, { { 0.0, t[1] } })),
      (is_positive<-1, -1, 4>(line, { { 0.0, t[1] } })));
  }
}

TEST(PositiveForm, RoundingIsLeftOver)
{
  // Far above zero but for the foot, where all that is there is less than the rounding of a cut.
  const std::array<double, 2> t{ { 0.3, 0.6 } };
  EXPECT_FALSE((is_positive<3, 3, 4>(square_form(3, 3, { { 1.0, 0.3, 1.0 } }, t, 1e-18), t)));
  EXPECT_TRUE((is_positive<3, 3, 4>(square_form(3, 3, { { 1.0, 0.3, 1.0 } }, t, 1e-12), t)));
  EXPECT_FALSE((is_positive<3, 3, 4>(square_form(3, 3, { { 1e8, 0.3, 1e8 } }, t, 1e-12), t)));
}
