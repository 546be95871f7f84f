// SPDX-License-Identifier: BSD-3-Clause
#include "GeometryArrays.h"

#include "vtkAbstractArray.h"
#include "vtkDataSetAttributes.h"

namespace footpoint::conversion
{

namespace
{

/// −1: no attribute.
int attribute_of(const std::string& name)
{
  return name == "RationalWeights" ? vtkDataSetAttributes::RATIONALWEIGHTS
    : name == "HigherOrderDegrees" ? vtkDataSetAttributes::HIGHERORDERDEGREES
                                   : -1;
}

} // namespace

const std::vector<std::string>& geometry_field_arrays()
{
  static const std::vector<std::string> names{ "KnotsU", "KnotsV", "Degree", "FaceName",
    "Orientation", "Tolerance" };
  return names;
}

const std::vector<std::string>& geometry_point_arrays()
{
  static const std::vector<std::string> names{ "RationalWeights" };
  return names;
}

const std::vector<std::string>& geometry_cell_arrays()
{
  static const std::vector<std::string> names{ "HigherOrderDegrees", "ParameterRange", "FaceId" };
  return names;
}

vtkAbstractArray* find_geometry_array(vtkDataSetAttributes* attributes, const std::string& name)
{
  const int attribute = attribute_of(name);
  vtkAbstractArray* const active =
    attribute >= 0 ? attributes->GetAbstractAttribute(attribute) : nullptr;
  return active ? active : attributes->GetAbstractArray(name.c_str());
}

void add_geometry_array(
  vtkDataSetAttributes* attributes, vtkAbstractArray* array, const std::string& name)
{
  if (!array)
  {
    return;
  }
  array->SetName(name.c_str());
  attributes->AddArray(array);
  if (attribute_of(name) >= 0)
  {
    attributes->SetActiveAttribute(name.c_str(), attribute_of(name));
  }
}

} // namespace footpoint::conversion
