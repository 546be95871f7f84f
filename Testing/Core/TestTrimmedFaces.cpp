// SPDX-License-Identifier: BSD-3-Clause

// The nearest point of trimmed faces: closed forms, and against an oracle by brute force.

#include "FootJudge.h"
#include "RandomFaces.h"

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
  EXPECT_EQ(
    PointInverter(model_of(trims::flat(0, 1), trims::flat(1, 2))).number_of_open_edges(), 6);
}

/// A second face farther away than the trimmed one; the box of its control points holds the point
/// above its middle, so that the search begins with it.
footpoint::Surface bowl(const Vector3& middle)
{
  footpoint::Points points(3, 9);
  for (int k = 0; k < 9; ++k)
  {
    const Vector3 out(0.5 * (k % 3 - 1), 0.5 * (k / 3 - 1), k == 4 ? -1.05 : 0.35);
    points.col(k) = middle + out;
  }
  const std::vector<double> knots{ 0, 0, 0, 1, 1, 1 };
  return Surface(footpoint::KnotVector(2, knots), footpoint::KnotVector(2, knots), points);
}

/// Files with twelve digits have loops that run beside the border of the domain, not along it.
TEST(TrimmedFaces, LoopsBesideTheBorderOfTheDomain)
{
  for (const double beside : { 1e-15, 1e-14, 1e-13, 9e-13, 1.1e-12, 1e-11, -1e-13, -1e-9 })
  {
    SCOPED_TRACE(beside);
    const Face face = trimmed(trims::flat(), { trims::rectangle(beside, 0, 1, 1) });
    const PointInverter inverter({ face });
    const Foot foot = inverter.find({ -0.1, 0.5, 0 });
    EXPECT_EQ(foot.status, Status::Certified);
    EXPECT_EQ(foot.type, FootType::Edge);
    EXPECT_NEAR(foot.distance, 0.1, 2.0 * std::abs(beside));
    const PointInverter two({ face, face_of(bowl({ -0.1, 0.5, -0.3 })) });
    const Foot nearer = two.find({ -0.1, 0.5, 0 });
    EXPECT_EQ(nearer.face, 0);
    EXPECT_NEAR(nearer.distance, 0.1, 2.0 * std::abs(beside));
  }
}

/// The foot on the untrimmed plane lies in the hole, which is bounded by edges all the same.
TEST(TrimmedFaces, HolesAsSmallAsRounding)
{
  for (const double radius : { 1e-8, 1e-9, 1e-10, 1e-12, 1e-13, 1e-14 })
  {
    SCOPED_TRACE(radius);
    const Face face = trimmed(trims::flat(),
      { trims::rectangle(0, 0, 1, 1), trims::reversed(trims::circle(0.5, 0.5, radius)) });
    const PointInverter two({ face, face_of(bowl({ 0.5, 0.5, -0.2 })) });
    const Foot foot = two.find({ 0.5, 0.5, 0.1 });
    EXPECT_EQ(foot.status, Status::Certified);
    EXPECT_EQ(foot.face, 0);
    EXPECT_NEAR(foot.distance, 0.1, 1e-12);
  }
}

/// A loop beside a pole instead of along the collapsed side.
TEST(TrimmedFaces, LoopBesideAPole)
{
  footpoint::Points points(3, 4);
  points << 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 1, 1;
  const footpoint::KnotVector knots(1, { 0, 0, 1, 1 });
  const Surface corner(knots, knots, points);
  for (const double beside : { 0.0, 1e-13, 1e-11, 1e-9 })
  {
    SCOPED_TRACE(beside);
    const PointInverter inverter(
      { trimmed(corner, { trims::rectangle(0, beside, 1, 1) }), face_of(bowl({ 0, 0, -0.4 })) });
    const Foot foot = inverter.find({ 0, 0, -0.1 });
    EXPECT_EQ(foot.status, Status::Certified);
    EXPECT_EQ(foot.face, 0);
    EXPECT_NEAR(foot.distance, 0.1, 2.0 * beside + 1e-12);
  }
}

/// Faces with loops over surfaces of several kinds, in parts of their domain.
struct Case
{
  const char* name;
  Surface surface;
  std::vector<TrimLoop> loops;
};

