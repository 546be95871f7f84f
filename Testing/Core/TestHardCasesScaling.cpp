// SPDX-License-Identifier: BSD-3-Clause

// The table of hard cases: S9, badly scaled surfaces against their well-scaled twins, and S10,
// surfaces far from the origin.

#include "Inversion.h"
#include "OracleNearest.h"
#include "OracleShapes.h"

using namespace inversion;
using footpoint::KnotVector;
using footpoint::Surface;

namespace
{

/// Random queries around the unit square, on the surface, near it and far from it.
std::vector<Vector3> queries(const Surface& surface, int count, std::uint64_t seed)
{
  shapes::Random random(seed);
  std::vector<Vector3> result;
  for (int k = 0; k < count; ++k)
  {
    const Parameter<2> t(random.uniform(0, surface.direction(0).length),
      random.uniform(0, surface.direction(1).length));
    const double off = k % 4 == 0 ? 0.0 : std::pow(10.0, -(k % 4) + 1);
    result.push_back(surface.centre() + surface.point(t) + off * random.vector(-1, 1));
  }
  return result;
}

/// The net of a surface on other knots and with other weights.
Surface with_knots(
  const Surface& surface, const std::array<double, 2>& scale, const std::array<double, 2>& start)
{
  std::array<std::vector<double>, 2> knots{ { surface.knots(0).knots(),
    surface.knots(1).knots() } };
  for (int i = 0; i < 2; ++i)
  {
    for (double& knot : knots[i])
    {
      knot = start[i] + scale[i] * knot;
    }
  }
  return Surface(KnotVector(surface.knots(0).degree(), knots[0], "KnotsU"),
    KnotVector(surface.knots(1).degree(), knots[1], "KnotsV"),
    surface.local_control_points().colwise() + surface.centre(), surface.weights());
}

void expect_same_feet(const Surface& twin, const Surface& scaled,
  const std::function<Parameter<2>(const Parameter<2>&)>& to_twin, std::uint64_t seed)
{
  const PointInverter one(model_of(twin));
  const PointInverter other(model_of(scaled));
  const double tolerance = 1e-12 * one.size();
  for (const Vector3& query : queries(twin, 100, seed))
  {
    SCOPED_TRACE(::testing::Message() << "query " << query.transpose());
    const Foot expected = one.find(query);
    const Foot foot = other.find(query);
    EXPECT_EQ(expected.status, Status::Certified);
    EXPECT_EQ(foot.status, Status::Certified);
    EXPECT_EQ(foot.type, expected.type);
    EXPECT_EQ(foot.isolated, expected.isolated);
    EXPECT_NEAR(foot.distance, expected.distance, tolerance);
    // A residual of 1e-12 |r| places the foot to the same over the curvature of E.
    EXPECT_LE((foot.point - expected.point).norm(), 1e-9 * one.size());
    EXPECT_LE((to_twin(foot.parameter) - expected.parameter).norm(), 1e-9);
  }
}

} // namespace

TEST(HardCaseS9, SpeedsOneToAHundredMillion)
{
  const Surface twin = shapes::bumpy(11, 9);
  for (const double ratio : { 1e8, 1e-8 })
  {
    expect_same_feet(
      twin, with_knots(twin, { 1, ratio }, { 0, 0 }),
      [&](const Parameter<2>& t) { return Parameter<2>(t(0), t(1) / ratio); }, 91);
  }
}

TEST(HardCaseS9, SpeedsThatDifferInSpace)
{
  // The same ratio from the shape itself: a ribbon of width 1e-8.
  const Surface bumpy = shapes::bumpy(11, 9);
  footpoint::Points net = bumpy.local_control_points();
  net.row(1) *= 1e-8;
  const Surface ribbon(bumpy.knots(0), bumpy.knots(1), net);
  const PointInverter inverter(model_of(ribbon));
  const oracle::Nearest<2> nearest(shapes::spline_of(ribbon));
  shapes::Random random(92);
  for (int k = 0; k < 20; ++k)
  {
    const Vector3 query(
      random.uniform(-0.5, 0.5), random.uniform(-1e-8, 1e-8), random.uniform(-1, 1));
    const Foot foot = inverter.find(query);
    EXPECT_EQ(foot.status, Status::Certified);
    EXPECT_NEAR(
      foot.distance, nearest(query.cast<oracle::Real>()).distance, 1e-12 * inverter.size());
  }
}

