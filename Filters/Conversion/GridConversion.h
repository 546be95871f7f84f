// SPDX-License-Identifier: BSD-3-Clause
// Private: structured grids of the core and of VTK.

#ifndef GridConversion_h
#define GridConversion_h

#include "footpoint/grids/grid_quality.h"
#include "footpoint/grids/smoothing.h"
#include "footpoint/grids/structured_points.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

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

/// A grid of dimensions nu × nv × 1 with points in double precision, where it is.
GridView view_grid(vtkStructuredGrid* grid);

/// A named array with the columns of a matrix as tuples.
vtkSmartPointer<vtkDoubleArray> make_array(const char* name,
  const Eigen::Ref<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic>>& columns);

/// A named array that is not filled yet.
vtkSmartPointer<vtkDoubleArray> new_array(const char* name, int components, vtkIdType tuples);

/// The cell arrays `Jacobian` and `Folded`, computed in their own memory.
/// \return the number of folded cells
std::int64_t attach_quality(const GridView& grid, vtkCellData* data);
void attach_quality(const GridQuality<3>& quality, vtkCellData* data);

/// The point array `Normals`, which becomes the active normals, computed in its own memory.
void attach_normals(const GridView& grid, vtkPointData* data);

/// The point array `TCoords`, which becomes the active texture coordinates.
/// \param count points along each direction
void attach_texture_coordinates(const std::array<int, 2>& count, vtkPointData* data);

/// The number of `SmoothingStatus`: 0 not smoothed, 1 converged, 2 not converged, 3 rejected.
int smoothing_status(const SmoothingResult& result, Smoothing method);

/// `FoldedCellsBefore`, `FoldedCellsAfter` and `SmoothingStatus`.
void attach_folds(const SmoothingResult& result, int status, vtkFieldData* data);

} // namespace footpoint::conversion

#endif
