// SPDX-License-Identifier: BSD-3-Clause
// Exact sums against sums known in closed form, and against other orders of themselves.

#include "footpoint/common/exact_sum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

using footpoint::ExactSum;

namespace
{

double sum_of(const std::vector<double>& values)
{
  ExactSum sum;
  for (const double value : values)
  {
    sum.add(value);
  }
  return sum.value();
}

} // namespace

TEST(ExactSum, KeepsEverySingleDouble)
{
  std::mt19937_64 generator(1);
  EXPECT_EQ(sum_of({}), 0.0);
  for (const double value : { 0.0, 1.0, 0.1, 5e-324, 2.2250738585072014e-308, 1e-310,
         1.7976931348623157e308, 4294967295.0, 4294967296.0 })
  {
    EXPECT_EQ(sum_of({ value }), value);
    EXPECT_EQ(sum_of({ -value }), -value);
    EXPECT_EQ(sum_of({ value, -value }), 0.0);
  }
  for (int k = 0; k < 100000; ++k)
  {
    const double value =
      std::ldexp(static_cast<double>(generator()), static_cast<int>(generator() % 1900) - 1100);
    ASSERT_EQ(sum_of({ value }), value);
    ASSERT_EQ(sum_of({ -value }), -value);
  }
}

TEST(ExactSum, RoundsOnceAndToEven)
{
  const double ulp = std::numeric_limits<double>::epsilon();
  EXPECT_EQ(sum_of({ 1.0, 0.5 * ulp }), 1.0);                 // tie, to even
  EXPECT_EQ(sum_of({ 1.0 + ulp, 0.5 * ulp }), 1.0 + 2 * ulp); // tie, to even
  EXPECT_EQ(sum_of({ 1.0, 0.5 * ulp, 5e-324 }), 1.0 + ulp);   // just above the tie
  EXPECT_EQ(sum_of({ 1.0, 0.5 * ulp, -5e-324 }), 1.0);
  EXPECT_EQ(sum_of({ 1e308, 1.0, -1e308 }), 1.0);
  EXPECT_EQ(sum_of({ 1e308, 1e308, -1e308 }), 1e308); // nothing overflows on the way
  EXPECT_EQ(sum_of({ 1e308, 1e308 }), std::numeric_limits<double>::infinity());
  EXPECT_EQ(sum_of({ -1.0, 1e-300 }), -1.0);
  EXPECT_EQ(sum_of({ 5e-324, 5e-324, 5e-324 }), 1.5e-323);
}

TEST(ExactSum, TakesNaNAndInfinitiesAsAdditionDoes)
{
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(sum_of({ 1.0, infinity }), infinity);
  EXPECT_EQ(sum_of({ -infinity, 1e308 }), -infinity);
  EXPECT_TRUE(std::isnan(sum_of({ -infinity, 1.0, infinity })));
  EXPECT_TRUE(std::isnan(sum_of({ 1.0, NAN })));
}

/// Numbers of very different sizes and both signs, in other orders and added up in parts.
TEST(ExactSum, IsTheSameForAnyOrderAndAnyParts)
{
  std::mt19937_64 generator(2);
  std::vector<double> values;
  for (int k = 0; k < 20000; ++k)
  {
    const double size = std::ldexp(1.0, static_cast<int>(generator() % 120) - 60);
    values.push_back(size * (static_cast<double>(generator()) / 1.8446744073709552e19 - 0.5));
  }
  const double sum = sum_of(values);
  long double other = 0;
  std::sort(
    values.begin(), values.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
  for (const double value : values)
  {
    other += value;
  }
  EXPECT_NEAR(sum, static_cast<double>(other), 1e-14 * std::abs(sum));
  EXPECT_EQ(sum, sum_of(values));
  for (const std::size_t parts : { 2u, 3u, 7u })
  {
    std::shuffle(values.begin(), values.end(), generator);
    ExactSum::Numbers all{};
    ExactSum joined;
    for (std::size_t p = 0; p < parts; ++p)
    {
      ExactSum part;
      for (std::size_t i = p; i < values.size(); i += parts)
      {
        part.add(values[i]);
      }
      const ExactSum::Numbers numbers = part.numbers();
      std::transform(all.begin(), all.end(), numbers.begin(), all.begin(), std::plus<>());
      joined.add(part);
    }
    EXPECT_EQ(joined.value(), sum);
    EXPECT_EQ(ExactSum::from_numbers(all).value(), sum);
  }
}

/// Integers of 60 bits: their sum fits a long double exactly and is rounded once by the cast.
TEST(ExactSum, OfIntegersIsTheirRoundedSum)
{
  std::mt19937_64 generator(3);
  for (int trial = 0; trial < 2000; ++trial)
  {
    ExactSum sum;
    std::int64_t exact = 0;
    for (int k = 0; k < 200; ++k)
    {
      const auto value = static_cast<std::int64_t>(generator() >> 11) - (std::int64_t{ 1 } << 52);
      exact += value;
      sum.add(static_cast<double>(value));
    }
    ASSERT_EQ(sum.value(), static_cast<double>(exact)); // conversion rounds to nearest even
  }
}
