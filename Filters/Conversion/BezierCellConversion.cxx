// SPDX-License-Identifier: BSD-3-Clause
#include "SplineConversion.h"

#include "footpoint/common/errors.h"

#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkHigherOrderQuadrilateral.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkUnstructuredGrid.h"
#include "vtkVariant.h"

#include <cmath>

namespace footpoint::conversion
{

namespace
{

/// Limit for `FaceId`, as every number up to the largest makes a face, if an empty one.
constexpr double kMaximumFaceId = 1e6;

[[noreturn]] void refuse(GeometryDefect defect, vtkIdType cell, const std::string& message)
{
  throw GeometryError(defect, "cell " + std::to_string(cell) + ": " + message);
}

/// The clamped knot vector of one Bézier piece.
KnotVector bezier_knots(int degree, double start, double end, const char* name)
{
  std::vector<double> knots(static_cast<std::size_t>(degree + 1), start);
  knots.resize(2 * knots.size(), end);
  return KnotVector(degree, std::move(knots), name);
}

/// Degrees of a quadrilateral in u and v: its `HigherOrderDegrees`, else a square number of points.
std::array<int, 2> quadrilateral_degrees(
  vtkUnstructuredGrid* grid, vtkIdType cell, vtkIdType number_of_points)
{
  vtkDataArray* array = grid->GetCellData()->GetHigherOrderDegrees();
  if (!array)
  {
    array = grid->GetCellData()->GetArray("HigherOrderDegrees");
  }
  std::array<int, 2> degrees;
  if (array)
  {
    if (array->GetNumberOfComponents() < 2)
    {
      refuse(GeometryDefect::Format, cell, "HigherOrderDegrees has fewer than 2 components");
    }
    for (int i = 0; i < 2; ++i)
    {
      const double degree = array->GetComponent(cell, i);
      if (!(degree >= 1.0 && degree <= kMaximumDegree))
      {
        refuse(GeometryDefect::Degree, cell,
          "HigherOrderDegrees[" + std::to_string(cell) + "] has component " + std::to_string(i) +
            " = " + vtkVariant(degree).ToString() + ", allowed are 1 to " +
            std::to_string(kMaximumDegree));
      }
      degrees[i] = static_cast<int>(degree);
    }
  }
  else
  {
    degrees.fill(static_cast<int>(std::lround(std::sqrt(double(number_of_points)))) - 1);
  }
  if ((degrees[0] + 1) * (degrees[1] + 1) != number_of_points)
  {
    refuse(GeometryDefect::Count, cell,
      "degrees (" + std::to_string(degrees[0]) + ", " + std::to_string(degrees[1]) +
        ") do not fit its " + std::to_string(number_of_points) +
        " points (HigherOrderDegrees names the degrees)");
  }
  return degrees;
}

/// (u0, u1, v0, v1): the cell's row of `ParameterRange`, else the unit square.
std::array<double, 4> parameter_range(vtkUnstructuredGrid* grid, vtkIdType cell, int dimension)
{
  std::array<double, 4> range{ { 0.0, 1.0, 0.0, 1.0 } };
  vtkDataArray* array = grid->GetCellData()->GetArray("ParameterRange");
  if (!array)
  {
    return range;
  }
  if (array->GetNumberOfComponents() < 2 * dimension)
  {
    refuse(GeometryDefect::Format, cell,
      "ParameterRange has " + std::to_string(array->GetNumberOfComponents()) +
        " components, needed are " + std::to_string(2 * dimension));
  }
  for (int i = 0; i < 2 * dimension; ++i)
  {
    range[i] = array->GetComponent(cell, i);
  }
  for (int i = 0; i < dimension; ++i)
  {
    if (!(range[2 * i] < range[2 * i + 1]) || !std::isfinite(range[2 * i + 1] - range[2 * i]))
    {
      refuse(GeometryDefect::EmptyDomain, cell,
        "ParameterRange[" + std::to_string(cell) + "] is from " +
          vtkVariant(range[2 * i]).ToString() + " to " + vtkVariant(range[2 * i + 1]).ToString() +
          " in " + (i == 0 ? "u" : "v") + ", which is no interval");
    }
  }
  return range;
}

Patch convert_cell(vtkUnstructuredGrid* grid, vtkIdType cell, const Eigen::VectorXd& all_weights)
{
  const int type = grid->GetCellType(cell);
  if (type != VTK_BEZIER_CURVE && type != VTK_BEZIER_QUADRILATERAL)
  {
    refuse(GeometryDefect::Format, cell,
      "type " + std::to_string(type) + "; only Bézier curves (type " +
        std::to_string(VTK_BEZIER_CURVE) + ") and quadrilaterals (type " +
        std::to_string(VTK_BEZIER_QUADRILATERAL) + ") are geometry");
  }
  vtkNew<vtkIdList> ids;
  grid->GetCellPoints(cell, ids);
  const vtkIdType count = ids->GetNumberOfIds();

  std::array<int, 2> degree{ { static_cast<int>(count) - 1, 0 } };
  if (type == VTK_BEZIER_QUADRILATERAL)
  {
    degree = quadrilateral_degrees(grid, cell, count);
  }
  const std::vector<int> order =
    type == VTK_BEZIER_CURVE ? bezier_node_order(degree[0]) : bezier_node_order(degree);

  Points control_points(3, count);
  Eigen::VectorXd weights(all_weights.size() > 0 ? count : 0);
  for (vtkIdType i = 0; i < count; ++i)
  {
    const vtkIdType id = ids->GetId(order[i]);
    grid->GetPoint(id, control_points.col(i).data());
    if (weights.size() > 0)
    {
      weights[i] = all_weights[id];
    }
  }

  Patch patch;
  try
  {
    if (type == VTK_BEZIER_CURVE)
    {
      const std::array<double, 4> range = parameter_range(grid, cell, 1);
      patch.curve = std::make_shared<Curve>(
        bezier_knots(degree[0], range[0], range[1], "ParameterRange"), control_points, weights);
    }
    else
    {
      const std::array<double, 4> range = parameter_range(grid, cell, 2);
      patch.surface =
        std::make_shared<Surface>(bezier_knots(degree[0], range[0], range[1], "ParameterRange"),
          bezier_knots(degree[1], range[2], range[3], "ParameterRange"), control_points, weights);
    }
  }
  catch (const GeometryError& error)
  {
    const std::string message = error.what();
    if (message.compare(0, 5, "cell ") == 0)
    {
      throw;
    }
    refuse(error.defect(), cell, message + " (counted along the cell's rows)");
  }
  return patch;
}

/// The face of every cell.
std::vector<std::size_t> read_face_ids(vtkUnstructuredGrid* grid)
{
  vtkDataArray* array = grid->GetCellData()->GetArray("FaceId");
  std::vector<std::size_t> ids;
  for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
  {
    const double id = array ? array->GetComponent(cell, 0) : static_cast<double>(cell);
    if (array && (!(id >= 0.0 && id <= kMaximumFaceId) || id != std::floor(id)))
    {
      refuse(GeometryDefect::Format, cell,
        "FaceId[" + std::to_string(cell) + "] = " + vtkVariant(id).ToString() +
          " is no whole number from 0 to 1000000");
    }
    ids.push_back(static_cast<std::size_t>(id));
  }
  return ids;
}

/// Names, orientations and tolerances of the faces; a face with bad ones is refused.
void read_attributes(
  vtkUnstructuredGrid* grid, ConvertedModel& converted, const std::vector<char>& refused)
{
  for (std::size_t id = 0; id < converted.model.size(); ++id)
  {
    Face& face = converted.model[id];
    try
    {
      const FaceAttributes attributes = read_face_attributes(grid->GetFieldData(), id);
      face.name = attributes.name;
      face.reversed = attributes.reversed;
      face.tolerance = attributes.tolerance;
    }
    catch (const GeometryError& error)
    {
      if (!refused[id] && !face.patches.empty())
      {
        converted.problems.push_back({ id, error.what() });
      }
      face.patches.clear();
    }
  }
}

} // namespace

std::vector<int> bezier_node_order(const std::array<int, 2>& degree)
{
  std::vector<int> order;
  for (int j = 0; j <= degree[1]; ++j)
  {
    for (int i = 0; i <= degree[0]; ++i)
    {
      order.push_back(vtkHigherOrderQuadrilateral::PointIndexFromIJK(i, j, degree.data()));
    }
  }
  return order;
}

std::vector<int> bezier_node_order(int degree)
{
  std::vector<int> order{ 0 };
  for (int i = 1; i < degree; ++i)
  {
    order.push_back(i + 1);
  }
  order.push_back(1);
  return order;
}

ConvertedModel convert_bezier_cells(vtkUnstructuredGrid* cells)
{
  if (cells->GetNumberOfCells() == 0)
  {
    throw GeometryError(GeometryDefect::Count, "the grid has no cells");
  }
  const std::vector<std::size_t> face_ids = read_face_ids(cells);
  const Eigen::VectorXd weights = read_weights(cells);

  ConvertedModel result;
  std::vector<char> refused;
  for (vtkIdType cell = 0; cell < cells->GetNumberOfCells(); ++cell)
  {
    const std::size_t id = face_ids[cell];
    if (id >= result.model.size())
    {
      result.model.resize(id + 1);
      refused.resize(id + 1, 0);
    }
    if (refused[id])
    {
      continue;
    }
    std::vector<Patch>& patches = result.model[id].patches;
    try
    {
      Patch patch = convert_cell(cells, cell, weights);
      if (!patches.empty() && (patches[0].curve != nullptr) != (patch.curve != nullptr))
      {
        refuse(GeometryDefect::Format, cell, "FaceId joins a curve and a surface into one face");
      }
      patches.push_back(std::move(patch));
    }
    catch (const GeometryError& error)
    {
      refused[id] = 1;
      patches.clear();
      result.problems.push_back({ id, error.what() });
    }
  }
  read_attributes(cells, result, refused);
  return result;
}

} // namespace footpoint::conversion
