// SPDX-License-Identifier: BSD-3-Clause
#include "CurveConversion.h"

#include <GeomConvert.hxx>
#include <GeomConvert_ApproxCurve.hxx>
#include <Geom_BezierCurve.hxx>
#include <Geom_Circle.hxx>
#include <Geom_Ellipse.hxx>
#include <Geom_Hyperbola.hxx>
#include <Geom_Line.hxx>
#include <Geom_OffsetCurve.hxx>
#include <Geom_Parabola.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <TColgp_Array1OfPnt.hxx>

#include <algorithm>
#include <cmath>

namespace footpoint::cad
{

namespace
{

constexpr int kMaximumSegments = 1000; ///< of an approximation
constexpr int kMaximumDegree = 9;      ///< of an approximation

Handle(Geom_BSplineCurve) make_line(const gp_Pnt& from, const gp_Pnt& to, double first, double last)
{
  TColgp_Array1OfPnt poles(1, 2);
  poles(1) = from;
  poles(2) = to;
  const KnotArrays knots({ first, last }, 1, 0);
  return new Geom_BSplineCurve(poles, knots.knots, knots.multiplicities, 1);
}

/// Quadratic arcs between knots. The middle control point of each is where the tangents at its ends
/// meet, `stretch` times as far from the centre as the arc's middle; the weight is its inverse.
Handle(Geom_BSplineCurve) make_arcs(const Handle(Geom_Curve) & curve, const gp_Pnt& centre,
  const std::vector<double>& knots, double weight)
{
  const int arcs = static_cast<int>(knots.size()) - 1;
  TColgp_Array1OfPnt poles(1, 2 * arcs + 1);
  TColStd_Array1OfReal weights(1, 2 * arcs + 1);
  for (int i = 0; i <= arcs; ++i)
  {
    const double at = knots[static_cast<std::size_t>(i)];
    poles(2 * i + 1) = curve->Value(at);
    weights(2 * i + 1) = 1.0;
    if (i < arcs)
    {
      const gp_Pnt middle = curve->Value(0.5 * (at + knots[static_cast<std::size_t>(i) + 1]));
      poles(2 * i + 2) = centre.XYZ() + (middle.XYZ() - centre.XYZ()) / weight;
      weights(2 * i + 2) = weight;
    }
  }
  const KnotArrays arrays(knots, 2, 2);
  return new Geom_BSplineCurve(poles, weights, arrays.knots, arrays.multiplicities, 2);
}

ConvertedCurve convert_ellipse(
  const Handle(Geom_Curve) & curve, const gp_Pnt& centre, double first, double last)
{
  const std::vector<double> knots = arc_knots(first, last);
  const double half = 0.5 * (last - first) / static_cast<double>(knots.size() - 1);
  return { make_arcs(curve, centre, knots, std::cos(half)), ParameterMap::arcs(knots), 0.0 };
}

ConvertedCurve convert_parabola(const Handle(Geom_Curve) & curve, double first, double last)
{
  gp_Pnt start;
  gp_Vec tangent;
  curve->D1(first, start, tangent);
  TColgp_Array1OfPnt poles(1, 3);
  poles(1) = start;
  poles(2) = start.Translated(0.5 * (last - first) * tangent);
  poles(3) = curve->Value(last);
  const KnotArrays knots({ first, last }, 2, 0);
  return { new Geom_BSplineCurve(poles, knots.knots, knots.multiplicities, 2),
    ParameterMap::identity(), 0.0 };
}

/// The range of a periodic B-spline, or a smaller range of any.
Handle(Geom_BSplineCurve)
  cut_spline(const Handle(Geom_BSplineCurve) & original, double first, double last)
{
  auto curve = Handle(Geom_BSplineCurve)::DownCast(original->Copy());
  double shift = 0.0;
  if (curve->IsPeriodic())
  {
    const double period = curve->Period();
    shift = period * std::floor((first - curve->FirstParameter()) / period + 1e-9);
    last = std::min(last, first + period);
    curve->Segment(first - shift, last - shift);
    if (curve->IsPeriodic())
    {
      curve->SetNotPeriodic();
    }
    shift += (first - shift) - curve->FirstParameter(); // it may have chosen another turn
  }
  else
  {
    first = std::max(first, curve->FirstParameter());
    last = std::min(last, curve->LastParameter());
    if (first >= last)
    {
      throw ConversionError("its range of parameters lies outside its spline");
    }
    if (first > curve->FirstParameter() || last < curve->LastParameter())
    {
      curve->Segment(first, last);
    }
  }
  if (shift != 0.0)
  {
    TColStd_Array1OfReal knots(1, curve->NbKnots());
    curve->Knots(knots);
    for (double& knot : knots)
    {
      knot += shift;
    }
    curve->SetKnots(knots);
  }
  return curve;
}

ConvertedCurve approximate(
  const Handle(Geom_Curve) & curve, double first, double last, double tolerance)
{
  GeomConvert_ApproxCurve approximation(new Geom_TrimmedCurve(curve, first, last), tolerance,
    GeomAbs_C1, kMaximumSegments, kMaximumDegree);
  if (!approximation.HasResult())
  {
    throw ConversionError(std::string("a ") + curve->DynamicType()->Name() +
      " could not be approximated by a B-spline");
  }
  return { approximation.Curve(), ParameterMap::identity(), approximation.MaxError() };
}

} // namespace

KnotArrays::KnotArrays(const std::vector<double>& distinct, int degree, int inner)
  : knots(1, static_cast<int>(distinct.size()))
  , multiplicities(1, static_cast<int>(distinct.size()))
{
  for (int i = 1; i <= this->knots.Length(); ++i)
  {
    this->knots(i) = distinct[static_cast<std::size_t>(i) - 1];
    this->multiplicities(i) = i == 1 || i == this->knots.Length() ? degree + 1 : inner;
  }
}

ConvertedCurve convert_curve(
  const Handle(Geom_Curve) & curve, double first, double last, double tolerance)
{
  if (const auto trimmed = Handle(Geom_TrimmedCurve)::DownCast(curve))
  {
    return convert_curve(trimmed->BasisCurve(), first, last, tolerance);
  }
  if (const auto line = Handle(Geom_Line)::DownCast(curve))
  {
    return { make_line(line->Value(first), line->Value(last), first, last),
      ParameterMap::identity(), 0.0 };
  }
  if (const auto circle = Handle(Geom_Circle)::DownCast(curve))
  {
    return convert_ellipse(curve, circle->Location(), first, last);
  }
  if (const auto ellipse = Handle(Geom_Ellipse)::DownCast(curve))
  {
    return convert_ellipse(curve, ellipse->Location(), first, last);
  }
  if (!Handle(Geom_Parabola)::DownCast(curve).IsNull())
  {
    return convert_parabola(curve, first, last);
  }
  if (const auto hyperbola = Handle(Geom_Hyperbola)::DownCast(curve))
  {
    return { make_arcs(
               curve, hyperbola->Location(), { first, last }, std::cosh(0.5 * (last - first))),
      ParameterMap::hyperbola(first, last), 0.0 };
  }
  if (const auto bezier = Handle(Geom_BezierCurve)::DownCast(curve))
  {
    return { cut_spline(GeomConvert::CurveToBSplineCurve(bezier), first, last),
      ParameterMap::identity(), 0.0 };
  }
  if (const auto spline = Handle(Geom_BSplineCurve)::DownCast(curve))
  {
    return { cut_spline(spline, first, last), ParameterMap::identity(), 0.0 };
  }
  return approximate(curve, first, last, tolerance);
}

std::vector<double> flat_knots(
  const TColStd_Array1OfReal& knots, const TColStd_Array1OfInteger& multiplicities)
{
  std::vector<double> result;
  for (int i = knots.Lower(); i <= knots.Upper(); ++i)
  {
    result.insert(result.end(), static_cast<std::size_t>(multiplicities(i)), knots(i));
  }
  return result;
}

CurveData curve_data(const Handle(Geom_BSplineCurve) & curve, const gp_Trsf& move, double scale)
{
  CurveData data;
  data.degree = curve->Degree();
  data.knots = flat_knots(curve->Knots(), curve->Multiplicities());
  for (int i = 1; i <= curve->NbPoles(); ++i)
  {
    const gp_Pnt pole = curve->Pole(i).Transformed(move);
    for (int axis = 1; axis <= 3; ++axis)
    {
      data.points.push_back(scale * pole.Coord(axis));
    }
    if (curve->IsRational())
    {
      data.weights.push_back(curve->Weight(i));
    }
  }
  return data;
}

} // namespace footpoint::cad
