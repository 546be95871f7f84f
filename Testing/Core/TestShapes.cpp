// SPDX-License-Identifier: BSD-3-Clause
// Shapes against the formulas that define them.
#include "footpoint/shapes/shapes.h"
#include "footpoint/splines/bezier.h"

#include <gtest/gtest.h>

#include <cmath>

using footpoint::Curve;
using footpoint::Parameter;
using footpoint::Shape;
using footpoint::ShapeError;
using footpoint::Side;
using footpoint::Sides;
using footpoint::Surface;
using footpoint::Vector3;

namespace
{

constexpr double kPi = 3.14159265358979323846;

/// A point in space at parameters of the domain.
Vector3 at(const Surface& surface, double u, double v)
{
  return surface.point(surface.to_local({ u, v })) + surface.centre();
}

Vector3 at(const Curve& curve, double u)
{
  return curve.point(curve.to_local(Parameter<1>(u))) + curve.centre();
}

/// Calls check(u, v, point, S_u × S_v) on a grid over the domain, borders included.
template <class Check>
void for_points(const Surface& surface, const Check& check)
{
  constexpr int kSteps = 40;
  const footpoint::KnotVector& ku = surface.knots(0);
  const footpoint::KnotVector& kv = surface.knots(1);
  for (int i = 0; i <= kSteps; ++i)
  {
    for (int j = 0; j <= kSteps; ++j)
    {
      const Parameter<2> local(ku.length() * i / kSteps, kv.length() * j / kSteps);
      const auto jet = surface.jet(local, Sides<2>::Constant(Side::Right), 1);
      check(ku.domain_start() + local[0], kv.domain_start() + local[1],
        Vector3(jet.point + surface.centre()), Vector3(jet.first.col(0).cross(jet.first.col(1))));
    }
  }
}

/// Volume inside closed faces with outward normals, by the divergence theorem, with Gauss's rule of
/// 5 points on parts of the knot spans.
double volume(const Shape& shape)
{
  constexpr double kNodes[] = { 0.0, 0.5384693101056831, -0.5384693101056831, 0.9061798459386640,
    -0.9061798459386640 };
  constexpr double kWeights[] = { 0.5688888888888889, 0.4786286704993665, 0.4786286704993665,
    0.2369268850561891, 0.2369268850561891 };
  constexpr int kParts = 8;
  double sum = 0.0;
  for (const auto& face : shape)
  {
    const Surface& surface = face.surface;
    const auto& u = surface.direction(0).spans;
    const auto& v = surface.direction(1).spans;
    for (std::size_t i = 0; i + 1 < u.size(); ++i)
    {
      for (std::size_t j = 0; j + 1 < v.size(); ++j)
      {
        const double hu = 0.5 * (u[i + 1] - u[i]) / kParts;
        const double hv = 0.5 * (v[j + 1] - v[j]) / kParts;
        for (int part = 0; part < kParts * kParts; ++part)
        {
          for (int g = 0; g < 25; ++g)
          {
            const Parameter<2> t(u[i] + hu * (2 * (part % kParts) + 1 + kNodes[g % 5]),
              v[j] + hv * (2 * (part / kParts) + 1 + kNodes[g / 5]));
            const auto jet = surface.jet(t, Sides<2>::Constant(Side::Right), 1);
            const Vector3 normal = jet.first.col(0).cross(jet.first.col(1));
            sum += kWeights[g % 5] * kWeights[g / 5] * hu * hv *
              (jet.point + surface.centre()).dot(normal) / 3.0;
          }
        }
      }
    }
  }
  return sum;
}

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

TEST(Shapes, HullIsWigleys)
{
  const double length = 10.0;
  const double beam = 1.0;
  const double draft = 0.625;
  const Shape hull = footpoint::ship_hull(length, beam, draft, true);
  for (const int sign : { 1, -1 })
  {
    for_points(hull[sign > 0 ? 0 : 1].surface,
      [&](double u, double v, const Vector3& p, const Vector3& normal)
      {
        EXPECT_NEAR(p[0], -sign * 0.5 * length * u, 1e-14);
        EXPECT_NEAR(p[2], draft * v, 1e-15);
        const double y =
          0.5 * beam * (1.0 - std::pow(2.0 * p[0] / length, 2)) * (1.0 - std::pow(p[2] / draft, 2));
        EXPECT_NEAR(p[1], sign * y, 1e-15);
        EXPECT_GE(sign * normal[1], 0.0);
      });
  }
  EXPECT_NEAR(volume(hull), 4.0 / 9.0 * length * beam * draft, 1e-12);
}

TEST(Shapes, WingHasTheSectionsOfTheReport)
{
  for (const char* digits : { "2412", "0012", "4415", "9999", "1101", "6921" })
  {
    for (const bool blunt : { false, true })
    {
      footpoint::WingOptions options;
      options.airfoil_digits = digits;
      options.blunt_trailing_edge = blunt;
      options.chord = 2.0;
      options.capping = true;
      const double m = (digits[0] - '0') / 100.0;
      const double p = (digits[1] - '0') / 10.0;
      const double t = std::stoi(digits + 2) / 100.0;
      const Shape wing = footpoint::wing(options);
      const double sweep = std::tan(15.0 * kPi / 180.0);
      for_points(wing[0].surface,
        [&](double u, double v, const Vector3& point, const Vector3&)
        {
          const double chord = 2.0 * (1.0 - 0.5 * std::abs(v));
          EXPECT_NEAR(point[1], 3.0 * v, 6e-15); // 1e-15 of the size
          EXPECT_NEAR(point[0], sweep * 3.0 * std::abs(v) + chord * u * u, 1e-14);
          const double x = u * u;
          const double half = 5.0 * t *
            (0.2969 * std::sqrt(x) - 0.126 * x - 0.3516 * x * x + 0.2843 * x * x * x -
              (blunt ? 0.1015 : 0.1036) * x * x * x * x);
          double camber = 0.0;
          if (m > 0.0)
          {
            camber = x <= p ? m / (p * p) * (2.0 * p * x - x * x)
                            : m / ((1 - p) * (1 - p)) * (1.0 - 2.0 * p + 2.0 * p * x - x * x);
          }
          EXPECT_NEAR(
            point[2], chord * (camber + (u < 0.0 ? -half : half)), 1e-14 * (1.0 + 20.0 * m));
        });
      const double area = 10.0 * t *
        (0.2969 * 2.0 / 3.0 - 0.126 / 2.0 - 0.3516 / 3.0 + 0.2843 / 4.0 -
          (blunt ? 0.1015 : 0.1036) / 5.0);
      EXPECT_NEAR(volume(wing), area * 6.0 * 4.0 * (1.0 + 0.5 + 0.25) / 3.0, 1e-12);
      EXPECT_EQ(wing.size(), blunt ? 4u : 3u);
      if (!blunt)
      {
        EXPECT_EQ(at(wing[0].surface, -1.0, 0.4), at(wing[0].surface, 1.0, 0.4));
      }
    }
  }
}

TEST(Shapes, WingIsSmoothAtNoseAndCrest)
{
  const Shape wing = footpoint::wing({});
  const Surface& surface = wing[0].surface;
  for (const double s : { -std::sqrt(0.4), 0.0, std::sqrt(0.4) })
  {
    const Parameter<2> t = surface.to_local({ s, 0.5 });
    Sides<2> sides = Sides<2>::Constant(Side::Left);
    const Vector3 left = surface.jet(t, sides, 1).first.col(0);
    sides[0] = Side::Right;
    const Vector3 right = surface.jet(t, sides, 1).first.col(0);
    EXPECT_LE((left - right).norm(), 1e-13);
  }
  EXPECT_EQ(surface.direction(0).breaks.size(), 2u);
  // Without taper and sweep there is no kink at the root either.
  footpoint::WingOptions straight;
  straight.taper_ratio = 1.0;
  straight.sweep_angle = 0.0;
  EXPECT_EQ(footpoint::wing(straight)[0].surface.knots(1).number_of_control_points(), 2);
}

TEST(Shapes, TeapotHasNewellsPatches)
{
  // Ten patches as they are published; the others are their mirror images.
  const double r[] = { 1.5, 1.75, 2.0, 2.0 };
  const double z[] = { 2.4, 1.875, 1.35, 0.9 };
  const double k[] = { 0.84, 0.98, 1.12, 1.12 };
  const Shape teapot = footpoint::teapot();
  ASSERT_EQ(teapot.size(), 4u);
  const auto pieces = [&](int part) { return footpoint::extract_bezier(teapot[part].surface); };
  const auto point = [&](int part, const auto& piece, int i, int j)
  {
    return Vector3(piece.control.col(i + 4 * j).template head<3>() + teapot[part].surface.centre());
  };
  ASSERT_EQ(pieces(0).size(), 16u);
  ASSERT_EQ(pieces(1).size(), 8u);
  ASSERT_EQ(pieces(2).size(), 4u);
  ASSERT_EQ(pieces(3).size(), 4u);

  // === Upper body: the first quarter of the third row, downwards
  const auto body = pieces(0)[8];
  for (int row = 0; row < 4; ++row)
  {
    const int j = 3 - row;
    EXPECT_LE((point(0, body, 0, j) - Vector3(r[row], 0, z[row])).norm(), 1e-15);
    EXPECT_LE((point(0, body, 1, j) - Vector3(r[row], k[row], z[row])).norm(), 1e-15);
    EXPECT_LE((point(0, body, 2, j) - Vector3(k[row], r[row], z[row])).norm(), 1e-15);
    EXPECT_LE((point(0, body, 3, j) - Vector3(0, r[row], z[row])).norm(), 1e-15);
  }
  // === Where patches meet, which our nets leave out
  EXPECT_LE((point(0, pieces(0)[12], 0, 0) - Vector3(1.5, 0, 2.4)).norm(), 1e-15);     // rim
  EXPECT_LE((point(0, pieces(0)[12], 0, 3) - Vector3(1.4, 0, 2.4)).norm(), 1e-15);     // rim
  EXPECT_LE((point(0, pieces(0)[6], 0, 0) - Vector3(-1.5, 0, 0.15)).norm(), 1e-15);    // lower body
  EXPECT_LE((point(0, pieces(0)[3], 2, 1) - Vector3(1.425, -0.798, 0)).norm(), 1e-15); // bottom
  EXPECT_LE((point(1, pieces(1)[4], 0, 0) - Vector3(0.2, 0, 2.7)).norm(), 1e-15);      // knob
  EXPECT_LE((point(1, pieces(1)[4], 1, 2) - Vector3(0.8, 0.45, 3.15)).norm(), 1e-15);
  EXPECT_LE((point(1, pieces(1)[0], 0, 0) - Vector3(1.3, 0, 2.4)).norm(), 1e-15);
  EXPECT_LE((point(2, pieces(2)[0], 0, 3) - Vector3(-2.7, 0, 1.8)).norm(), 1e-15); // handle
  EXPECT_LE((point(2, pieces(2)[0], 1, 3) - Vector3(-2.7, -0.3, 1.8)).norm(), 1e-15);
  EXPECT_LE((point(2, pieces(2)[0], 3, 3) - Vector3(-3, 0, 1.8)).norm(), 1e-15);
  EXPECT_LE((point(2, pieces(2)[3], 0, 3) - Vector3(-1.9, 0, 0.6)).norm(), 1e-15);
  EXPECT_LE((point(3, pieces(3)[0], 0, 3) - Vector3(2.7, 0, 2.4)).norm(), 1e-15); // spout
  EXPECT_LE((point(3, pieces(3)[0], 3, 3) - Vector3(3.3, 0, 2.4)).norm(), 1e-15);
  EXPECT_LE((point(3, pieces(3)[2], 2, 1) - Vector3(3.525, -0.25, 2.49375)).norm(), 1e-15);
}

TEST(Shapes, TeapotNormalsPointOutwards)
{
  const Shape teapot = footpoint::teapot();
  // The body is open at the rim alone: a lid at its height adds that part of the flux.
  const double flux = volume({ teapot[0] });
  EXPECT_GT(flux, 10.0);
  EXPECT_GT(volume({ teapot[1] }), 0.0);
  for (int part : { 2, 3 }) // tubes: away from their middle line
  {
    const Surface& tube = teapot[part].surface;
    const double end = part == 2 ? 2.0 : 1.0; // the last patches of the spout are its lip
    for (double v = 0.05 * end; v < end; v += 0.1 * end)
    {
      const Vector3 inside = 0.5 * (at(tube, 0.0, v) + at(tube, 1.0, v));
      for (const double u : { 0.25, 0.75, 1.25, 1.75 })
      {
        const Parameter<2> t = tube.to_local({ u, v });
        const auto jet = tube.jet(t, Sides<2>::Constant(Side::Right), 1);
        const Vector3 normal = jet.first.col(0).cross(jet.first.col(1));
        EXPECT_GT(normal.dot(jet.point + tube.centre() - inside), 0.0)
          << part << " " << u << " " << v;
      }
    }
  }
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
