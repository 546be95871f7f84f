// SPDX-License-Identifier: BSD-3-Clause
// vtkSplineReader on JSON files of geomdl: order of the control points, trims with their senses,
// what is left out or refused.
#include "FileTesting.h"

using namespace testing;

namespace
{

std::string path;

ReadResult ReadAs(const std::string& text)
{
  WriteText(path, text);
  return ReadSplines(path);
}

void TestSurfaces()
{
  const ReadResult result = ReadAs(files::kGeomdl);
  CHECK(result.errors.empty() && result.warnings.empty());
  CHECK(result.data->GetNumberOfBlocks() == 2);
  vtkStructuredGrid* sheet = Net(result.data, 0);
  CHECK(NameOf(result.data, 0) == "sheet");
  CHECK(Dimensions(sheet)[0] == 2 && Dimensions(sheet)[1] == 3);
  CHECK(FieldValues(sheet, "KnotsV") == std::vector<double>({ 0, 0, 1.5, 3, 3 }));
  // The file has v fastest, the net u.
  CHECK(sheet->GetPoint(1)[0] == 1 && sheet->GetPoint(1)[1] == 0);
  CHECK(sheet->GetPoint(2)[2] == 0.1 && sheet->GetPoint(3)[2] == 1e-3);
  CHECK(FieldValue(sheet, "Orientation") == -1);

  auto* face = vtkMultiBlockDataSet::SafeDownCast(result.data->GetBlock(1));
  CHECK(face && face->GetNumberOfBlocks() == 3);
  CHECK(NameOf(face, 0) == "Surface" && NameOf(face, 1) == "Loop 0" && NameOf(face, 2) == "Loop 1");
  vtkStructuredGrid* surface = Net(face, 0);
  const double weights[] = { 1, 3, 2, 4 };
  for (vtkIdType i = 0; i < 4; ++i)
  {
    CHECK(Value(surface, "RationalWeights", i) == weights[i]);
  }
  CHECK(!surface->GetFieldData()->HasArray("Orientation"));
  // The only trim is a hole, so the border of the domain keeps its inside; the trim runs clockwise
  // in the file.
  auto* border = vtkMultiBlockDataSet::SafeDownCast(face->GetBlock(1));
  CHECK(border && border->GetNumberOfBlocks() == 1);
  CHECK(Net(border, 0)->GetNumberOfPoints() == 5);
  CHECK(Net(border, 0)->GetPoint(1)[0] == 1 && Net(border, 0)->GetPoint(1)[1] == 0);
  CHECK(!Net(border, 0)->GetFieldData()->HasArray("KnotsU"));
  auto* hole = vtkMultiBlockDataSet::SafeDownCast(face->GetBlock(2));
  CHECK(hole && hole->GetNumberOfBlocks() == 1);
  vtkStructuredGrid* curve = Net(hole, 0);
  CHECK(FieldValues(curve, "KnotsU") == std::vector<double>({ 0, 0, 0, 0.5, 0.5, 1, 1, 1 }));
  CHECK(curve->GetPoint(1)[0] == 0.25 && curve->GetPoint(1)[1] == 0.75);
}

/// The curve of the only trim, after its sense was changed.
vtkSmartPointer<vtkMultiBlockDataSet> TrimsWith(const std::string& sense)
{
  const ReadResult result = ReadAs(Replaced(files::kGeomdl, "\"reversed\": 0", sense));
  CHECK(result.errors.empty());
  return vtkMultiBlockDataSet::SafeDownCast(result.data->GetBlock(1));
}

void TestTrims()
{
  // Kept inside: one loop, turned round.
  auto face = TrimsWith("\"reversed\": true");
  CHECK(face->GetNumberOfBlocks() == 2);
  vtkStructuredGrid* curve = Net(vtkMultiBlockDataSet::SafeDownCast(face->GetBlock(1)), 0);
  CHECK(FieldValues(curve, "KnotsU") == std::vector<double>({ 0, 0, 0, 0.5, 0.5, 1, 1, 1 }));
  CHECK(curve->GetPoint(1)[0] == 0.75 && curve->GetPoint(1)[1] == 0.75);
  CHECK(Value(curve, "RationalWeights", 1) == 0.5);
  // Without a sense the direction tells: clockwise, a hole.
  CHECK(TrimsWith("\"id\": 3")->GetNumberOfBlocks() == 3);

  // A container of a spline and a polyline, counter-clockwise in the file, a hole by its sense.
  const std::string container = R"("trims": { "count": 1, "data": [ { "type": "container",
    "reversed": false, "count": 2, "data": [
     { "type": "spline", "degree": 1, "knotvector": [0, 0, 1, 3, 3],
       "control_points": { "points": [[0, 0], [1, 0], [1, 1]] } },
     { "type": "freeform", "points": [[1, 1], [0.5, 0.75], [0, 0]] } ] } ] }, "id": 1 )";
  std::string text = Replaced(files::kGeomdl, "\"name\": \"sheet\"", container);
  ReadResult result = ReadAs(text);
  CHECK(result.errors.empty() && result.warnings.empty());
  face = vtkMultiBlockDataSet::SafeDownCast(result.data->GetBlock(0));
  CHECK(face && face->GetNumberOfBlocks() == 3);
  auto* loop = vtkMultiBlockDataSet::SafeDownCast(face->GetBlock(2));
  CHECK(loop && loop->GetNumberOfBlocks() == 2);
  CHECK(!Net(loop, 0)->GetFieldData()->HasArray("KnotsU"));
  CHECK(Net(loop, 0)->GetPoint(0)[0] == 0 && Net(loop, 0)->GetPoint(2)[0] == 1);
  CHECK(FieldValues(Net(loop, 1), "KnotsU") == std::vector<double>({ 0, 0, 2, 3, 3 }));
  CHECK(Net(loop, 1)->GetPoint(0)[1] == 1 && Net(loop, 1)->GetPoint(1)[0] == 1);

  CheckRefused(path,
    { { Replaced(text, "\"freeform\"", "\"circle\""), "expected spline, freeform or container" },
      { Replaced(text, "\"freeform\"", "\"container\""), "expected spline or freeform in a con" },
      { Replaced(text, "[0.5, 0.75]", "[0.5, 0.75, 2]"), "expected 2 coordinates as points[1]" },
      { Replaced(text, "\"reversed\": false", "\"reversed\": 2"), "expected true or false" },
      { Replaced(text, "[[0, 0], [1, 0], [1, 1]]", "[[0, 0, 0], [1, 0, 3], [1, 1, 0]]"),
        "point 1 of a trim has a third coordinate that is not 0" } });
}

