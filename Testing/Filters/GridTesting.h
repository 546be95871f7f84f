// SPDX-License-Identifier: BSD-3-Clause
// What the tests of grids share: boundaries of which the answers are known.

#ifndef GridTesting_h
#define GridTesting_h

#include "FilterTesting.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkStructuredGrid.h"

#include <functional>

namespace testing
{

/// A polyline as polygonal data.
inline vtkSmartPointer<vtkPolyData> MakeLine(const std::vector<Point>& positions)
{
  auto data = MakePoints(positions);
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell(static_cast<int>(positions.size()));
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    lines->InsertCellPoint(static_cast<vtkIdType>(i));
  }
  data->SetLines(lines);
  return data;
}

using Curve = std::function<Point(double)>;

/// Evenly spaced samples of a curve over [0, 1].
inline std::vector<Point> Sample(const Curve& curve, int count)
{
  std::vector<Point> points;
  for (int i = 0; i < count; ++i)
  {
    points.push_back(curve(static_cast<double>(i) / (count - 1)));
  }
  return points;
}

/// Bottom, right, top, left.
using Sides = std::array<Curve, 4>;

/// The borders of a surface over [0, 1]².
inline Sides BordersOf(const std::function<Point(double, double)>& surface)
{
  return { { [=](double s) { return surface(s, 0); }, [=](double t) { return surface(1, t); },
    [=](double s) { return surface(s, 1); }, [=](double t) { return surface(0, t); } } };
}

/// A hyperbolic paraboloid, which bilinear interpolation of its borders reproduces.
inline Point Product(double u, double v)
{
  return { { u, v, u * v } };
}

inline Sides Swan()
{
  return { { [](double s) { return Point{ { s, 0, 0 } }; },
    [](double s) { return Point{ { 1 + 2 * s - 2 * s * s, s, 0 } }; },
    [](double s) { return Point{ { s, 1 - 3 * s + 3 * s * s, 0 } }; },
    [](double s) { return Point{ { 0, s, 0 } }; } } };
}

/// Its bilinear transfinite interpolant.
inline Point SwanPoint(double u, double v)
{
  return { { u * (1 + 2 * v - 2 * v * v), v * (1 - 3 * u + 3 * u * u), 0 } };
}

inline void AddSides(vtkAlgorithm* algorithm, const Sides& sides, int count)
{
  for (const Curve& side : sides)
  {
    algorithm->AddInputDataObject(MakeLine(Sample(side, count)));
  }
}

inline double CellValue(vtkDataSet* data, const char* name, vtkIdType cell)
{
  vtkDataArray* array = data->GetCellData()->GetArray(name);
  CHECK(array != nullptr && array->GetNumberOfTuples() == data->GetNumberOfCells());
  return array->GetComponent(cell, 0);
}

/// Checks dimensions and every point against a surface over [0, 1]².
inline void CheckGrid(vtkStructuredGrid* grid, int nu, int nv,
  const std::function<Point(double, double)>& surface, double tolerance)
{
  int dimensions[3];
  grid->GetDimensions(dimensions);
  CHECK(dimensions[0] == nu && dimensions[1] == nv && dimensions[2] == 1);
  CHECK(grid->GetNumberOfPoints() == nu * nv);
  for (int j = 0; j < nv; ++j)
  {
    for (int i = 0; i < nu; ++i)
    {
      const Point expected =
        surface(static_cast<double>(i) / (nu - 1), static_cast<double>(j) / (nv - 1));
      double actual[3];
      grid->GetPoint(i + nu * j, actual);
      for (int k = 0; k < 3; ++k)
      {
        CHECK_NEAR(actual[k], expected[k], tolerance);
      }
    }
  }
}

/// Writes down the progress and aborts at once if asked to.
class ProgressWatcher : public vtkCommand
{
public:
  vtkTypeMacro(ProgressWatcher, vtkCommand);
  static ProgressWatcher* New() { return new ProgressWatcher; }
  void Execute(vtkObject* caller, unsigned long, void* data) override
  {
    this->Steps.push_back(*static_cast<double*>(data));
    if (this->Abort && this->Steps.back() < 1.0)
    {
      vtkAlgorithm::SafeDownCast(caller)->SetAbortExecute(1);
    }
  }
  std::vector<double> Steps;
  bool Abort = false;
};

} // namespace testing

#endif
