// SPDX-License-Identifier: BSD-3-Clause
// vtkCoonsSurface: the definition at random parameters, order and directions, inversion of its own
// points, errors.
#include "GridTesting.h"

#include "vtkCoonsSurface.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPointInversionFilter.h"
#include "vtkSplineEvaluator.h"

#include <algorithm>

using namespace testing;

namespace
{

/// A quarter of the unit circle, from an angle on, as a rational quadratic.
vtkSmartPointer<vtkStructuredGrid> QuarterCircle(double start)
{
  std::vector<Point> points = Arc(0.0, 1.0, start, 1);
  std::vector<double> weights;
  for (Point& point : points)
  {
    weights.push_back(point[2]);
    point[2] = 0.0;
  }
  return MakeNet(3, 1, points, weights, ArcKnots(1));
}

/// A cubic with one inner knot.
vtkSmartPointer<vtkStructuredGrid> Cubic(const std::vector<Point>& points)
{
  return MakeNet(5, 1, points, {}, { 2, 2, 2, 2, 3, 5, 5, 5, 5 });
}

/// Points of a geometry at parameters scaled to [0, 1].
std::vector<Point> Evaluate(
  vtkStructuredGrid* net, const std::vector<Point>& parameters, double first, double length)
{
  const auto data = MakePoints(parameters);
  vtkNew<vtkDoubleArray> array;
  array->SetName("Parameters");
  array->SetNumberOfComponents(2);
  for (const Point& p : parameters)
  {
    array->InsertNextTuple2(first + length * p[0], first + length * p[1]);
  }
  data->GetPointData()->AddArray(array);
  vtkNew<vtkSplineEvaluator> evaluator;
  evaluator->SetInputData(data);
  evaluator->SetSourceData(net);
  evaluator->Update();
  std::vector<Point> points(parameters.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    evaluator->GetOutput()->GetPoint(static_cast<vtkIdType>(i), points[i].data());
  }
  return points;
}

std::vector<Point> Parameters(int count)
{
  std::vector<Point> parameters = RandomPoints(count, 0.5);
  for (Point& p : parameters)
  {
    p = { { p[0] + 0.5, p[1] + 0.5, 0 } };
  }
  parameters[0] = { { 0, 0, 0 } };
  parameters[1] = { { 1, 1, 0 } };
  return parameters;
}

/// A surface against the definition with its four curves (bottom, right, top, left over [0, 1]).
void CheckDefinition(vtkStructuredGrid* net,
  const std::array<std::function<std::vector<Point>(const std::vector<Point>&)>, 4>& curves,
  double tolerance)
{
  const std::vector<Point> parameters = Parameters(200);
  const std::vector<Point> actual = Evaluate(net, parameters, 0.0, 1.0);
  std::vector<Point> along_v = parameters;
  for (Point& p : along_v)
  {
    std::swap(p[0], p[1]);
  }
  const auto bottom = curves[0](parameters);
  const auto top = curves[2](parameters);
  const auto right = curves[1](along_v);
  const auto left = curves[3](along_v);
  const auto ends = std::vector<Point>{ { { 0, 0, 0 } }, { { 1, 0, 0 } } };
  const auto low = curves[0](ends);
  const auto high = curves[2](ends);
  for (std::size_t i = 0; i < actual.size(); ++i)
  {
    const double s = parameters[i][0];
    const double t = parameters[i][1];
    for (int k = 0; k < 3; ++k)
    {
      const double expected = (1 - t) * bottom[i][k] + t * top[i][k] + (1 - s) * left[i][k] +
        s * right[i][k] - (1 - s) * (1 - t) * low[0][k] - s * (1 - t) * low[1][k] -
        (1 - s) * t * high[0][k] - s * t * high[1][k];
      CHECK_NEAR(actual[i][k], expected, tolerance);
    }
  }
}

/// Evaluation of a curve over [0, 1], perhaps from its end.
std::function<std::vector<Point>(const std::vector<Point>&)> Along(
  vtkSmartPointer<vtkStructuredGrid> curve, double first, double length, bool backwards)
{
  return [=](std::vector<Point> parameters)
  {
    for (Point& p : parameters)
    {
      p[0] = backwards ? 1.0 - p[0] : p[0];
    }
    return Evaluate(curve, parameters, first, length);
  };
}

/// The disk of four quarter circles that run around it; then every point is found again.
void TestDisk()
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  std::array<vtkSmartPointer<vtkStructuredGrid>, 4> arcs;
  for (int k = 0; k < 4; ++k)
  {
    arcs[k] = QuarterCircle((0.5 * k - 0.75) * vtkMath::Pi());
  }
  blocks->SetBlock(0, arcs[0]);
  blocks->SetBlock(1, arcs[2]);
  blocks->SetBlock(3, arcs[3]);
  blocks->SetBlock(4, arcs[1]);
  vtkNew<vtkCoonsSurface> surface;
  surface->SetInputData(blocks);
  surface->Update();
  vtkStructuredGrid* net = surface->GetOutput();
  CHECK(FieldValue(net, "Degree", 0) == 3 && FieldValue(net, "Degree", 1) == 3);
  CHECK(net->GetPointData()->GetRationalWeights() != nullptr);
  const int order[] = { 0, 3, 1, 2 };
  const int reversed[] = { 0, 0, 1, 1 };
  for (int role = 0; role < 4; ++role)
  {
    CHECK(FieldValue(net, "EdgeOrder", role) == order[role]);
    CHECK(FieldValue(net, "EdgeReversed", role) == reversed[role]);
    CHECK_NEAR(FieldValue(net, "CornerGaps", role), 0.0, 1e-15);
  }
  CheckDefinition(net,
    { { Along(arcs[0], 0, 1, false), Along(arcs[1], 0, 1, false), Along(arcs[2], 0, 1, true),
      Along(arcs[3], 0, 1, true) } },
    1e-14);

