// SPDX-License-Identifier: BSD-3-Clause
// Shapes against the formulas that define them; bumps, refusals.
#include "ShapeChecks.h"

#include <gtest/gtest.h>

using namespace shape_checks;
using footpoint::ShapeError;

namespace
{

template <class Make>
std::string refusal(const Make& make)
{
  try
  {
    make();
  }
  catch (const ShapeError& error)
  {
    return error.what();
  }
  return "";
}

} // namespace

TEST(Shapes, SphereHasItsRadius)
{
  for (const double radius : { 1.0, 2.7, 1e-9, 3e12 })
  {
    const Shape sphere = footpoint::sphere(radius);
    for_points(sphere[0].surface,
      [&](double, double, const Vector3& point, const Vector3& normal)
      {
        EXPECT_NEAR(point.norm() / radius, 1.0, 1e-15);
        EXPECT_GE(normal.dot(point), 0.0);
      });
    const double rounding = 1e-15 * radius;
    EXPECT_LE((at(sphere[0].surface, 0.3, 0.0) - Vector3(0, 0, -radius)).norm(), rounding);
    EXPECT_LE((at(sphere[0].surface, 0.7, 1.0) - Vector3(0, 0, radius)).norm(), rounding);
    EXPECT_NEAR(volume(sphere) / (4.0 / 3.0 * kPi * std::pow(radius, 3)), 1.0, 1e-9);
  }
}

TEST(Shapes, TorusHasItsRadii)
{
  const Shape torus = footpoint::torus(3.0, 0.7);
  for_points(torus[0].surface,
    [&](double, double, const Vector3& point, const Vector3&)
    { EXPECT_NEAR(std::hypot(std::hypot(point[0], point[1]) - 3.0, point[2]), 0.7, 2e-15); });
  EXPECT_NEAR(volume(torus), 2.0 * kPi * kPi * 3.0 * 0.49, 1e-8);
}

TEST(Shapes, CylinderAndConeKeepTheirEquations)
{
  const Shape cylinder = footpoint::cylinder(2.0, 5.0, true);
  for_points(cylinder[0].surface,
    [&](double, double v, const Vector3& point, const Vector3& normal)
    {
      EXPECT_NEAR(point.head<2>().norm(), 2.0, 2e-15);
      EXPECT_NEAR(point[2], 5.0 * (v - 0.5), 1e-15);
      EXPECT_GT(normal.dot(Vector3(point[0], point[1], 0.0)), 0.0);
    });
  EXPECT_NEAR(volume(cylinder), kPi * 4.0 * 5.0, 1e-8);
  EXPECT_EQ(footpoint::cylinder(2.0, 5.0, false).size(), 1u);

  const Shape cone = footpoint::cone(2.0, 5.0, true);
  for_points(cone[0].surface,
    [&](double, double v, const Vector3& point, const Vector3&)
    {
      EXPECT_NEAR(point.head<2>().norm(), 2.0 * (0.5 - point[2] / 5.0), 2e-15);
      EXPECT_NEAR(point[2], 5.0 * (v - 0.5), 1e-15);
    });
  EXPECT_NEAR(volume(cone), kPi * 4.0 * 5.0 / 3.0, 1e-8);
  EXPECT_EQ(at(cone[0].surface, 0.2, 1.0), Vector3(0, 0, 2.5));
}

TEST(Shapes, CircleHasItsRadiusCurvatureAndLength)
{
  const Curve circle = footpoint::circle(2.5);
  double length = 0.0;
  constexpr int kSteps = 4000;
  for (int i = 0; i <= kSteps; ++i)
  {
    const Parameter<1> t(static_cast<double>(i) / kSteps);
    const auto jet = circle.jet(t, Sides<1>::Constant(Side::Right), 2);
    const Vector3 tangent = jet.first.col(0);
    const double curvature =
      tangent.cross(Vector3(jet.second.col(0))).norm() / std::pow(tangent.norm(), 3);
    EXPECT_NEAR((jet.point + circle.centre()).norm(), 2.5, 1e-15 * 2.5);
    EXPECT_NEAR(curvature, 0.4, 1e-14);
    if (i < kSteps)
    {
      const Parameter<1> middle((i + 0.5) / kSteps);
      length += circle.jet(middle, Sides<1>::Constant(Side::Right), 1).first.norm() / kSteps;
    }
  }
  EXPECT_NEAR(length, 2.0 * kPi * 2.5, 1e-6); // of the midpoint rule
  EXPECT_EQ(at(circle, 0.0), Vector3(2.5, 0, 0));
  EXPECT_EQ(at(circle, 1.0), Vector3(2.5, 0, 0));
}

TEST(Shapes, HelixIsAsNearAsPromised)
{
  for (const double tolerance : { 1e-10, 1e-6, 1e-2, 1.0 })
  {
    for (const double turns : { 0.1, 1.0, 3.25 })
    {
      for (const double height : { 0.01, 4.0, 300.0 })
      {
        const double radius = 2.0;
        const Curve helix = footpoint::helix(radius, height, turns, tolerance);
        const double angle = 2.0 * kPi * turns;
        const double rise = height / angle;
        const int arcs = static_cast<int>(helix.knots().distinct_knots().size()) - 1;
        const double promised = footpoint::helix_deviation(rise, 0.5 * angle / arcs);
        EXPECT_LE(promised, tolerance * radius);
        double worst = 0.0;
        for (int i = 0; i <= 64 * arcs; ++i)
        {
          const Vector3 point = at(helix, i / (64.0 * arcs));
          EXPECT_NEAR(point.head<2>().norm(), radius, 4e-15);
          // The arc tells the turn, the position the angle within.
          const double middle = (std::min(i / 64, arcs - 1) + 0.5) * angle / arcs;
          const double within = std::remainder(std::atan2(point[1], point[0]) - middle, 2.0 * kPi);
          worst = std::max(worst, std::abs(point[2] + 0.5 * height - rise * (middle + within)));
        }
        const double rounding = 1e-14 * (height + radius * (1.0 + rise));
        EXPECT_LE(worst, promised + rounding) << tolerance << " " << turns << " " << height;
        EXPECT_GE(worst, 0.98 * promised - rounding) << tolerance << " " << turns << " " << height;
      }
    }
  }
}

