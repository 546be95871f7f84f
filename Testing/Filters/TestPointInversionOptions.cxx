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
  CHECK(filter->GetCertificateTolerance() == core.certificate_tolerance);
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
    filter->SetSearchToSeeded();
    filter->Update();
    CHECK(Value(filter->GetOutput(), "Status", 0) == Filter::CONVERGED);
    CHECK_NEAR(Value(filter->GetOutput(), "Distance", 0), expected, 1e-10);
    // The certified search has a step of its own.
    filter->SetSearchToGlobal();
    filter->Update();
    CHECK(Value(filter->GetOutput(), "Status", 0) == Filter::CERTIFIED);
    CHECK(Value(filter->GetOutput(), "Distance", 0) == expected);
  }

  filter->SetMethod(1000);
  CHECK(filter->GetMethod() == Filter::SECOND_ORDER_3);
  std::ostringstream text;
  filter->Print(text);
  for (const char* name : { "Search: Global", "Method: SecondOrder3", "CertificateTolerance: 1e-12",
         "MaximumDistance: 1e+299", "GenerateIterations: On", "NumberOfModelBuilds: 1" })
  {
    CHECK(Contains(text.str(), name));
  }
}

/// Without a tolerance nothing is certified; the feet are the same.
void TestCertificateTolerance()
{
  vtkNew<vtkPointInversionFilter> filter;
  filter->SetInputData(MakePoints(RandomPoints(100, 4.0)));
  filter->SetSourceData(MakeTorus());
  filter->Update();
  vtkNew<vtkPointInversionFilter> bare;
  bare->SetInputData(filter->GetInput());
  bare->SetSourceData(MakeTorus());
  bare->SetCertificateTolerance(0.0);
  CHECK(bare->GetCertificateTolerance() == 0.0);
  bare->Update();
  for (vtkIdType i = 0; i < 100; ++i)
  {
    CHECK(Value(filter->GetOutput(), "Status", i) == vtkPointInversionFilter::CERTIFIED);
    CHECK(Value(bare->GetOutput(), "Status", i) == vtkPointInversionFilter::CONVERGED);
  }
  for (vtkIdType i = 0; i < 100; ++i)
  {
    for (const char* name : { "Distance", "ClosestPoint", "Normal", "FootType", "FaceId" })
    {
      for (int k = 0; k < PointArray(bare->GetOutput(), name)->GetNumberOfComponents(); ++k)
      {
        CHECK_NEAR(
          Value(bare->GetOutput(), name, i, k), Value(filter->GetOutput(), name, i, k), 1e-11);
      }
    }
  }
  CHECK(FieldValue(filter->GetOutput(), "StatusCounts", 0) == 100);
  CHECK(FieldValue(bare->GetOutput(), "StatusCounts", 1) == 100);
  // It asks for no other structure.
  bare->SetCertificateTolerance(1e-9);
  bare->Update();
  CHECK(Value(bare->GetOutput(), "Status", 0) == vtkPointInversionFilter::CERTIFIED);
  CHECK(bare->GetNumberOfModelBuilds() == 1);
  bare->SetCertificateTolerance(-1.0);
  CHECK(bare->GetCertificateTolerance() == 0.0);
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
  CHECK(Value(feet, "Status", 0) == vtkPointInversionFilter::CONVERGED); // one of several
  CHECK(Value(filter->GetOutput(), "Status", 0) == vtkPointInversionFilter::CERTIFIED);
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

  // The feet of a line are neither minima nor orthogonal, so other lists do not go with it.
  vtkNew<MessageRecorder> recorder;
  recorder->Watch(filter);
  filter->AllFeetOn();
  filter->Update();
  CHECK(Contains(recorder->Errors, "FixedDirection"));
  CHECK(Contains(recorder->Errors, "does not go together with AllFeet or OrthogonalOnly"));
  recorder->Errors.clear();
  filter->AllFeetOff();
  filter->OrthogonalOnlyOn();
  filter->Update();
  CHECK(Contains(recorder->Errors, "does not go together with AllFeet or OrthogonalOnly"));
  recorder->Errors.clear();
  filter->OrthogonalOnlyOff();
  filter->Update();
  CHECK(recorder->Errors.empty());
  CHECK(filter->GetFootPointsOutput()->GetNumberOfPoints() == 2);
}

void TestOrthogonalOnly()
{
  vtkNew<vtkPointInversionFilter> filter;
  filter->SetInputData(MakePoints({ { { 0.5, 0.5, 3 } }, { { 2, 0.5, 0 } } }));
  filter->SetSourceData(MakeSquare());
  filter->Update();
  CHECK(Value(filter->GetOutput(), "FootType", 0) == vtkPointInversionFilter::INTERIOR);
  CHECK(Value(filter->GetOutput(), "FootType", 1) == vtkPointInversionFilter::EDGE);
  CHECK(Value(filter->GetOutput(), "Status", 1) == vtkPointInversionFilter::CERTIFIED);
  filter->OrthogonalOnlyOn();
  filter->Update();
  CHECK(Value(filter->GetOutput(), "Status", 0) == vtkPointInversionFilter::CONVERGED);
  CHECK(Value(filter->GetOutput(), "Status", 1) == vtkPointInversionFilter::NO_ORTHOGONAL_FOOT);
  CHECK_NEAR(Value(filter->GetOutput(), "Distance", 1), 1.0, 1e-12);
}

