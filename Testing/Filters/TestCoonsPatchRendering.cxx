// SPDX-License-Identifier: BSD-3-Clause
// A picture: the cells of one patch as quads and in the three triangulations.
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

/// A sail: curved sides in space.
Sides Sail()
{
  const auto height = [](double x, double y)
  { return 0.5 * std::sin(2.0 * x) * std::cos(1.5 * y); };
  const auto side = [=](const std::function<std::array<double, 2>(double)>& curve)
  {
    return [=](double t)
    {
      const auto p = curve(t);
      return Point{ { p[0], p[1], height(p[0], p[1]) } };
    };
  };
  using Plane = std::array<double, 2>;
  return { { side([](double s) { return Plane{ { 3 * s, 0.4 * std::sin(3 * s) } }; }),
    side([](double t) { return Plane{ { 3 - t * (1 - t), 0.4 * std::sin(3.0) + 2 * t } }; }),
    side([](double s) { return Plane{ { 3 * s, 2 + 0.4 * std::sin(3 * s) } }; }),
    side([](double t) { return Plane{ { -t * (1 - t), 2 * t } }; }) } };
}

} // namespace

int TestCoonsPatchRendering(int argc, char* argv[])
{
  vtkNew<vtkRenderWindow> window;
  window->SetSize(800, 600);
  window->SetMultiSamples(0);
  for (int k = 0; k < 4; ++k)
  {
    vtkNew<vtkCoonsPatchSource> source;
    AddSides(source, Sail(), 41);
    source->SetResolution(13, 9);
    if (k > 0)
    {
      source->SetCellTypeToTriangles();
      source->SetTriangleStyle(k - 1);
    }
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(source->GetOutputPort(1));
    mapper->ScalarVisibilityOff();
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    actor->GetProperty()->SetColor(0.95, 0.85, 0.55);
    actor->GetProperty()->EdgeVisibilityOn();
    actor->GetProperty()->SetEdgeColor(0.1, 0.2, 0.5);
    actor->GetProperty()->SetLineWidth(1.5);
    vtkNew<vtkRenderer> renderer;
    renderer->SetBackground(0.15, 0.17, 0.2);
    renderer->SetViewport(0.5 * (k % 2), k < 2 ? 0.5 : 0.0, 0.5 * (k % 2) + 0.5, k < 2 ? 1.0 : 0.5);
    renderer->AddActor(actor);
    window->AddRenderer(renderer);
    renderer->GetActiveCamera()->SetPosition(0.5, -4, 6);
    renderer->GetActiveCamera()->SetFocalPoint(1.5, 1, 0);
    renderer->GetActiveCamera()->SetViewUp(0, 0, 1);
    renderer->ResetCamera();
    renderer->GetActiveCamera()->Zoom(1.3);
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
