// SPDX-License-Identifier: BSD-3-Clause
// Hull and wing against their formulas, the teapot against its published control points.
#include "ShapeChecks.h"

#include "footpoint/splines/bezier.h"

#include <gtest/gtest.h>

using namespace shape_checks;

TEST(FreeFormShapes, HullIsWigleys)
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

TEST(FreeFormShapes, WingHasTheSectionsOfTheReport)
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

TEST(FreeFormShapes, WingIsSmoothAtNoseAndCrest)
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

TEST(FreeFormShapes, TeapotHasNewellsPatches)
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

TEST(FreeFormShapes, TeapotNormalsPointOutwards)
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
