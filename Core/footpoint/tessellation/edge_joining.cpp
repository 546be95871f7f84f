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

/// Rounds in which the chords of a group are halved for members that need it.
constexpr int kRounds = 40;

/// Each level asks for chords a quarter as far from the curve: about half as long.
constexpr double kFiner = 0.25;

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
    for (std::size_t j = i + 1;
         j < order.size() && ends[order[j]].point.x() - a.point.x() <= reach; ++j)
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
        collapsed = (edge.point(a.t + (b.t - a.t) * j / 8.0) - this->Vertices[a.node])
                      .norm() <= 2.0 * this->tolerance(k, k);
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
    between[{ { std::min(piece.start, piece.end), std::max(piece.start, piece.end) } }].push_back(k);
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

void EdgeJoining::refine(int group)
{
  this->Groups[group].stale = true;
  ++this->Groups[group].level;
}

/// Where a member of a group is nearest to points, strictly from one end to the other; false where it
/// does not pass them in their order.
bool EdgeJoining::map(const Group& group, std::size_t member, const std::vector<Vector3>& points,
  std::vector<double>& parameters) const
{
  const Piece& piece = this->Pieces[group.pieces[member]];
  const TrimEdge& edge = this->Edges[piece.edge].edge;
  parameters.clear();
  for (const Vector3& point : points)
  {
    parameters.push_back(edge.nearest(point, piece.from, piece.to));
  }
  std::vector<double> all = parameters;
  if (all.size() > 1 && all.front() > all.back())
  {
    std::reverse(all.begin(), all.end());
  }
  all.insert(all.begin(), piece.from);
  all.push_back(piece.to);
  return std::adjacent_find(all.begin(), all.end(), std::greater_equal<>()) == all.end();
}

void EdgeJoining::sample_group(Group& group, const SamplingRule& rule) const
{
  SamplingRule own = rule;
  own.tolerance *= std::pow(kFiner, group.level);
  own.resolution *= 1 << group.level;

  // === The finest member leads
  std::size_t leader = 0;
  std::vector<double> t;
  for (std::size_t m = 0; m < group.pieces.size(); ++m)
  {
    const Piece& piece = this->Pieces[group.pieces[m]];
    const PatchEdge& edge = this->Edges[piece.edge];
    std::vector<double> samples;
    if (!piece.collapsed)
    {
      samples = edge.edge.samples(*edge.bounds, own, piece.from, piece.to);
      samples = std::vector<double>(samples.begin() + 1, samples.end() - 1);
      // What begins where it ends encloses something.
      if (piece.start == piece.end && samples.size() < 2)
      {
        const double third = (piece.to - piece.from) / 3.0;
        samples = { piece.from + third, piece.from + 2.0 * third };
      }
    }
    if (m == 0 || samples.size() > t.size())
    {
      leader = m;
      t = std::move(samples);
    }
  }
  std::swap(group.pieces[0], group.pieces[leader]);
  const TrimEdge& leading = this->Edges[this->Pieces[group.pieces[0]].edge].edge;

  // === The others follow, until all chords are short enough for all
  for (int round = 0;; ++round)
  {
    group.points.clear();
    for (const double at : t)
    {
      group.points.push_back(leading.point(at));
    }
    group.parameters.assign(1, t);
    std::vector<double> more;
    for (std::size_t m = 1; m < group.pieces.size(); ++m)
    {
      const Piece& piece = this->Pieces[group.pieces[m]];
      const PatchEdge& edge = this->Edges[piece.edge];
      std::vector<double> mapped;
      this->map(group, m, group.points, mapped);
      std::vector<double> all = mapped;
      std::sort(all.begin(), all.end());
      all.insert(all.begin(), piece.from);
      all.push_back(piece.to);
      for (std::size_t i = 0; i + 1 < all.size() && round < kRounds; ++i)
      {
        if (all[i] < all[i + 1] && !edge.edge.is_fine(*edge.bounds, own, all[i], all[i + 1]))
        {
          const Vector3 middle = edge.edge.point(all[i] + 0.5 * (all[i + 1] - all[i]));
          const Piece& first = this->Pieces[group.pieces[0]];
          more.push_back(leading.nearest(middle, first.from, first.to));
        }
      }
      group.parameters.push_back(std::move(mapped));
    }
    const std::size_t before = t.size();
    const Piece& first = this->Pieces[group.pieces[0]];
    for (const double at : more)
    {
      if (at > first.from && at < first.to)
      {
        t.push_back(at);
      }
    }
    std::sort(t.begin(), t.end());
    t.erase(std::unique(t.begin(), t.end(),
              [&](double a, double b) { return b - a <= 1e-6 * (first.to - first.from); }),
      t.end());
    if (t.size() == before)
    {
      break;
    }
  }
  group.stale = false;
}

void EdgeJoining::sample(const SamplingRule& rule, const Execution& execution)
{
  std::vector<std::size_t> stale;
  for (std::size_t g = 0; g < this->Groups.size(); ++g)
  {
    if (this->Groups[g].stale)
    {
      stale.push_back(g);
    }
  }
  execution.parallel_for(static_cast<std::int64_t>(stale.size()),
    [&](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t k = begin; k < end; ++k)
      {
        this->sample_group(this->Groups[stale[k]], rule);
      }
    });

  std::vector<std::array<std::size_t, 2>> member(this->Pieces.size());
  for (const std::size_t g : stale)
  {
    Group& group = this->Groups[g];
    group.first_node = static_cast<int>(this->Nodes.size());
    this->Nodes.insert(this->Nodes.end(), group.points.begin(), group.points.end());
  }
  for (std::size_t g = 0; g < this->Groups.size(); ++g)
  {
    for (std::size_t m = 0; m < this->Groups[g].pieces.size(); ++m)
    {
      member[this->Groups[g].pieces[m]] = { { g, m } };
    }
  }
  this->Samples.assign(this->Edges.size(), {});
  for (std::size_t k = 0; k < this->Edges.size(); ++k)
  {
    EdgeSamples& samples = this->Samples[k];
    for (const std::size_t p : this->PiecesOfEdge[k])
    {
      const auto [g, m] = member[p];
      const std::vector<double>& t = this->Groups[g].parameters[m];
      const bool backwards = t.size() > 1 && t.front() > t.back();
      samples.parameters.push_back(this->Pieces[p].from);
      samples.nodes.push_back(this->Pieces[p].start);
      samples.groups.push_back(static_cast<int>(g));
      for (std::size_t i = 0; i < t.size(); ++i)
      {
        const std::size_t at = backwards ? t.size() - 1 - i : i;
        samples.parameters.push_back(t[at]);
        samples.nodes.push_back(this->Groups[g].first_node + static_cast<int>(at));
        samples.groups.push_back(static_cast<int>(g));
      }
      if (p == this->PiecesOfEdge[k].back())
      {
        samples.parameters.push_back(this->Pieces[p].to);
        samples.nodes.push_back(this->Pieces[p].end);
      }
    }
  }
}

} // namespace footpoint
