// SPDX-License-Identifier: BSD-3-Clause

// The table of hard cases, surfaces: S1 to S8, S11 and the surfaces of S13, each with its closed
// form.

#include "Inversion.h"
#include "OracleNearest.h"
#include "OracleShapes.h"

using namespace inversion;
using footpoint::Surface;

namespace
{

const double kNaN = NAN;
const double kRoot = std::sqrt(0.5);

Surface polynomial_surface(int degree_u, const std::vector<double>& knots_u, int degree_v,
  const std::vector<double>& knots_v, const footpoint::Points& net)
{
  return Surface(footpoint::KnotVector(degree_u, knots_u, "KnotsU"),
    footpoint::KnotVector(degree_v, knots_v, "KnotsV"), net);
}

/// A parallelogram on [0, 1]² from the origin.
Surface parallelogram(const Vector3& u, const Vector3& v)
{
  return polynomial_surface(
    1, { 0, 0, 1, 1 }, 1, { 0, 0, 1, 1 }, shapes::points({ { 0, 0, 0 }, u, v, u + v }));
}

/// A loop that crosses itself at x = ½, extruded along z: (x(u), y(u), v).
Surface crossing_sheet()
{
  return polynomial_surface(3, { 0, 0, 0, 0, 1, 1, 1, 1 }, 1, { 0, 0, 1, 1 },
    shapes::points({ { 0, 0, 0 }, { 3, 2, 0 }, { -2, 2, 0 }, { 1, 0, 0 }, { 0, 0, 1 }, { 3, 2, 1 },
      { -2, 2, 1 }, { 1, 0, 1 } }));
}

} // namespace

TEST(HardCaseS1, SaddleBetweenTwoMinima)
{
  const PointInverter inverter(model_of(shapes::saddle()));
  const PointInverter every(model_of(shapes::saddle()), all_feet());
  for (const double h : { 1.01, 1.25, 1.5, 1.75 })
  {
    const double s = std::sqrt(h - 1.0);
    const double distance = std::sqrt(2.0 * h - 1.0);
    const Expected low{ distance, { -s, -s }, FootType::Interior, true, { -s, -s, h - 1.0 } };
    const Expected high{ distance, { s, s }, FootType::Interior, true, { s, s, h - 1.0 } };
    expect_foot(inverter, { 0, 0, h }, low);
    expect_all(every, { 0, 0, h }, { low, high });
  }
  // Focal: a fourth-order minimum along x = y, hidden by rounding below 3e-6.
  Expected focal{ 1.0, { 0, 0 } };
  focal.parameter_tolerance = 1e-6;
  expect_foot(inverter, { 0, 0, 1 }, focal);
  expect_all(every, { 0, 0, 1 }, { focal });
  expect_foot(inverter, { 0, 0, 0.5 }, { 0.5, { 0, 0 }, FootType::Interior, true, { 0, 0, 0 } });
}

TEST(HardCaseS1, SaddlesAreOrthogonalFeet)
{
  InversionOptions options = orthogonal_only();
  options.all_feet = true;
  const PointInverter every(model_of(shapes::saddle()), options);
  expect_all(every, { 0, 0, 1.5 },
    { { std::sqrt(2.0), { -kRoot, -kRoot } }, { std::sqrt(2.0), { kRoot, kRoot } },
      { 1.5, { 0, 0 } } });
}

TEST(HardCaseS2, BoundaryFootOfThePartialCylinder)
{
  const double root = std::sqrt(2.0);
  const Vector3 query(root, -root, 5);
  const double distance = std::sqrt((10.0 - root) * (10.0 - root) + 2.0);
  EXPECT_NEAR(distance, 8.7015, 1e-4);
  const Expected start{ distance, { 0, 5 }, FootType::Edge, true, { 10, 0, 5 } };
  const Expected end{ distance, { 270, 5 }, FootType::Edge, true, { 0, -10, 5 } };
  expect_foot(PointInverter(model_of(shapes::cylinder())), query, start);
  expect_all(PointInverter(model_of(shapes::cylinder()), all_feet()), query, { start, end });
  // A little off the middle the tie is resolved.
  expect_foot(PointInverter(model_of(shapes::cylinder())), { root - 1e-6, -root - 1e-6, 5 },
    { std::hypot(10.0 - root - 1e-6, root - 1e-6), { 270, 5 }, FootType::Edge });
  // The orthogonal foot lies on the other side.
  expect_foot(PointInverter(model_of(shapes::cylinder()), orthogonal_only()), query,
    { 12.0, { 135, 5 }, FootType::Interior, true, { -10 * kRoot, 10 * kRoot, 5 } });
}

