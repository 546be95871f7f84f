// SPDX-License-Identifier: BSD-3-Clause

// The nearest point of trimmed faces: closed forms, and against an oracle by brute force.

#include "Inversion.h"
#include "TrimmedOracle.h"

#include <gtest/gtest.h>

namespace
{

using namespace inversion;
using footpoint::Surface;
using footpoint::TrimLoop;

Face trimmed(const Surface& surface, std::vector<TrimLoop> loops)
{
  Face face = face_of(surface);
  face.loops = std::move(loops);
  footpoint::trim(face);
  return face;
}

/// A plane of side 20 with a hole of radius 2 and in it an island of radius 0.5 (S12 has radius 1).
Face plate(bool island)
{
  std::vector<TrimLoop> loops{ trims::rectangle(-10, -10, 10, 10),
    trims::reversed(trims::circle(0, 0, 1)) };
  if (island)
  {
    loops.push_back(trims::circle(0, 0, 0.25));
  }
  return trimmed(trims::flat(-10, 10, -10, 10), loops);
}

void expect_foot(const Foot& foot, const Vector3& point, double distance, FootType type)
{
  EXPECT_EQ(foot.status, Status::Certified);
  EXPECT_EQ(foot.type, type);
  EXPECT_NEAR((foot.point - point).norm(), 0.0, 1e-12);
  EXPECT_NEAR(foot.distance, distance, 1e-12);
}

TEST(TrimmedFaces, HoleInAPlane)
{
  const PointInverter inverter({ plate(false) });
  expect_foot(inverter.find({ 0.2, 0, 1 }), { 1, 0, 0 }, std::sqrt(1.64), FootType::Edge);
  expect_foot(inverter.find({ 3, 2, 1 }), { 3, 2, 0 }, 1.0, FootType::Interior);
  expect_foot(inverter.find({ 12, 3, 0 }), { 10, 3, 0 }, 2.0, FootType::Edge);
  expect_foot(inverter.find({ 13, 14, 0 }), { 10, 10, 0 }, 5.0, FootType::Vertex);
  const Foot centre = inverter.find({ 0, 0, 1 });
  EXPECT_NEAR(centre.distance, std::sqrt(2.0), 1e-12);
  EXPECT_FALSE(centre.isolated);
}

TEST(TrimmedFaces, IslandInAHole)
{
  const PointInverter inverter({ plate(true) });
  expect_foot(inverter.find({ 0.2, 0, 1 }), { 0.2, 0, 0 }, 1.0, FootType::Interior);
  expect_foot(inverter.find({ 0.5, 0, 1 }), { 0.25, 0, 0 }, std::sqrt(1.0625), FootType::Edge);
  expect_foot(inverter.find({ 0.8, 0, 1 }), { 1, 0, 0 }, std::sqrt(1.04), FootType::Edge);
}

TEST(TrimmedFaces, OpenEdgesAreCounted)
{
  EXPECT_EQ(PointInverter({ plate(false) }).number_of_open_edges(), 5); // sides and the hole
  EXPECT_EQ(PointInverter(model_of(trims::flat())).number_of_open_edges(), 4);
  EXPECT_EQ(PointInverter(model_of(shapes::sphere())).number_of_open_edges(), 0);
  EXPECT_EQ(PointInverter(model_of(shapes::torus())).number_of_open_edges(), 0);
  EXPECT_EQ(
    PointInverter(model_of(shapes::cylinder(10.0, 360.0, 4))).number_of_open_edges(), 2);
  // Two squares side by side have one border in common.
  EXPECT_EQ(PointInverter(model_of(trims::flat(0, 1), trims::flat(1, 2))).number_of_open_edges(), 6);
}

/// Faces with loops over surfaces of several kinds, in parts of their domain.
struct Case
{
  const char* name;
  Surface surface;
  std::vector<TrimLoop> loops;
};

TrimLoop scaled(const Surface& surface, const TrimLoop& loop)
{
  TrimLoop result;
  for (const auto& curve : loop.curves)
  {
    footpoint::Points points = curve->local_control_points().colwise() + curve->centre();
    for (int i = 0; i < 2; ++i)
    {
      const footpoint::Direction& direction = surface.direction(i);
      points.row(i) = (direction.origin + direction.length * points.row(i).array()).matrix();
    }
    result.curves.push_back(
      std::make_shared<footpoint::Curve>(curve->knots(), points, curve->weights()));
  }
  return result;
}

/// A closed smooth wave around (u, v).
TrimLoop wave(double u, double v, double radius, int waves, double depth)
{
  const int count = 8 * waves;
  footpoint::Points points = footpoint::Points::Zero(3, count + 3);
  for (int k = 0; k < count + 3; ++k)
  {
    const double angle = 2.0 * std::acos(-1.0) * k / count;
    const double r = radius * (1.0 + depth * std::cos(waves * angle));
    points.col(k).head<2>() << u + r * std::cos(angle), v + r * std::sin(angle);
  }
  TrimLoop loop;
  loop.curves.push_back(std::make_shared<footpoint::Curve>(
    footpoint::KnotVector(3, shapes::uniform_knots(3, count)), points));
  return loop;
}

std::vector<Case> cases()
{
  std::vector<Case> result;
  const auto add = [&](const char* name, const Surface& surface, std::vector<TrimLoop> loops)
  {
    for (TrimLoop& loop : loops)
    {
      loop = scaled(surface, loop);
    }
    result.push_back({ name, surface, std::move(loops) });
  };
  add("saddle with a hole", shapes::saddle(),
    { trims::rectangle(0, 0, 1, 1), trims::reversed(trims::circle(0.5, 0.5, 0.3)) });
  add("sphere in a wave", shapes::sphere(), { wave(0.5, 0.5, 0.3, 5, 0.3) });
  add("torus with a window", shapes::torus(),
    { trims::rectangle(0.1, 0.2, 0.8, 0.9), trims::reversed(wave(0.5, 0.5, 0.15, 3, 0.2)) });
  add("bumpy in a wave", shapes::bumpy(8, 3), { wave(0.5, 0.5, 0.4, 7, 0.2) });
  add("bumpy with holes", shapes::bumpy(12, 5),
    { trims::rectangle(0, 0, 1, 1), trims::reversed(trims::circle(0.3, 0.3, 0.2)),
      trims::reversed(trims::circle(0.7, 0.7, 0.2)), trims::circle(0.7, 0.7, 0.1) });
  add("cylinder with a hole", shapes::cylinder(),
    { trims::rectangle(0, 0, 1, 1), trims::reversed(trims::circle(0.5, 0.5, 0.2)) });
  add("cusp", shapes::cusp(), { wave(0.5, 0.5, 0.35, 4, 0.1) });
  add("a thin strip", shapes::bumpy(6, 9), { trims::rectangle(0.1, 0.4, 0.9, 0.4005) });
  return result;
}

TEST(TrimmedFaces, NoPointIsNearerThanTheFoot)
{
  const char* queries = std::getenv("FOOTPOINT_TRIM_QUERIES");
  const int count = queries ? std::atoi(queries) : 60;
  for (const Case& one : cases())
  {
    SCOPED_TRACE(one.name);
    const PointInverter inverter({ trimmed(one.surface, one.loops) });
    const trims::TrimmedOracle oracle(one.surface, one.loops);
    const double size = inverter.size();
    shapes::Random random(7);
    int uncertified = 0;
    for (int k = 0; k < count; ++k)
    {
      // On, near, off and far from the untrimmed surface.
      const double away[4] = { 0.0, 1e-3, 0.1, 3.0 };
      Parameter<2> t;
      for (int i = 0; i < 2; ++i)
      {
        t(i) = random.uniform(0.0, 1.0) * one.surface.direction(i).length;
      }
      Vector3 query = one.surface.centre() + one.surface.point(t);
      for (int i = 0; i < 3; ++i)
      {
        query(i) += away[k % 4] * size * random.uniform(-1.0, 1.0);
      }
      const Foot foot = inverter.find(query);
      uncertified += foot.status != Status::Certified;
      const auto nearest = static_cast<double>(oracle.nearest(query));
      EXPECT_LE(foot.distance, nearest + 1e-12 * size)
        << "query " << k << ": " << query.transpose() << " foot " << foot.parameter.transpose()
        << " status " << static_cast<int>(foot.status);
      // The foot is a point of the face.
      const trims::Real2 at{ { foot.parameter(0), foot.parameter(1) } };
      EXPECT_LE((oracle.point(at) - foot.point.cast<trims::Real>()).norm(), 1e-13 * size);
      EXPECT_NEAR((foot.point - query).norm(), foot.distance, 1e-13 * (size + foot.distance));
      EXPECT_TRUE(oracle.keeps(at) || oracle.distance_to_loops(at) < 1e-4) << k;
      if (foot.type == FootType::Interior)
      {
        EXPECT_GE(foot.distance, 0.0);
      }
    }
    EXPECT_EQ(uncertified, 0);
  }
}

} // namespace
