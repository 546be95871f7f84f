// SPDX-License-Identifier: BSD-3-Clause
// Private: a control net from the parts that it was cut into.

#ifndef NetAssembly_h
#define NetAssembly_h

#include "vtkSmartPointer.h"

#include <vector>

class vtkStructuredGrid;

namespace footpoint::conversion
{

/// Whether the nets were cut from one: they have the same field data (knots and degrees above all),
/// and at least one is not the whole net that the knots and degrees ask for; where no degrees are
/// given, their extents differ.
bool are_parts_of_one_net(const std::vector<vtkStructuredGrid*>& parts);

/// The whole net. Parts may overlap where they agree.
/// \pre are_parts_of_one_net
/// \throw GeometryError where a control point is in no part, or has two values
vtkSmartPointer<vtkStructuredGrid> assemble_net(const std::vector<vtkStructuredGrid*>& parts);

} // namespace footpoint::conversion

#endif
