// SPDX-License-Identifier: BSD-3-Clause
// vtkStructuredGridSmoother: folds mended, sides and data kept, any of the three flat orientations,
// progress and abort, errors.
#include "GridTesting.h"

#include "vtkStructuredGridSmoother.h"

using namespace testing;

namespace
{

/// The folded grid of the swan, 21 × 21, with data.
vtkSmartPointer<vtkStructuredGrid> MakeSwan(int count = 21)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> numbers;
  numbers->SetName("Number");
  for (int j = 0; j < count; ++j)
  {
    for (int i = 0; i < count; ++i)
    {
      points->InsertNextPoint(SwanPoint(i / (count - 1.0), j / (count - 1.0)).data());
      numbers->InsertNextValue(i + count * j);
    }
  }
  auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
  grid->SetDimensions(count, count, 1);
  grid->SetPoints(points);
  grid->GetPointData()->AddArray(numbers);
  AddNumbers(grid->GetFieldData(), "Kept", { 5 });
  return grid;
}

bool SamePoint(vtkDataSet* a, vtkDataSet* b, vtkIdType i)
{
  double p[3];
  a->GetPoint(i, p);
  return std::equal(p, p + 3, b->GetPoint(i));
}

void TestSwan()
{
  const auto swan = MakeSwan();
  vtkNew<vtkStructuredGridSmoother> smoother;
  smoother->SetInputData(swan);
  smoother->Update();
  vtkStructuredGrid* grid = smoother->GetOutput();
  CHECK(FieldValue(grid, "FoldedCellsBefore") == 18);
  CHECK(FieldValue(grid, "FoldedCellsAfter") == 0);
  CHECK(FieldValue(grid, "SmoothingStatus") == vtkStructuredGridSmoother::CONVERGED);
  CHECK(FieldValue(grid, "SmoothingIterations") > 0);
  CHECK(FieldValue(grid, "SmoothingResidual") <= 1e-10);
  CHECK(FieldValue(grid, "Kept") == 5);
  CHECK(SameBits(PointArray(grid, "Number"), PointArray(swan, "Number")));
  double minimum = 1.0;
  for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i)
  {
    minimum = std::min(minimum, CellValue(grid, "Jacobian", i));
    CHECK(CellValue(grid, "Folded", i) == 0);
  }
  CHECK_NEAR(minimum, 0.3235, 5e-4);
  for (vtkIdType i = 0; i < 441; ++i)
  {
    const bool side = i % 21 == 0 || i % 21 == 20 || i / 21 == 0 || i / 21 == 20;
    CHECK(!side || SamePoint(grid, swan, i));
  }

  smoother->SetMethodToNone();
  smoother->Update();
  CHECK(FieldValue(grid, "FoldedCellsAfter") == 18);
  CHECK(FieldValue(grid, "SmoothingStatus") == vtkStructuredGridSmoother::NOT_SMOOTHED);
  CHECK(SamePoint(grid, swan, 220));

  smoother->SetMethodToLaplacian();
  smoother->Update();
  CHECK(FieldValue(grid, "FoldedCellsAfter") <= 18);
}

/// The same grid with another dimension of 1, and normals that are made anew.
void TestOrientations()
{
  vtkNew<vtkStructuredGridSmoother> expected;
  expected->SetInputData(MakeSwan());
  expected->Update();
  const std::array<std::array<int, 3>, 2> shapes{ { { { 21, 1, 21 } }, { { 1, 21, 21 } } } };
  for (const auto& shape : shapes)
  {
    const auto swan = MakeSwan();
    swan->SetDimensions(shape.data());
    vtkNew<vtkDoubleArray> normals;
    normals->SetName("N");
    normals->SetNumberOfComponents(3);
    normals->SetNumberOfTuples(441);
    normals->Fill(7.0);
    swan->GetPointData()->SetNormals(normals);
    vtkNew<vtkStructuredGridSmoother> smoother;
    smoother->SetInputData(swan);
    smoother->Update();
    int dimensions[3];
    smoother->GetOutput()->GetDimensions(dimensions);
    CHECK(std::equal(dimensions, dimensions + 3, shape.begin()));
    for (vtkIdType i = 0; i < 441; ++i)
    {
      CHECK(SamePoint(smoother->GetOutput(), expected->GetOutput(), i));
      CHECK_NEAR(std::abs(Value(smoother->GetOutput(), "N", i, 2)), 1.0, 1e-12);
    }
    CHECK(smoother->GetOutput()->GetPointData()->GetNormals() ==
      PointArray(smoother->GetOutput(), "N"));
    CHECK(Value(swan, "N", 0, 2) == 7.0);
  }
}

void TestProgressAndAbort()
{
  vtkNew<vtkStructuredGridSmoother> smoother;
  vtkNew<ProgressWatcher> watcher;
  smoother->AddObserver(vtkCommand::ProgressEvent, watcher);
  smoother->SetInputData(MakeSwan(41));
  smoother->SetMethodToWinslow();
  smoother->Update();
  CHECK(watcher->Steps.size() >= 3);
  CHECK(smoother->GetOutput()->GetNumberOfPoints() == 41 * 41);

  watcher->Abort = true;
  smoother->Modified();
  smoother->Update();
  CHECK(smoother->GetOutput()->GetNumberOfPoints() == 0);

  watcher->Abort = false;
  smoother->SetAbortExecute(0); // since VTK 9.2 the executive leaves that to the caller
  smoother->Modified();
  smoother->Update();
  CHECK(smoother->GetOutput()->GetNumberOfPoints() == 41 * 41);
}

std::string ErrorOf(vtkDataObject* input)
{
  vtkNew<vtkStructuredGridSmoother> smoother;
  vtkNew<MessageRecorder> recorder;
  recorder->Watch(smoother);
  smoother->SetInputDataObject(input);
  smoother->Update();
  CHECK(smoother->GetOutput()->GetNumberOfPoints() == 0);
  return recorder->Errors;
}

void TestErrors()
{
  const auto swan = MakeSwan();
  swan->SetDimensions(7, 9, 7);
  CHECK(Contains(ErrorOf(swan), "7 x 9 x 7 points; one dimension must be 1"));
  swan->SetDimensions(441, 1, 1);
  CHECK(Contains(ErrorOf(swan), "441 x 1 points"));
  swan->SetDimensions(21, 21, 1);
  swan->GetPoints()->SetPoint(30, 0, std::nan(""), 0);
  CHECK(Contains(ErrorOf(swan), "point 30 of the grid is not finite"));
}

} // namespace

int TestStructuredGridSmoother(int, char*[])
{
  return Run(
    []
    {
      TestSwan();
      TestOrientations();
      TestProgressAndAbort();
      TestErrors();
    });
}
