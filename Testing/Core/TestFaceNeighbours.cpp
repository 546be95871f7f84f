// SPDX-License-Identifier: BSD-3-Clause

// Signs of distances where faces meet, and what counts as an open edge.

#include "Inversion.h"
#include "TrimShapes.h"

#include "footpoint/shapes/shapes.h"

#include <gtest/gtest.h>

namespace
{

using namespace inversion;
using footpoint::Points;
using footpoint::Surface;
using footpoint::TrimLoop;

/// How the corners of a face's loop are given.
enum class Loops
{
  Lines,    ///< a curve a side
  Polyline, ///< all sides in one curve
  TinyEdges ///< lines, and at each corner one that is shorter than the tolerance
};

constexpr double kTiny = 1e-7; // of a side

/// A triangle in space as a trimmed plane.
Face triangle(const Vector3& a, const Vector3& b, const Vector3& c, Loops loops, int first)
{
  const auto at = [&](double u, double v) { return Vector3(a + u * (b - a) + v * (c - a)); };
  Points points(3, 4);
  points << at(-1, -1), at(2, -1), at(-1, 2), at(2, 2);
  const footpoint::KnotVector knots(1, { -1, -1, 2, 2 });
  std::vector<trims::Point2> corners{ { 0, 0 }, { 1, 0 }, { 0, 1 } };
  std::rotate(corners.begin(), corners.begin() + first, corners.end());
  TrimLoop loop = trims::polygon(corners);
  if (loops == Loops::Polyline)
  {
    corners.push_back(corners.front());
    loop.curves = { trims::polyline(corners) };
  }
  else if (loops == Loops::TinyEdges)
  {
    std::vector<trims::Point2> cut;
    for (int k = 0; k < 3; ++k)
    {
      const trims::Point2& here = corners[k];
      cut.push_back(here + kTiny * (corners[(k + 2) % 3] - here));
      cut.push_back(here + kTiny * (corners[(k + 1) % 3] - here));
    }
    loop = trims::polygon(cut);
  }
  Face face = face_of(Surface(knots, knots, points));
  face.loops = { loop };
  footpoint::trim(face);
  return face;
}

/// Distances from slender and flat tetrahedra are negative inside alone: where three faces meet at
/// a sharp corner their normals have to be weighted by the angles.
void expect_signs(Loops loops)
{
  shapes::Random random(5);
  for (int k = 0; k < 60; ++k)
  {
    SCOPED_TRACE(k);
    const double height = k % 2 == 0 ? 0.1 : 1.0;
    std::array<Vector3, 4> corner;
    const auto any = [&](double low, double high)
    {
      const Vector3 at = random.vector(low, high);
      return Vector3(at.x(), at.y(), height * at.z());
    };
    std::generate(corner.begin(), corner.end(), [&] { return any(0, 1); });
    const auto volume = [&]
    { return (corner[1] - corner[0]).cross(corner[2] - corner[0]).dot(corner[3] - corner[0]); };
    if (std::abs(volume()) < 0.01 * height)
    {
      continue;
    }
    if (volume() < 0.0)
    {
      std::swap(corner[1], corner[2]);
    }
    const int faces[4][3] = { { 0, 2, 1 }, { 0, 1, 3 }, { 1, 2, 3 }, { 0, 3, 2 } };
    Model model;
    for (const auto& face : faces)
    {
      model.push_back(
        triangle(corner[face[0]], corner[face[1]], corner[face[2]], loops, k % 3));
    }
    const PointInverter inverter(model);
    EXPECT_EQ(inverter.number_of_open_edges(), 0);
    for (int i = 0; i < 100; ++i)
    {
      const Vector3 query = any(-0.5, 1.5);
      double above = -INFINITY;
      for (const auto& face : faces)
      {
        const Vector3& a = corner[face[0]];
        const Vector3 normal =
          (corner[face[1]] - a).cross(corner[face[2]] - a).normalized();
        above = std::max(above, normal.dot(query - a));
      }
      const Foot foot = inverter.find(query);
      if (std::abs(above) > 1e-5) // farther than corners are cut off
      {
        EXPECT_EQ(foot.signed_distance < 0.0, above < 0.0) << query.transpose();
      }
    }
  }
}

TEST(FaceNeighbours, SignsAtCornersBetweenCurves)
{
  expect_signs(Loops::Lines);
}

TEST(FaceNeighbours, SignsAtCornersInsideACurve)
{
  expect_signs(Loops::Polyline);
}

TEST(FaceNeighbours, SignsAtCornersWithTinyEdges)
{
  expect_signs(Loops::TinyEdges);
}

TEST(FaceNeighbours, APolylineIsOpenWhereOneOfItsSegmentsIs)
{
  const Vector3 a(0, 0, 0);
  const Vector3 b(1, 0, 0);
  const Vector3 c(0, 1, 0);
  const Vector3 d(0, 0, 1);
  // Two triangles share the side from a to b: of three sides of each two are open.
  for (int first = 0; first < 3; ++first)
  {
    const PointInverter inverter({ triangle(a, b, c, Loops::Polyline, first),
      triangle(b, a, d, Loops::Polyline, 0) });
    EXPECT_EQ(inverter.number_of_open_edges(), 2);
  }
}

/// A wing with a sharp trailing edge is bent along the seam of its surface. Behind the end of the
/// edge, where the tip's face begins, everything is outside.
TEST(FaceNeighbours, SeamsOfBentFacesEndAtVertices)
{
  footpoint::WingOptions options;
  options.capping = true;
  Model model;
  for (const footpoint::NamedSurface& face : footpoint::wing(options))
  {
    model.push_back(face_of(face.surface));
  }
  const PointInverter inverter(model);
  const double half_span = 0.5 * options.span;
  const double back = half_span * std::tan(options.sweep_angle * std::acos(-1.0) / 180.0) +
    options.chord * options.taper_ratio;
  shapes::Random random(5);
  int at_the_corner = 0;
  for (int i = 0; i < 500; ++i)
  {
    const int side = i % 2 == 0 ? 1 : -1;
    const Vector3 corner(back, side * half_span, 0.0);
    const Vector3 off(
      random.uniform(0.01, 0.5), side * random.uniform(-0.03, 0.2), random.uniform(-0.1, 0.1));
    const Foot foot = inverter.find(corner + off);
    at_the_corner += (foot.point - corner).norm() < 1e-9;
    EXPECT_GT(foot.signed_distance, 0.0) << off.transpose();
  }
  EXPECT_GT(at_the_corner, 50);
}

} // namespace
