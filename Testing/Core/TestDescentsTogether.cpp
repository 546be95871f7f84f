// SPDX-License-Identifier: BSD-3-Clause

/// Queries that are searched together have their descents made in the lanes of one vector: every
/// foot has to have the bits that it has alone.

#include "FuzzGeometry.h"
#include "Inversion.h"
#include "OnlyTarget.h"
#include "SlowBuild.h"

using namespace inversion;

namespace
{

/// Points about a few places of a geometry, so that many share a piece.
template <int N, class Geometry>
footpoint::Points crowded_points(shapes::Random& random, const Geometry& geometry)
{
  constexpr int kPlaces = 4;
  constexpr int kEach = 25;
  footpoint::Points points(3, kPlaces * kEach);
  for (int place = 0; place < kPlaces; ++place)
  {
    Parameter<N> middle;
    for (int i = 0; i < N; ++i)
    {
      middle(i) = random.uniform(0.0, geometry.direction(i).length);
    }
    const Vector3 at = geometry.centre() + geometry.point(middle);
    const double reach = geometry.size() * std::pow(10.0, random.uniform(-6.0, -0.5));
    for (int k = 0; k < kEach; ++k)
    {
      points.col(place * kEach + k) = at + reach * random.vector(-1.0, 1.0);
    }
  }
  return points;
}

template <int N>
void expect_same_bits(std::uint64_t seed, int& certified)
{
  shapes::Random random(seed);
  const fuzz::Geometry<N> fuzzed = fuzz::random_geometry<N>(random);
  SCOPED_TRACE(fuzzed.description);
  const auto spline = fuzzed.arrays.geometry();
  const PointInverter inverter(model_of(spline));
  const footpoint::Points points = crowded_points<N>(random, spline);
  const footpoint::InversionResult together = footpoint::invert(inverter, points);
  PointInverter::Workspace workspace;
  for (Eigen::Index k = 0; k < points.cols(); ++k)
  {
    const Foot alone = inverter.find(points.col(k), {}, workspace);
    EXPECT_TRUE(identical(together.feet[k], alone)) << "query " << k;
    certified += alone.status == Status::Certified;
  }
}

} // namespace

/// Degrees 1 to 9, weights, knots of any multiplicity, collapsed sides; with all vector
/// instructions.
TEST(DescentsTogether, HaveTheBitsOfThoseAlone)
{
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets())
  {
    SCOPED_TRACE(hwy::TargetName(target));
    const OnlyTarget only(target);
    int certified = 0;
    constexpr int kSeeds = kSlowBuild ? 8 : 30;
    for (std::uint64_t seed = 0; seed < kSeeds; ++seed)
    {
      expect_same_bits<2>(seed, certified);
      expect_same_bits<1>(seed, certified);
    }
    EXPECT_GT(certified, 190 * kSeeds); // of 200 each: the descents lead somewhere
  }
}

TEST(DescentsTogether, TakePointsThatAreNoneAndAnyNumber)
{
  const PointInverter inverter(model_of(shapes::bumpy(12, 5, 0.3)));
  shapes::Random random(3);
  footpoint::Points points(3, 100);
  for (int k = 0; k < points.cols(); ++k)
  {
    points.col(k) = random.vector(0.3, 0.4);
  }
  points.col(40) = Vector3(NAN, 0, 0);
  PointInverter::Workspace workspace;
  for (const int count : { 0, 1, 2, 7, 8, 9, 31, 32, 33, 40, 41, 100 })
  {
    std::vector<Foot> feet(static_cast<std::size_t>(count));
    inverter.find(points.leftCols(count), {}, workspace, feet.data());
    for (int k = 0; k < count; ++k)
    {
      EXPECT_TRUE(identical(feet[static_cast<std::size_t>(k)], inverter.find(points.col(k))))
        << k << " of " << count;
    }
  }
}
