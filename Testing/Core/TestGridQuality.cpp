// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/grids/grid_quality.h"

#include "GridShapes.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using footpoint::find_folds;
using footpoint::fit_plane;
using footpoint::Folds;
using footpoint::Grid;
using footpoint::grid_quality;
using footpoint::GridQuality;
using footpoint::GridView;
using footpoint::Plane;
using footpoint::Points;
using footpoint::reference_normals;
using footpoint::Vector3;
using footpoint::VolumeGrid;
using grid_shapes::mapped;

namespace
{

/// A rotation that takes the z axis to a unit vector.
Eigen::Matrix3d turn_to(const Vector3& direction)
{
  const Vector3 axis = Vector3::UnitZ().cross(direction).normalized();
  return Eigen::AngleAxisd(std::acos(direction.z()), axis).toRotationMatrix();
}

/// One cell with the corners in the order of the grid's points.
GridQuality<2> one_cell(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d)
{
  Grid grid{ { 2, 2 }, Points(3, 4) };
  grid.points << a, b, c, d;
  return grid_quality(grid);
}

void expect_table(const grid_shapes::Domain& domain, std::int64_t folded, double minimum)
{
  const GridQuality<2> quality = grid_quality(grid_shapes::transfinite(domain, 21, 21));
  EXPECT_EQ(quality.folded_count, folded);
  EXPECT_EQ(quality.folded.count(), folded);
  EXPECT_NEAR(quality.minimum_scaled_jacobian, minimum, 6e-4);
  EXPECT_EQ(quality.minimum_scaled_jacobian, quality.scaled_jacobian.minCoeff());
}

Vector3 on_sphere(const Vector3& p)
{
  return Vector3(p(0), p(1), 4).normalized();
}

VolumeGrid box(int n, const Eigen::Matrix3d& axes)
{
  VolumeGrid grid{ { n, n + 1, n + 2 }, Points(3, n * (n + 1) * (n + 2)) };
  for (int k = 0; k < n + 2; ++k)
  {
    for (int j = 0; j < n + 1; ++j)
    {
      for (int i = 0; i < n; ++i)
      {
        grid.points.col(grid.index(i, j, k)) =
          axes * Vector3(i / (n - 1.0), j / double(n), k / (n + 1.0));
      }
    }
  }
  return grid;
}

} // namespace

TEST(GridQuality, reproduces_the_table_of_transfinite_grids)
{
  expect_table(grid_shapes::swan(), 18, -0.356);
  expect_table(grid_shapes::half_annulus(), 0, 0.9969);
  expect_table(grid_shapes::horseshoe(), 0, 0.3952);
  expect_table(grid_shapes::disk(), 0, 0.0785);
  const auto swan = grid_quality(grid_shapes::transfinite(grid_shapes::swan(), 21, 21));
  EXPECT_EQ((swan.measure.array() < 0).count(), 12);
}

TEST(GridQuality, areas_of_the_swan_sum_up_to_its_area)
{
  const auto quality = grid_quality(grid_shapes::transfinite(grid_shapes::swan(), 201, 201));
  EXPECT_NEAR(quality.measure.sum(), 5.0 / 6.0, 1e-4);
}

TEST(GridQuality, does_not_depend_on_place_and_sense)
{
  const Grid swan = grid_shapes::transfinite(grid_shapes::swan(), 21, 21);
  const Eigen::Matrix3d turn =
    Eigen::AngleAxisd(1.1, Vector3(1, -2, 0.5).normalized()).toRotationMatrix();
  auto moved = [&](const Vector3& p) -> Vector3 { return turn * p + Vector3(10, -20, 5); };
  auto mirrored = [](const Vector3& p) { return Vector3(p(1), p(0), 7.0); };
  auto tiny = [](const Vector3& p) -> Vector3 { return 1e-12 * p; };
  for (const Grid& grid : { mapped(swan, moved), mapped(swan, mirrored), mapped(swan, tiny) })
  {
    EXPECT_EQ(grid_quality(grid).folded_count, 18);
    EXPECT_NEAR(grid_quality(grid).minimum_scaled_jacobian, -0.3563, 1e-4);
  }
}

