// SPDX-License-Identifier: BSD-3-Clause
#include "Boundaries.h"

#include "footpoint/grids/transfinite_volume.h"

using namespace boundaries;
using footpoint::BoundaryDefect;
using footpoint::faces_from_edges;
using footpoint::Grid;
using footpoint::transfinite_volume;
using footpoint::VolumeFaces;
using footpoint::VolumeResult;

namespace
{

using Map = std::function<Vector3(double, double, double)>;

VolumeFaces faces_of(const Map& map, const std::array<int, 3>& count)
{
  VolumeFaces faces;
  for (int face = 0; face < 6; ++face)
  {
    const int normal = face / 2;
    const int first = normal == 0 ? 1 : 0;
    const int second = normal == 2 ? 1 : 2;
    Grid& grid = faces[face];
    grid.count = { { count[first], count[second] } };
    grid.points.resize(3, Eigen::Index(count[first]) * count[second]);
    for (int j = 0; j < count[second]; ++j)
    {
      for (int i = 0; i < count[first]; ++i)
      {
        Vector3 at;
        at[normal] = face % 2;
        at[first] = i / (count[first] - 1.0);
        at[second] = j / (count[second] - 1.0);
        grid.points.col(grid.index(i, j)) = map(at[0], at[1], at[2]);
      }
    }
  }
  return faces;
}

double largest_error(const VolumeResult& result, const Map& map)
{
  double error = 0.0;
  const auto& count = result.grid.count;
  for (int k = 0; k < count[2]; ++k)
  {
    for (int j = 0; j < count[1]; ++j)
    {
      for (int i = 0; i < count[0]; ++i)
      {
        const Vector3 expected =
          map(i / (count[0] - 1.0), j / (count[1] - 1.0), k / (count[2] - 1.0));
        error =
          std::max(error, (result.grid.points.col(result.grid.index(i, j, k)) - expected).norm());
      }
    }
  }
  return error;
}

Vector3 wavy(double u, double v, double w)
{
  return { u + 0.1 * std::sin(2 * v + w), v + 0.2 * u * w * w, w + 0.1 * std::cos(3 * u) * v };
}

std::array<Points, 12> edges_of(const Map& map, const std::array<int, 3>& count)
{
  std::array<Points, 12> edges;
  for (int k = 0; k < 12; ++k)
  {
    const int direction = k / 4;
    const int first = direction == 0 ? 1 : 0;
    const int second = direction == 2 ? 1 : 2;
    edges[k] = sampled(count[direction],
      [&](double t)
      {
        Vector3 at;
        at[direction] = t;
        at[first] = k & 1;
        at[second] = (k & 2) / 2;
        return map(at[0], at[1], at[2]);
      });
  }
  return edges;
}

} // namespace

TEST(TransfiniteVolume, ClosedForms)
{
  const Map squares = [](double u, double v, double w)
  { return Vector3(u, v, w + u * u * v * v * w * w); };
  const VolumeResult result = transfinite_volume(faces_of(squares, { { 5, 5, 5 } }));
  EXPECT_NEAR(result.grid.points(2, result.grid.index(2, 2, 2)), 0.5 + 1.0 / 32, 1e-15);
  EXPECT_FALSE(result.mirrored);
  // Products of which one factor at least is linear are reproduced.
  const Map ruled = [](double u, double v, double w)
  {
    return Vector3(
      u + v * v * w * w * u, v + u * u * w * w * w * v, w + std::exp(u) * std::sin(v) * w);
  };
  EXPECT_LE(largest_error(transfinite_volume(faces_of(ruled, { { 6, 4, 7 } })), ruled), 1e-14);
}

