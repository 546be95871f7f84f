// SPDX-License-Identifier: BSD-3-Clause
// Private: the text format .g2 of GoTools (SINTEF), and of programs that use it.
//
// A file is a row of objects. Each begins with a line of integers: the class, two of the version,
// and the number of further ones in the line. A spline curve (class 100) or surface (200) goes on
// with the dimension of space, whether it is rational, for each direction the number of control
// points, the order (degree + 1) and the knots, and then the control points, u fastest; rational
// ones as (w·x, w·y, w·z, w).

#ifndef GoToolsFormat_h
#define GoToolsFormat_h

#include "SplineFile.h"

#include <string>
#include <string_view>
#include <vector>

namespace footpoint::files
{

/// Objects of other classes are left out with a warning. \throw FileError
SplineFile read_go_tools(std::string_view text);

/// Homogeneous coordinates are written with so many digits that those of the control points come
/// back to the bit. \param warnings gains a sentence where names are left out \throw FileError for
/// loops and a reversed surface
std::string write_go_tools(const std::vector<Spline>& splines, std::vector<std::string>& warnings);

} // namespace footpoint::files

#endif
