// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <array>

namespace footpoint
{

/// A part of the boundary of a trimmed face: a polynomial or rational Bézier arc that is monotone
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
};

} // namespace footpoint
