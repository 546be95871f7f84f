// SPDX-License-Identifier: BSD-3-Clause
// Private: geometry of the core as VTK's Bézier cells, the inverse of convert_bezier_cells.

#ifndef BezierCells_h
#define BezierCells_h

#include "footpoint/model/model.h"

#include <functional>

class vtkUnstructuredGrid;

namespace footpoint::conversion
{

/// Fills a grid with the Bézier pieces of all faces, in the order of faces, patches and knot spans,
/// u fastest; loops are not looked at. Cell arrays `FaceId`, `ParameterRange` and
/// HigherOrderDegrees (active), active RationalWeights where any piece is rational; field data
/// `FaceName`, `Orientation` and `Tolerance` with a value for each face.
///
/// Cells of one face that are neighbours in parameters, also from the start of the face's domain to
/// its end, have the points of their border in common where these are the same numbers. Poles,
/// whose points differ in their parameters, stay apart: one point for several places of a cell
/// would stand for different positions where VTK interpolates between control points. \param model
/// faces without patches use up their numbers \param proceed  told the finished fraction; false
/// cancels \return false where it was cancelled \throw GeometryError for a patch that is no NURBS
/// curve or surface
bool write_bezier_cells(
  const Model& model, const std::function<bool(double)>& proceed, vtkUnstructuredGrid* grid);

} // namespace footpoint::conversion

#endif
