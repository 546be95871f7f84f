// SPDX-License-Identifier: BSD-3-Clause
#include "Boundaries.h"

#include "footpoint/grids/grid_faces.h"

using namespace boundaries;
using footpoint::Grid;
using footpoint::TriangleStyle;

namespace
{

Grid grid_of(const std::function<Vector3(double, double)>& map, int nu, int nv)
{
  Grid grid{ { { nu, nv } }, Points(3, nu * nv) };
  for (int j = 0; j < nv; ++j)
  {
    for (int i = 0; i < nu; ++i)
    {
      grid.points.col(grid.index(i, j)) = map(i / (nu - 1.0), j / (nv - 1.0));
    }
  }
  return grid;
}

using Quad = std::array<std::int64_t, 4>;
using Triangle = std::array<std::int64_t, 3>;

std::vector<Quad> quads(const Grid& grid)
{
  std::vector<Quad> result;
  footpoint::for_quads(grid.count, [&](const Quad& quad) { result.push_back(quad); });
  return result;
}

std::vector<Triangle> triangles(const Grid& grid, TriangleStyle style)
{
  std::vector<Triangle> result;
  footpoint::for_triangles(
    grid.count, style, [&](const Triangle& triangle) { result.push_back(triangle); });
  return result;
}

} // namespace

TEST(GridFaces, ConnectivityAsTheGuideListsIt)
{
  // 6 7 8
  // 3 4 5
  // 0 1 2
  const Grid grid = grid_of([](double s, double t) { return Vector3(s, t, 0); }, 3, 3);
  EXPECT_EQ(quads(grid),
    (std::vector<Quad>{ { 0, 1, 4, 3 }, { 1, 2, 5, 4 }, { 3, 4, 7, 6 }, { 4, 5, 8, 7 } }));
  EXPECT_EQ(triangles(grid, TriangleStyle::AlignLeft),
    (std::vector<Triangle>{ { 0, 1, 3 }, { 1, 4, 3 }, { 1, 2, 4 }, { 2, 5, 4 }, { 3, 4, 6 },
      { 4, 7, 6 }, { 4, 5, 7 }, { 5, 8, 7 } }));
  EXPECT_EQ(triangles(grid, TriangleStyle::AlignRight),
    (std::vector<Triangle>{ { 0, 1, 4 }, { 0, 4, 3 }, { 1, 2, 5 }, { 1, 5, 4 }, { 3, 4, 7 },
      { 3, 7, 6 }, { 4, 5, 8 }, { 4, 8, 7 } }));
  EXPECT_EQ(triangles(grid, TriangleStyle::UnionJack),
    (std::vector<Triangle>{ { 0, 1, 3 }, { 1, 4, 3 }, { 1, 2, 5 }, { 1, 5, 4 }, { 3, 4, 7 },
      { 3, 7, 6 }, { 4, 5, 7 }, { 5, 8, 7 } }));
  Eigen::Matrix2Xd coordinates(2, 15);
  footpoint::fill_texture_coordinates({ { 3, 5 } }, coordinates);
  EXPECT_TRUE(coordinates.col(0) == Eigen::Vector2d(0, 0));
  EXPECT_TRUE(coordinates.col(4) == Eigen::Vector2d(0.5, 0.25));
  EXPECT_TRUE(coordinates.col(14) == Eigen::Vector2d(1, 1));
}

TEST(GridFaces, Normals)
{
  for (const double scale : { 1e-12, 1.0, 1e12 })
  {
    const Grid plane = grid_of([scale](double s, double t) -> Vector3
      { return scale * Vector3(s, 0.6 * t, 0.8 * t); },
      4, 3);
    EXPECT_LE(
      (footpoint::point_normals(plane).colwise() - Vector3(0, -0.8, 0.6)).cwiseAbs().maxCoeff(),
      1e-15);
  }
  const Grid sphere = grid_of(
    [](double s, double t) -> Vector3 {
      return { std::cos(s) * std::cos(t), std::sin(s) * std::cos(t), std::sin(t) };
    },
    101, 101);
  const Points normals = footpoint::point_normals(sphere);
  for (int j = 1; j < 100; ++j)
  {
    for (int i = 1; i < 100; ++i)
    {
      const Eigen::Index at = sphere.index(i, j);
      ASSERT_LE((normals.col(at) - sphere.points.col(at)).norm(), 1e-4);
      ASSERT_NEAR(normals.col(at).norm(), 1.0, 1e-15);
    }
  }

  // Two cells, one of them nine times as large and standing: the area weighs.
  Grid bent = grid_of([](double s, double t) { return Vector3(2 * s, t, 0); }, 3, 2);
  bent.points.col(2) = Vector3(1, 0, 9);
  bent.points.col(5) = Vector3(1, 1, 9);
  EXPECT_LE((footpoint::point_normals(bent).col(1) - Vector3(-9, 0, 1).normalized()).norm(), 1e-15);
}

TEST(GridFaces, NormalsWhereCellsHaveNone)
{
  for (const double offset : { 0.0, 1e8 })
  {
    const Vector3 origin(offset, offset, -offset);
    const Vector3 direction = Vector3(1, 0.3, 0.7);
    const Grid collinear = grid_of(
      [&](double s, double t) -> Vector3 { return origin + (s + t * t) * direction; }, 5, 6);
    EXPECT_TRUE(footpoint::point_normals(collinear) == Points::Zero(3, 30)) << offset;
  }
  EXPECT_TRUE(footpoint::point_normals(grid_of(
                [](double, double) { return Vector3(1, 2, 3); }, 3, 3)) == Points::Zero(3, 9));
  // Folded onto itself: at the fold the areas cancel, and the normal of the whole grid stands in.
  const Grid folded = grid_of(
    [](double s, double t) {
      return Vector3(s < 0.4 ? 3 * s : s < 0.7 ? 0.0 : 4.0, t, 0);
    },
    4, 2);
  const Points normals = footpoint::point_normals(folded);
  EXPECT_TRUE(normals.allFinite());
  EXPECT_LE((normals.col(1) - Vector3(0, 0, 1)).norm(), 1e-15);
  // One side collapsed.
  const Grid fan = grid_of([](double s, double t) { return Vector3(s * (1 - t), t, 0); }, 4, 4);
  EXPECT_LE(
    (footpoint::point_normals(fan).colwise() - Vector3(0, 0, 1)).cwiseAbs().maxCoeff(), 1e-15);
}
