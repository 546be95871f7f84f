// SPDX-License-Identifier: BSD-3-Clause
// Splines as Bézier cells of VTK. Judges: VTK's own cells, which evaluate at given parameters
// without any code of ours, and feet on the nets that the cells were made from.
#include "BezierTesting.h"

#include "vtkDataSetSurfaceFilter.h"

using namespace testing;

namespace
{

void TestExactness()
{
  const double size = 2.0 * std::sqrt(3.0);
  for (const std::array<int, 2>& degree : std::vector<std::array<int, 2>>{
         { { 1, 1 } }, { { 3, 2 } }, { { 1, 4 } }, { { 5, 5 } }, { { 7, 3 } }, { { 12, 1 } } })
  {
    for (const bool rational : { false, true })
    {
      for (const bool clamped : { false, true })
      {
        const auto net = RandomNet(degree[0], degree[1], rational, clamped);
        const auto grid = Extract(net);
        CHECK(grid->GetNumberOfCells() == (degree[0] + 1) * (degree[1] + 1));
        CHECK(EvaluationError(net, grid) <= 1e-13 * size);
        // No point is there twice: neighbours share those on their border.
        CHECK(grid->GetNumberOfPoints() ==
          (degree[0] * (degree[0] + 1) + 1) * (degree[1] * (degree[1] + 1) + 1));
        CHECK((grid->GetPointData()->GetRationalWeights() != nullptr) == rational);
      }
    }
  }
  // === Curves
  for (const int degree : { 1, 2, 5, 12 })
  {
    const auto net = RandomNet(degree, 0, degree % 2 == 0, degree < 3);
    const auto grid = Extract(net);
    CHECK(grid->GetNumberOfCells() == degree + 1);
    CHECK(grid->GetNumberOfPoints() == degree * (degree + 1) + 1);
    CHECK(grid->GetCellData()->GetArray("ParameterRange")->GetNumberOfComponents() == 2);
    CHECK(EvaluationError(net, grid) <= 1e-13 * size);
  }
}

/// A cylinder of which the seam is closed to the bit, and whose border at u = 2 a gap may split.
vtkSmartPointer<vtkStructuredGrid> MakeCylinder(bool gap)
{
  const double half = std::sqrt(0.5);
  std::vector<Point> circle{ { { 1, 0, 1 } }, { { 1, 1, half } }, { { 0, 1, 1 } },
    { { -1, 1, half } }, { { -1, 0, 1 } }, { { -1, -1, half } }, { { 0, -1, 1 } },
    { { 1, -1, half } }, { { 1, 0, 1 } } };
  std::vector<double> knots = ArcKnots(4);
  if (gap)
  {
    circle.insert(circle.begin() + 4, { { -1.25, 0, 1 } });
    knots.insert(knots.begin() + 6, 2.0);
  }
  std::vector<Point> points;
  std::vector<double> weights;
  for (const double height : { 0.0, 3.0 })
  {
    for (const Point& point : circle)
    {
      points.push_back({ { point[0], point[1], height } });
      weights.push_back(point[2]);
    }
  }
  return MakeNet(static_cast<int>(circle.size()), 2, points, weights, knots, { 0, 0, 1, 1 });
}

void TestSharedPoints()
{
  CHECK(Extract(MakeCylinder(false))->GetNumberOfPoints() == 2 * 8);
  CHECK(Extract(MakeCylinder(true))->GetNumberOfPoints() == 2 * 9);
  // Twice extracted: the cells' ranges tell which are neighbours.
  const auto again = Extract(Extract(MakeCylinder(false)));
  CHECK(again->GetNumberOfPoints() == 2 * 8);
  CHECK(again->GetNumberOfCells() == 4);
  // sin(2π) is not 0: the seam of this sphere is closed to rounding alone, and stays apart. So do
  // the points of the poles, which differ in u.
  CHECK(Extract(MakeSphere())->GetNumberOfPoints() == 9 * 5);
  // A closed surface of one cell is no neighbour of itself.
  const auto tube = MakeNet(5, 2,
    { { { 1, 0, 0 } }, { { 1, 2, 0 } }, { { -2, 0, 0 } }, { { 1, -2, 0 } }, { { 1, 0, 0 } },
      { { 1, 0, 1 } }, { { 1, 2, 1 } }, { { -2, 0, 1 } }, { { 1, -2, 1 } }, { { 1, 0, 1 } } },
    {}, { 0, 0, 0, 0, 0, 1, 1, 1, 1, 1 }, { 0, 0, 1, 1 });
  CHECK(Extract(tube)->GetNumberOfPoints() == 10);
}

/// \param kinks whether the geometry has C0 lines
void CompareFeet(vtkDataObject* geometry, double size, bool kinks = false)
{
  const std::vector<Point> points = RandomPoints(400, 4.0);
  const auto of_net = Feet(geometry, points);
  const auto of_cells = Feet(Extract(geometry), points);
  vtkDataArray* parameters = PointArray(of_net, "Parameters");
  for (vtkIdType i = 0; i < 400; ++i)
  {
    for (const char* name : { "FaceId", "Status", "FootType", "Isolated" })
    {
      // At the end of a C0 line on the edge the net's foot is on an edge, the cells' at a vertex.
      const bool end_of_kink = std::string(name) == "FootType" &&
        Value(of_net, name, i) == vtkPointInversionFilter::EDGE &&
        Value(of_cells, name, i) == vtkPointInversionFilter::VERTEX;
      CHECK((kinks && end_of_kink) || Value(of_cells, name, i) == Value(of_net, name, i));
    }
    CHECK_NEAR(Value(of_cells, "Distance", i), Value(of_net, "Distance", i), 1e-13 * size);
    for (int k = 0; k < 3; ++k)
    {
      CHECK_NEAR(
        Value(of_cells, "ClosestPoint", i, k), Value(of_net, "ClosestPoint", i, k), 1e-13 * size);
    }
    for (int k = 0; k < parameters->GetNumberOfComponents(); ++k)
    {
      CHECK_NEAR(
        Value(of_cells, "Parameters", i, k), Value(of_net, "Parameters", i, k), 1e-13 * size);
    }
  }
}

void TestFeet()
{
  CompareFeet(MakeTorus(), 9.0);
  CompareFeet(MakeCylinder(false), 4.0);
  CompareFeet(RandomNet(3, 2, true, false), 3.5, true);
  CompareFeet(RandomNet(4, 5, false, true), 3.5, true);
  CompareFeet(MakeParabola(), 9.0);
  CompareFeet(MakeModel(), 9.0);
}

/// VTK's drawing of the cells lies on the sphere, and is one connected net within a face.
void TestDisplay()
{
  vtkNew<vtkBezierExtraction> extraction;
  extraction->SetInputData(MakeSphere());
  vtkNew<vtkDataSetSurfaceFilter> surface;
  surface->SetInputConnection(extraction->GetOutputPort());
  surface->SetNonlinearSubdivisionLevel(3);
  surface->Update();
  vtkPolyData* drawn = surface->GetOutput();
  // A cell has 2 by 2 quads of 2 triangles, which level 3 cuts twice into 4; all cells together are
  // a net of 33 by 17 points, no line of which is there twice.
  CHECK(drawn->GetNumberOfCells() == 8 * 2 * 2 * 2 * 16);
  CHECK(drawn->GetNumberOfPoints() == 33 * 17);
  for (vtkIdType i = 0; i < drawn->GetNumberOfPoints(); ++i)
  {
    CHECK_NEAR(Norm({ { drawn->GetPoint(i)[0], drawn->GetPoint(i)[1], drawn->GetPoint(i)[2] } }),
      1.0, 1e-6); // of floats
  }
}

} // namespace

int TestBezierExtraction(int, char*[])
{
  return Run(
    []
    {
      TestExactness();
      TestSharedPoints();
      TestFeet();
      TestDisplay();
    });
}