std::vector<Case> cases()
{
  std::vector<Case> result;
  const auto add = [&](const char* name, const Surface& surface, std::vector<TrimLoop> loops)
  {
    for (TrimLoop& loop : loops)
    {
      loop = trims::moved(surface, loop);
    }
    result.push_back({ name, surface, std::move(loops) });
  };
  add("saddle with a hole", shapes::saddle(),
    { trims::rectangle(0, 0, 1, 1), trims::reversed(trims::circle(0.5, 0.5, 0.3)) });
  add("sphere in a wave", shapes::sphere(), { trims::wave(0.5, 0.5, 0.3, 5, 0.3) });
  add("torus with a window", shapes::torus(),
    { trims::rectangle(0.1, 0.2, 0.8, 0.9), trims::reversed(trims::wave(0.5, 0.5, 0.15, 3, 0.2)) });
  add("bumpy in a wave", shapes::bumpy(8, 3), { trims::wave(0.5, 0.5, 0.4, 7, 0.2) });
  add("bumpy with holes", shapes::bumpy(12, 5),
    { trims::rectangle(0, 0, 1, 1), trims::reversed(trims::circle(0.3, 0.3, 0.2)),
      trims::reversed(trims::circle(0.7, 0.7, 0.2)), trims::circle(0.7, 0.7, 0.1) });
  add("cylinder with a hole", shapes::cylinder(),
    { trims::rectangle(0, 0, 1, 1), trims::reversed(trims::circle(0.5, 0.5, 0.2)) });
  add("cusp", shapes::cusp(), { trims::wave(0.5, 0.5, 0.35, 4, 0.1) });
  add("a thin strip", shapes::bumpy(6, 9), { trims::rectangle(0.1, 0.4, 0.9, 0.4005) });
  return result;
}

TEST(TrimmedFaces, NoPointIsNearerThanTheFoot)
{
  shapes::Random random(7);
  for (const Case& one : cases())
  {
    SCOPED_TRACE(one.name);
    judge::Tally tally;
    judge::Judge(one.name, { trimmed(one.surface, one.loops) }).ask(66, random, tally);
    EXPECT_EQ(tally.wrong(), 0u) << tally;
    EXPECT_EQ(tally.uncertified, 0u);
  }
}

/// Files leave trim curves along the border of the domain beside it by a rounding: what lies
/// between is neither trimmed away nor an edge of its own.
TEST(TrimmedFaces, CurvesBesideTheBorderAreOnIt)
{
  for (const double off : { 3e-13, -3e-13 })
  {
    const auto side = [off](double u0, double v0, double u1, double v1)
    {
      footpoint::Points points = footpoint::Points::Zero(3, 3);
      points.col(0).head<2>() << u0, v0;
      points.col(1).head<2>() << 0.5 * (u0 + u1) + off, 0.5 * (v0 + v1) + off;
      points.col(2).head<2>() << u1, v1;
      return std::make_shared<footpoint::Curve>(
        footpoint::KnotVector(2, { 0, 0, 0, 1, 1, 1 }), points);
    };
    TrimLoop loop;
    loop.curves = { side(0, 0, 1, 0), side(1, 0, 1, 1), side(1, 1, 0, 1), side(0, 1, 0, 0) };
    const PointInverter inverter({ trimmed(trims::flat(), { loop }) });
    expect_foot(inverter.find({ 0.3, 0.5, 2 }), { 0.3, 0.5, 0 }, 2.0, FootType::Interior);
    expect_foot(inverter.find({ 0.3, 3, 0 }), { 0.3, 1, 0 }, 2.0, FootType::Edge);
    expect_foot(inverter.find({ 0.3, -3, 0 }), { 0.3, 0, 0 }, 3.0, FootType::Edge);
    expect_foot(inverter.find({ -3, 0.7, 0 }), { 0, 0.7, 0 }, 3.0, FootType::Edge);
    expect_foot(inverter.find({ 4, 0.7, 0 }), { 1, 0.7, 0 }, 3.0, FootType::Edge);
    expect_foot(inverter.find({ 4, 5, 0 }), { 1, 1, 0 }, 5.0, FootType::Vertex);
  }
}

/// A gap of 4e-10 at a corner is an edge like any other.
TEST(TrimmedFaces, TheEdgeOfASmallGapCounts)
{
  TrimLoop loop;
  loop.curves = { trims::polyline({ { 0, 0 }, { 0.9, 0 } }),
    trims::polyline({ { 0.9, 0 }, { 0.9, 1 - 5e-10 } }),
    trims::polyline({ { 0.9 - 1e-10, 1 }, { 0, 1 } }), trims::polyline({ { 0, 1 }, { 0, 0 } }) };
  const PointInverter inverter({ trimmed(trims::flat(), { loop }) });
  expect_foot(inverter.find({ 1.9, 2, 0 }), { 0.9 - 1e-10, 1, 0 }, std::hypot(1 + 1e-10, 1),
    FootType::Vertex);
}

