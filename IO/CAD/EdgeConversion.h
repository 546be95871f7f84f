// SPDX-License-Identifier: BSD-3-Clause
// Private: edges of Open CASCADE as NURBS curves in space.

#ifndef EdgeConversion_h
#define EdgeConversion_h

#include "CADModel.h"

#include <TopoDS_Edge.hxx>

namespace footpoint::cad
{

/// An edge's curve and tolerance, without number and faces.
/// \param scale factor from Open CASCADE's lengths to the unit that is asked for
/// \throw ConversionError, Standard_Failure: the reason
EdgeData convert_edge(const TopoDS_Edge& edge, double scale);

} // namespace footpoint::cad

#endif
