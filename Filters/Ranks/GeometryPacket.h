// SPDX-License-Identifier: BSD-3-Clause
// Private: spline geometry as bytes, for ranks that do not have it.

#ifndef GeometryPacket_h
#define GeometryPacket_h

#include "vtkSmartPointer.h"

#include <vector>

class vtkDataObject;

namespace footpoint::conversion
{

/// Everything of the geometry that convert_to_model reads, so that it has the same ContentHash when
/// it is unpacked. (VTK's own marshalling loses which attributes are active.)
/// \param geometry may be null
std::vector<unsigned char> pack_geometry(vtkDataObject* geometry);

/// \return null where null was packed
vtkSmartPointer<vtkDataObject> unpack_geometry(const std::vector<unsigned char>& bytes);

} // namespace footpoint::conversion

#endif
