// SPDX-License-Identifier: BSD-3-Clause

/// Feet on kinks, which are filled in from the derivatives on both sides: judged by brute force, by
/// the surface on either side and by descents on the whole surface.

#include "OracleNearest.h"
#include "SlowBuild.h"
#include "SurfaceFeet.h"

#include <functional>

using footpoint::CertifiedAnswer;
using footpoint::KnotVector;
using footpoint::Points;
using footpoint::Side;
using footpoint::Sides;
using footpoint::Surface;
using namespace inversion;
using shapes::Random;

namespace
{

constexpr int kShare = kSlowBuild ? 5 : 1;

/// 3 by 3 bicubic pieces with creases between them, over about the unit square.
shapes::Arrays<2> creased(Random& random, bool rational)
{
  constexpr int count = 10;
  shapes::Arrays<2> arrays;
  arrays.degrees = { { 3, 3 } };
  for (int i = 0; i < 2; ++i)
  {
    const double start = i == 0 ? 0.0 : -1.0;
    arrays.knots[i].assign(4, start);
    arrays.knots[i].insert(arrays.knots[i].end(), 3, start + 1.1);
    arrays.knots[i].insert(arrays.knots[i].end(), 3, start + 1.9);
    arrays.knots[i].insert(arrays.knots[i].end(), 4, start + 3.0);
  }
  arrays.points.resize(3, count * count);
  arrays.weights.resize(rational ? count * count : 0);
  for (int k = 0; k < count * count; ++k)
  {
    const int i = k % count;
    const int j = k / count;
    // Creases along the lines, up and down.
    const bool ridge = i % 3 == 0 || j % 3 == 0;
    arrays.points.col(k) = Vector3(i / 9.0, j / 9.0, 0.0) + 0.03 * random.vector(-1.0, 1.0);
    arrays.points(2, k) += ridge ? random.uniform(0.0, 0.12) : 0.0;
    if (rational)
    {
      arrays.weights[k] = random.magnitude(0.3);
    }
  }
  return arrays;
}

/// Mean of the unit normals on both sides of a line. \param t in the domain
Vector3 mean_normal(const Surface& surface, const Parameter<2>& t, int across)
{
  Vector3 sum = Vector3::Zero();
  for (const Side side : { Side::Left, Side::Right })
  {
    Sides<2> sides = Sides<2>::Constant(Side::Right);
    sides(across) = side;
    const auto jet = surface.jet(surface.to_local(t), sides, 1);
    sum += jet.first.col(0).cross(jet.first.col(1)).normalized();
  }
  return sum.normalized();
}

/// The direction across whose line a parameter lies exactly; −1: on none or where two cross.
int line_at(const shapes::Arrays<2>& arrays, const Parameter<2>& t)
{
  bool on[2];
  for (int i = 0; i < 2; ++i)
  {
    const std::vector<double>& knots = arrays.knots[i];
    const double domain[] = { knots.front(), knots.back() };
    on[i] = t(i) != domain[0] && t(i) != domain[1] &&
      std::find(knots.begin(), knots.end(), t(i)) != knots.end();
  }
  return on[0] == on[1] ? -1 : (on[0] ? 0 : 1);
}

Vector3 query_over(Random& random)
{
  return { random.uniform(-0.1, 1.1), random.uniform(-0.1, 1.1),
    random.uniform(-1.0, 1.0) * random.magnitude(0.7) };
}

} // namespace

