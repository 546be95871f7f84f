// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/splines/surface.h"
#include "footpoint/trims/chain_arc.h"
#include "footpoint/trims/trim_loop.h"
#include "footpoint/trims/trim_plane.h"

#include <array>
#include <vector>

namespace footpoint
{

/// A loop as arcs head to tail, without gaps; not shifted into the domain yet.
struct LoopChain
{
  std::vector<ChainArc> arcs; ///< monotone, cut at knot lines; no arc of length zero
  /// How many periods further the chain ends than it starts: not 0 where it runs around a closed
  /// surface.
  std::array<int, 2> turns;
  double largest_gap; ///< that was closed, in model units
};

/// \param number    of the loop, for messages
/// \param tolerance largest gap that is closed, in model units
/// \throw GeometryError (Format) naming loop, curve and value: a gap is larger, a curve is not
/// planar
LoopChain make_chain(const TrimLoop& loop, int number, const Surface& surface,
  const TrimPlane& plane, double tolerance);

} // namespace footpoint
