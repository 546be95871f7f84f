// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace footpoint
{

/// A sum of doubles without any rounding, so that it depends neither on their order nor on how they
/// are shared out among processes: a fixed-point number as wide as the range of doubles (the long
/// accumulator of U. W. Kulisch, 1971), in words of 32 bits that are carried late.
class ExactSum
{
public:
  /// 2098 bits of a double's range and what is added above them, and the counts of NaN, +∞ and −∞.
  static constexpr std::size_t kNumbers = 71;
  using Numbers = std::array<std::int64_t, kNumbers>;

  void add(double value);
  void add(const ExactSum& other);

  /// The sum as integers: to be added number by number to those of up to 2³⁰ other sums, which
  /// makes their common sum.
  Numbers numbers() const;
  static ExactSum from_numbers(const Numbers& numbers);

  /// The sum, correctly rounded (to nearest, ties to even); NaN and infinities as by addition.
  double value() const;

private:
  /// Brings all words but the highest into [0, 2³²).
  void carry();

  Numbers Words{};
  std::int64_t Pending = 0; ///< values since the last carry
};

} // namespace footpoint
