// SPDX-License-Identifier: BSD-3-Clause

// Lists of all feet are complete: by Poincaré and Hopf's theorem, by a dense grid, and where the
// feet form continua.

#include "Inversion.h"
#include "OracleShapes.h"

#include <algorithm>
#include <chrono>
#include <cmath>

using namespace inversion;
using footpoint::KnotVector;
using footpoint::Points;
using footpoint::Surface;

namespace
{

InversionOptions all_orthogonal()
{
  InversionOptions options = orthogonal_only();
  options.all_feet = true;
  return options;
}

/// A bicubic torus with bumps, periodic and twice continuously differentiable; with weights if
/// asked for.
Surface bumpy_torus(int n, std::uint64_t seed, double height, bool rational)
{
  shapes::Random random(seed);
  std::vector<Vector3> poles;
  std::vector<double> weights;
  for (int k = 0; k < n * n; ++k)
  {
    const double u = 2.0 * std::acos(-1.0) * (k % n) / n;
    const double v = 2.0 * std::acos(-1.0) * (k / n) / n;
    const double radius = 1.0 + random.uniform(-height, height);
    const double axis = 3.0 + radius * std::cos(v);
    poles.emplace_back(axis * std::cos(u), axis * std::sin(u), radius * std::sin(v));
    weights.push_back(random.uniform(0.7, 1.4));
  }
  Points net(3, (n + 3) * (n + 3));
  Eigen::VectorXd all(net.cols());
  for (int k = 0; k < net.cols(); ++k)
  {
    const int pole = (k / (n + 3)) % n * n + k % (n + 3) % n;
    net.col(k) = poles[pole];
    all(k) = weights[pole];
  }
  const std::vector<double> knots = shapes::uniform_knots(3, n);
  return Surface(KnotVector(3, knots, "KnotsU"), KnotVector(3, knots, "KnotsV"), net,
    rational ? all : Eigen::VectorXd());
}

/// ½|S − P|² by the oracle, at wrapped parameters.
double energy(const oracle::Spline<2>& exact, const Vector3& query, double u, double v, int n)
{
  const auto wrap = [n](double t) { return static_cast<oracle::Real>(t - n * std::floor(t / n)); };
  const auto point = exact.point({ wrap(u), wrap(v) });
  oracle::Real sum = 0.0L;
  for (int i = 0; i < 3; ++i)
  {
    sum += (point[i] - query(i)) * (point[i] - query(i));
  }
  return static_cast<double>(0.5L * sum);
}

/// 0, 1 or 2 negative second derivatives, by differences.
int index_of(const oracle::Spline<2>& exact, const Vector3& query, const Foot& foot, int n)
{
  constexpr double kStep = 1e-4;
  const auto e = [&](int i, int j)
  { return energy(exact, query, foot.parameter(0) + kStep * i, foot.parameter(1) + kStep * j, n); };
  const double here = e(0, 0);
  const double uu = e(1, 0) + e(-1, 0) - 2.0 * here;
  const double vv = e(0, 1) + e(0, -1) - 2.0 * here;
  const double uv = 0.25 * (e(1, 1) + e(-1, -1) - e(1, -1) - e(-1, 1));
  const bool definite = uu * vv - uv * uv > 0.0;
  return definite ? (uu > 0.0 ? 0 : 2) : 1;
}

} // namespace

/// On a torus there are as many saddles of the distance as minima and maxima together (H. Poincaré
/// 1885, H. Hopf 1927), so that a missing foot shows.
TEST(StationaryPoints, IndicesOnATorusAddUpToZero)
{
  constexpr int kPoles = 10;
  for (const bool rational : { false, true })
  {
    const Surface torus = bumpy_torus(kPoles, 51, 0.3, rational);
    const oracle::Spline<2> exact = shapes::spline_of(torus);
    const PointInverter orthogonal(model_of(torus), all_orthogonal());
    const PointInverter minima(model_of(torus), all_feet());
    shapes::Random random(52);
    std::size_t most = 0;
    for (int k = 0; k < 60; ++k)
    {
      const Vector3 query = random.vector(-4.5, 4.5);
      int count[] = { 0, 0, 0 };
      const std::vector<Foot> feet = orthogonal.find_all(query);
      for (const Foot& foot : feet)
      {
        ++count[index_of(exact, query, foot, kPoles)];
      }
      most = std::max(most, feet.size());
      EXPECT_EQ(count[0] + count[2], count[1]) << query.transpose();
      EXPECT_EQ(minima.find_all(query).size(), static_cast<std::size_t>(count[0]))
        << query.transpose();
    }
    EXPECT_GE(most, 10u);
  }
}

