// SPDX-License-Identifier: BSD-3-Clause

// The table of hard cases, curves: C1 to C9 and the curves of S13, each with its closed form.

#include "Inversion.h"

using namespace inversion;

namespace
{

const double kNaN = NAN;

Parameter<2> at(double t)
{
  return { t, 0.0 };
}

} // namespace

TEST(HardCaseC1, QuarticMinimumOfTheParabola)
{
  const PointInverter inverter(model_of(shapes::parabola()));
  Expected expected{ 0.5, at(0.0) };
  // The gradient is 4t³, and its rounding of 1e-16 hides t below 3e-6.
  expected.parameter_tolerance = 1e-6;
  expect_foot(inverter, { 0, 0.5, 0 }, expected);
  // Off the plane the minimum is as flat.
  expected.distance = std::hypot(0.5, 0.25);
  expect_foot(inverter, { 0, 0.5, 0.25 }, expected);
  expect_all(
    PointInverter(model_of(shapes::parabola()), all_feet()), { 0, 0.5, 0.25 }, { expected });
  expect_foot(
    PointInverter(model_of(shapes::parabola()), orthogonal_only()), { 0, 0.5, 0.25 }, expected);
}

TEST(HardCaseC2, TwoFeetOfTheParabolaTie)
{
  const PointInverter inverter(model_of(shapes::parabola()));
  const PointInverter every(model_of(shapes::parabola()), all_feet());
  for (const double h : { 0.5 + 1e-6, 0.51, 0.75, 1.0, 1.25 })
  {
    const double t = std::sqrt(h - 0.5);
    Expected low{ std::sqrt(h - 0.25), at(-t), FootType::Interior, true, { -t, h - 0.5, 0 } };
    Expected high{ std::sqrt(h - 0.25), at(t), FootType::Interior, true, { t, h - 0.5, 0 } };
    // r is orthogonal to the curve to rounding; t follows from that by the curvature of E, 4t².
    low.tolerance = high.tolerance = low.parameter_tolerance = high.parameter_tolerance =
      std::max(1e-12, 1e-15 / (t * t));
    expect_foot(inverter, { 0, h, 0 }, low);
    expect_all(every, { 0, h, 0 }, { low, high });
  }
}

TEST(HardCaseC3, KinkOfThePolyline)
{
  const PointInverter inverter(model_of(shapes::tent()));
  expect_foot(inverter, { 1, 2, 0 }, { 1.0, at(1.0), FootType::Kink, true, { 1, 1, 0 } });
  // The kink stays the foot until one of the legs is met at a right angle.
  expect_foot(inverter, { 1.5, 1.5 + 1e-9, 0 },
    { std::hypot(0.5, 0.5 + 1e-9), at(1.0), FootType::Kink, true, { 1, 1, 0 } });
  expect_foot(inverter, { 1.5, 1.5 - 0.2, 0 },
    { 0.8 * std::sqrt(0.5), at(1.1), FootType::Interior, true, { 1.1, 0.9, 0 } });
  // Inside the angle both legs are met, and the kink is no foot.
  expect_all(PointInverter(model_of(shapes::tent()), all_feet()), { 1, 0, 0 },
    { { std::sqrt(0.5), at(0.5) }, { std::sqrt(0.5), at(1.5) } });
  // On the kink.
  expect_foot(inverter, { 1, 1, 0 }, { 0.0, at(1.0), FootType::Interior, true, { 1, 1, 0 } });
}

TEST(HardCaseC3, NoFootIsOrthogonalAtAKink)
{
  const PointInverter inverter(model_of(shapes::tent()), orthogonal_only());
  expect_foot(inverter, { 1, 2, 0 },
    { 1.0, at(1.0), FootType::Kink, true, { 1, 1, 0 }, Status::NoOrthogonalFoot });
  expect_foot(inverter, { 0.5, 1, 0 }, { std::sqrt(0.125), at(0.75) });
}

TEST(HardCaseC4, SeamThatIsACorner)
{
  const PointInverter inverter(model_of(shapes::closed_with_corner()));
  expect_foot(inverter, { 0, -1, 0 }, { 1.0, at(0.0), FootType::Kink, true, { 0, 0, 0 } });
  expect_foot(
    inverter, { 0.1, -1, 0 }, { std::sqrt(1.01), at(0.0), FootType::Kink, true, { 0, 0, 0 } });
  expect_foot(
    inverter, { -0.1, -1, 0 }, { std::sqrt(1.01), at(0.0), FootType::Kink, true, { 0, 0, 0 } });
  expect_all(PointInverter(model_of(shapes::closed_with_corner()), all_feet()), { 0, -1, 0 },
    { { 1.0, at(0.0), FootType::Kink } });
  expect_foot(PointInverter(model_of(shapes::closed_with_corner()), orthogonal_only()),
    { 0, -1, 0 }, { 3.25, at(0.5), FootType::Interior, true, { 0, 2.25, 0 } });
}

