// SPDX-License-Identifier: BSD-3-Clause
#include "figures.h"

#include "peer.h"
#include "timing.h"

#include <array>
#include <cmath>
#include <functional>
#include <ostream>

namespace inversion_benchmark
{
namespace
{

void row(std::ostream& out, const std::string& what, const std::string& aim,
  const std::string& measured, bool met)
{
  out << "| " << what << " | " << aim << " | " << measured << " | " << (met ? "yes" : "no")
      << " |\n";
}

/// A row without an aim.
void fact(std::ostream& out, const std::string& what, const std::string& measured)
{
  out << "| " << what << " | – | " << measured << " | – |\n";
}

/// A row of several numbers, each with its upper limit.
void limits(std::ostream& out, const std::string& what, const std::vector<double>& aims,
  const std::vector<double>& measured)
{
  std::string aim = "≤ ";
  std::string values;
  bool met = true;
  for (std::size_t k = 0; k < aims.size(); ++k)
  {
    const std::string between = k == 0 ? "" : " / ";
    aim += between + number(aims[k]);
    values += between + number(measured[k]);
    met = met && measured[k] <= aims[k];
  }
  row(out, what, aim, values, met);
}

bool in_main_class(const Record& r)
{
  return std::any_of(kMainClasses.begin(), kMainClasses.end(),
    [&](QueryClass query_class) { return r.query == name_of(query_class); });
}

/// Sums over ours, one by one and in one call, of some classes.
struct Counts
{
  std::int64_t checked = 0;
  std::int64_t wrong = 0;
  std::int64_t uncertified = 0;
};

template <class Wanted>
Counts count(const Records& records, const Wanted& wanted)
{
  Counts counts;
  for (const Record& r : records)
  {
    if (r.part == "comparison" && is_ours(r.program) && wanted(r))
    {
      counts.checked += r.checked;
      counts.wrong += r.wrong;
      counts.uncertified += r.uncertified;
    }
  }
  return counts;
}

void print_correctness(std::ostream& out, const Records& records)
{
  const auto wrong = [&](const std::string& what, const Counts& counts)
  {
    row(out, what, "0", std::to_string(counts.wrong) + " of " + std::to_string(counts.checked),
      counts.wrong == 0);
  };
  const auto central = [](const Record& r)
  {
    return r.query == name_of(QueryClass::Centre) || r.query == name_of(QueryClass::Core) ||
      r.query == name_of(QueryClass::Ties);
  };
  const Counts main = count(records, in_main_class);
  const Counts centres = count(records, central);
  wrong("wrong answers (error > 1e-12 × size), " +
      std::to_string(distinct(records, &Record::shape).size()) + " shapes, on / near / off / far",
    main);
  wrong("the same within 1e-9 … 1e-2 × size of centres, and at ties", centres);
  const double share = 100.0 * static_cast<double>(main.uncertified + centres.uncertified) /
    static_cast<double>(main.checked + centres.checked);
  row(out, "not certified on all of those", "≤ 0.001 %", number(share) + " %", share <= 0.001);
}

/// The largest of a member over ours of a class.
double largest(
  const Records& records, const std::string& ours, QueryClass query_class, double Record::*member)
{
  double most = 0.0;
  for (const Record& r : records)
  {
    if (r.part == "comparison" && r.program == ours && r.query == name_of(query_class))
    {
      most = std::max(most, r.*member);
    }
  }
  return most;
}

/// Mean over the offsets of the part "net".
Record mean_of_net(const Records& records, const std::string& shape)
{
  Record mean;
  mean.microseconds = 0.0;
  int lines = 0;
  for (const Record& r : records)
  {
    if (r.part == "net" && r.shape == shape)
    {
      mean.microseconds += r.microseconds;
      mean.build = r.build;
      ++lines;
    }
  }
  mean.microseconds /= lines;
  return mean;
}

std::int64_t most_points(const Records& records, const std::string& part)
{
  std::int64_t most = 0;
  for (const Record& r : records)
  {
    most = r.part == part ? std::max(most, r.points) : most;
  }
  return most;
}

/// Ours by classes of queries in a part of the measurement; empty where it was left out.
std::vector<double> main_times(
  const Records& records, const std::string& part, const std::string& program)
{
  std::vector<double> times;
  for (const QueryClass query_class : kMainClasses)
  {
    const double time = time_of(records, part, "bumpy40", query_class, program);
    if (std::isfinite(time))
    {
      times.push_back(time);
    }
  }
  return times;
}

/// Ours with all points in one call; empty where it was not measured.
std::string batch_program(const Records& records)
{
  const std::vector<std::string> programs = distinct(records, &Record::program);
  return programs.size() > 1 && is_ours(programs[1]) ? programs[1] : "";
}

void print_builds(std::ostream& out, const Records& records)
{
  std::array<double, 2> times{ { NAN, NAN } };
  for (const Record& r : records)
  {
    if (r.part == "build")
    {
      times[r.scale == 1 ? 0 : 1] = r.build;
    }
  }
  if (std::isfinite(times[1]))
  {
    fact(out, "200 × 200 net, built by one thread / by two: wall time in ms",
      number(times[0]) + " / " + number(times[1]));
  }
}

void print_own_times(std::ostream& out, const Records& records, const std::string& ours)
{
  limits(out, "40 × 40 bicubic, one query at a time: on / near / off / far", { .25, .40, .75, .40 },
    main_times(records, "comparison", ours));
  if (const std::string batch = batch_program(records); !batch.empty())
  {
    limits(out, "the same in one call", { .25, .40, .75, .40 },
      main_times(records, "comparison", batch));
  }
  const std::vector<double> filter = main_times(records, "filter", ours);
  if (!filter.empty())
  {
    limits(out,
      "the same through the filter, " + std::to_string(most_points(records, "filter")) +
        " points, sorting and output included",
      { .30, .45, .80, .50 }, filter);
  }
  const Record small = mean_of_net(records, "bumpy40");
  const Record large = mean_of_net(records, "bumpy200");
  limits(out,
    "200 × 200 net against 40 × 40, points in blocks 0 … 1 piece off: time a point; built in ms",
    { 1.3, 50 }, { large.microseconds / small.microseconds, large.build });
  print_builds(out, records);
  limits(
    out, "curve of 200 control points, mean", { .20 }, { mean_time(records, "curve200", ours) });
  limits(out, "within 1e-9 × size of a centre: mean, slowest; 1e6 × size away: mean",
    { 50, 1000, 10 },
    { largest(records, ours, QueryClass::Core, &Record::microseconds),
      largest(records, ours, QueryClass::Core, &Record::worst),
      largest(records, ours, QueryClass::Distant, &Record::microseconds) });
}

/// How many times as fast as another program ours is on each of some shapes; the least counts.
template <class Wanted>
void ratio(std::ostream& out, const Records& records, const std::string& ours,
  const std::string& peer, double aim, const std::string& what, const Wanted& wanted)
{
  const std::string of_ours =
    ours == distinct(records, &Record::program).front() ? "" : "; ours in one call";
  double least = INFINITY;
  std::string where;
  std::vector<double> all;
  for (const Shape& shape : all_shapes())
  {
    const double times =
      mean_time(records, shape.name, peer) / mean_time(records, shape.name, ours);
    if (wanted(shape) && std::isfinite(times))
    {
      all.push_back(times);
      if (times < least)
      {
        least = times;
        where = shape.name;
      }
    }
  }
  if (!all.empty())
  {
    row(out, peer + ", mean of the four classes, " + what + of_ours,
      "≥ " + number(aim) + " × faster",
      number(least) + " × (" + where + "), median " + number(median(all)) + " ×", least >= aim);
  }
}

void print_ratios(std::ostream& out, const Records& records, const std::string& ours)
{
  const auto surface = [](const Shape& shape) { return shape.family != Family::Other; };
  ratio(out, records, ours, "OCCT", 100, "each surface of degree ≤ 3 or rational quadric",
    [](const Shape& shape) { return shape.family == Family::Low; });
  ratio(out, records, ours, "OCCT", 75, "degree 7 × 7",
    [](const Shape& shape) { return shape.name == "degree7x7"; });
  ratio(out, records, ours, "SISL", 50, "each surface", surface);
  ratio(out, records, ours, "VTK locator", 10, "each surface", surface);
  ratio(out, records, ours, "VTK locator 1e-4", 10, "each surface", surface);
}

/// How far distances on the tessellation are off.
void print_locator_error(std::ostream& out, const Records& records, const std::string& locator)
{
  std::vector<double> errors;
  for (const Shape& shape : all_shapes())
  {
    double largest = NAN;
    for (const QueryClass query_class : kMainClasses)
    {
      const Record* r =
        find(records, "comparison", shape.name, name_of(query_class), locator);
      largest = r != nullptr ? std::fmax(largest, r->error) : largest;
    }
    if (shape.family != Family::Other && std::isfinite(largest))
    {
      errors.push_back(largest);
    }
  }
  if (!errors.empty())
  {
    fact(out, "largest error of distances by " + locator + ", by the size, on each surface",
      "median " + small(median(errors)) + ", " +
        small(*std::min_element(errors.begin(), errors.end())) + " … " +
        small(*std::max_element(errors.begin(), errors.end())));
  }
}

/// Older vector instructions against the newest that the processor has.
void print_vector_targets(std::ostream& out, const Records& records)
{
  std::vector<std::string> names;
  for (const Record& r : records)
  {
    if (r.part == "vectors" && std::find(names.begin(), names.end(), r.program) == names.end())
    {
      names.push_back(r.program);
    }
  }
  for (std::size_t k = 0; k + 1 < names.size(); ++k)
  {
    std::vector<double> ratios = main_times(records, "vectors", names[k]);
    const std::vector<double> newest = main_times(records, "vectors", names.back());
    std::transform(ratios.begin(), ratios.end(), newest.begin(), ratios.begin(), std::divides<>());
    const double aim = names[k] == "AVX2" ? 1.6 : 3.0;
    limits(out,
      "40 × 40 bicubic in one call with " + names[k] + " alone, time against " + names.back() +
        ": on / near / off / far",
      std::vector<double>(ratios.size(), aim), ratios);
  }
}

void print_threads(std::ostream& out, const Records& records)
{
  double one = NAN;
  double two = NAN;
  for (const Record& r : records)
  {
    if (r.part == "threads")
    {
      one = r.scale == 1 ? r.microseconds : one;
      two = r.scale == 2 ? r.microseconds : two;
    }
  }
  if (std::isfinite(two))
  {
    row(out,
      "two threads against one, through the filter, " +
        std::to_string(most_points(records, "threads")) + " points",
      "≥ 1.8 ×", number(one / two) + " ×", one / two >= 1.8);
  }
}

} // namespace

void print_figures(std::ostream& out, const Records& records)
{
  const std::string ours = distinct(records, &Record::program).front();
  out << "| what | aim | measured | met |\n|---|---|---|---|\n";
  print_correctness(out, records);
  print_own_times(out, records, ours);
  print_ratios(out, records, ours);
  if (const std::string batch = batch_program(records); !batch.empty())
  {
    print_ratios(out, records, batch);
  }
  print_locator_error(out, records, "VTK locator");
  print_locator_error(out, records, "VTK locator 1e-4");
  print_threads(out, records);
  print_vector_targets(out, records);
  out << '\n';
}

} // namespace inversion_benchmark
