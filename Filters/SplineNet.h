// SPDX-License-Identifier: BSD-3-Clause
// Private: geometry of the core as VTK data, the inverse of SplineConversion.

#ifndef SplineNet_h
#define SplineNet_h

#include "StructuredOutput.h"

#include "footpoint/splines/curve.h"
#include "footpoint/splines/surface.h"

#include <string>
#include <vector>

class vtkAlgorithm;
class vtkDataObject;
class vtkInformationVector;
class vtkStructuredGrid;

namespace footpoint::conversion
{

/// Numbers of control points of a surface; zeros of none.
Dimensions net_dimensions(const Surface* surface);

/// Makes a grid the control net of a surface, a curve: points, field data `KnotsU`, `KnotsV`,
/// `Degree`, and active RationalWeights where it is rational. \param net empty before
void fill_net(const Surface& surface, vtkStructuredGrid* net);
void fill_net(const Curve& curve, vtkStructuredGrid* net);

/// Makes output 0 the control net of a surface. An error of the algorithm where there is no
/// surface or its net is not as large as was announced. \param surface may be null \param error why
/// it is \return the net, null after an error
vtkStructuredGrid* write_net(vtkAlgorithm* algorithm, const Surface* surface,
  const std::string& error, vtkInformationVector* outputs);

/// All curves of data objects, composite ones included, in order; empty blocks are left out.
/// \param name what they are called in messages, e.g. "profile"
/// \throw GeometryError where one is bad or is no curve
std::vector<Curve> read_curves(const std::vector<vtkDataObject*>& data, const char* name);

/// The same curve run through from its end.
Curve reversed(const Curve& curve);

} // namespace footpoint::conversion

#endif