/// Every minimum among the points of a dense grid has a foot no farther away.
TEST(StationaryPoints, MinimaOfADenseGrid)
{
  constexpr int kGrid = 200;
  const Surface surface = shapes::bumpy(9, 53, 0.3);
  const oracle::Spline<2> exact = shapes::spline_of(surface);
  std::vector<Vector3> grid;
  for (int k = 0; k < (kGrid + 1) * (kGrid + 1); ++k)
  {
    const auto point =
      exact.point({ k % (kGrid + 1) / oracle::Real(kGrid), k / (kGrid + 1) / oracle::Real(kGrid) });
    grid.emplace_back(point[0], point[1], point[2]);
  }
  const PointInverter inverter(model_of(surface), all_feet());
  shapes::Random random(54);
  for (int k = 0; k < 40; ++k)
  {
    const Vector3 query(random.uniform(0, 1), random.uniform(0, 1), random.uniform(-0.5, 0.5));
    const std::vector<Foot> feet = inverter.find_all(query);
    for (int i = 0; i <= kGrid; ++i)
    {
      for (int j = 0; j <= kGrid; ++j)
      {
        const double here = (grid[i * (kGrid + 1) + j] - query).norm();
        bool lowest = true;
        for (int a = std::max(i - 1, 0); a <= std::min(i + 1, kGrid); ++a)
        {
          for (int b = std::max(j - 1, 0); b <= std::min(j + 1, kGrid); ++b)
          {
            lowest = lowest && (grid[a * (kGrid + 1) + b] - query).norm() >= here;
          }
        }
        const auto below = [&](const Foot& foot)
        {
          return foot.distance <= here + 1e-12 && std::abs(foot.parameter(0) * kGrid - j) <= 3.0 &&
            std::abs(foot.parameter(1) * kGrid - i) <= 3.0;
        };
        EXPECT_TRUE(!lowest || std::any_of(feet.begin(), feet.end(), below))
          << query.transpose() << " at " << j << ", " << i;
      }
    }
  }
}

TEST(StationaryPoints, WithinTheMaximumDistanceTheListIsTheSame)
{
  const Surface surface = shapes::bumpy(20, 55, 0.1);
  for (InversionOptions options : { all_feet(), all_orthogonal() })
  {
    const PointInverter everywhere(model_of(surface), options);
    options.maximum_distance = 0.2;
    const PointInverter near(model_of(surface), options);
    shapes::Random random(56);
    for (int k = 0; k < 50; ++k)
    {
      const Vector3 query = random.vector(-0.1, 1.1);
      std::vector<Foot> expected = everywhere.find_all(query);
      expected.erase(std::remove_if(expected.begin(), expected.end(),
                       [](const Foot& foot) { return foot.distance > 0.2; }),
        expected.end());
      const std::vector<Foot> feet = near.find_all(query);
      ASSERT_EQ(feet.size(), expected.size()) << query.transpose();
      for (std::size_t i = 0; i < feet.size(); ++i)
      {
        EXPECT_NEAR(feet[i].distance, expected[i].distance, 1e-14);
      }
    }
  }
}

TEST(StationaryPoints, TheNearestOrthogonalFootIsTheFirstOfAll)
{
  const Surface surface = shapes::bumpy(12, 57, 0.2);
  const PointInverter every(model_of(surface), all_orthogonal());
  const PointInverter nearest(model_of(surface), orthogonal_only());
  shapes::Random random(58);
  for (int k = 0; k < 100; ++k)
  {
    const Vector3 query = random.vector(-0.3, 1.3);
    const std::vector<Foot> feet = every.find_all(query);
    const Foot foot = nearest.find(query);
    EXPECT_EQ(foot.status == Status::NoOrthogonalFoot, feet.empty()) << query.transpose();
    if (!feet.empty())
    {
      EXPECT_NEAR(foot.distance, feet[0].distance, 1e-14);
    }
  }
}

/// A quarter of a cylinder whose rulings are sheared, so that the feet of a point on the axis run
/// across the parameters; and a trough whose focal line lies along its diagonal.
TEST(StationaryPoints, ContinuaAndFocalPointsEndInBoundedWork)
{
  const double root = std::sqrt(0.5);
  Points sheared(3, 9);
  Points trough(3, 9);
  Eigen::VectorXd weights(9);
  for (int k = 0; k < 9; ++k)
  {
    const int i = k % 3;
    const int j = k / 3;
    sheared.col(k) = Vector3(i<2, i> 0, i + j);
    weights(k) = i == 1 ? root : 1.0;
    const double square_u = i == 1 ? -1.0 : 1.0; // blossom of x² over [−1, 1]
    const double square_v = j == 1 ? -1.0 : 1.0;
    trough.col(k) = Vector3(i - 1, j - 1, square_u + square_v + 2.0 * (i - 1) * (j - 1));
  }
  const KnotVector knots(2, { 0, 0, 0, 1, 1, 1 }, "Knots");
  const auto begin = std::chrono::steady_clock::now();
  for (const InversionOptions& options : { all_feet(), all_orthogonal() })
  {
    const PointInverter axis(model_of(Surface(knots, knots, sheared, weights)), options);
    const std::vector<Foot> feet = axis.find_all({ 0, 0, 1.5 });
    ASSERT_EQ(feet.size(), 1u);
    EXPECT_NEAR(feet[0].distance, 1.0, 1e-14);
    EXPECT_FALSE(feet[0].isolated);
    // z = (x + y)² is 2s² across: its focal line is ¼ above the bottom.
    const PointInverter focal(model_of(Surface(knots, knots, trough)), options);
    const std::vector<Foot> foot = focal.find_all({ 0, 0, 0.25 });
    ASSERT_EQ(foot.size(), 1u);
    EXPECT_NEAR(foot[0].distance, 0.25, 1e-14);
    EXPECT_TRUE(foot[0].isolated);
    EXPECT_EQ(PointInverter(model_of(shapes::torus()), options).find_all({ 0, 0, 0.7 }).size(),
      options.orthogonal_only ? 2u : 1u);
  }
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
  EXPECT_LT(taken.count(), 5.0); // some milliseconds; without bounds it would be minutes
}
