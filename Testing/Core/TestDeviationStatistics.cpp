// SPDX-License-Identifier: BSD-3-Clause

#include "footpoint/model/deviation_statistics.h"

#include <gtest/gtest.h>

using footpoint::deviation_statistics;
using footpoint::DeviationStatistics;
using footpoint::Foot;
using footpoint::Status;

namespace
{

Foot foot_at(double signed_distance)
{
  Foot foot;
  foot.status = Status::Converged;
  foot.distance = std::abs(signed_distance);
  foot.signed_distance = signed_distance;
  return foot;
}

} // namespace

TEST(DeviationStatistics, OfTheNumbersOneToAHundred)
{
  std::vector<Foot> feet;
  for (int k = 100; k >= 1; --k)
  {
    feet.push_back(foot_at(k));
  }
  const DeviationStatistics result = deviation_statistics(feet, 90.0);
  EXPECT_EQ(result.count, 100);
  EXPECT_EQ(result.minimum, 1.0);
  EXPECT_EQ(result.maximum, 100.0);
  EXPECT_DOUBLE_EQ(result.mean, 50.5);
  EXPECT_DOUBLE_EQ(result.rms, std::sqrt(3383.5));
  EXPECT_DOUBLE_EQ(result.standard_deviation, std::sqrt(9999.0 / 12.0));
  EXPECT_EQ(result.percentile95, 95.0); // nearest rank: the 95th of 100
  EXPECT_DOUBLE_EQ(result.out_of_tolerance_fraction, 0.1);
}

TEST(DeviationStatistics, SignsAndNearestRanks)
{
  EXPECT_EQ(deviation_statistics({ foot_at(-3.0) }).percentile95, 3.0);
  std::vector<Foot> feet;
  for (const double value : { -5.0, 1.0, 2.0, 3.0 })
  {
    feet.push_back(foot_at(value));
  }
  const DeviationStatistics result = deviation_statistics(feet);
  EXPECT_EQ(result.minimum, -5.0);
  EXPECT_EQ(result.maximum, 3.0);
  EXPECT_EQ(result.mean, 0.25);
  EXPECT_EQ(result.percentile95, 5.0); // rank ⌈3.8⌉ of |distance|
  EXPECT_EQ(result.out_of_tolerance_fraction, 0.0);
  for (int count : { 19, 20, 21, 40, 41 })
  {
    std::vector<Foot> ranks;
    for (int k = 1; k <= count; ++k)
    {
      ranks.push_back(foot_at(k % 2 == 0 ? k : -k));
    }
    EXPECT_EQ(deviation_statistics(ranks).percentile95, (95 * count + 99) / 100) << count;
  }
}

TEST(DeviationStatistics, PointsWithoutADistanceOnlyCountByStatus)
{
  std::vector<Foot> feet{ foot_at(2.0), Foot{}, Foot{} }; // Foot{} is an invalid point
  feet[2].status = Status::BeyondMaximumDistance;
  feet.push_back(foot_at(4.0));
  feet.back().status = Status::NotConverged;
  // A foot on a curve has no sign: its distance counts.
  feet.push_back(foot_at(-6.0));
  feet.back().signed_distance = NAN;
  const DeviationStatistics result = deviation_statistics(feet, 5.0);
  EXPECT_EQ(result.count, 3);
  EXPECT_EQ(result.mean, 4.0);
  EXPECT_EQ(result.status_counts, (std::array<std::int64_t, 6>{ { 0, 2, 1, 1, 1, 0 } }));
  EXPECT_DOUBLE_EQ(result.out_of_tolerance_fraction, 1.0 / 3.0);
  const DeviationStatistics none = deviation_statistics({ Foot{} });
  EXPECT_EQ(none.count, 0);
  EXPECT_TRUE(std::isnan(none.mean));
  EXPECT_TRUE(std::isnan(none.percentile95));
  EXPECT_EQ(deviation_statistics({}).count, 0);
}

TEST(DeviationStatistics, LoseNoDigitsToALargeOffset)
{
  std::vector<Foot> feet;
  for (int k = 0; k < 1000; ++k)
  {
    feet.push_back(foot_at(1e8 + (k % 2 == 0 ? 1.0 : -1.0)));
  }
  const DeviationStatistics result = deviation_statistics(feet);
  EXPECT_EQ(result.mean, 1e8);
  EXPECT_EQ(result.standard_deviation, 1.0);
}