TEST(HardCaseS3, FarFromTheSquare)
{
  const PointInverter inverter(model_of(shapes::square()));
  expect_foot(
    inverter, { 5, 5, 100 }, { std::sqrt(8125.0), { 5, 10 }, FootType::Edge, true, { 0, 5, 10 } });
  expect_foot(inverter, { 5, 20, 100 },
    { std::sqrt(8225.0), { 10, 10 }, FootType::Vertex, true, { 0, 10, 10 } });
  expect_foot(
    inverter, { 5, -20, -1 }, { std::sqrt(426.0), { 0, 0 }, FootType::Vertex, true, { 0, 0, 0 } });
  expect_foot(inverter, { -5, 5, 3 }, { 5.0, { 5, 3 }, FootType::Interior, true, { 0, 5, 3 } });
  EXPECT_EQ(inverter.find({ -5, 5, 3 }).signed_distance, -5.0);
  EXPECT_EQ(inverter.find({ 5, 5, 3 }).signed_distance, 5.0);
  // In the plane beside the face the sign is +.
  EXPECT_NEAR(inverter.find({ 0, 12, 3 }).signed_distance, 2.0, 1e-14);
  // On the border itself.
  expect_foot(inverter, { 0, 10, 3 }, { 0.0, { 10, 3 }, FootType::Edge, true, { 0, 10, 3 } });
  const Vector3 query(5, 5, 100);
  expect_foot(PointInverter(model_of(shapes::square()), orthogonal_only()), query,
    { std::sqrt(8125.0), { 5, 10 }, FootType::Edge, true, { 0, 5, 10 }, Status::NoOrthogonalFoot });
}

