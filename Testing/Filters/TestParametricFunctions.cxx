// SPDX-License-Identifier: BSD-3-Clause
// VTK's parametric functions as geometry: points on each are found again, with one thread and with
// two, whatever the functions say about their derivatives.
#include "FilterTesting.h"

#include "vtkParametricBohemianDome.h"
#include "vtkParametricBour.h"
#include "vtkParametricBoy.h"
#include "vtkParametricCatalanMinimal.h"
#include "vtkParametricConicSpiral.h"
#include "vtkParametricCrossCap.h"
#include "vtkParametricDini.h"
#include "vtkParametricEllipsoid.h"
#include "vtkParametricEnneper.h"
#include "vtkParametricFigure8Klein.h"
#include "vtkParametricHenneberg.h"
#include "vtkParametricKlein.h"
#include "vtkParametricKuen.h"
#include "vtkParametricMobius.h"
#include "vtkParametricPluckerConoid.h"
#include "vtkParametricPseudosphere.h"
#include "vtkParametricRandomHills.h"
#include "vtkParametricRoman.h"
#include "vtkParametricSpline.h"
#include "vtkParametricSuperEllipsoid.h"
#include "vtkParametricSuperToroid.h"
#include "vtkParametricTorus.h"
#include "vtkPointInversionFilter.h"
#include "vtkSMPTools.h"

using namespace testing;

namespace
{

template <typename Function>
vtkSmartPointer<vtkParametricFunction> Make()
{
  return vtkSmartPointer<Function>::New();
}

Point Evaluate(vtkParametricFunction* function, double u, double v)
{
  double parameters[3] = { u, v, 0.0 };
  double derivatives[9] = {};
  Point point{ { 0, 0, 0 } };
  function->Evaluate(parameters, point.data(), derivatives);
  return point;
}

/// Points at parameters spread over the domain, the borders included.
std::vector<Point> PointsOn(vtkParametricFunction* function)
{
  const int steps = 9;
  const int rows = function->GetDimension() == 2 ? steps : 1;
  std::vector<Point> points;
  for (int j = 0; j < rows; ++j)
  {
    for (int i = 0; i < steps; ++i)
    {
      const double s = i / (steps - 1.0);
      const double t = j / (steps - 1.0);
      points.push_back(Evaluate(function,
        function->GetMinimumU() + s * (function->GetMaximumU() - function->GetMinimumU()),
        function->GetMinimumV() + t * (function->GetMaximumV() - function->GetMinimumV())));
    }
  }
  return points;
}

double Size(const std::vector<Point>& points)
{
  const auto data = MakePoints(points);
  return data->GetLength();
}

/// Largest distance found for points on the function, as a fraction of its size. A fresh function
/// is given to the filter, so that its first evaluation is the filter's.
double WorstDistance(vtkParametricFunction* judge, vtkParametricFunction* fresh)
{
  const std::vector<Point> points = PointsOn(judge);
  vtkNew<vtkPointInversionFilter> filter;
  filter->SetInputData(MakePoints(points));
  filter->SetParametricFunction(fresh);
  filter->Update();
  vtkDataObject* output = filter->GetOutput();
  CHECK(PointArray(output, "Parameters")->GetNumberOfComponents() == judge->GetDimension());
  double worst = 0.0;
  for (vtkIdType i = 0; i < static_cast<vtkIdType>(points.size()); ++i)
  {
    const double distance = Value(output, "Distance", i);
    CHECK(Value(output, "Status", i) != vtkPointInversionFilter::CERTIFIED);
    CHECK(std::isfinite(distance));
    worst = std::max(worst, distance);
  }
  return worst / Size(points);
}

vtkSmartPointer<vtkParametricFunction> MakeSpline()
{
  auto spline = vtkSmartPointer<vtkParametricSpline>::New();
  spline->SetPoints(
    MakePoints({ { { 0, 0, 0 } }, { { 1, 2, 0 } }, { { 3, 1, 1 } }, { { 4, 3, 2 } } })
      ->GetPoints());
  return spline;
}

void TestAll()
{
  const std::vector<std::pair<const char*, vtkSmartPointer<vtkParametricFunction> (*)()>>
    functions = { { "BohemianDome", Make<vtkParametricBohemianDome> },
      { "Bour", Make<vtkParametricBour> }, { "Boy", Make<vtkParametricBoy> },
      { "CatalanMinimal", Make<vtkParametricCatalanMinimal> },
      { "ConicSpiral", Make<vtkParametricConicSpiral> },
      { "CrossCap", Make<vtkParametricCrossCap> }, { "Dini", Make<vtkParametricDini> },
      { "Ellipsoid", Make<vtkParametricEllipsoid> }, { "Enneper", Make<vtkParametricEnneper> },
      { "Figure8Klein", Make<vtkParametricFigure8Klein> },
      { "Henneberg", Make<vtkParametricHenneberg> }, { "Klein", Make<vtkParametricKlein> },
      { "Kuen", Make<vtkParametricKuen> }, { "Mobius", Make<vtkParametricMobius> },
      { "PluckerConoid", Make<vtkParametricPluckerConoid> },
      { "Pseudosphere", Make<vtkParametricPseudosphere> },
      { "RandomHills", Make<vtkParametricRandomHills> }, { "Roman", Make<vtkParametricRoman> },
      { "Spline", MakeSpline }, { "SuperEllipsoid", Make<vtkParametricSuperEllipsoid> },
      { "SuperToroid", Make<vtkParametricSuperToroid> }, { "Torus", Make<vtkParametricTorus> } };
  std::string failures;
  for (const auto& [name, make] : functions)
  {
    const double worst = WorstDistance(make(), make());
    std::cout << name << ": " << worst << std::endl;
    if (!(worst <= 1e-9))
    {
      failures += std::string(" ") + name;
    }
  }
  if (!failures.empty())
  {
    throw std::runtime_error("points on these were not found:" + failures);
  }
}

/// Off the surface, against closed forms.
void TestDistances()
{
  vtkNew<vtkParametricTorus> torus;
  torus->SetRingRadius(3.0);
  torus->SetCrossSectionRadius(1.0);
  const std::vector<Point> points = RandomPoints(100, 4.0);
  vtkNew<vtkPointInversionFilter> filter;
  filter->SetInputData(MakePoints(points));
  filter->SetParametricFunction(torus);
  filter->Update();
  for (vtkIdType i = 0; i < 100; ++i)
  {
    CHECK(Value(filter->GetOutput(), "Status", i) == vtkPointInversionFilter::CONVERGED);
    CHECK_NEAR(
      Value(filter->GetOutput(), "Distance", i), std::abs(TorusDistance(points[i])), 1e-10);
  }

  // Newton's method needs right second derivatives to be quick.
  double iterations = 0.0;
  for (vtkIdType i = 0; i < 100; ++i)
  {
    iterations += Value(filter->GetOutput(), "Iterations", i);
  }
  std::cout << "iterations per point: " << iterations / 100 << std::endl;
  CHECK(iterations / 100 < 6.0);
}

} // namespace

int TestParametricFunctions(int, char*[])
{
  return Run(
    []
    {
      CHECK(vtkSMPTools::SetBackend("STDThread"));
      vtkSMPTools::Initialize(2);
      TestAll();
      TestDistances();
    });
}