/// A trimmed face at random: wild control points and weights, loops that are stars.
Face random_face(shapes::Random& random)
{
  std::array<footpoint::KnotVector, 2> knots{ footpoint::KnotVector(1, { 0, 0, 1, 1 }),
    footpoint::KnotVector(1, { 0, 0, 1, 1 }) };
  std::array<int, 2> count;
  for (int i = 0; i < 2; ++i)
  {
    const int degree = random.integer(1, 4);
    const int spans = random.integer(1, 5);
    knots[i] = footpoint::KnotVector(degree, shapes::clamped_knots(degree, spans));
    count[i] = degree + spans;
  }
  const double height = random.magnitude(1.0);
  footpoint::Points points(3, count[0] * count[1]);
  Eigen::VectorXd weights(count[0] * count[1]);
  for (int k = 0; k < points.cols(); ++k)
  {
    const Vector3 place(k % count[0] / (count[0] - 1.0), k / count[0] / (count[1] - 1.0), 0.0);
    points.col(k) = place + height * random.vector(-0.2, 0.2);
    weights[k] = random.magnitude(2.0);
  }
  const Surface surface = random.integer(0, 1) == 0
    ? Surface(knots[0], knots[1], points)
    : Surface(knots[0], knots[1], points, weights);
  const auto star = [&random](double u, double v, double radius)
  {
    std::vector<trims::Point2> corners;
    const int count_of_corners = random.integer(3, 9);
    for (int k = 0; k < count_of_corners; ++k)
    {
      const double angle = 2.0 * std::acos(-1.0) * k / count_of_corners;
      const double r = radius * random.uniform(0.4, 1.0);
      corners.emplace_back(u + r * std::cos(angle), v + r * std::sin(angle));
    }
    return trims::polygon(corners);
  };
  switch (random.integer(0, 2))
  {
    case 0:
      return trimmed(surface, { star(0.5, 0.5, 0.48) });
    case 1:
      return trimmed(
        surface, { trims::rectangle(0, 0, 1, 1), trims::reversed(star(0.5, 0.5, 0.4)) });
    default:
      return trimmed(surface,
        { trims::rectangle(0, 0, 1, 1), trims::reversed(star(0.25, 0.3, 0.2)),
          trims::reversed(star(0.7, 0.7, 0.25)), star(0.7, 0.7, 0.09) });
  }
}

/// Every foot is certified, and no sample of the face is nearer.
void expect_certified_feet(std::uint64_t seed, int queries)
{
  SCOPED_TRACE(seed);
  shapes::Random random(seed);
  const Face face = random_face(random);
  const auto& surface = *face.patches.front().surface;
  std::vector<Vector3> samples;
  for (int k = 0; k <= 60 * 61; ++k)
  {
    const Parameter<2> at(k % 61 / 60.0, k / 61 / 60.0);
    if (face.region->contains(at(0), at(1)))
    {
      samples.push_back(surface.centre() + surface.point(at));
    }
  }
  const PointInverter inverter({ face });
  for (int k = 0; k < queries; ++k)
  {
    const Parameter<2> at(random.uniform(0.0, 1.0), random.uniform(0.0, 1.0));
    const double away = std::pow(10.0, random.uniform(-5.0, 0.5));
    const Vector3 query =
      surface.centre() + surface.point(at) + away * random.vector(-1.0, 1.0);
    const Foot foot = inverter.find(query);
    EXPECT_EQ(foot.status, Status::Certified) << query.transpose();
    double nearest = INFINITY;
    for (const Vector3& sample : samples)
    {
      nearest = std::min(nearest, (sample - query).norm());
    }
    EXPECT_LE(foot.distance, nearest + 1e-12 * inverter.size()) << query.transpose();
  }
}

/// The last four seeds have pieces that go on far below the loops: their cells must not be narrow.
TEST(TrimmedFaces, RandomFacesAreCertified)
{
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
  {
    expect_certified_feet(seed, 40);
  }
  for (const std::uint64_t seed : { 143, 361, 572, 862 })
  {
    expect_certified_feet(seed, 100);
  }
}

} // namespace
