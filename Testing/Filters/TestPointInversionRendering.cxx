// SPDX-License-Identifier: BSD-3-Clause
// A picture: points around a bumpy surface, coloured by their signed distance, with a scalar bar.
#include "FilterTesting.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCell.h"
#include "vtkCellArray.h"
#include "vtkColorTransferFunction.h"
#include "vtkGlyph3D.h"
#include "vtkPointInversionFilter.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRegressionTestImage.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"
#include "vtkScalarBarActor.h"
#include "vtkSphereSource.h"
#include "vtkSplineEvaluator.h"
#include "vtkTextProperty.h"

using namespace testing;

namespace
{

constexpr int kPoles = 9;
constexpr int kSamples = 61;

/// A bicubic surface over [0, 4]² with hills; its domain is [0, 6]².
vtkSmartPointer<vtkStructuredGrid> MakeHills()
{
  std::vector<Point> points;
  for (int j = 0; j < kPoles; ++j)
  {
    for (int i = 0; i < kPoles; ++i)
    {
      points.push_back({ { 0.5 * i, 0.5 * j, 0.9 * std::sin(1.1 * i) * std::cos(0.9 * j) } });
    }
  }
  const std::vector<double> knots{ 0, 0, 0, 0, 1, 2, 3, 4, 5, 6, 6, 6, 6 };
  return MakeNet(kPoles, kPoles, points, {}, knots, knots);
}

/// The surface as quadrilaterals, evaluated exactly.
vtkSmartPointer<vtkPolyData> Tessellate(vtkStructuredGrid* net)
{
  vtkNew<vtkStructuredGrid> grid;
  grid->SetDimensions(kSamples, kSamples, 1);
  vtkNew<vtkPoints> positions;
  positions->SetNumberOfPoints(kSamples * kSamples);
  grid->SetPoints(positions);
  vtkNew<vtkDoubleArray> parameters;
  parameters->SetName("Parameters");
  parameters->SetNumberOfComponents(2);
  for (int i = 0; i < kSamples * kSamples; ++i)
  {
    positions->SetPoint(i, 0, 0, 0);
    parameters->InsertNextTuple2(
      6.0 * (i % kSamples) / (kSamples - 1), 6.0 * (i / kSamples) / (kSamples - 1));
  }
  grid->GetPointData()->AddArray(parameters);
  vtkNew<vtkSplineEvaluator> evaluator;
  evaluator->SetInputData(grid);
  evaluator->SetSourceData(net);
  evaluator->Update();
  vtkNew<vtkCellArray> quads;
  for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i)
  {
    quads->InsertNextCell(grid->GetCell(i)->GetPointIds());
  }
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(evaluator->GetOutput()->GetPoints());
  surface->GetPointData()->SetNormals(evaluator->GetOutput()->GetPointData()->GetNormals());
  surface->SetPolys(quads);
  return surface;
}

} // namespace

int TestPointInversionRendering(int argc, char* argv[])
{
  const auto net = MakeHills();
  std::vector<Point> positions;
  for (const Point& p : RandomPoints(700, 1.0))
  {
    positions.push_back({ { 2.0 + 1.9 * p[0], 2.0 + 1.9 * p[1], 1.0 * p[2] } });
  }
  vtkNew<vtkPointInversionFilter> inversion;
  inversion->SetInputData(MakePoints(positions));
  inversion->SetSourceData(net);

  vtkNew<vtkColorTransferFunction> colors;
  colors->SetColorSpaceToDiverging();
  colors->AddRGBPoint(-1.0, 0.23, 0.30, 0.75);
  colors->AddRGBPoint(0.0, 0.87, 0.87, 0.87);
  colors->AddRGBPoint(1.0, 0.71, 0.02, 0.15);

  vtkNew<vtkSphereSource> ball;
  ball->SetRadius(0.05);
  vtkNew<vtkGlyph3D> glyphs;
  glyphs->SetInputConnection(inversion->GetOutputPort());
  glyphs->SetSourceConnection(ball->GetOutputPort());
  glyphs->ScalingOff();
  vtkNew<vtkPolyDataMapper> point_mapper;
  point_mapper->SetInputConnection(glyphs->GetOutputPort());
  point_mapper->SetLookupTable(colors);
  vtkNew<vtkActor> point_actor;
  point_actor->SetMapper(point_mapper);

  vtkNew<vtkPolyDataMapper> surface_mapper;
  surface_mapper->SetInputData(Tessellate(net));
  surface_mapper->ScalarVisibilityOff();
  vtkNew<vtkActor> surface_actor;
  surface_actor->SetMapper(surface_mapper);
  surface_actor->GetProperty()->SetColor(0.95, 0.85, 0.55);

  vtkNew<vtkScalarBarActor> bar;
  bar->SetLookupTable(colors);
  bar->SetTitle("SignedDistance");
  bar->SetNumberOfLabels(5);
  bar->SetLabelFormat("%.1f");
  bar->SetUnconstrainedFontSize(true);
  bar->GetTitleTextProperty()->SetFontSize(14);
  bar->GetLabelTextProperty()->SetFontSize(14);
  bar->SetPosition(0.8, 0.15);
  bar->SetWidth(0.12);
  bar->SetHeight(0.7);

  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(0.15, 0.17, 0.2);
  renderer->AddActor(surface_actor);
  renderer->AddActor(point_actor);
  renderer->AddActor2D(bar);
  vtkNew<vtkRenderWindow> window;
  window->SetSize(600, 400);
  window->SetMultiSamples(0);
  window->AddRenderer(renderer);
  vtkNew<vtkRenderWindowInteractor> interactor;
  interactor->SetRenderWindow(window);
  renderer->GetActiveCamera()->SetPosition(-3, -7, 6);
  renderer->GetActiveCamera()->SetFocalPoint(2, 2, 0);
  renderer->GetActiveCamera()->SetViewUp(0, 0, 1);
  renderer->ResetCamera();
  renderer->GetActiveCamera()->Zoom(1.25);
  renderer->GetActiveCamera()->SetWindowCenter(0.15, 0.0); // room for the scalar bar
  window->Render();

  const int result = vtkRegressionTestImageThreshold(window, 10.0);
  if (result == vtkRegressionTester::DO_INTERACTOR)
  {
    interactor->Start();
  }
  return result == vtkRegressionTester::FAILED ? EXIT_FAILURE : EXIT_SUCCESS;
}