TEST(GridQuality, rounding_far_from_the_origin_makes_no_folds)
{
  auto far = [](const Vector3& p) -> Vector3 { return p + Vector3::Constant(1e8); };
  auto straight = [](const Vector3& p) -> Vector3 { return p; };
  grid_shapes::Domain thin = grid_shapes::half_ring(1, 1, 1 + 1e-6, 1 + 1e-6);
  EXPECT_EQ(grid_quality(mapped(grid_shapes::transfinite(thin, 5, 21), straight)).folded_count, 0);
  EXPECT_EQ(grid_quality(mapped(grid_shapes::transfinite(thin, 5, 21), far)).folded_count, 0);
}

TEST(GridQuality, folds_in_space_are_those_of_the_plane)
{
  const Grid swan = grid_shapes::transfinite(grid_shapes::swan(), 41, 41);
  const auto plane = grid_quality(swan);
  const auto cylinder = grid_quality(mapped(swan, grid_shapes::rolled));
  const auto sphere = grid_quality(mapped(swan, on_sphere));
  EXPECT_EQ(cylinder.folded_count, plane.folded_count);
  EXPECT_NEAR(cylinder.minimum_scaled_jacobian, plane.minimum_scaled_jacobian, 1e-3);
  EXPECT_NEAR(double(sphere.folded_count), double(plane.folded_count), 2.0);
}

TEST(GridQuality, curved_grids_are_not_folded)
{
  // A closed cylinder, a ribbon of seven turns and most of a sphere: normals of all directions.
  Grid grid{ { 181, 7 }, Points(3, 181 * 7) };
  for (int shape = 0; shape < 3; ++shape)
  {
    for (int j = 0; j < 7; ++j)
    {
      for (int i = 0; i < 181; ++i)
      {
        const double angle = 2 * grid_shapes::kPi * i / 180.0;
        const double v = j / 6.0;
        const double z = -1.4 + 2.8 * v;
        const double turns = 7 * angle;
        const Vector3 places[3] = { { std::cos(angle), std::sin(angle), v },
          { std::cos(turns), std::sin(turns), 0.2 * v + 0.25 * turns / 6.3 },
          { std::cos(z) * std::cos(angle), std::cos(z) * std::sin(angle), std::sin(z) } };
        grid.points.col(grid.index(i, j)) = places[shape];
      }
    }
    const auto quality = grid_quality(grid);
    EXPECT_EQ(quality.folded_count, 0) << shape;
    EXPECT_GT(quality.minimum_scaled_jacobian, 0.7) << shape;
  }
}

TEST(GridQuality, measures_of_single_cells)
{
  auto p = [](double x, double y, double z = 0) { return Vector3(x, y, z); };
  const auto rectangle = one_cell(p(0, 0), p(3, 0), p(0, 2), p(3, 2));
  EXPECT_DOUBLE_EQ(rectangle.measure(0), 6.0);
  EXPECT_DOUBLE_EQ(rectangle.scaled_jacobian(0), 1.0);
  EXPECT_DOUBLE_EQ(rectangle.skew(0), 0.0);
  EXPECT_DOUBLE_EQ(rectangle.aspect_ratio(0), 1.5);

  const auto rhombus = one_cell(p(0, 0), p(1, 0), p(0.5, std::sqrt(0.75)), p(1.5, std::sqrt(0.75)));
  EXPECT_NEAR(rhombus.scaled_jacobian(0), std::sqrt(0.75), 1e-15);
  EXPECT_NEAR(rhombus.skew(0), 0.5, 1e-15);

  // A dart: one corner is turned inward, the area is that of the outline.
  const auto dart = one_cell(p(0, 0), p(1, 0), p(0, 1), p(0.25, 0.25));
  EXPECT_EQ(dart.folded_count, 1);
  EXPECT_DOUBLE_EQ(dart.measure(0), 0.25);

  // Not flat: the two triangles about the shorter diagonal, from (1, 0, 0) to (0, 1, 0).
  const auto bent = one_cell(p(0, 0, 1), p(1, 0), p(0, 1), p(1, 1, 1));
  EXPECT_NEAR(bent.measure(0), std::sqrt(3.0), 1e-14);
  EXPECT_EQ(bent.folded_count, 0);
}

