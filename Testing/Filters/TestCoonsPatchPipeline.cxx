// SPDX-License-Identifier: BSD-3-Clause
// vtkCoonsPatchSource in a pipeline: abort, the boundary's own samples, pieces, time.
#include "GridTesting.h"

#include "vtkCoonsPatchSource.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkPolyDataAlgorithm.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStructuredGridGeometryFilter.h"
#include "vtkTransform.h"
#include "vtkTransformFilter.h"

using namespace testing;

namespace
{

/// An abort while smoothing leaves both outputs empty and no harm.
void TestAbort()
{
  vtkNew<vtkCoonsPatchSource> source;
  vtkNew<ProgressWatcher> watcher;
  source->AddObserver(vtkCommand::ProgressEvent, watcher);
  AddSides(source, Swan(), 41);
  source->SetResolution(41, 41);
  source->SetSmoothingToWinslow();
  watcher->Abort = true;
  source->Update();
  CHECK(!watcher->Steps.empty());
  CHECK(source->GetOutput()->GetNumberOfPoints() == 0);
  CHECK(source->GetMeshOutput()->GetNumberOfPoints() == 0);

  watcher->Abort = false;
  source->SetAbortExecute(0); // since VTK 9.2 the executive leaves that to the caller
  source->Modified();
  source->Update();
  CHECK(source->GetOutput()->GetNumberOfPoints() == 41 * 41);
  CHECK(FieldValue(source->GetOutput(), "FoldedCellsAfter") == 0);
}

/// Resolution 0: the boundary's own samples, known downstream before any data is.
void TestOwnSamples()
{
  vtkNew<vtkCoonsPatchSource> source;
  const Sides sides = BordersOf(Product);
  source->AddInputData(MakeLine(Sample(sides[0], 5)));
  source->AddInputData(MakeLine(Sample(sides[1], 7)));
  source->AddInputData(MakeLine(Sample(sides[2], 9)));
  source->AddInputData(MakeLine(Sample(sides[3], 3)));
  source->SetResolution(0, 0);
  source->UpdateInformation();
  int extent[6];
  source->GetOutputInformation(0)->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent);
  CHECK(extent[1] == 8 && extent[3] == 6 && extent[5] == 0);
  vtkNew<vtkStructuredGridGeometryFilter> surface;
  surface->SetInputConnection(source->GetOutputPort());
  surface->Update();
  CHECK(surface->GetOutput()->GetNumberOfPolys() == 48);
  CheckGrid(source->GetOutput(), 9, 7, Product, 1e-15);

  source->SetResolution(4, 0);
  surface->Update();
  CheckGrid(source->GetOutput(), 4, 7, Product, 1e-15);
}

void TestPieces()
{
  vtkNew<vtkCoonsPatchSource> source;
  AddSides(source, BordersOf(Product), 5);
  for (int port = 0; port < 2; ++port)
  {
    for (int piece = 0; piece < 3; ++piece)
    {
      source->UpdatePiece(piece, 3, 0);
      auto* output = vtkDataSet::SafeDownCast(source->GetOutputDataObject(port));
      CHECK(output->GetNumberOfPoints() == (piece == 0 ? 441 : 0));
      CHECK(output->GetNumberOfCells() == (piece == 0 ? 400 : 0));
    }
    source->GetOutputInformation(1)->Set(
      vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER(), 0);
  }
}

/// A square that grows with time; on demand it has another number of points then.
class GrowingSquare : public vtkPolyDataAlgorithm
{
public:
  vtkTypeMacro(GrowingSquare, vtkPolyDataAlgorithm);
  static GrowingSquare* New() { return new GrowingSquare; }
  bool ChangeCounts = false;

protected:
  GrowingSquare() { this->SetNumberOfInputPorts(0); }

  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    const double times[] = { 0.0, 1.0, 2.0 };
    const double range[] = { 0.0, 2.0 };
    vtkInformation* info = outputs->GetInformationObject(0);
    info->Set(vtkStreamingDemandDrivenPipeline::TIME_STEPS(), times, 3);
    info->Set(vtkStreamingDemandDrivenPipeline::TIME_RANGE(), range, 2);
    return 1;
  }

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    vtkInformation* info = outputs->GetInformationObject(0);
    const double time = info->Has(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP())
      ? info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP())
      : 0.0;
    const Sides sides = BordersOf(
      [=](double u, double v) {
        return Point{ { (1 + time) * u, v, 0 } };
      });
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    vtkNew<vtkCellArray> lines;
    for (const Curve& side : sides)
    {
      const int count = this->ChangeCounts ? 4 + static_cast<int>(time) : 4;
      lines->InsertNextCell(count);
      for (const Point& p : Sample(side, count))
      {
        lines->InsertCellPoint(points->InsertNextPoint(p.data()));
      }
    }
    vtkPolyData* output = vtkPolyData::GetData(outputs);
    output->SetPoints(points);
    output->SetLines(lines);
    return 1;
  }
};

