// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// What trim regions are judged against: dense polygons in long double, evaluated without Bézier
/// arcs, and the sum of the angles under which a point sees their sides.

#include "TrimShapes.h"

#include <array>
#include <vector>

namespace trims
{

using Real = long double;
using RealPoint = std::array<Real, 2>;

/// A point (u, v) of a curve in its own plane, by de Boor's algorithm (1972) in long double.
RealPoint de_boor(const Curve& curve, int span, Real t);

/// A loop as polygon: \param samples of each knot span (1 for straight ones).
std::vector<RealPoint> polygon_of(const TrimLoop& loop, int samples);

/// What a point sees of a polygon.
struct View
{
  int winding;
  Real distance; ///< from the nearest side, coordinates divided by `scale`
};

View view(
  const std::vector<RealPoint>& corners, Real u, Real v, const RealPoint& scale = { { 1, 1 } });

/// Signed area of a polygon.
Real area(const std::vector<RealPoint>& corners);

/// A point of an arc, in the surface's local parameters, by de Casteljau in long double.
RealPoint on_arc(const footpoint::TrimArc& arc, Real t);

} // namespace trims
