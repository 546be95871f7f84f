// SPDX-License-Identifier: BSD-3-Clause
// The exact orientation and the constrained Delaunay triangulation.
#include "Shapes.h"

#include "footpoint/tessellation/constrained_delaunay.h"
#include "footpoint/tessellation/orientation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

using footpoint::ConstrainedDelaunay;
using footpoint::EdgeKind;
using footpoint::orientation;
using Point = Eigen::Vector2d;

namespace
{

/// The sign of the area with integer arithmetic, of points on a grid of 2^−29.
int exact(const Point& a, const Point& b, const Point& c)
{
  const auto whole = [](double x) { return static_cast<std::int64_t>(std::ldexp(x, 29)); };
  const std::int64_t area = (whole(a[0]) - whole(c[0])) * (whole(b[1]) - whole(c[1])) -
    (whole(a[1]) - whole(c[1])) * (whole(b[0]) - whole(c[0]));
  return area > 0 ? 1 : area < 0 ? -1 : 0;
}

void check_topology(const ConstrainedDelaunay& mesh)
{
  const auto& triangles = mesh.triangles();
  for (std::size_t k = 0; k < triangles.size(); ++k)
  {
    const auto& v = triangles[k].vertex;
    ASSERT_EQ(orientation(mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2])), 1);
    for (int i = 0; i < 3; ++i)
    {
      const int beyond = triangles[k].neighbour[i];
      if (beyond >= 0)
      {
        const auto& back = triangles[beyond];
        const int j = static_cast<int>(
          std::find(back.neighbour.begin(), back.neighbour.end(), static_cast<int>(k)) -
          back.neighbour.begin());
        ASSERT_LT(j, 3);
        ASSERT_EQ(back.vertex[(j + 1) % 3], v[(i + 2) % 3]);
        ASSERT_EQ(back.kind[j], triangles[k].kind[i]);
      }
    }
  }
}

bool has_edge(const ConstrainedDelaunay& mesh, int a, int b)
{
  for (const auto& triangle : mesh.triangles())
  {
    for (int i = 0; i < 3; ++i)
    {
      if (triangle.vertex[i] == a && triangle.vertex[(i + 1) % 3] == b)
      {
        return triangle.kind[(i + 2) % 3] != EdgeKind::Free;
      }
    }
  }
  return false;
}

} // namespace

TEST(Orientation, IsExactNearALine)
{
  shapes::Random random(1);
  const auto on_grid = [&]
  { return std::ldexp(std::floor(std::ldexp(random.uniform(0, 1), 29)), -29); };
  int degenerate = 0;
  for (int k = 0; k < 20000; ++k)
  {
    const Point a(on_grid(), on_grid());
    const Point b(on_grid(), on_grid());
    const Point middle = 0.5 * (a + b);
    Point c;
    for (int i = 0; i < 2; ++i)
    {
      c[i] = std::ldexp(std::floor(std::ldexp(middle[i], 29)) + random.integer(0, 1), -29);
    }
    const int expected = exact(a, b, c);
    degenerate += expected == 0;
    ASSERT_EQ(orientation(a, b, c), expected);
    ASSERT_EQ(orientation(b, a, c), -expected);
    ASSERT_EQ(orientation(c, a, b), expected);
  }
  EXPECT_GT(degenerate, 100);
}

TEST(Triangulation, OfAGridIsSoundAndDelaunay)
{
  ConstrainedDelaunay mesh(Point(1, 1));
  for (int j = 0; j <= 20; ++j)
  {
    for (int i = 0; i <= 20; ++i)
    {
      mesh.insert(Point(i / 20.0, j / 20.0));
    }
  }
  EXPECT_EQ(mesh.number_of_vertices(), 3 + 441);
  EXPECT_EQ(mesh.insert(Point(0.5, 0.5)), 3 + 10 * 21 + 10) << "a vertex is inserted once";
  check_topology(mesh);
  double longest = 0.0;
  for (const auto& triangle : mesh.triangles())
  {
    for (int i = 0; i < 3; ++i)
    {
      const int a = triangle.vertex[i];
      const int b = triangle.vertex[(i + 1) % 3];
      longest = std::max(longest, a < 3 || b < 3 ? 0.0 : (mesh.point(a) - mesh.point(b)).norm());
    }
  }
  EXPECT_NEAR(longest, 0.05 * std::sqrt(2.0), 1e-12);
}

TEST(Triangulation, KeepsConstraints)
{
  shapes::Random random(2);
  for (int run = 0; run < 50; ++run)
  {
    ConstrainedDelaunay mesh(Point(1, 0.25));
    // A star of segments from the middle, among random points and points on the segments.
    const int centre = mesh.insert(Point(0.5, 0.5));
    std::vector<int> tips;
    for (int k = 0; k < 7; ++k)
    {
      const double angle = 2.0 * std::acos(-1.0) * (k + 0.3 * random.uniform(0, 1)) / 7.0;
      tips.push_back(mesh.insert(Point(0.5 + 0.4 * std::cos(angle), 0.5 + 0.4 * std::sin(angle))));
    }
    const int right = mesh.insert(Point(1, 0.5));
    const int between =
      mesh.insert(Point(0.75, 0.5)); // on the segment from the centre to the right
    for (int k = 0; k < 200; ++k)
    {
      mesh.insert(Point(random.uniform(0, 1), random.uniform(0, 1)));
    }
    for (const int tip : tips)
    {
      if (mesh.point(tip)[1] != 0.5)
      {
        mesh.constrain(centre, tip, EdgeKind::Fixed);
        EXPECT_TRUE(has_edge(mesh, centre, tip));
      }
    }
    mesh.constrain(centre, right, EdgeKind::Divisible);
    EXPECT_TRUE(has_edge(mesh, centre, between));
    EXPECT_TRUE(has_edge(mesh, between, right));
    check_topology(mesh);
    EXPECT_THROW(mesh.constrain(tips[1], tips[6], EdgeKind::Fixed), footpoint::CrossingEdges);
    for (int k = 0; k < 50; ++k)
    {
      mesh.insert(Point(random.uniform(0, 1), random.uniform(0, 1)));
    }
    check_topology(mesh);
  }
}
