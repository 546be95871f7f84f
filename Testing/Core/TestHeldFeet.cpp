// SPDX-License-Identifier: BSD-3-Clause

/// Feet where the parametrization stands still, poles and cusps, which are taken as they are where
/// the distance rises to all sides: judged by points around them and by descents on the whole
/// surface.

#include "SlowBuild.h"
#include "SurfaceFeet.h"

#include "footpoint/search/patch_search.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <utility>

using footpoint::CertifiedAnswer;
using footpoint::KnotVector;
using footpoint::PatchFoot;
using footpoint::PieceFoot;
using footpoint::Points;
using footpoint::Surface;
using namespace inversion;
using shapes::Random;

namespace
{

constexpr int kShare = kSlowBuild ? 5 : 1;

/// A bicubic fan of 3 pieces around a corner where all of one side is one point, seen from there
/// about along x.
Surface fan(Random& random, int collapsed, bool rational)
{
  constexpr int across = 5;
  constexpr int around = 6;
  const int nu = collapsed < 2 ? across : around;
  const int nv = collapsed < 2 ? around : across;
  std::vector<double> knots[2]{ { 0, 0, 0, 0, 0.4, 1, 1, 1, 1 },
    { 0, 0, 0, 0, 0.3, 0.7, 1, 1, 1, 1 } };
  Points net(3, across * around);
  Eigen::VectorXd weights(rational ? across * around : 0);
  for (int i = 0; i < nu; ++i)
  {
    for (int j = 0; j < nv; ++j)
    {
      int away = collapsed < 2 ? i : j;
      away = collapsed % 2 == 0 ? away : across - 1 - away;
      const double turn = 0.5 * (collapsed < 2 ? j : i);
      net.col(j * nu + i) = away == 0
        ? Vector3(0.5, 0.5, 0.5)
        : Vector3(Vector3(0.5, 0.5, 0.5) +
            0.25 * away * Vector3(std::cos(turn), std::sin(turn), 0.5) +
            0.04 * random.vector(-1.0, 1.0));
      if (rational)
      {
        weights[j * nu + i] = random.magnitude(0.7);
      }
    }
  }
  const int u = collapsed < 2 ? 0 : 1;
  return Surface(KnotVector(3, knots[u]), KnotVector(3, knots[1 - u]), net, weights);
}

/// The least distance of points a step across from a line, anywhere along it.
double least_beside(
  const Surface& surface, const Vector3& query, const Parameter<2>& local, int across)
{
  double least = std::numeric_limits<double>::infinity();
  const double width = surface.direction(across).length;
  for (const double part : { -1e-2, -1e-3, -1e-5, 1e-5, 1e-3, 1e-2 })
  {
    for (int k = 0; k <= 40; ++k)
    {
      Parameter<2> t;
      t(across) = local(across) + part * width;
      t(1 - across) = surface.direction(1 - across).length * k / 40.0;
      if (t(across) >= 0.0 && t(across) <= width)
      {
        least = std::min(least, (surface.centre() + surface.point(t) - query).norm());
      }
    }
  }
  return least;
}

/// A held foot is what the guarded descent on the whole surface makes of it.
void expect_refined(const Surface& surface, const Feet& feet, const Vector3& query,
  const CertifiedAnswer& answer)
{
  const auto search = footpoint::make_patch_search<2>(
    std::make_shared<Surface>(surface), footpoint::SolverOptions{}, footpoint::SeedOptions{});
  for (int k = 0; k < answer.count; ++k)
  {
    const PatchFoot found = feet.search().patch_foot(answer.feet[static_cast<std::size_t>(k)]);
    const PatchFoot refined = search->refine(query, found);
    const PatchFoot held = search->classified(query, found);
    EXPECT_EQ(held.type, refined.type);
    EXPECT_LE((held.point - refined.point).norm(), 1e-15 * surface.size());
    EXPECT_LE((held.local - refined.local).norm(), 1e-12);
  }
}

} // namespace

TEST(HeldFeet, PolesFromWhichAllColumnsLeadAway)
{
  int poles[2] = {};
  int held[2] = {}; // polynomial, rational
  for (int seed = 0; seed < 80 / kShare; ++seed)
  {
    SCOPED_TRACE(seed);
    Random random(static_cast<std::uint64_t>(seed));
    const bool rational = seed % 8 >= 4;
    const Surface surface = fan(random, seed % 4, rational);
    const Feet feet(surface);
    const Vector3 apex(0.5, 0.5, 0.5);
    for (int k = 0; k < 25; ++k)
    {
      const Vector3 query = apex + random.vector(-1.0, 1.0) * random.magnitude(0.7);
      const CertifiedAnswer answer = feet.answer(query);
      if (!answer.certified || answer.count == 0)
      {
        continue;
      }
      const Vector3 found = feet.search().patch_foot(answer.feet[0]).point;
      const bool at_pole = (found - apex).norm() <= 1e-13;
      poles[rational] += at_pole;
      if (!feet.search().is_held(answer))
      {
        continue;
      }
      ++held[rational];
      EXPECT_TRUE(at_pole);
      EXPECT_GE(answer.count, 3); // one from each piece
      const Parameter<2> local = feet.search().patch_foot(answer.feet[0]).local;
      EXPECT_GT(least_beside(surface, query, local, seed % 4 / 2), answer.feet[0].distance);
      expect_refined(surface, feet, query, answer);
    }
  }
  for (int k = 0; k < 2; ++k)
  {
    EXPECT_GT(poles[k], 100 / kShare);
    EXPECT_GT(held[k], 0.9 * poles[k]); // the control points say a little less than the surface
  }
}