TEST(PlainFeet, OnKinksAreThoseOfBothSides)
{
  int kinks = 0;
  int plain = 0;
  for (int seed = 0; seed < 60 / kShare; ++seed)
  {
    Random random(seed);
    const shapes::Arrays<2> arrays = creased(random, seed % 2 == 1);
    const Surface surface = arrays.geometry();
    const bool reversed = seed % 3 == 0;
    const PointInverter inverter({ face_of(surface, reversed) });
    const PointInverter every({ face_of(surface, reversed) }, all_feet());
    const Feet feet(surface, reversed);
    const oracle::Nearest<2> nearest(arrays.spline(), 6);
    for (int k = 0; k < 40; ++k)
    {
      const Vector3 query = query_over(random);
      const Foot foot = inverter.find(query);
      Foot filled;
      const bool is_plain = feet.is_plain_kink(query, filled);
      const int across = foot.type == FootType::Kink ? line_at(arrays, foot.parameter) : -1;
      SCOPED_TRACE(::testing::Message() << "seed " << seed << ", query " << query.transpose()
                                        << ", foot " << foot.parameter.transpose());
      EXPECT_EQ(foot.status, Status::Certified);
      EXPECT_EQ(std::abs(foot.signed_distance), foot.distance);
      kinks += across >= 0;
      plain += is_plain;
      if (is_plain)
      {
        ASSERT_EQ(foot.type, FootType::Kink);
        EXPECT_GE(across, 0);
        // As the inverter has it.
        EXPECT_EQ(filled.parameter, foot.parameter);
        EXPECT_EQ(filled.direction, foot.direction);
        EXPECT_EQ(filled.signed_distance, foot.signed_distance);
        EXPECT_EQ(filled.face, 3);
      }
      if (across < 0)
      {
        continue;
      }
      EXPECT_TRUE(foot.isolated);
      EXPECT_EQ(foot.face, 0);
      EXPECT_FALSE(foot.on_curve);
      EXPECT_GE(foot.iterations, 1);
      const Vector3 normal = (reversed ? -1.0 : 1.0) * mean_normal(surface, foot.parameter, across);
      EXPECT_LE((foot.direction - normal).norm(), 1e-9);
      EXPECT_EQ(foot.signed_distance < 0.0, (query - foot.point).dot(normal) < 0.0);
      EXPECT_NEAR(foot.distance, (query - foot.point).norm(), 1e-14 * surface.size());
      const oracle::Foot<2> best = nearest(query.cast<oracle::Real>());
      EXPECT_NEAR(foot.distance, static_cast<double>(best.distance), 1e-13 * surface.size());
      EXPECT_LE((foot.point - best.point.cast<double>()).norm(), 1e-7 * surface.size());
      // What descents on the whole surface end at.
      const std::vector<Foot> all = every.find_all(query);
      ASSERT_FALSE(all.empty());
      EXPECT_EQ(all[0].type, FootType::Kink);
      EXPECT_EQ(all[0].isolated, foot.isolated);
      EXPECT_EQ(all[0].parameter(across), foot.parameter(across));
      EXPECT_NEAR(all[0].parameter(1 - across), foot.parameter(1 - across), 1e-8);
      EXPECT_LE((all[0].direction - foot.direction).norm(), 1e-7);
      EXPECT_NEAR(all[0].signed_distance, foot.signed_distance, 1e-13 * surface.size());
    }
  }
  // The others lie where lines cross, or so that a look at derivatives does not do.
  EXPECT_GT(kinks, 0.1 * 40 * (60 / kShare));
  EXPECT_GT(plain, 0.75 * kinks);
}

namespace
{

/// Degree 1 along both directions: a polygon, drawn along y from 0 to 1.
Surface prism(const std::vector<Vector3>& polygon, int multiplicity = 1)
{
  std::vector<double> knots{ 0.0 };
  std::vector<Vector3> corners;
  const auto count = static_cast<int>(polygon.size());
  for (int k = 0; k < count; ++k)
  {
    const bool inside = k > 0 && k + 1 < count;
    knots.insert(knots.end(), inside ? multiplicity : 1, k);
    corners.insert(corners.end(), inside ? multiplicity : 1, polygon[k]);
  }
  knots.push_back(count - 1.0);
  Points net(3, 2 * static_cast<Eigen::Index>(corners.size()));
  for (Eigen::Index k = 0; k < net.cols(); ++k)
  {
    const auto size = static_cast<Eigen::Index>(corners.size());
    net.col(k) = corners[k % size] + Vector3(0.0, k / size * 1.0, 0.0);
  }
  return Surface(KnotVector(1, knots), KnotVector(1, { 0, 0, 1, 1 }), net);
}

} // namespace

