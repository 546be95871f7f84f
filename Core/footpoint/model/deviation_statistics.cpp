// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/model/deviation_statistics.h"

#include "footpoint/common/exact_sum.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <mutex>
#include <numeric>

namespace footpoint
{
namespace
{

/// Points that have statistics of their own: those of some parts.
using Group = std::vector<const Deviations::Part*>;

/// Groups that are worked on together: few calls of the reduction, and little memory (256 counts a
/// group, 8 bytes each, make 256 KiB).
constexpr std::size_t kBatch = 128;

/// The digits of a double that is not negative, as a number that grows with it.
std::uint64_t ordered_bits(double magnitude)
{
  std::uint64_t bits;
  std::memcpy(&bits, &magnitude, sizeof(bits));
  return bits;
}

double from_ordered_bits(std::uint64_t bits)
{
  double magnitude;
  std::memcpy(&magnitude, &bits, sizeof(magnitude));
  return magnitude;
}

/// Values that a thread works on at a time.
constexpr std::size_t kRange = 32768;

/// Groups whose values are looked at over and over, by several threads.
class Values
{
public:
  Values(const std::vector<Group>& groups, const Execution& execution)
    : Groups(groups.size())
    , Threads(execution)
  {
    for (std::size_t g = 0; g < groups.size(); ++g)
    {
      for (const Deviations::Part* part : groups[g])
      {
        const std::vector<double>& values = part->values;
        for (std::size_t first = 0; first < values.size(); first += kRange)
        {
          const double* begin = values.data() + first;
          this->Ranges.push_back({ g, begin, begin + std::min(kRange, values.size() - first) });
        }
      }
    }
  }

  /// Sums of each group. What Sums does must not depend on the order in which values come or sums
  /// of some of them are put together.
  /// \param take void(Sums& sums, std::size_t group, double value)
  template <class Sums, class Take>
  std::vector<Sums> sums(const Take& take) const
  {
    std::vector<Sums> all(this->Groups);
    std::mutex guard;
    const auto work = [&](std::int64_t begin, std::int64_t end)
    {
      for (auto range = this->Ranges.begin() + begin; range != this->Ranges.begin() + end; ++range)
      {
        Sums own;
        for (const double* value = range->begin; value != range->end; ++value)
        {
          take(own, range->group, *value);
        }
        const std::lock_guard<std::mutex> lock(guard);
        all[range->group].add(own);
      }
    };
    const auto count = static_cast<std::int64_t>(this->Ranges.size());
    if (this->is_long())
    {
      this->Threads.parallel_for(count, work);
    }
    else
    {
      work(0, count); // over before threads have begun
    }
    return all;
  }

private:
  struct Range
  {
    std::size_t group;
    const double* begin;
    const double* end;
  };

  bool is_long() const
  {
    const auto add = [](std::size_t sum, const Range& range)
    { return sum + static_cast<std::size_t>(range.end - range.begin); };
    return std::accumulate(this->Ranges.begin(), this->Ranges.end(), std::size_t{ 0 }, add) >
      2 * kRange;
  }

  std::size_t Groups;
  const Execution& Threads;
  std::vector<Range> Ranges;
};

/// What one look at the values tells.
struct FirstSums
{
  std::int64_t count = 0;
  std::int64_t outside = 0; ///< beyond the tolerance
  ExactSum sum;
  ExactSum squares;
  double minimum = std::numeric_limits<double>::infinity();
  double maximum = -std::numeric_limits<double>::infinity();

