// SPDX-License-Identifier: BSD-3-Clause
// Triangles and lines of untrimmed geometry.
#include "TessellationChecks.h"

#include "footpoint/tessellation/derivative_bounds.h"

#include <gtest/gtest.h>

#include <thread>

using namespace footpoint;
using namespace tessellations;

namespace
{

const double kPi = std::acos(-1.0);

} // namespace

TEST(DerivativeBounds, HoldAndConverge)
{
  shapes::Random random(3);
  for (int run = 0; run < 40; ++run)
  {
    const auto arrays =
      shapes::random_arrays<2>(random, { { random.integer(1, 5), random.integer(1, 5) } }, 3,
        run % 2 == 0, run % 3 == 0 ? 0.0 : 1.0);
    const Surface surface = arrays.geometry();
    SurfaceBounds bounds(surface);
    for (std::size_t row = 0; row < bounds.rows(); ++row)
    {
      bounds.prepare_row(row);
    }
    const Vector3 up = random.vector(-1, 1).normalized();
    for (const double extent : { 0.6, 1e-2, 1e-4 })
    {
      ParameterBox box;
      for (int i = 0; i < 2; ++i)
      {
        const double length = surface.direction(i).length;
        box.lower[i] = random.uniform(0.0, 1.0 - extent) * length;
        box.upper[i] = box.lower[i] + extent * length;
      }
      const DerivativeBounds over = bounds.over(box, up);
      const DerivativeBounds pieces = bounds.of_pieces(box);
      DerivativeBounds found;
      for (int k = 0; k < 200; ++k)
      {
        const Parameter<2> t = box.lower +
          Parameter<2>(random.uniform(0, 1), random.uniform(0, 1)).cwiseProduct(box.extent());
        const Jet<2> jet = surface.jet(t, Sides<2>::Constant(Side::Right), 2);
        const auto height = [&](int i) { return std::abs(jet.second.col(i).dot(up)); };
        found = found.joined_with({ jet.first.col(0).norm(), jet.first.col(1).norm(),
          { jet.second.col(0).norm(), jet.second.col(1).norm(), jet.second.col(2).norm() },
          { height(0), height(1), height(2) } });
      }
      const double rounding = 1e-9;
      EXPECT_LE(found.u, over.u * (1 + rounding));
      EXPECT_LE(found.v, over.v * (1 + rounding));
      EXPECT_LE(found.second.uu, over.second.uu * (1 + rounding) + rounding);
      EXPECT_LE(found.second.uv, over.second.uv * (1 + rounding) + rounding);
      EXPECT_LE(found.second.vv, over.second.vv * (1 + rounding) + rounding);
      EXPECT_LE(found.height.uu, over.height.uu * (1 + rounding) + rounding);
      EXPECT_LE(found.height.uv, over.height.uv * (1 + rounding) + rounding);
      EXPECT_LE(found.height.vv, over.height.vv * (1 + rounding) + rounding);
      EXPECT_LE(found.second.uu, pieces.second.uu * (1 + rounding) + rounding);
      const auto touched = bounds.spans(box);
      if (extent == 1e-4 && touched[0][0] == touched[0][1] && touched[1][0] == touched[1][1])
      {
        EXPECT_LE(over.u, 1.05 * found.u);
        EXPECT_LE(over.second.uu, 1.1 * found.second.uu + 1e-3);
        EXPECT_LE(over.second.uv, 1.1 * found.second.uv + 1e-3);
        EXPECT_LE(over.height.vv, 1.1 * found.height.vv + 0.05 * found.second.vv + 1e-3);
      }
    }
  }
}

