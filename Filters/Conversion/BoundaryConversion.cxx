// SPDX-License-Identifier: BSD-3-Clause
#include "BoundaryConversion.h"

#include "FieldArrays.h"

#include "footpoint/grids/boundary_error.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkVariant.h"

#include <cmath>

namespace footpoint::conversion
{

namespace
{

int read_role(vtkDataArray* roles, vtkIdType cell)
{
  const double role = roles ? roles->GetComponent(cell, 0) : -1.0;
  if (!(std::abs(role) < 1e6) || role != std::floor(role))
  {
    throw BoundaryError(BoundaryDefect::Count,
      "BoundaryRole[" + std::to_string(cell) + "] = " + vtkVariant(role).ToString() +
        " is no role; 0 bottom, 1 right, 2 top, 3 left, -1 any");
  }
  return static_cast<int>(role);
}

} // namespace

Lines read_lines(const std::vector<vtkPolyData*>& inputs)
{
  Lines result;
  vtkIdType count = 0;
  for (vtkPolyData* input : inputs)
  {
    count += input->GetNumberOfPoints();
  }
  result.points.resize(3, count);
  vtkIdType first = 0;
  vtkNew<vtkIdList> ids;
  for (vtkPolyData* input : inputs)
  {
    for (vtkIdType i = 0; i < input->GetNumberOfPoints(); ++i)
    {
      input->GetPoint(i, result.points.col(first + i).data());
    }
    vtkDataArray* roles = input->GetCellData()->GetArray("BoundaryRole");
    vtkIdType cell = input->GetNumberOfVerts(); // cell data of vertices comes before that of lines
    for (vtkIdType i = 0; i < input->GetNumberOfLines(); ++i, ++cell)
    {
      input->GetLines()->GetCellAtId(i, ids);
      if (ids->GetNumberOfIds() == 0)
      {
        continue;
      }
      std::vector<int> line;
      for (vtkIdType k = 0; k < ids->GetNumberOfIds(); ++k)
      {
        line.push_back(static_cast<int>(first + ids->GetId(k)));
      }
      result.ids.push_back(std::move(line));
      result.roles.push_back(read_role(roles, cell));
    }
    first += input->GetNumberOfPoints();
  }
  return result;
}

void report_sides(const Boundary& boundary, vtkFieldData* data)
{
  std::array<int, 4> order;
  std::array<int, 4> reversed;
  for (std::size_t role = 0; role < 4; ++role)
  {
    order[role] = boundary.reports[role].input;
    reversed[role] = boundary.reports[role].reversed ? 1 : 0;
  }
  set_numbers(data, "CornerGaps", boundary.corner_gaps);
  set_integers(data, "EdgeOrder", order);
  set_integers(data, "EdgeReversed", reversed);
}

} // namespace footpoint::conversion
