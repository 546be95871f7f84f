// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/model/point_inversion.h"

#include <algorithm>

namespace footpoint
{
namespace
{

/// Points between two looks at progress and cancellation: some tens of milliseconds of work at up
/// to 30 µs a point; where all feet are sought a point takes a hundred times as long.
constexpr std::int64_t kBlock = 1024;
constexpr std::int64_t kBlockOfAllFeet = 64;

bool wants_all(const InversionOptions& options)
{
  return options.all_feet || !options.fixed_direction.isZero();
}

Foot not_reached()
{
  Foot foot;
  foot.status = Status::NotConverged;
  return foot;
}

/// The feet of one point: the one for `feet` and, if asked for, all.
struct Answer
{
  Foot foot;
  std::vector<Foot> all;
};

Answer answer(const PointInverter& inverter, const Vector3& point, const Start& start, bool all,
  PointInverter::Workspace& workspace)
{
  Answer result;
  result.foot = inverter.find(point, start, workspace);
  if (all)
  {
    result.all = inverter.find_all(point, start);
  }
  return result;
}

void append(InversionResult& result, std::int64_t point, const std::vector<Foot>& feet)
{
  result.all_feet.insert(result.all_feet.end(), feet.begin(), feet.end());
  result.all_feet_point.insert(result.all_feet_point.end(), feet.size(), point);
}

} // namespace

InversionResult invert(const PointInverter& inverter, const Points& points,
  const std::vector<Start>& starts, const Execution& execution)
{
  const bool all = wants_all(inverter.options());
  const std::int64_t count = points.cols();
  InversionResult result;
  result.feet.assign(count, not_reached());
  const std::int64_t step = all ? kBlockOfAllFeet : kBlock;
  for (std::int64_t begin = 0; begin < count && !result.cancelled; begin += step)
  {
    const std::int64_t block = std::min(step, count - begin);
    std::vector<std::vector<Foot>> every(all ? block : 0);
    execution.parallel_for(block,
      [&](std::int64_t from, std::int64_t to)
      {
        PointInverter::Workspace workspace;
        for (std::int64_t k = from; k < to; ++k)
        {
          const Start start = starts.empty() ? Start{} : starts[begin + k];
          Answer found = answer(inverter, points.col(begin + k), start, all, workspace);
          result.feet[begin + k] = found.foot;
          if (all)
          {
            every[k] = std::move(found.all);
          }
        }
      });
    for (std::size_t k = 0; k < every.size(); ++k)
    {
      append(result, begin + static_cast<std::int64_t>(k), every[k]);
    }
    result.cancelled =
      !execution.proceed(static_cast<double>(begin + block) / count) && begin + block < count;
  }
  return result;
}

InversionResult invert_sequence(
  const PointInverter& inverter, const Points& points, const Execution& execution)
{
  const bool all = wants_all(inverter.options());
  const std::int64_t step = all ? kBlockOfAllFeet : kBlock;
  const std::int64_t count = points.cols();
  InversionResult result;
  result.feet.assign(count, not_reached());
  Start start;
  PointInverter::Workspace workspace;
  for (std::int64_t k = 0; k < count && !result.cancelled; ++k)
  {
    Answer found = answer(inverter, points.col(k), start, all, workspace);
    result.feet[k] = found.foot;
    append(result, k, found.all);
    // A point without a foot leaves the start where it was.
    if (found.foot.face >= 0)
    {
      start = { found.foot.face, found.foot.parameter };
    }
    if ((k + 1) % step == 0)
    {
      result.cancelled = !execution.proceed(static_cast<double>(k + 1) / count);
    }
  }
  return result;
}

} // namespace footpoint
