// SPDX-License-Identifier: BSD-3-Clause
// Private: lines of polygonal data as boundaries of grids.

#ifndef BoundaryConversion_h
#define BoundaryConversion_h

#include "footpoint/common/types.h"
#include "footpoint/grids/boundary.h"

#include <vector>

class vtkFieldData;
class vtkPolyData;

namespace footpoint::conversion
{

/// The lines of several polygonal data sets together.
struct Lines
{
  Points points;                     ///< of all inputs, one after another
  std::vector<std::vector<int>> ids; ///< by line: indices of points; empty lines are left out
  std::vector<int> roles;            ///< by line: its `BoundaryRole`; −1 where there is none

  /// The points of one line.
  Points line(std::size_t number) const { return this->points(Eigen::all, this->ids[number]); }
};

/// \throw BoundaryError where `BoundaryRole` is no integer
Lines read_lines(const std::vector<vtkPolyData*>& inputs);

/// What was done to the sides: `CornerGaps`, `EdgeOrder` and `EdgeReversed`.
void report_sides(const Boundary& boundary, vtkFieldData* data);

} // namespace footpoint::conversion

#endif
