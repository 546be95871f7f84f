// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/tessellation/derivative_bounds.h"
#include "footpoint/tessellation/surface_cells.h"
#include "footpoint/trims/arc_cell.h"
#include "footpoint/trims/trim_region.h"

#include <memory>
#include <vector>

namespace footpoint
{

/// A part of the boundary of a face as a run of arcs, each beginning where the one before it ends.
/// The parameter t counts arcs: k + f is the fraction f of arc k.
class TrimEdge
{
public:
  /// \param surface outlives this \param arcs at least one, inside the domain
  TrimEdge(const Surface& surface, std::vector<TrimArc> arcs);

  double length() const { return static_cast<double>(this->Arcs.size()); }
  /// Local parameters (u, v).
  Parameter<2> place(double t) const;
  Vector3 point(double t) const; ///< in space
  /// Unit normal of the surface; where two arcs meet, perhaps at a kink, beside the one on that
  /// side.
  Vector3 normal(double t, Side side) const;
  /// Whether it stands for a gap in a loop.
  bool closes_gap() const { return this->Arcs.front().closes_gap; }
  /// The parameter between two others at which the edge is nearest to a point, from the nearest of
  /// some samples by Gauss and Newton.
  double nearest(const Vector3& point, double from, double to) const;
  /// Lower and upper corner of a box in space around samples.
  const std::array<Vector3, 2>& box() const { return this->Box; }
  /// Whether all samples are within a distance of the first.
  bool collapsed(double tolerance) const;
  /// Where the edge crosses or leaves a C0 line of the surface: whole numbers strictly inside.
  std::vector<double> kinks() const;

  /// Bound of the distance between S(c(t)) and the chord from one parameter to another, and of that
  /// of the surface over the chord.
  double chord(const SurfaceBounds& bounds, double from, double to) const;

  /// Ascending parameters from one to another, both included, between which chords keep to a
  /// quarter of the rule's tolerance: triangles beside them, whose other sides turn as much, need
  /// the rest.
  std::vector<double> samples(
    const SurfaceBounds& bounds, const SamplingRule& rule, double from, double to) const;
  /// Whether one chord is enough.
  bool is_fine(const SurfaceBounds& bounds, const SamplingRule& rule, double from, double to) const;

private:
  std::size_t arc_at(double t) const;
  /// The control points (u, v) of the part of the edge between two parameters.
  std::vector<Parameter<2>> hull(double from, double to) const;
  void sample(const SurfaceBounds& bounds, const SamplingRule& rule, double from, double to,
    int depth, std::vector<double>& result) const;

  const Surface* Base;
  std::vector<TrimArc> Arcs;
  std::vector<ArcCell> Cells;
  std::vector<Vector3> Samples; ///< kSamples for each arc and the end
  std::array<Vector3, 2> Box;
};

/// The edges that bound what a face keeps of its surface, seams and poles included: one for each
/// run of arcs of a loop curve, and the parts of the domain's borders over which the region goes
/// on. \param region null: the four sides
std::vector<TrimEdge> boundary_edges(const Surface& surface, const TrimRegion* region);

} // namespace footpoint
