// SPDX-License-Identifier: BSD-3-Clause
#include "peer.h"

#include <vtkCellArray.h>
#include <vtkGenericCell.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStaticCellLocator.h>

namespace inversion_benchmark
{
namespace
{

constexpr int kQuadrilaterals = 200; // a direction
constexpr int kSegments = 4000;

void insert(vtkPoints* points, const Vector3& point)
{
  points->InsertNextPoint(point.data());
}

vtkSmartPointer<vtkPolyData> tessellate(const footpoint::Surface& surface)
{
  const int n = kQuadrilaterals + 1;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> triangles;
  for (int j = 0; j < n; ++j)
  {
    for (int i = 0; i < n; ++i)
    {
      const Parameter<2> at(surface.direction(0).length * i / kQuadrilaterals,
        surface.direction(1).length * j / kQuadrilaterals);
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

vtkSmartPointer<vtkPolyData> tessellate(const footpoint::Curve& curve)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> segments;
  for (vtkIdType i = 0; i <= kSegments; ++i)
  {
    const Parameter<1> at(curve.direction(0).length * static_cast<double>(i) / kSegments);
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

class VtkLocator : public Peer
{
public:
  std::string name() const override { return "VTK locator"; }
  bool exact() const override { return false; }

  bool build(const Shape& shape) override
  {
    this->Locator = vtkSmartPointer<vtkStaticCellLocator>::New();
    this->Locator->SetDataSet(
      shape.surface ? tessellate(*shape.surface) : tessellate(*shape.curve));
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
  vtkSmartPointer<vtkStaticCellLocator> Locator;
  vtkNew<vtkGenericCell> Cell;
};

} // namespace

std::unique_ptr<Peer> make_vtk_locator()
{
  return std::make_unique<VtkLocator>();
}

} // namespace inversion_benchmark
