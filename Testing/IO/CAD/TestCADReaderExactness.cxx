// SPDX-License-Identifier: BSD-3-Clause
// Every face of every real file against Open CASCADE's own evaluation, at corresponding parameters:
// points, outward normals, the kept region of (u, v), trim curves against edges, edges in space.
#include "CADTesting.h"

#include "LengthUnits.h"

#include "footpoint/splines/bezier.h"

#include <BRepAdaptor_Curve.hxx>
#include <BRepGProp_Face.hxx>
#include <BRepTopAdaptor_FClass2d.hxx>
#include <BRep_Tool.hxx>
#include <GeomAPI_ProjectPointOnCurve.hxx>
#include <Geom_Surface.hxx>
#include <TopExp_Explorer.hxx>

using namespace testing;

namespace
{

constexpr int kSamples = 9;
/// Deviations are relative to the size, and to this part of the distance from the origin: there,
/// the coordinates themselves have no more digits, and each degree of a spline (up to 11 here)
/// rounds.
constexpr double kFromOrigin = 4e-3;
constexpr double kExact = 1e-12;

struct Deviations
{
  double point = 0.0;  ///< |our point − theirs|, relative
  double bezier = 0.0; ///< |our point − that of the extracted Bézier piece|, relative
  double normal = 0.0; ///< |our unit normal − theirs|
  double trim = 0.0;   ///< distance of a trim curve from the nearest edge / tolerance of the face
  double gap = 0.0;    ///< largest gap in a loop / size
  int compared = 0;    ///< points inside or outside, as Open CASCADE says, too
  int different = 0;   ///< those where we say otherwise
  int faces = 0;

  void Add(const Deviations& other)
  {
    this->point = std::max(this->point, other.point);
    this->bezier = std::max(this->bezier, other.bezier);
    this->normal = std::max(this->normal, other.normal);
    this->trim = std::max(this->trim, other.trim);
    this->gap = std::max(this->gap, other.gap);
    this->compared += other.compared;
    this->different += other.different;
    this->faces += other.faces;
  }
};

footpoint::Vector3 Vector(const gp_XYZ& p)
{
  return footpoint::Vector3(p.X(), p.Y(), p.Z());
}

/// A point of the extracted Bézier piece that holds it, by de Casteljau's construction.
footpoint::Vector3 BezierPoint(const std::vector<footpoint::BezierPiece<2>>& pieces,
  const footpoint::Parameter<2>& at)
{
  for (const auto& piece : pieces)
  {
    if (at[0] < piece.lower[0] || at[0] > piece.upper[0] || at[1] < piece.lower[1] ||
      at[1] > piece.upper[1])
    {
      continue;
    }
    const auto cast = [&](Eigen::Matrix<double, 4, Eigen::Dynamic> points, int direction)
    {
      const double s = (at[direction] - piece.lower[direction]) /
        (piece.upper[direction] - piece.lower[direction]);
      while (points.cols() > 1)
      {
        const Eigen::Index left = points.cols() - 1;
        points = ((1.0 - s) * points.leftCols(left) + s * points.rightCols(left)).eval();
      }
      return points;
    };
    Eigen::Matrix<double, 4, Eigen::Dynamic> row(4, piece.degree[1] + 1);
    for (int j = 0; j <= piece.degree[1]; ++j)
    {
      const int count = piece.degree[0] + 1;
      row.col(j) = cast(piece.control.middleCols(j * count, count), 0);
    }
    const Eigen::Vector4d point = cast(row, 1);
    return point.head<3>() / point[3];
  }
  throw std::runtime_error("no Bézier piece holds a point of the domain");
}

/// Loops as fine polygons.
std::vector<std::vector<std::array<double, 2>>> Polygons(const ReadFace& face)
{
  std::vector<std::vector<std::array<double, 2>>> polygons;
  for (const auto& loop : face.loops)
  {
    auto& polygon = polygons.emplace_back();
    for (const footpoint::Curve& curve : loop)
    {
      const int steps = 32 * static_cast<int>(curve.knots().distinct_knots().size());
      for (int i = 0; i < steps; ++i)
      {
        const double t = First(curve) + (Last(curve) - First(curve)) * i / steps;
        const footpoint::Vector3 p = At(curve, t);
        polygon.push_back({ { p[0], p[1] } });
      }
    }
  }
  return polygons;
}

/// Winding number of all polygons around a point, which our loops keep where it is positive.
/// \param distance of the point from the polygons, scaled to the unit square, is lowered
int Winding(const std::vector<std::vector<std::array<double, 2>>>& polygons, double u, double v,
  double width, double height, double& distance)
{
  int winding = 0;
  for (const auto& polygon : polygons)
  {
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
      const auto& a = polygon[i];
      const auto& b = polygon[(i + 1) % polygon.size()];
      const double left = (b[0] - a[0]) * (v - a[1]) - (u - a[0]) * (b[1] - a[1]);
      winding += a[1] <= v && b[1] > v && left > 0.0 ? 1 : 0;
      winding -= a[1] > v && b[1] <= v && left < 0.0 ? 1 : 0;
      const double dx = (b[0] - a[0]) / width;
      const double dy = (b[1] - a[1]) / height;
      const double px = (u - a[0]) / width;
      const double py = (v - a[1]) / height;
      const double length = dx * dx + dy * dy;
      const double s =
        length > 0.0 ? std::min(1.0, std::max(0.0, (px * dx + py * dy) / length)) : 0.0;
      distance = std::min(distance, std::hypot(px - s * dx, py - s * dy));
    }
  }
  return winding;
}