TEST(HardCaseS4, ApexOfTheTriangle)
{
  const PointInverter inverter(model_of(shapes::triangle()));
  const Expected apex{ std::sqrt(3.0), { 0, kNaN }, FootType::Degenerate, true, { 0, 0, 0 } };
  expect_foot(inverter, { -1, -1, 1 }, apex);
  expect_all(PointInverter(model_of(shapes::triangle()), all_feet()), { -1, -1, 1 }, { apex });
  EXPECT_NEAR(inverter.find({ -1, -1, 1 }).signed_distance, std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(inverter.find({ -1, -1, -1 }).signed_distance, -std::sqrt(3.0), 1e-12);
  // Beside the apex: on the side v = 0, on the side v = 1, inside.
  expect_foot(
    inverter, { 1e-6, -1, 0 }, { 1.0, { 1e-6, 0 }, FootType::Edge, true, { 1e-6, 0, 0 } });
  expect_foot(
    inverter, { -1, 1e-3, 0 }, { 1.0, { 1e-3, 1 }, FootType::Edge, true, { 0, 1e-3, 0 } });
  expect_foot(inverter, { 1e-3, 3e-3, 1 },
    { 1.0, { 4e-3, 0.75 }, FootType::Interior, true, { 1e-3, 3e-3, 0 } });
  // A start on the collapsed side, in a column that leads away.
  InversionOptions local;
  local.search = footpoint::Search::Local;
  const PointInverter from_apex(model_of(shapes::triangle()), local);
  for (const double v : { 0.0, 0.5, 1.0 })
  {
    expect_foot(from_apex, from_apex.find({ 0.1, 0.3, 1 }, { 0, { 0.0, v } }),
      { 1.0, { 0.4, 0.75 }, FootType::Interior, true, { 0.1, 0.3, 0 } }, "started at the apex");
  }
}

TEST(HardCaseS5, PolesAndCentreOfTheSphere)
{
  const PointInverter inverter(model_of(shapes::sphere()));
  const Expected pole{ 1.0, { kNaN, 90 }, FootType::Degenerate, true, { 0, 0, 1 } };
  expect_foot(inverter, { 0, 0, 2 }, pole);
  expect_foot(
    inverter, { 0, 0, 1 }, { 0.0, { kNaN, 90 }, FootType::Degenerate, true, { 0, 0, 1 } });
  EXPECT_NEAR(inverter.find({ 0, 0, 2 }).signed_distance, 1.0, 1e-12);
  EXPECT_NEAR(inverter.find({ 0, 0, 0.5 }).signed_distance, -0.5, 1e-12);
  EXPECT_LE((inverter.find({ 0, 0, 2 }).direction - Vector3(0, 0, 1)).norm(), 1e-12);
  expect_foot(
    inverter, { 0, 0, -2 }, { 1.0, { kNaN, -90 }, FootType::Degenerate, true, { 0, 0, -1 } });
  expect_all(PointInverter(model_of(shapes::sphere()), all_feet()), { 0, 0, 2 }, { pole });
  // Near the pole the foot still has its own longitude.
  for (const double x : { 1e-3, 1e-6, 1e-9, 1e-12 })
  {
    const double norm = std::hypot(x, 2.0);
    const Foot foot = inverter.find({ 0, x, 2 });
    EXPECT_EQ(foot.status, Status::Certified);
    EXPECT_TRUE(foot.isolated);
    EXPECT_NEAR(foot.distance, norm - 1.0, 1e-15);
    EXPECT_NEAR(foot.signed_distance, norm - 1.0, 1e-15);
    // Where |S_u| is a tenth of a millionth of its mean, the pole itself may stand for the foot.
    EXPECT_LE((foot.point - Vector3(0, x, 2) / norm).norm(), x > 1e-7 ? 1e-12 : 1e-9) << x;
    EXPECT_LE((foot.direction - Vector3(0, x, 2) / norm).norm(), 1e-6);
  }
  expect_foot(
    inverter, { 0, 0, 0 }, { 1.0, { kNaN, kNaN }, inverter.find({ 0, 0, 0 }).type, false });
}

TEST(HardCaseS6, ContinuaEndWhereTheQueryLeavesTheCentre)
{
  const auto is_isolated = [](const Surface& surface, const Vector3& query)
  {
    const Foot foot = PointInverter(model_of(surface)).find(query);
    EXPECT_EQ(foot.status, Status::Certified);
    return foot.isolated;
  };
  const Vector3 way = Vector3(0.6, 0.5, 0.4).normalized();
  // So near the centre all of it is one point to rounding …
  for (const double off : { 0.0, 1e-14 })
  {
    EXPECT_FALSE(is_isolated(shapes::sphere(), off * way)) << off;
    EXPECT_FALSE(is_isolated(shapes::torus(), Vector3(3, 0, 0) + off * way)) << off;
  }
  // … also where it is far away beside the size, or of many pieces, whose second derivatives round
  // more …
  const Vector3 height(0, 0, 0.3);
  EXPECT_FALSE(is_isolated(shapes::cylinder(1000.0, 0.06, 1), height));
  EXPECT_FALSE(is_isolated(shapes::cylinder(100.0, 0.6, 4), height));
  EXPECT_FALSE(is_isolated(shapes::cylinder(100.0, 6.0, 256), height));
  EXPECT_FALSE(is_isolated(shapes::cylinder(1.0, 350.0, 4000), height));
  // … and beside it the foot is the point on that side.
  for (const double off : { 1e-8, 1e-5, 1e-2 })
  {
    EXPECT_TRUE(is_isolated(shapes::sphere(), off * way)) << off;
    EXPECT_TRUE(is_isolated(shapes::torus(), Vector3(3, 0, 0) + off * way)) << off;
  }
}

TEST(HardCaseS6, TorusAxisAndSeams)
{
  const Surface torus = shapes::torus();
  const PointInverter inverter(model_of(torus));
  // The centre of the tube and of the whole: circles of feet.
  expect_foot(inverter, { 3, 0, 0 }, { 1.0, { 0, kNaN }, FootType::Interior, false });
  expect_foot(inverter, { 0, 0, 0 }, { 2.0, { kNaN, 180 }, FootType::Interior, false });
  // Across both seams nothing jumps.
  for (const double y : { -1e-12, 0.0, 1e-12 })
  {
    for (const double z : { -1e-12, 0.0, 1e-12 })
    {
      const Foot foot = inverter.find({ 5, y, z });
      EXPECT_EQ(foot.status, Status::Certified);
      EXPECT_EQ(foot.type, FootType::Interior);
      EXPECT_TRUE(foot.isolated);
      EXPECT_NEAR(foot.signed_distance, 1.0, 1e-12);
      EXPECT_LE((foot.point - Vector3(4, 0.8 * y, 0.5 * z)).norm(), 1e-12);
      EXPECT_LE((foot.direction - Vector3(1, 0, 0)).norm(), 1e-11);
    }
  }
  shapes::Random random(6);
  for (int k = 0; k < 200; ++k)
  {
    const Vector3 query = random.vector(-5, 5);
    const double to_tube = std::hypot(std::hypot(query.x(), query.y()) - 3.0, query.z());
    EXPECT_NEAR(inverter.find(query).signed_distance, to_tube - 1.0, 1e-12 * inverter.size());
  }
}

TEST(HardCaseS7, CuspWithSingularMetric)
{
  const PointInverter inverter(model_of(shapes::cusp()));
  for (const double v : { 0.0, 0.3, 1.0 })
  {
    expect_foot(inverter, { -1, 0, v }, { 1.0, { 0, v }, FootType::Degenerate, true, { 0, 0, v } });
    // Both sides of the cusp.
    for (const double u : { -0.1, 0.1 })
    {
      expect_foot(inverter, { u * u, u * u * u, v },
        { 0.0, { u, v }, inverter.find({ u * u, u * u * u, v }).type, true,
          { u * u, u * u * u, v } });
    }
  }
}

TEST(HardCaseS8, TurnsOfTheHelicalRibbon)
{
  const Surface ribbon = shapes::helical_ribbon();
  const PointInverter inverter(model_of(ribbon));
  const PointInverter every(model_of(ribbon), all_feet());
  const oracle::Nearest<2> nearest(shapes::spline_of(ribbon));
  // Halfway between the turns at u = 3 and u = 4 the half turn about the x axis makes a tie.
  const Vector3 query(0.75, 0, 0.875);
  const double distance = static_cast<double>(nearest(query.cast<oracle::Real>()).distance);
  const Foot tie = inverter.find(query);
  EXPECT_NEAR(tie.distance, distance, 1e-12 * inverter.size());
  EXPECT_LT(tie.parameter(0), 3.5);
  const std::vector<Foot> both = every.find_all(query);
  ASSERT_GE(both.size(), 2u);
  EXPECT_NEAR(both[0].distance, both[1].distance, 1e-12 * inverter.size());
  EXPECT_NEAR(both[0].parameter(0) + both[1].parameter(0), 7.0, 1e-9);
  EXPECT_LT(both[0].parameter(0), both[1].parameter(0));
  for (const double shift : { -1e-6, 1e-6 })
  {
    const Vector3 moved = query + Vector3(0, 0, shift);
    const Foot foot = inverter.find(moved);
    const oracle::Foot<2> judge = nearest(moved.cast<oracle::Real>());
    EXPECT_NEAR(foot.distance, judge.distance, 1e-12 * inverter.size());
    EXPECT_NEAR(foot.parameter(0), judge.parameter[0], 1e-6);
    EXPECT_EQ(foot.parameter(0) > 3.5, shift > 0.0);
  }
}

TEST(HardCaseS11, NearlyParallelDerivatives)
{
  // The plane z = 0 under |S_u × S_v| = 1e-8: the strip 0 ≤ y ≤ 1e-8 between slanted ends.
  const PointInverter inverter(model_of(parallelogram({ 1, 0, 0 }, { 1, 1e-8, 0 })));
  shapes::Random random(11);
  for (int k = 0; k < 100; ++k)
  {
    const double x = random.uniform(1e-6, 2.0 - 1e-6);
    const double z = random.uniform(-1.0, 1.0);
    const double v = random.uniform(std::max(0.0, x - 1.0), std::min(1.0, x));
    const Foot above = inverter.find({ x, 1e-8 * v, z });
    EXPECT_NEAR(above.distance, std::abs(z), 1e-12 * inverter.size());
    // Convexity cannot be told from rounding in these parameters: right, but not certified.
    EXPECT_LE(above.status, Status::Converged);
    const Foot beside = inverter.find({ x, 1.0, z });
    EXPECT_NEAR(
      beside.distance, std::hypot(1.0 - 1e-8 * std::min(1.0, x), z), 1e-12 * inverter.size());
  }
}

TEST(HardCaseS11, SelfIntersection)
{
  const Surface sheet = crossing_sheet();
  const oracle::Spline<2> exact = shapes::spline_of(sheet);
  // x(u) = ½ for the first time, by bisection: x rises to the crossing from 0.
  oracle::Real low = 0.0L;
  oracle::Real high = 0.2L;
  for (int k = 0; k < 100; ++k)
  {
    const oracle::Real middle = (low + high) / 2.0L;
    (exact.point({ middle, 0.0L })[0] < 0.5L ? low : high) = middle;
  }
  const double u = static_cast<double>(low);
  const double y = static_cast<double>(exact.point({ low, 0.0L })[1]);
  const PointInverter inverter(model_of(sheet));
  const PointInverter every(model_of(sheet), all_feet());
  for (const double v : { 0.25, 0.5, 0.75 })
  {
    const Expected first{ 0.0, { u, v }, FootType::Interior, true, { 0.5, y, v } };
    const Expected second{ 0.0, { 1.0 - u, v }, FootType::Interior, true, { 0.5, y, v } };
    expect_foot(inverter, { 0.5, y, v }, first);
    const std::vector<Foot> feet = every.find_all({ 0.5, y, v });
    ASSERT_GE(feet.size(), 2u);
    expect_foot(every, feet[0], first, "first branch");
    expect_foot(every, feet[1], second, "second branch");
  }
  const oracle::Nearest<2> nearest(exact);
  shapes::Random random(111);
  for (int k = 0; k < 50; ++k)
  {
    const Vector3 query = random.vector(-1.0, 2.0);
    EXPECT_NEAR(inverter.find(query).distance, nearest(query.cast<oracle::Real>()).distance,
      1e-12 * inverter.size());
  }
}

TEST(HardCaseS11, CoincidentFaces)
{
  const Surface bumpy = shapes::bumpy(8, 3);
  const Model model = model_of(shapes::square(), bumpy, bumpy);
  const PointInverter inverter(model);
  const PointInverter every(model, all_feet());
  shapes::Random random(112);
  for (int k = 0; k < 50; ++k)
  {
    const Vector3 query(random.uniform(0.5, 1), random.uniform(0, 1), random.uniform(-0.2, -0.1));
    const Foot foot = inverter.find(query);
    EXPECT_EQ(foot.face, 1);
    const std::vector<Foot> feet = every.find_all(query);
    ASSERT_GE(feet.size(), 2u);
    EXPECT_EQ(feet[0].face, 1);
    EXPECT_EQ(feet[1].face, 2);
    EXPECT_EQ(feet[0].parameter, feet[1].parameter);
    EXPECT_NEAR(feet[0].distance, foot.distance, 1e-15);
  }
}

TEST(HardCaseS13, BadQueriesToASurface)
{
  const PointInverter inverter(model_of(shapes::torus()));
  footpoint::Points points(3, 4);
  points << kNaN, INFINITY, 5, 1, //
    0, 0, 0, -INFINITY,           //
    0, 0, 0, 0;
  const footpoint::InversionResult result = footpoint::invert(inverter, points);
  for (const int k : { 0, 1, 3 })
  {
    EXPECT_EQ(result.feet[k].status, Status::InvalidPoint);
    EXPECT_TRUE(std::isnan(result.feet[k].signed_distance));
    EXPECT_TRUE(result.feet[k].point.array().isNaN().all());
    EXPECT_TRUE(result.feet[k].direction.array().isNaN().all());
  }
  EXPECT_NEAR(result.feet[2].distance, 1.0, 1e-12);
  EXPECT_TRUE(footpoint::invert(inverter, footpoint::Points(3, 0)).feet.empty());
}

TEST(HardCaseS13, SurfaceThatIsAPoint)
{
  const Surface point = polynomial_surface(2, shapes::clamped_knots(2, 2), 1,
    shapes::clamped_knots(1, 1), Vector3(1, 2, 3).replicate(1, 8));
  for (const InversionOptions& options : { InversionOptions(), all_feet() })
  {
    const PointInverter inverter(model_of(point), options);
    for (const Vector3& query : { Vector3(1, 2, 3), Vector3(1, 2, 5), Vector3(0, 0, 0) })
    {
      const std::vector<Foot> feet = inverter.find_all(query);
      ASSERT_EQ(feet.size(), 1u);
      EXPECT_EQ(feet[0].status, options.all_feet ? Status::Converged : Status::Certified);
      EXPECT_EQ(feet[0].type, FootType::Degenerate);
      EXPECT_EQ(feet[0].point, Vector3(1, 2, 3));
      EXPECT_NEAR(feet[0].distance, (query - Vector3(1, 2, 3)).norm(), 1e-15);
      EXPECT_TRUE(feet[0].parameter.allFinite());
      EXPECT_EQ(feet[0].signed_distance, feet[0].distance);
    }
  }
}

TEST(HardCaseS13, ModelWithoutGeometry)
{
  for (const Model& model : { Model(), Model{ Face{} } })
  {
    const PointInverter inverter(model);
    EXPECT_EQ(inverter.size(), 0.0);
    EXPECT_EQ(inverter.find({ 1, 2, 3 }).status, Status::BeyondMaximumDistance);
    EXPECT_TRUE(inverter.find_all({ 1, 2, 3 }).empty());
  }
}
