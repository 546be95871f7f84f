// SPDX-License-Identifier: BSD-3-Clause
// Models as Bézier cells: attributes of faces, files, trimmed faces, refusals, pieces, abort.
#include "BezierTesting.h"

#include "vtkXMLMultiBlockDataReader.h"
#include "vtkXMLMultiBlockDataWriter.h"
#include "vtkXMLUnstructuredGridReader.h"
#include "vtkXMLUnstructuredGridWriter.h"

using namespace testing;

namespace
{

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
  const auto before = Feet(grid, RandomPoints(400, 4.0));
  const auto same = [&](vtkDataObject* read)
  {
    const auto after = Feet(read, RandomPoints(400, 4.0));
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

int TestBezierExtractionModels(int argc, char* argv[])
{
  return Run(
    [&]
    {
      TestModels();
      TestFiles(OutputFolder(argc, argv));
      TestTrimmedFaces();
      TestRefusals();
      TestPieces();
      TestAbort();
    });
}
