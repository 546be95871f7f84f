// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/grids/boundary_error.h"
#include "footpoint/splines/curve.h"
#include "footpoint/splines/surface.h"

namespace footpoint
{

/// The bilinearly blended Coons surface of four NURBS curves as a NURBS surface, exactly.
///
/// Facing curves are brought to one degree and one knot vector (over [0, 1]). Polynomial sides give
/// the degree of the sides (at least 1). Rational sides whose facing weights agree up to a factor,
/// w(u) and w(v), give the surface over the common denominator w(u)·w(v): the blend of three parts,
/// each multiplied out, has the degrees p + 1 and q + 1 (quadratic arcs: bidegree 3). Sides with
/// other weights are multiplied by each other's denominators first. (Blending the homogeneous
/// coordinates instead is exact on the boundary only.) \param curves bottom, right, top, left,
/// directed as Role says and meeting in the corners \throw BoundaryError (Gap) where they do not
/// meet to `corner_tolerance` of the size
Surface coons_surface(const std::array<Curve, 4>& curves, double corner_tolerance = 1e-8);

} // namespace footpoint
