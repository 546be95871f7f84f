// SPDX-License-Identifier: BSD-3-Clause
// Private: the arrays that spline geometry is read from.

#ifndef GeometryArrays_h
#define GeometryArrays_h

#include <string>
#include <vector>

class vtkAbstractArray;
class vtkDataSetAttributes;

namespace footpoint::conversion
{

/// Of a leaf, in its field data.
const std::vector<std::string>& geometry_field_arrays();
const std::vector<std::string>& geometry_point_arrays();
/// Of Bézier cells.
const std::vector<std::string>& geometry_cell_arrays();

/// Where the name is that of an attribute: the active one before an array of that name.
/// \return null where there is none
vtkAbstractArray* find_geometry_array(vtkDataSetAttributes* attributes, const std::string& name);

/// Adds an array under that name and as the attribute that it is.
/// \param array null: none is added
void add_geometry_array(
  vtkDataSetAttributes* attributes, vtkAbstractArray* array, const std::string& name);

} // namespace footpoint::conversion

#endif