void TestTime()
{
  vtkNew<GrowingSquare> square;
  vtkNew<vtkCoonsPatchSource> source;
  source->SetInputConnection(square->GetOutputPort());
  source->SetResolution(0, 0);
  source->UpdateInformation();
  CHECK(
    source->GetOutputInformation(0)->Length(vtkStreamingDemandDrivenPipeline::TIME_STEPS()) == 3);
  for (const double time : { 2.0, 0.0, 1.0 })
  {
    source->UpdateTimeStep(time);
    CheckGrid(
      source->GetOutput(), 4, 4,
      [=](double u, double v) {
        return Point{ { (1 + time) * u, v, 0 } };
      },
      1e-14);
  }
}

/// Numbers of points that change over time: the whole extent is that of the time asked for.
void TestChangingCounts()
{
  vtkNew<GrowingSquare> square;
  square->ChangeCounts = true;
  vtkNew<vtkCoonsPatchSource> source;
  source->SetInputConnection(square->GetOutputPort());
  source->SetResolution(0, 0);
  vtkNew<vtkStructuredGridGeometryFilter> surface;
  surface->SetInputConnection(source->GetOutputPort());
  for (const double time : { 0.0, 2.0, 1.0, 0.0 })
  {
    const int count = 4 + static_cast<int>(time);
    surface->UpdateTimeStep(time);
    int extent[6];
    source->GetOutputInformation(0)->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent);
    CHECK(extent[1] == count - 1 && extent[3] == count - 1 && extent[5] == 0);
    CheckGrid(
      source->GetOutput(), count, count,
      [=](double u, double v) {
        return Point{ { (1 + time) * u, v, 0 } };
      },
      1e-14);
    CHECK(surface->GetOutput()->GetNumberOfPolys() == (count - 1) * (count - 1));
  }
  for (const double time : { 2.0, 0.0 })
  {
    const int count = 4 + static_cast<int>(time);
    source->UpdateTimeStep(time);
    CHECK(source->GetOutput()->GetNumberOfPoints() == count * count);
    CHECK(source->GetMeshOutput()->GetNumberOfPolys() == (count - 1) * (count - 1));
  }

  // With a resolution of its own the boundary's counts do not matter.
  source->SetResolution(5, 3);
  source->UpdateTimeStep(1.0);
  CheckGrid(
    source->GetOutput(), 5, 3,
    [](double u, double v) {
      return Point{ { 2 * u, v, 0 } };
    },
    1e-14);
}

/// A filter that takes extents over once: a grid of another size is refused, never cut, and others
/// get theirs.
void TestConsumerThatDoesNotFollow()
{
  vtkNew<GrowingSquare> square;
  square->ChangeCounts = true;
  vtkNew<vtkCoonsPatchSource> source;
  source->SetInputConnection(square->GetOutputPort());
  source->SetResolution(0, 0);
  vtkNew<vtkTransformFilter> transform;
  vtkNew<vtkTransform> identity;
  transform->SetTransform(identity);
  transform->SetInputConnection(source->GetOutputPort());
  vtkNew<vtkStructuredGridGeometryFilter> surface;
  surface->SetInputConnection(source->GetOutputPort());
  vtkNew<MessageRecorder> recorder;
  recorder->Watch(source);

  const int known = 4; // points a side that the filter knows of: those of the first step
  for (const double time : { 0.0, 2.0, 0.0, 1.0, 2.0, 1.0 })
  {
    const int count = 4 + static_cast<int>(time);
    const auto text = [](int n) { return std::to_string(n) + " x " + std::to_string(n) + " x 1"; };
    transform->UpdateTimeStep(time);
    CHECK(recorder->Errors.empty() == (count == known));
    if (count == known)
    {
      CHECK(transform->GetOutput()->GetNumberOfPoints() == count * count);
      continue;
    }
    CHECK(Contains(recorder->Errors,
      "the grid has " + text(count) + " points now, but a filter downstream asks for " +
        text(known)));
    CHECK(source->GetOutput()->GetNumberOfPoints() == 0);
    CHECK(source->GetMeshOutput()->GetNumberOfPoints() == 0);
    recorder->Clear();
    surface->UpdateTimeStep(time);
    CHECK(recorder->Errors.empty());
    CHECK(surface->GetOutput()->GetNumberOfPolys() == (count - 1) * (count - 1));
  }

  // Begun at a later step, where the filter is told of it: a smaller grid is refused as well.
  transform->UpdateTimeStep(0.0);
  surface->UpdateTimeStep(2.0);
  transform->Modified();
  transform->UpdateTimeStep(2.0);
  CHECK(recorder->Errors.empty());
  CHECK(transform->GetOutput()->GetNumberOfPoints() == 36);
  transform->UpdateTimeStep(1.0);
  CHECK(Contains(recorder->Errors, "5 x 5 x 1 points now, but a filter downstream asks for 6 x 6"));
  recorder->Clear();
  surface->UpdateTimeStep(1.0);
  CHECK(recorder->Errors.empty());
  CHECK(surface->GetOutput()->GetNumberOfPolys() == 16);
}

} // namespace

int TestCoonsPatchPipeline(int, char*[])
{
  return Run(
    []
    {
      TestAbort();
      TestOwnSamples();
      TestPieces();
      TestTime();
      TestChangingCounts();
      TestConsumerThatDoesNotFollow();
    });
}
