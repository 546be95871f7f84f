// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/splines/surface.h"
#include "footpoint/trims/trim_arc.h"

namespace footpoint
{

/// The rectangle between knot lines of a surface on which an arc lies; what is evaluated on the arc
/// is the polynomial or rational piece of this rectangle.
struct ArcCell
{
  std::array<int, 2> span; ///< of the knot vectors, see KnotVector::find_span
  Parameter<2> lower;      ///< local parameters
  Parameter<2> upper;
};

/// \param arc monotone and between knot lines; an arc along a knot line counts as above it
ArcCell arc_cell(const Surface& surface, const TrimArc& arc);

/// The point of the cell nearest to a place that is outside by a rounding at most, and the sides
/// from which the cell's own piece of the surface is evaluated there.
struct CellPlace
{
  Parameter<2> t;
  Sides<2> sides;
};
CellPlace place_in(const ArcCell& cell, const Parameter<2>& t);

/// Moves the control points that are outside a cell onto its border: rounding, as arcs do not cross
/// knot lines.
void keep_inside(const ArcCell& cell, TrimArc& arc);

/// (u, v) of an arc and its derivatives. \param fraction of the arc, in [0, 1]; derivatives are by
/// it \param order highest derivative wanted, 0 … 3; columns above are 0
Eigen::Matrix<double, 2, 4> arc_jet(const TrimArc& arc, double fraction, int order);

} // namespace footpoint