void TestSeeds()
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

  // The certified search takes none: a tie has one answer.
  filter->SetSearchToGlobal();
  filter->Update();
  for (vtkIdType i = 0; i < 3; ++i)
  {
    CHECK(Value(filter->GetOutput(), "Parameters", i) < -1.0);
  }

  // Surfaces take no seed of one component.
  vtkNew<vtkPointInversionFilter> on_surface;
  on_surface->SetSourceData(MakeSphere());
  on_surface->SetSearchToLocal();
  on_surface->SetInputData(points);
  on_surface->Update();
  CHECK_NEAR(Value(on_surface->GetOutput(), "Distance", 0), 1.0, 1e-12);
}

/// Only the face of the seed is searched from the seed.
void TestSeedFaceId()
{
  vtkNew<vtkMultiBlockDataSet> faces;
  faces->SetBlock(0, MakeParabola());
  faces->SetBlock(1, MakeParabola());
  vtkNew<vtkPointInversionFilter> filter;
  filter->SetSourceData(faces);
  filter->SetSearchToLocal();
  // A little right of the middle, so that the right arm is the nearest: a start on the left ends on
  // the left arm, which is farther.
  const auto points = MakePoints({ { { 0.01, 2, 0 } }, { { 0.01, 2, 0 } }, { { 0.01, 2, 0 } } });
  AddNumbers(points->GetPointData(), "SeedParameters", { -1.2, -1.2, -1.2 });
  AddNumbers(points->GetPointData(), "SeedFaceId", { 0, 1, -1 });
  filter->SetInputData(points);
  filter->Update();
  // The face without a seed starts from the best sample, on the right.
  CHECK(Value(filter->GetOutput(), "FaceId", 0) == 1);
  CHECK(Value(filter->GetOutput(), "Parameters", 0) > 1.0);
  CHECK(Value(filter->GetOutput(), "FaceId", 1) == 0);
  CHECK(Value(filter->GetOutput(), "Parameters", 1) > 1.0);
  // For every face: both end on the left.
  CHECK(Value(filter->GetOutput(), "FaceId", 2) == 0);
  CHECK(Value(filter->GetOutput(), "Parameters", 2) < -1.0);
}

/// A path that comes from the right and crosses the middle plane, where the nearest arm changes:
/// started from the foot before, a local search stays on its arm.
void TestWarmStart()
{
  std::vector<Point> path;
  for (int i = 0; i < 21; ++i)
  {
    path.push_back({ { 0.2 - 0.02 * i, 2, 0 } });
  }
  vtkNew<vtkPointInversionFilter> filter;
  filter->SetSourceData(MakeParabola());
  filter->SetInputData(MakePoints(path));
  filter->SetSearchToLocal();
  filter->Update();
  CHECK(Value(filter->GetOutput(), "Parameters", 20) < -1.0);
  filter->WarmStartOn();
  filter->Update();
  for (vtkIdType i = 0; i < 21; ++i)
  {
    CHECK(Value(filter->GetOutput(), "Parameters", i) > 1.0);
    CHECK(Value(filter->GetOutput(), "Status", i) == vtkPointInversionFilter::CONVERGED);
  }
  // 2 t³ − 3 t + 0.2 = 0 has its foot on the right arm at the end of the path.
  const double t = Value(filter->GetOutput(), "Parameters", 20);
  CHECK_NEAR(2.0 * t * t * t - 3.0 * t + 0.2, 0.0, 1e-9);
  CHECK(FieldValue(filter->GetOutput(), "DistanceCount") == 21);
  // Each block of a composite is a path of its own.
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, MakePoints(path));
  blocks->SetBlock(1, MakePoints({ { { -0.2, 2, 0 } } }));
  filter->SetInputData(blocks);
  filter->Update();
  auto* output = vtkMultiBlockDataSet::SafeDownCast(filter->GetOutput());
  CHECK(Value(output->GetBlock(0), "Parameters", 20) > 1.0);
  CHECK(Value(output->GetBlock(1), "Parameters", 0) < -1.0);
  // The certified search finds the nearest foot whatever came before.
  filter->SetInputData(MakePoints(path));
  filter->SetSearchToGlobal();
  filter->Update();
  CHECK(Value(filter->GetOutput(), "Parameters", 20) < -1.0);
}

} // namespace

int TestPointInversionOptions(int, char*[])
{
  return Run(
    []
    {
      TestDefaults();
      TestNames();
      TestCertificateTolerance();
      TestAllFeet();
      TestFixedDirection();
      TestOrthogonalOnly();
      TestSeeds();
      TestSeedFaceId();
      TestWarmStart();
    });
}