TEST(Shapes, HelixIsSmoothAndNeedsFewArcs)
{
  const Curve helix = footpoint::helix(1.0, 2.0, 3.0, 1e-6);
  const auto& knots = helix.knots().distinct_knots();
  EXPECT_LE(knots.size(), 80u);
  for (std::size_t i = 1; i + 1 < knots.size(); ++i)
  {
    const Parameter<1> t(knots[i].at);
    const Vector3 left = helix.jet(t, Sides<1>::Constant(Side::Left), 1).first.col(0);
    const Vector3 right = helix.jet(t, Sides<1>::Constant(Side::Right), 1).first.col(0);
    EXPECT_LE((left - right).norm(), 1e-12 * left.norm());
    // The helix' own slope.
    EXPECT_NEAR(left[2] / left.head<2>().norm(), 2.0 / (6.0 * kPi), 1e-12);
  }
  EXPECT_NEAR((at(helix, 0.0) - Vector3(1, 0, -1)).norm(), 0.0, 1e-15);
  EXPECT_NEAR((at(helix, 1.0) - Vector3(1, 0, 1)).norm(), 0.0, 1e-14);
}

TEST(Shapes, BumpsAreTheSameEverywhere)
{
  // The first words of SplitMix64 for this seed, as published with its reference code.
  const std::uint64_t words[] = { 6457827717110365317u, 3203168211198807973u, 9817491932198370423u,
    4593380528125082431u };
  const Shape patch = footpoint::bumpy_patch(3.0, 0.5, 1, 1234567);
  const Surface& surface = patch[0].surface;
  for (int i = 0; i < 4; ++i)
  {
    const double height = surface.local_control_points()(2, i) + surface.centre()[2];
    EXPECT_NEAR(height, 0.5 * (std::ldexp(double(words[i] >> 11), -52) - 1.0), 1e-16);
  }
  for_points(footpoint::bumpy_patch(3.0, 0.5, 9, 7)[0].surface,
    [](double u, double v, const Vector3& point, const Vector3& normal)
    {
      EXPECT_NEAR(point[0], 3.0 * (u - 0.5), 2e-15);
      EXPECT_NEAR(point[1], 3.0 * (v - 0.5), 2e-15);
      EXPECT_LE(std::abs(point[2]), 0.5);
      EXPECT_GT(normal[2], 0.0);
    });
}

TEST(Shapes, BadDimensionsAreNamed)
{
  EXPECT_EQ(
    refusal([] { footpoint::sphere(0.0); }), "Radius = 0; a positive, finite length is needed");
  EXPECT_EQ(refusal([] { footpoint::circle(std::nan("")); }),
    "Radius = nan; a positive, finite length is needed");
  EXPECT_EQ(refusal([] { footpoint::cone(1.0, -2.5, true); }),
    "Height = -2.5; a positive, finite length is needed");
  EXPECT_EQ(refusal([] { footpoint::torus(1.0, 1.5); }),
    "CrossSectionRadius = 1.5; it must be less than Radius = 1, or the torus cuts itself");
  EXPECT_EQ(refusal([] { footpoint::helix(1.0, 1.0, 0.0, 1e-6); }),
    "Turns = 0; more than 0 and at most 1000 are needed");
  EXPECT_EQ(refusal([] { footpoint::helix(1.0, 1.0, 1.0, 1e-12); }),
    "HelixTolerance = 1e-12; allowed is 1e-10 to 1");
  EXPECT_EQ(refusal([] { footpoint::bumpy_patch(1.0, 1.0, 0, 1); }),
    "Resolution = 0; allowed is 1 to 1000");
  EXPECT_EQ(refusal([] { footpoint::ship_hull(1.0, HUGE_VAL, 1.0, false); }),
    "Beam = inf; a positive, finite length is needed");
  footpoint::WingOptions options;
  for (const auto& [digits, words] :
    std::initializer_list<std::pair<const char*, const char*>>{
      { "24x2", "AirfoilDigits = '24x2'; four digits are needed, as 2412" },
      { "24012", "AirfoilDigits = '24012'; four digits are needed, as 2412" },
      { "2400",
        "AirfoilDigits = '2400'; the last two, the thickness in % of the chord, must not be 00" },
      { "2012",
        "AirfoilDigits = '2012'; with camber (the first) its place (the second) must not be 0" } })
  {
    options.airfoil_digits = digits;
    EXPECT_EQ(refusal([&] { footpoint::wing(options); }), words);
  }
  options.airfoil_digits = "0012";
  options.sweep_angle = 90.0;
  EXPECT_EQ(refusal([&] { footpoint::wing(options); }), "SweepAngle = 90; allowed is -80 to 80");
  options.sweep_angle = 0.0;
  options.taper_ratio = 0.0;
  EXPECT_EQ(refusal([&] { footpoint::wing(options); }), "TaperRatio = 0; allowed is 0.01 to 100");
}