/// Distance of a point from the edges of a face; not the smallest where it is below `enough`.
double EdgeDistance(const TopoDS_Face& face, const gp_Pnt& point, double enough)
{
  double nearest = 1e300;
  for (TopExp_Explorer edges(face, TopAbs_EDGE); edges.More() && nearest > enough; edges.Next())
  {
    const TopoDS_Edge edge = TopoDS::Edge(edges.Current());
    double first = 0.0;
    double last = 0.0;
    const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, first, last);
    if (curve.IsNull())
    {
      continue;
    }
    for (int i = 0; i <= 16; ++i)
    {
      nearest = std::min(nearest, curve->Value(first + (last - first) * i / 16).Distance(point));
    }
    GeomAPI_ProjectPointOnCurve projection(point, curve, first, last);
    if (projection.NbPoints() > 0)
    {
      nearest = std::min(nearest, projection.LowerDistance());
    }
  }
  for (TopExp_Explorer vertices(face, TopAbs_VERTEX); vertices.More(); vertices.Next())
  {
    nearest = std::min(nearest, BRep_Tool::Pnt(TopoDS::Vertex(vertices.Current())).Distance(point));
  }
  return nearest;
}

/// \param scale millimetres in the unit of the outputs
Deviations CompareFace(const TopoDS_Face& original, vtkDataObject* block, double scale)
{
  Deviations found;
  found.faces = 1;
  const ReadFace face = FaceOf(block);
  // The parameters that correspond come from the conversion; points and normals do not.
  const auto map = footpoint::cad::convert_face(original, { 1.0 / scale }).map;
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(original);
  BRepGProp_Face properties(original);
  const auto& direction_u = face.surface->direction(0);
  const auto& direction_v = face.surface->direction(1);
  double u1 = 0.0;
  double u2 = 0.0;
  double v1 = 0.0;
  double v2 = 0.0;
  properties.Bounds(u1, u2, v1, v2);
  BRepTopAdaptor_FClass2d classifier(original, 1e-9);
  // A face may wind around its surface more than once.
  const bool as_given = false;
  const auto polygons = Polygons(face);
  const std::vector<footpoint::BezierPiece<2>> pieces = footpoint::extract_bezier(*face.surface);
  const double orientation = FieldValue(face.net, "Orientation");
  const double size = face.surface->size();

  for (int i = 0; i < kSamples; ++i)
  {
    for (int j = 0; j < kSamples; ++j)
    {
      const double u = u1 + (u2 - u1) * (i + 0.5) / kSamples;
      const double v = v1 + (v2 - v1) * (j + 0.5) / kSamples;
      double our_u = map[0](u);
      const double our_v = map[1](v);
      if (our_v < direction_v.origin || our_v > direction_v.origin + direction_v.length ||
        our_u < direction_u.origin || our_u > direction_u.origin + direction_u.length)
      {
        continue; // a window in another period, or a loop beyond its surface
      }
      const footpoint::Parameter<2> at =
        face.surface->to_local(footpoint::Parameter<2>(our_u, our_v));
      const auto jet =
        face.surface->jet(at, footpoint::Sides<2>::Constant(footpoint::Side::Right), 1);
      const footpoint::Vector3 point = face.surface->centre() + jet.point;
      found.point = std::max(found.point,
        (point - Vector(surface->Value(u, v).XYZ()) / scale).norm() /
          (size + kFromOrigin * point.norm()));
      const footpoint::Vector3 extracted = face.surface->centre() + BezierPoint(pieces, at);
      found.bezier = std::max(
        found.bezier, (point - extracted).norm() / (size + kFromOrigin * point.norm()));

      gp_Pnt position;
      gp_Vec outward;
      properties.Normal(u, v, position, outward);
      const footpoint::Vector3 normal = jet.first.col(0).cross(jet.first.col(1));
      if (outward.Magnitude() > 1e-6 && normal.norm() > 1e-9 * size * size)
      {
        found.normal = std::max(found.normal,
          (orientation * normal.normalized() - Vector(outward.XYZ()).normalized()).norm());
      }

      double distance = 1.0;
      const bool ours = polygons.empty() ||
        Winding(polygons, our_u, our_v, direction_u.length, direction_v.length, distance) > 0;
      const TopAbs_State theirs = classifier.Perform(gp_Pnt2d(u, v), as_given);
      if (distance > 0.005 && (theirs == TopAbs_IN || theirs == TopAbs_OUT))
      {
        ++found.compared;
        found.different += ours != (theirs == TopAbs_IN) ? 1 : 0;
      }
    }
  }

  const double tolerance = FieldValue(face.net, "Tolerance");
  for (const auto& loop : face.loops)
  {
    for (std::size_t i = 0; i < loop.size(); ++i)
    {
      const footpoint::Vector3 end = At(loop[i], Last(loop[i]));
      const footpoint::Curve& after = loop[(i + 1) % loop.size()];
      const footpoint::Vector3 next = At(after, First(after));
      const auto on_surface = [&](const footpoint::Vector3& p)
      { return At(*face.surface, p[0], p[1]); };
      found.gap = std::max(found.gap, (on_surface(end) - on_surface(next)).norm() / size);
      for (int k = 0; k <= 4; ++k)
      {
        const double t = First(loop[i]) + (Last(loop[i]) - First(loop[i])) * (k + 0.37) / 5;
        const footpoint::Vector3 p = scale * on_surface(At(loop[i], t));
        found.trim = std::max(found.trim,
          EdgeDistance(original, gp_Pnt(p[0], p[1], p[2]), 0.5 * scale * tolerance) /
            (scale * tolerance));
      }
    }
  }
  return found;
}

