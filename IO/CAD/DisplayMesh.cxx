// SPDX-License-Identifier: BSD-3-Clause
#include "DisplayMesh.h"

#include <BRepBndLib.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <GeomLib.hxx>
#include <IMeshTools_Parameters.hxx>
#include <Poly_Triangulation.hxx>
#include <TopLoc_Location.hxx>

#include <cmath>

namespace footpoint::cad
{

namespace
{

/// Default deflection as a fraction of the diagonal: a sphere gets some 3000 triangles.
constexpr double kRelativeDeflection = 1e-3;
/// Angle (radians) of tangents below which a point is a pole to Open CASCADE.
constexpr double kSingular = 1e-10;

double default_deflection(const TopoDS_Shape& shape)
{
  Bnd_Box box;
  BRepBndLib::Add(shape, box, false);
  const double diagonal = box.IsVoid() ? 0.0 : std::sqrt(box.SquareExtent());
  return diagonal > 0.0 && std::isfinite(diagonal) ? kRelativeDeflection * diagonal : 1.0;
}

/// Unit normals of the triangles around each node, for nodes at which the surface has none.
std::vector<gp_XYZ> triangle_normals(const Handle(Poly_Triangulation) & mesh)
{
  std::vector<gp_XYZ> sums(static_cast<std::size_t>(mesh->NbNodes()) + 1);
  for (int i = 1; i <= mesh->NbTriangles(); ++i)
  {
    int a = 0;
    int b = 0;
    int c = 0;
    mesh->Triangle(i).Get(a, b, c);
    const gp_XYZ origin = mesh->Node(a).XYZ();
    const gp_XYZ normal = (mesh->Node(b).XYZ() - origin).Crossed(mesh->Node(c).XYZ() - origin);
    for (const int corner : { a, b, c })
    {
      sums[static_cast<std::size_t>(corner)] += normal;
    }
  }
  return sums;
}

} // namespace

void triangulate(const TopoDS_Shape& shape, double deflection, double angular_deflection,
  const Message_ProgressRange& progress)
{
  IMeshTools_Parameters parameters;
  parameters.Deflection = deflection > 0.0 ? deflection : default_deflection(shape);
  parameters.Angle = angular_deflection * M_PI / 180.0;
  parameters.InParallel = true;
  BRepMesh_IncrementalMesh(shape, parameters, progress);
}

FaceMesh face_mesh(const TopoDS_Face& face, double scale)
{
  FaceMesh result;
  TopLoc_Location location;
  const Handle(Poly_Triangulation) mesh = BRep_Tool::Triangulation(face, location);
  if (mesh.IsNull())
  {
    return result;
  }
  TopLoc_Location surface_location;
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(face, surface_location);
  const gp_Trsf& move = location.Transformation();
  const bool exact = mesh->HasUVNodes() && !surface.IsNull();
  const std::vector<gp_XYZ> rough = triangle_normals(mesh);
  const bool reversed = face.Orientation() == TopAbs_REVERSED;
  // Triangles of a mirrored face run the other way round.
  const bool turned = reversed != move.IsNegative();
  for (int i = 1; i <= mesh->NbNodes(); ++i)
  {
    const gp_Pnt point = mesh->Node(i).Transformed(move);
    gp_XYZ normal = rough[static_cast<std::size_t>(i)];
    gp_Dir estimate;
    if (exact && GeomLib::NormEstim(surface, mesh->UVNode(i), kSingular, estimate) <= 1)
    {
      normal = estimate.XYZ();
    }
    const gp_Mat rotation = move.HVectorialPart();
    normal.Multiply(rotation);
    const double length = normal.Modulus();
    const double sign = (turned ? -1.0 : 1.0) * (length > 0.0 ? 1.0 / length : 0.0);
    for (int axis = 1; axis <= 3; ++axis)
    {
      result.points.push_back(scale * point.Coord(axis));
      result.normals.push_back(sign * normal.Coord(axis));
    }
  }
  for (int i = 1; i <= mesh->NbTriangles(); ++i)
  {
    int corners[3];
    mesh->Triangle(i).Get(corners[0], corners[1], corners[2]);
    if (turned)
    {
      std::swap(corners[1], corners[2]);
    }
    for (const int corner : corners)
    {
      result.corners.push_back(corner - 1);
    }
  }
  return result;
}

} // namespace footpoint::cad
