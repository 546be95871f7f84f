// SPDX-License-Identifier: BSD-3-Clause
// What of EdgeJoining samples edges that were joined.
#include "footpoint/tessellation/edge_joining.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace footpoint
{
namespace
{

/// Rounds in which the chords of a group are halved for members that need it.
constexpr int kRounds = 40;

/// Each level asks for chords a quarter as far from the curve: about half as long.
constexpr double kFiner = 0.25;

} // namespace

void EdgeJoining::refine(int group)
{
  this->Groups[group].stale = true;
  ++this->Groups[group].level;
}

/// Where a member of a group is nearest to points, strictly from one end to the other; false where
/// it does not pass them in their order.
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