/// Largest distance of our curve from Open CASCADE's edge, relative to its size.
double CompareEdge(const TopoDS_Edge& original, vtkStructuredGrid* net, double scale)
{
  const footpoint::Curve curve = MakeCurve(net);
  BRepAdaptor_Curve theirs(original);
  double worst = 0.0;
  for (int i = 0; i <= 8; ++i)
  {
    const double t = First(curve) + (Last(curve) - First(curve)) * i / 8;
    const footpoint::Vector3 p = scale * At(curve, t);
    const gp_Pnt point(p[0], p[1], p[2]);
    // The parameters agree at knots; elsewhere the foot is close to the same parameter.
    double distance =
      theirs.Value(std::min(theirs.LastParameter(), std::max(theirs.FirstParameter(), t)))
        .Distance(point);
    double first = 0.0;
    double last = 0.0;
    const Handle(Geom_Curve) geometry = BRep_Tool::Curve(original, first, last);
    GeomAPI_ProjectPointOnCurve projection(point, geometry, first, last);
    if (projection.NbPoints() > 0)
    {
      distance = std::min(distance, projection.LowerDistance());
    }
    worst = std::max(worst, distance / (scale * curve.size() + kFromOrigin * p.norm()));
  }
  return worst;
}

void CompareFile(const std::string& file)
{
  const CadResult result = Read(file);
  CHECK(result.errors.empty());
  const OcctModel original(file);
  CHECK(result.faces == original.faces.Extent());
  CHECK(result.skipped == 0);
  CHECK(static_cast<int>(result.model->GetNumberOfBlocks()) == original.faces.Extent());
  Deviations total;
  for (unsigned int i = 0; i < result.model->GetNumberOfBlocks(); ++i)
  {
    vtkDataObject* block = result.model->GetBlock(i);
    const std::string unit = FieldText(FaceOf(block).net, "LengthUnit");
    const Deviations found =
      CompareFace(original.face(static_cast<int>(i)), block, footpoint::cad::millimetres_in(unit));
    total.Add(found);
  }
  double edges = 0.0;
  int worst_edge = -1;
  for (unsigned int i = 0; i < result.edges->GetNumberOfBlocks(); ++i)
  {
    auto* net = vtkStructuredGrid::SafeDownCast(result.edges->GetBlock(i));
    const double scale = footpoint::cad::millimetres_in(FieldText(net, "LengthUnit"));
    const int id = static_cast<int>(FieldValue(net, "EdgeId"));
    const double found = CompareEdge(TopoDS::Edge(original.edges(id + 1)), net, scale);
    worst_edge = found > edges ? id : worst_edge;
    edges = std::max(edges, found);
  }
  std::cout << std::filesystem::path(file).filename().string() << ": " << total.faces
            << " faces, point " << total.point << ", Bézier " << total.bezier << ", normal "
            << total.normal << ", trim " << total.trim << " tolerances, gap " << total.gap
            << ", region " << total.different << " of " << total.compared << ", edges " << edges
            << " (edge " << worst_edge << ")" << std::endl;
  CHECK(total.point <= kExact);
  CHECK(total.bezier <= kExact);
  CHECK(total.normal <= 1e-9);
  CHECK(edges <= kExact);
  CHECK(total.different == 0);
  // Tolerances are those of samples, to Open CASCADE and to us; between them it may be more.
  CHECK(total.trim <= 2.0);
  CHECK(total.gap <= 2e-3);
}

} // namespace

int TestCADReaderExactness(int, char*[])
{
  const std::vector<std::string> files = RealCadFiles();
  if (files.empty())
  {
    std::cout << "skipped: there is no CAD file in FOOTPOINT_SHARED_DATA or of Debian's packages\n";
    return 125;
  }
  footpoint::cad::redirect_messages();
  return Run(
    [&]
    {
      for (const std::string& file : files)
      {
        CompareFile(file);
      }
    });
}
