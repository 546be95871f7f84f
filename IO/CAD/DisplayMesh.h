// SPDX-License-Identifier: BSD-3-Clause
// Private: triangles for the screen, made by Open CASCADE.

#ifndef DisplayMesh_h
#define DisplayMesh_h

#include "CADModel.h"

#include <Message_ProgressRange.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>

namespace footpoint::cad
{

/// Triangulates all faces of a shape; the triangles are kept in it.
/// \param deflection distance in millimetres; 0: a thousandth of the diagonal of the shape's box
/// \param angular_deflection degrees
/// \throw Standard_Failure
void triangulate(const TopoDS_Shape& shape, double deflection, double angular_deflection,
  const Message_ProgressRange& progress);

/// The triangles of a face, with the normals of the exact surface, which point outward; empty where
/// it has none. \param scale factor from millimetres to the unit that is asked for
FaceMesh face_mesh(const TopoDS_Face& face, double scale);

} // namespace footpoint::cad

#endif