TEST(HeldFeet, NotWhereAColumnLeadsNearer)
{
  const Surface triangle = shapes::triangle();
  const Feet feet(triangle);
  const CertifiedAnswer beside = feet.answer({ -0.5, -0.3, 0.2 });
  ASSERT_EQ(beside.count, 1);
  EXPECT_TRUE(feet.search().is_held(beside));
  // Right above the apex all is level, and at the apex there is no direction.
  EXPECT_FALSE(feet.search().is_held(feet.answer({ 0.0, 0.0, 0.5 })));
  EXPECT_FALSE(feet.search().is_held(feet.answer({ 0.0, 0.0, 0.0 })));
  EXPECT_FALSE(feet.search().is_held(feet.answer({ 0.3, 0.3, 0.5 })));
  EXPECT_FALSE(feet.search().is_held(CertifiedAnswer{}));
  // One of the columns alone.
  const CertifiedAnswer level = feet.answer({ 0.0, -0.3, 0.2 });
  EXPECT_FALSE(feet.search().is_held(level));
  // Not all of the pieces around.
  Random random(1);
  const Feet pieces(fan(random, 0, false));
  Vector3 query;
  CertifiedAnswer around;
  for (int k = 0; k < 100 && !pieces.search().is_held(around); ++k)
  {
    query = random.vector(-1.0, 2.0);
    around = pieces.answer(query);
  }
  ASSERT_GE(around.count, 3);
  ASSERT_TRUE(pieces.search().is_held(around));
  std::swap(around.feet[0], around.feet[2]);
  EXPECT_TRUE(pieces.search().is_held(around));
  --around.count;
  EXPECT_FALSE(pieces.search().is_held(around));
  ++around.count;
  for (int k = 0; k < around.count; ++k)
  {
    for (int j = 0; j < k; ++j)
    {
      CertifiedAnswer twice = around;
      twice.feet[static_cast<std::size_t>(k)] = around.feet[static_cast<std::size_t>(j)];
      EXPECT_FALSE(pieces.search().is_held(twice));
    }
  }
  around = pieces.answer(query);
  around.feet[1].t[0] = 0.5;
  EXPECT_FALSE(pieces.search().is_held(around));
}

TEST(HeldFeet, TheLineOfACusp)
{
  const Surface cusp = shapes::cusp();
  const Feet feet(cusp);
  Random random(7);
  int held = 0;
  for (int k = 0; k < 1000 / kShare; ++k)
  {
    const Vector3 query(
      random.uniform(-2.0, 0.0), random.uniform(-1.0, 1.0), random.uniform(-0.5, 1.5));
    const CertifiedAnswer answer = feet.answer(query);
    if (answer.certified && feet.search().is_held(answer))
    {
      ++held;
      const PatchFoot foot = feet.search().patch_foot(answer.feet[0]);
      const double z = std::min(std::max(query.z(), 0.0), 1.0);
      EXPECT_LE((foot.point - Vector3(0, 0, z)).norm(), 1e-15);
      EXPECT_GT(least_beside(cusp, query, foot.local, 0), foot.distance);
      expect_refined(cusp, feet, query, answer);
    }
  }
  EXPECT_GT(held, 450 / kShare);
  CertifiedAnswer end = feet.answer({ -0.7, 0.1, -0.4 });
  ASSERT_TRUE(feet.search().is_held(end));
  end.feet[0].gradient[1] = -end.feet[0].gradient[1];
  EXPECT_FALSE(feet.search().is_held(end));
  const CertifiedAnswer answer = feet.answer({ -0.7, 0.1, 0.4 });
  ASSERT_EQ(answer.count, 2);
  ASSERT_TRUE(feet.search().is_held(answer));
  const auto refuses = [&](const char* what, const std::function<void(PieceFoot&)>& change)
  {
    for (std::size_t k = 0; k < 2; ++k)
    {
      CertifiedAnswer changed = answer;
      change(changed.feet[k]);
      EXPECT_FALSE(feet.search().is_held(changed)) << what << ", side " << k;
    }
  };
  refuses("level across", [](PieceFoot& each) { each.hessian[0] = 0.0; });
  refuses("downhill across", [](PieceFoot& each) { each.hessian[0] = -each.hessian[0]; });
  refuses("leads on across", [](PieceFoot& each)
    { each.gradient[0] = (each.t[0] == 0.0 ? -1e-6 : 1e-6) * each.hessian[0]; });
  refuses("a kink", [](PieceFoot& each) { each.metric[0] = 1e-3; });
  refuses("no minimum along", [](PieceFoot& each) { each.gradient[1] = 1e-3; });
  refuses("flat along", [](PieceFoot& each) { each.hessian[2] = 1e-9 * each.metric[1]; });
  refuses("a saddle", [](PieceFoot& each)
    { each.hessian[1] = std::sqrt(each.hessian[0] * each.hessian[2]); });
  refuses("stalled along", [](PieceFoot& each) { each.metric[1] = 0.0; });
  refuses("elsewhere along", [](PieceFoot& each) { each.t[1] += 1e-6; });
}
