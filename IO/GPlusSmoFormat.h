// SPDX-License-Identifier: BSD-3-Clause
// Private: the XML format of G+Smo (gismo, RICAM and others).
//
// Below the root `xml` every `Geometry` has a `Basis` and `coefs`, the control points, first
// direction fastest, Cartesian. Read are the types BSpline, Nurbs, TensorBSpline2 and TensorNurbs2.

#ifndef GPlusSmoFormat_h
#define GPlusSmoFormat_h

#include "SplineFile.h"

#include <string_view>

namespace footpoint::files
{

/// Elements that are no such geometry are left out with a warning; of a `MultiPatch` the patches
/// are read, as they are geometries of the file. \throw FileError
SplineFile read_g_plus_smo(std::string_view text);

/// Names become attributes `label`. \throw FileError for loops and a reversed surface
std::string write_g_plus_smo(const std::vector<Spline>& splines);

} // namespace footpoint::files

#endif
