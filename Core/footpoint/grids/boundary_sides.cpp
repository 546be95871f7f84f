// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/grids/boundary.h"

#include "footpoint/grids/boundary_crossing.h"
#include "footpoint/grids/polyline.h"
#include "footpoint/grids/side_roles.h"

#include <algorithm>

namespace footpoint
{

namespace
{

constexpr const char* kRoleNames[] = { "bottom", "right", "top", "left" };
constexpr const char* kCornerNames[] = { "C00", "C10", "C11", "C01" };

/// Places along a polyline at which it is compared with another.
constexpr int kComparedPoints = 33;

bool same_curve(const Points& a, const Points& b, double distance)
{
  const Eigen::VectorXd at = even_spacing(kComparedPoints);
  const Points first = sample_by_arc_length(a, at);
  const Points second = sample_by_arc_length(b, at);
  return (first - second).colwise().norm().maxCoeff() <= distance ||
    (first - second.rowwise().reverse()).colwise().norm().maxCoeff() <= distance;
}

/// A side given twice is an error, except as the seam of a tube, whose other two sides are closed.
void check_duplicates(const std::vector<Points>& polylines, const BoundaryScale& scale)
{
  const auto closed = [&](const Points& p)
  {
    return (p.col(0) - p.col(p.cols() - 1)).norm() <= scale.largest &&
      !without_length(p, scale.merge);
  };
  for (std::size_t i = 0; i < polylines.size(); ++i)
  {
    for (std::size_t j = i + 1; j < polylines.size(); ++j)
    {
      if (without_length(polylines[i], scale.merge) || without_length(polylines[j], scale.merge) ||
        !same_curve(polylines[i], polylines[j], scale.merge))
      {
        continue;
      }
      bool seam = polylines.size() == 4;
      for (std::size_t other = 0; other < polylines.size(); ++other)
      {
        seam =
          seam && (other == i || other == j ? !closed(polylines[other]) : closed(polylines[other]));
      }
      if (!seam)
      {
        throw BoundaryError(BoundaryDefect::Duplicate,
          "polyline " + std::to_string(i) + " and polyline " + std::to_string(j) +
            " are the same edge");
      }
    }
  }
}

std::string side_name(const RoleAssignment& assignment, int role)
{
  const std::string name = kRoleNames[role];
  return assignment.polyline[role] < 0
    ? name + " (collapsed)"
    : name + " (polyline " + std::to_string(assignment.polyline[role]) + ")";
}

void check_gaps(
  const RoleAssignment& assignment, const BoundaryScale& scale, const BoundaryOptions& options)
{
  const double closed = options.force_corner_match ? scale.largest : scale.merge;
  std::string message;
  double largest = 0.0;
  for (int corner = 0; corner < 4; ++corner)
  {
    if (assignment.gaps[corner] <= closed)
    {
      continue;
    }
    std::array<int, 2> role{ { kCorners[corner].role[0], kCorners[corner].role[1] } };
    bool named = false;
    for (int k = 0; k < 2; ++k)
    {
      if (assignment.polyline[role[k]] < 0)
      {
        named = kCorners[corner].end[k] == 1; // the first end of the collapsed side names the gap
        role[k] = (role[1 - k] + 2) % 4;
      }
    }
    if (named)
    {
      continue;
    }
    largest = std::max(largest, assignment.gaps[corner]);
    message += (message.empty() ? "" : "; ") + side_name(assignment, role[0]) + " and " +
      side_name(assignment, role[1]) + " are " + distance_text(assignment.gaps[corner], scale) +
      " apart at " + kCornerNames[corner];
  }
  if (message.empty())
  {
    return;
  }
  if (largest <= scale.largest)
  {
    message += "; ForceCornerMatch closes gaps up to " + short_text(options.corner_tolerance) +
      " of the size";
  }
  else
  {
    message += "; CornerTolerance allows " + short_text(options.corner_tolerance) + " of the size";
  }
  throw BoundaryError(BoundaryDefect::Gap, message);
}

/// Which sides are points; at most one may be.
std::array<bool, 4> check_lengths(const RoleAssignment& assignment,
  const std::vector<Points>& polylines, const BoundaryScale& scale)
{
  std::array<bool, 4> point{};
  std::vector<int> all;
  for (int role = 0; role < 4; ++role)
  {
    const int polyline = assignment.polyline[role];
    point[role] = polyline < 0 || without_length(polylines[polyline], scale.merge);
    if (point[role])
    {
      all.push_back(role);
    }
  }
  if (all.size() > 1)
  {
    std::string names;
    for (const int role : all)
    {
      names += (names.empty() ? "" : ", ") + side_name(assignment, role);
    }
    const bool opposite = all.size() == 2 && all[1] - all[0] == 2;
    throw BoundaryError(BoundaryDefect::Degenerate,
      names +
        (all.size() > 2 ? ": sides"
            : opposite  ? ": two opposite sides"
                        : ": two adjacent sides") +
        " without length; at most one may collapse to a point");
  }
  return point;
}

/// Closes the corners in the middle of their gaps and gives the sides their points.
Boundary close_corners(const RoleAssignment& assignment, const std::vector<Points>& polylines,
  const std::array<bool, 4>& point)
{
  std::array<Vector3, 4> corners;
  for (int k = 0; k < 4; ++k)
  {
    corners[k] = 0.5 * (assignment.ends[k][0] + assignment.ends[k][1]);
  }
  std::array<std::array<int, 2>, 4> corner_of_end; // [role][end]
  for (int k = 0; k < 4; ++k)
  {
    for (int side = 0; side < 2; ++side)
    {
      corner_of_end[kCorners[k].role[side]][kCorners[k].end[side]] = k;
    }
  }
  for (int role = 0; role < 4; ++role)
  {
    if (point[role])
    {
      const auto [first, last] = corner_of_end[role];
      corners[first] = 0.5 * (corners[first] + corners[last]);
      corners[last] = corners[first];
    }
  }

  Boundary boundary;
  boundary.corner_gaps = assignment.gaps;
  for (int role = 0; role < 4; ++role)
  {
    const int input = assignment.polyline[role];
    const Vector3& first = corners[corner_of_end[role][0]];
    Points& side = boundary.sides[role];
    boundary.reports[role] = { input, assignment.reversed[role] };
    boundary.collapsed = boundary.collapsed || point[role];
    if (point[role])
    {
      side = first.replicate(1, input < 0 ? 2 : polylines[input].cols());
      continue;
    }
    side =
      assignment.reversed[role] ? Points(polylines[input].rowwise().reverse()) : polylines[input];
    side.col(0) = first;
    side.col(side.cols() - 1) = corners[corner_of_end[role][1]];
  }
  return boundary;
}

Points around(const std::array<Points, 4>& sides)
{
  Eigen::Index count = 0;
  for (const Points& side : sides)
  {
    count += side.cols();
  }
  Points loop(3, count);
  loop << sides[kBottom], sides[kRight], sides[kTop].rowwise().reverse(),
    sides[kLeft].rowwise().reverse();
  return loop;
}

} // namespace

Boundary assemble_sides(const std::vector<Points>& polylines, const std::vector<int>& roles,
  const BoundaryOptions& options)
{
  if (polylines.size() != 3 && polylines.size() != 4)
  {
    throw BoundaryError(BoundaryDefect::Count,
      "there are " + std::to_string(polylines.size()) +
        " polylines; a patch has four sides, or three");
  }
  check_polylines(polylines, 2, "polyline");
  const BoundaryScale scale = measure(polylines, options);
  if (!(scale.size > 0.0))
  {
    throw BoundaryError(BoundaryDefect::Degenerate, "all points of the boundary are one");
  }
  check_duplicates(polylines, scale);
  const RoleAssignment assignment = assign_roles(polylines, roles, scale, options.strict);
  check_gaps(assignment, scale, options);
  const std::array<bool, 4> point = check_lengths(assignment, polylines, scale);
  Boundary boundary = close_corners(assignment, polylines, point);
  boundary.self_crossing = crosses_itself(around(boundary.sides));
  return boundary;
}

} // namespace footpoint