TEST(Tessellation, KeepsTheChordTolerance)
{
  const std::vector<std::pair<const char*, Surface>> surfaces{ { "sphere", shapes::sphere() },
    { "torus", shapes::torus() }, { "cylinder", shapes::cylinder() },
    { "saddle", shapes::saddle() }, { "cusp", shapes::cusp() }, { "triangle", shapes::triangle() },
    { "ribbon", shapes::helical_ribbon() }, { "bumpy", shapes::bumpy(12, 1) } };
  for (const auto& [name, surface] : surfaces)
  {
    const Model model = one(surface);
    for (const double tolerance : { 1e-2, 1e-3 })
    {
      const Tessellation mesh = tessellate(model, chord(tolerance));
      EXPECT_TRUE(mesh.problems.empty()) << name;
      EXPECT_DOUBLE_EQ(mesh.tolerance, tolerance * surface.size()) << name;
      EXPECT_LE(largest_distance(model, mesh, mesh.tolerance), mesh.tolerance) << name;
      const Counts counts = count(model, mesh);
      EXPECT_EQ(counts.degenerate, 0) << name;
      EXPECT_GT(counts.least_parameter_area, 0.0) << name;
    }
  }
}

TEST(Tessellation, IsNotWasteful)
{
  // Equilateral triangles with all corners on a surface of these curvatures need as many.
  const auto least = [](double area, double tolerance)
  { return area / (0.75 * std::sqrt(3.0) * 2.0 * tolerance); };
  for (const double tolerance : { 1e-3, 1e-4 })
  {
    const auto triangles = [&](const Surface& surface)
    { return static_cast<double>(tessellate(one(surface), chord(tolerance)).triangles.size()); };
    const Surface sphere = shapes::sphere();
    EXPECT_LE(triangles(sphere), 5.0 * least(4.0 * kPi, tolerance * sphere.size()) + 100.0);
    // The arcs of a cylinder: chords off by the tolerance, two triangles each.
    const Surface cylinder = shapes::cylinder(1.0, 270.0, 3);
    const double step = 2.0 * std::acos(1.0 - tolerance * cylinder.size());
    EXPECT_LE(tessellate(one(cylinder), chord(tolerance)).triangles.size(),
      4.0 * 2.0 * 1.5 * kPi / step + 8);
  }
  // A cone is straight from its apex to its base.
  const Model cone{ solids::cone().faces[0] };
  EXPECT_LE(tessellate(cone, chord(1e-3)).triangles.size(), 200u);
  // A plane needs two, however it is parametrized.
  EXPECT_EQ(tessellate(one(shapes::square()), chord(1e-6)).triangles.size(), 2u);
  EXPECT_EQ(tessellate(one(trims::flat(0, 1, 0, 1, 1)), chord(1e-6)).triangles.size(), 2u);
}

TEST(Tessellation, NormalsAndParametersAreTheSurfaces)
{
  const Surface sphere = shapes::sphere();
  for (const bool reversed : { false, true })
  {
    const Model model{ solids::whole(sphere, reversed) };
    const Tessellation mesh = tessellate(model, chord(1e-3));
    const Vector3 outward =
      mesh.normals.col(0).dot(mesh.points.col(0)) > 0 ? Vector3(1, 1, 1) : Vector3(-1, -1, -1);
    for (Eigen::Index k = 0; k < mesh.points.cols(); ++k)
    {
      EXPECT_NEAR(mesh.points.col(k).norm(), 1.0, 1e-14);
      EXPECT_LE((mesh.normals.col(k) - outward[0] * mesh.points.col(k)).norm(), 1e-7);
      const Vector3 there = sphere.centre() + sphere.point(sphere.to_local(mesh.parameters.col(k)));
      EXPECT_LE((there - mesh.points.col(k)).norm(), 1e-14);
    }
    for (std::size_t k = 0; k < mesh.triangles.size(); ++k)
    {
      const auto [a, b, c] = corners(mesh, k);
      EXPECT_GT((b - a).cross(c - a).dot(mesh.normals.col(mesh.triangles[k][0])), 0.0);
    }
    // v runs from the south pole: S_u × S_v points outward; the volume has the sign of the
    // triangles.
    const double sign = reversed ? -1.0 : 1.0;
    EXPECT_NEAR(count(model, mesh).volume, sign * 4.0 * kPi / 3.0, 0.02);
  }
}

