// SPDX-License-Identifier: BSD-3-Clause
#include "FootArrays.h"

#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>

namespace footpoint::conversion
{

namespace
{

/// Makes an array from a function of the foot, `write(foot, values)`, and adds it in place of one
/// of its name. Without a foot all values are `none`.
template <typename ArrayType, typename Write>
vtkDataArray* add_array(const char* name, int components, const Foot* feet, vtkIdType count,
  int repeat, const FootArrayLayout& layout, vtkDataSetAttributes* attributes,
  typename ArrayType::ValueType none, const Write& write)
{
  const std::string full_name = layout.prefix + name;
  vtkNew<ArrayType> array;
  array->SetName(full_name.c_str());
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(count * repeat);
  auto* values = array->GetPointer(0);
  for (vtkIdType i = 0; i < count; ++i)
  {
    auto* first = values;
    std::fill_n(first, components, none);
    if (has_foot(feet[i]))
    {
      write(feet[i], first);
    }
    values += components;
    for (int k = 1; k < repeat; ++k)
    {
      values = std::copy_n(first, components, values);
    }
  }
  // An array that is only overwritten would stay what it was active as, with other components.
  attributes->RemoveArray(full_name.c_str());
  attributes->AddArray(array);
  return array;
}

void write_vector(const Vector3& vector, double* values)
{
  std::copy_n(vector.data(), 3, values);
}

} // namespace

void describe_model(const Model& model, FootArrayLayout& layout)
{
  for (const Face& face : model)
  {
    for (const Patch& patch : face.patches)
    {
      layout.has_curves |= patch.curve != nullptr;
      layout.has_surfaces |= patch.surface != nullptr;
    }
  }
}

bool has_foot(const Foot& foot)
{
  return foot.status != Status::BeyondMaximumDistance && foot.status != Status::InvalidPoint;
}

void attach_feet(const Foot* feet, vtkIdType count, int repeat, const FootArrayLayout& layout,
  vtkDataSetAttributes* attributes)
{
  const auto add_doubles = [&](const char* name, int components, const auto& write)
  {
    return add_array<vtkDoubleArray>(
      name, components, feet, count, repeat, layout, attributes, std::nan(""), write);
  };
  const auto add_ints = [&](const char* name, const auto& write)
  { add_array<vtkIntArray>(name, 1, feet, count, repeat, layout, attributes, -1, write); };

  vtkDataArray* scalars = nullptr;
  if (layout.parameters)
  {
    const int components = layout.has_curves && !layout.has_surfaces ? 1 : 2;
    add_doubles("Parameters", components,
      [components](const Foot& foot, double* values)
      { std::copy_n(foot.parameter.data(), components, values); });
  }
  if (layout.distance)
  {
    vtkDataArray* distance =
      add_doubles("Distance", 1, [](const Foot& foot, double* value) { *value = foot.distance; });
    scalars = layout.has_surfaces ? nullptr : distance;
  }
  if (layout.signed_distance && layout.has_surfaces)
  {
    scalars = add_doubles(
      "SignedDistance", 1, [](const Foot& foot, double* value) { *value = foot.signed_distance; });
  }
  if (layout.closest_point)
  {
    add_doubles("ClosestPoint", 3,
      [](const Foot& foot, double* values) { write_vector(foot.point, values); });
  }
  if (layout.normal && layout.has_surfaces)
  {
    add_doubles("Normal", 3,
      [](const Foot& foot, double* values)
      {
        if (!foot.on_curve)
        {
          write_vector(foot.direction, values);
        }
      });
  }
  if (layout.tangent && layout.has_curves)
  {
    add_doubles("Tangent", 3,
      [](const Foot& foot, double* values)
      {
        if (foot.on_curve)
        {
          write_vector(foot.direction, values);
        }
      });
  }
  if (layout.face_id)
  {
    add_array<vtkIdTypeArray>("FaceId", 1, feet, count, repeat, layout, attributes, -1,
      [](const Foot& foot, vtkIdType* value) { *value = foot.face; });
  }
  if (layout.foot_type)
  {
    add_ints(
      "FootType", [](const Foot& foot, int* value) { *value = static_cast<int>(foot.type); });
  }
  if (layout.isolated)
  {
    add_ints("Isolated", [](const Foot& foot, int* value) { *value = foot.isolated ? 1 : 0; });
  }
  if (layout.iterations)
  {
    add_ints("Iterations", [](const Foot& foot, int* value) { *value = foot.iterations; });
  }
  if (layout.status)
  {
    // The one array that has its value everywhere.
    const std::string name = layout.prefix + "Status";
    vtkNew<vtkIntArray> array;
    array->SetName(name.c_str());
    array->SetNumberOfValues(count * repeat);
    for (vtkIdType i = 0; i < count * repeat; ++i)
    {
      array->SetValue(i, static_cast<int>(feet[i / repeat].status));
    }
    attributes->RemoveArray(name.c_str());
    attributes->AddArray(array);
  }
  if (scalars)
  {
    attributes->SetActiveScalars(scalars->GetName());
  }
}

void fill_foot_points(const std::vector<TaggedFoot>& feet, bool segments, bool with_blocks,
  const FootArrayLayout& layout, vtkPolyData* output)
{
  const int repeat = segments ? 2 : 1;
  const auto count = static_cast<vtkIdType>(feet.size());

  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(count * repeat);
  vtkNew<vtkCellArray> cells;
  cells->AllocateExact(count, count * repeat);
  vtkNew<vtkIdTypeArray> point_ids;
  point_ids->SetName((layout.prefix + "PointId").c_str());
  point_ids->SetNumberOfValues(count * repeat);
  vtkNew<vtkIntArray> block_ids;
  block_ids->SetName((layout.prefix + "BlockId").c_str());
  block_ids->SetNumberOfValues(count * repeat);

  std::vector<Foot> plain;
  plain.reserve(feet.size());
  for (vtkIdType i = 0; i < count; ++i)
  {
    const TaggedFoot& tagged = feet[static_cast<std::size_t>(i)];
    plain.push_back(tagged.foot);
    cells->InsertNextCell(repeat);
    for (int k = 0; k < repeat; ++k)
    {
      const vtkIdType at = i * repeat + k;
      const Vector3& position = segments && k == 0 ? tagged.query : tagged.foot.point;
      points->SetPoint(at, position.data());
      cells->InsertCellPoint(at);
      point_ids->SetValue(at, tagged.point);
      block_ids->SetValue(at, tagged.block);
    }
  }
  output->SetPoints(points);
  if (segments)
  {
    output->SetLines(cells);
  }
  else
  {
    output->SetVerts(cells);
  }

  vtkPointData* attributes = output->GetPointData();
  attach_feet(plain.data(), count, repeat, layout, attributes);
  attributes->AddArray(point_ids);
  if (with_blocks)
  {
    attributes->AddArray(block_ids);
  }
  if (layout.normal && layout.has_surfaces)
  {
    attributes->SetActiveNormals((layout.prefix + "Normal").c_str());
  }
}

} // namespace footpoint::conversion
