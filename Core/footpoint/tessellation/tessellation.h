// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/common/execution.h"
#include "footpoint/model/model.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace footpoint
{

/// How densely a model is sampled.
enum class TessellationMode
{
  Adaptive, ///< as densely as the tolerances ask for, by bounds of the second derivatives
  Fixed     ///< a number of segments for each knot span, whatever the shape
};

struct TessellationOptions
{
  TessellationMode mode = TessellationMode::Adaptive;
  /// Adaptive: the largest distance between geometry and triangles or lines. A fraction of the size
  /// of the model (the diagonal of the box of its control points) unless `absolute`. The default is
  /// what a screen shows: a thousand pixels for the whole model.
  double chord_tolerance = 1e-3;
  bool absolute = false; ///< chord_tolerance is in model units
  /// Adaptive: the largest angle in radians between the normals of two corners of a triangle, of
  /// the tangents at two ends of a line; 0: any. Parts smaller than the chord tolerance are not
  /// divided for its sake. It is met at the corners, which proves nothing between them. Default: 30
  /// degrees.
  double angle_tolerance = 0.5235987755982988;
  int resolution = 4; ///< Fixed: segments for each knot span, 1 or more
};

/// A face, or a part of it, that is not in the result as it should be.
struct TessellationProblem
{
  std::size_t face;
  std::string message;
};

/// Triangles and lines near a model.
///
/// Points are not shared between faces, nor between the two sides of a kink or a seam, as they
/// differ in normal or parameters; but where edges meet (to kSewing of the model's size, or the
/// tolerance of a face where that is larger) their points have the same bits.
struct Tessellation
{
  Points points;  ///< in space
  Points normals; ///< unit, outward where the model says so; curves: 0
  Eigen::Matrix<double, 2, Eigen::Dynamic> parameters; ///< of the patch's own domain; curves: v = 0
  std::vector<std::array<std::int64_t, 3>> triangles;  ///< counter-clockwise against the normals
  std::vector<int> triangle_faces;
  std::vector<std::vector<std::int64_t>> lines; ///< a polyline for each curve
  std::vector<int> line_faces;
  std::vector<TessellationProblem> problems; ///< ascending faces; their triangles are left out
  double tolerance = 0.0;                    ///< that was used, model units
  bool cancelled = false;                    ///< nothing else is set then
};

/// Triangulates surfaces and trimmed faces, and turns curves into polylines.
///
/// Adaptive: the distance of every point of the surface from the triangles is at most the tolerance
/// (from the one over its parameters it may be more, where parameters run unevenly). Over a
/// triangle whose corners lie within a circle of radius R of the metric (d²S(a, a) ≤ |a|²) around
/// the parameters, a linear interpolant is off by R²/2 at most (S. Waldron 1998; for boxes D.
/// Filip, R. Magedson and R. Markot 1986); the second derivatives are bounded by control nets of
/// the Bézier pieces restricted to the triangle's box. Where that bound is too large, their
/// components along the normal are bounded, and what lies beside it counts by the slope of the
/// triangle: that is measured at its corners and enlarged by a factor, not bounded. Along edges the
/// trim curve's distance from its chord is added. Joining edges of neighbouring faces moves points
/// by no more than those edges are apart.
///
/// Edges are sampled by their curves and the faces that meet there, whichever way they run: closed
/// solids become watertight meshes. Results have the same bits for any number of threads.
/// \throw std::invalid_argument where an option is out of range
Tessellation tessellate(
  const Model& model, const TessellationOptions& options, const Execution& execution = {});

} // namespace footpoint
