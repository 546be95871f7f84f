// SPDX-License-Identifier: BSD-3-Clause
// Private: trim curves in the parameters of our NURBS surfaces.

#ifndef ParameterCurves_h
#define ParameterCurves_h

#include "CADModel.h"
#include "EdgeProjection.h"
#include "ParameterMap.h"

#include <Geom2d_Curve.hxx>
#include <gp_Vec2d.hxx>

#include <array>
#include <memory>

namespace footpoint::cad
{

/// A trim curve as Open CASCADE has it, in the direction in which its loop runs.
struct TrimCurve
{
  Handle(Geom2d_Curve) curve;
  double first = 0.0;
  double last = 0.0;
  bool reversed = false;           ///< the loop runs from `last` to `first`
  gp_Vec2d shift = gp_Vec2d(0, 0); ///< whole periods of the surface
  /// The edge that `curve` misses; null where it does not.
  std::shared_ptr<const EdgeOnSurface> missed;
  double deviation = 0.0; ///< from the edge, where it is known to be above the edge's tolerance

  gp_Pnt2d at(double parameter) const; ///< of the curve, shifted
  /// The same, or where the edge is that it misses.
  gp_Pnt2d exact_at(double parameter) const;
  gp_Pnt2d start() const { return this->at(this->reversed ? this->last : this->first); }
  gp_Pnt2d end() const { return this->at(this->reversed ? this->first : this->last); }
};

/// What one unit of u and of v is in space, at most, and how exact a curve has to be there.
struct ParameterScale
{
  std::array<double, 2> speed; ///< model units
  double exactness;            ///< model units
};

/// The same curve in our parameters. Where those are Open CASCADE's, it is exact, and so are lines
/// along u and v everywhere; other curves are approximated until no sample is farther than
/// `exactness` away or rounding allows no more.
/// \param deviation is raised to the largest distance that was found (model units)
/// \throw ConversionError, Standard_Failure
CurveData convert_parameter_curve(const TrimCurve& trim, const std::array<ParameterMap, 2>& map,
  const ParameterScale& scale, double& deviation);

/// A straight piece of a loop.
CurveData parameter_line(const gp_Pnt2d& from, const gp_Pnt2d& to);

/// Extent of a curve: {{u_min, v_min}, {u_max, v_max}}, without tolerance.
std::array<std::array<double, 2>, 2> extent(const TrimCurve& trim);

} // namespace footpoint::cad

#endif
