// SPDX-License-Identifier: BSD-3-Clause
// Private: edges on surfaces, for trim curves in (u, v) that do not lie on them.

#ifndef EdgeProjection_h
#define EdgeProjection_h

#include <Geom_Curve.hxx>
#include <Geom_Surface.hxx>
#include <gp_Pnt2d.hxx>

#include <optional>
#include <vector>

namespace footpoint::cad
{

/// An edge's curve in space and the surface it lies on, in the same coordinates.
///
/// Open CASCADE's translators compute curves in (u, v) where a file has none, and miss the edge by
/// far more than the tolerance that they claim (seen with 7.6: 5e-4 of a circle's radius).
struct EdgeOnSurface
{
  Handle(Geom_Curve) curve;
  Handle(Geom_Surface) surface;
  double first = 0.0; ///< range of the edge on its curve
  double last = 0.0;

  /// Where the edge is, at a fraction of its range.
  gp_Pnt at(double fraction) const;

  /// Parameters of the surface's point nearest to the edge at a fraction of its range, found by
  /// Newton's method from a start that is near; the start itself where that is no better.
  gp_Pnt2d foot(double fraction, const gp_Pnt2d& start) const;

  /// Parameters of a point's foot where the surface is a plane with straight parameters, as planes
  /// and parallelograms are; else none. It is an affine map, so control points go to control
  /// points.
  std::optional<gp_Pnt2d> flat_foot(const gp_Pnt& point) const;

  /// Fractions of the range at which the curve is not smooth.
  std::vector<double> kinks() const;
};

} // namespace footpoint::cad

#endif
