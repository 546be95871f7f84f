// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/tessellation/edge_joining.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace footpoint
{
namespace
{

/// Smallest representatives of joined sets.
class Sets
{
public:
  explicit Sets(std::size_t count)
    : Parent(count)
  {
    std::iota(this->Parent.begin(), this->Parent.end(), std::size_t{ 0 });
  }
  std::size_t find(std::size_t i)
  {
    while (this->Parent[i] != i)
    {
      this->Parent[i] = this->Parent[this->Parent[i]];
      i = this->Parent[i];
    }
    return i;
  }
  void join(std::size_t a, std::size_t b)
  {
    a = this->find(a);
    b = this->find(b);
    this->Parent[std::max(a, b)] = std::min(a, b);
  }

private:
  std::vector<std::size_t> Parent;
};

bool is_near(const std::array<Vector3, 2>& box, const Vector3& point, double reach)
{
  return ((point - box[0]).array() >= -reach).all() && ((point - box[1]).array() <= reach).all();
}

} // namespace

EdgeJoining::EdgeJoining(const std::vector<PatchEdge>& edges, double sewing, double gap)
  : Edges(edges)
  , Sewing(sewing)
  , Gap(gap)
  , Cuts(edges.size())
{
  this->cut_at_ends();
  this->cut_where_others_end();
  this->make_pieces();
  this->group_pieces();
  this->Nodes = this->Vertices;
}

double EdgeJoining::tolerance(std::size_t a, std::size_t b) const
{
  return std::max({ this->Sewing, this->Edges[a].tolerance, this->Edges[b].tolerance });
}

void EdgeJoining::cut_at_ends()
{
  struct End
  {
    std::size_t edge;
    double t;
    Vector3 point;
  };
  std::vector<End> ends;
  double reach = this->Sewing;
  for (std::size_t k = 0; k < this->Edges.size(); ++k)
  {
    const TrimEdge& edge = this->Edges[k].edge;
    std::vector<double> at = edge.kinks();
    at.insert(at.begin(), 0.0);
    at.push_back(edge.length());
    for (const double t : at)
    {
      ends.push_back({ k, t, edge.point(t) });
    }
    reach = std::max(reach, this->Edges[k].tolerance);
  }
  std::vector<std::size_t> order(ends.size());
  std::iota(order.begin(), order.end(), std::size_t{ 0 });
  std::sort(order.begin(), order.end(),
    [&](std::size_t a, std::size_t b)
    {
      const double xa = ends[a].point.x();
      const double xb = ends[b].point.x();
      return xa < xb || (xa == xb && a < b);
    });
  Sets sets(ends.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    const End& a = ends[order[i]];
    for (std::size_t j = i + 1; j < order.size() && ends[order[j]].point.x() - a.point.x() <= reach;
         ++j)
    {
      const End& b = ends[order[j]];
      if ((a.point - b.point).norm() <= this->tolerance(a.edge, b.edge))
      {
        sets.join(order[i], order[j]);
      }
    }
  }
  for (std::size_t i = 0; i + 1 < ends.size(); ++i)
  {
    const TrimEdge& edge = this->Edges[ends[i].edge].edge;
    if (ends[i].edge == ends[i + 1].edge && edge.closes_gap() && edge.collapsed(this->Gap))
    {
      sets.join(i, i + 1);
    }
  }
  std::vector<int> node(ends.size(), -1);
  for (std::size_t i = 0; i < ends.size(); ++i)
  {
    const std::size_t first = sets.find(i);
    if (first == i)
    {
      node[i] = static_cast<int>(this->Vertices.size());
      this->Vertices.push_back(ends[i].point);
    }
    this->Cuts[ends[i].edge].push_back({ ends[i].t, node[first] });
    node[i] = node[first];
  }
}

void EdgeJoining::cut_where_others_end()
{
  // The nodes by ascending x, each with the largest tolerance of an edge that ends there.
  std::vector<double> reach(this->Vertices.size(), this->Sewing);
  for (std::size_t k = 0; k < this->Edges.size(); ++k)
  {
    for (const Cut& cut : this->Cuts[k])
    {
      reach[cut.node] = std::max(reach[cut.node], this->Edges[k].tolerance);
    }
  }
  std::vector<int> order(this->Vertices.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
    [&](int a, int b)
    {
      const double xa = this->Vertices[a].x();
      const double xb = this->Vertices[b].x();
      return xa < xb || (xa == xb && a < b);
    });
  const double largest = reach.empty() ? 0.0 : *std::max_element(reach.begin(), reach.end());
  for (std::size_t k = 0; k < this->Edges.size(); ++k)
  {
    const TrimEdge& edge = this->Edges[k].edge;
    // Between samples the edge may leave their box by a part of it.
    const double beside = largest + 0.1 * (edge.box()[1] - edge.box()[0]).norm();
    const auto first = std::lower_bound(order.begin(), order.end(), edge.box()[0].x() - beside,
      [&](int node, double x) { return this->Vertices[node].x() < x; });
    std::vector<Cut> found;
    for (auto at = first;
         at != order.end() && this->Vertices[*at].x() <= edge.box()[1].x() + beside; ++at)
    {
      const Vector3& point = this->Vertices[*at];
      const double allowed = std::max(reach[*at], this->Edges[k].tolerance);
      const auto is_at = [&](const Cut& cut) { return cut.node == *at; };
      if (!is_near(edge.box(), point, beside) ||
        std::any_of(this->Cuts[k].begin(), this->Cuts[k].end(), is_at))
      {
        continue;
      }
      const double t = edge.nearest(point, 0.0, edge.length());
      const Vector3 there = edge.point(t);
      const bool beside_cut = std::any_of(this->Cuts[k].begin(), this->Cuts[k].end(),
        [&](const Cut& cut) { return (this->Vertices[cut.node] - there).norm() <= allowed; });
      if ((there - point).norm() <= allowed && !beside_cut)
      {
        found.push_back({ t, *at });
      }
    }
    this->Cuts[k].insert(this->Cuts[k].end(), found.begin(), found.end());
    std::sort(this->Cuts[k].begin(), this->Cuts[k].end(),
      [](const Cut& a, const Cut& b) { return a.t < b.t || (a.t == b.t && a.node < b.node); });
    this->Cuts[k].erase(std::unique(this->Cuts[k].begin(), this->Cuts[k].end(),
                          [](const Cut& a, const Cut& b) { return a.t == b.t; }),
      this->Cuts[k].end());
  }
}

void EdgeJoining::make_pieces()
{
  this->PiecesOfEdge.resize(this->Edges.size());
  for (std::size_t k = 0; k < this->Edges.size(); ++k)
  {
    for (std::size_t i = 0; i + 1 < this->Cuts[k].size(); ++i)
    {
      const Cut& a = this->Cuts[k][i];
      const Cut& b = this->Cuts[k][i + 1];
      const TrimEdge& edge = this->Edges[k].edge;
      bool collapsed = a.node == b.node;
      const bool gap = collapsed && edge.closes_gap() && edge.collapsed(this->Gap);
      for (int j = 1; collapsed && !gap && j < 8; ++j)
      {
        collapsed = (edge.point(a.t + (b.t - a.t) * j / 8.0) - this->Vertices[a.node]).norm() <=
          2.0 * this->tolerance(k, k);
      }
      this->PiecesOfEdge[k].push_back(this->Pieces.size());
      this->Pieces.push_back({ k, a.t, b.t, a.node, b.node, collapsed });
    }
  }
}

bool EdgeJoining::run_along(const Piece& a, const Piece& b) const
{
  const double allowed = this->tolerance(a.edge, b.edge);
  for (const double f : { 0.5, 0.25, 0.75 })
  {
    const Vector3 point = this->Edges[a.edge].edge.point(a.from + f * (a.to - a.from));
    const TrimEdge& other = this->Edges[b.edge].edge;
    if ((other.point(other.nearest(point, b.from, b.to)) - point).norm() > allowed)
    {
      return false;
    }
  }
  return true;
}

void EdgeJoining::group_pieces()
{
  std::map<std::array<int, 2>, std::vector<std::size_t>> between;
  for (std::size_t k = 0; k < this->Pieces.size(); ++k)
  {
    const Piece& piece = this->Pieces[k];
    between[{ { std::min(piece.start, piece.end), std::max(piece.start, piece.end) } }].push_back(
      k);
  }
  Sets sets(this->Pieces.size());
  for (const auto& [nodes, pieces] : between)
  {
    for (std::size_t i = 0; i < pieces.size(); ++i)
    {
      for (std::size_t j = 0; j < i; ++j)
      {
        const Piece& a = this->Pieces[pieces[i]];
        const Piece& b = this->Pieces[pieces[j]];
        if (!a.collapsed && !b.collapsed && sets.find(pieces[i]) != sets.find(pieces[j]) &&
          this->run_along(a, b))
        {
          sets.join(pieces[i], pieces[j]);
        }
      }
    }
  }
  this->GroupOfPiece.resize(this->Pieces.size());
  for (std::size_t k = 0; k < this->Pieces.size(); ++k)
  {
    const std::size_t first = sets.find(k);
    if (first == k)
    {
      this->GroupOfPiece[k] = static_cast<int>(this->Groups.size());
      this->Groups.emplace_back();
    }
    this->GroupOfPiece[k] = this->GroupOfPiece[first];
    this->Groups[this->GroupOfPiece[k]].pieces.push_back(k);
  }
}

} // namespace footpoint
