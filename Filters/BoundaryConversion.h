// SPDX-License-Identifier: BSD-3-Clause
// Private: lines of polygonal data as boundaries of grids.

#ifndef BoundaryConversion_h
#define BoundaryConversion_h

#include "footpoint/grids/boundary.h"

#include <vector>

class vtkPolyData;

namespace footpoint::conversion
{

/// A line of polygonal data.
struct Line
{
  Points points;
  int role = -1;  ///< its `BoundaryRole`; −1 for "find out"
  int input = -1; ///< the number of the connection it came with
};

/// All lines of all inputs in order; those without points are left out.
/// \throw BoundaryError where `BoundaryRole` is no role
std::vector<Line> read_lines(const std::vector<vtkPolyData*>& inputs);

/// The boundary that vtkCoonsPatchSource makes of its inputs, see there.
/// \param corner_ids numbers of points of the first input, all −1: found by angle
/// \throw BoundaryError
Boundary read_boundary(const std::vector<vtkPolyData*>& inputs,
  const std::array<int, 4>& corner_ids, const BoundaryOptions& options);

} // namespace footpoint::conversion

#endif
