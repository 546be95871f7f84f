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

namespace
{

vtkSmartPointer<vtkIntArray> new_flags(vtkIdType cells)
{
  auto array = vtkSmartPointer<vtkIntArray>::New();
  array->SetName("Folded");
  array->SetNumberOfValues(cells);
  return array;
}

} // namespace

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

GridView view_grid(vtkStructuredGrid* grid)
{
  int dimensions[3];
  grid->GetDimensions(dimensions);
  auto* points = vtkDoubleArray::SafeDownCast(grid->GetPoints()->GetData());
  return GridView({ { dimensions[0], dimensions[1] } }, points->GetPointer(0));
}

vtkSmartPointer<vtkDoubleArray> new_array(const char* name, int components, vtkIdType tuples)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  return array;
}

vtkSmartPointer<vtkDoubleArray> make_array(const char* name,
  const Eigen::Ref<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic>>& columns)
{
  auto array = new_array(name, static_cast<int>(columns.rows()), columns.cols());
  Eigen::Map<Eigen::MatrixXd>(array->GetPointer(0), columns.rows(), columns.cols()) = columns;
  return array;
}

std::int64_t attach_quality(const GridView& grid, vtkCellData* data)
{
  const vtkIdType cells =
    vtkIdType(std::max(0, grid.count[0] - 1)) * std::max(0, grid.count[1] - 1);
  auto jacobian = new_array("Jacobian", 1, cells);
  auto folded = new_flags(cells);
  const Folds folds = find_folds(grid, jacobian->GetPointer(0), folded->GetPointer(0));
  data->AddArray(jacobian);
  data->AddArray(folded);
  return folds.count;
}

void attach_quality(const GridQuality<3>& quality, vtkCellData* data)
{
  data->AddArray(make_array("Jacobian", quality.scaled_jacobian.transpose()));
  auto folded = new_flags(quality.folded.size());
  for (Eigen::Index i = 0; i < quality.folded.size(); ++i)
  {
    folded->SetValue(i, quality.folded[i] ? 1 : 0);
  }
  data->AddArray(folded);
}

void attach_normals(const GridView& grid, vtkPointData* data)
{
  auto normals = new_array("Normals", 3, grid.points.cols());
  fill_point_normals(grid, Eigen::Map<Points>(normals->GetPointer(0), 3, grid.points.cols()));
  data->SetNormals(normals);
}

void attach_texture_coordinates(const std::array<int, 2>& count, vtkPointData* data)
{
  const vtkIdType size = vtkIdType(count[0]) * count[1];
  auto coordinates = new_array("TCoords", 2, size);
  fill_texture_coordinates(
    count, Eigen::Map<Eigen::Matrix2Xd>(coordinates->GetPointer(0), 2, size));
  data->SetTCoords(coordinates);
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