TEST(Tessellation, ClosedSurfacesAreClosed)
{
  for (const double tolerance : { 3e-2, 1e-3 })
  {
    for (const Surface& surface : { shapes::sphere(), shapes::torus() })
    {
      const Model model = one(surface);
      const Counts counts = count(model, tessellate(model, chord(tolerance)));
      EXPECT_EQ(counts.open, 0);
      EXPECT_EQ(counts.degenerate, 0);
    }
  }
}

TEST(Tessellation, KeepsTheAngleTolerance)
{
  for (const double angle : { 0.5, 0.1 })
  {
    for (const Surface& surface : { shapes::sphere(), shapes::torus(), shapes::bumpy(8, 2) })
    {
      const Tessellation mesh = tessellate(one(surface), chord(1e-3, angle));
      const Tessellation without = tessellate(one(surface), chord(1e-3));
      EXPECT_GE(mesh.triangles.size(), without.triangles.size());
      for (std::size_t k = 0; k < mesh.triangles.size(); ++k)
      {
        const std::array<Vector3, 3> corner = corners(mesh, k);
        const double area = (corner[1] - corner[0]).cross(corner[2] - corner[0]).norm();
        for (int i = 0; i < 3; ++i)
        {
          const Vector3 a = mesh.normals.col(mesh.triangles[k][i]);
          const Vector3 b = mesh.normals.col(mesh.triangles[k][(i + 1) % 3]);
          const double length = (corner[i] - corner[(i + 1) % 3]).norm();
          if (length > mesh.tolerance && area > mesh.tolerance * length)
          {
            EXPECT_LE(std::atan2(a.cross(b).norm(), a.dot(b)), angle * (1 + 1e-6));
          }
        }
      }
    }
  }
}

TEST(Tessellation, KinksStaySharp)
{
  // A roof over the unit square with its ridge at u = 1/2.
  const Points net = shapes::points(
    { { 0, 0, 0 }, { 0.5, 0, 1 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0.5, 1, 1 }, { 1, 1, 0 } });
  const Surface roof(KnotVector(1, { 0, 0, 0.5, 1, 1 }), KnotVector(1, { 0, 0, 1, 1 }), net);
  const Tessellation mesh = tessellate(one(roof), chord(1e-2));
  EXPECT_EQ(mesh.triangles.size(), 4u);
  EXPECT_EQ(mesh.points.cols(), 8) << "each side has its own points";
  const double s = std::sqrt(0.2);
  for (std::size_t k = 0; k < 4; ++k)
  {
    const auto [a, b, c] = corners(mesh, k);
    const Vector3 normal = (b - a).cross(c - a).normalized();
    EXPECT_NEAR(std::abs(normal.x()), 2.0 * s, 1e-14);
    for (const std::int64_t corner : mesh.triangles[k])
    {
      EXPECT_LE((mesh.normals.col(corner) - normal).norm(), 1e-14);
    }
  }
}

TEST(Tessellation, FixedResolution)
{
  TessellationOptions options;
  options.mode = TessellationMode::Fixed;
  for (const int resolution : { 1, 3, 8 })
  {
    options.resolution = resolution;
    const Surface surface = shapes::bumpy(7, 1); // 4 x 4 spans
    const Tessellation mesh = tessellate(one(surface), options);
    EXPECT_EQ(mesh.triangles.size(), 2u * 16 * resolution * resolution);
    EXPECT_EQ(mesh.points.cols(), (4 * resolution + 1) * (4 * resolution + 1));
    const Tessellation line = tessellate(one(shapes::circle()), options);
    ASSERT_EQ(line.lines.size(), 1u);
    EXPECT_EQ(line.lines[0].size(), 4u * resolution + 1);
  }
}

