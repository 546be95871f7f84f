// SPDX-License-Identifier: BSD-3-Clause
#include "vector_targets.h"

#include "OnlyTarget.h"
#include "timing.h"

#include <ostream>

namespace inversion_benchmark
{
namespace
{

struct VectorTarget
{
  const char* name;
  std::int64_t bit;
};

/// Those that the search is compiled for, where it runs on x86-64; elsewhere there is one alone.
constexpr std::array<VectorTarget, 3> kTargets{ { { "SSE4", HWY_SSE4 }, { "AVX2", HWY_AVX2 },
  { "AVX-512", HWY_AVX3 } } };

std::vector<VectorTarget> supported_targets()
{
  std::vector<VectorTarget> all;
  for (const VectorTarget& target : kTargets)
  {
    if ((hwy::SupportedTargets() & target.bit) != 0)
    {
      all.push_back(target);
    }
  }
  return all;
}

} // namespace

Records measure_vector_targets(const Settings& settings, std::ostream& progress)
{
  const std::vector<VectorTarget> targets = supported_targets();
  Records records;
  if (targets.size() < 2)
  {
    return records;
  }
  const Shape sheet = bumpy_sheet(40);
  // In one call there is more to do for wide vectors.
  const std::unique_ptr<Peer> ours = make_footpoint_batch();
  ours->build(sheet);
  Settings one_pass = settings;
  one_pass.repeats = 1;
  for (const QueryClass query_class : kMainClasses)
  {
    progress << "vector instructions " << name_of(query_class) << std::endl;
    const Points points = make_queries(sheet, query_class, settings.points).points;
    std::vector<std::vector<double>> passes(targets.size());
    std::vector<Record> lines(targets.size());
    for (int repeat = 0; repeat < settings.repeats; ++repeat)
    {
      for (std::size_t k = 0; k < targets.size(); ++k)
      {
        const OnlyTarget scope(targets[k].bit);
        time_program(*ours, points, one_pass, lines[k]);
        passes[k].push_back(lines[k].microseconds);
      }
    }
    for (std::size_t k = 0; k < targets.size(); ++k)
    {
      lines[k].part = "vectors";
      lines[k].shape = sheet.name;
      lines[k].query = name_of(query_class);
      lines[k].program = targets[k].name;
      lines[k].microseconds = median(passes[k]);
      records.push_back(lines[k]);
    }
  }
  return records;
}

} // namespace inversion_benchmark