TEST(TransfiniteVolume, FacesComeOutBitForBit)
{
  const std::array<int, 3> count{ { 5, 4, 6 } };
  const VolumeFaces faces = faces_of(wavy, count);
  const VolumeResult result = transfinite_volume(faces);
  EXPECT_EQ(result.grid.count, count);
  EXPECT_EQ(result.largest_gap, 0.0);
  for (int j = 0; j < 6; ++j)
  {
    for (int i = 0; i < 4; ++i)
    {
      EXPECT_TRUE(result.grid.points.col(result.grid.index(0, i, j)) ==
        faces[0].points.col(faces[0].index(i, j)));
      EXPECT_TRUE(result.grid.points.col(result.grid.index(4, i, j)) ==
        faces[1].points.col(faces[1].index(i, j)));
    }
    for (int i = 0; i < 5; ++i)
    {
      EXPECT_TRUE(result.grid.points.col(result.grid.index(i, 3, j)) ==
        faces[3].points.col(faces[3].index(i, j)));
    }
  }
}

TEST(TransfiniteVolume, LeftHandedInputIsMirrored)
{
  const Map mirrored = [](double u, double v, double w) { return wavy(1.0 - u, v, w); };
  const VolumeResult result = transfinite_volume(faces_of(mirrored, { { 5, 4, 6 } }));
  const VolumeResult expected = transfinite_volume(faces_of(wavy, { { 5, 4, 6 } }));
  EXPECT_TRUE(result.mirrored);
  EXPECT_FALSE(expected.mirrored);
  EXPECT_LE((result.grid.points - expected.grid.points).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(TransfiniteVolume, BadFacesAreNamed)
{
  VolumeFaces faces = faces_of(wavy, { { 5, 4, 6 } });
  faces[5].points.col(0).x() += 1e-3;
  expect_refused([&] { transfinite_volume(faces); }, BoundaryDefect::Gap,
    "the faces u = 0 and w = 1 are 0.001 (");
  const VolumeResult loose = transfinite_volume(faces, 1e-2);
  EXPECT_NEAR(loose.largest_gap, 1e-3, 1e-15);
  faces = faces_of(wavy, { { 5, 4, 6 } });
  faces[2] = faces_of(wavy, { { 7, 4, 6 } })[2];
  expect_refused([&] { transfinite_volume(faces); }, BoundaryDefect::Count,
    "the face v = 0 has 7 points along u; others have 5");
  faces = faces_of(wavy, { { 5, 4, 6 } });
  faces[3].points(0, 2) = NAN;
  expect_refused(
    [&] { transfinite_volume(faces); }, BoundaryDefect::NotFinite, "point 2 of face 3");
  faces[0].count = { { 1, 6 } };
  expect_refused([&] { transfinite_volume(faces); }, BoundaryDefect::Resolution, "the face u = 0");
}

TEST(TransfiniteVolume, TwelveEdges)
{
  const Map trilinear = [](double u, double v, double w)
  { return Vector3(u + 0.2 * v * w, v - 0.1 * u * w + 0.3 * u, w + 0.1 * u * v * w); };
  const auto edges = edges_of(trilinear, { { 5, 4, 6 } });
  const VolumeResult result = transfinite_volume(faces_from_edges(edges));
  EXPECT_LE(largest_error(result, trilinear), 1e-14);

  auto coarse = edges; // resampled to the count of the others
  coarse[7] = edges_of(trilinear, { { 5, 2, 6 } })[7];
  EXPECT_LE(largest_error(transfinite_volume(faces_from_edges(coarse)), trilinear), 1e-14);

  auto apart = edges;
  apart[1].col(0).z() += 0.25;
  expect_refused([&] { faces_from_edges(apart); }, BoundaryDefect::Gap, "the edges");

  // A prism: the face u = 0 is squeezed to a line.
  const Map wedge = [](double u, double v, double w) { return Vector3(u, u * (v - 0.5), w); };
  const VolumeResult prism = transfinite_volume(faces_from_edges(edges_of(wedge, { { 5, 4, 6 } })));
  EXPECT_LE(largest_error(prism, wedge), 1e-14);
}