void TestCurves()
{
  const std::string curve = R"({ "shape": { "type": "curve", "data": {
    "degree": 1, "knotvector": [0, 0, 1, 1], "sample": 7,
    "control_points": { "points": [[-0.0, 1], [12345678901234567890, 3]] } } } })";
  const ReadResult result = ReadAs(curve);
  CHECK(result.errors.empty());
  CHECK(Contains(result.warnings, "line 2: the member 'sample' is left out"));
  CHECK(result.data->GetNumberOfBlocks() == 1);
  CHECK(std::signbit(Net(result.data, 0)->GetPoint(0)[0]));
  CHECK(Net(result.data, 0)->GetPoint(1)[0] == 12345678901234567890.0);
  CHECK(Net(result.data, 0)->GetPoint(1)[2] == 0);
  CheckRefused(path,
    { { Replaced(curve, "[0, 0, 1, 1]", "[0, 0, 1]"), "line 2: expected 4 numbers at least" },
      { Replaced(curve, "[0, 0, 1, 1]", "[0, 0, 1, 0]"), "KnotsU[3] = 0" },
      { Replaced(curve, "[0, 0, 1, 1]", "{}"), "line 2: expected numbers in brackets" },
      { Replaced(curve, "[0, 0, 1, 1]", "[0, 0, \"1\", 1]"), "expected a number as knotvector[2]" },
      { Replaced(curve, "1234567890123456789", "1e99999"), "is not a number" },
      { Replaced(curve, ", 3]", ", 3, 4, 5]"), "expected 2 coordinates as points[1], found 4" },
      { Replaced(curve, "[-0.0, 1], ", ""), "expected 2 control points by the knots and degrees" },
      { Replaced(curve, "\"degree\": 1", "\"degree\": 1.5"),
        "expected a whole number from 1 to 30" },
      { Replaced(curve, "\"degree\": 1", "\"degree\": 31"),
        "expected a whole number from 1 to 30" },
      { Replaced(curve, "\"degree\": 1, ", ""), "line 1: expected a member degree" } });
}

void TestErrors()
{
  const std::string good = files::kGeomdl;
  CheckRefused(path,
    { { "", "it is no JSON" }, { "[]", "line 1: expected an object with the member shape" },
      { "{}", "line 1: expected a member shape" }, { good + "{", "it is no JSON: * Line 43" },
      { Replaced(good, "\"count\": 2", "\"count\": 3"), "expected the number of the shapes, 2" },
      { Replaced(good, "\"surface\"", "\"mesh\""), "line 3: expected curve, surface or volume" },
      { Replaced(good, "\"surface\"", "\"volume\""),
        "no spline; line 2: the volumes are left out" },
      { Replaced(good, "\"size_u\": 2", "\"size_u\": 3"), "line 11: size_u = 3 does not fit" },
      { Replaced(good, "[1, 2, 3, 4]", "[1, 2, 3]"), "expected 4 weights, found 3" },
      { Replaced(good, "[1, 2, 3, 4]", "[1, 2, 3, 0]"), "RationalWeights[" },
      { Replaced(good, "\"sheet\"", "7"), "line 15: expected a text as name" },
      { Replaced(good, "\"sheet\"", "\"sheet\", \"name\": \"again\""), "it is no JSON" },
      { std::string(200000, '['), "it is no JSON" } });
}

} // namespace

int TestGeomdlFiles(int argc, char* argv[])
{
  return Run(
    [&]
    {
      path = OutputFolder(argc, argv) + "/geomdl.json";
      TestSurfaces();
      TestTrims();
      TestCurves();
      TestErrors();
    });
}