TEST(HardCaseC5, StalledParameter)
{
  const PointInverter inverter(model_of(shapes::stalled_line()));
  expect_foot(
    inverter, { 0.001, 1, 0 }, { 1.0, at(0.1), FootType::Interior, true, { 0.001, 0, 0 } });
  // At the stalled end itself, and beyond it.
  Expected end{ 1.0, at(0.0), FootType::Degenerate, true, { 0, 0, 0 } };
  expect_foot(inverter, { 0, 1, 0 }, end);
  expect_foot(inverter, { -1, 0, 0 }, end);
  // A start at the stalled point.
  InversionOptions local;
  local.search = footpoint::Search::Local;
  const PointInverter from_there(model_of(shapes::stalled_line()), local);
  expect_foot(from_there, from_there.find({ 0.001, 1, 0 }, { 0, at(0.0) }),
    { 1.0, at(0.1), FootType::Interior, true, { 0.001, 0, 0 } }, "started at the stalled point");
}

TEST(HardCaseC6, PointsOnTheCircle)
{
  const footpoint::Curve circle = shapes::circle();
  const PointInverter inverter(model_of(circle));
  for (int k = 0; k <= 100; ++k)
  {
    const double t = 3.6 * k;
    const Vector3 query = circle.centre() + circle.point(Parameter<1>(t));
    const Foot foot = inverter.find(query);
    EXPECT_LE(foot.distance, 1e-12) << k;
    EXPECT_NEAR(query.norm(), 10.0, 1e-14);
    EXPECT_NEAR(foot.parameter(0), k == 100 ? 0.0 : t, 360.0 * 1e-10) << k;
    EXPECT_EQ(foot.status, Status::Certified);
    EXPECT_EQ(foot.type, FootType::Interior);
    EXPECT_TRUE(foot.isolated);
  }
  // Off the seam, on both sides of it.
  for (const double y : { -1e-3, -1e-13, 0.0, 1e-13, 1e-3 })
  {
    const double distance = std::hypot(12.0, y) - 10.0;
    const Foot foot = inverter.find({ 12.0, y, 0 });
    EXPECT_NEAR(foot.distance, distance, 1e-12);
    EXPECT_EQ(foot.type, FootType::Interior);
    EXPECT_NEAR(foot.point.y(), 10.0 * y / std::hypot(12.0, y), 1e-11);
  }
}

TEST(HardCaseC7, CentreOfTheCircle)
{
  const PointInverter inverter(model_of(shapes::circle()));
  const Foot foot = inverter.find({ 0, 0, 0 });
  expect_foot(inverter, { 0, 0, 0 }, { 10.0, { kNaN, 0.0 }, FootType::Interior, false });
  expect_foot(
    inverter, { 0, 0, 5 }, { std::hypot(10.0, 5.0), { kNaN, 0.0 }, FootType::Interior, false });
  EXPECT_EQ(foot.parameter, PointInverter(model_of(shapes::circle())).find({ 0, 0, 0 }).parameter);
  EXPECT_NEAR(foot.point.norm(), 10.0, 1e-12);
}

TEST(HardCaseC8, TheTwoSidesOfAGap)
{
  const PointInverter inverter(model_of(shapes::line_with_gap()));
  expect_foot(inverter, { 1, 0.9, 0 }, { 0.1, at(1.0), FootType::Vertex, true, { 1, 1, 0 } });
  expect_foot(inverter, { 1, 0.1, 0 }, { 0.1, at(1.0), FootType::Vertex, true, { 1, 0, 0 } });
  expect_foot(inverter, { 0.5, 0.9, 0 },
    { std::hypot(0.5, 0.1), at(1.0), FootType::Vertex, true, { 1, 1, 0 } });
  expect_foot(inverter, { 1.5, 0.1, 0 },
    { std::hypot(0.5, 0.1), at(1.0), FootType::Vertex, true, { 1, 0, 0 } });
  expect_foot(
    inverter, { 0.5, -0.1, 0 }, { 0.1, at(0.5), FootType::Interior, true, { 0.5, 0, 0 } });
  // Both sides are feet of their own though they share the parameter.
  expect_all(PointInverter(model_of(shapes::line_with_gap()), all_feet()), { 1, 0.25, 0 },
    { { 0.25, at(1.0), FootType::Vertex, true, { 1, 0, 0 } },
      { 0.75, at(1.0), FootType::Vertex, true, { 1, 1, 0 } } });
}

