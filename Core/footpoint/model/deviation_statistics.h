// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/model/point_inversion.h"

#include <array>

namespace footpoint
{

/// Statistics of the distances of many points, in model units. Points at status 3 and 4 have no
/// distance: they count in `status_counts` alone.
struct DeviationStatistics
{
  std::int64_t count = 0;
  double minimum = NAN; ///< of the signed distance where there is one, else of the distance
  double maximum = NAN;
  double mean = NAN;
  double rms = NAN;                ///< root of the mean square
  double standard_deviation = NAN; ///< of the population (divided by count)
  double percentile95 = NAN;       ///< of |distance|, nearest rank
  std::array<std::int64_t, 6> status_counts{};
  double out_of_tolerance_fraction = NAN; ///< part of `count` with |distance| above the tolerance
};

/// What statistics need of the points that count, for feet that are not kept.
struct Deviations
{
  std::vector<double> values; ///< signed distances; where there is no sign, distances
  std::array<std::int64_t, 6> status_counts{};

  void add(const Foot& foot);
  /// \param tolerance limit of |distance| in model units; infinity: nothing is out of tolerance
  /// Sums are taken in the order of the points with compensation (Neumaier 1974).
  DeviationStatistics statistics(double tolerance = std::numeric_limits<double>::infinity()) const;
};

/// \param feet all points that count
DeviationStatistics deviation_statistics(
  const std::vector<Foot>& feet, double tolerance = std::numeric_limits<double>::infinity());

} // namespace footpoint
