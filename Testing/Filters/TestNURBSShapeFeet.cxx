// SPDX-License-Identifier: BSD-3-Clause
// Feet on the shapes of vtkNURBSShapeSource: certified, with the distances and signs of the shapes'
// equations.
#include "BezierTesting.h"

#include "vtkNURBSShapeSource.h"

#include <functional>

using namespace testing;
using Source = vtkNURBSShapeSource;

namespace
{

/// All feet of random points are certified, and their signed distances are those of an equation.
void CheckSignedDistances(Source* source, double reach, double tolerance,
  const std::function<double(const Point&)>& expected)
{
  source->Update();
  std::vector<Point> points = RandomPoints(500, reach);
  for (Point& point : points)
  {
    for (int i = 0; i < 3; ++i)
    {
      point[i] += source->GetCenter()[i];
    }
  }
  const auto feet = Feet(source->GetOutputDataObject(0), points);
  for (vtkIdType i = 0; i < 500; ++i)
  {
    Point local = points[i];
    for (int k = 0; k < 3; ++k)
    {
      local[k] -= source->GetCenter()[k];
    }
    CHECK(Value(feet, "Status", i) == 0);
    CHECK_NEAR(Value(feet, "SignedDistance", i), expected(local), tolerance);
  }
}

/// Only the signs, positive where `outside` says so. \param no_sign feet that tell no side
void CheckSigns(
  Source* source, const Point& reach, const std::function<bool(const Point&)>& outside,
  const std::function<bool(const Point&)>& no_sign = [](const Point&) { return false; })
{
  source->Update();
  std::vector<Point> points = RandomPoints(2000, 1.0);
  for (Point& point : points)
  {
    point = { { point[0] * reach[0], point[1] * reach[1], point[2] * reach[2] } };
  }
  const auto feet = Feet(source->GetOutputDataObject(0), points);
  int inside = 0;
  int left_out = 0;
  for (vtkIdType i = 0; i < 2000; ++i)
  {
    CHECK(Value(feet, "Status", i) == 0);
    Point foot;
    PointArray(feet, "ClosestPoint")->GetTuple(i, foot.data());
    if (no_sign(foot))
    {
      ++left_out;
      continue;
    }
    CHECK((Value(feet, "SignedDistance", i) > 0.0) == outside(points[i]));
    inside += outside(points[i]) ? 0 : 1;
  }
  CHECK(inside > 60);
  CHECK(left_out < 200);
}

void TestSignedDistances()
{
  vtkNew<Source> source;
  source->SetCenter(1.0, -2.0, 0.5);
  source->SetRadius(2.0);
  CheckSignedDistances(source, 4.0, 1e-14, [](const Point& p) { return Norm(p) - 2.0; });
  source->SetShapeToTorus();
  source->SetCrossSectionRadius(0.5);
  CheckSignedDistances(source, 4.0, 1e-14,
    [](const Point& p) { return std::hypot(std::hypot(p[0], p[1]) - 2.0, p[2]) - 0.5; });

  // === Solids: the distance of a box, a triangle in the half-plane (r, z)
  source->SetHeight(3.0);
  source->CappingOn();
  source->SetShapeToCylinder();
  CheckSignedDistances(source, 4.0, 1e-13,
    [](const Point& p)
    {
      const double r = std::hypot(p[0], p[1]) - 2.0;
      const double z = std::abs(p[2]) - 1.5;
      return std::min(std::max(r, z), 0.0) + std::hypot(std::max(r, 0.0), std::max(z, 0.0));
    });
  source->SetShapeToCone();
  CheckSignedDistances(source, 4.0, 1e-13,
    [](const Point& p)
    {
      const double r = std::hypot(p[0], p[1]);
      const double z = p[2] + 1.5;
      const auto to_segment = [&](double ar, double az, double br, double bz)
      {
        const double t = std::min(std::max(((r - ar) * (br - ar) + (z - az) * (bz - az)) /
                                      ((br - ar) * (br - ar) + (bz - az) * (bz - az)),
                                    0.0),
          1.0);
        return std::hypot(r - ar - t * (br - ar), z - az - t * (bz - az));
      };
      const double distance = std::min(to_segment(2, 0, 0, 3), to_segment(0, 0, 2, 0));
      return z > 0.0 && r / 2.0 + z / 3.0 < 1.0 ? -distance : distance;
    });
}

void TestSigns()
{
  vtkNew<Source> source;
  source->CappingOn();
  source->SetShapeToShipHull();
  CheckSigns(
    source, { { 6.0, 0.8, 0.9 } },
    [](const Point& p)
    {
      const double x = 2.0 * p[0] / 10.0;
      const double z = p[2] / 0.625;
      return std::abs(x) > 1.0 || z > 0.0 || z < -1.0 ||
        std::abs(p[1]) > 0.5 * (1.0 - x * x) * (1.0 - z * z);
    },
    // Where stem and keel meet both sides touch the same plane, and the sum of their normals is 0.
    [](const Point& foot) { return std::abs(foot[0]) == 5.0 && foot[2] == -0.625; });
  source->SetShapeToWing();
  for (const bool blunt : { false, true })
  {
    source->SetBluntTrailingEdge(blunt);
    CheckSigns(source, { { 2.0, 3.5, 0.1 } },
      [&](const Point& p)
      {
        const double eta = std::abs(p[1]) / 3.0;
        const double chord = 1.0 - 0.5 * eta;
        const double x =
          (p[0] - std::abs(p[1]) * std::tan(vtkMath::RadiansFromDegrees(15.0))) / chord;
        if (eta > 1.0 || x < 0.0 || x > 1.0)
        {
          return true;
        }
        const double half = 0.6 *
          (0.2969 * std::sqrt(x) - 0.126 * x - 0.3516 * x * x + 0.2843 * x * x * x -
            (blunt ? 0.1015 : 0.1036) * x * x * x * x);
        const double camber =
          x < 0.4 ? 0.125 * (0.8 * x - x * x) : 0.02 / 0.36 * (0.2 + 0.8 * x - x * x);
        return std::abs(p[2] / chord - camber) > half;
      });
  }
}

/// Open surfaces and curves: certified feet, and signs of a height field.
void TestOthers()
{
  vtkNew<Source> source;
  source->SetShapeToBumpy();
  source->SetSeed(3);
  source->Update();
  std::vector<Point> points;
  for (Point p : RandomPoints(200, 0.7))
  {
    p[2] += p[2] > 0.0 ? 0.3 : -0.3;
    points.push_back(p);
  }
  auto feet = Feet(source->GetOutputDataObject(0), points);
  for (vtkIdType i = 0; i < 200; ++i)
  {
    CHECK(Value(feet, "Status", i) == 0);
    CHECK((Value(feet, "SignedDistance", i) > 0.0) == (points[i][2] > 0.0));
  }

  source->SetShapeToCircle();
  source->Update();
  points = RandomPoints(200, 3.0);
  feet = Feet(source->GetOutputDataObject(0), points);
  for (vtkIdType i = 0; i < 200; ++i)
  {
    const Point& p = points[i];
    CHECK(Value(feet, "Status", i) == 0);
    CHECK_NEAR(Value(feet, "Distance", i), std::hypot(std::hypot(p[0], p[1]) - 1.0, p[2]), 1e-14);
  }

  source->SetShapeToHelix();
  source->Update();
  points.clear();
  for (int i = 0; i < 100; ++i) // radially away from a helix its nearest point stays the same
  {
    const double angle = 0.3 + 0.18 * i;
    points.push_back(
      { { 1.1 * std::cos(angle), 1.1 * std::sin(angle), angle / (3.0 * vtkMath::Pi()) - 1.0 } });
  }
  feet = Feet(source->GetOutputDataObject(0), points);
  for (vtkIdType i = 0; i < 100; ++i)
  {
    CHECK(Value(feet, "Status", i) == 0);
    CHECK_NEAR(Value(feet, "Distance", i), 0.1, 1.1e-6);
    CHECK(Value(feet, "FootType", i) == vtkPointInversionFilter::INTERIOR);
  }

  source->SetShapeToTeapot();
  source->Update();
  points = { { { 0, -2.5, 1 } }, { { 0, -1.5, 1 } }, { { 0, 0, 3.25 } }, { { -2.8, 0, 3 } },
    { { 4, 0, 2.6 } }, { { 2.7, -0.8, 1.4 } }, { { 0, 0, -0.5 } }, { { 0, 0, 0.5 } } };
  const std::vector<double> faces{ 0, 0, 1, 2, 3, 3, 0, 0 };
  const std::vector<double> signs{ 1, -1, 1, 1, 1, 1, 1, -1 };
  feet = Feet(source->GetOutputDataObject(0), points);
  for (vtkIdType i = 0; i < vtkIdType(points.size()); ++i)
  {
    CHECK(Value(feet, "Status", i) == 0);
    CHECK(Value(feet, "FaceId", i) == faces[i]);
    CHECK(Value(feet, "SignedDistance", i) * signs[i] > 0.0);
  }
  CHECK_NEAR(Value(feet, "SignedDistance", 2), 0.1, 1e-14); // above the knob
}

} // namespace

int TestNURBSShapeFeet(int, char*[])
{
  return Run(
    []
    {
      TestSignedDistances();
      TestSigns();
      TestOthers();
    });
}
