// SPDX-License-Identifier: BSD-3-Clause
// Every message of vtkPointInversionFilter about bad geometry or missing input: the array, the
// index and the value are named, the outputs are empty, and good faces of a model go on.
#include "FilterTesting.h"

#include "vtkCellArray.h"
#include "vtkCompositeDataSet.h"
#include "vtkExtractGrid.h"
#include "vtkInformation.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkMultiPieceDataSet.h"
#include "vtkParametricEllipsoid.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPointInversionFilter.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"

using namespace testing;

namespace
{

/// Executes with a source and returns the error text; checks that there is none iff outputs are
/// full.
std::string ErrorOf(vtkDataObject* source)
{
  vtkNew<vtkPointInversionFilter> filter;
  vtkNew<MessageRecorder> recorder;
  recorder->Watch(filter);
  filter->SetInputData(MakePoints({ { { 0, 0, 2 } } }));
  filter->SetSourceData(source);
  filter->Update();
  auto* output = vtkPolyData::SafeDownCast(filter->GetOutput());
  CHECK(output != nullptr);
  CHECK((output->GetNumberOfPoints() == 0) == !recorder->Errors.empty());
  CHECK((filter->GetFootPointsOutput()->GetNumberOfPoints() == 0) == !recorder->Errors.empty());
  CHECK(recorder->Warnings.empty());
  return recorder->Errors;
}

void CheckRefused(vtkDataObject* source, const std::vector<std::string>& parts)
{
  const std::string error = ErrorOf(source);
  for (const std::string& part : parts)
  {
    if (!Contains(error, part))
    {
      throw std::runtime_error("expected '" + part + "' in '" + error + "'");
    }
  }
}

vtkDoubleArray* FieldArray(vtkDataObject* data, const char* name)
{
  return vtkDoubleArray::SafeDownCast(data->GetFieldData()->GetArray(name));
}

void TestNets()
{
  CHECK(ErrorOf(MakeSphere()).empty());

  auto net = MakeSphere();
  net->GetFieldData()->RemoveArray("KnotsV");
  CheckRefused(net, { "KnotsV", "missing" });

  net = MakeSphere();
  FieldArray(net, "KnotsU")->SetValue(4, 0.25);
  CheckRefused(net, { "KnotsU[4]", "0.25" });

  net = MakeSphere();
  FieldArray(net, "KnotsV")->SetValue(2, std::nan(""));
  CheckRefused(net, { "KnotsV[2]", "nan" });

  net = MakeSphere();
  FieldArray(net, "KnotsU")->InsertNextValue(4);
  CheckRefused(net, { "Degree[0]", "2", "KnotsU", "degree 3" });

  net = MakeSphere();
  net->GetFieldData()->RemoveArray("Degree");
  CHECK(ErrorOf(net).empty());
  FieldArray(net, "KnotsU")->SetNumberOfTuples(10);
  CheckRefused(net, { "KnotsU has 10 values", "9 control points" });

  net = MakeSphere();
  AddNumbers(net->GetFieldData(), "Degree", { 2 });
  CheckRefused(net, { "Degree has 1 value" });

  net = MakeSphere();
  PointArray(net, "RationalWeights")->SetComponent(7, 0, 0.0);
  CheckRefused(net, { "eight", "7", "0" });

  net = MakeSphere();
  net->GetPointData()->RemoveArray("RationalWeights");
  vtkNew<vtkDoubleArray> vectors;
  vectors->SetName("RationalWeights");
  vectors->SetNumberOfComponents(3);
  vectors->SetNumberOfTuples(45);
  vectors->Fill(1.0);
  net->GetPointData()->AddArray(vectors);
  CheckRefused(net, { "RationalWeights has 3 components" });

  net = MakeSphere();
  net->GetPoints()->SetPoint(11, 1.0, std::nan(""), 0.0);
  CheckRefused(net, { "11", "nan" });

  net = MakeSphere();
  AddNumbers(net->GetFieldData(), "Orientation", { 0.5 });
  CheckRefused(net, { "Orientation[0] = 0.5" });

  net = MakeCircle();
  AddNumbers(net->GetFieldData(), "KnotsV", { 0, 1 });
  CheckRefused(net, { "(9, 1, 1)", "KnotsV" });

  net = MakeSphere();
  net->SetDimensions(9, 1, 5);
  CheckRefused(net, { "(9, 1, 5)" });

  vtkNew<vtkStructuredGrid> empty;
  CheckRefused(empty, { "no control points" });
}

void TestCutNets()
{
  vtkNew<vtkExtractGrid> extract;
  extract->SetInputData(MakeSphere());
  extract->SetVOI(2, 8, 0, 4, 0, 0);
  extract->Update();
  CheckRefused(extract->GetOutput(), { "cut" });
  extract->SetVOI(0, 6, 0, 4, 0, 0);
  extract->Update();
  CheckRefused(extract->GetOutput(), { "Degree[0]", "cut" });

  auto shifted = MakeSphere();
  shifted->SetExtent(3, 11, 0, 4, 0, 0);
  CheckRefused(shifted, { "starts at (3, 0, 0)" });
}

void TestWeightsByName()
{
  // vtkWarpVector and others drop the active flag; the name still counts.
  auto net = MakeSphere();
  net->GetPointData()->SetActiveAttribute(-1, vtkDataSetAttributes::RATIONALWEIGHTS);
  CHECK(net->GetPointData()->GetRationalWeights() == nullptr);
  vtkNew<vtkPointInversionFilter> filter;
  filter->SetInputData(MakePoints({ { { 1, 1, 1 } } }));
  filter->SetSourceData(net);
  filter->Update();
  CHECK_NEAR(Value(filter->GetOutput(), "Distance", 0), std::sqrt(3.0) - 1.0, 1e-12);
}

void TestOtherData()
{
  vtkNew<vtkMultiBlockDataSet> model;
  CheckRefused(model, { "no faces" });
  model->SetBlock(0, nullptr);
  CheckRefused(model, { "no faces" });
  model->SetBlock(0, MakePoints({ { { 0, 0, 0 } } }));
  CheckRefused(model, { "Face 0", "vtkPolyData" });

  vtkNew<vtkMultiPieceDataSet> pieces;
  pieces->SetPiece(0, MakeSquare());
  model->SetBlock(0, pieces);
  CHECK(ErrorOf(model).empty());
  pieces->SetPiece(1, MakeSquare(1.0));
  CheckRefused(model, { "2 pieces" });

  vtkNew<vtkMultiBlockDataSet> trimmed;
  trimmed->SetBlock(0, MakeSquare());
  trimmed->GetMetaData(0u)->Set(vtkCompositeDataSet::NAME(), "Surface");
  CHECK(ErrorOf(trimmed).empty());
  trimmed->SetBlock(1, MakeCircle());
  trimmed->GetMetaData(1u)->Set(vtkCompositeDataSet::NAME(), "Loop 0");
  CHECK(ErrorOf(trimmed).empty());
  // From (-2, 4) to (2, 4): no loop.
  trimmed->SetBlock(1, MakeParabola());
  trimmed->GetMetaData(1u)->Set(vtkCompositeDataSet::NAME(), "Loop 0");
  CheckRefused(trimmed, { "curve 0 of trim loop 0", "from (2, 4) to (-2, 4)" });
}

/// One bad face, or a trimmed one, never takes the others down.
void TestPartlyBadModel()
{
  auto bad = MakeSphere();
  FieldArray(bad, "KnotsU")->SetValue(4, 0.25);
  vtkNew<vtkMultiBlockDataSet> model;
  model->SetBlock(0, bad);
  model->GetMetaData(0u)->Set(vtkCompositeDataSet::NAME(), "wing");
  model->SetBlock(1, MakeSquare());

  vtkNew<vtkPointInversionFilter> filter;
  vtkNew<MessageRecorder> recorder;
  recorder->Watch(filter);
  filter->SetInputData(MakePoints({ { { 0.5, 0.5, 2 } } }));
  filter->SetSourceData(model);
  filter->Update();
  CHECK(recorder->Errors.empty());
  CHECK(Contains(recorder->Warnings, "Face 0 ('wing')"));
  CHECK(Contains(recorder->Warnings, "KnotsU[4]"));
  CHECK(Value(filter->GetOutput(), "FaceId", 0) == 1);
  CHECK(filter->GetFaceStatisticsOutput()->GetNumberOfRows() == 2);

  // The warning comes again when the model is taken from the cache.
  recorder->Clear();
  filter->Modified();
  filter->Update();
  CHECK(filter->GetNumberOfModelBuilds() == 1);
  CHECK(Contains(recorder->Warnings, "Face 0 ('wing')"));
}

void TestMissingInput()
{
  vtkNew<vtkPointInversionFilter> filter;
  vtkNew<MessageRecorder> recorder;
  recorder->Watch(filter);
  filter->SetInputData(MakePoints({ { { 0, 0, 2 } } }));
  CHECK(filter->GetSource() == nullptr);
  filter->Update();
  CHECK(Contains(recorder->Errors, "No geometry"));
  CHECK(vtkPolyData::SafeDownCast(filter->GetOutput())->GetNumberOfPoints() == 0);

  recorder->Clear();
  const auto sphere = MakeSphere();
  filter->SetSourceData(sphere);
  CHECK(filter->GetSource() == sphere);
  filter->SetFixedDirection(0, std::nan(""), 1);
  filter->Update();
  CHECK(Contains(recorder->Errors, "FixedDirection[1]"));

  recorder->Clear();
  filter->SetFixedDirection(0, 0, 1);
  filter->WarmStartOn();
  filter->Update();
  CHECK(Contains(recorder->Errors, "WarmStart"));

  recorder->Clear();
  filter->WarmStartOff();
  filter->SetStepTolerance(std::nan(""));
  filter->Update();
  CHECK(Contains(recorder->Errors, "StepTolerance"));

  recorder->Clear();
  filter->SetStepTolerance(1e-15);
  filter->SetMethodToCurvatureCircle();
  filter->Update();
  CHECK(Contains(recorder->Errors, "Method CurvatureCircle"));

  // All is well again.
  recorder->Clear();
  filter->SetMethodToNewton();
  filter->Update();
  CHECK(recorder->Errors.empty());
  CHECK(vtkPolyData::SafeDownCast(filter->GetOutput())->GetNumberOfPoints() == 1);
}

void TestParametricFunction()
{
  vtkNew<vtkParametricEllipsoid> ellipsoid;
  ellipsoid->SetMaximumU(ellipsoid->GetMinimumU());
  vtkNew<vtkPointInversionFilter> filter;
  vtkNew<MessageRecorder> recorder;
  recorder->Watch(filter);
  filter->SetInputData(MakePoints({ { { 0, 0, 2 } } }));
  filter->SetParametricFunction(ellipsoid);
  filter->Update();
  CHECK(Contains(recorder->Errors, "domain from 0 to 0 in u"));
}

} // namespace

int TestPointInversionErrors(int, char*[])
{
  return Run(
    []
    {
      TestNets();
      TestCutNets();
      TestWeightsByName();
      TestOtherData();
      TestPartlyBadModel();
      TestMissingInput();
      TestParametricFunction();
    });
}
