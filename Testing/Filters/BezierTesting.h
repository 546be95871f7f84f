// SPDX-License-Identifier: BSD-3-Clause
// What the tests of Bézier cells and of shapes share: feet, cells, and VTK's own evaluation of
// them.

#ifndef BezierTesting_h
#define BezierTesting_h

#include "FilterTesting.h"

#include "vtkBezierExtraction.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkCompositeDataSet.h"
#include "vtkInformation.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPointInversionFilter.h"
#include "vtkSplineEvaluator.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>

namespace testing
{

/// Feet of points.
inline vtkSmartPointer<vtkPolyData> Feet(vtkDataObject* geometry, const std::vector<Point>& points)
{
  vtkNew<vtkPointInversionFilter> filter;
  filter->SetInputData(MakePoints(points));
  filter->SetSourceData(geometry);
  filter->Update();
  vtkSmartPointer<vtkPolyData> feet = vtkPolyData::SafeDownCast(filter->GetOutput());
  CHECK(feet && feet->GetNumberOfPoints() == vtkIdType(points.size()));
  return feet;
}

inline vtkSmartPointer<vtkUnstructuredGrid> Extract(vtkDataObject* geometry)
{
  vtkNew<vtkBezierExtraction> extraction;
  extraction->SetInputDataObject(geometry);
  extraction->Update();
  vtkSmartPointer<vtkUnstructuredGrid> grid = extraction->GetOutput();
  return grid;
}

inline double CellValue(
  vtkUnstructuredGrid* grid, const char* name, vtkIdType cell, int component = 0)
{
  vtkDataArray* array = grid->GetCellData()->GetArray(name);
  CHECK(array != nullptr);
  return array->GetComponent(cell, component);
}

/// The points of faces of a geometry at rows of parameters.
inline std::vector<Point> Evaluate(
  vtkDataObject* geometry, const std::vector<Point>& parameters, const std::vector<double>& faces)
{
  vtkNew<vtkTable> table;
  vtkNew<vtkDoubleArray> rows;
  rows->SetName("Parameters");
  rows->SetNumberOfComponents(2);
  for (const Point& parameter : parameters)
  {
    rows->InsertNextTuple(parameter.data());
  }
  table->AddColumn(rows);
  AddNumbers(table->GetRowData(), "FaceId", faces);
  vtkNew<vtkSplineEvaluator> evaluator;
  evaluator->SetInputData(table);
  evaluator->SetSourceData(geometry);
  evaluator->Update();
  std::vector<Point> points(parameters.size());
  CHECK(evaluator->GetOutput()->GetNumberOfPoints() == vtkIdType(parameters.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    evaluator->GetOutput()->GetPoint(static_cast<vtkIdType>(i), points[i].data());
  }
  return points;
}

/// Largest distance between all cells, as VTK evaluates them, and the geometry.
inline double EvaluationError(vtkDataObject* geometry, vtkUnstructuredGrid* grid)
{
  std::vector<Point> parameters;
  std::vector<double> faces;
  std::vector<Point> of_vtk;
  for (vtkIdType id = 0; id < grid->GetNumberOfCells(); ++id)
  {
    vtkCell* cell = grid->GetCell(id);
    const bool curve = cell->GetCellType() == VTK_BEZIER_CURVE;
    std::vector<double> weights(static_cast<std::size_t>(cell->GetNumberOfPoints()));
    for (const double v : { 0.03125, 0.4375, 0.96875 })
    {
      for (const double u : { 0.0625, 0.5, 0.8125 })
      {
        const double pcoords[3] = { u, curve ? 0.0 : v, 0.0 };
        Point point;
        int sub = 0;
        cell->EvaluateLocation(sub, pcoords, point.data(), weights.data());
        of_vtk.push_back(point);
        const auto at = [&](int direction, double fraction)
        {
          const double start = CellValue(grid, "ParameterRange", id, 2 * direction);
          const double end = CellValue(grid, "ParameterRange", id, 2 * direction + 1);
          return start + fraction * (end - start);
        };
        parameters.push_back({ { at(0, u), curve ? 0.0 : at(1, v), 0.0 } });
        faces.push_back(CellValue(grid, "FaceId", id));
      }
    }
  }
  const std::vector<Point> ours = Evaluate(geometry, parameters, faces);
  double worst = 0.0;
  for (std::size_t i = 0; i < ours.size(); ++i)
  {
    worst = std::max(worst,
      std::hypot(ours[i][0] - of_vtk[i][0], ours[i][1] - of_vtk[i][1], ours[i][2] - of_vtk[i][2]));
  }
  return worst;
}

/// Knots with inner multiplicities 1 … degree, every second time not clamped.
inline std::vector<double> SomeKnots(int degree, bool clamped)
{
  std::vector<double> knots;
  for (int i = 0; i <= degree; ++i)
  {
    knots.push_back(clamped ? 1.5 : 1.5 - 0.25 * (degree - i));
  }
  for (int multiplicity = 1; multiplicity <= degree; ++multiplicity)
  {
    knots.insert(knots.end(), multiplicity, 1.5 + multiplicity * 0.7);
  }
  for (int i = 0; i <= degree; ++i)
  {
    knots.push_back(1.5 + (degree + 1) * 0.7 + (clamped ? 0.0 : 0.25 * i));
  }
  return knots;
}

/// Random control points in a cube of edge 2, random weights in [0.2, 5].
inline vtkSmartPointer<vtkStructuredGrid> RandomNet(int p, int q, bool rational, bool clamped)
{
  const std::vector<double> u = SomeKnots(p, clamped);
  const std::vector<double> v = q > 0 ? SomeKnots(q, clamped) : std::vector<double>();
  const int nu = static_cast<int>(u.size()) - p - 1;
  const int nv = q > 0 ? static_cast<int>(v.size()) - q - 1 : 1;
  std::vector<double> weights;
  if (rational)
  {
    for (const Point& x : RandomPoints(nu * nv, 1.0, 7))
    {
      weights.push_back(std::pow(5.0, x[0]));
    }
  }
  return MakeNet(nu, nv, RandomPoints(nu * nv, 1.0, 40 * p + q), weights, u, v);
}

/// Sets the attributes of a face.
inline void Name(vtkDataObject* leaf, const char* name, int orientation, double tolerance)
{
  vtkNew<vtkStringArray> names;
  names->SetName("FaceName");
  names->InsertNextValue(name);
  leaf->GetFieldData()->AddArray(names);
  AddNumbers(leaf->GetFieldData(), "Orientation", { double(orientation) });
  AddNumbers(leaf->GetFieldData(), "Tolerance", { tolerance });
  vtkNew<vtkStringArray> unit;
  unit->SetName("LengthUnit");
  unit->InsertNextValue("mm");
  leaf->GetFieldData()->AddArray(unit);
}

/// A torus, nothing, a reversed square, a curve.
inline vtkSmartPointer<vtkMultiBlockDataSet> MakeModel()
{
  auto model = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  model->SetBlock(0, MakeTorus());
  model->SetBlock(1, nullptr);
  model->SetBlock(2, MakeSquare(2.5));
  model->SetBlock(3, MakeParabola());
  Name(model->GetBlock(0), "ring", 1, 0.0);
  Name(model->GetBlock(2), "lid", -1, 0.125);
  model->GetMetaData(3u)->Set(vtkCompositeDataSet::NAME(), "wire");
  return model;
}

} // namespace testing

#endif
