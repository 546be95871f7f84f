// SPDX-License-Identifier: BSD-3-Clause
// Private: Open CASCADE's curves as B-splines.

#ifndef CurveConversion_h
#define CurveConversion_h

#include "CADModel.h"
#include "ParameterMap.h"

#include <Geom_BSplineCurve.hxx>
#include <Geom_Curve.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <gp_Trsf.hxx>

#include <stdexcept>
#include <string>

namespace footpoint::cad
{

/// Geometry that cannot be converted; the message says why.
class ConversionError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

struct ConvertedCurve
{
  Handle(Geom_BSplineCurve) curve;
  ParameterMap map = ParameterMap::identity();
  double error = 0.0; ///< model units; 0 where the conversion is exact
};

/// The part of a curve between two parameters, exactly; offset curves and unknown ones are
/// approximated to `tolerance` (model units), with `error` saying how well.
/// \pre first < last \throw ConversionError, Standard_Failure
ConvertedCurve convert_curve(
  const Handle(Geom_Curve) & curve, double first, double last, double tolerance);

/// Numbers of a B-spline that is not periodic, moved and then scaled.
CurveData curve_data(const Handle(Geom_BSplineCurve) & curve, const gp_Trsf& move, double scale);

/// A full knot vector.
std::vector<double> flat_knots(
  const TColStd_Array1OfReal& knots, const TColStd_Array1OfInteger& multiplicities);

/// Distinct knots and multiplicities of a clamped B-spline with knots of multiplicity `inner`
/// between its ends.
struct KnotArrays
{
  KnotArrays(const std::vector<double>& distinct, int degree, int inner);
  TColStd_Array1OfReal knots;
  TColStd_Array1OfInteger multiplicities;
};

} // namespace footpoint::cad

#endif
