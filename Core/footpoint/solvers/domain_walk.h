// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/splines/parametric_geometry.h"

#include <vector>

namespace footpoint
{

/// Movement of a parameter over a domain that is cut into *smooth pieces* by kinks, gaps and seams.
///
/// A parameter that lies on such a line belongs to the piece on its `side`: at Side::Right it is
/// the lower border of its piece, at Side::Left the upper one. A closed direction continues at its
/// seam.
template <int N>
class DomainWalk
{
public:
  explicit DomainWalk(const ParametricGeometry<N>& geometry);

  /// A place: a parameter and the piece it belongs to.
  struct Place
  {
    Parameter<N> t;
    Sides<N> sides;
  };

  /// Brings any parameter into the domain: wraps where closed, else clamps.
  Place enter(Parameter<N> t) const;

  /// Whether t_i is a border of its piece, and on which end.
  bool at_lower_border(const Place& place, int i) const;
  bool at_upper_border(const Place& place, int i) const;

  /// Whether t_i lies on the boundary of the geometry: an open end or the side of a gap.
  bool on_boundary(const Place& place, int i) const;

  /// Whether t_i lies on a side that is one point in space.
  bool on_collapsed_side(const Place& place, int i) const;

  /// place + step, wrapped and clamped; the displacement really made is in `moved`.
  struct Move
  {
    Place place;
    Parameter<N> moved;
    bool crosses = false; ///< the way leads over a border of the piece
  };
  Move move(const Place& place, const Parameter<N>& step) const;

  /// The same, cut short at the first border of the piece on the way, and along those it starts
  /// from.
  Move move_to_border(const Place& place, const Parameter<N>& step) const;

  /// The same point as member of the pieces that meet there, `place` itself not included (at a gap
  /// the other side is another point).
  std::vector<Place> neighbours(const Place& place) const;

private:
  bool is_break(int i, double t) const;
  /// The border of the piece that is met first on the way up or down; `t_i` itself where it is one.
  double border_ahead(const Place& place, int i, bool up) const;
  Place place_at(const Parameter<N>& t, const Parameter<N>& came_along) const;

  const ParametricGeometry<N>& Geometry;
};

} // namespace footpoint