TEST(Tessellation, CurvesBecomePolylines)
{
  const Curve circle = shapes::circle(10.0);
  for (const double tolerance : { 1e-2, 1e-4, 1e-6 })
  {
    const Tessellation mesh = tessellate(one(circle), chord(tolerance));
    ASSERT_EQ(mesh.lines.size(), 1u);
    const auto& line = mesh.lines[0];
    double largest = 0.0;
    for (std::size_t k = 0; k + 1 < line.size(); ++k)
    {
      const Vector3 a = mesh.points.col(line[k]);
      const Vector3 b = mesh.points.col(line[k + 1]);
      EXPECT_NEAR(a.head<2>().norm(), 10.0, 1e-13);
      largest = std::max(largest, 10.0 - (0.5 * (a + b)).head<2>().norm());
    }
    EXPECT_LE(largest, mesh.tolerance);
    const double step = 2.0 * std::acos(1.0 - mesh.tolerance / 10.0);
    EXPECT_LE(line.size(), 2.0 * 2.0 * kPi / step + 4);
  }
  EXPECT_EQ(tessellate(one(shapes::line_with_gap()), chord(1e-3)).lines.size(), 2u);
  const Tessellation tent = tessellate(one(shapes::tent()), chord(1e-3));
  EXPECT_EQ(tent.lines[0].size(), 3u) << "its corner is a point";
}

TEST(Tessellation, EqualBordersHaveEqualPoints)
{
  // A box of six bicubic faces, each turned in its own way, bulging; neighbours share border
  // curves.
  const auto bulge = [](const Vector3& p)
  {
    return Vector3(
      p + 0.15 * Vector3(std::sin(2 * p.y()), std::sin(2 * p.z() + p.x()), p.x() * p.y()));
  };
  shapes::Random random(5);
  for (int run = 0; run < 8; ++run)
  {
    Model model;
    const std::vector<double> knots{ 0, 0, 0, 0, 0.3, 0.7, 1, 1, 1, 1 };
    for (int axis = 0; axis < 3; ++axis)
    {
      for (const double at : { -1.0, 1.0 })
      {
        // Net points on the border depend on the place alone, so that borders are equal curves.
        std::array<bool, 3> turn{ { random.integer(0, 1) == 1, random.integer(0, 1) == 1,
          random.integer(0, 1) == 1 } };
        Points net(3, 36);
        std::vector<double> symmetric{ -1, -0.8, -0.35, 0.35, 0.8, 1 };
        for (int j = 0; j < 6; ++j)
        {
          for (int i = 0; i < 6; ++i)
          {
            Vector3 p;
            p[axis] = at;
            p[(axis + 1) % 3] = symmetric[turn[0] ? 5 - i : i];
            p[(axis + 2) % 3] = symmetric[turn[1] ? 5 - j : j];
            net.col(turn[2] ? i * 6 + j : j * 6 + i) = bulge(p);
          }
        }
        const bool reversed = (at < 0) != (turn[0] != (turn[1] != turn[2]));
        model.push_back(
          solids::whole(Surface(KnotVector(3, knots), KnotVector(3, knots), net), reversed));
      }
    }
    const Tessellation mesh = tessellate(model, chord(1e-3));
    const Counts counts = count(model, mesh);
    EXPECT_EQ(counts.open, 0);
    EXPECT_EQ(counts.degenerate, 0);
    EXPECT_GT(counts.volume, 6.0);
    EXPECT_LE(largest_distance(model, mesh, mesh.tolerance, 3), mesh.tolerance);
    // Alone, each face has the same border points, up to rounding.
    for (std::size_t face = 0; face < 2; ++face)
    {
      const Model alone{ model[face] };
      TessellationOptions absolute = chord(mesh.tolerance);
      absolute.absolute = true;
      EXPECT_EQ(tessellate(alone, absolute).triangles.size(),
        static_cast<std::size_t>(std::count(
          mesh.triangle_faces.begin(), mesh.triangle_faces.end(), static_cast<int>(face))));
    }
  }
}
