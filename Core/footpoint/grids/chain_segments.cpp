// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/grids/boundary.h"

#include "footpoint/grids/boundary_checks.h"
#include "footpoint/grids/point_merging.h"
#include "footpoint/splines/validation.h"

#include <algorithm>

namespace footpoint
{

namespace
{

/// So many points are named in a message.
constexpr std::size_t kNamed = 8;

std::string listed(const std::vector<int>& points)
{
  std::string text;
  for (std::size_t k = 0; k < std::min(kNamed, points.size()); ++k)
  {
    text += (k > 0 ? ", " : "") + std::to_string(points[k]);
  }
  return text + (points.size() > kNamed ? ", …" : "");
}

/// The segments as a graph of merged points.
class SegmentGraph
{
public:
  SegmentGraph(const Points& points, const std::vector<std::array<int, 2>>& segments,
    const std::vector<int>& merged)
    : Positions(points)
    , Neighbours(static_cast<std::size_t>(points.cols()))
    , Visited(static_cast<std::size_t>(points.cols()), false)
  {
    for (const auto& segment : segments)
    {
      const int a = merged[segment[0]];
      const int b = merged[segment[1]];
      auto& of_a = this->Neighbours[a];
      if (a != b && std::find(of_a.begin(), of_a.end(), b) == of_a.end())
      {
        of_a.push_back(b);
        this->Neighbours[b].push_back(a);
      }
    }
  }

  void check_branches() const
  {
    std::vector<int> forks;
    for (std::size_t point = 0; point < this->Neighbours.size(); ++point)
    {
      if (this->Neighbours[point].size() > 2)
      {
        forks.push_back(static_cast<int>(point));
      }
    }
    if (forks.empty())
    {
      return;
    }
    const std::vector<int>& others = this->Neighbours[forks.front()];
    const Vector3 at = this->Positions.col(forks.front());
    std::string text = std::to_string(others.size()) + " segments meet at point " +
      std::to_string(forks.front()) + " (" + short_text(at.x()) + ", " + short_text(at.y()) + ", " +
      short_text(at.z()) + "), from points " + listed(others);
    if (forks.size() > 1)
    {
      text += "; so they do at " + std::to_string(forks.size() - 1) +
        " more points: " + listed({ forks.begin() + 1, forks.end() });
    }
    throw BoundaryError(BoundaryDefect::Branch, text + "; a boundary does not fork");
  }

  /// All chains that begin at points with so many neighbours and were not walked before.
  std::vector<std::vector<int>> walk(std::size_t neighbours)
  {
    // In the order of coordinates, so that the order of the segments plays no part.
    std::vector<int> starts;
    for (std::size_t point = 0; point < this->Neighbours.size(); ++point)
    {
      if (this->Neighbours[point].size() == neighbours)
      {
        starts.push_back(static_cast<int>(point));
      }
    }
    std::sort(starts.begin(), starts.end(), [this](int a, int b) { return this->before(a, b); });
    std::vector<std::vector<int>> chains;
    for (const int start : starts)
    {
      if (!this->Visited[start])
      {
        chains.push_back(this->walk_from(start));
      }
    }
    return chains;
  }

private:
  bool before(int a, int b) const
  {
    return compare_points(this->Positions.col(a), this->Positions.col(b)) < 0;
  }

  std::vector<int> walk_from(int start)
  {
    std::vector<int> chain;
    int point = start;
    while (point >= 0)
    {
      chain.push_back(point);
      this->Visited[point] = true;
      int next = -1;
      for (const int neighbour : this->Neighbours[point])
      {
        if (!this->Visited[neighbour] && (next < 0 || this->before(neighbour, next)))
        {
          next = neighbour;
        }
      }
      point = next;
    }
    return chain;
  }

  const Points& Positions;
  std::vector<std::vector<int>> Neighbours;
  std::vector<bool> Visited;
};

struct Chain
{
  std::vector<int> ids;
  Points points;
  double length;
};

void deliver(const Points& points, std::vector<std::vector<int>> all, bool closed,
  std::vector<Points>& positions, std::vector<std::vector<int>>& ids)
{
  std::vector<Chain> chains;
  for (std::vector<int>& chain_ids : all)
  {
    Chain chain{ std::move(chain_ids), {}, 0.0 };
    chain.points = points(Eigen::all, chain.ids);
    const Eigen::Index count = chain.points.cols();
    for (Eigen::Index i = 0; i + (closed ? 0 : 1) < count; ++i)
    {
      chain.length += (chain.points.col((i + 1) % count) - chain.points.col(i)).norm();
    }
    chains.push_back(std::move(chain));
  }
  std::stable_sort(chains.begin(), chains.end(),
    [](const Chain& a, const Chain& b) { return a.length > b.length; });
  for (Chain& chain : chains)
  {
    positions.push_back(std::move(chain.points));
    ids.push_back(std::move(chain.ids));
  }
}

} // namespace

Chains chain_segments(const Points& points, const std::vector<std::array<int, 2>>& segments,
  const BoundaryOptions& options)
{
  check_polylines({ points }, 2, "segment set");
  for (std::size_t k = 0; k < segments.size(); ++k)
  {
    for (const int id : segments[k])
    {
      if (id < 0 || id >= points.cols())
      {
        throw BoundaryError(BoundaryDefect::Count,
          "segment " + std::to_string(k) + " names the point " + std::to_string(id) +
            "; there are " + std::to_string(points.cols()));
      }
    }
  }
  SegmentGraph graph(points, segments, merge_points(points, measure({ points }, options).merge));
  graph.check_branches();
  Chains chains;
  deliver(points, graph.walk(1), false, chains.open, chains.open_ids);
  deliver(points, graph.walk(2), true, chains.loops, chains.loop_ids);
  return chains;
}

} // namespace footpoint
