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

/// Where in an array the value of a face is: one value is for all faces.
std::size_t place_of_face(const char* name, std::size_t count, std::size_t face)
{
  if (count > 1 && face >= count)
  {
    refuse(GeometryDefect::Count,
      std::string(name) + " has " + std::to_string(count) +
        " values, none for this face; one for all faces or one for each is needed");
  }
  return count > 1 ? face : 0;
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

FaceAttributes read_face_attributes(vtkFieldData* data, std::size_t face)
{
  FaceAttributes attributes;
  if (!data)
  {
    return attributes;
  }
  auto* names = vtkStringArray::SafeDownCast(data->GetAbstractArray("FaceName"));
  if (names && names->GetNumberOfValues() > 0)
  {
    const std::size_t at = place_of_face("FaceName", names->GetNumberOfValues(), face);
    attributes.name = names->GetValue(static_cast<vtkIdType>(at));
  }
  const std::vector<double> orientations = read_field_array(data, "Orientation");
  if (!orientations.empty())
  {
    const std::size_t at = place_of_face("Orientation", orientations.size(), face);
    if (orientations[at] != 1.0 && orientations[at] != -1.0)
    {
      refuse(GeometryDefect::Format,
        "Orientation[" + std::to_string(at) + "] = " + vtkVariant(orientations[at]).ToString() +
          "; 1 (along Su × Sv) or -1 (reversed) is allowed");
    }
    attributes.reversed = orientations[at] < 0.0;
  }
  const std::vector<double> tolerances = read_field_array(data, "Tolerance");
  if (!tolerances.empty())
  {
    const std::size_t at = place_of_face("Tolerance", tolerances.size(), face);
    if (!(tolerances[at] >= 0.0 && std::isfinite(tolerances[at])))
    {
      refuse(GeometryDefect::Format,
        "Tolerance[" + std::to_string(at) + "] = " + vtkVariant(tolerances[at]).ToString() +
          "; a length in model units is needed, 0 or larger");
    }
    attributes.tolerance = tolerances[at];
  }
  return attributes;
}

} // namespace footpoint::conversion
