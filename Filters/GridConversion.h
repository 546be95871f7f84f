// SPDX-License-Identifier: BSD-3-Clause
// Private: structured grids of the core and of VTK.

#ifndef GridConversion_h
#define GridConversion_h

#include "footpoint/grids/grid_quality.h"
#include "footpoint/grids/smoothing.h"
#include "footpoint/grids/structured_points.h"

#include "vtkSmartPointer.h"

class vtkCellData;
class vtkDoubleArray;
class vtkFieldData;
class vtkPointData;
class vtkPoints;
class vtkStructuredGrid;

namespace footpoint::conversion
{

/// A copy, in double precision.
vtkSmartPointer<vtkPoints> make_points(const Points& points);

/// The points of a grid with one dimension of 1, whichever it is; the two others in order.
/// \param name of the grid in messages
/// \throw BoundaryError (Resolution, NotFinite)
Grid read_grid(vtkStructuredGrid* input, const std::string& name);

/// A named array with the columns of a matrix as tuples.
vtkSmartPointer<vtkDoubleArray> make_array(const char* name,
  const Eigen::Ref<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic>>& columns);

/// The cell arrays `Jacobian` and `Folded`.
template <int N>
void attach_quality(const GridQuality<N>& quality, vtkCellData* data);

/// The point array `Normals`, which becomes the active normals.
void attach_normals(const Grid& grid, vtkPointData* data);

/// The number of `SmoothingStatus`: 0 not smoothed, 1 converged, 2 not converged, 3 rejected.
int smoothing_status(const SmoothingResult& result, Smoothing method);

/// `FoldedCellsBefore`, `FoldedCellsAfter` and `SmoothingStatus`.
void attach_folds(const SmoothingResult& result, int status, vtkFieldData* data);

} // namespace footpoint::conversion

#endif
