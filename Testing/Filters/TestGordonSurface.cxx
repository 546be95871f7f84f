// SPDX-License-Identifier: BSD-3-Clause
// vtkGordonSurface: a known surface from curves in any order and direction, the report, inversion
// of the curves' points, errors.
#include "GridTesting.h"

#include "vtkGordonSurface.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPointInversionFilter.h"

using namespace testing;

namespace
{

/// A bicubic polynomial surface, whose isoparametric curves are cubics.
Point Hill(double u, double v)
{
  return { { 2.0 * u + 0.2 * v * v, 1.5 * v - 0.1 * u * u * u,
    u * u * v - 0.5 * v * v * v * u + 0.3 * u } };
}

/// The cubic Bézier curve through four points of a curve at 0, 1/3, 2/3, 1.
vtkSmartPointer<vtkStructuredGrid> Cubic(const Curve& curve, bool reversed)
{
  const std::vector<Point> p = Sample(curve, 4);
  std::vector<Point> control(4);
  for (int k = 0; k < 3; ++k)
  {
    control[0][k] = p[0][k];
    control[1][k] = (-5.0 * p[0][k] + 18.0 * p[1][k] - 9.0 * p[2][k] + 2.0 * p[3][k]) / 6.0;
    control[2][k] = (2.0 * p[0][k] - 9.0 * p[1][k] + 18.0 * p[2][k] - 5.0 * p[3][k]) / 6.0;
    control[3][k] = p[3][k];
  }
  if (reversed)
  {
    std::swap(control[0], control[3]);
    std::swap(control[1], control[2]);
  }
  return MakeNet(4, 1, control, {}, { 0, 0, 0, 0, 1, 1, 1, 1 });
}

vtkSmartPointer<vtkStructuredGrid> Profile(double v, bool reversed = false)
{
  return Cubic([=](double u) { return Hill(u, v); }, reversed);
}

vtkSmartPointer<vtkStructuredGrid> Guide(double u, bool reversed = false)
{
  return Cubic([=](double v) { return Hill(u, v); }, reversed);
}

void TestSurface()
{
  vtkNew<vtkGordonSurface> surface;
  vtkNew<vtkMultiBlockDataSet> profiles;
  profiles->SetBlock(0, Profile(0.4));
  profiles->SetBlock(2, Profile(1.0, true));
  profiles->SetBlock(3, Profile(0.0));
  surface->SetInputData(profiles);
  surface->AddInputData(Profile(0.7, true));
  vtkNew<vtkMultiBlockDataSet> guides;
  guides->SetBlock(0, Guide(0.0));
  guides->SetBlock(1, Guide(1.0));
  surface->AddGuidesData(guides);
  surface->AddGuidesData(Guide(0.25, true));
  surface->AddGuidesData(Guide(0.6));
  surface->Update();
  vtkStructuredGrid* net = surface->GetOutput();

  const int profile_order[] = { 2, 0, 3, 1 };
  const int guide_order[] = { 0, 2, 3, 1 };
  const double v[] = { 0.0, 0.4, 0.7, 1.0 };
  const double u[] = { 0.0, 0.25, 0.6, 1.0 };
  for (int k = 0; k < 4; ++k)
  {
    CHECK(FieldValue(net, "ProfileOrder", k) == profile_order[k]);
    CHECK(FieldValue(net, "GuideOrder", k) == guide_order[k]);
    CHECK(FieldValue(net, "ProfileReversed", k) == (k > 1));
    CHECK(FieldValue(net, "GuideReversed", k) == (k == 1));
    CHECK_NEAR(FieldValue(net, "ParametersU", k), u[k], 1e-9);
    CHECK_NEAR(FieldValue(net, "ParametersV", k), v[k], 1e-9);
  }
  CHECK(FieldValue(net, "LargestGap") <= 1e-12);
  CHECK(FieldValue(net, "ReparametrizationError") == 0.0);

  std::vector<Point> points;
  for (int i = 0; i <= 6; ++i)
  {
    for (int j = 0; j <= 6; ++j)
    {
      points.push_back(Hill(i / 6.0, j / 6.0));
    }
  }
  vtkNew<vtkPointInversionFilter> inversion;
  inversion->SetInputData(MakePoints(points));
  inversion->SetSourceConnection(surface->GetOutputPort());
  inversion->Update();
  for (vtkIdType i = 0; i < 49; ++i)
  {
    CHECK(Value(inversion->GetOutput(), "Distance", i) <= 1e-11);
    CHECK_NEAR(Value(inversion->GetOutput(), "Parameters", i, 0), (i / 7) / 6.0, 1e-8);
    CHECK_NEAR(Value(inversion->GetOutput(), "Parameters", i, 1), (i % 7) / 6.0, 1e-8);
  }
}

std::string ErrorOf(const std::vector<vtkSmartPointer<vtkStructuredGrid>>& profiles,
  const std::vector<vtkSmartPointer<vtkStructuredGrid>>& guides)
{
  vtkNew<vtkGordonSurface> surface;
  vtkNew<MessageRecorder> recorder;
  recorder->Watch(surface);
  for (const auto& curve : profiles)
  {
    surface->AddInputData(curve);
  }
  for (const auto& curve : guides)
  {
    surface->AddGuidesData(curve);
  }
  surface->Update();
  CHECK(surface->GetOutput()->GetNumberOfPoints() == 0);
  return recorder->Errors;
}

void TestErrors()
{
  CHECK(!ErrorOf({ Profile(0) }, { Guide(0), Guide(1) }).empty());
  CHECK(Contains(ErrorOf({ Profile(0), MakeSquare() }, { Guide(0), Guide(1) }), "profile 1"));
  const auto far = Cubic(
    [](double t)
    {
      Point p = Hill(t, 0.5);
      p[2] += 3;
      return p;
    },
    false);
  CHECK(!ErrorOf({ Profile(0), far, Profile(1) }, { Guide(0), Guide(1) }).empty());
}

} // namespace

int TestGordonSurface(int, char*[])
{
  return Run(
    []
    {
      TestSurface();
      TestErrors();
    });
}
