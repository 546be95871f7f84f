// SPDX-License-Identifier: BSD-3-Clause
// vtkSplineEvaluator: points and directions with known values, the inverse of point inversion, and
// what happens to parameters outside the domain.
#include "FilterTesting.h"

#include "vtkCellArray.h"
#include "vtkIdTypeArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkParametricTorus.h"
#include "vtkPointInversionFilter.h"
#include "vtkSplineEvaluator.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

using namespace testing;

namespace
{

/// A table with a column `Parameters` of rows of numbers.
vtkSmartPointer<vtkTable> MakeTable(int components, const std::vector<double>& numbers)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName("Parameters");
  array->SetNumberOfComponents(components);
  for (std::size_t i = 0; i < numbers.size(); i += components)
  {
    array->InsertNextTuple(&numbers[i]);
  }
  auto table = vtkSmartPointer<vtkTable>::New();
  table->AddColumn(array);
  return table;
}

Point PointOf(vtkPolyData* output, vtkIdType i)
{
  Point point;
  output->GetPoint(i, point.data());
  return point;
}

void CheckPoint(vtkPolyData* output, vtkIdType i, const Point& expected)
{
  for (int k = 0; k < 3; ++k)
  {
    CHECK_NEAR(output->GetPoint(i)[k], expected[k], 1e-14);
  }
}

void TestSphere()
{
  const double nan = std::nan("");
  vtkNew<vtkSplineEvaluator> evaluator;
  const auto table = MakeTable(2, { 0, 1, 1, 1, 2.5, 2, nan, 1, 5, 1, 1, 3, 0, 0 });
  vtkNew<vtkStringArray> labels;
  labels->SetName("Label");
  for (const char* label : { "a", "b", "c", "d", "e", "f", "g" })
  {
    labels->InsertNextValue(label);
  }
  table->AddColumn(labels);
  evaluator->SetInputData(table);
  evaluator->SetSourceData(MakeSphere());
  evaluator->Update();
  vtkPolyData* output = evaluator->GetOutput();
  CHECK(output->GetNumberOfPoints() == 6);
  CHECK(output->GetNumberOfVerts() == 6);
  CHECK(output->GetPoints()->GetDataType() == VTK_DOUBLE);
  CheckPoint(output, 0, { { 1, 0, 0 } });
  CheckPoint(output, 1, { { 0, 1, 0 } });
  CheckPoint(output, 2, { { 0, 0, 1 } });
  CheckPoint(output, 3, { { 0, 1, 0 } }); // u is closed: 5 is 1
  CheckPoint(output, 4, { { 0, 0, 1 } }); // v is not: 3 is moved to 2
  CheckPoint(output, 5, { { 0, 0, -1 } });
  const double rows[] = { 0, 1, 2, 4, 5, 6 };
  for (vtkIdType i = 0; i < 6; ++i)
  {
    CHECK(Value(output, "PointId", i) == rows[i]);
    CHECK(Value(output, "Clamped", i) == (i == 4 ? 1 : 0));
    for (int k = 0; k < 3; ++k)
    {
      CHECK_NEAR(Value(output, "Normal", i, k), output->GetPoint(i)[k], 1e-12);
    }
  }
  CHECK(output->GetPointData()->GetNormals() == PointArray(output, "Normal"));
  CHECK(!output->GetPointData()->HasArray("Tangent"));
  CHECK(
    vtkStringArray::SafeDownCast(output->GetPointData()->GetAbstractArray("Label"))->GetValue(3) ==
    "e");
  CHECK(FieldValue(output, "NumberOfSkippedPoints") == 1);

  evaluator->FlipNormalsOn();
  evaluator->Update();
  CHECK_NEAR(Value(evaluator->GetOutput(), "Normal", 0, 0), -1.0, 1e-14);
}

/// What point inversion writes can be read, and gives its closest points.
void TestInverse()
{
  vtkNew<vtkMultiBlockDataSet> model;
  model->SetBlock(0, MakeTorus());
  model->SetBlock(1, nullptr);
  model->SetBlock(2, MakeCircle());
  std::vector<Point> points = RandomPoints(200, 4.0);
  points[17][1] = std::nan("");
  vtkNew<vtkPointInversionFilter> inversion;
  inversion->SetInputData(MakePoints(points));
  inversion->SetSourceData(model);
  vtkNew<vtkSplineEvaluator> evaluator;
  evaluator->SetInputConnection(inversion->GetOutputPort());
  evaluator->SetSourceData(model);
  evaluator->Update();
  vtkPolyData* output = evaluator->GetOutput();
  CHECK(output->GetNumberOfPoints() == 199);
  CHECK(Value(output, "PointId", 17) == 18);
  int on_curve = 0;
  for (vtkIdType i = 0; i < 199; ++i)
  {
    const bool curve = Value(output, "FaceId", i) == 2;
    on_curve += curve ? 1 : 0;
    for (int k = 0; k < 3; ++k)
    {
      CHECK_NEAR(output->GetPoint(i)[k], Value(output, "ClosestPoint", i, k), 1e-13);
    }
    CHECK(std::isnan(Value(output, "Normal", i)) == curve);
    CHECK(std::isnan(Value(output, "Tangent", i)) == !curve);
    CHECK(Value(output, "Clamped", i) == 0);
  }
  CHECK(on_curve > 0 && on_curve < 199);
}

