// SPDX-License-Identifier: BSD-3-Clause
// vtkSplineTessellator: its arrays, closed meshes, models, options, errors, the pipeline.
#include "FilterTesting.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCleanPolyData.h"
#include "vtkFeatureEdges.h"
#include "vtkIdList.h"
#include "vtkIdTypeArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkSMPTools.h"
#include "vtkSplineTessellator.h"

using namespace testing;

namespace
{

/// Aborts at the first progress that is reported from inside.
class Stopper : public vtkCommand
{
public:
  vtkTypeMacro(Stopper, vtkCommand);
  static Stopper* New() { return new Stopper; }

  void Execute(vtkObject* caller, unsigned long, void* data) override
  {
    if (*static_cast<double*>(data) > 0.0)
    {
      ++this->Steps;
      vtkAlgorithm::SafeDownCast(caller)->SetAbortExecute(1);
    }
  }

  int Steps = 0;
};

/// Edges of one triangle alone, after points of equal coordinates were made one.
vtkIdType OpenEdges(vtkPolyData* mesh)
{
  vtkNew<vtkCleanPolyData> clean;
  clean->SetInputData(mesh);
  clean->SetTolerance(0.0);
  vtkNew<vtkFeatureEdges> edges;
  edges->SetInputConnection(clean->GetOutputPort());
  edges->FeatureEdgesOff();
  edges->ManifoldEdgesOff();
  edges->NonManifoldEdgesOn();
  edges->BoundaryEdgesOn();
  edges->Update();
  return edges->GetOutput()->GetNumberOfCells();
}

void TestSphere()
{
  vtkNew<vtkSplineTessellator> tessellator;
  tessellator->SetInputData(MakeSphere());
  tessellator->Update();
  vtkPolyData* output = tessellator->GetOutput();
  CHECK(output->GetNumberOfPolys() > 100);
  CHECK(output->GetNumberOfLines() == 0);
  CHECK(output->GetPoints()->GetDataType() == VTK_DOUBLE);
  CHECK(output->GetPointData()->GetNormals() == PointArray(output, "Normals"));
  CHECK(output->GetPointData()->GetTCoords() == PointArray(output, "Parameters"));
  CHECK(PointArray(output, "Parameters")->GetNumberOfComponents() == 2);
  CHECK(PointArray(output, "Parameters")->GetDataType() == VTK_DOUBLE);
  CHECK_NEAR(FieldValue(output, "ChordTolerance"), 1e-3 * std::sqrt(12.0), 1e-12);
  for (vtkIdType i = 0; i < output->GetNumberOfPoints(); ++i)
  {
    Point point;
    output->GetPoint(i, point.data());
    CHECK_NEAR(Norm(point), 1.0, 1e-14);
    for (int k = 0; k < 3; ++k)
    {
      CHECK_NEAR(Value(output, "Normals", i, k), point[k], 1e-7);
    }
    CHECK(Value(output, "Parameters", i, 0) >= 0.0 && Value(output, "Parameters", i, 0) <= 4.0);
    CHECK(Value(output, "Parameters", i, 1) >= 0.0 && Value(output, "Parameters", i, 1) <= 2.0);
  }
  CHECK(OpenEdges(output) == 0);

  // Centres of triangles are below the sphere by the tolerance at most, and oriented outward.
  vtkNew<vtkIdList> ids;
  for (vtkIdType k = 0; k < output->GetNumberOfPolys(); ++k)
  {
    output->GetCellPoints(k, ids);
    CHECK(ids->GetNumberOfIds() == 3);
    Point corner[3];
    Point centre{ { 0, 0, 0 } };
    for (int i = 0; i < 3; ++i)
    {
      output->GetPoint(ids->GetId(i), corner[i].data());
      for (int c = 0; c < 3; ++c)
      {
        centre[c] += corner[i][c] / 3.0;
      }
    }
    CHECK(1.0 - Norm(centre) <= FieldValue(output, "ChordTolerance"));
    CHECK(vtkMath::Determinant3x3(corner[0].data(), corner[1].data(), corner[2].data()) > 0.0);
  }

  tessellator->FlipNormalsOn();
  tessellator->Update();
  Point point;
  tessellator->GetOutput()->GetPoint(0, point.data());
  CHECK_NEAR(Value(tessellator->GetOutput(), "Normals", 0, 2), -point[2], 1e-7);
}

void TestModel()
{
  vtkNew<vtkMultiBlockDataSet> model;
  model->SetBlock(0, MakeTorus());
  model->SetBlock(1, nullptr);
  model->SetBlock(2, MakeCircle());
  const auto square = MakeSquare(2.0);
  vtkNew<vtkIntArray> orientation;
  orientation->SetName("Orientation");
  orientation->InsertNextValue(-1);
  square->GetFieldData()->AddArray(orientation);
  model->SetBlock(3, square);
  vtkNew<vtkSplineTessellator> tessellator;
  tessellator->SetInputData(model);
  tessellator->Update();
  vtkPolyData* output = tessellator->GetOutput();
  CHECK(output->GetNumberOfLines() == 1);
  auto* faces = vtkIdTypeArray::SafeDownCast(output->GetCellData()->GetArray("FaceId"));
  CHECK(faces && faces->GetNumberOfValues() == output->GetNumberOfCells());
  CHECK(faces->GetValue(0) == 2); // the line comes first
  CHECK(faces->GetValue(1) == 0);
  const vtkIdType last = output->GetNumberOfCells() - 1;
  CHECK(
    faces->GetValue(last) == 3 && faces->GetValue(last - 1) == 3 && faces->GetValue(last - 2) == 0);
  vtkNew<vtkIdList> ids;
  output->GetCellPoints(last, ids);
  for (vtkIdType i = 0; i < 3; ++i)
  {
    CHECK_NEAR(Value(output, "Normals", ids->GetId(i), 2), -1.0, 1e-14);
  }
  output->GetCellPoints(0, ids);
  CHECK(Value(output, "Normals", ids->GetId(0), 2) == 0.0);
  CHECK(Value(output, "Parameters", ids->GetId(ids->GetNumberOfIds() - 1), 0) == 4.0);

  vtkNew<vtkSplineTessellator> curve;
  curve->SetInputData(MakeCircle());
  curve->Update();
  CHECK(curve->GetOutput()->GetNumberOfLines() == 1);
  CHECK(!curve->GetOutput()->GetPointData()->HasArray("Normals"));
}

void TestOptions()
{
  vtkNew<vtkSplineTessellator> tessellator;
  tessellator->SetInputData(MakeTorus());
  const auto triangles = [&]
  {
    tessellator->Update();
    CHECK(OpenEdges(tessellator->GetOutput()) == 0);
    return tessellator->GetOutput()->GetNumberOfPolys();
  };
  const vtkIdType plain = triangles();
  tessellator->SetChordTolerance(1e-4);
  const vtkIdType finer = triangles();
  CHECK(finer > 4 * plain);
  tessellator->AbsoluteToleranceOn();
  tessellator->SetChordTolerance(0.1);
  const vtkIdType coarse = triangles();
  CHECK(coarse < plain);
  CHECK(FieldValue(tessellator->GetOutput(), "ChordTolerance") == 0.1);
  tessellator->SetAngleTolerance(5.0);
  CHECK(triangles() > coarse);
  tessellator->SetModeToFixed();
  CHECK(std::string(tessellator->GetModeAsString()) == "Fixed");
  tessellator->SetResolution(3);
  CHECK(triangles() == 2 * 16 * 9); // 4 x 4 spans
  CHECK(FieldValue(tessellator->GetOutput(), "ChordTolerance") == 0.0);
  std::ostringstream text;
  tessellator->Print(text);
  for (const char* name : { "Mode: Fixed", "ChordTolerance: 0.1", "AbsoluteTolerance: On",
         "AngleTolerance: 5", "Resolution: 3", "FlipNormals: Off" })
  {
    CHECK(Contains(text.str(), name));
  }
}

void TestErrors()
{
  vtkNew<MessageRecorder> recorder;
  vtkNew<vtkSplineTessellator> tessellator;
  recorder->Watch(tessellator);
  tessellator->SetInputData(MakeSphere());
  for (const double bad : { 0.0, -1.0, std::nan("") })
  {
    recorder->Clear();
    tessellator->SetChordTolerance(bad);
    tessellator->Update();
    CHECK(Contains(recorder->Errors, "ChordTolerance"));
    CHECK(tessellator->GetOutput()->GetNumberOfPoints() == 0);
  }
  tessellator->SetChordTolerance(1e-3);

  // A bad face among good ones is named and left out; alone it is an error.
  const auto broken = MakeSquare();
  broken->GetFieldData()->GetArray("KnotsU")->SetComponent(2, 0, -5.0);
  recorder->Clear();
  tessellator->SetInputData(broken);
  tessellator->Update();
  CHECK(Contains(recorder->Errors, "KnotsU[2]"));
  CHECK(tessellator->GetOutput()->GetNumberOfPoints() == 0);
  vtkNew<vtkMultiBlockDataSet> model;
  model->SetBlock(0, broken);
  model->SetBlock(1, MakeSquare());
  recorder->Clear();
  tessellator->SetInputData(model);
  tessellator->Update();
  CHECK(recorder->Errors.empty());
  CHECK(Contains(recorder->Warnings, "Face 0") && Contains(recorder->Warnings, "KnotsU[2]"));
  CHECK(tessellator->GetOutput()->GetNumberOfPolys() == 2);

  // A face that is one point has no triangles.
  const auto point = MakeSquare();
  for (vtkIdType i = 0; i < 4; ++i)
  {
    point->GetPoints()->SetPoint(i, 1.0, 2.0, 3.0);
  }
  model->SetBlock(0, point);
  recorder->Clear();
  tessellator->Update();
  CHECK(Contains(recorder->Warnings, "Face 0") && Contains(recorder->Warnings, "no triangles"));
  CHECK(tessellator->GetOutput()->GetNumberOfPolys() == 2);

  vtkNew<vtkMultiBlockDataSet> nothing;
  recorder->Clear();
  tessellator->SetInputData(nothing);
  tessellator->Update();
  CHECK(Contains(recorder->Errors, "no faces"));
}

void TestPipeline()
{
  vtkNew<vtkSplineTessellator> tessellator;
  tessellator->SetInputData(MakeTorus());
  tessellator->UpdatePiece(1, 2, 0);
  CHECK(tessellator->GetOutput()->GetNumberOfPoints() == 0);
  tessellator->UpdatePiece(0, 2, 0);
  CHECK(tessellator->GetOutput()->GetNumberOfPolys() > 0);

  // The same bits with one thread.
  vtkNew<vtkPolyData> parallel;
  parallel->DeepCopy(tessellator->GetOutput());
  vtkNew<vtkSplineTessellator> serial;
  serial->SetInputData(MakeTorus());
  vtkSMPTools::Initialize(1);
  serial->Update();
  vtkSMPTools::Initialize(0);
  CHECK(SameBits(parallel->GetPoints()->GetData(), serial->GetOutput()->GetPoints()->GetData()));
  CHECK(SameBits(PointArray(parallel, "Normals"), PointArray(serial->GetOutput(), "Normals")));
  CHECK(SameBits(parallel->GetPolys()->GetConnectivityArray(),
    serial->GetOutput()->GetPolys()->GetConnectivityArray()));

  // Stopped on the way nothing comes out; afterwards it works again.
  vtkNew<vtkSplineTessellator> stopped;
  vtkNew<Stopper> stopper;
  stopped->SetInputData(MakeTorus());
  stopped->AddObserver(vtkCommand::ProgressEvent, stopper);
  stopped->Update();
  CHECK(stopper->Steps >= 1);
  CHECK(stopped->GetOutput()->GetNumberOfPoints() == 0);
  stopped->RemoveAllObservers();
  stopped->SetAbortExecute(0); // since VTK 9.2 the executive leaves that to the caller
  stopped->Modified();
  stopped->Update();
  CHECK(stopped->GetOutput()->GetNumberOfPoints() > 0);
}

} // namespace

int TestSplineTessellator(int, char*[])
{
  return Run(
    []
    {
      TestSphere();
      TestModel();
      TestOptions();
      TestErrors();
      TestPipeline();
    });
}
