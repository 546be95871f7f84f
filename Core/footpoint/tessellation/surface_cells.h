// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/tessellation/derivative_bounds.h"
#include "footpoint/trims/trim_region.h"

#include <algorithm>
#include <vector>

namespace footpoint
{

/// What triangles have to keep to.
struct SamplingRule
{
  bool adaptive = true;
  double tolerance = 0.0; ///< of chords, model units
  double angle = 0.0;     ///< of normals, radians; 0: any
  int resolution = 1;     ///< where not adaptive: segments for each knot span
};

/// How far triangles may be from the surface in height, as a part of the tolerance. Beside the
/// boundary of a face, where chords of edges use a quarter of the tolerance sideways, both together
/// are within it.
constexpr double kShareOfHeights = 0.96;

/// Bound of the distance of a surface from triangles that interpolate it, which are the graph of a
/// function over a plane with normal `up` and of some slope: a point that is off its interpolant by
/// `second` sideways and by `height` upward has a point of the triangles above or below it that
/// differs by the slope of the way sideways. \return in parts of the tolerance
inline double off_triangles(double second, double height, double slope, double tolerance)
{
  return std::min(second, (height + slope * second) / kShareOfHeights) / tolerance;
}

/// A rectangle of a surface's domain that is divided evenly.
struct SurfaceCells
{
  ParameterBox box;
  std::array<int, 2> count;

  /// Exactly the border at the ends.
  double line(int direction, int k) const
  {
    const double low = this->box.lower[direction];
    const double high = this->box.upper[direction];
    const int n = this->count[direction];
    return k == n ? high : k == 0 ? low : low + (high - low) * (static_cast<double>(k) / n);
  }
};

/// Divides the domain of a surface so that two triangles for each cell keep to the rule: at C0
/// lines, then, as long as one bound for all of a block asks for too much, at knot lines and in
/// halves. What a region leaves out is left out. The order is that of a walk in which neighbours
/// are near. \param region null: all is kept
std::vector<SurfaceCells> divide(
  const SurfaceBounds& bounds, const TrimRegion* region, const SamplingRule& rule);

/// The angle between two unit vectors; 0 where one of them is zero.
double angle_between(const Vector3& a, const Vector3& b);

} // namespace footpoint
