// SPDX-License-Identifier: BSD-3-Clause
// The border of a mesh, and of a hole in one, goes straight from vtkFeatureEdges into
// vtkCoonsPatchSource: the patch closes the hole.
#include "GridTesting.h"

#include "vtkCoonsPatchSource.h"
#include "vtkFeatureEdges.h"
#include "vtkPlaneSource.h"

#include <algorithm>
#include <set>

using namespace testing;

namespace
{

vtkSmartPointer<vtkFeatureEdges> BoundaryEdges()
{
  auto edges = vtkSmartPointer<vtkFeatureEdges>::New();
  edges->BoundaryEdgesOn();
  edges->FeatureEdgesOff();
  edges->NonManifoldEdgesOff();
  edges->ManifoldEdgesOff();
  edges->ColoringOff();
  return edges;
}

/// A box of quads, n a side, without its lid, closed at z = 1 by the patch; cells are shuffled.
vtkSmartPointer<vtkPolyData> OpenBox(int n)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  std::vector<std::array<vtkIdType, 4>> quads;
  const auto ring = [&](int i, int j) { return static_cast<vtkIdType>(i % (4 * n) + 4 * n * j); };
  for (int j = 0; j <= n; ++j)
  {
    for (int i = 0; i < 4 * n; ++i)
    {
      const double s = static_cast<double>(i % n) / n;
      const Point sides[] = { { { s, 0, 0 } }, { { 1, s, 0 } }, { { 1 - s, 1, 0 } },
        { { 0, 1 - s, 0 } } };
      const Point& p = sides[i / n];
      points->InsertNextPoint(p[0], p[1], static_cast<double>(j) / n);
    }
  }
  for (int j = 0; j < n; ++j)
  {
    for (int i = 0; i < 4 * n; ++i)
    {
      quads.push_back({ { ring(i, j), ring(i + 1, j), ring(i + 1, j + 1), ring(i, j + 1) } });
    }
  }
  std::mt19937 generator(7);
  std::shuffle(quads.begin(), quads.end(), generator);
  vtkNew<vtkCellArray> polygons;
  for (const auto& quad : quads)
  {
    polygons->InsertNextCell(4, quad.data());
  }
  // The floor is one polygon, so that the lid alone is open.
  polygons->InsertNextCell(4 * n);
  for (int i = 0; i < 4 * n; ++i)
  {
    polygons->InsertCellPoint(i);
  }
  auto box = vtkSmartPointer<vtkPolyData>::New();
  box->SetPoints(points);
  box->SetPolys(polygons);
  return box;
}

void TestLid(int n)
{
  const auto edges = BoundaryEdges();
  edges->SetInputData(OpenBox(n));
  vtkNew<vtkCoonsPatchSource> source;
  source->SetInputConnection(edges->GetOutputPort());
  source->SetResolution(0, 0);
  source->Update();
  CHECK(edges->GetOutput()->GetNumberOfLines() == 4 * n);
  vtkStructuredGrid* grid = source->GetOutput();
  int dimensions[3];
  grid->GetDimensions(dimensions);
  CHECK(dimensions[0] == n + 1 && dimensions[1] == n + 1);
  CHECK(FieldValue(grid, "FoldedCellsAfter") == 0);
  // The lattice of the lid, in whichever orientation.
  std::set<std::pair<long, long>> lattice;
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
  {
    double p[3];
    grid->GetPoint(i, p);
    CHECK_NEAR(p[2], 1.0, 1e-6);
    CHECK_NEAR(n * p[0], std::round(n * p[0]), 1e-4);
    CHECK_NEAR(n * p[1], std::round(n * p[1]), 1e-4);
    lattice.insert({ std::lround(n * p[0]), std::lround(n * p[1]) });
  }
  CHECK(lattice.size() == static_cast<std::size_t>((n + 1) * (n + 1)));
}

/// A plane with a hole has two loops; that is said.
void TestTwoLoops()
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetResolution(5, 5);
  plane->Update();
  vtkNew<vtkPolyData> holed;
  holed->DeepCopy(plane->GetOutput());
  holed->BuildCells();
  holed->DeleteCell(12);
  holed->RemoveDeletedCells();
  const auto edges = BoundaryEdges();
  edges->SetInputData(holed);
  vtkNew<vtkCoonsPatchSource> source;
  source->SetInputConnection(edges->GetOutputPort());
  vtkNew<MessageRecorder> recorder;
  recorder->Watch(source);
  source->Update();
  CHECK(Contains(recorder->Errors, "2 closed loops (20 points through point "));
  CHECK(source->GetOutput()->GetNumberOfPoints() == 0);
}

} // namespace

int TestFeatureEdgesToCoons(int, char*[])
{
  return Run(
    []
    {
      TestLid(4);
      TestLid(300);
      TestTwoLoops();
    });
}
