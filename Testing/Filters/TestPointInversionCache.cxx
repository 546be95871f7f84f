// SPDX-License-Identifier: BSD-3-Clause
// The search structure is kept by content: not built again for other modification times or points,
// for other options of the queries, built again for every change of content or of what enters it.
#include "FilterTesting.h"

#include "vtkCompositeDataSet.h"
#include "vtkInformation.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkParametricTorus.h"
#include "vtkPointInversionFilter.h"
#include "vtkXMLStructuredGridReader.h"
#include "vtkXMLStructuredGridWriter.h"

using namespace testing;

namespace
{

class Builds
{
public:
  explicit Builds(vtkPointInversionFilter* filter)
    : Filter(filter)
  {
  }

  /// Whether an update built the structure anew.
  bool Rebuilt()
  {
    const int before = this->Filter->GetNumberOfModelBuilds();
    this->Filter->Modified();
    this->Filter->Update();
    return this->Filter->GetNumberOfModelBuilds() == before + 1;
  }

private:
  vtkPointInversionFilter* Filter;
};

void TestNet()
{
  vtkNew<vtkPointInversionFilter> filter;
  Builds builds(filter);
  filter->SetInputData(MakePoints(RandomPoints(5, 2.0)));
  const auto sphere = MakeSphere();
  filter->SetSourceData(sphere);
  CHECK(filter->GetNumberOfModelBuilds() == 0);
  CHECK(builds.Rebuilt());
  CHECK(!builds.Rebuilt());

  // === The same content
  sphere->Modified();
  sphere->GetPoints()->Modified();
  CHECK(!builds.Rebuilt());
  filter->SetSourceData(MakeSphere());
  CHECK(!builds.Rebuilt());
  filter->SetInputData(MakePoints(RandomPoints(6, 2.0)));
  CHECK(!builds.Rebuilt());
  filter->SetArrayNamePrefix("X");
  filter->SetDeviationTolerance(1.0);
  filter->FootSegmentsOn();
  filter->GenerateStatusOff();
  CHECK(!builds.Rebuilt());
  AddNumbers(sphere->GetPointData(), "Pressure", std::vector<double>(45, 1.0));
  filter->SetSourceData(sphere);
  CHECK(!builds.Rebuilt());

  // === Other content
  double point[3];
  sphere->GetPoint(44, point);
  sphere->GetPoints()->SetPoint(44, point[0], point[1], point[2] + 1e-12);
  CHECK(builds.Rebuilt());
  auto* weights = PointArray(sphere, "RationalWeights");
  weights->SetComponent(3, 0, weights->GetComponent(3, 0) * 1.001);
  CHECK(builds.Rebuilt());
  sphere->GetFieldData()->GetArray("KnotsU")->SetComponent(11, 0, 4.5);
  sphere->GetFieldData()->GetArray("KnotsU")->SetComponent(10, 0, 4.5);
  sphere->GetFieldData()->GetArray("KnotsU")->SetComponent(9, 0, 4.5);
  CHECK(builds.Rebuilt());
  AddNumbers(sphere->GetFieldData(), "Orientation", { -1 });
  CHECK(builds.Rebuilt());

  // The same arrays as another part of a net are no geometry.
  vtkNew<MessageRecorder> recorder;
  recorder->Watch(filter);
  sphere->SetExtent(3, 11, 0, 4, 0, 0);
  CHECK(!builds.Rebuilt());
  CHECK(Contains(recorder->Errors, "starts at (3, 0, 0)"));
  sphere->SetExtent(0, 8, 0, 4, 0, 0);
  CHECK(builds.Rebuilt());

  filter->FlipNormalsOn();
  CHECK(builds.Rebuilt());
  CHECK(!builds.Rebuilt());
}

/// Options of the queries alone need nothing new; what is built for some of them is kept.
void TestOptions()
{
  vtkNew<vtkPointInversionFilter> filter;
  Builds builds(filter);
  filter->SetInputData(MakePoints(RandomPoints(5, 2.0)));
  filter->SetSourceData(MakeSphere());
  CHECK(builds.Rebuilt());

  filter->SetMaximumDistance(100.0);
  CHECK(!builds.Rebuilt());
  filter->SetMaximumDistance(1e-6);
  CHECK(!builds.Rebuilt());
  CHECK(Value(filter->GetOutput(), "Status", 0) == 3); // and yet it acts
  filter->SetMaximumDistance(VTK_DOUBLE_MAX);
  filter->SetCertificateTolerance(0.0);
  CHECK(!builds.Rebuilt());
  CHECK(Value(filter->GetOutput(), "Status", 0) == 1);
  filter->SetPointTolerance(1e-10);
  filter->SetCosineTolerance(1e-6);
  filter->SetStepTolerance(1e-10);
  filter->SetMaximumIterations(50);
  filter->SetTrustRadius(0.1);
  filter->ColumnScalingOff();
  filter->IsocurveFallbackOff();
  filter->SetNumberOfSeeds(2);
  filter->SetMethodToGaussNewton();
  CHECK(!builds.Rebuilt());
  filter->SetSearchToSeeded();
  CHECK(!builds.Rebuilt());
  filter->SetSearchToLocal();
  CHECK(!builds.Rebuilt());

  // A method that the geometry refuses costs nothing but the update.
  vtkNew<MessageRecorder> recorder;
  recorder->Watch(filter);
  filter->SetMethodToFirstOrder();
  CHECK(!builds.Rebuilt());
  CHECK(Contains(recorder->Errors, "Method FirstOrder is for curves alone"));
  filter->SetMethodToNewton();
  CHECK(!builds.Rebuilt());

  // === What enters the structure
  filter->SetSeedResolution(9);
  CHECK(builds.Rebuilt());
  filter->SetSearchToGlobal();
  CHECK(!builds.Rebuilt());
  filter->AllFeetOn();
  CHECK(!builds.Rebuilt());
  filter->AllFeetOff();
  filter->OrthogonalOnlyOn();
  CHECK(!builds.Rebuilt());
  filter->OrthogonalOnlyOff();
  filter->SetFixedDirection(0, 0, 1);
  CHECK(!builds.Rebuilt());
  filter->SetFixedDirection(0, 0, 0);
  CHECK(!builds.Rebuilt());

  // Seeds and lines do without the certified search, which is built where it is asked for.
  vtkNew<vtkPointInversionFilter> seeded;
  Builds later(seeded);
  seeded->SetInputData(filter->GetInput());
  seeded->SetSourceData(MakeSphere());
  seeded->SetSearchToSeeded();
  CHECK(later.Rebuilt());
  seeded->SetSearchToGlobal();
  CHECK(later.Rebuilt());
  seeded->SetSearchToSeeded();
  CHECK(!later.Rebuilt());
  seeded->SetSearchToGlobal();
  CHECK(!later.Rebuilt());
}

void TestComposite()
{
  vtkNew<vtkMultiBlockDataSet> model;
  model->SetBlock(0, MakeSquare(0.0));
  model->SetBlock(1, MakeSquare(2.0));
  vtkNew<vtkPointInversionFilter> filter;
  Builds builds(filter);
  filter->SetInputData(MakePoints(RandomPoints(5, 2.0)));
  filter->SetSourceData(model);
  CHECK(builds.Rebuilt());
  vtkNew<vtkMultiBlockDataSet> copy;
  copy->DeepCopy(model);
  filter->SetSourceData(copy);
  CHECK(!builds.Rebuilt());

  // A null block in between, another order, a nested block and a name change the faces.
  copy->SetBlock(2, copy->GetBlock(1));
  copy->SetBlock(1, nullptr);
  CHECK(builds.Rebuilt());
  copy->SetBlock(0, MakeSquare(2.0));
  copy->SetBlock(2, MakeSquare(0.0));
  CHECK(builds.Rebuilt());
  vtkNew<vtkMultiBlockDataSet> nested;
  nested->SetBlock(0, MakeSquare(0.0));
  copy->SetBlock(2, nested);
  CHECK(builds.Rebuilt());
  copy->GetMetaData(0u)->Set(vtkCompositeDataSet::NAME(), "wing");
  CHECK(builds.Rebuilt());
  CHECK(!builds.Rebuilt());
}

/// Whatever piece of the points is wanted, the geometry is asked for whole, and built once.
void TestPieces()
{
  vtkNew<vtkXMLStructuredGridWriter> writer;
  writer->WriteToOutputStringOn();
  writer->SetInputData(MakeSphere());
  writer->Write();
  vtkNew<vtkXMLStructuredGridReader> reader;
  reader->ReadFromInputStringOn();
  reader->SetInputString(writer->GetOutputString());

  const std::vector<Point> positions = RandomPoints(10, 2.0);
  vtkNew<vtkPointInversionFilter> filter;
  filter->SetInputData(MakePoints(positions));
  filter->SetSourceConnection(reader->GetOutputPort());
  for (const int piece : { 1, 0 })
  {
    filter->UpdatePiece(piece, 2, 0);
    CHECK(filter->GetNumberOfModelBuilds() == 1);
    CHECK(vtkStructuredGrid::SafeDownCast(filter->GetSource())->GetNumberOfPoints() == 45);
    CHECK_NEAR(Value(filter->GetOutput(), "SignedDistance", 0), Norm(positions[0]) - 1.0, 1e-12);
  }
}

void TestFunction()
{
  vtkNew<vtkParametricTorus> torus;
  vtkNew<vtkPointInversionFilter> filter;
  filter->SetInputData(MakePoints({ { { 4, 0, 0 } } }));
  filter->SetParametricFunction(torus);
  filter->Update();
  CHECK_NEAR(Value(filter->GetOutput(), "Distance", 0), 2.5, 1e-9);
  filter->Update();
  CHECK(filter->GetNumberOfModelBuilds() == 1);
  // The filter's modification time includes the function's.
  torus->SetRingRadius(2.0);
  filter->Update();
  CHECK(filter->GetNumberOfModelBuilds() == 2);
  CHECK_NEAR(Value(filter->GetOutput(), "Distance", 0), 1.5, 1e-9);
  // A source goes before it.
  filter->SetSourceData(MakeSphere());
  filter->Update();
  CHECK_NEAR(Value(filter->GetOutput(), "Distance", 0), 3.0, 1e-12);
}

} // namespace

int TestPointInversionCache(int, char*[])
{
  return Run(
    []
    {
      TestNet();
      TestOptions();
      TestComposite();
      TestPieces();
      TestFunction();
    });
}
