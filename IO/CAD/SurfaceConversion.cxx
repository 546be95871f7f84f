// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceConversion.h"

#include "CurveConversion.h"

#include <GeomConvert.hxx>
#include <GeomConvert_ApproxSurface.hxx>
#include <Geom_BezierSurface.hxx>
#include <Geom_ElementarySurface.hxx>
#include <Geom_OffsetSurface.hxx>
#include <Geom_Plane.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Geom_SurfaceOfLinearExtrusion.hxx>
#include <Geom_SurfaceOfRevolution.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>

#include <algorithm>
#include <cmath>

namespace footpoint::cad
{

namespace
{

constexpr int kMaximumSegments = 400; ///< of an approximation
constexpr int kMaximumDegree = 9;     ///< of an approximation

ConvertedSurface convert_plane(const Handle(Geom_Plane) & plane, const Window& window)
{
  TColgp_Array2OfPnt poles(1, 2, 1, 2);
  for (int i = 0; i < 2; ++i)
  {
    for (int j = 0; j < 2; ++j)
    {
      poles(i + 1, j + 1) =
        plane->Value(i ? window.upper[0] : window.lower[0], j ? window.upper[1] : window.lower[1]);
    }
  }
  const KnotArrays u({ window.lower[0], window.upper[0] }, 1, 0);
  const KnotArrays v({ window.lower[1], window.upper[1] }, 1, 0);
  ConvertedSurface result;
  result.surface =
    new Geom_BSplineSurface(poles, u.knots, v.knots, u.multiplicities, v.multiplicities, 1, 1);
  return result;
}

/// A meridian turned about an axis by the angles of a window; `sense` −1 turns clockwise.
ConvertedSurface revolve(const Handle(Geom_Curve) & meridian, const gp_Ax1& axis, double sense,
  const Window& window, double tolerance)
{
  const ConvertedCurve profile =
    convert_curve(meridian, window.lower[1], window.upper[1], tolerance);
  const std::vector<double> knots = arc_knots(window.lower[0], window.upper[0]);
  const int arcs = static_cast<int>(knots.size()) - 1;
  const double half = 0.5 * (window.upper[0] - window.lower[0]) / arcs;
  const int rows = profile.curve->NbPoles();
  TColgp_Array2OfPnt poles(1, 2 * arcs + 1, 1, rows);
  TColStd_Array2OfReal weights(1, 2 * arcs + 1, 1, rows);
  const gp_XYZ& centre = axis.Location().XYZ();
  const gp_XYZ& along = axis.Direction().XYZ();
  for (int i = 0; i <= 2 * arcs; ++i)
  {
    const bool middle = i % 2 == 1;
    const double start = knots[static_cast<std::size_t>(i / 2)];
    const double angle =
      middle ? 0.5 * (start + knots[static_cast<std::size_t>(i / 2) + 1]) : start;
    // The tangents at an arc's ends meet at 1 / cos(half) times the radius.
    const double stretch = middle ? 1.0 / std::cos(half) : 1.0;
    for (int j = 1; j <= rows; ++j)
    {
      const gp_XYZ arm = profile.curve->Pole(j).XYZ() - centre;
      const gp_XYZ height = along * arm.Dot(along);
      const gp_XYZ radial = arm - height;
      const gp_XYZ tangential = along.Crossed(radial) * sense;
      poles(i + 1, j) =
        centre + height + (radial * std::cos(angle) + tangential * std::sin(angle)) * stretch;
      weights(i + 1, j) = profile.curve->Weight(j) * (middle ? std::cos(half) : 1.0);
    }
  }
  const KnotArrays u(knots, 2, 2);
  ConvertedSurface result;
  result.surface = new Geom_BSplineSurface(poles, weights, u.knots, profile.curve->Knots(),
    u.multiplicities, profile.curve->Multiplicities(), 2, profile.curve->Degree());
  result.map = { { ParameterMap::arcs(knots), profile.map } };
  result.error = profile.error;
  return result;
}

ConvertedSurface extrude(
  const Handle(Geom_SurfaceOfLinearExtrusion) & surface, const Window& window, double tolerance)
{
  const ConvertedCurve profile =
    convert_curve(surface->BasisCurve(), window.lower[0], window.upper[0], tolerance);
  const gp_XYZ direction = surface->Direction().XYZ();
  const int columns = profile.curve->NbPoles();
  TColgp_Array2OfPnt poles(1, columns, 1, 2);
  TColStd_Array2OfReal weights(1, columns, 1, 2);
  for (int i = 1; i <= columns; ++i)
  {
    for (int j = 1; j <= 2; ++j)
    {
      const double height = j == 1 ? window.lower[1] : window.upper[1];
      poles(i, j) = profile.curve->Pole(i).XYZ() + direction * height;
      weights(i, j) = profile.curve->Weight(i);
    }
  }
  const KnotArrays v({ window.lower[1], window.upper[1] }, 1, 0);
  ConvertedSurface result;
  result.surface = new Geom_BSplineSurface(poles, weights, profile.curve->Knots(), v.knots,
    profile.curve->Multiplicities(), v.multiplicities, profile.curve->Degree(), 1);
  result.map[0] = profile.map;
  result.error = profile.error;
  return result;
}

void shift_knots(const Handle(Geom_BSplineSurface) & surface, int direction, double shift)
{
  if (shift == 0.0)
  {
    return;
  }
  TColStd_Array1OfReal knots(direction == 0 ? surface->UKnots() : surface->VKnots());
  for (double& knot : knots)
  {
    knot += shift;
  }
  direction == 0 ? surface->SetUKnots(knots) : surface->SetVKnots(knots);
}

/// Opens a periodic direction at the window's lower end.
void open_periodic(const Handle(Geom_BSplineSurface) & surface, int direction, double start)
{
  const bool u = direction == 0;
  const double period = u ? surface->UPeriod() : surface->VPeriod();
  double first =
    u ? surface->UKnot(surface->FirstUKnotIndex()) : surface->VKnot(surface->FirstVKnotIndex());
  const double turns = std::floor((start - first) / period + 1e-9);
  const double origin = start - turns * period;
  // A knot nearer than this to the start serves as it.
  const double near = 1e-10 * period;
  int index = 0;
  const auto find = [&]
  {
    for (int i = 1; i <= (u ? surface->NbUKnots() : surface->NbVKnots()); ++i)
    {
      if (std::abs((u ? surface->UKnot(i) : surface->VKnot(i)) - origin) <= near)
      {
        return i;
      }
    }
    return 0;
  };
  index = find();
  if (index == 0)
  {
    u ? surface->InsertUKnot(origin, 1, near) : surface->InsertVKnot(origin, 1, near);
    index = find();
  }
  if (index == 0)
  {
    throw ConversionError("a periodic B-spline surface could not be opened at its seam");
  }
  u ? surface->SetUOrigin(index) : surface->SetVOrigin(index);
  u ? surface->SetUNotPeriodic() : surface->SetVNotPeriodic();
  // Open CASCADE keeps knots before the first of the domain.
  first =
    u ? surface->UKnot(surface->FirstUKnotIndex()) : surface->VKnot(surface->FirstVKnotIndex());
  shift_knots(surface, direction, start - first);
}

ConvertedSurface cut_spline(
  const Handle(Geom_BSplineSurface) & original, const Window& window, bool cut)
{
  const auto surface = Handle(Geom_BSplineSurface)::DownCast(original->Copy());
  const bool u_periodic = surface->IsUPeriodic();
  const bool v_periodic = surface->IsVPeriodic();
  if (u_periodic)
  {
    open_periodic(surface, 0, window.lower[0]);
  }
  if (v_periodic)
  {
    open_periodic(surface, 1, window.lower[1]);
  }
  double u1 = 0.0;
  double u2 = 0.0;
  double v1 = 0.0;
  double v2 = 0.0;
  surface->Bounds(u1, u2, v1, v2);
  Window range{ { { u1, v1 } }, { { u2, v2 } } };
  // What was periodic has knots beyond the domain, which cutting removes.
  bool smaller = u_periodic || v_periodic;
  for (int direction = 0; direction < 2; ++direction)
  {
    if (!cut && !(direction == 0 ? u_periodic : v_periodic))
    {
      continue;
    }
    const double length = range.upper[direction] - range.lower[direction];
    // Ends that are this near to the surface's are the surface's.
    const double near = 1e-9 * length;
    if (window.lower[direction] > range.lower[direction] + near)
    {
      range.lower[direction] = window.lower[direction];
      smaller = true;
    }
    if (window.upper[direction] < range.upper[direction] - near)
    {
      range.upper[direction] = window.upper[direction];
      smaller = true;
    }
    if (range.lower[direction] >= range.upper[direction])
    {
      throw ConversionError("its trim loops lie outside its B-spline surface");
    }
  }
  if (smaller)
  {
    surface->Segment(range.lower[0], range.upper[0], range.lower[1], range.upper[1]);
  }
  ConvertedSurface result;
  result.surface = surface;
  return result;
}

ConvertedSurface approximate(
  const Handle(Geom_Surface) & surface, const Window& window, double tolerance)
{
  const Handle(Geom_Surface) part = new Geom_RectangularTrimmedSurface(
    surface, window.lower[0], window.upper[0], window.lower[1], window.upper[1]);
  GeomConvert_ApproxSurface approximation(
    part, tolerance, GeomAbs_C1, GeomAbs_C1, kMaximumDegree, kMaximumDegree, kMaximumSegments, 1);
  if (!approximation.HasResult())
  {
    throw ConversionError(std::string("a ") + surface->DynamicType()->Name() +
      " could not be approximated by a B-spline surface");
  }
  ConvertedSurface result;
  result.surface = approximation.Surface();
  // 0 would say that it is exact.
  result.error = std::max(approximation.MaxError(), 1e-16);
  return result;
}

} // namespace

Handle(Geom_Surface) bare_surface(const Handle(Geom_Surface) & surface)
{
  if (const auto trimmed = Handle(Geom_RectangularTrimmedSurface)::DownCast(surface))
  {
    return bare_surface(trimmed->BasisSurface());
  }
  if (const auto offset = Handle(Geom_OffsetSurface)::DownCast(surface))
  {
    if (offset->Offset() == 0.0)
    {
      return bare_surface(offset->BasisSurface());
    }
    const Handle(Geom_Surface) simple = offset->Surface();
    return simple.IsNull() ? surface : bare_surface(simple);
  }
  return surface;
}

ConvertedSurface convert_surface(
  const Handle(Geom_Surface) & surface, const Window& window, bool cut, double tolerance)
{
  if (const auto plane = Handle(Geom_Plane)::DownCast(surface))
  {
    return convert_plane(plane, window);
  }
  if (const auto simple = Handle(Geom_ElementarySurface)::DownCast(surface))
  {
    // Cylinder, cone, sphere, torus; the frame may be left-handed.
    const gp_Ax3& frame = simple->Position();
    return revolve(simple->UIso(0.0), frame.Axis(), frame.Direct() ? 1.0 : -1.0, window, tolerance);
  }
  if (const auto turned = Handle(Geom_SurfaceOfRevolution)::DownCast(surface))
  {
    return revolve(turned->BasisCurve(), turned->Axis(), 1.0, window, tolerance);
  }
  if (const auto extruded = Handle(Geom_SurfaceOfLinearExtrusion)::DownCast(surface))
  {
    return extrude(extruded, window, tolerance);
  }
  if (const auto bezier = Handle(Geom_BezierSurface)::DownCast(surface))
  {
    return cut_spline(GeomConvert::SurfaceToBSplineSurface(bezier), window, cut);
  }
  if (const auto spline = Handle(Geom_BSplineSurface)::DownCast(surface))
  {
    return cut_spline(spline, window, cut);
  }
  return approximate(surface, window, tolerance);
}

SurfaceData surface_data(
  const Handle(Geom_BSplineSurface) & surface, const gp_Trsf& move, double scale)
{
  SurfaceData data;
  data.degree = { { surface->UDegree(), surface->VDegree() } };
  data.size = { { surface->NbUPoles(), surface->NbVPoles() } };
  data.knots = { { flat_knots(surface->UKnots(), surface->UMultiplicities()),
    flat_knots(surface->VKnots(), surface->VMultiplicities()) } };
  // Open CASCADE 7.6 returns weights of 0 where a surface is not rational.
  const bool rational = surface->IsURational() || surface->IsVRational();
  for (int j = 1; j <= data.size[1]; ++j)
  {
    for (int i = 1; i <= data.size[0]; ++i)
    {
      const gp_Pnt pole = surface->Pole(i, j).Transformed(move);
      for (int axis = 1; axis <= 3; ++axis)
      {
        data.points.push_back(scale * pole.Coord(axis));
      }
      if (rational)
      {
        data.weights.push_back(surface->Weight(i, j));
      }
    }
  }
  return data;
}

} // namespace footpoint::cad
