// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/grids/side_roles.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

namespace footpoint
{

namespace
{

/// Two scores that differ by less than this fraction of the size are equal; symmetric boundaries
/// (a square on its corner) must not be decided by rounding.
constexpr double kEqualScores = 1e-9;
/// The area vector of a boundary that has none is rounding of this fraction of the size squared.
constexpr double kNoArea = 1e-10;
/// Components of the area vector within this factor are equally large.
constexpr double kEqualComponents = 1.0 - 1e-6;

/// One of the given polylines, seen in the direction that does not depend on how it was given.
struct Candidate
{
  int input;
  bool flipped; ///< against the given direction
  Vector3 first, last;
  Vector3 area; ///< ½ Σ p × q over its segments, about the centre of the boundary
};

/// Compares polylines column by column, both read in a given direction.
int compare(const Points& a, bool reverse_a, const Points& b, bool reverse_b)
{
  const Eigen::Index count = std::min(a.cols(), b.cols());
  for (Eigen::Index i = 0; i < count; ++i)
  {
    const int order = compare_points(
      a.col(reverse_a ? a.cols() - 1 - i : i), b.col(reverse_b ? b.cols() - 1 - i : i));
    if (order != 0)
    {
      return order;
    }
  }
  return a.cols() == b.cols() ? 0 : (a.cols() < b.cols() ? -1 : 1);
}

std::vector<Candidate> canonical_candidates(
  const std::vector<Points>& polylines, const Vector3& centre, bool keep_as_given)
{
  std::vector<Candidate> candidates;
  for (std::size_t index = 0; index < polylines.size(); ++index)
  {
    const Points& p = polylines[index];
    const bool flip = !keep_as_given && compare(p, true, p, false) < 0;
    const auto at = [&](Eigen::Index i) -> Vector3 { return p.col(flip ? p.cols() - 1 - i : i); };
    Candidate candidate{ static_cast<int>(index), flip, at(0), at(p.cols() - 1), Vector3::Zero() };
    for (Eigen::Index i = 0; i + 1 < p.cols(); ++i)
    {
      candidate.area += 0.5 * (at(i) - centre).cross(at(i + 1) - centre);
    }
    candidates.push_back(candidate);
  }
  if (!keep_as_given)
  {
    std::stable_sort(candidates.begin(), candidates.end(),
      [&](const Candidate& a, const Candidate& b)
      { return compare(polylines[a.input], a.flipped, polylines[b.input], b.flipped) < 0; });
  }
  return candidates;
}

std::vector<int> checked_roles(const std::vector<int>& roles, std::size_t count)
{
  if (roles.empty())
  {
    return std::vector<int>(count, -1);
  }
  if (roles.size() != count)
  {
    throw BoundaryError(BoundaryDefect::Count,
      "BoundaryRole holds " + std::to_string(roles.size()) + " values; there are " +
        std::to_string(count) + " polylines");
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::string entry =
      "BoundaryRole[" + std::to_string(i) + "] = " + std::to_string(roles[i]);
    if (roles[i] < -1 || roles[i] > 3)
    {
      throw BoundaryError(
        BoundaryDefect::Count, entry + " is no role; 0 bottom, 1 right, 2 top, 3 left, -1 any");
    }
    const auto twice = std::find(roles.begin(), roles.begin() + i, roles[i]);
    if (roles[i] >= 0 && twice != roles.begin() + i)
    {
      throw BoundaryError(BoundaryDefect::Count,
        entry + " was given to polyline " + std::to_string(twice - roles.begin()) + " already");
    }
  }
  return roles;
}

/// Fills ends and gaps of an assignment whose roles and directions stand (`reversed` still against
/// the candidates).
void find_gaps(RoleAssignment& assignment, const std::vector<Candidate>& candidates)
{
  std::array<int, 4> collapsed_ends{ { -1, -1, -1, -1 } };
  for (int corner = 0; corner < 4; ++corner)
  {
    for (int k = 0; k < 2; ++k)
    {
      const Role role = kCorners[corner].role[k];
      if (assignment.polyline[role] < 0)
      {
        collapsed_ends[corner] = k;
        continue;
      }
      const Candidate& candidate = candidates[assignment.polyline[role]];
      const bool last = (kCorners[corner].end[k] == 1) != assignment.reversed[role];
      assignment.ends[corner][k] = last ? candidate.last : candidate.first;
    }
  }
  // === The ends of a collapsed side are the far ends of its neighbours
  for (int corner = 0; corner < 4; ++corner)
  {
    const int k = collapsed_ends[corner];
    for (int other = 0; k >= 0 && other < 4; ++other)
    {
      if (other != corner && collapsed_ends[other] == k)
      {
        assignment.ends[corner][k] = assignment.ends[other][1 - k];
      }
    }
  }
  for (int corner = 0; corner < 4; ++corner)
  {
    assignment.gaps[corner] = (assignment.ends[corner][0] - assignment.ends[corner][1]).norm();
  }
}

/// All assignments that the given roles allow.
std::vector<RoleAssignment> all_assignments(
  const std::vector<Candidate>& candidates, const std::vector<int>& roles, bool strict)
{
  const int count = static_cast<int>(candidates.size());
  // A collapsed side is tried as top first; the others only where roles leave no top to collapse.
  std::vector<int> collapsed{ -1 };
  if (count == 3)
  {
    collapsed = { kTop, kLeft, kRight, kBottom };
  }
  std::vector<RoleAssignment> assignments;
  for (const int point : collapsed)
  {
    std::array<int, 4> order{ { 0, 1, 2,
      3 } }; // role of each candidate; of the last of three: none
    do
    {
      bool allowed = count == 4 || order[3] == point;
      for (int k = 0; k < count; ++k)
      {
        const int role = roles[candidates[k].input];
        allowed = allowed && (role < 0 || role == order[k]);
      }
      for (int directions = 0; allowed && directions < (strict ? 1 : 1 << count); ++directions)
      {
        RoleAssignment assignment;
        for (int k = 0; k < count; ++k)
        {
          assignment.polyline[order[k]] = k;
          assignment.reversed[order[k]] = ((directions >> k) & 1) != 0;
        }
        find_gaps(assignment, candidates);
        assignments.push_back(assignment);
      }
    } while (std::next_permutation(order.begin(), order.end()));
    if (!assignments.empty())
    {
      break;
    }
  }
  return assignments;
}

Vector3 area_vector(const RoleAssignment& assignment, const std::vector<Candidate>& candidates)
{
  Vector3 area = Vector3::Zero();
  for (int role = 0; role < 4; ++role)
  {
    if (assignment.polyline[role] >= 0)
    {
      const bool along_loop = role == kBottom || role == kRight;
      const double sign = along_loop != assignment.reversed[role] ? 1.0 : -1.0;
      area += sign * candidates[assignment.polyline[role]].area;
    }
  }
  return area;
}

/// How an observer holds the boundary; his line of sight is −right × up.
struct View
{
  Vector3 right, up;
};

View view_of(const Vector3& area)
{
  const Vector3 size = area.cwiseAbs();
  const double large = kEqualComponents * size.maxCoeff();
  if (size.z() >= large)
  {
    return { Vector3::UnitX(), Vector3::UnitY() };
  }
  return { size.y() >= large ? Vector3::UnitX() : Vector3::UnitY(), Vector3::UnitZ() };
}

/// Keeps the assignments whose score is the best, up to `slack`.
void keep_best(std::vector<RoleAssignment>& assignments, double slack,
  const std::function<double(const RoleAssignment&)>& score)
{
  double best = -std::numeric_limits<double>::infinity();
  for (const RoleAssignment& assignment : assignments)
  {
    best = std::max(best, score(assignment));
  }
  assignments.erase(
    std::remove_if(assignments.begin(), assignments.end(),
      [&](const RoleAssignment& assignment) { return score(assignment) < best - slack; }),
    assignments.end());
}

double squared_gaps(const RoleAssignment& assignment, double size)
{
  std::array<double, 4> gaps = assignment.gaps;
  std::sort(gaps.begin(), gaps.end()); // one sum for all ways to name the same corners
  return std::accumulate(gaps.begin(), gaps.end(), 0.0,
    [size](double sum, double gap) { return sum + (gap / size) * (gap / size); });
}

} // namespace

RoleAssignment assign_roles(const std::vector<Points>& polylines,
  const std::vector<int>& given_roles, const BoundaryScale& scale, bool strict)
{
  std::vector<int> roles = checked_roles(given_roles, polylines.size());
  if (strict && polylines.size() == 4 &&
    std::all_of(roles.begin(), roles.end(), [](int role) { return role < 0; }))
  {
    roles = { kBottom, kRight, kTop, kLeft };
  }
  if (strict && std::any_of(roles.begin(), roles.end(), [](int role) { return role < 0; }))
  {
    throw BoundaryError(BoundaryDefect::Count,
      std::to_string(polylines.size()) +
        " polylines without a role each; a strict boundary has four, or a BoundaryRole for each");
  }
  const std::vector<Candidate> candidates = canonical_candidates(polylines, scale.centre, strict);
  std::vector<RoleAssignment> assignments = all_assignments(candidates, roles, strict);

  keep_best(
    assignments, 0.0, [&](const RoleAssignment& a) { return -squared_gaps(a, scale.size); });

  const Vector3 area = area_vector(assignments.front(), candidates);
  const View view = view_of(area);
  if (area.norm() > kNoArea * scale.size * scale.size)
  {
    const Vector3 towards = view.right.cross(view.up);
    keep_best(assignments, 0.0,
      [&](const RoleAssignment& a)
      { return area_vector(a, candidates).dot(towards) > 0.0 ? 1.0 : 0.0; });
  }
  const double slack = kEqualScores * scale.size;
  const auto corner = [&](const RoleAssignment& a, int k) -> Vector3
  { return 0.5 * (a.ends[k][0] + a.ends[k][1]) - scale.centre; };
  keep_best(assignments, slack,
    [&](const RoleAssignment& a)
    {
      const Vector3 along_u = corner(a, 1) + corner(a, 2) - corner(a, 0) - corner(a, 3);
      const Vector3 along_v = corner(a, 3) + corner(a, 2) - corner(a, 0) - corner(a, 1);
      return along_u.dot(view.right) + along_v.dot(view.up);
    });
  keep_best(
    assignments, slack, [&](const RoleAssignment& a) { return -corner(a, 0).dot(view.right); });
  keep_best(
    assignments, slack, [&](const RoleAssignment& a) { return -corner(a, 0).dot(view.up); });
  keep_best(
    assignments, slack, [&](const RoleAssignment& a) { return corner(a, 1).dot(view.right); });

  // === Name the polylines as they were given
  RoleAssignment found = assignments.front();
  for (int role = 0; role < 4; ++role)
  {
    if (found.polyline[role] >= 0)
    {
      const Candidate& candidate = candidates[found.polyline[role]];
      found.polyline[role] = candidate.input;
      found.reversed[role] = found.reversed[role] != candidate.flipped;
    }
  }
  return found;
}

} // namespace footpoint
