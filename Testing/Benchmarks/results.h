// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "queries.h"

#include <cstdint>
#include <iosfwd>

namespace inversion_benchmark
{

/// One line of the results.
struct Record
{
  std::string part; ///< build, comparison, filter, net, pieces, points, threads or vectors
  std::string shape;
  std::string query;
  std::string program;
  double scale = NAN;        ///< what varies: pieces, points, threads, offset in pieces
  std::int64_t points = 0;   ///< timed
  double microseconds = NAN; ///< a point, median of the passes
  double worst = NAN;        ///< the slowest point, in µs, its fastest pass counting
  double build = NAN;        ///< in ms
  std::int64_t checked = 0;  ///< points whose distance was looked at; errors are of these
  std::int64_t failed = 0;   ///< points without an answer
  std::int64_t wrong = 0;    ///< error > 1e-12 × size, or no answer
  std::int64_t missed = 0;   ///< error > 1e-6 × size: not the nearest point
  double error = NAN;        ///< the largest, by the size
  std::int64_t uncertified = 0;
};

using Records = std::vector<Record>;

/// Heads and writes the lines as comma-separated values.
void write_csv(std::ostream& out, const Records& records);

/// The line of a part that has these names; null where there is none.
const Record* find(const Records& records, const std::string& part, const std::string& shape,
  const std::string& query, const std::string& program);

/// Distinct values of a member in the part "comparison", in the order they come.
std::vector<std::string> distinct(const Records& records, std::string Record::*member);

/// µs a point; NaN where it was not measured.
double time_of(const Records& records, const std::string& part, const std::string& shape,
  QueryClass query_class, const std::string& program);

/// Mean over the four classes, µs a point; NaN where one is missing.
double mean_time(const Records& records, const std::string& shape, const std::string& program);

/// Three significant digits without an exponent; a dash for what is not finite.
std::string number(double value);

/// One significant digit with an exponent; a dash for what is not finite.
std::string small(double value);

} // namespace inversion_benchmark