TEST(PlainFeet, OnTheRidgeOfARoof)
{
  const Surface roof = prism({ { -1, 0, 0 }, { 0, 0, 1 }, { 2, 0, 0 } });
  Foot foot;
  const Vector3 query(0.1, 0.25, 3.0);
  ASSERT_TRUE(Feet(roof).is_plain_kink(query, foot));
  EXPECT_EQ(foot.type, FootType::Kink);
  EXPECT_EQ(foot.parameter, Parameter<2>(1.0, 0.25));
  EXPECT_EQ(foot.point, Vector3(0.0, 0.25, 1.0));
  EXPECT_NEAR(foot.distance, std::hypot(0.1, 2.0), 1e-15);
  // S_u × S_v of either side.
  const Vector3 normal =
    (Vector3(-1, 0, 1).normalized() + Vector3(1, 0, 2).normalized()).normalized();
  EXPECT_LE((foot.direction - normal).norm(), 1e-15);
  EXPECT_EQ(foot.signed_distance, foot.distance);
  Foot reversed;
  ASSERT_TRUE(Feet(roof, true).is_plain_kink(query, reversed));
  EXPECT_EQ(reversed.direction, -foot.direction);
  EXPECT_EQ(reversed.signed_distance, -foot.signed_distance);
  // Below it the sides are as near as each other: two feet, neither on the ridge.
  const Surface even = prism({ { -1, 0, 0 }, { 0, 0, 1 }, { 1, 0, 0 } });
  EXPECT_EQ(Feet(even).answer({ 0.0, 0.5, 0.5 }).count, 2);
  EXPECT_FALSE(Feet(even).is_plain_kink({ 0.0, 0.5, 0.5 }, foot));
  // At its end the ridge is held by the border as well.
  EXPECT_FALSE(Feet(roof).is_plain_kink({ 0.0, -0.5, 3.0 }, foot));
  EXPECT_NE(PointInverter(model_of(roof)).find({ 0.0, -0.5, 3.0 }).type, FootType::Kink);
  EXPECT_FALSE(Feet(roof).is_plain_kink({ 0.0, 0.0, 3.0 }, foot));
}

TEST(PlainFeet, OnlyWhereBothSidesLeadAway)
{
  const Surface roof = prism({ { -1, 0, 0 }, { 0, 0, 1 }, { 2, 0, 0 } });
  const Feet feet(roof);
  const CertifiedAnswer answer = feet.answer({ 0.1, 0.25, 3.0 });
  ASSERT_EQ(answer.count, 2);
  using footpoint::PieceFoot;
  const PieceFoot& one = answer.feet[0];
  const PieceFoot& two = answer.feet[1];
  Foot foot;
  Foot other;
  ASSERT_TRUE(feet.search().plain_kink_foot(one, two, foot));
  ASSERT_TRUE(feet.search().plain_kink_foot(two, one, other));
  EXPECT_TRUE(identical(foot, other));
  EXPECT_FALSE(feet.search().plain_kink_foot(one, one, foot));
  for (int k = 0; k < 2; ++k)
  {
    const auto refuses = [&](const char* what, const std::function<void(PieceFoot&)>& change)
    {
      PieceFoot changed[2] = { one, two };
      change(changed[k]);
      EXPECT_FALSE(feet.search().plain_kink_foot(changed[0], changed[1], foot))
        << what << ", side " << k;
    };
    refuses("level across", [](PieceFoot& each) { each.gradient[0] = 0.0; });
    refuses("downhill across", [](PieceFoot& each) { each.gradient[0] = -each.gradient[0]; });
    refuses("no minimum along", [](PieceFoot& each) { each.gradient[1] = 1e-3; });
    refuses("a maximum along", [](PieceFoot& each) { each.hessian[2] = -each.hessian[2]; });
    refuses("flat along", [](PieceFoot& each) { each.hessian[2] = 1e-9 * each.metric[1]; });
    refuses("elsewhere along", [](PieceFoot& each) { each.t[1] += 1e-6; });
    refuses("off the line", [](PieceFoot& each) { each.t[0] = 0.5; });
    refuses("the other end", [](PieceFoot& each) { each.t[0] = 1.0 - each.t[0]; });
    refuses("stalled across", [](PieceFoot& each) { each.metric[0] = 0.0; });
    refuses("stalled along", [](PieceFoot& each) { each.metric[1] = 0.0; });
    refuses("without a normal", [](PieceFoot& each) { each.first[0] = each.first[1]; });
  }
}