TEST(HardCaseC9, ClosureIsFoundByEvaluating)
{
  // Stored unclamped, closed and smooth: nothing is special about the seam.
  const footpoint::Curve periodic = shapes::periodic();
  const PointInverter inverter(model_of(periodic));
  const Vector3 seam = periodic.centre() + periodic.point(Parameter<1>(0.0));
  expect_foot(inverter, 2.0 * seam, { seam.norm(), at(0.0), FootType::Interior, true, seam });
  for (const double t : { 0.01, 7.99 })
  {
    const Vector3 point = periodic.centre() + periodic.point(Parameter<1>(t));
    const footpoint::Jet<1> jet =
      periodic.jet(Parameter<1>(t), footpoint::Sides<1>(footpoint::Side::Right), 1);
    const Vector3 normal = Vector3(jet.first.col(0)).cross(Vector3::UnitZ()).normalized();
    expect_foot(inverter, point + 0.5 * normal, { 0.5, at(t), FootType::Interior, true, point });
    expect_foot(inverter, point - 0.5 * normal, { 0.5, at(t), FootType::Interior, true, point });
  }
  // Matching end poles, but open: (0.5, 0) and (0, 0.5) are ends, and tie.
  const PointInverter open(model_of(shapes::open_with_matching_poles()), all_feet());
  const double distance = std::hypot(0.4, 0.1);
  const Expected start{ distance, at(0.0), FootType::Vertex, true, { 0.5, 0, 0 } };
  const Expected end{ distance, at(3.0), FootType::Vertex, true, { 0, 0.5, 0 } };
  expect_foot(open, { 0.1, 0.1, 0 }, start);
  expect_all(open, { 0.1, 0.1, 0 }, { start, end });
}

TEST(HardCaseS13, BadQueriesToACurve)
{
  for (const InversionOptions& options :
    { InversionOptions(), all_feet(), orthogonal_only(), along({ 1, 0, 0 }) })
  {
    const PointInverter inverter(model_of(shapes::circle()), options);
    footpoint::Points points(3, 5);
    points << kNaN, 1, 1, 20, INFINITY, //
      0, INFINITY, 2, 0, INFINITY,      //
      0, 0, kNaN, 0, -INFINITY;
    const footpoint::InversionResult result = footpoint::invert(inverter, points);
    ASSERT_EQ(result.feet.size(), 5u);
    for (const int k : { 0, 1, 2, 4 })
    {
      EXPECT_EQ(result.feet[k].status, Status::InvalidPoint) << k;
      EXPECT_TRUE(std::isnan(result.feet[k].distance));
      EXPECT_TRUE(result.feet[k].parameter.array().isNaN().all());
      EXPECT_EQ(result.feet[k].face, -1);
      EXPECT_TRUE(inverter.find_all(points.col(k)).empty());
    }
    EXPECT_LE(result.feet[3].status, Status::Converged);
    EXPECT_NEAR(result.feet[3].distance, 10.0, 1e-11);
    EXPECT_TRUE(footpoint::invert(inverter, footpoint::Points(3, 0)).feet.empty());
  }
}

TEST(HardCaseS13, CurveThatIsAPoint)
{
  for (const int degree : { 1, 3 })
  {
    const footpoint::Points poles = Vector3(1, 2, 3).replicate(1, degree + 1);
    const footpoint::Curve point =
      shapes::polynomial_curve(degree, shapes::clamped_knots(degree, 1), poles);
    const PointInverter inverter(model_of(point));
    for (const Vector3& query : { Vector3(1, 2, 3), Vector3(1, 2, 5), Vector3(0, 0, 0) })
    {
      const Foot foot = inverter.find(query);
      EXPECT_EQ(foot.status, Status::Certified);
      EXPECT_EQ(foot.type, FootType::Degenerate);
      EXPECT_EQ(foot.point, Vector3(1, 2, 3));
      EXPECT_NEAR(foot.distance, (query - Vector3(1, 2, 3)).norm(), 1e-15);
      EXPECT_GE(foot.parameter(0), 0.0);
      EXPECT_LE(foot.parameter(0), 1.0);
      EXPECT_EQ(PointInverter(model_of(point), all_feet()).find_all(query).size(), 1u);
    }
  }
}
