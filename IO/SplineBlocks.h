// SPDX-License-Identifier: BSD-3-Clause
// Private: splines of files as VTK data.

#ifndef SplineBlocks_h
#define SplineBlocks_h

#include "SplineFile.h"

#include "footpoint/splines/curve.h"

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkMultiBlockDataSet;
class vtkStructuredGrid;

namespace footpoint::files
{

/// A curve for the core. \throw GeometryError naming the array, the index and the value
Curve make_curve(const Spline& spline);

/// Refuses what the core refuses. \throw GeometryError naming the array, the index and the value
void check(const Spline& spline);

/// Puts control points and weights, rows of `fastest` numbers, into columns: from v fastest to u
/// fastest, or back.
void reorder(Spline& surface, std::size_t fastest, std::size_t slowest);

/// \throw FileError where the spline has loops or is reversed, for formats that have neither
void refuse_face_data(const Spline& spline, std::size_t index, const std::string& format);

/// The name of a spline. \throw FileError where it is no UTF-8 or has control characters, so that a
/// text file cannot hold it
std::string checked_name(const Spline& spline, std::size_t index);

/// The control net of a surface or curve without its loops: see vtkPointInversionFilter. Every
/// number is that of the spline, to the bit.
vtkSmartPointer<vtkStructuredGrid> make_net(const Spline& spline);

/// Appends a block: a net, or for a trimmed surface the blocks `Surface`, `Loop 0`, …
void append_block(vtkMultiBlockDataSet* blocks, const Spline& spline);

} // namespace footpoint::files

#endif
