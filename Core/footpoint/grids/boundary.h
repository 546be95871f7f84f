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

/// Four sides that meet: bottom(0) = left(0), bottom(1) = right(0), top(0) = left(1), top(1) = right(1),
/// bit for bit after assembly.
struct Boundary
{
  std::array<Points, 4> sides; ///< by Role, each of at least two points
  std::array<SideReport, 4> reports;
  /// How far apart the two ends at each corner were given: C00, C10, C11, C01.
  std::array<double, 4> corner_gaps{};
  bool collapsed = false;     ///< one side is a point (three-sided input)
  bool self_crossing = false; ///< two sides meet where they should not (planar boundaries)
};

struct BoundaryOptions
{
  /// Gaps at corners up to this fraction of the size (diagonal of the boundary's bounding box) are
  /// closed silently, as rounding.
  double merge_tolerance = 1e-8;
  /// Larger ones up to this fraction are closed where force_corner_match is on, else refused.
  double corner_tolerance = 1e-3;
  bool force_corner_match = false; ///< snap both ends to the middle and report the gap
  /// Loops: a turn by more than this is a corner (degrees); the four sharpest are taken.
  double corner_angle = 30.0;
  /// Loops: the corners by their point index (four), bottom-left first, in the sense of the loop;
  /// empty: found by angle.
  std::vector<int> corner_ids;
  /// Take sides as given (bottom, right, top, left, directions as Role says) and refuse others.
  bool strict = false;
};

/// Assembles four sides (or three: the missing one is the point where the ends of the first and the
/// last given one meet) in any order and direction. The first polyline becomes the bottom in its own
/// direction; of the two patches that are possible then the one is taken whose sides turn
/// counter-clockwise seen from the side on which they do (right follows bottom's end).
/// \param roles by polyline, empty or −1 for "find out"; where all are given they override the guess
/// \throw BoundaryError
Boundary assemble_sides(
  const std::vector<Points>& polylines, const std::vector<int>& roles, const BoundaryOptions& options);

/// One closed loop → four sides, by corner ids or angles.
/// \param loop points in order; the first may be repeated at the end, and may lie inside a side
Boundary split_loop(const Points& loop, const BoundaryOptions& options);

/// Chains short segments (feature edges, in any order and direction) to closed loops and open chains.
/// \param segments pairs of point indices
/// \param points   positions; ends within merge_tolerance × size are one
/// \return loops (first point not repeated) and chains, longest first
struct Chains
{
  std::vector<Points> loops;
  std::vector<Points> open;
};
Chains chain_segments(const Points& points, const std::vector<std::array<int, 2>>& segments,
  const BoundaryOptions& options);

} // namespace footpoint
