// SPDX-License-Identifier: BSD-3-Clause
#include "filter_timing.h"

#include "timing.h"

#include <vtkDataSet.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPointInversionFilter.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>
#include <vtkStructuredGrid.h>

#include <stdexcept>

namespace inversion_benchmark
{
namespace
{

vtkSmartPointer<vtkPoints> vtk_points(const Points& columns)
{
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(columns.cols());
  for (vtkIdType k = 0; k < columns.cols(); ++k)
  {
    points->SetPoint(k, columns.col(k).data());
  }
  return points;
}

void add_knots(vtkFieldData* data, const char* name, const footpoint::KnotVector& knots)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  for (const double knot : knots.knots())
  {
    array->InsertNextValue(knot);
  }
  data->AddArray(array);
}

} // namespace

struct FilterTiming::Implementation
{
  vtkNew<vtkStructuredGrid> Source;
  vtkNew<vtkPolyData> Input;
};

FilterTiming::FilterTiming(const Shape& shape, const Points& points)
  : Data(std::make_unique<Implementation>())
{
  const footpoint::Surface& s = *shape.surface;
  this->Data->Source->SetDimensions(
    s.knots(0).number_of_control_points(), s.knots(1).number_of_control_points(), 1);
  this->Data->Source->SetPoints(vtk_points(shape.control_points()));
  add_knots(this->Data->Source->GetFieldData(), "KnotsU", s.knots(0));
  add_knots(this->Data->Source->GetFieldData(), "KnotsV", s.knots(1));
  this->Data->Input->SetPoints(vtk_points(points));
}

FilterTiming::~FilterTiming() = default;

FilterTiming::Times FilterTiming::run(int threads) const
{
  Times spent{};
  const auto work = [&]
  {
    vtkNew<vtkPointInversionFilter> filter;
    filter->SetInputData(this->Data->Input);
    filter->SetSourceData(this->Data->Source);
    spent.cpu = cpu_seconds([&] { spent.wall = seconds([&] { filter->Update(); }); });
    auto* const output = vtkDataSet::SafeDownCast(filter->GetOutputDataObject(0));
    if (output == nullptr || output->GetPointData()->GetArray("Distance") == nullptr)
    {
      throw std::runtime_error("the filter gave no distances");
    }
  };
  if (threads == 1)
  {
    vtkSMPTools::LocalScope(vtkSMPTools::Config{ 1, "Sequential", false }, work);
  }
  else
  {
    vtkSMPTools::LocalScope(vtkSMPTools::Config{ threads, "STDThread", false }, work);
  }
  return spent;
}

} // namespace inversion_benchmark