TEST(GridQuality, collapsed_and_straight_corners_are_no_folds)
{
  auto p = [](double x, double y) { return Vector3(x, y, 0); };
  const auto triangle = one_cell(p(0, 0), p(1, 0), p(0, 0), p(1, 1));
  EXPECT_EQ(triangle.folded_count, 0);
  EXPECT_EQ(triangle.scaled_jacobian(0), 0.0);
  EXPECT_EQ(triangle.aspect_ratio(0), std::numeric_limits<double>::infinity());
  EXPECT_NEAR(triangle.minimum_scaled_jacobian, std::sqrt(0.5), 1e-15);
  // Three corners in a line, in numbers that are rounded.
  const auto straight = one_cell(p(0, 0), p(0.1, 0.3), p(-1, 0.5), p(0.2, 0.6));
  EXPECT_EQ(straight.folded_count, 0);
  EXPECT_NEAR(straight.scaled_jacobian(0), 0.0, 1e-15);

  const auto point = one_cell(p(1, 1), p(1, 1), p(1, 1), p(1, 1));
  EXPECT_EQ(point.folded_count, 0);
  EXPECT_EQ(point.minimum_scaled_jacobian, 1.0);
  const auto line = one_cell(p(0, 0), p(1, 0), p(2, 0), p(3, 0));
  EXPECT_EQ(line.folded_count, 0);
  EXPECT_TRUE(line.skew.allFinite());
}

TEST(GridQuality, a_grid_of_one_line_has_no_cells)
{
  const Grid line{ { 5, 1 }, Points::Random(3, 5) };
  EXPECT_EQ(grid_quality(line).folded.size(), 0);
  EXPECT_EQ(grid_quality(Grid()).folded.size(), 0);
  EXPECT_EQ(grid_quality(VolumeGrid()).folded.size(), 0);
}

TEST(GridQuality, volumes_of_boxes)
{
  Eigen::Matrix3d axes;
  axes << 2, 0, 1, 0, 3, 0, 0, 0, 1;
  const auto quality = grid_quality(box(4, axes));
  EXPECT_EQ(quality.measure.size(), 3 * 4 * 5);
  EXPECT_NEAR(quality.measure.sum(), 6.0, 1e-13);
  EXPECT_EQ(quality.folded_count, 0);
  EXPECT_NEAR(quality.minimum_scaled_jacobian, std::sqrt(0.5), 1e-14);
  EXPECT_NEAR(quality.skew.maxCoeff(), std::sqrt(0.5), 1e-14);
  EXPECT_NEAR(quality.aspect_ratio(0), 0.75 / (std::sqrt(2.0) / 5.0), 1e-13);

  axes.col(0) *= -1.0;
  const auto left_handed = grid_quality(box(4, axes));
  EXPECT_EQ(left_handed.folded_count, 60);
  EXPECT_NEAR(left_handed.measure.sum(), -6.0, 1e-13);
}

TEST(GridQuality, volume_of_a_trilinear_cell)
{
  // x = (1 + z) u, y = (1 + z) v, z = w: the integral of (1 + w)² is 7/3.
  VolumeGrid grid = box(2, Eigen::Matrix3d::Identity());
  grid.count = { { 2, 2, 2 } };
  grid.points.resize(3, 8);
  for (int c = 0; c < 8; ++c)
  {
    const double w = c >> 2;
    grid.points.col(c) = Vector3((1 + w) * (c & 1), (1 + w) * (c >> 1 & 1), w);
  }
  EXPECT_NEAR(grid_quality(grid).measure(0), 7.0 / 3.0, 1e-14);
  EXPECT_NEAR(grid_quality(grid).scaled_jacobian(0), std::sqrt(1.0 / 3.0), 1e-14);
}

