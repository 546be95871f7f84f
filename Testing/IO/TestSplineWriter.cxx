// SPDX-License-Identifier: BSD-3-Clause
// vtkSplineWriter: what is written is read again to the bit, in every format; what a format cannot
// hold is refused, or named and left out.
#include "FileTesting.h"

#include "vtkCellArray.h"
#include "vtkMultiPieceDataSet.h"
#include "vtkPartitionedDataSetCollection.h"

#include <limits>

using namespace testing;

namespace
{

std::string folder;

const char* const kExtensions[] = { ".xml", ".g2", ".json" };

/// Numbers of all magnitudes, with zeros of both signs.
class Numbers
{
public:
  double operator()()
  {
    const double value = std::ldexp(this->Unit() - 0.5, static_cast<int>(this->Unit() * 80) - 40);
    return this->Unit() < 0.05 ? (value < 0 ? -0.0 : 0.0) : value;
  }
  double Unit() { return static_cast<double>(this->Generator() >> 11) * 0x1p-53; }

private:
  std::mt19937_64 Generator{ 7 };
};

/// A net of random numbers, knots and positive weights, by its degrees.
vtkSmartPointer<vtkStructuredGrid> MakeRandomNet(
  Numbers& numbers, const std::vector<int>& degrees, bool rational)
{
  std::vector<std::vector<double>> knots;
  int count = 1;
  std::vector<int> sizes;
  for (const int degree : degrees)
  {
    const int size = degree + 1 + static_cast<int>(4 * numbers.Unit());
    std::vector<double> values{ numbers.Unit() - 0.5 };
    for (int i = 0; i < size + degree; ++i)
    {
      values.push_back(values.back() + numbers.Unit() / 3);
    }
    knots.push_back(values);
    sizes.push_back(size);
    count *= size;
  }
  std::vector<Point> points;
  std::vector<double> weights;
  for (int i = 0; i < count; ++i)
  {
    points.push_back({ { numbers(), numbers(), numbers() } });
    weights.push_back(std::exp(6 * numbers.Unit() - 3));
  }
  return MakeNet(sizes[0], sizes.size() > 1 ? sizes[1] : 1, points,
    rational ? weights : std::vector<double>(), knots[0],
    knots.size() > 1 ? knots[1] : std::vector<double>());
}

/// Writes, reads again, compares to the bit, and the same once more from what was read.
void CheckRoundTrip(vtkMultiBlockDataSet* data, const std::string& extension)
{
  const std::string path = folder + "/round" + extension;
  const WriteResult written = WriteSplines(data, path);
  CHECK(written.result == 1 && written.errors.empty() && written.warnings.empty());
  const ReadResult read = ReadSplines(path);
  CHECK(read.errors.empty() && read.warnings.empty());
  if (!SameSplines(read.data, data))
  {
    throw std::runtime_error("other numbers in " + extension);
  }
  const std::string text = ReadText(path);
  CHECK(WriteSplines(read.data, path).result == 1);
  CHECK(ReadText(path) == text);
}

void TestRoundTrips()
{
  Numbers numbers;
  for (int trial = 0; trial < 60; ++trial)
  {
    vtkNew<vtkMultiBlockDataSet> curves;
    vtkNew<vtkMultiBlockDataSet> surfaces;
    vtkNew<vtkMultiBlockDataSet> both;
    for (int i = 0; i < 3; ++i)
    {
      const int p = 1 + static_cast<int>(5 * numbers.Unit());
      const int q = 1 + static_cast<int>(3 * numbers.Unit());
      Append(curves, MakeRandomNet(numbers, { p }, i != 1));
      Append(surfaces, MakeRandomNet(numbers, { p, q }, i != 1));
      Append(both, curves->GetBlock(static_cast<unsigned int>(i)));
      Append(both, surfaces->GetBlock(static_cast<unsigned int>(i)));
    }
    for (const char* extension : kExtensions)
    {
      CheckRoundTrip(curves, extension);
      CheckRoundTrip(surfaces, extension);
    }
    CheckRoundTrip(both, ".xml");
    CheckRoundTrip(both, ".g2");
  }
  vtkNew<vtkMultiBlockDataSet> extremes;
  const double huge = std::numeric_limits<double>::max() / 8;
  Append(extremes,
    MakeNet(2, 1, { { { 5e-324, -huge, -0.0 } }, { { 1e-310, huge, 0.1 } } }, {},
      { -1e300, -1e300, 1e-300, 1e-300 }));
  for (const char* extension : kExtensions)
  {
    CheckRoundTrip(extremes, extension);
  }
}

void TestNames()
{
  for (const std::string name : { "wing", "a & b < c > \"d\" 'e'", "Flügel \xe2\x82\xac",
         "tab\tline\nreturn\r\\ \\u0041 </label>", "  blanks  " })
  {
    vtkNew<vtkMultiBlockDataSet> data;
    Append(data, MakeSphere(), name);
    SetName(data->GetBlock(0), name);
    CheckRoundTrip(data, ".xml");
    CheckRoundTrip(data, ".json");
    const WriteResult result = WriteSplines(data, folder + "/named.g2");
    CHECK(result.result == 1 && Contains(result.warnings, "names are left out"));
  }
  for (const std::string name : { "bell\a", "\xff", "cut \xe2\x82" })
  {
    const auto net = MakeSphere();
    SetName(net, name);
    const WriteResult result = WriteSplines(net, folder + "/bad_name.xml");
    CHECK(result.result == 0 && Contains(result.errors, "spline 0: its name is no text"));
    CHECK(WriteSplines(net, folder + "/bad_name.json").result == 0);
  }
}

/// The square with a square and a round loop; holes run clockwise.
vtkSmartPointer<vtkMultiBlockDataSet> MakeFace(bool holes_alone)
{
  const std::vector<Point> border{ { { 0.125, 0.125, 0 } }, { { 0.875, 0.125, 0 } },
    { { 0.875, 0.875, 0 } }, { { 0.125, 0.875, 0 } }, { { 0.125, 0.125, 0 } } };
  auto first = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  for (std::size_t i = 0; i < 4; ++i)
  {
    vtkNew<vtkStructuredGrid> line;
    line->SetDimensions(2, 1, 1);
    line->SetPoints(MakePoints({ border[i], border[i + 1] })->GetPoints());
    Append(first, line, "Curve " + std::to_string(i));
  }
  const std::vector<Point> circle = Arc(0.0, 0.25, 0.0, 4);
  std::vector<Point> clockwise;
  std::vector<double> weights;
  for (std::size_t i = circle.size(); i-- > 0;)
  {
    clockwise.push_back({ { 0.5 + circle[i][0], 0.5 + circle[i][1], 0 } });
    weights.push_back(circle[i][2]);
  }
  vtkNew<vtkMultiBlockDataSet> hole;
  Append(hole, MakeNet(9, 1, clockwise, weights, ArcKnots(4)), "Curve 0");
  auto face = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  Append(face, MakeSquare(), "Surface");
  Append(face, holes_alone ? hole.Get() : first.Get(), "Loop 0");
  if (!holes_alone)
  {
    Append(face, hole, "Loop 1");
  }
  return face;
}

void TestTrimmedFaces()
{
  vtkNew<vtkMultiBlockDataSet> model;
  Append(model, MakeFace(false), "skin");
  SetName(vtkMultiBlockDataSet::SafeDownCast(model->GetBlock(0))->GetBlock(0), "skin");
  AddNumbers(model->GetBlock(0)->GetFieldData(), "Lost", { 1 });
  CheckRoundTrip(model, ".json");
  for (const char* extension : { ".xml", ".g2" })
  {
    const std::string path = folder + "/kept" + extension;
    WriteText(path, "as before");
    const WriteResult result = WriteSplines(model, path);
    CHECK(result.result == 0 && Contains(result.errors, "spline 0: it is a trimmed face"));
    CHECK(Contains(result.errors, path) && ReadText(path) == "as before");
  }
  CHECK(Contains(WriteSplines(MakeFace(true), folder + "/holes.json").errors,
    "spline 0: all its trim loops run clockwise"));

  // A single face is written as a model of one; lines become polylines.
  const auto face = MakeFace(false);
  auto lines = MakePoints({ { { 0, 0, 0 } }, { { 1, 0, 0 } }, { { 0, 1, 0 } }, { { 0, 0, 0 } } });
  vtkNew<vtkCellArray> cells;
  const vtkIdType ids[] = { 0, 1, 2, 3 };
  cells->InsertNextCell(4, ids);
  lines->SetLines(cells);
  face->SetBlock(1, lines);
  const std::string path = folder + "/lines.json";
  CHECK(WriteSplines(face, path).result == 1);
  const ReadResult read = ReadSplines(path);
  auto* again = vtkMultiBlockDataSet::SafeDownCast(read.data->GetBlock(0));
  CHECK(again && again->GetNumberOfBlocks() == 3);
  CHECK(Net(vtkMultiBlockDataSet::SafeDownCast(again->GetBlock(1)), 0)->GetNumberOfPoints() == 4);
  CHECK(SameSplines(again->GetBlock(2), face->GetBlock(2)));
}

void TestLeftOut()
{
  const auto net = MakeSphere();
  AddNumbers(net->GetFieldData(), "Tolerance", { 1e-3 });
  AddNumbers(net->GetPointData(), "Heat", std::vector<double>(45, 1.0));
  vtkNew<vtkMultiPieceDataSet> pieces;
  pieces->SetPiece(1, MakeSquare());
  vtkNew<vtkMultiBlockDataSet> model;
  Append(model, net);
  Append(model, nullptr);
  Append(model, pieces);
  const WriteResult result = WriteSplines(model, folder + "/left_out.xml");
  CHECK(result.result == 1 && result.errors.empty());
  CHECK(Contains(result.warnings, "arrays that are no spline are left out: Heat, Tolerance"));
  CHECK(Contains(result.warnings, "Face 1 is empty and left out"));
  CHECK(ReadSplines(folder + "/left_out.xml").data->GetNumberOfBlocks() == 2);

  vtkNew<vtkPartitionedDataSetCollection> collection;
  collection->SetPartition(0, 0, MakeCircle());
  collection->SetPartition(1, 0, MakeSquare());
  CHECK(WriteSplines(collection, folder + "/collection.g2").result == 1);
  CHECK(ReadSplines(folder + "/collection.g2").data->GetNumberOfBlocks() == 2);
  collection->SetPartition(1, 1, MakeSquare());
  CHECK(Contains(WriteSplines(collection, folder + "/collection.g2").errors, "Face 1: it is cut"));
}

void TestRefused()
{
  const auto reversed = MakeSquare();
  AddNumbers(reversed->GetFieldData(), "Orientation", { -1 });
  CHECK(Contains(WriteSplines(reversed, folder + "/r.g2").errors, "its Orientation is -1"));
  CHECK(Contains(WriteSplines(reversed, folder + "/r.xml").errors, "its Orientation is -1"));
  CHECK(WriteSplines(reversed, folder + "/r.json").result == 1);
  CHECK(FieldValue(ReadSplines(folder + "/r.json").data->GetBlock(0), "Orientation") == -1);

  vtkNew<vtkMultiBlockDataSet> model;
  Append(model, MakeSquare());
  Append(model, MakeCircle(), "rim");
  CHECK(Contains(WriteSplines(model, folder + "/r.json").errors,
    "spline 1: curves and surfaces do not go into one geomdl file"));
  model->GetBlock(1)->GetFieldData()->GetArray("KnotsU")->SetComponent(4, 0, -1.0);
  CHECK(Contains(WriteSplines(model, folder + "/r.xml").errors, "Face 1 ('rim'): KnotsU[4] = -1"));
  model->SetBlock(1, MakePoints({}));
  CHECK(Contains(WriteSplines(model, folder + "/r.xml").errors, "Face 1 ('rim'): it is a vtkPoly"));
  vtkNew<vtkMultiBlockDataSet> empty;
  CHECK(Contains(WriteSplines(empty, folder + "/r.xml").errors, "the input has no spline"));

  const auto sphere = MakeSphere();
  CHECK(Contains(WriteSplines(sphere, folder + "/no/folder.g2").errors, "it cannot be written"));
  CHECK(WriteSplines(sphere, folder + "/no/folder.g2").result == 0);
  CHECK(Contains(WriteSplines(sphere, folder + "/spline.abc").errors, "the extension '.abc'"));
  CHECK(WriteSplines(sphere, folder + "/spline.G2").result == 1);
  vtkNew<vtkSplineWriter> writer;
  vtkNew<MessageRecorder> recorder;
  recorder->Watch(writer);
  writer->SetInputData(sphere);
  CHECK(writer->Write() == 0 && Contains(recorder->Errors, "No file name"));
  writer->SetFileName((folder + "/by_format.txt").c_str());
  writer->SetFormatToGoTools();
  CHECK(writer->Write() == 1 && Contains(ReadText(folder + "/by_format.txt"), "200 1 0 0\n3 1\n"));
  std::ostringstream text;
  writer->Print(text);
  CHECK(Contains(text.str(), "Format: GoTools"));
}

} // namespace

int TestSplineWriter(int argc, char* argv[])
{
  return Run(
    [&]
    {
      folder = OutputFolder(argc, argv);
      TestRoundTrips();
      TestNames();
      TestTrimmedFaces();
      TestLeftOut();
      TestRefused();
    });
}
