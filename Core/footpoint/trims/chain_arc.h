// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/trims/trim_arc.h"
#include "footpoint/trims/trim_plane.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace footpoint
{

/// An arc of a loop on its way to becoming TrimArcs. Its coordinates are not shifted by periods
/// yet.
struct ChainArc
{
  TrimArc arc;
  /// Start and end (u, v): the very same numbers as those of the neighbours in the chain, which
  /// (w·u)/w need not be.
  std::array<Eigen::Vector2d, 2> end;
};

/// The straight arc between two points.
ChainArc straight_arc(const Eigen::Vector2d& from, const Eigen::Vector2d& to);

/// Moves an end of an arc (0 start, 1 end) along coordinate i, with its control point.
void place_end(ChainArc& arc, int which, int i, double at);

/// Moves all of an arc to one value of coordinate i.
void make_constant(ChainArc& arc, int i, double at);

/// Moves an arc along coordinate i by a distance.
void shift(ChainArc& arc, int i, double by);

/// Whether coordinate i of the whole arc is the same up to a distance.
bool is_constant(const ChainArc& arc, int i, double rounding);

/// Cuts an arc at ascending fractions in (0, 1) of its range.
std::vector<ChainArc> cut(const ChainArc& arc, const std::vector<double>& fractions);

/// The fraction in (0, 1) of the range at which a monotone coordinate i has a value between those
/// of its ends.
double fraction_at(const ChainArc& arc, int i, double at);

/// Cuts an arc where du/dt or dv/dt changes its sign. Coordinates that turn by no more than the
/// plane's rounding are monotone. The new ends are snapped to borders and knot lines.
std::vector<ChainArc> cut_to_monotone(const ChainArc& arc, const TrimPlane& plane);

/// Cuts a monotone arc at the borders and knot lines that it crosses. The new ends lie on them
/// exactly.
std::vector<ChainArc> cut_at_lines(const ChainArc& arc, const TrimPlane& plane);

} // namespace footpoint
