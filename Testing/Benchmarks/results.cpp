// SPDX-License-Identifier: BSD-3-Clause
#include "results.h"

#include <algorithm>
#include <cstdio>
#include <ostream>

namespace inversion_benchmark
{

void write_csv(std::ostream& out, const Records& records)
{
  out << "part,shape,query,program,scale,points,microseconds,worst,build_ms,checked,failed,wrong,"
         "missed,error,uncertified\n";
  for (const Record& r : records)
  {
    out << r.part << ',' << r.shape << ',' << r.query << ',' << r.program << ',' << r.scale << ','
        << r.points << ',' << r.microseconds << ',' << r.worst << ',' << r.build << ',' << r.checked
        << ',' << r.failed << ',' << r.wrong << ',' << r.missed << ',' << r.error << ','
        << r.uncertified << '\n';
  }
}

std::vector<std::string> distinct(const Records& records, std::string Record::*member)
{
  std::vector<std::string> all;
  for (const Record& r : records)
  {
    if (r.part == "comparison" && std::find(all.begin(), all.end(), r.*member) == all.end())
    {
      all.push_back(r.*member);
    }
  }
  return all;
}

const Record* find(const Records& records, const std::string& part, const std::string& shape,
  const std::string& query, const std::string& program)
{
  for (const Record& r : records)
  {
    if (r.part == part && r.shape == shape && r.query == query && r.program == program)
    {
      return &r;
    }
  }
  return nullptr;
}

double time_of(const Records& records, const std::string& part, const std::string& shape,
  QueryClass query_class, const std::string& program)
{
  const Record* r = find(records, part, shape, name_of(query_class), program);
  return r != nullptr ? r->microseconds : NAN;
}

double mean_time(const Records& records, const std::string& shape, const std::string& program)
{
  double sum = 0.0;
  for (const QueryClass query_class : kMainClasses)
  {
    sum += time_of(records, "comparison", shape, query_class, program);
  }
  return sum / kMainClasses.size();
}

std::string number(double value)
{
  if (!std::isfinite(value))
  {
    return "–";
  }
  std::array<char, 40> text{};
  const int digits = value < 1.0 ? 3 : value < 10.0 ? 2 : value < 100.0 ? 1 : 0;
  std::snprintf(text.data(), text.size(), "%.*f", digits, value);
  return text.data();
}

std::string small(double value)
{
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.0e", value);
  return std::isfinite(value) ? text.data() : "–";
}

} // namespace inversion_benchmark
