// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/splines/surface.h"
#include "footpoint/trims/trim_loop.h"

#include <array>
#include <vector>

namespace footpoint
{

/// A part of the boundary of a trimmed face: a polynomial or rational Bézier arc that is monotone in
/// u and in v and crosses no knot line of the surface and no border of its domain.
struct TrimArc
{
  /// (w·u, w·v, w), one control point a column, u and v being *local* parameters of the surface
  /// (measured from the start of its domain; on a closed surface shifted into it by whole periods).
  Eigen::Matrix<double, 3, Eigen::Dynamic> control;
  int loop;
  int curve; ///< of the loop; an arc that closes a gap has the number of the curve before the gap
  bool closes_gap;
  std::array<double, 2> range;  ///< of the curve's local parameter, ascending
  std::array<bool, 2> vertex;   ///< whether it starts, ends at an end of the curve as given
  bool inside_domain;           ///< lies in the surface's domain, borders included
};

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
  /// \param tolerance in model units: gaps in a loop up to this, and at least up to kLargestGap of the
  ///                  surface's size, are closed
  /// \throw GeometryError (Format) naming loop, curve and value where a gap is larger, a curve is not
  ///        planar, or the loops keep nothing
  TrimRegion(const std::vector<TrimLoop>& loops, const Surface& surface, double tolerance);

  /// Whether a point is kept. \param u, v local parameters inside the domain
  bool contains(double u, double v) const;

  /// How much of a box of local parameters is kept.
  Cover cover(const std::array<double, 2>& lower, const std::array<double, 2>& upper) const;

  /// The whole boundary, loop by loop in the order of the curves.
  const std::vector<TrimArc>& arcs() const { return this->Arcs; }

  /// The largest gap that was closed, in model units.
  double largest_gap() const { return this->LargestGap; }

private:
  std::vector<TrimArc> Arcs;
  double LargestGap = 0.0;
};

} // namespace footpoint
