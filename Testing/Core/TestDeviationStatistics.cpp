// SPDX-License-Identifier: BSD-3-Clause

#include "footpoint/model/deviation_statistics.h"

#include "InThreads.h"

#include <gtest/gtest.h>

#include <condition_variable>
#include <mutex>
#include <random>
#include <thread>

using footpoint::deviation_statistics;
using footpoint::Deviations;
using footpoint::DeviationStatistics;
using footpoint::Foot;
using footpoint::Reduction;
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

/// Stands in for message passing: threads that meet, and leave when all have brought their numbers.
class Meeting
{
public:
  explicit Meeting(int members)
    : Members(members)
  {
  }

  Reduction reduction()
  {
    Reduction result;
    result.sum = [this](std::vector<std::int64_t>& numbers)
    { this->meet(numbers, this->Sums, [](std::int64_t a, std::int64_t b) { return a + b; }); };
    result.maximum = [this](std::vector<double>& numbers)
    { this->meet(numbers, this->Maxima, [](double a, double b) { return std::max(a, b); }); };
    return result;
  }

private:
  template <class Number, class Combine>
  void meet(std::vector<Number>& numbers, std::vector<Number>& common, const Combine& combine)
  {
    std::unique_lock<std::mutex> lock(this->Mutex);
    if (this->Here == 0)
    {
      common = numbers;
    }
    else
    {
      std::transform(common.begin(), common.end(), numbers.begin(), common.begin(), combine);
    }
    ++this->Here;
    this->wait_for_all(lock);
    numbers = common;
    --this->Here;
    this->wait_for_all(lock); // before the next numbers come in
  }

  void wait_for_all(std::unique_lock<std::mutex>& lock)
  {
    const int turn = this->Turn;
    if (++this->Waiting == this->Members)
    {
      this->Waiting = 0;
      ++this->Turn;
      this->Change.notify_all();
    }
    this->Change.wait(lock, [&] { return this->Turn != turn; });
  }

  const int Members;
  int Here = 0;
  int Waiting = 0;
  int Turn = 0;
  std::vector<std::int64_t> Sums;
  std::vector<double> Maxima;
  std::mutex Mutex;
  std::condition_variable Change;
};

void expect_same_bits(const DeviationStatistics& a, const DeviationStatistics& b)
{
  EXPECT_EQ(a.count, b.count);
  EXPECT_EQ(a.status_counts, b.status_counts);
  const auto same = [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); };
  EXPECT_TRUE(same(a.minimum, b.minimum));
  EXPECT_TRUE(same(a.maximum, b.maximum));
  EXPECT_TRUE(same(a.mean, b.mean)) << a.mean - b.mean;
  EXPECT_TRUE(same(a.rms, b.rms)) << a.rms - b.rms;
  EXPECT_TRUE(same(a.standard_deviation, b.standard_deviation));
  EXPECT_TRUE(same(a.percentile95, b.percentile95));
  EXPECT_TRUE(same(a.out_of_tolerance_fraction, b.out_of_tolerance_fraction));
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

/// The same bits for every number of processes and every way to share the points out, some
/// processes without any; more faces than are worked on at a time, some without points.
TEST(DeviationStatistics, AreTheSameForAnyNumberOfProcesses)
{
  constexpr int kFaces = 150;
  std::mt19937 generator(4);
  std::vector<Foot> feet;
  for (int k = 0; k < 3000; ++k)
  {
    const double size = std::ldexp(1.0, static_cast<int>(generator() % 40) - 20);
    feet.push_back(foot_at(size * (generator() / 4294967296.0 - 0.3)));
    feet.back().face = static_cast<int>(generator() % kFaces);
    if (k % 17 == 0)
    {
      feet.back() = Foot{}; // an invalid point: no distance, no face
    }
    else if (feet.back().face % 10 == 3)
    {
      feet.back().face = 0;
    }
  }
  Deviations whole(kFaces, feet.size());
  for (const Foot& foot : feet)
  {
    whole.add(foot);
  }
  const DeviationStatistics of_all = whole.of_all(0.5);
  const std::vector<DeviationStatistics> of_faces = whole.of_faces(0.5);
  ASSERT_EQ(of_faces.size(), static_cast<std::size_t>(kFaces));
  EXPECT_EQ(of_faces[3].count, 0);
  EXPECT_TRUE(std::isnan(of_faces[3].percentile95));
  std::int64_t counted = 0;
  for (const DeviationStatistics& face : of_faces)
  {
    counted += face.count;
  }
  EXPECT_EQ(counted, of_all.count);
  EXPECT_EQ(of_all.status_counts[4], (3000 + 16) / 17);

  for (const int processes : { 2, 3, 4 })
  {
    std::shuffle(feet.begin(), feet.end(), generator);
    Meeting meeting(processes);
    std::vector<std::thread> threads;
    for (int rank = 0; rank < processes; ++rank)
    {
      threads.emplace_back(
        [&, rank]
        {
          Deviations part(kFaces);
          for (std::size_t i = 0; i < feet.size(); ++i)
          {
            // Of four processes, number 1 has no points.
            const std::size_t to = i % static_cast<std::size_t>(processes);
            if ((processes == 4 && to == 1 ? 0 : to) == static_cast<std::size_t>(rank))
            {
              part.add(feet[i]);
            }
          }
          expect_same_bits(part.of_all(0.5, meeting.reduction()), of_all);
          const auto faces = part.of_faces(0.5, meeting.reduction());
          for (std::size_t face = 0; face < of_faces.size(); ++face)
          {
            expect_same_bits(faces[face], of_faces[face]);
          }
        });
    }
    for (std::thread& thread : threads)
    {
      thread.join();
    }
  }
}

/// More values than one thread takes at a time: one face with most of them, many with a few.
TEST(DeviationStatistics, AreTheSameForAnyNumberOfThreads)
{
  constexpr int kFaces = 150;
  std::mt19937 generator(5);
  Deviations deviations(kFaces);
  for (int k = 0; k < 150000; ++k)
  {
    const double size = std::ldexp(1.0, static_cast<int>(generator() % 40) - 20);
    Foot foot = foot_at(size * (generator() / 4294967296.0 - 0.3));
    foot.face = generator() % 3 != 0 ? 7 : static_cast<int>(generator() % kFaces);
    deviations.add(foot);
  }
  const DeviationStatistics of_all = deviations.of_all(0.5);
  const std::vector<DeviationStatistics> of_faces = deviations.of_faces(0.5);
  EXPECT_EQ(of_all.count, 150000);
  for (const int threads : { 2, 3, 16 })
  {
    expect_same_bits(deviations.of_all(0.5, {}, in_threads(threads)), of_all);
    const auto faces = deviations.of_faces(0.5, {}, in_threads(threads));
    for (std::size_t face = 0; face < of_faces.size(); ++face)
    {
      expect_same_bits(faces[face], of_faces[face]);
    }
  }
}
