// SPDX-License-Identifier: BSD-3-Clause
#include "EdgeConversion.h"

#include "CurveConversion.h"

#include <BRepLib.hxx>
#include <BRep_Tool.hxx>
#include <TopLoc_Location.hxx>

#include <cmath>

namespace footpoint::cad
{

namespace
{

/// Exactness of what is approximated, relative to the edge's length.
constexpr double kExactness = 1e-10;

double rough_length(const Handle(Geom_Curve) & curve, double first, double last)
{
  constexpr int steps = 16;
  double length = 0.0;
  gp_Pnt before = curve->Value(first);
  for (int i = 1; i <= steps; ++i)
  {
    const gp_Pnt point = curve->Value(first + (last - first) * i / steps);
    length += before.Distance(point);
    before = point;
  }
  return length;
}

} // namespace

EdgeData convert_edge(const TopoDS_Edge& edge, double scale)
{
  if (BRep_Tool::Degenerated(edge))
  {
    throw ConversionError("it is degenerate: a point");
  }
  TopLoc_Location location;
  double first = 0.0;
  double last = 0.0;
  Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, location, first, last);
  if (curve.IsNull())
  {
    // There may be one on a surface alone.
    if (BRepLib::BuildCurve3d(edge))
    {
      curve = BRep_Tool::Curve(edge, location, first, last);
    }
    if (curve.IsNull())
    {
      throw ConversionError("it has no curve in space, and none could be made");
    }
  }
  if (!(std::isfinite(first) && std::isfinite(last) && first < last && last - first < 1e100))
  {
    throw ConversionError("its range of parameters [" + std::to_string(first) + ", " +
      std::to_string(last) + "] is no interval");
  }
  const double length = rough_length(curve, first, last);
  if (!(std::isfinite(length) && length > 0.0))
  {
    throw ConversionError("its length is zero or not finite");
  }
  const ConvertedCurve converted = convert_curve(curve, first, last, kExactness * length);
  EdgeData data;
  data.curve = curve_data(converted.curve, location.Transformation(), scale);
  data.tolerance = scale * (BRep_Tool::Tolerance(edge) + converted.error);
  return data;
}

} // namespace footpoint::cad
