// SPDX-License-Identifier: BSD-3-Clause
// Arrays of vtkPointInversionFilter: names, types, numbers of components, and values that are known
// on a sphere, a torus and a circle.
#include "FilterTesting.h"

#include "vtkCellArray.h"
#include "vtkFloatArray.h"
#include "vtkPointInversionFilter.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"

using namespace testing;

namespace
{

constexpr double kTight = 1e-12;

void CheckArray(vtkDataObject* data, const char* name, int type, int components, vtkIdType tuples)
{
  vtkDataArray* array = PointArray(data, name);
  CHECK(array->GetDataType() == type);
  CHECK(array->GetNumberOfComponents() == components);
  CHECK(array->GetNumberOfTuples() == tuples);
}

void CheckSurfaceArrays(vtkDataObject* data, vtkIdType tuples)
{
  CheckArray(data, "Parameters", VTK_DOUBLE, 2, tuples);
  CheckArray(data, "Distance", VTK_DOUBLE, 1, tuples);
  CheckArray(data, "SignedDistance", VTK_DOUBLE, 1, tuples);
  CheckArray(data, "ClosestPoint", VTK_DOUBLE, 3, tuples);
  CheckArray(data, "Normal", VTK_DOUBLE, 3, tuples);
  CheckArray(data, "FaceId", VTK_ID_TYPE, 1, tuples);
  CheckArray(data, "Status", VTK_INT, 1, tuples);
  CheckArray(data, "FootType", VTK_INT, 1, tuples);
  CheckArray(data, "Isolated", VTK_INT, 1, tuples);
  CheckArray(data, "Iterations", VTK_INT, 1, tuples);
  CHECK(!vtkDataSet::SafeDownCast(data)->GetPointData()->HasArray("Tangent"));
}

void TestSphere()
{
  std::vector<Point> positions = RandomPoints(500, 2.0);
  positions.push_back({ { 0, 0, 2 } });
  positions.push_back({ { 1e-9, 0, 2 } });
  const auto input = MakePoints(positions);
  AddNumbers(input->GetPointData(), "Temperature", std::vector<double>(positions.size(), 7.0));

  vtkNew<vtkPointInversionFilter> filter;
  filter->SetInputData(input);
  filter->SetSourceData(MakeSphere());
  filter->Update();
  auto* output = vtkPolyData::SafeDownCast(filter->GetOutput());
  CHECK(output != nullptr);
  const auto count = static_cast<vtkIdType>(positions.size());
  CheckSurfaceArrays(output, count);
  CHECK(output->GetPointData()->GetScalars() == PointArray(output, "SignedDistance"));
  CHECK(Value(output, "Temperature", 3) == 7.0);
  CHECK(output->GetPointData()->GetNormals() == nullptr);

  for (vtkIdType i = 0; i < count; ++i)
  {
    const double radius = Norm(positions[i]);
    CHECK_NEAR(Value(output, "SignedDistance", i), radius - 1.0, kTight);
    CHECK_NEAR(Value(output, "Distance", i), std::abs(radius - 1.0), kTight);
    for (int k = 0; k < 3; ++k)
    {
      CHECK_NEAR(Value(output, "ClosestPoint", i, k), positions[i][k] / radius, 1e-9);
      CHECK_NEAR(Value(output, "Normal", i, k), positions[i][k] / radius, 1e-9);
    }
    CHECK(Value(output, "FaceId", i) == 0);
    CHECK(Value(output, "Status", i) == vtkPointInversionFilter::CERTIFIED);
    CHECK(Value(output, "Isolated", i) == 1);
    CHECK(Value(output, "Iterations", i) >= 1);
    // Meridians are circles: z = sin of the latitude, which v knows up to its rational speed.
    const double v = Value(output, "Parameters", i, 1);
    CHECK(v >= 0.0 && v <= 2.0);
    CHECK((v > 1.0) == (positions[i][2] > 0.0));
  }
  CHECK(Value(output, "FootType", 0) == vtkPointInversionFilter::INTERIOR);
  CHECK(Value(output, "FootType", 500) == vtkPointInversionFilter::DEGENERATE);
  CHECK_NEAR(Value(output, "Normal", 500, 2), 1.0, kTight);

  // === Output 1: the feet
  vtkPolyData* feet = filter->GetFootPointsOutput();
  CheckSurfaceArrays(feet, count);
  CHECK(feet->GetPoints()->GetDataType() == VTK_DOUBLE);
  CHECK(feet->GetNumberOfVerts() == count);
  CHECK(feet->GetPointData()->GetNormals() == PointArray(feet, "Normal"));
  CHECK(!feet->GetPointData()->HasArray("BlockId"));
  for (vtkIdType i = 0; i < count; ++i)
  {
    CHECK(Value(feet, "PointId", i) == i);
    CHECK(feet->GetPoint(i)[1] == Value(output, "ClosestPoint", i, 1));
  }

  // === Statistics
  double sum = 0.0;
  double largest = -10.0;
  for (const Point& position : positions)
  {
    sum += Norm(position) - 1.0;
    largest = std::max(largest, Norm(position) - 1.0);
  }
  CHECK(FieldValue(output, "DistanceCount") == count);
  CHECK_NEAR(FieldValue(output, "DistanceMean"), sum / count, kTight);
  CHECK_NEAR(FieldValue(output, "DistanceMaximum"), largest, kTight);
  CHECK(FieldValue(output, "DistanceMinimum") < 0.0);
  CHECK(FieldValue(output, "DistanceRMS") > 0.0);
  CHECK(FieldValue(output, "DistanceStandardDeviation") > 0.0);
  CHECK(FieldValue(output, "DistancePercentile95") > 0.0);
  CHECK(FieldValue(output, "OutOfToleranceFraction") == 0.0);
  CHECK(FieldValue(output, "StatusCounts", 0) == count);
  CHECK(FieldValue(output, "StatusCounts", 5) == 0);
  vtkTable* table = filter->GetFaceStatisticsOutput();
  CHECK(table->GetNumberOfRows() == 1);
  CHECK(table->GetValueByName(0, "Count").ToInt() == count);
  CHECK(table->GetValueByName(0, "Maximum").ToDouble() == FieldValue(output, "DistanceMaximum"));
  CHECK(table->GetValueByName(0, "MaximumAbsolute").ToDouble() ==
    std::max(-FieldValue(output, "DistanceMinimum"), FieldValue(output, "DistanceMaximum")));

  // === Sign, tolerance and prefix
  filter->FlipNormalsOn();
  filter->SetDeviationTolerance(0.5);
  filter->SetArrayNamePrefix("Scan");
  filter->Update();
  output = vtkPolyData::SafeDownCast(filter->GetOutput());
  CHECK(!output->GetPointData()->HasArray("SignedDistance"));
  int outside = 0;
  for (vtkIdType i = 0; i < count; ++i)
  {
    CHECK_NEAR(Value(output, "ScanSignedDistance", i), 1.0 - Norm(positions[i]), kTight);
    CHECK_NEAR(Value(output, "ScanNormal", i, 0), -positions[i][0] / Norm(positions[i]), 1e-9);
    outside += std::abs(Norm(positions[i]) - 1.0) > 0.5 ? 1 : 0;
  }
  CHECK_NEAR(FieldValue(output, "ScanOutOfToleranceFraction"), double(outside) / count, kTight);
}

void TestTorus()
{
  const std::vector<Point> positions = RandomPoints(500, 4.0, 2);
  vtkNew<vtkPointInversionFilter> filter;
  filter->SetInputData(MakePoints(positions, VTK_FLOAT));
  filter->SetSourceData(MakeTorus());
  filter->Update();
  vtkDataObject* output = filter->GetOutput();
  CHECK(vtkPointSet::SafeDownCast(output)->GetPoints()->GetDataType() == VTK_FLOAT);
  CheckSurfaceArrays(output, 500);
  for (vtkIdType i = 0; i < 500; ++i)
  {
    Point single;
    for (int k = 0; k < 3; ++k)
    {
      single[k] = static_cast<float>(positions[i][k]);
    }
    CHECK_NEAR(Value(output, "SignedDistance", i), TorusDistance(single), 1e-11);
  }
}

void TestStatuses()
{
  const double nan = std::nan("");
  vtkNew<vtkPointInversionFilter> filter;
  filter->SetInputData(MakePoints({ { { nan, 0, 0 } }, { { 100, 0, 0 } }, { { 0, 0, 0 } },
    { { 0, VTK_DOUBLE_MAX * 1e10, 0 } }, { { 1.5, 0, 0 } } }));
  filter->SetSourceData(MakeSphere());
  filter->SetMaximumDistance(10.0);
  filter->Update();
  vtkDataObject* output = filter->GetOutput();
  const int expected[] = { 4, 3, 0, 4, 0 };
  for (vtkIdType i = 0; i < 5; ++i)
  {
    CHECK(Value(output, "Status", i) == expected[i]);
    if (expected[i] > 1)
    {
      for (const char* name :
        { "Parameters", "Distance", "SignedDistance", "ClosestPoint", "Normal" })
      {
        for (int k = 0; k < PointArray(output, name)->GetNumberOfComponents(); ++k)
        {
          CHECK(std::isnan(Value(output, name, i, k)));
        }
      }
      for (const char* name : { "FaceId", "FootType", "Isolated", "Iterations" })
      {
        CHECK(Value(output, name, i) == -1);
      }
    }
  }
  CHECK(Value(output, "Isolated", 2) == 0); // the centre
  CHECK(Value(output, "Isolated", 4) == 1);
  CHECK(filter->GetFootPointsOutput()->GetNumberOfPoints() == 2);
  CHECK(Value(filter->GetFootPointsOutput(), "PointId", 1) == 4);
  CHECK(FieldValue(output, "DistanceCount") == 2);
  CHECK(FieldValue(output, "StatusCounts", 4) == 2);

  // === Segments
  filter->FootSegmentsOn();
  filter->Update();
  vtkPolyData* segments = filter->GetFootPointsOutput();
  CHECK(segments->GetNumberOfLines() == 2);
  CHECK(segments->GetNumberOfVerts() == 0);
  CHECK(segments->GetNumberOfPoints() == 4);
  CHECK(segments->GetPoint(2)[0] == 1.5);
  CHECK_NEAR(segments->GetPoint(3)[0], 1.0, kTight);
  CHECK_NEAR(Value(segments, "Distance", 2), 0.5, kTight);
  CHECK_NEAR(Value(segments, "Distance", 3), 0.5, kTight);
}

void TestCurve()
{
  const std::vector<Point> positions = RandomPoints(100, 2.0, 3);
  vtkNew<vtkPointInversionFilter> filter;
  filter->SetInputData(MakePoints(positions));
  filter->SetSourceData(MakeCircle());
  filter->Update();
  auto* output = vtkPolyData::SafeDownCast(filter->GetOutput());
  CheckArray(output, "Parameters", VTK_DOUBLE, 1, 100);
  CheckArray(output, "Tangent", VTK_DOUBLE, 3, 100);
  CHECK(!output->GetPointData()->HasArray("SignedDistance"));
  CHECK(!output->GetPointData()->HasArray("Normal"));
  CHECK(output->GetPointData()->GetScalars() == PointArray(output, "Distance"));
  for (vtkIdType i = 0; i < 100; ++i)
  {
    const Point& p = positions[i];
    const double radius = std::hypot(p[0], p[1]);
    CHECK_NEAR(Value(output, "Distance", i), std::hypot(radius - 1.0, p[2]), kTight);
    CHECK_NEAR(Value(output, "Tangent", i, 0), -p[1] / radius, 1e-9);
    CHECK_NEAR(Value(output, "Tangent", i, 1), p[0] / radius, 1e-9);
  }
}

void TestReplacedAndKeptArrays()
{
  const auto input = MakePoints(RandomPoints(4, 1.0));
  vtkNew<vtkDoubleArray> stale;
  stale->SetName("Distance");
  stale->SetNumberOfComponents(3);
  stale->SetNumberOfTuples(4);
  stale->Fill(5.0);
  input->GetPointData()->SetVectors(stale);
  vtkNew<vtkFloatArray> normals;
  normals->SetName("ScanNormals");
  normals->SetNumberOfComponents(3);
  normals->SetNumberOfTuples(4);
  normals->Fill(1.0);
  input->GetPointData()->SetNormals(normals);

  vtkNew<vtkPointInversionFilter> filter;
  filter->SetInputData(input);
  filter->SetSourceData(MakeSphere());
  filter->Update();
  auto* output = vtkPolyData::SafeDownCast(filter->GetOutput());
  CheckArray(output, "Distance", VTK_DOUBLE, 1, 4);
  CHECK(output->GetPointData()->GetVectors() == nullptr);
  CHECK(output->GetPointData()->GetNormals() == normals);
  CHECK(input->GetPointData()->GetArray("Distance") == stale);
  CHECK(!input->GetPointData()->HasArray("Status"));
  CHECK(input->GetFieldData()->GetNumberOfArrays() == 0);

  // === Each array can be switched off
  const std::vector<std::pair<const char*, void (vtkPointInversionFilter::*)(bool)>> switches = {
    { "Parameters", &vtkPointInversionFilter::SetGenerateParameters },
    { "SignedDistance", &vtkPointInversionFilter::SetGenerateSignedDistance },
    { "ClosestPoint", &vtkPointInversionFilter::SetGenerateClosestPoint },
    { "Normal", &vtkPointInversionFilter::SetGenerateNormal },
    { "FaceId", &vtkPointInversionFilter::SetGenerateFaceId },
    { "Status", &vtkPointInversionFilter::SetGenerateStatus },
    { "FootType", &vtkPointInversionFilter::SetGenerateFootType },
    { "Isolated", &vtkPointInversionFilter::SetGenerateIsolated },
    { "Iterations", &vtkPointInversionFilter::SetGenerateIterations }
  };
  for (const auto& [name, set] : switches)
  {
    (filter->*set)(false);
    filter->Update();
    output = vtkPolyData::SafeDownCast(filter->GetOutput());
    CHECK(!output->GetPointData()->HasArray(name));
    CHECK(!filter->GetFootPointsOutput()->GetPointData()->HasArray(name));
    CHECK(output->GetPointData()->HasArray("Distance"));
    (filter->*set)(true);
  }
  CHECK(filter->GetNumberOfModelBuilds() == 1);
  filter->SetSourceData(MakeCircle());
  filter->GenerateTangentOff();
  filter->GenerateDistanceOff();
  filter->SetArrayNamePrefix("New");
  filter->Update();
  output = vtkPolyData::SafeDownCast(filter->GetOutput());
  CHECK(!output->GetPointData()->HasArray("NewTangent"));
  CHECK(!output->GetPointData()->HasArray("NewDistance"));
}

/// More points than the core hands over at a time.
void TestManyPoints()
{
  constexpr vtkIdType kCount = 70000;
  std::vector<Point> positions = RandomPoints(kCount, 2.0, 5);
  vtkNew<vtkPointInversionFilter> filter;
  filter->SetInputData(MakePoints(positions));
  filter->SetSourceData(MakeSphere());
  filter->Update();
  vtkPolyData* feet = filter->GetFootPointsOutput();
  CHECK(PointArray(feet, "Distance") == PointArray(filter->GetOutput(), "Distance"));
  CHECK(std::string(feet->GetPoints()->GetData()->GetName()) == "Points");

  // === Points without a foot leave no row
  for (const vtkIdType i : { vtkIdType{ 5 }, vtkIdType{ 40000 }, kCount - 1 })
  {
    positions[i][1] = NAN;
  }
  filter->SetInputData(MakePoints(positions));
  filter->Update();
  vtkDataObject* output = filter->GetOutput();
  CHECK(feet->GetNumberOfPoints() == kCount - 3);
  CHECK(feet->GetNumberOfVerts() == kCount - 3);
  vtkIdType row = 0;
  for (vtkIdType i = 0; i < kCount; ++i)
  {
    if (std::isnan(positions[i][1]))
    {
      CHECK(std::isnan(Value(output, "Distance", i)));
      continue;
    }
    CHECK_NEAR(Value(output, "SignedDistance", i), Norm(positions[i]) - 1.0, kTight);
    CHECK(Value(feet, "PointId", row) == i);
    CHECK(Value(feet, "Parameters", row, 1) == Value(output, "Parameters", i, 1));
    CHECK(Value(feet, "Status", row) == Value(output, "Status", i));
    CHECK(feet->GetPoint(row)[2] == Value(output, "ClosestPoint", i, 2));
    ++row;
  }
  CHECK(FieldValue(output, "DistanceCount") == kCount - 3);
}

void TestEmptyInputAndTypes()
{
  vtkNew<vtkPointInversionFilter> filter;
  vtkNew<vtkPolyData> empty;
  filter->SetInputData(empty);
  filter->SetSourceData(MakeSphere());
  filter->Update();
  CheckSurfaceArrays(filter->GetOutput(), 0);
  CheckSurfaceArrays(filter->GetFootPointsOutput(), 0);
  CHECK(FieldValue(filter->GetOutput(), "DistanceCount") == 0);
  CHECK(std::isnan(FieldValue(filter->GetOutput(), "DistanceMean")));
  CHECK(filter->GetFaceStatisticsOutput()->GetNumberOfRows() == 1);

  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(MakePoints(RandomPoints(3, 1.0))->GetPoints());
  filter->SetInputData(grid);
  filter->Update();
  CHECK(vtkUnstructuredGrid::SafeDownCast(filter->GetOutput()) != nullptr);
  CheckSurfaceArrays(filter->GetOutput(), 3);

  filter->SetInputData(MakeSphere()); // its own control points
  filter->Update();
  auto* net = vtkStructuredGrid::SafeDownCast(filter->GetOutput());
  CHECK(net != nullptr);
  int dimensions[3];
  net->GetDimensions(dimensions);
  CHECK(dimensions[0] == 9 && dimensions[1] == 5);
  CheckSurfaceArrays(net, 45);
  CHECK(net->GetPointData()->GetRationalWeights() != nullptr);
  CHECK(net->GetFieldData()->HasArray("KnotsU"));
}

} // namespace

int TestPointInversionFilter(int, char*[])
{
  return Run(
    []
    {
      TestSphere();
      TestTorus();
      TestStatuses();
      TestCurve();
      TestReplacedAndKeptArrays();
      TestManyPoints();
      TestEmptyInputAndTypes();
    });
}