TEST(GridQuality, folds_alone_are_those_of_the_quality)
{
  const Grid swan = grid_shapes::transfinite(grid_shapes::swan(), 41, 31);
  for (const Grid& grid : { swan, mapped(swan, grid_shapes::rolled), mapped(swan, on_sphere),
         grid_shapes::transfinite(grid_shapes::disk(), 7, 5) })
  {
    const GridQuality<2> quality = grid_quality(grid);
    Eigen::VectorXd jacobian(quality.measure.size());
    Eigen::VectorXi folded(quality.measure.size());
    const Folds folds =
      find_folds(GridView(grid.count, grid.points.data()), jacobian.data(), folded.data());
    EXPECT_EQ(folds.count, quality.folded_count);
    EXPECT_EQ(folds.minimum_scaled_jacobian, quality.minimum_scaled_jacobian);
    EXPECT_TRUE(jacobian == quality.scaled_jacobian);
    EXPECT_TRUE(((folded.array() != 0) == quality.folded).all());
    EXPECT_EQ(find_folds(grid).count, folds.count);
  }
  EXPECT_EQ(find_folds(Grid()).count, 0);
}

// On a smooth grid the cells' directions are taken row by row, with one fold they go through the
// tree: away from the fold both are the same, bit for bit.
TEST(GridQuality, a_fold_changes_normals_only_about_it)
{
  const auto cap = [](const Vector3& p) -> Vector3 {
    return { p(0), p(1), 1 - 0.7 * p(0) * p(0) - 0.4 * p(1) * p(1) };
  };
  const Grid smooth = mapped(grid_shapes::transfinite(grid_shapes::half_annulus(), 31, 23), cap);
  Grid folded = smooth;
  folded.points.col(folded.index(20, 15)) =
    2.5 * smooth.points.col(folded.index(19, 15)) - 1.5 * smooth.points.col(folded.index(20, 15));
  ASSERT_EQ(find_folds(smooth).count, 0);
  ASSERT_GT(find_folds(folded).count, 0);
  const Points expected = reference_normals(smooth);
  const Points normals = reference_normals(folded);
  for (int j = 0; j < 22; ++j)
  {
    for (int i = 0; i < 30; ++i)
    {
      const int cell = i + 30 * j;
      ASSERT_GT(normals.col(cell).dot(expected.col(cell)), 0.5) << i << ' ' << j;
      if (i < 18 || i > 21 || j < 13 || j > 16)
      {
        ASSERT_TRUE(normals.col(cell) == expected.col(cell)) << i << ' ' << j;
      }
    }
  }
}

// More points than are taken at a time, and one of them off the plane, in each place.
TEST(GridQuality, planes_are_found_among_many_points)
{
  const Eigen::Matrix3d turn = turn_to(Vector3(1, 2, 3).normalized());
  const Grid flat = mapped(grid_shapes::transfinite(grid_shapes::swan(), 61, 61),
    [&](const Vector3& p) -> Vector3 { return turn * p; });
  const Plane plane = fit_plane(flat.points);
  ASSERT_TRUE(plane.planar);
  EXPECT_NEAR(std::abs(plane.normal.dot(Vector3(1, 2, 3).normalized())), 1.0, 1e-14);
  for (const int place : { 0, 1023, 1024, 2048, 3720 })
  {
    Points points = flat.points;
    points.col(place) += 1e-6 * plane.normal;
    EXPECT_FALSE(fit_plane(points).planar) << place;
  }
}

TEST(GridQuality, planes_are_found)
{
  const Grid swan = grid_shapes::transfinite(grid_shapes::swan(), 11, 11);
  EXPECT_TRUE(fit_plane(swan.points).planar);
  EXPECT_EQ(fit_plane(swan.points).normal, Vector3(Vector3::UnitZ()));
  EXPECT_EQ(reference_normals(swan).col(0), Vector3(Vector3::UnitZ()));
  const Vector3 direction = Vector3(1, 2, 3).normalized();
  const Eigen::Matrix3d turn = turn_to(direction);
  const Grid turned = mapped(swan, [&](const Vector3& p) -> Vector3 { return turn * p; });
  const Plane plane = fit_plane(turned.points);
  EXPECT_TRUE(plane.planar);
  EXPECT_NEAR(std::abs(plane.normal.dot(direction)), 1.0, 1e-14);
  EXPECT_FALSE(fit_plane(mapped(swan, grid_shapes::rolled).points).planar);
  EXPECT_TRUE(fit_plane(Points::Zero(3, 4)).planar);
}