  const std::vector<Point> parameters = Parameters(50);
  vtkNew<vtkPointInversionFilter> inversion;
  inversion->SetInputData(MakePoints(Evaluate(net, parameters, 0.0, 1.0)));
  inversion->SetSourceConnection(surface->GetOutputPort());
  inversion->Update();
  for (vtkIdType i = 2; i < 50; ++i)
  {
    CHECK(Value(inversion->GetOutput(), "Distance", i) <= 1e-13);
    CHECK_NEAR(Value(inversion->GetOutput(), "Parameters", i, 0), parameters[i][0], 1e-10);
    CHECK_NEAR(Value(inversion->GetOutput(), "Parameters", i, 1), parameters[i][1], 1e-10);
  }
}

std::vector<Point> SpacePoints(const Point& a, const Point& b, double bulge)
{
  std::vector<Point> points;
  for (int i = 0; i < 5; ++i)
  {
    const double t = i / 4.0;
    points.push_back({ { a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]),
      a[2] + t * (b[2] - a[2]) + (i % 4 == 0 ? 0.0 : bulge * i) } });
  }
  return points;
}

void TestPolynomialSides()
{
  const Point c00{ { 0, 0, 0 } };
  const Point c10{ { 3, 0, 1 } };
  const Point c11{ { 3, 2, 0 } };
  const Point c01{ { 0, 2, 2 } };
  const auto bottom = Cubic(SpacePoints(c00, c10, 0.2));
  const auto right = MakeNet(2, 1, { c10, c11 }, {}, { 0, 0, 1, 1 });
  const auto top = Cubic(SpacePoints(c01, c11, -0.3));
  const auto left = Cubic(SpacePoints(c00, c01, 0.1));
  vtkNew<vtkCoonsSurface> surface;
  for (const auto& curve : { bottom, right, top, left })
  {
    surface->AddInputData(curve);
  }
  surface->Update();
  vtkStructuredGrid* net = surface->GetOutput();
  CHECK(net->GetPointData()->GetRationalWeights() == nullptr);
  CHECK(FieldValue(net, "Degree", 0) == 3 && FieldValue(net, "Degree", 1) == 3);
  CheckDefinition(net,
    { { Along(bottom, 2, 3, false), Along(right, 0, 1, false), Along(top, 2, 3, false),
      Along(left, 2, 3, false) } },
    1e-13);
}

std::string ErrorOf(const std::vector<vtkDataObject*>& curves)
{
  vtkNew<vtkCoonsSurface> surface;
  vtkNew<MessageRecorder> recorder;
  recorder->Watch(surface);
  for (vtkDataObject* curve : curves)
  {
    surface->AddInputData(curve);
  }
  surface->Update();
  CHECK(surface->GetOutput()->GetNumberOfPoints() == 0);
  return recorder->Errors;
}

void TestErrors()
{
  const auto arc = QuarterCircle(0.0);
  CHECK(Contains(ErrorOf({ arc, arc, arc }), "needs 4 curves; there are 3"));
  CHECK(Contains(ErrorOf({ arc, arc, arc, MakeSquare() }), "curve 3: it is no NURBS curve"));
  const auto line = MakeNet(2, 1, { { { 0, 0, 0 } }, { { 9, 9, 9 } } }, {}, { 0, 0, 1, 1 });
  CHECK(!ErrorOf({ arc, QuarterCircle(2.0), QuarterCircle(4.0), line }).empty());
  const auto bad = MakeNet(2, 1, { { { 0, 0, 0 } }, { { 9, 9, 9 } } }, {}, { 0, 0, 1, -1 });
  CHECK(Contains(ErrorOf({ arc, arc, bad, arc }), "curve 2: KnotsU"));
}

} // namespace

int TestCoonsSurface(int, char*[])
{
  return Run(
    []
    {
      TestDisk();
      TestPolynomialSides();
      TestErrors();
    });
}
