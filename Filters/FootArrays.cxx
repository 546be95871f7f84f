// SPDX-License-Identifier: BSD-3-Clause
#include "FootArrays.h"

#include "AlgorithmExecution.h"

#include "vtkDataSetAttributes.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace footpoint::conversion
{

namespace
{

/// Feet that are turned into all arrays one after the other, so that they stay in the cache.
constexpr vtkIdType kSlice = 64;
/// Feet that a thread takes at least.
constexpr vtkIdType kGrain = 4096;

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

template <typename ArrayType, typename Write>
void FootArrays::add(const char* name, int components, const Write& write)
{
  vtkNew<ArrayType> array;
  array->SetName((this->Layout.prefix + name).c_str());
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(this->Count);
  auto* const values = array->GetPointer(0);
  this->Columns.push_back({ array,
    [=](vtkIdType row, const Foot* feet, vtkIdType count)
    {
      for (vtkIdType i = 0; i < count; ++i)
      {
        write(feet[i], values + (row + i) * components);
      }
    } });
}

FootArrays::FootArrays(const FootArrayLayout& layout, vtkIdType count)
  : Layout(layout)
  , Count(count)
{
  // The number of components is a type, so that a few numbers are copied without a call.
  const auto add_doubles = [this](const char* name, auto components, const auto& values_of)
  {
    constexpr int kCount = decltype(components)::value;
    this->add<vtkDoubleArray>(name, kCount,
      [=](const Foot& foot, double* values)
      {
        const double* const from = has_foot(foot) ? values_of(foot) : nullptr;
        from ? std::copy_n(from, kCount, values) : std::fill_n(values, kCount, NAN);
      });
  };
  constexpr std::integral_constant<int, 1> kOne;
  constexpr std::integral_constant<int, 2> kTwo;
  constexpr std::integral_constant<int, 3> kThree;
  const auto add_ints = [this](const char* name, const auto& value_of)
  {
    this->add<vtkIntArray>(name, 1,
      [=](const Foot& foot, int* value) { *value = has_foot(foot) ? value_of(foot) : -1; });
  };

  if (layout.parameters)
  {
    const auto parameter_of = [](const Foot& foot) { return foot.parameter.data(); };
    layout.has_curves && !layout.has_surfaces ? add_doubles("Parameters", kOne, parameter_of)
                                              : add_doubles("Parameters", kTwo, parameter_of);
  }
  if (layout.distance)
  {
    add_doubles("Distance", kOne, [](const Foot& foot) { return &foot.distance; });
  }
  if (layout.signed_distance && layout.has_surfaces)
  {
    add_doubles("SignedDistance", kOne, [](const Foot& foot) { return &foot.signed_distance; });
  }
  // Also where it is not asked for: output 1 has its points there.
  add_doubles("ClosestPoint", kThree, [](const Foot& foot) { return foot.point.data(); });
  this->Points = vtkDoubleArray::SafeDownCast(this->Columns.back().array);
  if (layout.normal && layout.has_surfaces)
  {
    add_doubles("Normal", kThree,
      [](const Foot& foot) { return foot.on_curve ? nullptr : foot.direction.data(); });
  }
  if (layout.tangent && layout.has_curves)
  {
    add_doubles("Tangent", kThree,
      [](const Foot& foot) { return foot.on_curve ? foot.direction.data() : nullptr; });
  }
  if (layout.face_id)
  {
    this->add<vtkIdTypeArray>("FaceId", 1,
      [](const Foot& foot, vtkIdType* value) { *value = has_foot(foot) ? foot.face : -1; });
  }
  if (layout.foot_type)
  {
    add_ints("FootType", [](const Foot& foot) { return static_cast<int>(foot.type); });
  }
  if (layout.isolated)
  {
    add_ints("Isolated", [](const Foot& foot) { return foot.isolated ? 1 : 0; });
  }
  if (layout.iterations)
  {
    add_ints("Iterations", [](const Foot& foot) { return foot.iterations; });
  }
  if (layout.status)
  {
    // The one array that has its value everywhere.
    this->add<vtkIntArray>(
      "Status", 1, [](const Foot& foot, int* value) { *value = static_cast<int>(foot.status); });
  }
}

void FootArrays::write(vtkIdType first, const Foot* feet, vtkIdType count)
{
  run_parallel(count, kGrain,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType at = begin; at < end; at += kSlice)
      {
        for (const Column& column : this->Columns)
        {
          column.write(first + at, feet + at, std::min(kSlice, end - at));
        }
      }
    });
}

void FootArrays::copy(vtkIdList* rows, const FootArrays& others, vtkIdList* their_rows)
{
  for (std::size_t k = 0; k < this->Columns.size(); ++k)
  {
    this->Columns[k].array->InsertTuples(rows, their_rows, others.Columns[k].array);
  }
}

void FootArrays::attach_to(vtkDataSetAttributes* attributes) const
{
  for (const Column& column : this->Columns)
  {
    if (column.array != this->Points || this->Layout.closest_point)
    {
      // An array that is only overwritten would stay what it was active as, with other components.
      attributes->RemoveArray(column.array->GetName());
      attributes->AddArray(column.array);
    }
  }
  if (this->Layout.has_surfaces ? this->Layout.signed_distance : this->Layout.distance)
  {
    const char* const scalars = this->Layout.has_surfaces ? "SignedDistance" : "Distance";
    attributes->SetActiveScalars((this->Layout.prefix + scalars).c_str());
  }
}

} // namespace footpoint::conversion
