// SPDX-License-Identifier: BSD-3-Clause
// Tessellation at its limits: scales, geometry that is a point, bad options, cancelling, threads.
#include "InThreads.h"
#include "TessellationChecks.h"

#include "footpoint/tessellation/derivative_bounds.h"

#include <gtest/gtest.h>

using namespace footpoint;
using namespace tessellations;

TEST(Tessellation, PowersOfTwoScaleAllExactly)
{
  for (const Surface& surface : { shapes::sphere(), shapes::cusp(), shapes::bumpy(12, 1) })
  {
    const Tessellation mesh = tessellate(one(surface), chord(1e-3));
    for (const double scale : { 0x1p-400, 0x1p-250, 0x1p250, 0x1p400 })
    {
      const Points points = (surface.local_control_points().colwise() + surface.centre()) * scale;
      const Surface scaled(surface.knots(0), surface.knots(1), points, surface.weights());
      const Tessellation same = tessellate(one(scaled), chord(1e-3));
      EXPECT_EQ(same.triangles, mesh.triangles) << scale;
      EXPECT_TRUE(same.parameters == mesh.parameters) << scale;
      EXPECT_TRUE(same.normals == mesh.normals) << scale;
      EXPECT_TRUE(same.points == mesh.points * scale) << scale;
    }
  }
}

TEST(Tessellation, CurveThatIsAPointOrHasNoFiniteDerivatives)
{
  const std::vector<double> knots{ 0, 0, 1, 1 };
  const Curve point(KnotVector(1, knots, "KnotsU"), Points::Ones(3, 2));
  const Tessellation mesh = tessellate(one(point), chord(1e-3));
  ASSERT_EQ(mesh.lines.size(), 1u);
  EXPECT_EQ(mesh.lines[0].size(), 2u);
  EXPECT_TRUE(mesh.problems.empty());

  Points bent(3, 3);
  bent << 0, 1, 0, 0, 1, 1, 0, 0, 0;
  const double end = 1e-200;
  const Curve steep(KnotVector(2, { 0, 0, 0, end, end, end }, "KnotsU"), bent);
  const Tessellation none = tessellate(one(steep), chord(1e-3));
  ASSERT_EQ(none.problems.size(), 1u);
  EXPECT_NE(none.problems[0].message.find("derivatives"), std::string::npos);
}

TEST(Tessellation, FixedTakesNoNoticeOfTheChordTolerance)
{
  TessellationOptions options;
  options.mode = TessellationMode::Fixed;
  const Tessellation mesh = tessellate(one(shapes::sphere()), options);
  ASSERT_FALSE(mesh.triangles.empty());
  for (const double tolerance : { 0.0, -1.0, 1e9, std::nan("") })
  {
    for (const bool absolute : { false, true })
    {
      options.chord_tolerance = tolerance;
      options.absolute = absolute;
      const Tessellation same = tessellate(one(shapes::sphere()), options);
      EXPECT_EQ(same.triangles, mesh.triangles) << tolerance;
      EXPECT_TRUE(same.problems.empty()) << tolerance;
    }
  }
}

TEST(Tessellation, ScalesAndPlaces)
{
  const Surface torus = shapes::torus();
  const Points net = torus.local_control_points().colwise() + torus.centre();
  const std::size_t expected = tessellate(one(torus), chord(1e-3)).triangles.size();
  for (const double scale : { 1e-9, 1e6, 1e12 })
  {
    const Model model = one(Surface(torus.knots(0), torus.knots(1), scale * net, torus.weights()));
    const Tessellation mesh = tessellate(model, chord(1e-3));
    EXPECT_NEAR(static_cast<double>(mesh.triangles.size()), static_cast<double>(expected),
      0.02 * static_cast<double>(expected));
    EXPECT_EQ(count(model, mesh).open, 0);
  }
  Points far = net;
  far.colwise() += Vector3(1e6, -2e6, 3e6);
  const Model model = one(Surface(torus.knots(0), torus.knots(1), far, torus.weights()));
  const Tessellation mesh = tessellate(model, chord(1e-3));
  EXPECT_EQ(count(model, mesh).open, 0);
  EXPECT_LE(largest_distance(model, mesh, mesh.tolerance, 3), mesh.tolerance);
}

TEST(Tessellation, RandomRationalSurfaces)
{
  shapes::Random random(11);
  for (int run = 0; run < 40; ++run)
  {
    const auto arrays = shapes::random_arrays<2>(random,
      { { random.integer(1, 4), random.integer(1, 4) } }, random.integer(1, 3), run % 2 == 0, 1.0);
    const Model model = one(arrays.geometry());
    const Tessellation mesh = tessellate(model, chord(1e-2));
    EXPECT_TRUE(mesh.problems.empty()) << run;
    EXPECT_NEAR(count(model, mesh).parameter_area, 1.0, 1e-9) << run;
    EXPECT_LE(largest_distance(model, mesh, mesh.tolerance, 3), mesh.tolerance) << run;
  }
}

TEST(Tessellation, SameBitsForAnyThreads)
{
  Model model = one(shapes::bumpy(20, 3));
  for (const solids::Solid& solid : solids::all())
  {
    model.insert(model.end(), solid.faces.begin(), solid.faces.end());
  }
  const Tessellation serial = tessellate(model, chord(1e-3, 0.5));
  const Tessellation parallel = tessellate(model, chord(1e-3, 0.5), in_threads(3));
  EXPECT_TRUE(serial.points == parallel.points);
  EXPECT_TRUE(serial.normals == parallel.normals);
  EXPECT_TRUE(serial.parameters == parallel.parameters);
  EXPECT_EQ(serial.triangles, parallel.triangles);
}

TEST(Tessellation, CanBeCancelled)
{
  Execution execution;
  double last = 0.0;
  execution.proceed = [&last](double fraction)
  {
    EXPECT_GE(fraction, last);
    last = fraction;
    return fraction < 0.35;
  };
  const Tessellation mesh = tessellate(one(shapes::torus()), chord(1e-3), execution);
  EXPECT_TRUE(mesh.cancelled);
  EXPECT_EQ(mesh.points.cols(), 0);
}

TEST(Tessellation, RefusesAndReports)
{
  for (const double bad : { 0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity() })
  {
    EXPECT_THROW(tessellate(one(shapes::sphere()), chord(bad)), std::invalid_argument);
  }
  EXPECT_THROW(tessellate(one(shapes::sphere()), chord(1e-3, -0.1)), std::invalid_argument);
  EXPECT_TRUE(tessellate({}, {}).triangles.empty());
  // All on one point, or on one line: named, and the others go on.
  Points point = Points::Zero(3, 4);
  Points line = shapes::points({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 0, 0 }, { 1, 0, 0 } });
  const KnotVector knots(1, { 0, 0, 1, 1 });
  const Model model{ solids::whole(Surface(knots, knots, point)), solids::whole(shapes::square()),
    solids::whole(Surface(knots, knots, line)) };
  const Tessellation mesh = tessellate(model, chord(1e-3));
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.triangle_faces, (std::vector<int>{ 1, 1 }));
  ASSERT_EQ(mesh.problems.size(), 2u);
  EXPECT_EQ(mesh.problems[0].face, 0u);
  EXPECT_EQ(mesh.problems[1].face, 2u);
}
