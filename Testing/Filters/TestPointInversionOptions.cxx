// SPDX-License-Identifier: BSD-3-Clause
// Options of vtkPointInversionFilter: defaults, names, and what each does.
#include "FilterTesting.h"

#include "vtkMultiBlockDataSet.h"
#include "vtkPointInversionFilter.h"

#include "footpoint/model/point_inversion.h"

using namespace testing;

namespace
{

void TestDefaults()
{
  vtkNew<vtkPointInversionFilter> filter;
  const footpoint::InversionOptions core;
  CHECK(filter->GetSearch() == static_cast<int>(core.search));
  CHECK(filter->GetMethod() == static_cast<int>(core.solver.method));
  CHECK(filter->GetPointTolerance() == core.solver.point_tolerance);
  CHECK(filter->GetCosineTolerance() == core.solver.cosine_tolerance);
  CHECK(filter->GetStepTolerance() == core.solver.step_tolerance);
  CHECK(filter->GetMaximumIterations() == core.solver.maximum_iterations);
  CHECK(filter->GetTrustRadius() == core.solver.trust_radius);
  CHECK(filter->GetColumnScaling() == core.solver.column_scaling);
  CHECK(filter->GetIsocurveFallback() == core.solver.isocurve_fallback);
  CHECK(filter->GetSeedResolution() == core.seeding.resolution);
  CHECK(filter->GetNumberOfSeeds() == core.seeding.number_of_seeds);
  CHECK(filter->GetMaximumDistance() == VTK_DOUBLE_MAX);
  CHECK(filter->GetOrthogonalOnly() == core.orthogonal_only);
  CHECK(filter->GetAllFeet() == core.all_feet);
  CHECK(filter->GetFixedDirection()[2] == 0.0);
  CHECK(!filter->GetWarmStart() && !filter->GetFlipNormals() && !filter->GetFootSegments());
  CHECK(filter->GetDeviationTolerance() == VTK_DOUBLE_MAX);
  CHECK(std::string(filter->GetArrayNamePrefix()).empty());
  CHECK(filter->GetGenerateParameters() && filter->GetGenerateStatus());
}

void TestNames()
{
  vtkNew<vtkPointInversionFilter> filter;
  using Filter = vtkPointInversionFilter;
  CHECK(std::string(filter->GetSearchAsString()) == "Global");
  filter->SetSearchToSeeded();
  CHECK(filter->GetSearch() == Filter::SEEDED);
  CHECK(std::string(filter->GetSearchAsString()) == "Seeded");
  filter->SetSearchToLocal();
  CHECK(std::string(filter->GetSearchAsString()) == "Local");
  filter->SetSearchToGlobal();
  CHECK(filter->GetSearch() == Filter::GLOBAL);

  const std::vector<std::pair<void (Filter::*)(), const char*>> methods = {
    { &Filter::SetMethodToNewton, "Newton" }, { &Filter::SetMethodToGaussNewton, "GaussNewton" },
    { &Filter::SetMethodToLevenbergMarquardt, "LevenbergMarquardt" },
    { &Filter::SetMethodToSecondOrder, "SecondOrder" },
    { &Filter::SetMethodToFirstOrder, "FirstOrder" },
    { &Filter::SetMethodToCurvatureCircle, "CurvatureCircle" },
    { &Filter::SetMethodToSecondOrder1, "SecondOrder1" },
    { &Filter::SetMethodToSecondOrder2, "SecondOrder2" },
    { &Filter::SetMethodToSecondOrder3, "SecondOrder3" }
  };
  const auto points = MakePoints({ { { 1.2, 0.7, 0 } }, { { -0.3, 0.1, 0.4 } } });
  filter->SetInputData(points);
  filter->SetSourceData(MakeParabola());
  filter->Update();
  const double expected = Value(filter->GetOutput(), "Distance", 0);
  for (std::size_t i = 0; i < methods.size(); ++i)
  {
    (filter->*methods[i].first)();
    CHECK(filter->GetMethod() == static_cast<int>(i));
    CHECK(std::string(filter->GetMethodAsString()) == methods[i].second);
    filter->Update();
    CHECK(Value(filter->GetOutput(), "Status", 0) == Filter::CONVERGED);
    CHECK_NEAR(Value(filter->GetOutput(), "Distance", 0), expected, 1e-10);
  }

  filter->SetMethod(1000);
  CHECK(filter->GetMethod() == Filter::SECOND_ORDER_3);
  std::ostringstream text;
  filter->Print(text);
  for (const char* name : { "Search: Global", "Method: SecondOrder3", "MaximumDistance: 1e+299",
         "GenerateIterations: On", "NumberOfModelBuilds: 9" })
  {
    CHECK(Contains(text.str(), name));
  }
}

void TestAllFeet()
{
  // Two minima at t = ±√(h − ½), d² = h − ¼; between them a maximum at 0.
  const double height = 2.0;
  vtkNew<vtkPointInversionFilter> filter;
  filter->SetInputData(MakePoints({ { { 0, height, 0 } }, { { 3, -5, 0 } } }));
  filter->SetSourceData(MakeParabola());
  filter->AllFeetOn();
  filter->Update();
  vtkPolyData* feet = filter->GetFootPointsOutput();
  int found = 0;
  for (vtkIdType i = 0; i < feet->GetNumberOfPoints(); ++i)
  {
    if (Value(feet, "PointId", i) == 0)
    {
      ++found;
      CHECK_NEAR(std::abs(Value(feet, "Parameters", i)), std::sqrt(height - 0.5), 1e-9);
      CHECK_NEAR(Value(feet, "Distance", i), std::sqrt(height - 0.25), 1e-12);
    }
  }
  CHECK(found == 2);
  CHECK(feet->GetNumberOfPoints() >= 3);
  // A tie: the smaller parameter.
  CHECK(Value(filter->GetOutput(), "Parameters", 0) < 0.0);
}

void TestFixedDirection()
{
  vtkNew<vtkPointInversionFilter> filter;
  filter->SetInputData(MakePoints({ { { 0.6, 0, 5 } }, { { 2, 0, 5 } } }));
  filter->SetSourceData(MakeSphere());
  filter->SetFixedDirection(0, 0, -2);
  filter->Update();
  CHECK(Value(filter->GetOutput(), "Status", 0) == 1);
  CHECK_NEAR(Value(filter->GetOutput(), "Distance", 0), 4.2, 1e-11);
  CHECK_NEAR(Value(filter->GetOutput(), "SignedDistance", 0), 4.2, 1e-11);
  CHECK(Value(filter->GetOutput(), "Status", 1) == 3); // the line misses the sphere
  vtkPolyData* feet = filter->GetFootPointsOutput();
  CHECK(feet->GetNumberOfPoints() == 2);
  CHECK_NEAR(feet->GetPoint(0)[2], 0.8, 1e-11);
  CHECK_NEAR(feet->GetPoint(1)[2], -0.8, 1e-11);
  CHECK_NEAR(Value(feet, "Distance", 1), 5.8, 1e-11);
}

void TestOrthogonalOnly()
{
  vtkNew<vtkPointInversionFilter> filter;
  filter->SetInputData(MakePoints({ { { 0.5, 0.5, 3 } }, { { 2, 0.5, 0 } } }));
  filter->SetSourceData(MakeSquare());
  filter->Update();
  CHECK(Value(filter->GetOutput(), "FootType", 0) == vtkPointInversionFilter::INTERIOR);
  CHECK(Value(filter->GetOutput(), "FootType", 1) == vtkPointInversionFilter::EDGE);
  CHECK(Value(filter->GetOutput(), "Status", 1) == vtkPointInversionFilter::CONVERGED);
  filter->OrthogonalOnlyOn();
  filter->Update();
  CHECK(Value(filter->GetOutput(), "Status", 0) == vtkPointInversionFilter::CONVERGED);
  CHECK(Value(filter->GetOutput(), "Status", 1) == vtkPointInversionFilter::NO_ORTHOGONAL_FOOT);
  CHECK_NEAR(Value(filter->GetOutput(), "Distance", 1), 1.0, 1e-12);
}

void TestSeedsAndWarmStart()
{
  // Near both arms of the parabola; the seed decides on which one a local search ends.
  const auto points = MakePoints({ { { 0, 2, 0 } }, { { 0, 2, 0 } }, { { 0, 2, 0 } } });
  vtkNew<vtkPointInversionFilter> filter;
  filter->SetSourceData(MakeParabola());
  filter->SetSearchToLocal();
  AddNumbers(points->GetPointData(), "SeedParameters", { 1.0, -1.0, std::nan("") });
  filter->SetInputData(points);
  filter->Update();
  CHECK(Value(filter->GetOutput(), "Parameters", 0) > 1.0);
  CHECK(Value(filter->GetOutput(), "Parameters", 1) < -1.0);
  CHECK_NEAR(std::abs(Value(filter->GetOutput(), "Parameters", 2)), std::sqrt(1.5), 1e-9);
  CHECK(filter->GetNumberOfModelBuilds() == 1);

  // Surfaces take no seed of one component.
  vtkNew<vtkPointInversionFilter> on_surface;
  on_surface->SetSourceData(MakeSphere());
  on_surface->SetSearchToLocal();
  on_surface->SetInputData(points);
  on_surface->Update();
  CHECK_NEAR(Value(on_surface->GetOutput(), "Distance", 0), 1.0, 1e-12);

  // Of two faces the one of the seed is tried from there.
  const auto between = MakePoints({ { { 0, 2, 0 } } });
  AddNumbers(between->GetPointData(), "SeedParameters", { -1.0 });
  AddNumbers(between->GetPointData(), "SeedFaceId", { 1 });
  vtkNew<vtkMultiBlockDataSet> twins;
  twins->SetBlock(0, MakeParabola());
  twins->SetBlock(1, MakeParabola());
  filter->SetSourceData(twins);
  filter->SetInputData(between);
  filter->Update();
  CHECK_NEAR(Value(filter->GetOutput(), "Distance", 0), std::sqrt(1.75), 1e-12);
  filter->SetSourceData(MakeParabola());

  // A path on one arm; every point but the first starts from the foot before it.
  std::vector<Point> path;
  for (int i = 0; i < 50; ++i)
  {
    const double t = 1.5 - 0.02 * i;
    path.push_back({ { t, t * t, 0 } });
  }
  filter->SetInputData(MakePoints(path));
  filter->WarmStartOn();
  filter->Update();
  for (vtkIdType i = 0; i < 50; ++i)
  {
    CHECK_NEAR(Value(filter->GetOutput(), "Parameters", i), path[i][0], 1e-10);
  }
  CHECK(FieldValue(filter->GetOutput(), "DistanceCount") == 50);
}

} // namespace

int TestPointInversionOptions(int, char*[])
{
  return Run(
    []
    {
      TestDefaults();
      TestNames();
      TestAllFeet();
      TestFixedDirection();
      TestOrthogonalOnly();
      TestSeedsAndWarmStart();
    });
}