TEST(HardCaseS9, ShortSpansAndDomainFarFromZero)
{
  const Surface twin = shapes::bumpy(11, 9); // eight spans on [0, 1]
  expect_same_feet(
    twin, with_knots(twin, { 8 * 5e-3, 5e-3 }, { 0, 0 }),
    [](const Parameter<2>& t) { return Parameter<2>(t(0) / 0.04, t(1) / 5e-3); }, 93);
  // The domain's parameters have a rounding of 1e-10 there.
  expect_same_feet(
    twin, with_knots(twin, { 1, 1 }, { 1e6, -1e6 }),
    [](const Parameter<2>& t) { return Parameter<2>(t(0) - 1e6, t(1) + 1e6); }, 94);
}

TEST(HardCaseS9, WeightsFromAMillionthToAMillion)
{
  // Weights λ^i on a Bézier net reparametrize it: s / (1 − s) = λ t / (1 − t).
  const Surface twin = shapes::bumpy(4, 9, 0.5);
  const double lambda = 1e4;
  Eigen::VectorXd weights(16);
  for (int k = 0; k < 16; ++k)
  {
    weights[k] = 1e-6 * std::pow(lambda, k % 4);
  }
  const Surface scaled(
    twin.knots(0), twin.knots(1), twin.local_control_points().colwise() + twin.centre(), weights);
  expect_same_feet(
    twin, scaled,
    [&](const Parameter<2>& t)
    { return Parameter<2>(lambda * t(0) / (1.0 - t(0) + lambda * t(0)), t(1)); },
    95);
  // All weights alike are no weights.
  const Surface heavy(twin.knots(0), twin.knots(1),
    twin.local_control_points().colwise() + twin.centre(), Eigen::VectorXd::Constant(16, 1e6));
  expect_same_feet(
    twin, heavy, [](const Parameter<2>& t) { return t; }, 96);
}

TEST(HardCaseS9, WeightsThatJump)
{
  shapes::Random random(97);
  for (int k = 0; k < 4; ++k)
  {
    const auto arrays = shapes::random_arrays<2>(random, { { 3, 2 } }, 2, true, 6.0);
    const PointInverter inverter(model_of(arrays.geometry()));
    const oracle::Nearest<2> nearest(arrays.spline(), 40);
    for (int i = 0; i < 10; ++i)
    {
      const Vector3 query = random.vector(-1.5, 1.5);
      const Foot foot = inverter.find(query);
      EXPECT_LE(foot.distance,
        nearest(query.cast<oracle::Real>()).distance + 1e-12 * inverter.size())
        << "status " << static_cast<int>(foot.status);
    }
  }
}

TEST(HardCaseS10, UnitSizeTenMillionFromTheOrigin)
{
  for (const double offset : { 1e7, -1e7 })
  {
    Surface bumpy = shapes::bumpy(8, 10, 0.3);
    const Vector3 shift(offset, 0.7 * offset, -offset);
    const footpoint::Points net =
      (bumpy.local_control_points().colwise() + bumpy.centre()).colwise() + shift;
    const Surface moved(bumpy.knots(0), bumpy.knots(1), net);
    const PointInverter inverter(model_of(moved));
    // The judge sees the net as it was rounded, from its centre: nothing more may be lost.
    const oracle::Nearest<2> nearest(shapes::local_spline_of(moved));
    const oracle::Vector centre = moved.centre().cast<oracle::Real>();
    for (const Vector3& query : queries(moved, 40, 101))
    {
      const Foot foot = inverter.find(query);
      const oracle::Foot<2> judge = nearest(query.cast<oracle::Real>() - centre);
      EXPECT_EQ(foot.status, Status::Certified);
      EXPECT_NEAR(foot.distance, judge.distance, 1e-12 * inverter.size());
      EXPECT_LE((foot.point.cast<oracle::Real>() - centre - judge.point).norm(), 1e-8);
      EXPECT_EQ(std::abs(foot.signed_distance), foot.distance);
    }
  }
}
