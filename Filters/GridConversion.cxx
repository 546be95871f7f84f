// SPDX-License-Identifier: BSD-3-Clause
#include "GridConversion.h"

#include "FieldArrays.h"

#include "footpoint/grids/boundary_error.h"
#include "footpoint/grids/grid_faces.h"

#include "vtkCellData.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkStructuredGrid.h"

#include <algorithm>

namespace footpoint::conversion
{

vtkSmartPointer<vtkPoints> make_points(const Points& points)
{
  auto result = vtkSmartPointer<vtkPoints>::New();
  result->SetData(make_array("Points", points));
  return result;
}

Grid read_grid(vtkStructuredGrid* input, const std::string& name)
{
  int dimensions[3];
  input->GetDimensions(dimensions);
  const int* flat = std::find(dimensions, dimensions + 3, 1);
  Grid grid;
  if (flat == dimensions + 3 || input->GetNumberOfPoints() == 0 || !input->GetPoints())
  {
    throw BoundaryError(BoundaryDefect::Resolution,
      name + " has " + std::to_string(dimensions[0]) + " x " + std::to_string(dimensions[1]) +
        " x " + std::to_string(dimensions[2]) + " points; one dimension must be 1");
  }
  // Of (n, 1, 1) the last is left out, so that the message names n x 1.
  const int left_out = dimensions[2] == 1 ? 2 : static_cast<int>(flat - dimensions);
  grid.count = { { dimensions[left_out == 0 ? 1 : 0], dimensions[left_out == 2 ? 1 : 2] } };
  if (grid.count[0] < 2 || grid.count[1] < 2)
  {
    throw BoundaryError(BoundaryDefect::Resolution,
      name + " has " + std::to_string(grid.count[0]) + " x " + std::to_string(grid.count[1]) +
        " points; at least 2 are needed in each direction");
  }
  grid.points.resize(3, input->GetNumberOfPoints());
  for (vtkIdType i = 0; i < input->GetNumberOfPoints(); ++i)
  {
    input->GetPoint(i, grid.points.col(i).data());
    if (!grid.points.col(i).allFinite())
    {
      throw BoundaryError(
        BoundaryDefect::NotFinite, "point " + std::to_string(i) + " of " + name + " is not finite");
    }
  }
  return grid;
}

vtkSmartPointer<vtkDoubleArray> make_array(const char* name,
  const Eigen::Ref<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic>>& columns)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(static_cast<int>(columns.rows()));
  array->SetNumberOfTuples(columns.cols());
  Eigen::Map<Eigen::MatrixXd>(array->GetPointer(0), columns.rows(), columns.cols()) = columns;
  return array;
}

template <int N>
void attach_quality(const GridQuality<N>& quality, vtkCellData* data)
{
  data->AddArray(make_array("Jacobian", quality.scaled_jacobian.transpose()));
  vtkNew<vtkIntArray> folded;
  folded->SetName("Folded");
  folded->SetNumberOfValues(quality.folded.size());
  for (Eigen::Index i = 0; i < quality.folded.size(); ++i)
  {
    folded->SetValue(i, quality.folded[i] ? 1 : 0);
  }
  data->AddArray(folded);
}

template void attach_quality<2>(const GridQuality<2>& quality, vtkCellData* data);
template void attach_quality<3>(const GridQuality<3>& quality, vtkCellData* data);

void attach_normals(const Grid& grid, vtkPointData* data)
{
  data->SetNormals(make_array("Normals", point_normals(grid)));
}

int smoothing_status(const SmoothingResult& result, Smoothing method)
{
  const bool automatic = method == Smoothing::Auto;
  if (method == Smoothing::None || (automatic && result.folds_before == 0))
  {
    return 0;
  }
  if (!result.changed)
  {
    return result.converged && !automatic ? 1 : 3;
  }
  return result.converged ? 1 : 2;
}

void attach_folds(const SmoothingResult& result, int status, vtkFieldData* data)
{
  set_count(data, "FoldedCellsBefore", result.folds_before);
  set_count(data, "FoldedCellsAfter", result.folds_after);
  set_integer(data, "SmoothingStatus", status);
}

} // namespace footpoint::conversion
