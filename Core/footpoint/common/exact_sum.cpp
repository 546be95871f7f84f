// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/common/exact_sum.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>

namespace footpoint
{
namespace
{

/// Words of the fixed-point number, lowest first; the lowest bit is 2⁻¹⁰⁷⁴. The highest mantissa
/// ends in word 65, the two above take carries.
constexpr std::size_t kDigits = 68;
constexpr std::size_t kNaN = kDigits;
constexpr std::size_t kPlusInfinity = kDigits + 1;
constexpr std::size_t kMinusInfinity = kDigits + 2;
static_assert(kMinusInfinity + 1 == ExactSum::kNumbers, "each number has its place");

constexpr std::uint64_t kMask = 0xffffffffu;
/// A value adds less than 2³³ to a word, which holds 2⁶³.
constexpr std::int64_t kMostPending = std::int64_t{ 1 } << 29;

} // namespace

void ExactSum::add(double value)
{
  std::uint64_t bits;
  std::memcpy(&bits, &value, sizeof(bits));
  const auto exponent = static_cast<unsigned>((bits >> 52) & 0x7ffu);
  std::uint64_t mantissa = bits & ((std::uint64_t{ 1 } << 52) - 1);
  const bool negative = (bits >> 63) != 0;
  if (exponent == 0x7ffu)
  {
    ++this->Words[mantissa != 0 ? kNaN : negative ? kMinusInfinity : kPlusInfinity];
    return;
  }
  // Subnormal numbers have the exponent of the smallest normal ones and no hidden bit.
  mantissa |= exponent > 0 ? std::uint64_t{ 1 } << 52 : 0;
  const unsigned place = exponent > 0 ? exponent - 1 : 0;
  const std::size_t word = place / 32;
  const unsigned shift = place % 32;
  const std::uint64_t low = (mantissa & kMask) << shift;
  const std::uint64_t high = (mantissa >> 32) << shift;
  const std::int64_t sign = negative ? -1 : 1;
  this->Words[word] += sign * static_cast<std::int64_t>(low & kMask);
  this->Words[word + 1] += sign * static_cast<std::int64_t>((low >> 32) + (high & kMask));
  this->Words[word + 2] += sign * static_cast<std::int64_t>(high >> 32);
  if (++this->Pending >= kMostPending)
  {
    this->carry();
  }
}

void ExactSum::add(const ExactSum& other)
{
  const Numbers numbers = other.numbers(); // as small as what a value adds
  std::transform(this->Words.begin(), this->Words.end(), numbers.begin(), this->Words.begin(),
    std::plus<>());
  if (++this->Pending >= kMostPending)
  {
    this->carry();
  }
}

void ExactSum::carry()
{
  for (std::size_t i = 0; i + 1 < kDigits; ++i)
  {
    const auto rest = static_cast<std::int64_t>(static_cast<std::uint64_t>(this->Words[i]) & kMask);
    this->Words[i + 1] += (this->Words[i] - rest) / (std::int64_t{ 1 } << 32);
    this->Words[i] = rest;
  }
  this->Pending = 0;
}

ExactSum::Numbers ExactSum::numbers() const
{
  ExactSum copy = *this;
  copy.carry();
  return copy.Words;
}

ExactSum ExactSum::from_numbers(const Numbers& numbers)
{
  ExactSum result;
  result.Words = numbers;
  result.carry();
  return result;
}

double ExactSum::value() const
{
  const double infinity = std::numeric_limits<double>::infinity();
  const bool up = this->Words[kPlusInfinity] > 0;
  const bool down = this->Words[kMinusInfinity] > 0;
  if (this->Words[kNaN] > 0 || (up && down))
  {
    return std::numeric_limits<double>::quiet_NaN();
  }
  if (up || down)
  {
    return up ? infinity : -infinity;
  }

  ExactSum magnitude = *this;
  magnitude.carry();
  const bool negative = magnitude.Words[kDigits - 1] < 0;
  if (negative)
  {
    for (std::size_t i = 0; i < kDigits; ++i)
    {
      magnitude.Words[i] = -magnitude.Words[i];
    }
    magnitude.carry();
  }
  std::size_t top = kDigits;
  while (top > 0 && magnitude.Words[top - 1] == 0)
  {
    --top;
  }
  if (top == 0)
  {
    return 0.0;
  }
  // The 64 highest bits; whether anything is below them goes into the last one, which is enough to
  // round to 53 bits. Sums in the subnormal range have fewer bits and are exact.
  const auto word = [&](std::size_t i) { return static_cast<std::uint64_t>(magnitude.Words[i]); };
  int shift = 0;
  while (((word(top - 1) << shift) & 0x80000000u) == 0)
  {
    ++shift;
  }
  std::uint64_t leading = word(top - 1) << 32;
  std::uint64_t below = 0;
  if (top > 1)
  {
    leading |= word(top - 2);
  }
  leading <<= shift;
  if (top > 2)
  {
    leading |= word(top - 3) >> (32 - shift);
    below = (word(top - 3) << shift) & kMask;
  }
  for (std::size_t i = 0; i + 3 < top; ++i)
  {
    below |= word(i);
  }
  leading |= below != 0 ? 1 : 0;
  const int exponent = 32 * (static_cast<int>(top) - 2) - shift - 1074;
  const double result = std::ldexp(static_cast<double>(leading), exponent);
  return negative ? -result : result;
}

} // namespace footpoint
