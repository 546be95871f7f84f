// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/model/deviation_statistics.h"

#include "footpoint/common/exact_sum.h"

#include <algorithm>
#include <cmath>
#include <cstring>

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

template <class Body>
void for_each_value(const Group& group, const Body& body)
{
  for (const Deviations::Part* part : group)
  {
    for (const double value : part->values)
    {
      body(value);
    }
  }
}

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

/// Counts, sums and squares of all groups.
void reduce_sums(const std::vector<Group>& groups, double tolerance, const Reduction& reduction,
  std::vector<DeviationStatistics>& results)
{
  std::vector<std::int64_t> numbers;
  for (const Group& group : groups)
  {
    std::int64_t count = 0;
    std::int64_t outside = 0;
    std::array<std::int64_t, 6> status_counts{};
    for (const Deviations::Part* part : group)
    {
      std::transform(status_counts.begin(), status_counts.end(), part->status_counts.begin(),
        status_counts.begin(), std::plus<>());
    }
    ExactSum sum;
    ExactSum squares;
    for_each_value(group,
      [&](double value)
      {
        ++count;
        outside += std::abs(value) > tolerance ? 1 : 0;
        sum.add(value);
        squares.add(value * value);
      });
    numbers.push_back(count);
    numbers.push_back(outside);
    numbers.insert(numbers.end(), status_counts.begin(), status_counts.end());
    append(sum, numbers);
    append(squares, numbers);
  }
  reduction.sum(numbers);
  auto next = numbers.cbegin();
  for (DeviationStatistics& result : results)
  {
    result.count = *next++;
    const auto count = static_cast<double>(result.count);
    const auto outside = static_cast<double>(*next++);
    std::copy_n(next, result.status_counts.size(), result.status_counts.begin());
    next += static_cast<std::ptrdiff_t>(result.status_counts.size());
    const double sum = take_sum(next).value();
    const double squares = take_sum(next).value();
    if (result.count > 0)
    {
      result.mean = sum / count;
      result.rms = std::sqrt(squares / count);
      result.out_of_tolerance_fraction = outside / count;
    }
  }
}

void reduce_ends(const std::vector<Group>& groups, const Reduction& reduction,
  std::vector<DeviationStatistics>& results)
{
  std::vector<double> ends; // −minimum, maximum
  for (const Group& group : groups)
  {
    double least = std::numeric_limits<double>::infinity();
    double most = -least;
    for_each_value(group,
      [&](double value)
      {
        least = std::min(least, value);
        most = std::max(most, value);
      });
    ends.push_back(-least);
    ends.push_back(most);
  }
  reduction.maximum(ends);
  for (std::size_t g = 0; g < groups.size(); ++g)
  {
    if (results[g].count > 0)
    {
      // Of zeros of both signs either may have come first; + 0.0 makes both the positive one.
      results[g].minimum = 0.0 - ends[2 * g];
      results[g].maximum = ends[2 * g + 1] + 0.0;
    }
  }
}

/// A second pass: the difference of large squares would cancel.
void reduce_standard_deviations(const std::vector<Group>& groups, const Reduction& reduction,
  std::vector<DeviationStatistics>& results)
{
  std::vector<std::int64_t> numbers;
  for (std::size_t g = 0; g < groups.size(); ++g)
  {
    ExactSum squares;
    for_each_value(groups[g],
      [&, mean = results[g].mean](double value)
      {
        const double deviation = value - mean;
        squares.add(deviation * deviation);
      });
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

/// The magnitude of nearest rank, eight bits after eight bits: values that begin with the bits
/// found so far are counted by their next ones.
void reduce_percentiles(const std::vector<Group>& groups, const Reduction& reduction,
  std::vector<DeviationStatistics>& results)
{
  constexpr std::size_t kBins = 256;
  std::vector<std::uint64_t> found(groups.size(), 0);
  std::vector<std::int64_t> rank; // among the values that begin so, from 0
  for (const DeviationStatistics& result : results)
  {
    rank.push_back(
      static_cast<std::int64_t>(std::ceil(0.95 * static_cast<double>(result.count))) - 1);
  }
  for (int shift = 56; shift >= 0; shift -= 8)
  {
    std::vector<std::int64_t> counts(groups.size() * kBins, 0);
    for (std::size_t g = 0; g < groups.size(); ++g)
    {
      for_each_value(groups[g],
        [&, begin = found[g], first = g * kBins](double value)
        {
          const std::uint64_t bits = ordered_bits(std::abs(value)) >> shift;
          if (bits >> 8 == begin)
          {
            ++counts[first + bits % kBins];
          }
        });
    }
    reduction.sum(counts);
    for (std::size_t g = 0; g < groups.size(); ++g)
    {
      std::size_t bin = 0;
      for (; bin + 1 < kBins && rank[g] >= counts[g * kBins + bin]; ++bin)
      {
        rank[g] -= counts[g * kBins + bin];
      }
      found[g] = found[g] << 8 | bin;
    }
  }
  for (std::size_t g = 0; g < groups.size(); ++g)
  {
    if (results[g].count > 0)
    {
      results[g].percentile95 = from_ordered_bits(found[g]);
    }
  }
}

std::vector<DeviationStatistics> reduce_batch(
  const std::vector<Group>& groups, double tolerance, const Reduction& reduction)
{
  std::vector<DeviationStatistics> results(groups.size());
  reduce_sums(groups, tolerance, reduction, results);
  reduce_ends(groups, reduction, results);
  reduce_standard_deviations(groups, reduction, results);
  reduce_percentiles(groups, reduction, results);
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

DeviationStatistics Deviations::of_all(double tolerance, const Reduction& reduction) const
{
  Group all;
  for (const Part& part : this->Parts)
  {
    all.push_back(&part);
  }
  return reduce_batch({ all }, tolerance, reduction).front();
}

std::vector<DeviationStatistics> Deviations::of_faces(
  double tolerance, const Reduction& reduction) const
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
    const auto batch = reduce_batch(groups, tolerance, reduction);
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