  void add(const FirstSums& other)
  {
    this->count += other.count;
    this->outside += other.outside;
    this->sum.add(other.sum);
    this->squares.add(other.squares);
    this->minimum = std::min(this->minimum, other.minimum);
    this->maximum = std::max(this->maximum, other.maximum);
  }
};

void append(const ExactSum& sum, std::vector<std::int64_t>& numbers)
{
  const ExactSum::Numbers own = sum.numbers();
  numbers.insert(numbers.end(), own.begin(), own.end());
}

ExactSum take_sum(std::vector<std::int64_t>::const_iterator& next)
{
  ExactSum::Numbers numbers;
  std::copy_n(next, numbers.size(), numbers.begin());
  next += static_cast<std::ptrdiff_t>(numbers.size());
  return ExactSum::from_numbers(numbers);
}

/// Counts, sums, squares and ends of all groups.
void reduce_sums(const std::vector<Group>& groups, const Values& values, double tolerance,
  const Reduction& reduction, std::vector<DeviationStatistics>& results)
{
  const auto sums = values.sums<FirstSums>(
    [tolerance](FirstSums& own, std::size_t, double value)
    {
      ++own.count;
      own.outside += std::abs(value) > tolerance ? 1 : 0;
      own.sum.add(value);
      own.squares.add(value * value);
      own.minimum = std::min(own.minimum, value);
      own.maximum = std::max(own.maximum, value);
    });
  std::vector<std::int64_t> numbers;
  std::vector<double> ends; // −minimum, maximum
  for (std::size_t g = 0; g < groups.size(); ++g)
  {
    std::array<std::int64_t, 6> status_counts{};
    for (const Deviations::Part* part : groups[g])
    {
      std::transform(status_counts.begin(), status_counts.end(), part->status_counts.begin(),
        status_counts.begin(), std::plus<>());
    }
    numbers.push_back(sums[g].count);
    numbers.push_back(sums[g].outside);
    numbers.insert(numbers.end(), status_counts.begin(), status_counts.end());
    append(sums[g].sum, numbers);
    append(sums[g].squares, numbers);
    ends.push_back(-sums[g].minimum);
    ends.push_back(sums[g].maximum);
  }
  reduction.sum(numbers);
  reduction.maximum(ends);
  auto next = numbers.cbegin();
  auto end = ends.cbegin();
  for (DeviationStatistics& result : results)
  {
    result.count = *next++;
    const auto count = static_cast<double>(result.count);
    const auto outside = static_cast<double>(*next++);
    std::copy_n(next, result.status_counts.size(), result.status_counts.begin());
    next += static_cast<std::ptrdiff_t>(result.status_counts.size());
    const double sum = take_sum(next).value();
    const double squares = take_sum(next).value();
    const double least = -*end++;
    const double most = *end++;
    if (result.count > 0)
    {
      result.mean = sum / count;
      result.rms = std::sqrt(squares / count);
      result.out_of_tolerance_fraction = outside / count;
      // Of zeros of both signs either may have come first; + 0.0 makes both the positive one.
      result.minimum = least + 0.0;
      result.maximum = most + 0.0;
    }
  }
}

/// A second pass: the difference of large squares would cancel.
void reduce_standard_deviations(
  const Values& values, const Reduction& reduction, std::vector<DeviationStatistics>& results)
{
  const auto squares_of_groups = values.sums<ExactSum>(
    [&results](ExactSum& own, std::size_t group, double value)
    {
      const double deviation = value - results[group].mean;
      own.add(deviation * deviation);
    });
  std::vector<std::int64_t> numbers;
  for (const ExactSum& squares : squares_of_groups)
  {
    append(squares, numbers);
  }
  reduction.sum(numbers);
  auto next = numbers.cbegin();
  for (DeviationStatistics& result : results)
  {
    const double squares = take_sum(next).value();
    if (result.count > 0)
    {
      result.standard_deviation = std::sqrt(squares / static_cast<double>(result.count));
    }
  }
}

/// How many values go on with each number of eight bits.
struct Bins
{
  static constexpr std::size_t kCount = 256;
  std::array<std::int64_t, kCount> counts{};

