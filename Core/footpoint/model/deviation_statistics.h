// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/common/execution.h"
#include "footpoint/common/reduction.h"
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

/// What statistics need of the points that count, for feet that are not kept: a number a point,
/// kept by faces.
///
/// All results have the same bits whatever the order of the points and however they are shared out
/// among threads and processes: sums are exact until they are rounded (see ExactSum), and the
/// percentile is found digit by digit from counts, with no number sent elsewhere. Beside the
/// numbers it takes a fixed amount of memory.
class Deviations
{
public:
  /// \param faces  of the model; on all processes the same
  /// \param points that will be added here, at most; 0: unknown
  explicit Deviations(std::size_t faces, std::size_t points = 0)
    : Parts(faces + 1)
  {
    // How many fall to each of several faces is not known.
    this->Parts.front().values.reserve(faces == 1 ? points : 0);
  }

  /// \param foot its face is one of the model's, or −1
  void add(const Foot& foot);

  /// Of all points of all processes.
  /// \param tolerance limit of |distance| in model units; infinity: nothing is out of tolerance
  /// \param execution only its parallel_for is used
  DeviationStatistics of_all(double tolerance = std::numeric_limits<double>::infinity(),
    const Reduction& reduction = {}, const Execution& execution = {}) const;

  /// Of the points with their foot on each face, by face.
  std::vector<DeviationStatistics> of_faces(
    double tolerance = std::numeric_limits<double>::infinity(), const Reduction& reduction = {},
    const Execution& execution = {}) const;

  struct Part
  {
    std::vector<double> values; ///< signed distances; where there is no sign, distances
    std::array<std::int64_t, 6> status_counts{};
  };

private:
  std::vector<Part> Parts; ///< by face; last: of points without one
};

/// \param feet all points that count
DeviationStatistics deviation_statistics(
  const std::vector<Foot>& feet, double tolerance = std::numeric_limits<double>::infinity());

} // namespace footpoint
