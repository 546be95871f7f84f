// SPDX-License-Identifier: BSD-3-Clause
#include "scaling.h"

#include "timing.h"
#include "two_threads.h"

#include "footpoint/model/point_inversion.h"

#ifdef BENCHMARK_VTK
#include "filter_timing.h"
#endif

#include <array>
#include <memory>
#include <ostream>
#include <thread>

namespace inversion_benchmark
{
namespace
{

/// Control points a direction: 10², 10³, 10⁴, 10⁵, 10⁶ pieces of a bicubic sheet.
constexpr std::array<int, 5> kSheets{ { 13, 35, 103, 319, 1003 } };
constexpr int kPointsOfSheets = 20000;
/// A program that takes longer than this for a point is not asked about larger sheets.
constexpr double kSlowest = 5e4; // µs

/// The fastest counts: a virtual machine may have to find the memory for the first.
constexpr int kBuilds = 2;
/// Times the repeats: what takes a tenth of a second varies more.
constexpr int kBuildsOfThreads = 3;

/// Offset of the points of the larger sheets, in sizes of a piece.
constexpr double kOffset = 0.5;

/// Time against number of pieces: points in the order of a scan, half a piece off.
void measure_pieces(const Settings& settings, std::ostream& progress, Records& records)
{
  for (const std::unique_ptr<Peer>& program : all_peers(settings.ours_only, false))
  {
    double slowest = 0.0;
    for (const int n : kSheets)
    {
      if (slowest > kSlowest)
      {
        break;
      }
      const Shape sheet = bumpy_sheet(n);
      progress << "pieces " << program->name() << ' ' << sheet.pieces() << std::endl;
      Record record;
      record.part = "pieces";
      record.shape = sheet.name;
      record.program = program->name();
      record.scale = static_cast<double>(sheet.pieces());
      bool taken = false;
      record.build = INFINITY;
      for (int repeat = 0; repeat < kBuilds; ++repeat)
      {
        record.build =
          std::min(record.build, 1e3 * cpu_seconds([&] { taken = program->build(sheet); }));
      }
      if (!taken)
      {
        break;
      }
      const int count = std::min(kPointsOfSheets, settings.points);
      time_program(*program, ordered_queries(sheet, kOffset / (n - 3), count), settings, record);
      slowest = record.microseconds;
      records.push_back(record);
    }
  }
}

/// The same points, by their offset in pieces, on 40 x 40 and 200 x 200 control points by turns.
void measure_large_net(const Settings& settings, std::ostream& progress, Records& records)
{
  progress << "200 x 200 against 40 x 40" << std::endl;
  for (const double offset : { 0.0, 0.1, kOffset, 1.0 })
  {
    for (const int n : { 40, 200 })
    {
      const Shape sheet = bumpy_sheet(n);
      std::unique_ptr<Peer> ours = make_footpoint();
      Record record;
      record.part = "net";
      record.shape = sheet.name;
      record.program = ours->name();
      record.scale = offset;
      std::vector<double> builds;
      for (int repeat = 0; repeat < settings.repeats; ++repeat)
      {
        ours = make_footpoint(); // freeing what was built before takes time too
        builds.push_back(1e3 * cpu_seconds([&] { ours->build(sheet); }));
      }
      record.build = median(builds);
      time_program(
        *ours, ordered_queries(sheet, offset / (n - 3), settings.points), settings, record);
      records.push_back(record);
    }
  }
}

/// Wall time of building the larger net by one thread and by two, by turns.
void measure_builds(const Settings& settings, std::ostream& progress, Records& records)
{
  progress << "build" << std::endl;
  const Shape sheet = bumpy_sheet(200);
  const footpoint::Model model = model_of(sheet);
  const std::array<footpoint::Execution, 2> executions{ { {}, on_two_threads() } };
  std::array<std::vector<double>, 2> builds;
  for (int repeat = 0; repeat < kBuildsOfThreads * settings.repeats; ++repeat)
  {
    for (std::size_t k = 0; k < 2; ++k)
    {
      std::unique_ptr<footpoint::PointInverter> built;
      builds[k].push_back(1e3 *
        seconds(
          [&]
          {
            built = std::make_unique<footpoint::PointInverter>(
              model, footpoint::InversionOptions{}, executions[k]);
          }));
    }
  }
  for (std::size_t k = 0; k < 2; ++k)
  {
    Record record;
    record.part = "build";
    record.shape = sheet.name;
    record.program = make_footpoint()->name();
    record.scale = static_cast<double>(k + 1);
    record.build = median(builds[k]);
    records.push_back(record);
  }
}

#ifdef BENCHMARK_VTK
constexpr int kPointsOfFilter = 1000000;
/// A pass of the filter is long: those after the first are made while all of them take less than
/// this times the passes and the budget of the comparison.
constexpr double kBudgetsOfFilter = 10.0;

/// Runs `pass`, which returns the seconds it took, `settings.repeats` times or as often as the
/// budget allows, at least once.
template <class Pass>
void repeat_filter(const Settings& settings, const Pass& pass)
{
  const double most = kBudgetsOfFilter * settings.repeats * settings.budget;
  double spent = 0.0;
  for (int repeat = 0; repeat < settings.repeats && (repeat == 0 || spent < most); ++repeat)
  {
    spent += pass();
  }
}

Record line_of_filter(
  const std::string& part, const Shape& shape, QueryClass query_class, int count)
{
  Record record;
  record.part = part;
  record.shape = shape.name;
  record.query = name_of(query_class);
  record.program = "Footpoint";
  record.points = count;
  return record;
}

/// The filter on one thread, in processor time.
Record time_filter(const Shape& shape, QueryClass query_class, int count, const Settings& settings)
{
  const FilterTiming timing(shape, make_queries(shape, query_class, count).points);
  std::vector<double> passes;
  repeat_filter(settings,
    [&]
    {
      const double spent = timing.run(1).cpu;
      passes.push_back(1e6 * spent / count);
      return spent;
    });
  Record record = line_of_filter("filter", shape, query_class, count);
  record.microseconds = median(passes);
  return record;
}

/// 1, 2, 4, … threads, up to those of the machine; two at least.
std::vector<int> thread_counts()
{
  const int most = std::max(2, static_cast<int>(std::thread::hardware_concurrency()));
  std::vector<int> counts;
  for (int count = 1; count < most; count *= 2)
  {
    counts.push_back(count);
  }
  counts.push_back(most);
  return counts;
}

/// Wall time by the number of threads, by turns.
void measure_threads(const Shape& shape, int count, const Settings& settings, Records& records)
{
  const FilterTiming timing(shape, make_queries(shape, QueryClass::Off, count).points);
  const std::vector<int> counts = thread_counts();
  std::vector<std::vector<double>> passes(counts.size());
  repeat_filter(settings,
    [&]
    {
      double spent = 0.0;
      for (std::size_t k = 0; k < counts.size(); ++k)
      {
        const double wall = timing.run(counts[k]).wall;
        passes[k].push_back(1e6 * wall / count);
        spent += wall;
      }
      return spent;
    });
  for (std::size_t k = 0; k < counts.size(); ++k)
  {
    Record record = line_of_filter("threads", shape, QueryClass::Off, count);
    record.scale = counts[k];
    record.microseconds = median(passes[k]);
    records.push_back(record);
  }
}

void measure_filter(const Settings& settings, std::ostream& progress, Records& records)
{
  const Shape sheet = bumpy_sheet(40);
  // A run with few points asks for few here too.
  const int most = settings.points < Settings().points ? settings.points : kPointsOfFilter;
  for (const QueryClass query_class : kMainClasses)
  {
    progress << "filter " << name_of(query_class) << ", " << most << " points" << std::endl;
    records.push_back(time_filter(sheet, query_class, most, settings));
  }

  for (int count = kPointsOfFilter / 1000; count <= most; count *= 10)
  {
    progress << "filter " << count << " points" << std::endl;
    Record record = count == kPointsOfFilter
      ? *find(records, "filter", sheet.name, name_of(QueryClass::Off), "Footpoint")
      : time_filter(sheet, QueryClass::Off, count, settings);
    record.part = "points";
    record.scale = count;
    records.push_back(record);
  }

  progress << "filter, threads" << std::endl;
  measure_threads(sheet, most, settings, records);
}
#endif

} // namespace

Records measure_scaling(const Settings& settings, std::ostream& progress)
{
  Records records;
#ifdef BENCHMARK_VTK
  measure_filter(settings, progress, records);
#endif
  measure_large_net(settings, progress, records);
  measure_builds(settings, progress, records);
  measure_pieces(settings, progress, records);
  return records;
}

} // namespace inversion_benchmark
