// SPDX-License-Identifier: BSD-3-Clause
// What of SplineConversion.h reads names and field data.
#include "SplineConversion.h"

#include "footpoint/common/errors.h"

#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPartitionedDataSet.h"
#include "vtkStringArray.h"
#include "vtkVariant.h"

#include <cmath>

namespace footpoint::conversion
{

namespace
{

[[noreturn]] void refuse(GeometryDefect defect, const std::string& message)
{
  throw GeometryError(defect, message);
}

} // namespace

std::vector<double> read_field_array(vtkFieldData* data, const char* name)
{
  vtkDataArray* array = data ? data->GetArray(name) : nullptr;
  std::vector<double> values;
  if (array)
  {
    const int components = array->GetNumberOfComponents();
    values.reserve(static_cast<std::size_t>(array->GetNumberOfValues()));
    for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i)
    {
      values.push_back(array->GetComponent(i / components, static_cast<int>(i % components)));
    }
  }
  return values;
}

std::string block_name(vtkInformation* meta_data)
{
  const char* name = meta_data && meta_data->Has(vtkCompositeDataSet::NAME())
    ? meta_data->Get(vtkCompositeDataSet::NAME())
    : nullptr;
  return name ? name : "";
}

std::string block_name(vtkMultiBlockDataSet* blocks, unsigned int number)
{
  return block_name(blocks->HasMetaData(number) ? blocks->GetMetaData(number) : nullptr);
}

vtkDataObject* single_piece(vtkDataObject* data)
{
  auto* pieces = vtkPartitionedDataSet::SafeDownCast(data);
  if (!pieces)
  {
    return data;
  }
  vtkDataObject* only = nullptr;
  int count = 0;
  for (unsigned int i = 0; i < pieces->GetNumberOfPartitions(); ++i)
  {
    if (vtkDataObject* piece = pieces->GetPartitionAsDataObject(i))
    {
      only = piece;
      ++count;
    }
  }
  if (count > 1)
  {
    refuse(GeometryDefect::Format,
      "it is cut into " + std::to_string(count) + " pieces; a net must come in one piece");
  }
  return only;
}

FaceAttributes read_face_attributes(vtkFieldData* data)
{
  FaceAttributes attributes;
  if (!data)
  {
    return attributes;
  }
  auto* name = vtkStringArray::SafeDownCast(data->GetAbstractArray("FaceName"));
  if (name && name->GetNumberOfValues() > 0)
  {
    attributes.name = name->GetValue(0);
  }
  const std::vector<double> orientation = read_field_array(data, "Orientation");
  if (!orientation.empty())
  {
    if (orientation[0] != 1.0 && orientation[0] != -1.0)
    {
      refuse(GeometryDefect::Format,
        "Orientation[0] = " + vtkVariant(orientation[0]).ToString() +
          "; 1 (along Su × Sv) or -1 (reversed) is allowed");
    }
    attributes.reversed = orientation[0] < 0.0;
  }
  const std::vector<double> tolerance = read_field_array(data, "Tolerance");
  if (!tolerance.empty())
  {
    if (!(tolerance[0] >= 0.0 && std::isfinite(tolerance[0])))
    {
      refuse(GeometryDefect::Format,
        "Tolerance[0] = " + vtkVariant(tolerance[0]).ToString() +
          "; a length in model units is needed, 0 or larger");
    }
    attributes.tolerance = tolerance[0];
  }
  return attributes;
}

} // namespace footpoint::conversion
