// SPDX-License-Identifier: BSD-3-Clause
// Private: the JSON format of geomdl (NURBS-Python, O. R. Bingol and A. Krishnamurthy 2019).
//
// The member `shape` has a type, curve or surface, and in `data` the splines: degrees, knots,
// control points (Cartesian; of surfaces v fastest), weights beside them, and of surfaces `trims`.
// A trim with `reversed` keeps its inside, one without is a hole, whatever its direction.

#ifndef GeomdlFormat_h
#define GeomdlFormat_h

#include "SplineFile.h"

#include <string_view>

namespace footpoint::files
{

/// Loops come out directed: counter-clockwise where they keep their inside. Where all trims are
/// holes, the border of the domain becomes loop 0. Volumes are left out with a warning, as are
/// members that are not known. \throw FileError
SplineFile read_geomdl(std::string_view text);

/// \throw FileError for curves and surfaces in one file, and for
/// loops of which none keeps its inside
std::string write_geomdl(const std::vector<Spline>& splines);

} // namespace footpoint::files

#endif