void TestCurveAndFunction()
{
  vtkNew<vtkSplineEvaluator> evaluator;
  evaluator->SetInputData(MakeTable(1, { 0, 1, -3 }));
  evaluator->SetSourceData(MakeParabola());
  evaluator->Update();
  vtkPolyData* output = evaluator->GetOutput();
  CheckPoint(output, 1, { { 1, 1, 0 } });
  CheckPoint(output, 2, { { -2, 4, 0 } });
  CHECK(Value(output, "Clamped", 2) == 1);
  CHECK_NEAR(Value(output, "Tangent", 1, 0), 1.0 / std::sqrt(5.0), 1e-14);
  CHECK(!output->GetPointData()->HasArray("Normal"));

  vtkNew<vtkSplineEvaluator> of_function;
  vtkNew<vtkParametricTorus> torus;
  of_function->SetParametricFunction(torus);
  of_function->SetInputData(MakeTable(2, { 0, 0 }));
  of_function->Update();
  CHECK_NEAR(Norm(PointOf(of_function->GetOutput(), 0)), 1.5, 1e-14);
  torus->SetRingRadius(3.0);
  of_function->Update();
  CHECK_NEAR(Norm(PointOf(of_function->GetOutput(), 0)), 3.5, 1e-14);
}

void TestNamesAndErrors()
{
  vtkNew<vtkSplineEvaluator> evaluator;
  vtkNew<MessageRecorder> recorder;
  recorder->Watch(evaluator);
  const auto errors = [&]
  {
    recorder->Clear();
    evaluator->Modified();
    evaluator->Update();
    return recorder->Errors;
  };
  evaluator->SetInputData(MakeTable(1, { 0 }));
  CHECK(Contains(errors(), "No geometry"));
  evaluator->SetSourceData(MakeSphere());
  CHECK(Contains(errors(), "has 1 component"));
  evaluator->SetParametersArrayName("UV");
  CHECK(Contains(errors(), "no array 'UV'"));
  CHECK(evaluator->GetOutput()->GetNumberOfPoints() == 0);

  evaluator->SetParametersArrayName("Parameters");
  const auto table = MakeTable(2, { 0.5, 0.5, 0.5, 0.5, 0.5, 0.5 });
  evaluator->SetInputData(table);
  vtkNew<vtkMultiBlockDataSet> model;
  model->SetBlock(0, MakeSquare(0.0));
  model->SetBlock(1, MakeSquare(1.0));
  evaluator->SetSourceData(model);
  CHECK(Contains(errors(), "several faces"));
  vtkNew<vtkIdTypeArray> faces;
  faces->SetName("Which");
  faces->InsertNextValue(1);
  faces->InsertNextValue(-1);
  faces->InsertNextValue(2);
  table->AddColumn(faces);
  evaluator->SetFaceIdArrayName("Which");
  CHECK(errors().empty());
  CHECK(evaluator->GetOutput()->GetNumberOfPoints() == 1);
  CheckPoint(evaluator->GetOutput(), 0, { { 0.5, 0.5, 1 } });
  CHECK(FieldValue(evaluator->GetOutput(), "NumberOfSkippedPoints") == 2);

  const auto bad = MakeSquare();
  bad->GetFieldData()->RemoveArray("KnotsU");
  model->SetBlock(0, bad);
  CHECK(errors().empty());
  CHECK(Contains(recorder->Warnings, "KnotsU"));
  evaluator->SetSourceData(bad);
  CHECK(Contains(errors(), "KnotsU"));

  evaluator->SetSourceData(MakeSphere());
  vtkNew<vtkPolyData> empty;
  evaluator->SetInputData(empty);
  CHECK(errors().empty());
  CHECK(evaluator->GetOutput()->GetPointData()->HasArray("Normal"));
  std::ostringstream text;
  evaluator->Print(text);
  CHECK(Contains(text.str(), "FaceIdArrayName: Which"));
}

} // namespace

int TestSplineEvaluator(int, char*[])
{
  return Run(
    []
    {
      TestSphere();
      TestInverse();
      TestCurveAndFunction();
      TestNamesAndErrors();
    });
}
