// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/grids/gordon_surface.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace footpoint;

namespace
{

/// A bicubic polynomial surface in Bernstein form, so that its isoparametric curves are cubics.
Vector3 height(double u, double v)
{
  return { 2.0 * u + 0.2 * v * v, 1.5 * v - 0.1 * u * u * u,
    u * u * v - 0.5 * v * v * v * u + 0.3 * u };
}

/// The cubic through four points at 0, 1/3, 2/3, 1.
Curve cubic(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d, bool reversed)
{
  Points points(3, 4);
  points.col(0) = a;
  points.col(1) = (-5.0 * a + 18.0 * b - 9.0 * c + 2.0 * d) / 6.0;
  points.col(2) = (2.0 * a - 9.0 * b + 18.0 * c - 5.0 * d) / 6.0;
  points.col(3) = d;
  if (reversed)
  {
    points = points.rowwise().reverse().eval();
  }
  return Curve(KnotVector(3, { 0, 0, 0, 0, 1, 1, 1, 1 }), points);
}

Curve profile(double v, bool reversed = false)
{
  return cubic(height(0, v), height(1 / 3., v), height(2 / 3., v), height(1, v), reversed);
}

Curve guide(double u, bool reversed = false)
{
  return cubic(height(u, 0), height(u, 1 / 3.), height(u, 2 / 3.), height(u, 1), reversed);
}

Vector3 at(const Surface& surface, double u, double v)
{
  return surface.centre() + surface.point(Parameter<2>(u, v));
}

} // namespace

TEST(GordonSurface, ReproducesABicubicFromShuffledAndReversedCurves)
{
  const std::vector<Curve> profiles{ profile(0.4), profile(1.0, true), profile(0.0),
    profile(0.7, true) };
  const std::vector<Curve> guides{ guide(0.0), guide(1.0), guide(0.25, true), guide(0.6) };
  const GordonResult result = gordon_surface(profiles, guides);
  EXPECT_EQ(result.network.profile_order, (std::vector<int>{ 2, 0, 3, 1 }));
  EXPECT_EQ(result.network.guide_order, (std::vector<int>{ 0, 2, 3, 1 }));
  EXPECT_EQ(result.network.profile_reversed, (std::vector<bool>{ false, false, true, true }));
  EXPECT_EQ(result.network.reparametrization_error, 0.0);
  EXPECT_LE(result.network.largest_gap, 1e-14);
  for (int i = 0; i <= 20; ++i)
  {
    for (int j = 0; j <= 20; ++j)
    {
      const double u = i / 20.0;
      const double v = j / 20.0;
      ASSERT_LE((at(result.surface, u, v) - height(u, v)).norm(), 1e-12) << u << ", " << v;
    }
  }
}

TEST(GordonSurface, GapNamesTheCurvesAndTheDistance)
{
  Curve far = profile(0.5);
  const Points moved =
    (far.local_control_points().colwise() + far.centre()).colwise() + Vector3(0, 0, 3);
  const std::vector<Curve> profiles{ profile(0.0), Curve(far.knots(), moved), profile(1.0) };
  try
  {
    gordon_surface(profiles, { guide(0.0), guide(1.0) });
    FAIL() << "a curve three units above the network was accepted";
  }
  catch (const BoundaryError& error)
  {
    EXPECT_EQ(error.defect(), BoundaryDefect::Gap);
    EXPECT_NE(std::string(error.what()).find("profile 1 and guide 0"), std::string::npos)
      << error.what();
  }
}

TEST(GordonSurface, DifferingParametersAreRefusedOrReparametrizedOnRequest)
{
  // The middle profile runs unevenly: t² in place of t along a straight line.
  auto line = [](const Vector3& a, const Vector3& b)
  {
    Points points(3, 2);
    points << a, b;
    return Curve(KnotVector(1, { 0, 0, 1, 1 }), points);
  };
  auto uneven = [](const Vector3& a, const Vector3& b)
  {
    Points points(3, 3);
    points << a, a + 0.2 * (b - a), b;
    return Curve(KnotVector(2, { 0, 0, 0, 1, 1, 1 }), points);
  };
  const std::vector<Curve> profiles{ line({ 0, 0, 0 }, { 1, 0, 0 }),
    uneven({ 0, 0.5, 0 }, { 1, 0.5, 0 }), line({ 0, 1, 0 }, { 1, 1, 0 }) };
  const std::vector<Curve> guides{ line({ 0, 0, 0 }, { 0, 1, 0 }),
    line({ 0.5, 0, 0 }, { 0.5, 1, 0 }), line({ 1, 0, 0 }, { 1, 1, 0 }) };
  EXPECT_THROW(gordon_surface(profiles, guides), BoundaryError);
  GordonOptions options;
  options.reparametrize = true;
  const GordonResult result = gordon_surface(profiles, guides, options);
  EXPECT_GT(result.network.reparametrization_error, 0.0);
  EXPECT_LE(result.network.reparametrization_error, 1e-4);
  for (int i = 0; i <= 10; ++i)
  {
    for (int j = 0; j <= 10; ++j)
    {
      EXPECT_NEAR(at(result.surface, i / 10.0, j / 10.0).z(), 0.0, 1e-12);
    }
  }
  // The network's curves lie on the surface.
  const double u = result.network.parameters_u[1];
  EXPECT_NEAR(at(result.surface, u, 0.3).x(), 0.5, 1e-9);
}

TEST(GordonSurface, TooFewCurvesAreRefused)
{
  EXPECT_THROW(gordon_surface({ profile(0.0) }, { guide(0.0), guide(1.0) }), BoundaryError);
}
