// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/splines/surface.h"
#include "footpoint/trims/chain_arc.h"
#include "footpoint/trims/kept_cells.h"
#include "footpoint/trims/trim_arc.h"
#include "footpoint/trims/trim_loop.h"
#include "footpoint/trims/trim_plane.h"
#include "footpoint/trims/winding_index.h"

#include <array>
#include <vector>

namespace footpoint
{

/// Gaps in a loop that are closed whatever the tolerance, as a fraction of the surface's size: real
/// files close their loops to 2e-3 of the face at worst, and a wrong curve leaves far more.
constexpr double kLargestGap = 2e-2;

/// The part of a surface that its trim loops keep.
///
/// The test whether a point is kept is exact up to the rounding of the point: loops are curves, not
/// polygons, and gaps between curves are closed by straight lines in (u, v), which belong to the
/// boundary like the curves themselves. Built once; const and thread-safe.
class TrimRegion
{
public:
  enum class Cover
  {
    Inside,  ///< all of it is kept
    Outside, ///< nothing of it is kept
    Crossed  ///< an arc passes through it or too near to tell
  };

  /// \param loops     at least one, each with at least one curve
  /// \param surface   on which they lie
  /// \param tolerance in model units: gaps in a loop up to this, and at least up to kLargestGap of
  /// the
  ///                  surface's size, are closed
  /// \throw GeometryError (Format) naming loop, curve and value where a gap is larger, a curve is
  /// not
  ///        planar, or the loops keep nothing
  TrimRegion(const std::vector<TrimLoop>& loops, const Surface& surface, double tolerance);

  /// Whether a point is kept. \param u, v local parameters inside the domain
  bool contains(double u, double v) const
  {
    const double a = this->clamped(0, this->Swapped ? v : u);
    const double b = this->clamped(1, this->Swapped ? u : v);
    const KeptCells::State state = this->Cells.at(a, b);
    return state == KeptCells::State::Crossed
      ? (this->Passed.empty() ? this->Index.winding(a, b) > 0 : this->keeps_near_passed(a, b))
      : state == KeptCells::State::Inside;
  }

  /// How much of a box of local parameters is kept.
  Cover cover(const std::array<double, 2>& lower, const std::array<double, 2>& upper) const;

  /// All loops, one after the other in the order of their curves, cut where they meet. What ends at
  /// an arc says its `bounds`.
  const std::vector<TrimArc>& arcs() const { return this->Arcs; }

  /// The largest gap that was closed, in model units.
  double largest_gap() const { return this->LargestGap; }

private:
  /// Into the index's domain, NaN to its start.
  double clamped(int i, double at) const
  {
    const double length = this->Index.length()[i];
    return at > 0.0 ? (at < length ? at : length) : 0.0;
  }
  /// Arcs that share a stretch, with the same kept on both sides: what is on them is, too, whatever
  /// the rounding of the winding number says.
  struct PassedStretch
  {
    ChainArc arc;
    bool kept;
  };

  bool keeps_near_passed(double a, double b) const;
  void add_arcs(std::vector<ChainArc> arcs);
  bool keeps_something() const;

  TrimPlane Plane;
  std::vector<TrimArc> Arcs;
  std::vector<PassedStretch> Passed;
  bool Swapped = false; ///< the index takes (v, u): its rays run along u
  WindingIndex Index;
  KeptCells Cells;
  double LargestGap = 0.0;
};

} // namespace footpoint
