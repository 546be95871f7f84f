// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/grids/boundary.h"

#include "footpoint/grids/boundary_checks.h"

#include <algorithm>

namespace footpoint
{

namespace
{

void check_ids(const Points& points, const std::vector<std::vector<int>>& lines)
{
  for (std::size_t k = 0; k < lines.size(); ++k)
  {
    for (const int id : lines[k])
    {
      if (id < 0 || id >= points.cols())
      {
        throw BoundaryError(BoundaryDefect::Count,
          "polyline " + std::to_string(k) + " names the point " + std::to_string(id) +
            "; there are " + std::to_string(points.cols()));
      }
    }
  }
}

/// Splits a loop of point ids; corner ids are looked up in it.
Boundary split_ids(
  const Points& points, const std::vector<int>& loop, const BoundaryOptions& options)
{
  BoundaryOptions in_loop = options;
  for (int& corner : in_loop.corner_ids)
  {
    const auto found = std::find(loop.begin(), loop.end(), corner);
    if (found == loop.end())
    {
      throw BoundaryError(BoundaryDefect::Corners,
        "the corner id " + std::to_string(corner) + " is no point of the loop");
    }
    corner = static_cast<int>(found - loop.begin());
  }
  return split_loop(points(Eigen::all, loop), in_loop);
}

/// So many chains are named in a message.
constexpr std::size_t kNamed = 6;

/// How many points each chain has and where it is.
std::string chains_text(const std::vector<std::vector<int>>& chains, bool closed)
{
  std::string text;
  for (std::size_t k = 0; k < std::min(kNamed, chains.size()); ++k)
  {
    const std::vector<int>& ids = chains[k];
    text += (k > 0 ? "; " : "") + std::to_string(ids.size()) + " points " +
      (closed ? "through point " + std::to_string(ids.front())
              : "from point " + std::to_string(ids.front()) + " to " + std::to_string(ids.back()));
  }
  return text + (chains.size() > kNamed ? "; …" : "");
}

/// One loop, or three or four open chains, of many short polylines.
Boundary assemble_chains(
  const Points& points, const std::vector<std::vector<int>>& lines, const BoundaryOptions& options)
{
  std::vector<std::array<int, 2>> segments;
  for (const std::vector<int>& line : lines)
  {
    for (std::size_t k = 0; k + 1 < line.size(); ++k)
    {
      segments.push_back({ { line[k], line[k + 1] } });
    }
  }
  const Chains chains = chain_segments(points, segments, options);
  if (chains.loops.size() == 1 && chains.open.empty())
  {
    return split_ids(points, chains.loop_ids.front(), options);
  }
  if (chains.loops.empty() && (chains.open.size() == 3 || chains.open.size() == 4))
  {
    return assemble_sides(chains.open, {}, options);
  }
  if (chains.loops.size() > 1)
  {
    throw BoundaryError(BoundaryDefect::Loops,
      "the segments form " + std::to_string(chains.loops.size()) + " closed loops (" +
        chains_text(chains.loop_ids, true) + ")" +
        (chains.open.empty() ? ""
                             : " and " + std::to_string(chains.open.size()) + " open chains (" +
              chains_text(chains.open_ids, false) + ")") +
        " where one loop is expected");
  }
  const BoundaryScale scale = measure({ points }, options);
  if (chains.loops.empty() && chains.open.size() == 1)
  {
    const Points& chain = chains.open.front();
    const double gap = (chain.col(0) - chain.col(chain.cols() - 1)).norm();
    if (options.force_corner_match && gap <= scale.largest)
    {
      return split_ids(points, chains.open_ids.front(), options);
    }
    throw BoundaryError(BoundaryDefect::Gap,
      "the segments form one open chain; its ends, points " +
        std::to_string(chains.open_ids.front().front()) + " and " +
        std::to_string(chains.open_ids.front().back()) + ", are " + distance_text(gap, scale) +
        " apart");
  }
  throw BoundaryError(BoundaryDefect::Count,
    "the segments form " + std::to_string(chains.loops.size()) + " closed loops" +
      (chains.loops.empty() ? "" : " (" + chains_text(chains.loop_ids, true) + ")") + " and " +
      std::to_string(chains.open.size()) + " open chains" +
      (chains.open.empty() ? "" : " (" + chains_text(chains.open_ids, false) + ")") +
      "; a patch needs one loop or three or four chains");
}

} // namespace

Boundary assemble_boundary(const Points& points, const std::vector<std::vector<int>>& lines,
  const std::vector<int>& roles, const BoundaryOptions& options)
{
  check_ids(points, lines);
  if (lines.size() == 1)
  {
    std::vector<int> loop = lines.front();
    if (loop.size() > 1 && loop.front() == loop.back())
    {
      loop.pop_back();
    }
    return split_ids(points, loop, options);
  }
  if (lines.size() == 3 || lines.size() == 4)
  {
    std::vector<Points> polylines;
    for (const std::vector<int>& line : lines)
    {
      polylines.emplace_back(points(Eigen::all, line));
    }
    return assemble_sides(polylines, roles, options);
  }
  if (lines.empty())
  {
    throw BoundaryError(BoundaryDefect::Count, "there are no polylines");
  }
  return assemble_chains(points, lines, options);
}

} // namespace footpoint
