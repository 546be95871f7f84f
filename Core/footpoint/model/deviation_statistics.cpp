// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/model/deviation_statistics.h"

#include <algorithm>
#include <cmath>

namespace footpoint
{
namespace
{

/// A sum with the rounding of every addition kept (A. Neumaier 1974).
class CompensatedSum
{
public:
  void add(double value)
  {
    const double sum = this->Sum + value;
    const bool larger = std::abs(this->Sum) >= std::abs(value);
    this->Lost += larger ? (this->Sum - sum) + value : (value - sum) + this->Sum;
    this->Sum = sum;
  }

  double value() const { return this->Sum + this->Lost; }

private:
  double Sum = 0.0;
  double Lost = 0.0;
};

} // namespace

void Deviations::add(const Foot& foot)
{
  ++this->status_counts[static_cast<int>(foot.status)];
  if (!std::isnan(foot.distance))
  {
    this->values.push_back(std::isnan(foot.signed_distance) ? foot.distance : foot.signed_distance);
  }
}

DeviationStatistics Deviations::statistics(double tolerance) const
{
  DeviationStatistics result;
  result.status_counts = this->status_counts;
  result.count = static_cast<std::int64_t>(this->values.size());
  if (this->values.empty())
  {
    return result;
  }
  const double count = static_cast<double>(this->values.size());
  const auto ends = std::minmax_element(this->values.begin(), this->values.end());
  result.minimum = *ends.first;
  result.maximum = *ends.second;
  CompensatedSum sum;
  CompensatedSum squares;
  for (const double value : this->values)
  {
    sum.add(value);
    squares.add(value * value);
  }
  result.mean = sum.value() / count;
  result.rms = std::sqrt(squares.value() / count);
  // Two passes: the difference of large squares would cancel.
  CompensatedSum deviations;
  std::int64_t outside = 0;
  std::vector<double> magnitudes;
  magnitudes.reserve(this->values.size());
  for (const double value : this->values)
  {
    const double deviation = value - result.mean;
    deviations.add(deviation * deviation);
    magnitudes.push_back(std::abs(value));
    outside += magnitudes.back() > tolerance ? 1 : 0;
  }
  result.standard_deviation = std::sqrt(deviations.value() / count);
  result.out_of_tolerance_fraction = static_cast<double>(outside) / count;
  const auto rank = static_cast<std::ptrdiff_t>(std::ceil(0.95 * count)) - 1;
  std::nth_element(magnitudes.begin(), magnitudes.begin() + rank, magnitudes.end());
  result.percentile95 = magnitudes[rank];
  return result;
}

DeviationStatistics deviation_statistics(const std::vector<Foot>& feet, double tolerance)
{
  Deviations deviations;
  for (const Foot& foot : feet)
  {
    deviations.add(foot);
  }
  return deviations.statistics(tolerance);
}

} // namespace footpoint
