// SPDX-License-Identifier: BSD-3-Clause
// Bézier cells as geometry: node order, weights, degrees, parameter ranges, faces of several cells.
// The oracle is the net from which the cells were cut.
#include "FilterTesting.h"

#include "vtkBezierQuadrilateral.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkHigherOrderQuadrilateral.h"
#include "vtkIdList.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPointInversionFilter.h"
#include "vtkUnstructuredGrid.h"

#include <numeric>

using namespace testing;

namespace
{

vtkSmartPointer<vtkUnstructuredGrid> MakeGrid(
  const std::vector<Point>& positions, const std::vector<double>& weights)
{
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(MakePoints(positions)->GetPoints());
  if (!weights.empty())
  {
    AddNumbers(grid->GetPointData(), "RationalWeights", weights);
    grid->GetPointData()->SetActiveRationalWeights("RationalWeights");
  }
  return grid;
}

/// Numbers for each cell in rows of `components`.
void AddRows(
  vtkUnstructuredGrid* grid, const char* name, int components, const std::vector<double>& numbers)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  for (std::size_t i = 0; i < numbers.size(); i += components)
  {
    array->InsertNextTuple(&numbers[i]);
  }
  grid->GetCellData()->AddArray(array);
}

/// The sphere as 4 × 2 biquadratic cells that share no points, in order of u, then v.
vtkSmartPointer<vtkUnstructuredGrid> MakeSphereCells()
{
  const auto net = MakeSphere();
  std::vector<Point> positions;
  std::vector<double> weights;
  std::vector<double> ranges;
  std::vector<double> degrees;
  std::vector<std::array<vtkIdType, 9>> cells;
  const int order[] = { 2, 2 };
  for (int v = 0; v < 2; ++v)
  {
    for (int u = 0; u < 4; ++u)
    {
      std::array<vtkIdType, 9> ids;
      for (int j = 0; j < 3; ++j)
      {
        for (int i = 0; i < 3; ++i)
        {
          const vtkIdType from = (2 * u + i) + 9 * (2 * v + j);
          ids[vtkHigherOrderQuadrilateral::PointIndexFromIJK(i, j, order)] =
            static_cast<vtkIdType>(positions.size());
          Point position;
          net->GetPoint(from, position.data());
          positions.push_back(position);
          weights.push_back(Value(net, "RationalWeights", from));
        }
      }
      cells.push_back(ids);
      ranges.insert(ranges.end(), { double(u), u + 1.0, double(v), v + 1.0 });
      degrees.insert(degrees.end(), { 2, 2, 0 });
    }
  }
  auto grid = MakeGrid(positions, weights);
  for (const auto& ids : cells)
  {
    grid->InsertNextCell(VTK_BEZIER_QUADRILATERAL, 9, ids.data());
  }
  AddRows(grid, "ParameterRange", 4, ranges);
  AddRows(grid, "FaceId", 1, std::vector<double>(8, 0.0));
  AddRows(grid, "HigherOrderDegrees", 3, degrees);
  grid->GetCellData()->SetActiveAttribute(
    "HigherOrderDegrees", vtkDataSetAttributes::HIGHERORDERDEGREES);
  return grid;
}

void TestSphere()
{
  const std::vector<Point> positions = RandomPoints(300, 2.0);
  vtkNew<vtkPointInversionFilter> of_net;
  of_net->SetInputData(MakePoints(positions));
  of_net->SetSourceData(MakeSphere());
  of_net->Update();
  vtkNew<vtkPointInversionFilter> of_cells;
  of_cells->SetInputData(MakePoints(positions));
  of_cells->SetSourceData(MakeSphereCells());
  of_cells->Update();
  for (vtkIdType i = 0; i < 300; ++i)
  {
    CHECK_NEAR(Value(of_cells->GetOutput(), "SignedDistance", i),
      Value(of_net->GetOutput(), "SignedDistance", i), 1e-13);
    for (int k = 0; k < 2; ++k)
    {
      CHECK_NEAR(Value(of_cells->GetOutput(), "Parameters", i, k),
        Value(of_net->GetOutput(), "Parameters", i, k), 1e-9);
    }
    CHECK(Value(of_cells->GetOutput(), "FaceId", i) == 0);
    // Borders between cells of one face are interior.
    CHECK(Value(of_cells->GetOutput(), "FootType", i) == vtkPointInversionFilter::INTERIOR);
  }
  // On the border between cells u = 1.
  of_cells->SetInputData(MakePoints({ { { 0, 1.5, 1.5 } }, { { 0, 2, 0 } } }));
  of_cells->Update();
  CHECK(Value(of_cells->GetOutput(), "FootType", 0) == vtkPointInversionFilter::INTERIOR);
  CHECK(Value(of_cells->GetOutput(), "FootType", 1) == vtkPointInversionFilter::INTERIOR);
  CHECK_NEAR(Value(of_cells->GetOutput(), "Parameters", 1, 0), 1.0, 1e-12);
}

