// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <array>

namespace footpoint
{

/// What an arc of a loop is to the face. All arcs of loops that do not meet bound it, but not those
/// of loops that cross, nor those of a hole beside the face.
enum class ArcBounds
{
  Face,     ///< the face lies to its left and ends there
  Repeated, ///< the same, where an earlier arc runs along the same stretch and counts
  Inside,   ///< the face lies on both sides
  Outside,  ///< the face lies on neither side
  Undecided ///< it may be any of these: it counts as an edge, but no foot on it is proved
};

/// Whether an arc is an edge of the face.
inline bool is_edge(ArcBounds bounds)
{
  return bounds == ArcBounds::Face || bounds == ArcBounds::Undecided;
}

/// A part of a loop of a trimmed face: a polynomial or rational Bézier arc that is monotone
/// in u and in v and crosses no knot line of the surface and no border of its domain.
struct TrimArc
{
  /// (w·u, w·v, w), one control point a column, u and v being *local* parameters of the surface
  /// (measured from the start of its domain; on a closed surface shifted into it by whole periods).
  Eigen::Matrix<double, 3, Eigen::Dynamic> control;
  int loop;
  int curve; ///< of the loop; an arc that closes a gap has the number of the curve before the gap
  bool closes_gap;
  std::array<double, 2> range; ///< of the curve's local parameter, ascending
  std::array<bool, 2> vertex;  ///< whether it starts, ends at an end of the curve as given
  bool inside_domain;          ///< lies in the surface's domain, borders included
  ArcBounds bounds = ArcBounds::Face; ///< where it is inside the domain
};

} // namespace footpoint
