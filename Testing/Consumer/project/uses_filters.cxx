// SPDX-License-Identifier: BSD-3-Clause
// One point above a bilinear unit square, through the installed Footpoint::Filters.
#include <vtkDataObject.h>
#include <vtkDataSet.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPointInversionFilter.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStructuredGrid.h>

#include <cmath>
#include <iostream>

int main()
{
  vtkNew<vtkPoints> corners;
  corners->InsertNextPoint(0.0, 0.0, 0.0);
  corners->InsertNextPoint(1.0, 0.0, 0.0);
  corners->InsertNextPoint(0.0, 1.0, 0.0);
  corners->InsertNextPoint(1.0, 1.0, 0.0);
  vtkNew<vtkStructuredGrid> square;
  square->SetDimensions(2, 2, 1);
  square->SetPoints(corners);
  for (const char* name : { "KnotsU", "KnotsV" })
  {
    vtkNew<vtkDoubleArray> knots;
    knots->SetName(name);
    for (double knot : { 0.0, 0.0, 1.0, 1.0 })
    {
      knots->InsertNextValue(knot);
    }
    square->GetFieldData()->AddArray(knots);
  }

  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0.25, 0.5, 2.0);
  vtkNew<vtkPolyData> query;
  query->SetPoints(points);

  vtkNew<vtkPointInversionFilter> inversion;
  inversion->SetInputData(query);
  inversion->SetSourceData(square);
  inversion->Update();

  vtkDataSet* result = vtkDataSet::SafeDownCast(inversion->GetOutputDataObject(0));
  vtkDataArray* distance = result ? result->GetPointData()->GetArray("Distance") : nullptr;
  if (!distance || distance->GetNumberOfTuples() != 1)
  {
    std::cerr << "no distance\n";
    return 1;
  }
  if (!(std::abs(distance->GetTuple1(0) - 2.0) <= 1e-12))
  {
    std::cerr << "the distance is " << distance->GetTuple1(0) << ", not 2\n";
    return 1;
  }
  return 0;
}
