// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/splines/bezier.h"
#include "footpoint/trims/arc_cell.h"
#include "footpoint/trims/trim_region.h"

#include <memory>
#include <vector>

namespace footpoint
{

/// An edge of a trimmed face in space: S(c(t)), a surface after a trim curve. Its centre() is that
/// of the surface.
class EdgeCurve : public ParametricCurve
{
public:
  /// \param surface of the face; kept alive
  /// \param arcs    a run of arcs of one loop curve inside the domain, each beginning where the one
  ///                before it ends. The local parameter t of the edge runs over the ranges of the
  ///                arcs, from 0 (over a length of 1 where a range is empty, as that of a gap).
  /// \throw GeometryError (Format) without arcs, or where the edge is a single point
  EdgeCurve(std::shared_ptr<const Surface> surface, std::vector<TrimArc> arcs);

  Jet<1> jet(const Parameter<1>& t, const Sides<1>& sides, int order) const override;

  /// Where on the surface: local parameters (u, v) = c(t).
  Parameter<2> surface_parameter(double t, Side side = Side::Right) const;

  const Surface& surface() const { return *this->Base; }
  /// As given, but that control points which are outside by a rounding lie on the border.
  const std::vector<TrimArc>& arcs() const { return this->Arcs; }
  /// Whether it is an edge for certain: all of its arcs bound the face, or all may.
  bool decided() const { return this->Arcs.front().bounds == ArcBounds::Face; }
  /// Where each arc lies between the knot lines of the surface.
  const std::vector<ArcCell>& cells() const { return this->Cells; }

private:
  /// The arc that holds t; where two meet the one on the given side.
  std::size_t arc_at(double t, Side side) const;
  /// t as a fraction of an arc, in [0, 1].
  double fraction(double t, std::size_t arc) const;
  /// Points of the edge, so many of each arc and the end.
  Points sampled(int of_arc) const;
  /// Size from samples; breaks where arcs meet with a kink.
  void measure();

  std::shared_ptr<const Surface> Base;
  std::vector<TrimArc> Arcs;
  std::vector<ArcCell> Cells;
};

/// An edge as Bézier pieces in space, for searching.
struct EdgePieces
{
  /// Ascending; `lower` and `upper` are local parameters of the edge, positions relative to its
  /// centre().
  std::vector<BezierPiece<1>> pieces;
  /// Bound of |piece(t) − S(c(t))| over all pieces (model units). Rounding where pieces are exact
  /// (plane faces, edges along u or v), else that of interpolation.
  double error;
};

/// \param tolerance to which S(c(t)) is approximated where no exact piece of low degree exists
/// (model
///                  units); `error` may exceed it where rounding or work do not allow more
EdgePieces edge_pieces(const EdgeCurve& edge, double tolerance);

/// Which arcs of a region's boundary become edges.
enum class EdgeArcs
{
  /// All but those along a seam over which the region goes on.
  NoSeams,
  /// And none along a border of the domain that is open: there the surface itself ends.
  InsideDomain
};

/// The edges of a face: one for each run of arcs of one loop curve (or closed gap) in the domain.
/// Left out are arcs that are no edges of the face, arcs of no length in the parameters and edges
/// that are one point in space, as those along a pole: up to rounding with InsideDomain, up to
/// kClosureTolerance of the surface's size with NoSeams.
std::vector<std::shared_ptr<const EdgeCurve>> edge_curves(
  const std::shared_ptr<const Surface>& surface, const TrimRegion& region, EdgeArcs which);

} // namespace footpoint
