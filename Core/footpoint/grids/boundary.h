// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/grids/boundary_error.h"

#include "footpoint/common/types.h"

#include <array>
#include <string>
#include <vector>

namespace footpoint
{

/// The sides of a four-sided patch, in the order of the array BoundaryRole.
enum Role
{
  kBottom = 0, ///< left → right
  kRight = 1,  ///< bottom → top
  kTop = 2,    ///< left → right
  kLeft = 3    ///< bottom → top
};

/// What became of one given polyline.
struct SideReport
{
  int input = -1;        ///< index of the polyline it came from, −1 for a collapsed side
  bool reversed = false; ///< its points were taken in the opposite order
};

/// Four sides that meet: bottom(0) = left(0), bottom(1) = right(0), top(0) = left(1), top(1) =
/// right(1), bit for bit after assembly.
struct Boundary
{
  std::array<Points, 4> sides; ///< by Role, each of at least two points
  std::array<SideReport, 4> reports;
  /// How far apart the two ends at each corner were given: C00, C10, C11, C01.
  std::array<double, 4> corner_gaps{};
  bool collapsed = false; ///< one side is a point (three-sided input)
  /// The boundary passes through itself (planar ones; the two banks of a cut do not). No smoothing
  /// unfolds such a grid.
  bool self_crossing = false;
  /// Loops: how many corners no angle marked, so that they were put at even arc lengths.
  int guessed_corners = 0;
};

struct BoundaryOptions
{
  /// Gaps at corners up to this fraction of the size (diagonal of the boundary's bounding box) are
  /// closed silently, as rounding; so are a few units in the last place of the largest coordinate.
  double merge_tolerance = 1e-8;
  /// Larger ones up to this fraction are closed where force_corner_match is on, else refused.
  double corner_tolerance = 1e-3;
  bool force_corner_match = false; ///< snap both ends to the middle and report the gap
  /// Loops: a turn by more than this is a corner (degrees); the four sharpest are taken.
  double corner_angle = 30.0;
  /// Loops: the corners by their point index (four): C00, C10, C11, C01, along the loop or against
  /// it; empty: found by angle.
  std::vector<int> corner_ids;
  /// Take sides as given (bottom, right, top, left or as their roles say, in the directions of
  /// Role) and refuse others.
  bool strict = false;
};

/// Assembles four sides, or three, given in any order and direction. Both make no difference, not
/// in a single bit: ends are paired so that the gaps are smallest, and the roles follow from where
/// the sides lie (side_roles.h has the rule): in the x-y plane the bottom runs towards +x, the left
/// side towards +y, right follows bottom counter-clockwise. Of three sides the top is collapsed, to
/// the point where left and right meet.
/// \param roles by polyline: a Role or −1 for "find out"; empty: all −1. Where all are given they
///              override the rule and only directions are found; the role missing of three
///              collapses
/// \throw BoundaryError (Count, NotFinite, Duplicate, Gap, Degenerate)
Boundary assemble_sides(const std::vector<Points>& polylines, const std::vector<int>& roles = {},
  const BoundaryOptions& options = {});

/// One closed loop → four sides, by corner ids or by angles. Which corner is the first is decided
/// as in assemble_sides; where the loop starts and in which sense it runs make no difference.
///
/// More than four corners: the sharpest, among equally sharp ones those farthest apart along the
/// loop. Three: a patch with a collapsed side. Fewer: the longest piece between corners is cut at
/// the point nearest to its middle until there are four (a circle: four quarters, beginning at its
/// lowest leftmost point), and `guessed_corners` says so.
/// \param loop points in order; the first may be repeated at the end, and may lie inside a side
/// \throw BoundaryError (Count, NotFinite, Corners, Duplicate, Degenerate)
Boundary split_loop(const Points& loop, const BoundaryOptions& options = {});

/// Closed loops and open chains of segments, longest first; each begins at its first point in the
/// order of coordinates x, y, z and goes on to the lesser of the two neighbours.
struct Chains
{
  std::vector<Points> loops; ///< first point not repeated
  std::vector<Points> open;
  /// Indices of the given points, of merged ones the first.
  std::vector<std::vector<int>> loop_ids;
  std::vector<std::vector<int>> open_ids;
};

/// Chains short segments (feature edges, in any order and direction). Segments without length and
/// repeated ones are left out.
/// \param points   positions; points within merge_tolerance × size are one
/// \param segments pairs of point indices
/// \throw BoundaryError (Count, NotFinite, Branch)
Chains chain_segments(const Points& points, const std::vector<std::array<int, 2>>& segments,
  const BoundaryOptions& options = {});

/// Whatever polylines bound a patch: four or three are its sides; one is a closed loop; all others
/// are chained, to one loop (then split) or to three or four sides.
/// \param points #n positions
/// \param lines  point indices of each polyline; corner_ids are indices of these points
/// \param roles  by polyline, as in assemble_sides
/// \throw BoundaryError
Boundary assemble_boundary(const Points& points, const std::vector<std::vector<int>>& lines,
  const std::vector<int>& roles = {}, const BoundaryOptions& options = {});

} // namespace footpoint
