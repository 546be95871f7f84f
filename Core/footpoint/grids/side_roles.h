// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/grids/boundary_checks.h"

namespace footpoint
{

/// Which polyline plays which role, and in which direction.
struct RoleAssignment
{
  std::array<int, 4> polyline{ { -1, -1, -1, -1 } }; ///< by Role; −1: collapsed to a point
  std::array<bool, 4> reversed{};
  /// The two ends that meet at each corner C00, C10, C11, C01: first of bottom or top, then of left
  /// or right. At a collapsed side the ends of its two neighbours.
  std::array<std::array<Vector3, 2>, 4> ends;
  std::array<double, 4> gaps{}; ///< their distances
};

/// The roles at a corner, C00, C10, C11, C01, and which end (0 first, 1 last) of them meets there.
struct CornerEnds
{
  std::array<Role, 2> role;
  std::array<int, 2> end;
};
constexpr std::array<CornerEnds, 4> kCorners{ { { { { kBottom, kLeft } }, { { 0, 0 } } },
  { { { kBottom, kRight } }, { { 1, 0 } } }, { { { kTop, kRight } }, { { 1, 1 } } },
  { { { kTop, kLeft } }, { { 0, 1 } } } } };

/// Finds the roles of three or four polylines by their geometry alone, so that order and direction
/// make no difference, not in a single bit:
/// 1. The ends must meet as well as they can: least sum of squared corner gaps.
/// 2. Right follows the end of the bottom counter-clockwise, for an observer who looks along −z at
///    a boundary that lies flat (right is +x and up is +y for him), along +y at one that stands
///    facing y (right +x, up +z), along −x at one that stands facing x (right +y, up +z); which one
///    it is, the largest component of its area vector says.
/// 3. To the same observer u runs as much to the right and v as much upwards as can be; among
///    equals C00 is the leftmost corner, then the lowest.
/// Of three polylines the top is the collapsed side where roles do not say otherwise.
/// \param roles by polyline: a Role, or −1 for "find out"; empty: all −1
/// \throw BoundaryError (Count) where roles are no roles or given twice
RoleAssignment assign_roles(const std::vector<Points>& polylines, const std::vector<int>& roles,
  const BoundaryScale& scale, bool strict);

} // namespace footpoint
