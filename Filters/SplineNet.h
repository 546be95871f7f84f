// SPDX-License-Identifier: BSD-3-Clause
// Private: geometry of the core as VTK data, the inverse of SplineConversion.

#ifndef SplineNet_h
#define SplineNet_h

#include "footpoint/splines/curve.h"
#include "footpoint/splines/surface.h"

#include <vector>

class vtkDataObject;
class vtkStructuredGrid;

namespace footpoint::conversion
{

/// Makes `net` the control net of a surface: points, field data `KnotsU`, `KnotsV`, `Degree`, and
/// active RationalWeights where it is rational.
void write_net(const Surface& surface, vtkStructuredGrid* net);

/// All curves of data objects, composite ones included, in order; empty blocks are left out.
/// \param name what they are called in messages, e.g. "profile"
/// \throw GeometryError where one is bad or is no curve
std::vector<Curve> read_curves(const std::vector<vtkDataObject*>& data, const char* name);

/// The same curve run through from its end.
Curve reversed(const Curve& curve);

} // namespace footpoint::conversion

#endif
