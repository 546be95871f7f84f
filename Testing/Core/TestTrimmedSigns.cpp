// SPDX-License-Identifier: BSD-3-Clause

// Signed distances of closed solids: negative inside, positive outside, along paths that lead past
// edges and vertices, where the nearest point is one of several faces.

#include "ClosedSolids.h"
#include "Inversion.h"

#include <gtest/gtest.h>

namespace
{

using namespace inversion;
using solids::Solid;

/// Nearer to the surface than this, in parts of the size, rounding tells no side.
constexpr double kOnSurface = 1e-10;

struct Walk
{
  int queries = 0;
  int wrong = 0;
  int inside = 0;
};

void check(const Solid& solid, const PointInverter& inverter, const Vector3& at, Walk& walk)
{
  const Foot foot = inverter.find(at);
  EXPECT_EQ(foot.status, Status::Certified) << at.transpose();
  EXPECT_EQ(std::abs(foot.signed_distance), foot.distance);
  if (foot.distance <= kOnSurface * solid.size)
  {
    return;
  }
  const bool inside = solid.inside(at);
  ++walk.queries;
  walk.inside += inside;
  if ((foot.signed_distance < 0.0) != inside && ++walk.wrong < 5)
  {
    std::ostringstream where;
    where.precision(17);
    where << at.transpose() << ", foot " << foot.point.transpose();
    ADD_FAILURE() << solid.name << (inside ? ": inside " : ": outside ") << where.str() << ", face "
                  << foot.face << ", type " << static_cast<int>(foot.type) << ", signed distance "
                  << foot.signed_distance;
  }
}

TEST(Signs, PathsPastEdgesAndVertices)
{
  for (const Solid& solid : solids::all())
  {
    SCOPED_TRACE(solid.name);
    const PointInverter inverter(solid.faces);
    EXPECT_EQ(inverter.number_of_open_edges(), 0);
    shapes::Random random(11);
    Walk walk;
    for (const Vector3& target : solid.targets)
    {
      for (int path = 0; path < 24; ++path)
      {
        // Past the target at 1e-6 to 1 of the size, in any direction, denser near it.
        const double beside = std::pow(10.0, -6.0 + 0.25 * path) * solid.size;
        const Vector3 way = random.vector(-1.0, 1.0).normalized();
        const Vector3 across = way.cross(random.vector(-1.0, 1.0)).normalized();
        for (int k = -20; k <= 20; ++k)
        {
          const double along = std::pow(std::abs(k) / 20.0, 3.0) * (k < 0 ? -4.0 : 4.0) * beside;
          check(solid, inverter, target + beside * across + along * way, walk);
        }
      }
    }
    EXPECT_EQ(walk.wrong, 0);
    EXPECT_GT(walk.inside, walk.queries / 1000);
    EXPECT_LT(walk.inside, walk.queries - walk.queries / 20);
    std::cout << solid.name << ": " << walk.queries << " queries, " << walk.inside << " inside, "
              << walk.wrong << " wrong\n";
  }
}

/// Turned inside out all signs turn; moved and scaled none does.
TEST(Signs, ReversedSolids)
{
  for (Solid solid : solids::all())
  {
    SCOPED_TRACE(solid.name);
    const PointInverter forth(solid.faces);
    for (Face& face : solid.faces)
    {
      face.reversed = !face.reversed;
    }
    const PointInverter back(solid.faces);
    shapes::Random random(3);
    for (const Vector3& target : solid.targets)
    {
      const Vector3 at = target + 0.1 * solid.size * random.vector(-1.0, 1.0);
      const Foot foot = forth.find(at);
      EXPECT_EQ(foot.signed_distance, -back.find(at).signed_distance) << at.transpose();
    }
  }
}

TEST(Signs, OpenShellsAreCounted)
{
  Solid box = solids::box("box", 1, 2, 3);
  box.faces.pop_back();
  EXPECT_EQ(PointInverter(box.faces).number_of_open_edges(), 4);
  Solid cylinder = solids::cylinder();
  cylinder.faces.pop_back();
  EXPECT_EQ(PointInverter(cylinder.faces).number_of_open_edges(), 1);
  Solid hole = solids::box_with_hole();
  hole.faces.pop_back();
  EXPECT_EQ(PointInverter(hole.faces).number_of_open_edges(), 2);
}

/// Without a neighbour the distance from an edge has the sign of the face alone.
TEST(Signs, OfAnOpenFace)
{
  const PointInverter inverter({ solids::plane(
    Vector3::Zero(), Vector3::UnitX(), Vector3::UnitY(), { trims::rectangle(0, 0, 1, 1) }) });
  EXPECT_GT(inverter.find({ 2, 0.5, 0.1 }).signed_distance, 0.0);
  EXPECT_LT(inverter.find({ 2, 0.5, -0.1 }).signed_distance, 0.0);
  EXPECT_LT(inverter.find({ 2, 3, -0.1 }).signed_distance, 0.0);
  EXPECT_EQ(inverter.number_of_open_edges(), 4);
}

} // namespace
