// SPDX-License-Identifier: BSD-3-Clause

// Many points in one call: their order, threads, progress, cancelling, parts.

#include "InThreads.h"
#include "Inversion.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

using namespace inversion;
using footpoint::Execution;
using footpoint::InversionResult;
using footpoint::Points;
using footpoint::Search;
using footpoint::Start;

TEST(Batch, SameBitsForAnySplitAndOrder)
{
  const PointInverter inverter(model_of(shapes::bumpy(12, 5, 0.3), shapes::torus(0.5, 0.2)));
  constexpr int kCount = 3000;
  Points points = random_points(kCount, 6, -0.5, 1.5);
  points.col(17) = Vector3(NAN, 0, 0);
  points.col(18) = Vector3(0, HUGE_VAL, 0);
  points.col(19) = points.col(20);
  points.col(21) = Vector3(1e300, -1e300, 0);
  const InversionResult whole = footpoint::invert(inverter, points);
  const Execution pieces = in_small_ranges();
  const InversionResult split = footpoint::invert(inverter, points, {}, pieces);
  const InversionResult reversed = footpoint::invert(inverter, points.rowwise().reverse());
  const InversionResult part = footpoint::invert(inverter, points.middleCols(100, 777));
  for (int k = 0; k < kCount; ++k)
  {
    EXPECT_TRUE(identical(whole.feet[k], split.feet[k])) << k;
    EXPECT_TRUE(identical(whole.feet[k], reversed.feet[kCount - 1 - k])) << k;
    if (k >= 100 && k < 877)
    {
      EXPECT_TRUE(identical(whole.feet[k], part.feet[k - 100])) << k;
    }
    if (k % 9 == 0)
    {
      EXPECT_TRUE(identical(whole.feet[k], inverter.find(points.col(k)))) << k;
    }
  }
}

/// More than one block is put in order, so that points have other neighbours in other orders.
TEST(Batch, ManyPointsKeepTheirOrder)
{
  constexpr int kCount = 70000;
  const PointInverter inverter(model_of(plate(0, 1)));
  const Points points = random_points(kCount, 16, 0, 1);
  const InversionResult result = footpoint::invert(inverter, points);
  const InversionResult reversed = footpoint::invert(inverter, points.rowwise().reverse());
  int different = 0;
  for (int k = 0; k < kCount; ++k)
  {
    different += !identical(result.feet[k], inverter.find(points.col(k)));
    different += !identical(result.feet[k], reversed.feet[kCount - 1 - k]);
  }
  EXPECT_EQ(different, 0);
}

/// More points than are sorted at once, of which each has its foot right below it.
TEST(Batch, AMillionPointsInThreadsKeepTheirOrder)
{
  const PointInverter inverter(model_of(plate(0, 1)));
  const Points points = random_points((1 << 20) + 100, 17, 0, 1);
  std::int64_t next = 0;
  std::int64_t different = 0;
  footpoint::invert(inverter, points, {}, in_threads(3),
    [&](std::int64_t first, const InversionResult& part)
    {
      different += first != next;
      for (const Foot& foot : part.feet)
      {
        const Vector3 point = points.col(next++);
        different += foot.status != Status::Certified ||
          (foot.point - Vector3(point(0), point(1), 0)).norm() > 1e-12;
      }
    });
  EXPECT_EQ(next, points.cols());
  EXPECT_EQ(different, 0);
}

TEST(Batch, StartsAndAllFeetKeepToTheirPoints)
{
  const PointInverter inverter(model_of(shapes::saddle()), all_feet());
  const Points points = random_points(300, 12, -1, 1);
  const Execution pieces = in_small_ranges();
  const InversionResult result = footpoint::invert(inverter, points, {}, pieces);
  std::size_t at = 0;
  for (int k = 0; k < 300; ++k)
  {
    for (const Foot& foot : inverter.find_all(points.col(k)))
    {
      ASSERT_LT(at, result.all_feet.size());
      EXPECT_EQ(result.all_feet_point[at], k);
      EXPECT_TRUE(identical(result.all_feet[at], foot)) << k;
      ++at;
    }
  }
  EXPECT_EQ(at, result.all_feet.size());
  // Above the tie of the saddle the start decides.
  const PointInverter local(model_of(shapes::saddle()), searching(Search::Local));
  Points axis(3, 300);
  std::vector<Start> starts(300);
  for (int k = 0; k < 300; ++k)
  {
    axis.col(k) = Vector3(0, 0, 1.5 + 0.001 * ((7 * k) % 300));
    const double side = k % 3 == 0 ? 1.0 : -1.0;
    starts[k].parameter = Parameter<2>(0.7 * side, 0.7 * side);
  }
  const InversionResult seeded = footpoint::invert(local, axis, starts, pieces);
  for (int k = 0; k < 300; ++k)
  {
    EXPECT_GT(seeded.feet[k].parameter(0) * starts[k].parameter(0), 0.0) << k;
  }
}