/// Unequal degrees show an exchange of u and v or a wrong order of nodes; VTK's own cell, which is
/// right for polynomial patches at given parameters, is the judge.
void TestNodeOrder()
{
  const int order[] = { 3, 2 };
  std::vector<Point> positions(12);
  for (int j = 0; j <= 2; ++j)
  {
    for (int i = 0; i <= 3; ++i)
    {
      positions[vtkHigherOrderQuadrilateral::PointIndexFromIJK(i, j, order)] = { { double(i),
        double(j) + 0.1 * i, 0.3 * i * j - 0.2 * j * j } };
    }
  }
  std::vector<vtkIdType> ids(12);
  std::iota(ids.begin(), ids.end(), 0);
  auto grid = MakeGrid(positions, {});
  grid->InsertNextCell(VTK_BEZIER_QUADRILATERAL, 12, ids.data());
  vtkNew<vtkPointInversionFilter> filter;
  AddRows(grid, "HigherOrderDegrees", 3, { 3, 2, 0 }); // found by its name
  filter->SetSourceData(grid);

  vtkNew<vtkUnstructuredGrid> judge;
  judge->DeepCopy(grid);
  judge->GetCellData()->SetActiveAttribute(
    "HigherOrderDegrees", vtkDataSetAttributes::HIGHERORDERDEGREES);
  vtkCell* cell = judge->GetCell(0);
  std::vector<Point> on_surface;
  std::vector<double> weights(12);
  for (const double v : { 0.0, 0.3, 0.8 })
  {
    for (const double u : { 0.1, 0.5, 1.0 })
    {
      double parameters[3] = { u, v, 0.0 };
      int sub = 0;
      Point position;
      cell->EvaluateLocation(sub, parameters, position.data(), weights.data());
      on_surface.push_back(position);
    }
  }
  filter->SetInputData(MakePoints(on_surface));
  filter->Update();
  vtkIdType i = 0;
  for (const double v : { 0.0, 0.3, 0.8 })
  {
    for (const double u : { 0.1, 0.5, 1.0 })
    {
      CHECK_NEAR(Value(filter->GetOutput(), "Distance", i), 0.0, 1e-14);
      CHECK_NEAR(Value(filter->GetOutput(), "Parameters", i, 0), u, 1e-10);
      CHECK_NEAR(Value(filter->GetOutput(), "Parameters", i, 1), v, 1e-10);
      ++i;
    }
  }
}

