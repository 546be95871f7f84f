// SPDX-License-Identifier: BSD-3-Clause
// vtkSplineReader on files of GoTools: every number arrives, what is no spline is named and left
// out, what is malformed is refused with its line.
#include "FilterTesting.h"

#include "vtkCompositeDataSet.h"
#include "vtkInformation.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkSplineReader.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTestUtilities.h"

#include <fstream>
#include <memory>

using namespace testing;

namespace
{

std::string folder;

std::string Write(const std::string& name, const std::string& text)
{
  const std::string path = folder + "/" + name;
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

struct Result
{
  vtkSmartPointer<vtkMultiBlockDataSet> data;
  std::string errors, warnings;
};

Result Read(const std::string& path)
{
  vtkNew<vtkSplineReader> reader;
  vtkNew<MessageRecorder> recorder;
  recorder->Watch(reader);
  reader->SetFileName(path.c_str());
  reader->Update();
  return { reader->GetOutput(), recorder->Errors, recorder->Warnings };
}

std::vector<double> Field(vtkDataObject* data, const char* name)
{
  vtkDataArray* array = data->GetFieldData()->GetArray(name);
  std::vector<double> values;
  for (vtkIdType i = 0; array && i < array->GetNumberOfTuples(); ++i)
  {
    values.push_back(array->GetComponent(i, 0));
  }
  return values;
}

const char* const kCurve = "100 1 0 0\n"
                           "2 1\n"
                           "3 3\n"
                           "0 0 0 1 1 1\n"
                           "1 0 1\n"
                           "0.5 +0.5 0.5\n"
                           "0 1 1\n\n";
const char* const kSurface = "200 1 0 4 255 0 -5 255\n"
                             "3 0\n"
                             "2 2\n0 0 2 2\n"
                             "3 2\n0 0 1.5 3 3\n"
                             "0 0 0\n1 0 0\n0 1 0.1\n1 1 1e-3\n0 2 0\n1 2 0\n";
const char* const kCircle = "130 1 0 0\n3\n1.5\n0 0 0\n0 0 1\n1 0 0\n0 6.28\n0\n";

void TestGoTools()
{
  const Result result = Read(Write("several.g2", std::string(kCurve) + kCircle + kSurface));
  CHECK(result.errors.empty());
  CHECK(Contains(result.warnings, "line 9: the Circle (class 130) is left out"));
  CHECK(result.data->GetNumberOfBlocks() == 2);

  auto* curve = vtkStructuredGrid::SafeDownCast(result.data->GetBlock(0));
  CHECK(curve && curve->GetDimensions()[0] == 3 && curve->GetDimensions()[1] == 1);
  CHECK(Field(curve, "KnotsU") == std::vector<double>({ 0, 0, 0, 1, 1, 1 }));
  CHECK(Field(curve, "Degree") == std::vector<double>({ 2 }));
  CHECK(!curve->GetFieldData()->HasArray("KnotsV"));
  // Rational control points are divided by their weight.
  CHECK(curve->GetPoint(1)[0] == 1 && curve->GetPoint(1)[1] == 1 && curve->GetPoint(1)[2] == 0);
  CHECK(curve->GetPointData()->GetRationalWeights() == PointArray(curve, "RationalWeights"));
  CHECK(Value(curve, "RationalWeights", 1) == 0.5);

  auto* surface = vtkStructuredGrid::SafeDownCast(result.data->GetBlock(1));
  CHECK(surface && surface->GetDimensions()[0] == 2 && surface->GetDimensions()[1] == 3);
  CHECK(Field(surface, "KnotsU") == std::vector<double>({ 0, 0, 2, 2 }));
  CHECK(Field(surface, "KnotsV") == std::vector<double>({ 0, 0, 1.5, 3, 3 }));
  CHECK(Field(surface, "Degree") == std::vector<double>({ 1, 1 }));
  CHECK(surface->GetPoint(2)[2] == 0.1 && surface->GetPoint(3)[2] == 1e-3);
  CHECK(!surface->GetPointData()->HasArray("RationalWeights"));
}

void TestGoToolsErrors()
{
  const std::string cases[][2] = {
    { "", "no spline" },
    { " \n", "no spline" },
    { "# comment", "line 1: expected the class of an object" },
    { "105 1 0 0", "class 105, which GoTools does not have" },
    { "100 1 0 5000", "the number of further values (0 to 100), found '5000'" },
    { "100 1 0 0\n4 0", "the dimension of space is 4" },
    { "100 1 0 0\n3 2", "whether it is rational (0 to 1), found '2'" },
    { "100 1 0 0\n3 0\n2000000000 4\n0 0", "line 4: expected knot 2, found the end" },
    { "100 1 0 0\n3 0\n99999999999 4\n0 0", "line 3: expected the number of control points" },
    { "100 1 0 0\n3 0\n4 99\n", "the order (2 to 31), found '99'" },
    { "100 1 0 0\n3 0\n2 4\n", "2 control points are too few for the order 4" },
    { "100 1 0 0\n3 0\n2 2\n0 0 nan 1", "line 4: expected knot 2, found 'nan'" },
    { "100 1 0 0\n3 0\n2 2\n0 0 1e999 1", "expected knot 2, found '1e999'" },
    { "100 1 0 0\n3 0\n2 2\n0 0 1 0\n0 0 0 1 1 1", "line 1: the SplineCurve: KnotsU[3] = 0" },
    { "100 1 0 0\n3 0\n2 2\n0 0 1 1\n0 0 0 1 1", "coordinate 2 of control point 1, found the end" },
    { "100 1 0 0\n2 1\n2 2\n0 0 1 1\n0 0 0 1 1 1",
      "the weight of control point 0 is not positive" },
    { std::string(kCurve) + "7,5", "line 9: expected the class of an object" },
  };
  for (const auto& [text, message] : cases)
  {
    const Result result = Read(Write("bad.g2", text));
    if (!Contains(result.errors, message) || !Contains(result.errors, "bad.g2"))
    {
      throw std::runtime_error("'" + text + "' gives: " + result.errors);
    }
    CHECK(result.data->GetNumberOfBlocks() == 0);
  }
}

void TestFiles()
{
  CHECK(Contains(Read(folder + "/none.g2").errors, "none.g2: it cannot be opened"));
  CHECK(Contains(Read(folder).errors, "it is a folder"));
  CHECK(Contains(Read(Write("spline.abc", kCurve)).errors, "the extension '.abc'"));
  vtkNew<vtkSplineReader> reader;
  vtkNew<MessageRecorder> recorder;
  recorder->Watch(reader);
  reader->Update();
  CHECK(Contains(recorder->Errors, "No file name"));

  reader->SetFileName(Write("piece.g2", kCurve).c_str());
  vtkNew<vtkInformation> request;
  request->Set(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER(), 1);
  request->Set(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES(), 2);
  recorder->Clear();
  reader->Update(request);
  CHECK(recorder->Errors.empty() && reader->GetOutput()->GetNumberOfBlocks() == 0);
  request->Set(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER(), 0);
  reader->Update(request);
  CHECK(reader->GetOutput()->GetNumberOfBlocks() == 1);
  std::ostringstream text;
  reader->Print(text);
  CHECK(Contains(text.str(), "piece.g2"));
}

} // namespace

int TestSplineReader(int argc, char* argv[])
{
  return Run(
    [&]
    {
      const std::unique_ptr<char[]> output(
        vtkTestUtilities::GetArgOrEnvOrDefault("-T", argc, argv, "FOOTPOINT_TEST_OUTPUT", "."));
      folder = output.get();
      TestGoTools();
      TestGoToolsErrors();
      TestFiles();
    });
}