  void add(const Bins& other)
  {
    std::transform(this->counts.begin(), this->counts.end(), other.counts.begin(),
      this->counts.begin(), std::plus<>());
  }
};

/// The magnitude of nearest rank, eight bits after eight bits: values that begin with the bits
/// found so far are counted by their next ones.
void reduce_percentiles(
  const Values& values, const Reduction& reduction, std::vector<DeviationStatistics>& results)
{
  std::vector<std::uint64_t> found(results.size(), 0);
  std::vector<std::int64_t> rank; // among the values that begin so, from 0
  for (const DeviationStatistics& result : results)
  {
    rank.push_back(
      static_cast<std::int64_t>(std::ceil(0.95 * static_cast<double>(result.count))) - 1);
  }
  for (int shift = 56; shift >= 0; shift -= 8)
  {
    const auto bins = values.sums<Bins>(
      [&found, shift](Bins& own, std::size_t group, double value)
      {
        const std::uint64_t bits = ordered_bits(std::abs(value)) >> shift;
        own.counts[bits % Bins::kCount] += bits >> 8 == found[group] ? 1 : 0;
      });
    std::vector<std::int64_t> counts;
    for (const Bins& own : bins)
    {
      counts.insert(counts.end(), own.counts.begin(), own.counts.end());
    }
    reduction.sum(counts);
    for (std::size_t g = 0; g < results.size(); ++g)
    {
      const std::int64_t* const own = counts.data() + g * Bins::kCount;
      std::size_t bin = 0;
      for (; bin + 1 < Bins::kCount && rank[g] >= own[bin]; ++bin)
      {
        rank[g] -= own[bin];
      }
      found[g] = found[g] << 8 | bin;
    }
  }
  for (std::size_t g = 0; g < results.size(); ++g)
  {
    if (results[g].count > 0)
    {
      results[g].percentile95 = from_ordered_bits(found[g]);
    }
  }
}

std::vector<DeviationStatistics> reduce_batch(const std::vector<Group>& groups, double tolerance,
  const Reduction& reduction, const Execution& execution)
{
  const Values values(groups, execution);
  std::vector<DeviationStatistics> results(groups.size());
  reduce_sums(groups, values, tolerance, reduction, results);
  reduce_standard_deviations(values, reduction, results);
  reduce_percentiles(values, reduction, results);
  return results;
}

} // namespace

void Deviations::add(const Foot& foot)
{
  Part& part =
    foot.face >= 0 ? this->Parts[static_cast<std::size_t>(foot.face)] : this->Parts.back();
  ++part.status_counts[static_cast<std::size_t>(foot.status)];
  if (!std::isnan(foot.distance))
  {
    part.values.push_back(std::isnan(foot.signed_distance) ? foot.distance : foot.signed_distance);
  }
}

DeviationStatistics Deviations::of_all(
  double tolerance, const Reduction& reduction, const Execution& execution) const
{
  Group all;
  for (const Part& part : this->Parts)
  {
    all.push_back(&part);
  }
  return reduce_batch({ all }, tolerance, reduction, execution).front();
}

std::vector<DeviationStatistics> Deviations::of_faces(
  double tolerance, const Reduction& reduction, const Execution& execution) const
{
  std::vector<DeviationStatistics> results;
  const std::size_t faces = this->Parts.size() - 1;
  for (std::size_t first = 0; first < faces; first += kBatch)
  {
    std::vector<Group> groups;
    for (std::size_t face = first; face < std::min(first + kBatch, faces); ++face)
    {
      groups.push_back({ &this->Parts[face] });
    }
    const auto batch = reduce_batch(groups, tolerance, reduction, execution);
    results.insert(results.end(), batch.begin(), batch.end());
  }
  return results;
}

DeviationStatistics deviation_statistics(const std::vector<Foot>& feet, double tolerance)
{
  int last = -1;
  for (const Foot& foot : feet)
  {
    last = std::max(last, foot.face);
  }
  Deviations deviations(static_cast<std::size_t>(last + 1));
  for (const Foot& foot : feet)
  {
    deviations.add(foot);
  }
  return deviations.of_all(tolerance);
}

} // namespace footpoint
