// SPDX-License-Identifier: BSD-3-Clause
// Private: VTK data as splines for files, number for number.

#ifndef SplineCollection_h
#define SplineCollection_h

#include "SplineFile.h"

class vtkDataObject;

namespace footpoint::files
{

/// All splines of a net, a trimmed face or a composite data set of these, in order, checked as the
/// filters check them. Warnings are of what no file holds: empty blocks, arrays that are no spline.
/// \throw FileError naming the face and what is wrong with it
SplineFile collect_splines(vtkDataObject* data);

} // namespace footpoint::files

#endif
