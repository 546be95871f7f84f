// SPDX-License-Identifier: BSD-3-Clause
// vtkSplineReader on files of GoTools: every number arrives, what is no spline is named and left
// out, what is malformed is refused with its line.
#include "FileTesting.h"

#include "vtkStreamingDemandDrivenPipeline.h"

using namespace testing;

namespace
{

std::string folder;

const char* const kCircle = "130 1 0 0\n3\n1.5\n0 0 0\n0 0 1\n1 0 0\n0 6.28\n0\n";

void TestGoTools()
{
  WriteText(folder + "/several.g2", std::string(files::kGoTools) + kCircle + files::kGoTools);
  const ReadResult result = ReadSplines(folder + "/several.g2");
  CHECK(result.errors.empty());
  CHECK(Contains(result.warnings, "line 21: the Circle (class 130) is left out"));
  CHECK(result.data->GetNumberOfBlocks() == 4);

  auto* curve = Net(result.data, 0);
  CHECK(Dimensions(curve)[0] == 3 && Dimensions(curve)[1] == 1);
  CHECK(FieldValues(curve, "KnotsU") == std::vector<double>({ 0, 0, 0, 1, 1, 1 }));
  CHECK(FieldValues(curve, "Degree") == std::vector<double>({ 2 }));
  CHECK(!curve->GetFieldData()->HasArray("KnotsV"));
  // Rational control points are divided by their weight.
  CHECK(curve->GetPoint(1)[0] == 1 && curve->GetPoint(1)[1] == 1 && curve->GetPoint(1)[2] == 0);
  CHECK(curve->GetPointData()->GetRationalWeights() == PointArray(curve, "RationalWeights"));
  CHECK(Value(curve, "RationalWeights", 1) == 0.5);

  auto* surface = Net(result.data, 1);
  CHECK(Dimensions(surface)[0] == 2 && Dimensions(surface)[1] == 3);
  CHECK(FieldValues(surface, "KnotsU") == std::vector<double>({ 0, 0, 2, 2 }));
  CHECK(FieldValues(surface, "KnotsV") == std::vector<double>({ 0, 0, 1.5, 3, 3 }));
  CHECK(FieldValues(surface, "Degree") == std::vector<double>({ 1, 1 }));
  CHECK(surface->GetPoint(2)[2] == 0.1 && surface->GetPoint(3)[2] == 1e-3);
  CHECK(!surface->GetPointData()->HasArray("RationalWeights"));
}

void TestGoToolsErrors()
{
  CheckRefused(folder + "/bad.g2",
    { { "", "no spline" }, { " \n", "no spline" },
      { "# comment", "line 1: expected the class of an object" },
      { "105 1 0 0", "class 105, which GoTools does not have" },
      { "100 1 0 5000", "the number of further values (0 to 100), found '5000'" },
      { "100 1 0 0\n4 0", "the dimension of space is 4" },
      { "100 1 0 0\n1 0\n2 2\n0 0 1 1\n3 4\n", "a function, not a geometry" },
      { "100 1 0 0\n3 2", "whether it is rational (0 to 1), found '2'" },
      { "100 1 0 0\n3 0\n2000000000 4\n0 0", "line 4: expected knot 2, found the end" },
      { "100 1 0 0\n3 0\n99999999999 4\n0 0", "line 3: expected the number of control points" },
      { "100 1 0 0\n3 0\n4 99\n", "the order (2 to 31), found '99'" },
      { "100 1 0 0\n3 0\n2 4\n", "2 control points are too few for the order 4" },
      { "100 1 0 0\n3 0\n2 2\n0 0 nan 1", "line 4: expected knot 2, found 'nan'" },
      { "100 1 0 0\n3 0\n2 2\n0 0 1e999 1", "expected knot 2, found '1e999'" },
      { "100 1 0 0\n3 0\n2 2\n0 0 1 0\n0 0 0 1 1 1", "line 1: the SplineCurve: KnotsU[3] = 0" },
      { "100 1 0 0\n3 0\n2 2\n0 0 1 1\n0 0 0 1 1",
        "coordinate 2 of control point 1, found the end" },
      { "100 1 0 0\n2 1\n2 2\n0 0 1 1\n0 0 0 1 1 1",
        "the weight of control point 0 is not positive" },
      { std::string(files::kGoTools) + "7,5", "line 21: expected the class of an object" },
      { kCircle, "no spline; line 1: the Circle (class 130) is left out" } });
}

void TestFiles()
{
  CHECK(Contains(ReadSplines(folder + "/none.g2").errors, "none.g2: it cannot be opened"));
  CHECK(Contains(ReadSplines(folder).errors, "it is a folder"));
  const std::string unknown = folder + "/spline.abc";
  WriteText(unknown, files::kGoTools);
  CHECK(Contains(ReadSplines(unknown).errors, "the extension '.abc'"));
  CHECK(ReadSplines(unknown, vtkSplineReader::GO_TOOLS).data->GetNumberOfBlocks() == 2);
  CHECK(Contains(ReadSplines(unknown, vtkSplineReader::GEOMDL).errors, "it is no JSON"));
  vtkNew<vtkSplineReader> reader;
  vtkNew<MessageRecorder> recorder;
  recorder->Watch(reader);
  reader->Update();
  CHECK(Contains(recorder->Errors, "No file name"));

  const std::string path = folder + "/piece.g2";
  WriteText(path, files::kGoTools);
  CHECK(reader->CanReadFile(path.c_str()) == 1);
  CHECK(reader->CanReadFile(unknown.c_str()) == 0 && reader->CanReadFile(nullptr) == 0);
  reader->SetFileName(path.c_str());
  vtkNew<vtkInformation> request;
  request->Set(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER(), 1);
  request->Set(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES(), 2);
  recorder->Clear();
  reader->Update(request);
  CHECK(recorder->Errors.empty() && reader->GetOutput()->GetNumberOfBlocks() == 0);
  request->Set(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER(), 0);
  reader->Update(request);
  CHECK(reader->GetOutput()->GetNumberOfBlocks() == 2);
  std::ostringstream text;
  reader->Print(text);
  CHECK(Contains(text.str(), "piece.g2"));
  CHECK(Contains(text.str(), "Format: Auto"));
  reader->SetFormatToGeomdl();
  CHECK(std::string(reader->GetFormatAsString()) == "Geomdl");
}

} // namespace

int TestSplineReader(int argc, char* argv[])
{
  return Run(
    [&]
    {
      folder = OutputFolder(argc, argv);
      TestGoTools();
      TestGoToolsErrors();
      TestFiles();
    });
}
