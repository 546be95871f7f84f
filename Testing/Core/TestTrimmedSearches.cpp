// SPDX-License-Identifier: BSD-3-Clause

// All minima, orthogonal feet, lines, cut-offs, seeds and starts on trimmed faces, against closed
// forms; and that the feet do not depend on threads, blocks or order.

#include "ClosedSolids.h"
#include "InThreads.h"
#include "Inversion.h"
#include "RandomFaces.h"

#include <gtest/gtest.h>

#include <cstring>

namespace
{

using namespace inversion;
using footpoint::InversionResult;
using footpoint::Points;
using footpoint::Search;
using footpoint::Start;

/// [−10, 10]² in z = 0 with a hole of radius 1; in it an island of radius 0.25.
Face plate(bool island)
{
  Face face = face_of(trims::flat(-10, 10, -10, 10));
  face.loops = { trims::rectangle(-10, -10, 10, 10), trims::reversed(trims::circle(0, 0, 1)) };
  if (island)
  {
    face.loops.push_back(trims::circle(0, 0, 0.25));
  }
  footpoint::trim(face);
  return face;
}

TEST(TrimmedAllFeet, MinimaOfAPlateWithAnIsland)
{
  // Above the gap at (0.5, 0, 1): the island's near edge and the hole's.
  const PointInverter inverter({ plate(true) }, all_feet());
  const double tolerance = 1e-13 * inverter.size();
  const std::vector<Foot> feet = inverter.find_all({ 0.5, 0, 1 });
  ASSERT_EQ(feet.size(), 2u);
  EXPECT_NEAR((feet[0].point - Vector3(0.25, 0, 0)).norm(), 0.0, tolerance);
  EXPECT_EQ(feet[0].type, FootType::Edge);
  EXPECT_NEAR((feet[1].point - Vector3(1, 0, 0)).norm(), 0.0, tolerance);
  EXPECT_EQ(feet[1].type, FootType::Edge);
  // Above the island: itself and the hole's edge, nearest at (1, 0, 0).
  const std::vector<Foot> over = inverter.find_all({ 0.1, 0, 1 });
  ASSERT_EQ(over.size(), 2u);
  EXPECT_EQ(over[0].type, FootType::Interior);
  EXPECT_NEAR(over[0].distance, 1.0, 1e-14);
  EXPECT_NEAR((over[1].point - Vector3(1, 0, 0)).norm(), 0.0, tolerance);
  // Above the plate: itself; the island's edge that faces the point.
  const std::vector<Foot> beside = inverter.find_all({ 5, 0, 1 });
  ASSERT_EQ(beside.size(), 2u);
  EXPECT_EQ(beside[0].type, FootType::Interior);
  EXPECT_NEAR((beside[1].point - Vector3(0.25, 0, 0)).norm(), 0.0, tolerance);
}

TEST(TrimmedOrthogonalOnly, NothingOverAHole)
{
  const PointInverter inverter({ plate(false) }, orthogonal_only());
  const Foot over = inverter.find({ 3, 2, 1 });
  EXPECT_EQ(over.type, FootType::Interior);
  EXPECT_NEAR(over.distance, 1.0, 1e-14);
  const Foot hole = inverter.find({ 0.2, 0, 1 });
  EXPECT_EQ(hole.status, Status::NoOrthogonalFoot);
  EXPECT_NEAR(hole.distance, std::sqrt(1.64), 1e-12);
  EXPECT_EQ(inverter.find({ 12, 0, 1 }).status, Status::NoOrthogonalFoot);
}

TEST(TrimmedFixedDirection, LinesThroughHoles)
{
  const PointInverter inverter({ plate(true) }, along({ 0, 0, 2 }));
  EXPECT_TRUE(inverter.find_all({ 0.5, 0.3, 7 }).empty());
  EXPECT_EQ(inverter.find({ 0.5, 0.3, 7 }).status, Status::BeyondMaximumDistance);
  const std::vector<Foot> island = inverter.find_all({ 0.1, 0.1, 7 });
  ASSERT_EQ(island.size(), 1u);
  EXPECT_NEAR((island[0].point - Vector3(0.1, 0.1, 0)).norm(), 0.0, 1e-13);
  EXPECT_NEAR(island[0].distance, 7.0, 1e-13);
  EXPECT_EQ(inverter.find_all({ -4, 3, -2 }).size(), 1u);
  EXPECT_TRUE(inverter.find_all({ 11, 3, -2 }).empty());
  // Through a solid: in and out; through its hole: nothing.
  const PointInverter solid(solids::box_with_hole().faces, along({ 0, 0, 1 }));
  EXPECT_EQ(solid.find_all({ 1.5, 1.4, 5 }).size(), 2u);
  EXPECT_TRUE(solid.find_all({ 0.5, 0.4, 5 }).empty());
}

TEST(TrimmedMaximumDistance, CutsOffAtEdges)
{
  InversionOptions options;
  options.maximum_distance = 1.0;
  const PointInverter inverter({ plate(false) }, options);
  EXPECT_EQ(inverter.find({ 0.2, 0, 0 }).status, Status::Certified); // 0.8 from the hole's edge
  EXPECT_EQ(inverter.find({ 0.2, 0, 1 }).status, Status::BeyondMaximumDistance);
  EXPECT_EQ(inverter.find({ 10.9, 0, 0 }).status, Status::Certified);
  EXPECT_EQ(inverter.find({ 11.1, 0, 0 }).status, Status::BeyondMaximumDistance);
}

TEST(TrimmedSearches, SeededAndLocalKeepToTheFace)
{
  for (const Search search : { Search::Seeded, Search::Local })
  {
    InversionOptions options;
    options.search = search;
    const PointInverter inverter({ plate(false) }, options);
    const Foot hole = inverter.find({ 0.2, 0, 1 });
    EXPECT_GE(hole.distance, std::sqrt(1.64) - 1e-12);
    EXPECT_GE(hole.point.head<2>().norm(), 1.0 - 1e-12);
    EXPECT_NEAR(inverter.find({ 3, 2, 1 }).distance, 1.0, 1e-12);
    // From a start in the hole.
    Start start;
    start.face = 0;
    start.parameter = Parameter<2>(0.1, 0.1);
    const Foot started = inverter.find({ 0.2, 0, 1 }, start);
    EXPECT_TRUE(started.face < 0 || started.point.head<2>().norm() >= 1.0 - 1e-12);
  }
  InversionOptions seeded;
  seeded.search = Search::Seeded;
  EXPECT_NEAR(
    PointInverter({ plate(false) }, seeded).find({ 0.2, 0, 1 }).distance, std::sqrt(1.64), 1e-9);
}

// === Threads, blocks and order

/// Numbers of a foot, bit for bit.
std::vector<double> bits(const Foot& foot)
{
  return { static_cast<double>(foot.status), static_cast<double>(foot.type),
    static_cast<double>(foot.isolated), static_cast<double>(foot.iterations),
    static_cast<double>(foot.face), foot.parameter(0), foot.parameter(1), foot.point[0],
    foot.point[1], foot.point[2], foot.direction[0], foot.direction[1], foot.direction[2],
    foot.distance, foot.signed_distance };
}

bool same_bits(const Foot& a, const Foot& b)
{
  const std::vector<double> first = bits(a);
  const std::vector<double> second = bits(b);
  return std::memcmp(first.data(), second.data(), first.size() * sizeof(double)) == 0;
}

TEST(TrimmedThreads, SameBitsForAnySplitAndOrder)
{
  Model model;
  std::string name;
  trims::RandomFaces faces(77);
  for (int k = 0; k < 10; ++k)
  {
    model.push_back(faces.face(name));
  }
  for (const Face& face : solids::box_with_hole().faces)
  {
    model.push_back(face);
  }
  const PointInverter inverter(model);
  shapes::Random random(5);
  const int count = 600;
  Points points(3, count);
  Points reversed(3, count);
  for (int k = 0; k < count; ++k)
  {
    points.col(k) = k % 5 == 0 ? random.vector(-4.0, 4.0) : random.vector(-0.2, 1.2);
    reversed.col(count - 1 - k) = points.col(k);
  }
  const InversionResult alone = invert(inverter, points);
  const InversionResult threads = invert(inverter, points, {}, in_threads(3));
  const InversionResult backwards = invert(inverter, reversed, {}, in_threads(2));
  for (int k = 0; k < count; ++k)
  {
    EXPECT_TRUE(same_bits(alone.feet[k], threads.feet[k])) << k;
    EXPECT_TRUE(same_bits(alone.feet[k], backwards.feet[count - 1 - k])) << k;
    EXPECT_TRUE(same_bits(alone.feet[k], inverter.find(points.col(k)))) << k;
  }
}

} // namespace
