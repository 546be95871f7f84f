// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/trims/arc_cell.h"

namespace footpoint
{

/// An arc and the part of the surface over the arc's own box in (u, v), both in Bézier form.
///
/// In this box the arc runs from corner to corner, u = u0 + (u1 − u0) a / (a + b). All numbers that
/// S(c(t)) is made of are sums of positive products then, a and b included, and nothing cancels
/// whatever the weights are.
struct ArcPatch
{
  using Homogeneous = Eigen::Matrix<double, 4, Eigen::Dynamic>;

  /// \param allowed what S(c(t)) may be changed by to make it simpler (model units)
  ArcPatch(const Surface& surface, const TrimArc& arc, const ArcCell& cell, double allowed);

  int arc_degree() const { return static_cast<int>(this->arc.cols()) - 1; }
  /// Of S(c(t)), numerator and denominator.
  int composed_degree() const;
  /// (w·x, w·y, w·z, w) at t in [0, 1]. \param along an arc in the same box
  Eigen::Vector4d at(const Homogeneous& along, double t) const;
  /// Control points of S(c(t)), relative to the surface's centre.
  Homogeneous compose() const;

  std::array<int, 2> degree; ///< 0 in a direction in which the arc does not run
  Homogeneous control;       ///< (w·x, w·y, w·z, w) over the box, u fastest
  Homogeneous arc;           ///< rows b, a of u, then b, a of v; b + a is the arc's weight
  bool rational;             ///< of S(c(t))
  bool affine;               ///< S is affine in (u, v) over the box
  double magnitude;          ///< the largest distance of a control point from the centre
  double change;             ///< bound of what S(c(t)) was changed by
};

/// Both halves of an arc (de Casteljau 1959).
std::array<ArcPatch::Homogeneous, 2> halve_arc(const ArcPatch::Homogeneous& arc);

} // namespace footpoint
