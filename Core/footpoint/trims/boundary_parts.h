// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/trims/chain_arc.h"
#include "footpoint/trims/trim_plane.h"

#include <vector>

namespace footpoint
{

/// A part of a loop on which what is kept beside it does not change.
struct BoundaryPart
{
  ChainArc arc;
  /// The winding number to the left of it less that to the right: 1, more or less where other loops
  /// run along the same stretch.
  int jump = 1;
  bool overlapped = false; ///< another loop runs along the same stretch
  bool repeated = false;   ///< an earlier part runs along the same stretch the same way
  bool complete = true;    ///< false: it may meet arcs at places that are not known
};

/// Cuts the arcs of all loops where they cross or touch each other, and where stretches begin or
/// end that several of them share. What is cut ends in the same numbers as what it meets.
/// \param arcs monotone, shifted into the domain; those outside of it are not compared
std::vector<BoundaryPart> cut_at_contacts(std::vector<ChainArc> arcs, const TrimPlane& plane);

} // namespace footpoint