void TestCurves()
{
  // A quarter circle as a rational quadratic: ends first, then the inner point.
  auto grid = MakeGrid(
    { { { 1, 0, 0 } }, { { 0, 1, 0 } }, { { 1, 1, 0 } }, { { -1, 0, 0 } }, { { -1, 1, 0 } } },
    { 1, 1, std::sqrt(0.5), 1, std::sqrt(0.5) });
  const vtkIdType first[] = { 0, 1, 2 };
  const vtkIdType second[] = { 1, 3, 4 };
  grid->InsertNextCell(VTK_BEZIER_CURVE, 3, first);
  grid->InsertNextCell(VTK_BEZIER_CURVE, 3, second);
  vtkNew<vtkPointInversionFilter> filter;
  filter->SetSourceData(grid);
  const double half = std::sqrt(0.5);
  filter->SetInputData(
    MakePoints({ { { 2 * half, 2 * half, 0 } }, { { -2 * half, 2 * half, 0 } } }));
  filter->Update();
  for (vtkIdType i = 0; i < 2; ++i)
  {
    CHECK_NEAR(Value(filter->GetOutput(), "Distance", i), 1.0, 1e-12);
    CHECK_NEAR(Value(filter->GetOutput(), "Parameters", i), 0.5, 1e-9);
    CHECK(Value(filter->GetOutput(), "FaceId", i) == i); // no FaceId: every cell is a face
  }

  // === Numbers of faces are the values of FaceId, in a model after those used up before
  AddRows(grid, "FaceId", 1, { 4, 2 });
  grid->Modified();
  filter->Modified();
  filter->Update();
  CHECK(Value(filter->GetOutput(), "FaceId", 0) == 4);
  CHECK(Value(filter->GetOutput(), "FaceId", 1) == 2);
  vtkNew<vtkMultiBlockDataSet> model;
  model->SetBlock(0, nullptr);
  model->SetBlock(1, grid);
  model->SetBlock(2, MakeSquare(1.0));
  filter->SetSourceData(model);
  filter->Update();
  CHECK(Value(filter->GetOutput(), "FaceId", 0) == 5);
  CHECK(Value(filter->GetOutput(), "FaceId", 1) == 3);
}

void TestErrors()
{
  const auto error_of = [](vtkDataObject* grid)
  {
    vtkNew<vtkPointInversionFilter> filter;
    vtkNew<MessageRecorder> recorder;
    recorder->Watch(filter);
    filter->SetInputData(MakePoints({ { { 0, 0, 2 } } }));
    filter->SetSourceData(grid);
    filter->Update();
    return recorder->Errors + recorder->Warnings;
  };
  auto grid = MakeSphereCells();
  CHECK(error_of(grid).empty());
  grid->GetCellData()->GetArray("ParameterRange")->SetComponent(5, 3, 0.5);
  CHECK(Contains(error_of(grid), "ParameterRange[5]"));

  grid = MakeSphereCells();
  grid->GetCellData()->GetArray("HigherOrderDegrees")->SetComponent(3, 1, 4);
  CHECK(Contains(error_of(grid), "cell 3: degrees (2, 4)"));

  grid = MakeSphereCells();
  grid->GetCellData()->GetArray("HigherOrderDegrees")->SetComponent(3, 1, -1);
  CHECK(Contains(error_of(grid), "HigherOrderDegrees[3]"));

  grid = MakeSphereCells();
  PointArray(grid, "RationalWeights")->SetComponent(20, 0, -1.0);
  CHECK(Contains(error_of(grid), "cell 2"));
  CHECK(Contains(error_of(grid), "-1"));

  grid = MakeSphereCells();
  grid->GetCellData()->GetArray("FaceId")->SetComponent(6, 0, -3);
  CHECK(Contains(error_of(grid), "FaceId[6] = -3"));

  grid = MakeSphereCells();
  const vtkIdType line[] = { 0, 1 };
  grid->InsertNextCell(VTK_LINE, 2, line);
  grid->GetCellData()->GetArray("FaceId")->InsertNextTuple1(1);
  grid->GetCellData()->GetArray("ParameterRange")->InsertNextTuple4(0, 1, 0, 1);
  grid->GetCellData()->GetArray("HigherOrderDegrees")->InsertNextTuple3(1, 1, 0);
  CHECK(Contains(error_of(grid), "Face 1: cell 8: type 3")); // the sphere goes on

  vtkNew<vtkMultiBlockDataSet> model;
  model->SetBlock(0, MakeSquare());
  model->SetBlock(1, grid);
  CHECK(Contains(error_of(model), "Face 2: cell 8: type 3"));

  vtkNew<vtkUnstructuredGrid> empty;
  CHECK(Contains(error_of(empty), "no cells"));
}

} // namespace

int TestBezierCells(int, char*[])
{
  return Run(
    []
    {
      TestSphere();
      TestNodeOrder();
      TestCurves();
      TestErrors();
    });
}
