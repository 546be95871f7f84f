// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/trims/chain_arc.h"
#include "footpoint/trims/trim_plane.h"

#include <array>
#include <vector>

namespace footpoint
{

/// Points of the plane that are no farther apart than this fraction of its rounding(), in either
/// coordinate, are one where arcs cross: what evaluation on an arc and the winding number leave.
constexpr double kContact = 0.5;

/// kContact in u and in v.
inline Eigen::Vector2d contact_unit(const TrimPlane& plane)
{
  return { kContact * plane.rounding(0), kContact * plane.rounding(1) };
}

/// A place where two arcs cross or touch: they are one point there, up to kContact.
struct ArcTouch
{
  std::array<double, 2> at; ///< fraction of each arc
};

/// A stretch along which two arcs are the same, up to kContact.
struct ArcOverlap
{
  /// Fractions of each arc, ascending; of the second they run backwards where !same_way.
  std::array<std::array<double, 2>, 2> range;
  bool same_way;
};

/// Where two arcs meet.
struct ArcContacts
{
  std::vector<ArcTouch> touches; ///< the one where two arcs of a chain join among them
  std::vector<ArcOverlap> overlaps; ///< at most one: what lies beyond it is the same curve, too
  /// Whether the list holds everything. It does not where arcs run side by side, nearer to each
  /// other than their parts are straight, for so long that the work allowed is used up.
  bool complete = true;
};

/// Where two arcs meet, by halving both until their control polygons are apart or both are straight
/// up to rounding (fat lines: T. W. Sederberg and T. Nishita 1990). That arcs which have two points
/// in common overlap between them is known by more common points than curves of their degrees can
/// have (É. Bézout 1779).
/// \pre both arcs are monotone in u and in v
/// \param steps pairs of parts that may be compared; what was needed is taken off
ArcContacts arc_contacts(
  const ChainArc& a, const ChainArc& b, const TrimPlane& plane, int& steps);

} // namespace footpoint
