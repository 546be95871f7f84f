// SPDX-License-Identifier: BSD-3-Clause
#include "scaling.h"

#include "timing.h"

#ifdef BENCHMARK_VTK
#include "filter_timing.h"
#endif

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

/// Offset of the points of the larger sheets, in sizes of a piece.
constexpr double kOffset = 0.5;

/// Time against number of pieces: points in the order of a scan, half a piece off.
void measure_pieces(const Settings& settings, std::ostream& progress, Records& records)
{
  for (const std::unique_ptr<Peer>& program : all_peers(settings.ours_only))
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
      record.build = 1e3 * seconds([&] { taken = program->build(sheet); });
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
      const std::unique_ptr<Peer> ours = make_footpoint();
      Record record;
      record.part = "net";
      record.shape = sheet.name;
      record.program = ours->name();
      record.scale = offset;
      std::vector<double> builds;
      for (int repeat = 0; repeat < settings.repeats; ++repeat)
      {
        builds.push_back(1e3 * cpu_seconds([&] { ours->build(sheet); }));
      }
      record.build = median(builds);
      time_program(
        *ours, ordered_queries(sheet, offset / (n - 3), settings.points), settings, record);
      records.push_back(record);
    }
  }
}

#ifdef BENCHMARK_VTK
constexpr int kPointsOfFilter = 1000000;

/// How many points the filter is given: as many as the budget of ten passes allows.
int affordable(const Shape& shape, QueryClass query_class, const Settings& settings, int most)
{
  const int pilot = std::min(1000, most);
  const FilterTiming timing(shape, make_queries(shape, query_class, pilot).points);
  const double rate = timing.run(1).cpu / pilot;
  return static_cast<int>(
    std::min<double>(most, std::max<double>(pilot, 10.0 * settings.budget / rate)));
}

/// A line of the filter on one thread, in processor time.
Record time_filter(const Shape& shape, QueryClass query_class, int count, const Settings& settings)
{
  const FilterTiming timing(shape, make_queries(shape, query_class, count).points);
  Record record;
  record.shape = shape.name;
  record.query = name_of(query_class);
  record.program = "Footpoint";
  record.points = count;
  std::vector<double> passes;
  for (int repeat = 0; repeat < settings.repeats; ++repeat)
  {
    passes.push_back(1e6 * timing.run(1).cpu / count);
  }
  record.microseconds = median(passes);
  return record;
}

/// Wall time on one thread and more, by turns.
void measure_threads(const Shape& shape, int count, const Settings& settings, Records& records)
{
  const FilterTiming timing(shape, make_queries(shape, QueryClass::Off, count).points);
  const std::size_t most = std::max(2U, std::thread::hardware_concurrency());
  std::vector<std::vector<double>> passes(most);
  for (int repeat = 0; repeat < settings.repeats; ++repeat)
  {
    for (std::size_t k = 0; k < most; ++k)
    {
      passes[k].push_back(1e6 * timing.run(static_cast<int>(k) + 1).wall / count);
    }
  }
  for (std::size_t k = 0; k < most; ++k)
  {
    Record record;
    record.part = "threads";
    record.shape = shape.name;
    record.query = name_of(QueryClass::Off);
    record.program = "Footpoint";
    record.points = count;
    record.scale = static_cast<double>(k) + 1.0;
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
    progress << "filter " << name_of(query_class) << std::endl;
    const int count = affordable(sheet, query_class, settings, most);
    records.push_back(time_filter(sheet, query_class, count, settings));
    records.back().part = "filter";
  }

  const int largest = affordable(sheet, QueryClass::Off, settings, most);
  for (int count = 1000; count <= most; count *= 10)
  {
    const int points = std::min(count, largest);
    progress << "filter " << points << " points" << std::endl;
    records.push_back(time_filter(sheet, QueryClass::Off, points, settings));
    records.back().part = "points";
    records.back().scale = points;
    if (points < count)
    {
      break;
    }
  }

  progress << "filter, threads" << std::endl;
  measure_threads(sheet, largest, settings, records);
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
  measure_pieces(settings, progress, records);
  return records;
}

} // namespace inversion_benchmark
