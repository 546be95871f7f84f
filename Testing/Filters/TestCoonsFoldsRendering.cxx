// SPDX-License-Identifier: BSD-3-Clause
// A picture: the grid of the swan with its folded cells in red, before and after smoothing.
#include "GridTesting.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCoonsPatchSource.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRegressionTestImage.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"

using namespace testing;

namespace
{

/// The cells alone that are marked as folded.
vtkSmartPointer<vtkPolyData> FoldedCells(vtkPolyData* mesh)
{
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkIdList> ids;
  for (vtkIdType i = 0; i < mesh->GetNumberOfPolys(); ++i)
  {
    if (CellValue(mesh, "Folded", i) != 0)
    {
      mesh->GetPolys()->GetCellAtId(i, ids);
      cells->InsertNextCell(ids);
    }
  }
  auto folded = vtkSmartPointer<vtkPolyData>::New();
  folded->SetPoints(mesh->GetPoints());
  folded->SetPolys(cells);
  return folded;
}

/// \param height above the plane of the grid, so that what comes later is seen
vtkSmartPointer<vtkActor> MakeActor(vtkPolyData* data, const Point& color, double height)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  mapper->ScalarVisibilityOff();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->SetPosition(0, 0, height);
  actor->GetProperty()->SetColor(color[0], color[1], color[2]);
  actor->GetProperty()->LightingOff();
  return actor;
}

} // namespace

int TestCoonsFoldsRendering(int argc, char* argv[])
{
  vtkNew<vtkRenderWindow> window;
  window->SetSize(800, 450);
  window->SetMultiSamples(0);
  for (int k = 0; k < 2; ++k)
  {
    vtkNew<vtkCoonsPatchSource> source;
    AddSides(source, Swan(), 21);
    source->SetSmoothing(k == 0 ? vtkCoonsPatchSource::NONE : vtkCoonsPatchSource::AUTO);
    vtkNew<vtkRenderer> renderer;
    renderer->SetBackground(0.15, 0.17, 0.2);
    renderer->SetViewport(0.5 * k, 0.0, 0.5 * k + 0.5, 1.0);
    source->Update();
    vtkPolyData* mesh = source->GetMeshOutput();
    renderer->AddActor(MakeActor(mesh, { { 0.95, 0.95, 0.9 } }, 0.0));
    const auto wires = MakeActor(mesh, { { 0.1, 0.2, 0.5 } }, 0.01);
    wires->GetProperty()->SetRepresentationToWireframe();
    renderer->AddActor(wires);
    renderer->AddActor(MakeActor(FoldedCells(mesh), { { 0.9, 0.1, 0.1 } }, 0.02));
    window->AddRenderer(renderer);
    renderer->GetActiveCamera()->ParallelProjectionOn();
    renderer->ResetCamera();
    renderer->GetActiveCamera()->Zoom(1.15);
  }
  vtkNew<vtkRenderWindowInteractor> interactor;
  interactor->SetRenderWindow(window);
  window->Render();

  const int result = vtkRegressionTestImageThreshold(window, 10.0);
  if (result == vtkRegressionTester::DO_INTERACTOR)
  {
    interactor->Start();
  }
  return result == vtkRegressionTester::FAILED ? EXIT_FAILURE : EXIT_SUCCESS;
}
