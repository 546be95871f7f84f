// SPDX-License-Identifier: BSD-3-Clause
#include "peer.h"

#include <vtkCellArray.h>
#include <vtkGenericCell.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStaticCellLocator.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace inversion_benchmark
{
namespace
{

constexpr int kQuadrilaterals = 200; // a direction
constexpr int kSegments = 4000;
/// A finer mesh has so many times as many a direction, not more than that: millions of triangles.
constexpr double kFiner = 1.25;
constexpr int kMost = 2000;
/// Of every so many cells one is looked at for how far the mesh is off: no divisor of their numbers
/// in a row.
constexpr int kLookedAt = 7;

void insert(vtkPoints* points, const Vector3& point)
{
  points->InsertNextPoint(point.data());
}

/// Quadrilaterals cut into triangles. \param number of quadrilaterals a direction
vtkSmartPointer<vtkPolyData> tessellate(const footpoint::Surface& surface, int number)
{
  const int n = number + 1;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> triangles;
  for (int j = 0; j < n; ++j)
  {
    for (int i = 0; i < n; ++i)
    {
      const Parameter<2> at(
        surface.direction(0).length * i / number, surface.direction(1).length * j / number);
      insert(points, surface.point(at) + surface.centre());
      if (i > 0 && j > 0)
      {
        const vtkIdType corner = static_cast<vtkIdType>(j) * n + i;
        triangles->InsertNextCell({ corner - n - 1, corner - n, corner });
        triangles->InsertNextCell({ corner - n - 1, corner, corner - 1 });
      }
    }
  }
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(points);
  mesh->SetPolys(triangles);
  return mesh;
}

vtkSmartPointer<vtkPolyData> tessellate(const footpoint::Curve& curve, int number)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> segments;
  for (vtkIdType i = 0; i <= number; ++i)
  {
    const Parameter<1> at(curve.direction(0).length * static_cast<double>(i) / number);
    insert(points, curve.point(at) + curve.centre());
    if (i > 0)
    {
      segments->InsertNextCell({ i - 1, i });
    }
  }
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  mesh->SetPoints(points);
  mesh->SetLines(segments);
  return mesh;
}

/// How far the surface is from the mesh, at some quadrilaterals: in their middle, from the plane of
/// the nearer one of the two triangles, and on two sides, from the plane of the triangle there; and
/// on the surface's own sides, from the edge of the mesh.
double error_of(const footpoint::Surface& surface, int number)
{
  double largest = 0.0;
  const auto at = [&](double i, double j)
  {
    return surface.point(Parameter<2>(
      surface.direction(0).length * i / number, surface.direction(1).length * j / number));
  };
  for (int k = 0; k < number * number; k += kLookedAt)
  {
    const int i = k % number;
    const int j = k / number;
    const Vector3 corner = at(i, j);
    const Vector3 diagonal = at(i + 1.0, j + 1.0) - corner;
    const Vector3 middle = at(i + 0.5, j + 0.5) - corner;
    const auto normal = [&](const Vector3& third) -> Vector3
    { return (third - corner).cross(diagonal).stableNormalized(); };
    const Vector3 one = normal(at(i + 1.0, j));
    const Vector3 two = normal(at(i, j + 1.0));
    largest = std::max({ largest, std::min(std::abs(middle.dot(one)), std::abs(middle.dot(two))),
      std::abs((at(i + 0.5, j) - corner).dot(one)),
      std::abs((at(i, j + 0.5) - corner).dot(two)) });
  }
  const auto off_edge = [](const Vector3& from, const Vector3& middle, const Vector3& to)
  { return (middle - from).cross((to - from).stableNormalized()).norm(); };
  for (int k = 0; k < number; ++k)
  {
    for (const int end : { 0, number })
    {
      largest = std::max({ largest, off_edge(at(k, end), at(k + 0.5, end), at(k + 1.0, end)),
        off_edge(at(end, k), at(end, k + 0.5), at(end, k + 1.0)) });
    }
  }
  return largest;
}

class VtkLocator : public Peer
{
public:
  VtkLocator(std::string name, double accuracy)
    : Name(std::move(name))
    , Accuracy(accuracy)
  {
  }
  std::string name() const override { return this->Name; }
  bool exact() const override { return false; }

  bool build(const Shape& shape) override
  {
    int number = shape.surface ? kQuadrilaterals : kSegments;
    while (shape.surface && number < kMost &&
      error_of(*shape.surface, number) > this->Accuracy * shape.size())
    {
      number = std::min(static_cast<int>(kFiner * number), kMost);
    }
    this->Locator = vtkSmartPointer<vtkStaticCellLocator>::New();
    this->Locator->SetDataSet(
      shape.surface ? tessellate(*shape.surface, number) : tessellate(*shape.curve, number));
    this->Locator->BuildLocator();
    return true;
  }

  Answer project(const Vector3& point) override
  {
    Vector3 foot;
    vtkIdType cell = -1;
    int part = 0;
    double square = 0.0;
    this->Locator->FindClosestPoint(point.data(), foot.data(), this->Cell, cell, part, square);
    Answer answer;
    answer.distance = cell < 0 ? NAN : std::sqrt(square);
    return answer;
  }

private:
  std::string Name;
  double Accuracy; ///< of the mesh, by the size
  vtkSmartPointer<vtkStaticCellLocator> Locator;
  vtkNew<vtkGenericCell> Cell;
};

} // namespace

std::unique_ptr<Peer> make_vtk_locator()
{
  return std::make_unique<VtkLocator>("VTK locator", INFINITY);
}

std::unique_ptr<Peer> make_fine_vtk_locator()
{
  return std::make_unique<VtkLocator>("VTK locator 1e-4", 1e-4);
}

} // namespace inversion_benchmark
