// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Judges tessellations by what shares no code with them: distances to triangles at dense samples,
/// edges counted by coordinates, areas and volumes.

#include "ClosedSolids.h"

#include "footpoint/tessellation/tessellation.h"

#include <array>
#include <cstddef>
#include <limits>

namespace tessellations
{

using footpoint::Model;
using footpoint::Parameter;
using footpoint::Tessellation;
using footpoint::TessellationOptions;
using footpoint::Vector3;

/// A model of one untrimmed surface.
Model one(const footpoint::Surface& surface);

/// A model of one curve.
Model one(const footpoint::Curve& curve);

/// Distance of a point from a triangle (C. Ericson 2005, section 5.1.5).
double distance(const Vector3& p, const Vector3& a, const Vector3& b, const Vector3& c);

std::array<Vector3, 3> corners(const Tessellation& mesh, std::size_t triangle);

/// The largest distance of the surface from all triangles, at samples of what lies over each
/// triangle; stops at the first that is beyond the limit.
double largest_distance(
  const Model& model, const Tessellation& mesh, double limit, int samples = 5);

struct Counts
{
  int open = 0;       ///< edges that are not run through as often one way as the other
  int degenerate = 0; ///< triangles two of whose corners have the same coordinates
  double area = 0.0;
  double volume = 0.0; ///< of what is enclosed, if the mesh is closed
  /// Of the triangles in the plane of parameters, scaled to the unit square; model: one face.
  double parameter_area = 0.0;
  double least_parameter_area = std::numeric_limits<double>::infinity();
};

Counts count(const Model& model, const Tessellation& mesh);
TessellationOptions chord(double tolerance, double angle = 0.0);

} // namespace tessellations