TEST(PlainFeet, NotWhereLinesCross)
{
  // A pyramid over [−1, 1]².
  Points net(3, 9);
  for (int k = 0; k < 9; ++k)
  {
    net.col(k) << k % 3 - 1.0, k / 3 - 1.0, k == 4 ? 1.0 : 0.0;
  }
  const KnotVector knots(1, { 0, 0, 1, 2, 2 });
  const Surface pyramid(knots, knots, net);
  const Feet feet(pyramid);
  for (const Vector3& query : { Vector3(0, 0, 3), Vector3(0.02, 0.01, 2.5) })
  {
    const CertifiedAnswer answer = feet.answer(query);
    EXPECT_GE(answer.count, 2);
    Foot foot;
    for (int a = 0; a < answer.count; ++a)
    {
      for (int b = 0; b < answer.count; ++b)
      {
        EXPECT_FALSE(feet.search().plain_kink_foot(answer.feet[a], answer.feet[b], foot));
      }
    }
    foot = PointInverter(model_of(pyramid)).find(query);
    EXPECT_EQ(foot.type, FootType::Kink);
    EXPECT_EQ(foot.parameter, Parameter<2>(1.0, 1.0));
    EXPECT_LE((foot.direction - Vector3::UnitZ()).norm(), 1e-15);
    EXPECT_GT(foot.signed_distance, 0.0);
  }
}

TEST(PlainFeet, NotOnSeams)
{
  // A square tube whose seam is one of its four edges.
  const Surface tube =
    prism({ { 1, 0, 1 }, { -1, 0, 1 }, { -1, 0, -1 }, { 1, 0, -1 }, { 1, 0, 1 } });
  ASSERT_TRUE(tube.direction(0).closed);
  const Feet feet(tube);
  const PointInverter inverter(model_of(tube));
  for (int k = 0; k < 4; ++k)
  {
    // (2.1, 0.3, 1.9) turned from edge to edge.
    const double x[4] = { 2.1, -1.9, -2.1, 1.9 };
    const double z[4] = { 1.9, 2.1, -1.9, -2.1 };
    const Vector3 query(x[k], 0.3, z[k]);
    Foot filled;
    EXPECT_EQ(feet.is_plain_kink(query, filled), k > 0) << k;
    const Foot foot = inverter.find(query);
    EXPECT_EQ(foot.type, FootType::Kink);
    EXPECT_TRUE(foot.isolated);
    EXPECT_EQ(foot.parameter(0), k * 1.0);
    EXPECT_NEAR(foot.parameter(1), 0.3, 1e-15);
    EXPECT_NEAR(foot.distance, std::hypot(1.1, 0.9), 1e-15);
    const Vector3 outwards =
      Vector3(std::copysign(1.0, x[k]), 0.0, std::copysign(1.0, z[k])).normalized();
    EXPECT_NEAR(std::abs(foot.direction.dot(outwards)), 1.0, 1e-15);
    EXPECT_EQ(foot.signed_distance > 0.0, foot.direction.dot(outwards) > 0.0);
  }
}

TEST(PlainFeet, NotOnGapsAndFolds)
{
  // A knot of multiplicity p + 1 is a gap, whether its sides meet or not.
  const Surface gap = prism({ { -1, 0, 0 }, { 0, 0, 1 }, { 2, 0, 0 } }, 2);
  ASSERT_TRUE(gap.direction(0).breaks[1].gap);
  const Vector3 query(0.1, 0.25, 3.0);
  Foot foot;
  EXPECT_EQ(Feet(gap).answer(query).count, 2);
  EXPECT_FALSE(Feet(gap).is_plain_kink(query, foot));
  EXPECT_NEAR(PointInverter(model_of(gap)).find(query).distance, std::hypot(0.1, 2.0), 1e-15);
  // Folded back onto itself there is no mean of the normals.
  const Surface fold = prism({ { -1, 0, 0 }, { 1, 0, 0 }, { -1, 0, 0 } });
  EXPECT_EQ(Feet(fold).answer({ 2, 0.5, 0.5 }).count, 2);
  EXPECT_FALSE(Feet(fold).is_plain_kink({ 2, 0.5, 0.5 }, foot));
  foot = PointInverter(model_of(fold)).find({ 2, 0.5, 0.5 });
  EXPECT_EQ(foot.type, FootType::Kink);
  EXPECT_NEAR(foot.direction.norm(), 1.0, 1e-15);
  // Over a smooth knot line feet are interior.
  const Surface flat = prism({ { -1, 0, 0 }, { 0, 0, 0 }, { 1, 0, 0 } });
  EXPECT_FALSE(Feet(flat).is_plain_kink({ 0, 0.5, 0.5 }, foot));
  EXPECT_EQ(PointInverter(model_of(flat)).find({ 0, 0.5, 0.5 }).type, FootType::Interior);
}
