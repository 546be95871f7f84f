// SPDX-License-Identifier: BSD-3-Clause
#include "tables.h"

#include "peer.h"

#include <fstream>
#include <ostream>
#include <thread>

namespace inversion_benchmark
{
namespace
{

std::string processor()
{
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
  {
    if (line.rfind("model name", 0) == 0)
    {
      return line.substr(line.find(':') + 2);
    }
  }
  return "unknown processor";
}

void print_head(std::ostream& out, const std::vector<std::string>& columns, std::size_t texts)
{
  std::string rule = "|";
  for (std::size_t k = 0; k < columns.size(); ++k)
  {
    out << "| " << columns[k] << ' ';
    rule += k < texts ? "---|" : "--:|";
  }
  out << "|\n" << rule << '\n';
}

/// A line for each shape and class, a column for each program.
template <class Cell>
void print_cells(std::ostream& out, const Records& records, const Cell& cell)
{
  const std::vector<std::string> programs = distinct(records, &Record::program);
  std::vector<std::string> columns{ "shape", "queries" };
  columns.insert(columns.end(), programs.begin(), programs.end());
  print_head(out, columns, 2);
  for (const Record& own : records)
  {
    if (own.part == "comparison" && own.program == programs.front())
    {
      out << "| " << own.shape << " | " << own.query;
      for (const std::string& program : programs)
      {
        const Record* r = find(records, "comparison", own.shape, own.query, program);
        out << " | " << (r != nullptr ? cell(*r) : "–");
      }
      out << " |\n";
    }
  }
  out << '\n';
}

/// Means over the four classes, and how many times as long as ours the others take.
void print_means(std::ostream& out, const Records& records)
{
  const std::vector<std::string> programs = distinct(records, &Record::program);
  std::vector<std::string> columns{ "shape" };
  columns.insert(columns.end(), programs.begin(), programs.end());
  for (const std::string& program : programs)
  {
    if (!is_ours(program))
    {
      columns.push_back(program + " / ours");
    }
  }
  print_head(out, columns, 1);
  for (const std::string& shape : distinct(records, &Record::shape))
  {
    std::string ratios;
    const double own = mean_time(records, shape, programs.front());
    out << "| " << shape;
    for (const std::string& program : programs)
    {
      const double mean = mean_time(records, shape, program);
      out << " | " << number(mean);
      ratios += is_ours(program) ? "" : " | " + number(mean / own);
    }
    out << ratios << " |\n";
  }
  out << '\n';
}

} // namespace

void print_machine(std::ostream& out, const Settings& settings)
{
  out << "Machine: " << processor() << ", " << std::thread::hardware_concurrency()
      << " threads; compiler " <<
#ifdef __VERSION__
    __VERSION__
#else
    "unknown"
#endif
      << ". Measured with `--budget " << settings.budget << " --repeats " << settings.repeats
      << "`. Times are µs a point, one thread unless said otherwise, medians.\n\n";
}

void print_comparison(std::ostream& out, const Records& records)
{
  if (records.empty())
  {
    return;
  }
  out << "Mean of on, near, off and far, µs a point:\n\n";
  print_means(out, records);
  out << "µs a point:\n\n";
  print_cells(out, records, [](const Record& r) { return number(r.microseconds); });
  out << "Largest error by the size; of ours the wrong answers, of the others the share of points "
         "off by more than 1e-6 × size:\n\n";
  print_cells(out, records,
    [](const Record& r)
    {
      const double missed = 100.0 * static_cast<double>(r.missed) / static_cast<double>(r.checked);
      return small(r.error) + ", " +
        (is_ours(r.program) ? std::to_string(r.wrong) + " of " + std::to_string(r.checked)
                           : number(missed) + " %");
    });
}

} // namespace inversion_benchmark
