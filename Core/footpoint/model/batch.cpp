// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/model/point_inversion.h"

#include <hwy/cache_control.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <numeric>
#include <utility>

namespace footpoint
{
namespace
{

/// Points that are put in an order of their own: enough for neighbours in space to find in the
/// caches what the ones before them have used, also where they come in no order at all, and sorted
/// in some milliseconds. (On a surface of 300 × 300 spans random points take 13 µs each one by one,
/// 10 in blocks of 8192, 8 in blocks of this size.)
constexpr std::int64_t kBlock = 32768;
/// So many blocks are sorted at once, by several threads; a millisecond and 128 KiB each.
constexpr std::int64_t kSortedAtOnce = 32;

/// Time between two looks at progress and cancellation: long enough to keep threads busy, short for
/// a user who waits. How many points that is depends on geometry and points by powers of ten, so
/// the first pieces are small, and each next one grows by this much at most.
constexpr std::chrono::milliseconds kInterval{ 100 };
constexpr std::chrono::milliseconds kLatest{ 400 };
constexpr std::int64_t kFirstPiece = 64;
constexpr std::int64_t kLargestPiece = kBlock;
constexpr double kGrowth = 8.0;
/// The clock is looked at so often in a piece of the usual points: to ask it for each would take
/// some percent of the time of fast queries.
constexpr std::int64_t kLooks = 64;
/// And after so many points at the latest, the next of which may take a thousand times as long.
constexpr std::int64_t kLongestStride = 128;

/// Points whose feet are sought together: enough for some of them to meet on one piece.
constexpr std::int64_t kGroup = 32;

/// A word of the order along the curve: three coordinates of so many bits each, then the number of
/// the point in its block. (Points crowd together where others are 1e4 times as far out; then they
/// keep the order they came in, which costs time but nothing else.)
constexpr int kBits = 16;
constexpr int kNumberBits = 64 - 3 * kBits;
static_assert(kBlock <= std::int64_t{ 1 } << kNumberBits, "the number of a point must fit");

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

/// Has the memory of a foot ready by the time that it is written to.
void fetch(const Foot& foot)
{
  const char* begin = reinterpret_cast<const char*>(&foot);
  hwy::Prefetch(begin);
  hwy::Prefetch(begin + sizeof(Foot) / 2);
  hwy::Prefetch(begin + sizeof(Foot) - 1);
}

void append(InversionResult& result, std::int64_t point, const std::vector<Foot>& feet)
{
  result.all_feet.insert(result.all_feet.end(), feet.begin(), feet.end());
  result.all_feet_point.insert(result.all_feet_point.end(), feet.size(), point);
}

/// Two zero bits after each of the low 16.
std::uint64_t spread(std::uint64_t bits)
{
  bits = (bits | bits << 16) & 0x0000ff0000ff;
  bits = (bits | bits << 8) & 0x00f00f00f00f;
  bits = (bits | bits << 4) & 0x0c30c30c30c3;
  return (bits | bits << 2) & 0x249249249249;
}

/// Sorts by the bits above the number of the point, eight at a time from the lowest ones. What is
/// equal there keeps its order.
void sort_by_place(std::vector<std::uint64_t>& words)
{
  std::vector<std::uint64_t> sorted(words.size());
  for (int shift = kNumberBits; shift < 64; shift += 8)
  {
    std::array<std::uint32_t, 256> next{};
    for (const std::uint64_t word : words)
    {
      ++next[word >> shift & 0xff];
    }
    std::exclusive_scan(next.begin(), next.end(), next.begin(), std::uint32_t{ 0 });
    for (const std::uint64_t word : words)
    {
      sorted[next[word >> shift & 0xff]++] = word;
    }
    words.swap(sorted);
  }
}

/// The order of points along Morton's curve (G. M. Morton 1966) through their box.
std::vector<std::int32_t> order_along_curve(const Eigen::Ref<const Points>& points)
{
  Box box;
  for (Eigen::Index k = 0; k < points.cols(); ++k)
  {
    if (points.col(k).allFinite())
    {
      box.add({ points.col(k), points.col(k) });
    }
  }
  constexpr double kCells = 1 << kBits;
  // One scale for all directions, so that cells are cubes. Halves, because a width may overflow.
  const double half = (0.5 * box.upper - 0.5 * box.lower).maxCoeff();
  std::vector<std::uint64_t> words(points.cols());
  for (Eigen::Index k = 0; k < points.cols(); ++k)
  {
    std::uint64_t place = 0;
    for (int i = 0; i < 3; ++i)
    {
      const double at = (0.5 * points(i, k) - 0.5 * box.lower(i)) / half;
      // A point that is no number goes first, as do all where they coincide.
      const double cell = at >= 0.0 ? std::min(at * kCells, kCells - 1.0) : 0.0;
      place |= spread(static_cast<std::uint64_t>(cell)) << i;
    }
    words[k] = place << kNumberBits | static_cast<std::uint64_t>(k);
  }
  sort_by_place(words);
  std::vector<std::int32_t> order(words.size());
  constexpr std::uint64_t kNumbers = (std::uint64_t{ 1 } << kNumberBits) - 1;
  std::transform(words.begin(), words.end(), order.begin(),
    [](std::uint64_t word) { return static_cast<std::int32_t>(word & kNumbers); });
  return order;
}

/// The orders of all points of up to kSortedAtOnce blocks, the first of which begins at `begin`.
std::vector<std::vector<std::int32_t>> orders_of_blocks(
  const Eigen::Ref<const Points>& points, std::int64_t begin, const Execution& execution)
{
  const std::int64_t rest = points.cols() - begin;
  std::vector<std::vector<std::int32_t>> orders(
    std::min((rest + kBlock - 1) / kBlock, kSortedAtOnce));
  const auto sort = [&](std::int64_t from, std::int64_t to)
  {
    for (std::int64_t k = from; k < to; ++k)
    {
      const std::int64_t first = k * kBlock;
      orders[k] = order_along_curve(
        points.middleCols(begin + first, std::min(kBlock, rest - first)));
    }
  };
  const auto count = static_cast<std::int64_t>(orders.size());
  count > 1 ? execution.parallel_for(count, sort) : sort(0, count);
  return orders;
}

/// Workspaces of the ranges that threads work on, kept for the next ones: memory that goes back to
/// the system comes back page by page.
class Workspaces
{
public:
  using Pointer = std::unique_ptr<PointInverter::Workspace>;