TEST(Batch, ProgressAndCancel)
{
  const PointInverter inverter(model_of(plate(0, 1)));
  const Points points = random_points(10000, 7, 0, 1);
  std::vector<double> fractions;
  Execution execution;
  execution.proceed = [&](double fraction)
  {
    fractions.push_back(fraction);
    return true;
  };
  const InversionResult whole = footpoint::invert(inverter, points, {}, execution);
  EXPECT_FALSE(whole.cancelled);
  ASSERT_GE(fractions.size(), 2u);
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_EQ(fractions.back(), 1.0);
  execution.proceed = [](double) { return false; };
  for (const bool sequence : { false, true })
  {
    const InversionResult result = sequence
      ? footpoint::invert_sequence(inverter, points, execution)
      : footpoint::invert(inverter, points, {}, execution);
    EXPECT_TRUE(result.cancelled);
    ASSERT_EQ(result.feet.size(), 10000u);
    int reached = 0;
    for (int k = 0; k < 10000; ++k)
    {
      const Foot& foot = result.feet[k];
      if (foot.status == Status::Certified)
      {
        ++reached;
        EXPECT_TRUE(identical(foot, whole.feet[k]));
      }
      else
      {
        EXPECT_EQ(foot.status, Status::NotConverged);
        EXPECT_TRUE(std::isnan(foot.distance));
      }
    }
    EXPECT_GT(reached, 0);
    EXPECT_LT(reached, 10000);
  }
}

TEST(Batch, HandsOverTheSameFeetInParts)
{
  const PointInverter inverter(model_of(plate(0, 1)));
  const Points points = random_points(70000, 8, 0, 1);
  const InversionResult whole = footpoint::invert(inverter, points);
  std::int64_t next = 0;
  int parts = 0;
  footpoint::invert(inverter, points, {}, {},
    [&](std::int64_t first, const InversionResult& part)
    {
      EXPECT_EQ(first, next);
      EXPECT_FALSE(part.cancelled);
      for (const Foot& foot : part.feet)
      {
        EXPECT_TRUE(identical(foot, whole.feet[next++]));
      }
      ++parts;
    });
  EXPECT_EQ(next, 70000);
  EXPECT_GT(parts, 1);
}

TEST(Batch, BreaksOffAPieceThatTakesLong)
{
  // A user who cancels waits for less than a second; where nobody cancels nothing is lost.
  const PointInverter inverter(model_of(plate(0, 1)));
  const Points points = random_points(1300, 15, 0, 1);
  Execution execution;
  bool slow = true;
  execution.parallel_for =
    [&](std::int64_t count, const std::function<void(std::int64_t, std::int64_t)>& body)
  {
    const std::int64_t half = count / 2;
    body(0, half);
    if (slow)
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(500));
      slow = false;
    }
    body(half, count);
  };
  std::vector<double> fractions;
  execution.proceed = [&](double fraction)
  {
    fractions.push_back(fraction);
    return true;
  };
  const InversionResult result = footpoint::invert(inverter, points, {}, execution);
  ASSERT_GE(fractions.size(), 3u);
  EXPECT_GT(fractions[0], 0.0);
  // After half a piece of half a second the next ones are short.
  EXPECT_LE(fractions[1] - fractions[0], fractions[0]);
  EXPECT_EQ(fractions.back(), 1.0);
  for (int k = 0; k < 1300; ++k)
  {
    EXPECT_TRUE(identical(result.feet[k], inverter.find(points.col(k)))) << k;
  }
}
