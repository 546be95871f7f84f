// SPDX-License-Identifier: BSD-3-Clause
// Private: splines of files as VTK data.

#ifndef SplineBlocks_h
#define SplineBlocks_h

#include "SplineFile.h"

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkMultiBlockDataSet;
class vtkStructuredGrid;

namespace footpoint::files
{

/// Refuses what the core refuses. \throw GeometryError naming the array, the index and the value
void check(const Spline& spline);

/// The control net of a surface or curve without its loops: see vtkPointInversionFilter. Every
/// number is that of the spline, to the bit.
vtkSmartPointer<vtkStructuredGrid> make_net(const Spline& spline);

/// Appends a block: a net, or for a trimmed surface the blocks `Surface`, `Loop 0`, …
void append_block(vtkMultiBlockDataSet* blocks, const Spline& spline);

} // namespace footpoint::files

#endif
