// SPDX-License-Identifier: BSD-3-Clause
// Splines as Bézier cells of VTK. Judges: VTK's own cells, which evaluate at given parameters
// without any code of ours, and feet on the nets that the cells were made from.
#include "FilterTesting.h"

#include "vtkBezierExtraction.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataSetSurfaceFilter.h"
#include "vtkInformation.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPointInversionFilter.h"
#include "vtkSplineEvaluator.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"
#include "vtkXMLMultiBlockDataReader.h"
#include "vtkXMLMultiBlockDataWriter.h"
#include "vtkXMLUnstructuredGridReader.h"
#include "vtkXMLUnstructuredGridWriter.h"

#include <algorithm>

using namespace testing;

namespace
{

vtkSmartPointer<vtkUnstructuredGrid> Extract(vtkDataObject* geometry)
{
  vtkNew<vtkBezierExtraction> extraction;
  extraction->SetInputDataObject(geometry);
  extraction->Update();
  vtkSmartPointer<vtkUnstructuredGrid> grid = extraction->GetOutput();
  return grid;
}

double CellValue(vtkUnstructuredGrid* grid, const char* name, vtkIdType cell, int component = 0)
{
  vtkDataArray* array = grid->GetCellData()->GetArray(name);
  CHECK(array != nullptr);
  return array->GetComponent(cell, component);
}

/// The points of faces of a geometry at rows of parameters.
std::vector<Point> Evaluate(
  vtkDataObject* geometry, const std::vector<Point>& parameters, const std::vector<double>& faces)
{
  vtkNew<vtkTable> table;
  vtkNew<vtkDoubleArray> rows;
  rows->SetName("Parameters");
  rows->SetNumberOfComponents(2);
  for (const Point& parameter : parameters)
  {
    rows->InsertNextTuple(parameter.data());
  }
  table->AddColumn(rows);
  AddNumbers(table->GetRowData(), "FaceId", faces);
  vtkNew<vtkSplineEvaluator> evaluator;
  evaluator->SetInputData(table);
  evaluator->SetSourceData(geometry);
  evaluator->Update();
  std::vector<Point> points(parameters.size());
  CHECK(evaluator->GetOutput()->GetNumberOfPoints() == vtkIdType(parameters.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    evaluator->GetOutput()->GetPoint(static_cast<vtkIdType>(i), points[i].data());
  }
  return points;
}

/// Largest distance between all cells, as VTK evaluates them, and the geometry.
double EvaluationError(vtkDataObject* geometry, vtkUnstructuredGrid* grid)
{
  std::vector<Point> parameters;
  std::vector<double> faces;
  std::vector<Point> of_vtk;
  for (vtkIdType id = 0; id < grid->GetNumberOfCells(); ++id)
  {
    vtkCell* cell = grid->GetCell(id);
    const bool curve = cell->GetCellType() == VTK_BEZIER_CURVE;
    std::vector<double> weights(static_cast<std::size_t>(cell->GetNumberOfPoints()));
    for (const double v : { 0.03125, 0.4375, 0.96875 })
    {
      for (const double u : { 0.0625, 0.5, 0.8125 })
      {
        const double pcoords[3] = { u, curve ? 0.0 : v, 0.0 };
        Point point;
        int sub = 0;
        cell->EvaluateLocation(sub, pcoords, point.data(), weights.data());
        of_vtk.push_back(point);
        const auto at = [&](int direction, double fraction)
        {
          const double start = CellValue(grid, "ParameterRange", id, 2 * direction);
          const double end = CellValue(grid, "ParameterRange", id, 2 * direction + 1);
          return start + fraction * (end - start);
        };
        parameters.push_back({ { at(0, u), curve ? 0.0 : at(1, v), 0.0 } });
        faces.push_back(CellValue(grid, "FaceId", id));
      }
    }
  }
  const std::vector<Point> ours = Evaluate(geometry, parameters, faces);
  double worst = 0.0;
  for (std::size_t i = 0; i < ours.size(); ++i)
  {
    worst = std::max(worst,
      std::hypot(ours[i][0] - of_vtk[i][0], ours[i][1] - of_vtk[i][1], ours[i][2] - of_vtk[i][2]));
  }
  return worst;
}

/// Knots with inner multiplicities 1 … degree, every second time not clamped.
std::vector<double> SomeKnots(int degree, bool clamped)
{
  std::vector<double> knots;
  for (int i = 0; i <= degree; ++i)
  {
    knots.push_back(clamped ? 1.5 : 1.5 - 0.25 * (degree - i));
  }
  for (int multiplicity = 1; multiplicity <= degree; ++multiplicity)
  {
    knots.insert(knots.end(), multiplicity, 1.5 + multiplicity * 0.7);
  }
  for (int i = 0; i <= degree; ++i)
  {
    knots.push_back(1.5 + (degree + 1) * 0.7 + (clamped ? 0.0 : 0.25 * i));
  }
  return knots;
}

/// Random control points in a cube of edge 2, random weights in [0.2, 5].
vtkSmartPointer<vtkStructuredGrid> RandomNet(int p, int q, bool rational, bool clamped)
{
  const std::vector<double> u = SomeKnots(p, clamped);
  const std::vector<double> v = q > 0 ? SomeKnots(q, clamped) : std::vector<double>();
  const int nu = static_cast<int>(u.size()) - p - 1;
  const int nv = q > 0 ? static_cast<int>(v.size()) - q - 1 : 1;
  std::vector<double> weights;
  if (rational)
  {
    for (const Point& x : RandomPoints(nu * nv, 1.0, 7))
    {
      weights.push_back(std::pow(5.0, x[0]));
    }
  }
  return MakeNet(nu, nv, RandomPoints(nu * nv, 1.0, 40 * p + q), weights, u, v);
}

void TestExactness()
{
  const double size = 2.0 * std::sqrt(3.0);
  for (const std::array<int, 2>& degree : std::vector<std::array<int, 2>>{
         { { 1, 1 } }, { { 3, 2 } }, { { 1, 4 } }, { { 5, 5 } }, { { 7, 3 } }, { { 12, 1 } } })
  {
    for (const bool rational : { false, true })
    {
      for (const bool clamped : { false, true })
      {
        const auto net = RandomNet(degree[0], degree[1], rational, clamped);
        const auto grid = Extract(net);
        CHECK(grid->GetNumberOfCells() == (degree[0] + 1) * (degree[1] + 1));
        CHECK(EvaluationError(net, grid) <= 1e-13 * size);
        // No point is there twice: neighbours share those on their border.
        CHECK(grid->GetNumberOfPoints() ==
          (degree[0] * (degree[0] + 1) + 1) * (degree[1] * (degree[1] + 1) + 1));
        CHECK((grid->GetPointData()->GetRationalWeights() != nullptr) == rational);
      }
    }
  }
  // === Curves
  for (const int degree : { 1, 2, 5, 12 })
  {
    const auto net = RandomNet(degree, 0, degree % 2 == 0, degree < 3);
    const auto grid = Extract(net);
    CHECK(grid->GetNumberOfCells() == degree + 1);
    CHECK(grid->GetNumberOfPoints() == degree * (degree + 1) + 1);
    CHECK(grid->GetCellData()->GetArray("ParameterRange")->GetNumberOfComponents() == 2);
    CHECK(EvaluationError(net, grid) <= 1e-13 * size);
  }
}

/// A cylinder of which the seam is closed to the bit, and whose border at u = 2 a gap may split.
vtkSmartPointer<vtkStructuredGrid> MakeCylinder(bool gap)
{
  const double half = std::sqrt(0.5);
  std::vector<Point> circle{ { { 1, 0, 1 } }, { { 1, 1, half } }, { { 0, 1, 1 } },
    { { -1, 1, half } }, { { -1, 0, 1 } }, { { -1, -1, half } }, { { 0, -1, 1 } },
    { { 1, -1, half } }, { { 1, 0, 1 } } };
  std::vector<double> knots = ArcKnots(4);
  if (gap)
  {
    circle.insert(circle.begin() + 4, { { -1.25, 0, 1 } });
    knots.insert(knots.begin() + 6, 2.0);
  }
  std::vector<Point> points;
  std::vector<double> weights;
  for (const double height : { 0.0, 3.0 })
  {
    for (const Point& point : circle)
    {
      points.push_back({ { point[0], point[1], height } });
      weights.push_back(point[2]);
    }
  }
  return MakeNet(static_cast<int>(circle.size()), 2, points, weights, knots, { 0, 0, 1, 1 });
}

void TestSharedPoints()
{
  CHECK(Extract(MakeCylinder(false))->GetNumberOfPoints() == 2 * 8);
  CHECK(Extract(MakeCylinder(true))->GetNumberOfPoints() == 2 * 9);
  // Twice extracted: the cells' ranges tell which are neighbours.
  const auto again = Extract(Extract(MakeCylinder(false)));
  CHECK(again->GetNumberOfPoints() == 2 * 8);
  CHECK(again->GetNumberOfCells() == 4);
  // sin(2π) is not 0: the seam of this sphere is closed to rounding alone, and stays apart. So do
  // the points of the poles, which differ in u.
  CHECK(Extract(MakeSphere())->GetNumberOfPoints() == 9 * 5);
  // A closed surface of one cell is no neighbour of itself.
  const auto tube = MakeNet(5, 2,
    { { { 1, 0, 0 } }, { { 1, 2, 0 } }, { { -2, 0, 0 } }, { { 1, -2, 0 } }, { { 1, 0, 0 } },
      { { 1, 0, 1 } }, { { 1, 2, 1 } }, { { -2, 0, 1 } }, { { 1, -2, 1 } }, { { 1, 0, 1 } } },
    {}, { 0, 0, 0, 0, 0, 1, 1, 1, 1, 1 }, { 0, 0, 1, 1 });
  CHECK(Extract(tube)->GetNumberOfPoints() == 10);
}

/// Feet of random points.
vtkSmartPointer<vtkPolyData> Feet(vtkDataObject* geometry)
{
  vtkNew<vtkPointInversionFilter> filter;
  filter->SetInputData(MakePoints(RandomPoints(400, 4.0)));
  filter->SetSourceData(geometry);
  filter->Update();
  vtkSmartPointer<vtkPolyData> feet = vtkPolyData::SafeDownCast(filter->GetOutput());
  CHECK(feet && feet->GetNumberOfPoints() == 400);
  return feet;
}

/// \param kinks whether the geometry has C0 lines
void CompareFeet(vtkDataObject* geometry, double size, bool kinks = false)
{
  const auto of_net = Feet(geometry);
  const auto of_cells = Feet(Extract(geometry));
  vtkDataArray* parameters = PointArray(of_net, "Parameters");
  for (vtkIdType i = 0; i < 400; ++i)
  {
    for (const char* name : { "FaceId", "Status", "FootType", "Isolated" })
    {
      // At the end of a C0 line on the edge the net's foot is on an edge, the cells' at a vertex.
      const bool end_of_kink = std::string(name) == "FootType" &&
        Value(of_net, name, i) == vtkPointInversionFilter::EDGE &&
        Value(of_cells, name, i) == vtkPointInversionFilter::VERTEX;
      CHECK((kinks && end_of_kink) || Value(of_cells, name, i) == Value(of_net, name, i));
    }
    CHECK_NEAR(Value(of_cells, "Distance", i), Value(of_net, "Distance", i), 1e-13 * size);
    for (int k = 0; k < 3; ++k)
    {
      CHECK_NEAR(
        Value(of_cells, "ClosestPoint", i, k), Value(of_net, "ClosestPoint", i, k), 1e-13 * size);
    }
    for (int k = 0; k < parameters->GetNumberOfComponents(); ++k)
    {
      CHECK_NEAR(
        Value(of_cells, "Parameters", i, k), Value(of_net, "Parameters", i, k), 1e-13 * size);
    }
  }
}

void Name(vtkDataObject* leaf, const char* name, int orientation, double tolerance)
{
  vtkNew<vtkStringArray> names;
  names->SetName("FaceName");
  names->InsertNextValue(name);
  leaf->GetFieldData()->AddArray(names);
  AddNumbers(leaf->GetFieldData(), "Orientation", { double(orientation) });
  AddNumbers(leaf->GetFieldData(), "Tolerance", { tolerance });
  vtkNew<vtkStringArray> unit;
  unit->SetName("LengthUnit");
  unit->InsertNextValue("mm");
  leaf->GetFieldData()->AddArray(unit);
}

/// A torus, nothing, a reversed square, a curve.
vtkSmartPointer<vtkMultiBlockDataSet> MakeModel()
{
  auto model = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  model->SetBlock(0, MakeTorus());
  model->SetBlock(1, nullptr);
  model->SetBlock(2, MakeSquare(2.5));
  model->SetBlock(3, MakeParabola());
  Name(model->GetBlock(0), "ring", 1, 0.0);
  Name(model->GetBlock(2), "lid", -1, 0.125);
  model->GetMetaData(3u)->Set(vtkCompositeDataSet::NAME(), "wire");
  return model;
}

void TestFeet()
{
  CompareFeet(MakeTorus(), 9.0);
  CompareFeet(MakeCylinder(false), 4.0);
  CompareFeet(RandomNet(3, 2, true, false), 3.5, true);
  CompareFeet(RandomNet(4, 5, false, true), 3.5, true);
  CompareFeet(MakeParabola(), 9.0);
  CompareFeet(MakeModel(), 9.0);
}

void TestModels()
{
  const auto grid = Extract(MakeModel());
  CHECK(grid->GetNumberOfCells() == 16 + 1 + 1);
  CHECK(grid->GetCellType(17) == VTK_BEZIER_CURVE);
  const std::vector<double> faces{ 0, 2, 3 };
  for (std::size_t i = 0; i < 3; ++i)
  {
    CHECK(CellValue(grid, "FaceId", static_cast<vtkIdType>(15 + i)) == faces[i]);
  }
  CHECK(CellValue(grid, "HigherOrderDegrees", 17) == 2);
  CHECK(
    CellValue(grid, "ParameterRange", 17) == -2 && CellValue(grid, "ParameterRange", 17, 1) == 2);
  auto* names = vtkStringArray::SafeDownCast(grid->GetFieldData()->GetAbstractArray("FaceName"));
  CHECK(names && names->GetNumberOfValues() == 4);
  CHECK(names->GetValue(0) == "ring" && names->GetValue(1).empty());
  CHECK(names->GetValue(2) == "lid" && names->GetValue(3) == "wire");
  CHECK(FieldValue(grid, "Orientation", 0) == 1 && FieldValue(grid, "Orientation", 2) == -1);
  CHECK(FieldValue(grid, "Tolerance", 2) == 0.125);
  CHECK(grid->GetFieldData()->HasArray("LengthUnit"));
  CHECK(grid->GetPointData()->GetRationalWeights()->GetTuple1(grid->GetNumberOfPoints() - 1) == 1);

  // === Orientations go on to the feet: above the lid is below it
  vtkNew<vtkPointInversionFilter> filter;
  filter->SetInputData(MakePoints({ { { 0.5, 0.5, 2.75 } } }));
  filter->SetSourceData(grid);
  filter->Update();
  CHECK(Value(filter->GetOutput(), "FaceId", 0) == 2);
  CHECK_NEAR(Value(filter->GetOutput(), "SignedDistance", 0), -0.25, 1e-15);

  // === Arrays of field data that are too short for the faces
  grid->GetFieldData()->GetArray("Orientation")->SetNumberOfTuples(2);
  vtkNew<MessageRecorder> recorder;
  recorder->Watch(filter);
  filter->Modified();
  grid->Modified();
  filter->Update();
  CHECK(Contains(recorder->Warnings, "Face 2"));
  CHECK(Contains(recorder->Warnings, "Orientation has 2 values, none for this face"));
}

void TestFiles(const std::string& folder)
{
  const auto grid = Extract(MakeModel());
  const auto before = Feet(grid);
  const auto same = [&](vtkDataObject* read)
  {
    const auto after = Feet(read);
    for (const char* name : { "Parameters", "Distance", "ClosestPoint", "SignedDistance" })
    {
      const auto bits = [&](vtkPolyData* data) { return PointArray(data, name); };
      // NaN equals itself in its bits.
      CHECK(SameBits(bits(before), bits(after)));
    }
  };
  const std::string file = folder + "/bezier.vtu";
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(grid);
  writer->SetFileName(file.c_str());
  CHECK(writer->Write() == 1);
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  same(reader->GetOutput());
  CHECK(reader->GetOutput()->GetPointData()->GetRationalWeights() != nullptr);
  CHECK(reader->GetOutput()->GetCellData()->GetHigherOrderDegrees() != nullptr);
  CHECK(EvaluationError(MakeModel(), reader->GetOutput()) <= 1e-12);

  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, grid);
  const std::string composite = folder + "/bezier.vtm";
  vtkNew<vtkXMLMultiBlockDataWriter> block_writer;
  block_writer->SetInputData(blocks);
  block_writer->SetFileName(composite.c_str());
  CHECK(block_writer->Write() == 1);
  vtkNew<vtkXMLMultiBlockDataReader> block_reader;
  block_reader->SetFileName(composite.c_str());
  block_reader->Update();
  same(block_reader->GetOutputDataObject(0));
}

/// VTK's drawing of the cells lies on the sphere, and is one connected net within a face.
void TestDisplay()
{
  vtkNew<vtkBezierExtraction> extraction;
  extraction->SetInputData(MakeSphere());
  vtkNew<vtkDataSetSurfaceFilter> surface;
  surface->SetInputConnection(extraction->GetOutputPort());
  surface->SetNonlinearSubdivisionLevel(3);
  surface->Update();
  vtkPolyData* drawn = surface->GetOutput();
  // A cell has 2 by 2 quads of 2 triangles, which level 3 cuts twice into 4; all cells together are
  // a net of 33 by 17 points, no line of which is there twice.
  CHECK(drawn->GetNumberOfCells() == 8 * 2 * 2 * 2 * 16);
  CHECK(drawn->GetNumberOfPoints() == 33 * 17);
  for (vtkIdType i = 0; i < drawn->GetNumberOfPoints(); ++i)
  {
    CHECK_NEAR(Norm({ { drawn->GetPoint(i)[0], drawn->GetPoint(i)[1], drawn->GetPoint(i)[2] } }),
      1.0, 1e-6); // of floats
  }
}

void TestTrimmedFaces()
{
  vtkNew<vtkMultiBlockDataSet> face;
  const auto append = [](vtkMultiBlockDataSet* blocks, vtkDataObject* data, const char* name)
  {
    const unsigned int number = blocks->GetNumberOfBlocks();
    blocks->SetBlock(number, data);
    blocks->GetMetaData(number)->Set(vtkCompositeDataSet::NAME(), name);
  };
  vtkNew<vtkStructuredGrid> loop;
  loop->SetDimensions(4, 1, 1);
  loop->SetPoints(MakePoints(
    { { { 0.2, 0.2, 0 } }, { { 0.8, 0.2, 0 } }, { { 0.5, 0.7, 0 } }, { { 0.2, 0.2, 0 } } })
                    ->GetPoints());
  append(face, MakeSquare(), "Surface");
  append(face, loop, "Loop 0");
  Name(face->GetBlock(0), "gusset", 1, 0.0);
  vtkNew<vtkMultiBlockDataSet> model;
  model->SetBlock(0, MakeSquare(1.0));
  model->SetBlock(1, face);

  vtkNew<vtkBezierExtraction> extraction;
  vtkNew<MessageRecorder> recorder;
  recorder->Watch(extraction);
  extraction->SetInputData(model);
  extraction->Update();
  CHECK(extraction->GetOutput()->GetNumberOfCells() == 2);
  CHECK(Contains(recorder->Warnings, "whole surfaces were extracted of: Face 1 ('gusset')."));
  recorder->Clear();
  extraction->SkipTrimmedFacesOn();
  extraction->Update();
  CHECK(extraction->GetOutput()->GetNumberOfCells() == 1);
  CHECK(Contains(recorder->Warnings, "Trimmed faces are left out: Face 1 ('gusset')."));
  CHECK(recorder->Errors.empty());
  extraction->SetInputData(face);
  extraction->Update();
  CHECK(Contains(recorder->Errors, "all are trimmed and left out: Face 0 ('gusset')"));
  CHECK(extraction->GetOutput()->GetNumberOfCells() == 0);
}

void TestRefusals()
{
  vtkNew<vtkBezierExtraction> extraction;
  vtkNew<MessageRecorder> recorder;
  recorder->Watch(extraction);
  const auto broken = MakeSquare();
  broken->GetFieldData()->GetArray("KnotsV")->SetTuple1(1, 5.0);
  extraction->SetInputData(broken);
  extraction->Update();
  CHECK(Contains(recorder->Errors, "Face 0: KnotsV"));
  CHECK(extraction->GetOutput()->GetNumberOfPoints() == 0);

  recorder->Clear();
  vtkNew<vtkMultiBlockDataSet> model;
  model->SetBlock(0, broken);
  model->SetBlock(1, MakeSquare());
  extraction->SetInputData(model);
  extraction->Update();
  CHECK(recorder->Errors.empty());
  CHECK(Contains(recorder->Warnings, "(left out)"));
  CHECK(extraction->GetOutput()->GetNumberOfCells() == 1);
  CHECK(CellValue(extraction->GetOutput(), "FaceId", 0) == 1);

  recorder->Clear();
  vtkNew<vtkMultiBlockDataSet> empty;
  extraction->SetInputData(empty);
  extraction->Update();
  CHECK(Contains(recorder->Errors, "The input has no faces."));

  // === Cells beyond the room that filters of VTK have
  recorder->Clear();
  extraction->SetInputData(RandomNet(22, 22, false, true));
  extraction->Update();
  CHECK(Contains(recorder->Warnings, "Face 0"));
  CHECK(Contains(recorder->Warnings, "512"));
  CHECK(recorder->Errors.empty());
  recorder->Clear();
  extraction->SetInputData(RandomNet(21, 22, false, true));
  extraction->Update();
  CHECK(recorder->Warnings.empty());
}

void TestPieces()
{
  vtkNew<vtkBezierExtraction> extraction;
  extraction->SetInputData(MakeTorus());
  extraction->UpdatePiece(1, 2, 0);
  CHECK(extraction->GetOutput()->GetNumberOfCells() == 0);
  extraction->UpdatePiece(0, 2, 0);
  CHECK(extraction->GetOutput()->GetNumberOfCells() == 16);
}

/// Aborts at the first progress after half.
class Stop : public vtkCommand
{
public:
  vtkTypeMacro(Stop, vtkCommand);
  static Stop* New() { return new Stop; }
  void Execute(vtkObject* caller, unsigned long, void* data) override
  {
    if (*static_cast<double*>(data) > 0.5)
    {
      vtkAlgorithm::SafeDownCast(caller)->SetAbortExecute(1);
    }
  }
};

void TestAbort()
{
  std::vector<double> knots{ 0 };
  for (int i = 0; i <= 40; ++i)
  {
    knots.push_back(i);
  }
  knots.push_back(40);
  vtkNew<vtkBezierExtraction> extraction;
  extraction->SetInputData(MakeNet(41, 41, RandomPoints(41 * 41, 1.0), {}, knots, knots));
  vtkNew<Stop> stop;
  const unsigned long tag = extraction->AddObserver(vtkCommand::ProgressEvent, stop);
  extraction->Update();
  CHECK(extraction->GetOutput()->GetNumberOfCells() == 0);
  extraction->RemoveObserver(tag);
  extraction->SetAbortExecute(0);
  extraction->Modified();
  extraction->Update();
  CHECK(extraction->GetOutput()->GetNumberOfCells() == 1600);
}

} // namespace

int TestBezierExtraction(int argc, char* argv[])
{
  return Run(
    [&]
    {
      TestExactness();
      TestSharedPoints();
      TestFeet();
      TestModels();
      TestFiles(OutputFolder(argc, argv));
      TestDisplay();
      TestTrimmedFaces();
      TestRefusals();
      TestPieces();
      TestAbort();
    });
}