  Pointer take()
  {
    const std::lock_guard<std::mutex> lock(this->Guard);
    if (this->Idle.empty())
    {
      return std::make_unique<PointInverter::Workspace>();
    }
    Pointer workspace = std::move(this->Idle.back());
    this->Idle.pop_back();
    return workspace;
  }

  void give_back(Pointer workspace)
  {
    const std::lock_guard<std::mutex> lock(this->Guard);
    this->Idle.push_back(std::move(workspace));
  }

private:
  std::mutex Guard;
  std::vector<Pointer> Idle;
};

/// How many points to go on with between two looks at progress.
class Pace
{
public:
  std::int64_t piece() const { return this->Piece; }

  /// Whether the piece takes so much longer than the one before that it is better broken off.
  bool late() const { return Clock::now() - this->Last > kLatest; }

  /// Says that a piece of so many points is done.
  void done(std::int64_t points)
  {
    const Clock::time_point now = Clock::now();
    const double taken = std::chrono::duration<double>(now - this->Last).count();
    const double wanted = std::chrono::duration<double>(kInterval).count();
    const double factor = taken * kGrowth > wanted ? wanted / taken : kGrowth;
    this->Piece = std::clamp<std::int64_t>(
      static_cast<std::int64_t>(factor * static_cast<double>(points)), 1, kLargestPiece);
    this->Last = now;
  }

private:
  using Clock = std::chrono::steady_clock;
  std::int64_t Piece = kFirstPiece;
  Clock::time_point Last = Clock::now();
};

} // namespace

void invert(const PointInverter& inverter, const Eigen::Ref<const Points>& points,
  const std::vector<Start>& starts, const Execution& execution, const FeetTaker& take)
{
  const bool all = wants_all(inverter.options());
  const std::int64_t count = points.cols();
  InversionResult result; // of one block
  std::vector<std::vector<std::int32_t>> orders;
  Workspaces workspaces;
  Pace pace;
  for (std::int64_t begin = 0; begin < count && !result.cancelled; begin += kBlock)
  {
    const std::int64_t block = std::min(kBlock, count - begin);
    const std::int64_t number = begin / kBlock % kSortedAtOnce;
    if (number == 0)
    {
      orders = orders_of_blocks(points, begin, execution);
    }
    std::vector<std::int32_t>& order = orders[number];
    result.feet.resize(block);
    std::vector<std::vector<Foot>> every(all ? block : 0);
    std::vector<char> reached(block, 0); // no bool, of which threads would share words
    for (auto next = order.begin(); next != order.end() && !result.cancelled;)
    {
      const std::int64_t piece = std::min<std::int64_t>(pace.piece(), order.end() - next);
      execution.parallel_for(piece,
        [&](std::int64_t from, std::int64_t to)
        {
          Workspaces::Pointer workspace = workspaces.take();
          const std::int64_t stride =
            std::clamp<std::int64_t>(pace.piece() / kLooks, 1, kLongestStride);
          const std::int64_t most = std::min(kGroup, stride); // few where points take long
          std::int64_t look = from;
          std::vector<Start> group_starts;
          Foot feet[kGroup];
          for (std::int64_t i = from; i < to; i += most)
          {
            // The first points are always done, so that there is progress.
            if (i > 0 && i >= look && pace.late())
            {
              break;
            }
            look = i >= look ? i + stride : look;
            // Points are near each other in space, not in memory.
            const std::int64_t size = std::min(most, to - i);
            Eigen::Matrix<double, 3, kGroup> group;
            group_starts.clear();
            for (std::int64_t j = 0; j < size; ++j)
            {
              const std::int64_t k = begin + next[i + j];
              group.col(j) = points.col(k);
              fetch(result.feet[next[i + j]]);
              if (!starts.empty())
              {
                group_starts.push_back(starts[k]);
              }
            }
            inverter.find(group.leftCols(size), group_starts, *workspace, feet);
            for (std::int64_t j = 0; j < size; ++j)
            {
              const std::int32_t k = next[i + j];
              result.feet[k] = feet[j];
              if (all)
              {
                every[k] = inverter.find_all(
                  group.col(j), group_starts.empty() ? Start{} : group_starts[j]);
              }
              reached[k] = 1;
            }
          }
          workspaces.give_back(std::move(workspace));
        });
      // What was too late for this piece goes first in the next one.
      const auto rest =
        std::stable_partition(next, next + piece, [&](std::int32_t k) { return reached[k]; });
      pace.done(rest - next);
      next = rest;
      const std::int64_t done = begin + (next - order.begin());
      result.cancelled =
        !execution.proceed(static_cast<double>(done) / static_cast<double>(count)) && done < count;
      std::for_each(result.cancelled ? next : order.end(), order.end(),
        [&](std::int32_t k) { result.feet[k] = not_reached(); });
    }
    result.all_feet.clear();
    result.all_feet_point.clear();
    for (std::size_t k = 0; k < every.size(); ++k)
    {
      append(result, begin + static_cast<std::int64_t>(k), every[k]);
    }
    take(begin, result);
  }
}

InversionResult invert(const PointInverter& inverter, const Eigen::Ref<const Points>& points,
  const std::vector<Start>& starts, const Execution& execution)
{
  InversionResult result;
  result.feet.reserve(points.cols());
  invert(inverter, points, starts, execution,
    [&](std::int64_t, const InversionResult& part)
    {
      const auto add = [](auto& all, const auto& some)
      { all.insert(all.end(), some.begin(), some.end()); };
      add(result.feet, part.feet);
      add(result.all_feet, part.all_feet);
      add(result.all_feet_point, part.all_feet_point);
      result.cancelled = part.cancelled;
    });
  result.feet.resize(points.cols(), not_reached());
  return result;
}

InversionResult invert_sequence(
  const PointInverter& inverter, const Eigen::Ref<const Points>& points, const Execution& execution)
{
  const bool all = wants_all(inverter.options());
  const std::int64_t count = points.cols();
  InversionResult result;
  result.feet.assign(count, not_reached());
  Start start;
  PointInverter::Workspace workspace;
  Pace pace;
  std::int64_t since = 0;
  for (std::int64_t k = 0; k < count && !result.cancelled; ++k)
  {
    const Vector3 point = points.col(k);
    const Foot& foot = result.feet[k] = inverter.find(point, start, workspace);
    if (all)
    {
      append(result, k, inverter.find_all(point, start));
    }
    // A point without a foot leaves the start where it was.
    if (foot.face >= 0)
    {
      start = { foot.face, foot.parameter };
    }
    if (++since == pace.piece() || k + 1 == count)
    {
      pace.done(since);
      since = 0;
      result.cancelled =
        !execution.proceed(static_cast<double>(k + 1) / static_cast<double>(count)) &&
        k + 1 < count;
    }
  }
  return result;
}

} // namespace footpoint
