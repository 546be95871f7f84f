// SPDX-License-Identifier: BSD-3-Clause
// What of trim_edge.h collects the edges of a face.
#include "footpoint/tessellation/trim_edge.h"

#include <algorithm>

namespace footpoint
{
namespace
{

bool is_between(double a, double b, double x)
{
  return x > std::min(a, b) && x < std::max(a, b);
}

/// A straight arc between two points of the plane.
TrimArc straight(const Parameter<2>& from, const Parameter<2>& to)
{
  TrimArc arc{ {}, -1, 0, false, { { 0.0, 1.0 } }, { { true, true } }, true };
  arc.control.resize(3, 2);
  arc.control << from[0], to[0], from[1], to[1], 1.0, 1.0;
  return arc;
}

/// A side of the domain between ascending coordinates, cut at knot lines.
std::vector<TrimArc> side_arcs(
  const Surface& surface, int across, double border, double from, double to)
{
  const int along = 1 - across;
  std::vector<double> cuts{ from };
  for (const double knot : surface.direction(along).spans)
  {
    if (is_between(from, to, knot))
    {
      cuts.push_back(knot);
    }
  }
  cuts.push_back(to);
  std::vector<TrimArc> arcs;
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k)
  {
    Parameter<2> a;
    Parameter<2> b;
    a[across] = b[across] = border;
    a[along] = cuts[k];
    b[along] = cuts[k + 1];
    arcs.push_back(straight(a, b));
  }
  return arcs;
}

/// The coordinates of an arc's ends.
std::array<Parameter<2>, 2> ends_of(const TrimArc& arc)
{
  const auto first = arc.control.col(0);
  const auto last = arc.control.col(arc.control.cols() - 1);
  return { { first.head<2>() / first[2], last.head<2>() / last[2] } };
}

/// The parts of a side over which the region goes on without an arc along it.
void append_open_sides(const Surface& surface, const TrimRegion& region, int across, double border,
  std::vector<TrimEdge>& edges)
{
  const int along = 1 - across;
  std::vector<double> cuts{ 0.0, surface.direction(along).length };
  std::vector<std::array<double, 2>> covered;
  for (const TrimArc& arc : region.arcs())
  {
    const auto ends = ends_of(arc);
    for (int i = 0; i < 2; ++i)
    {
      if (arc.inside_domain && ends[i][across] == border)
      {
        cuts.push_back(ends[i][along]);
      }
    }
    if (arc.inside_domain && ends[0][across] == border && ends[1][across] == border)
    {
      covered.push_back({ { ends[0][along], ends[1][along] } });
    }
  }
  std::sort(cuts.begin(), cuts.end());
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  double start = 0.0;
  double end = -1.0; // of the run that is being collected
  const auto finish = [&]()
  {
    if (end > start)
    {
      edges.emplace_back(surface, side_arcs(surface, across, border, start, end));
    }
    end = -1.0;
  };
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k)
  {
    const double middle = 0.5 * (cuts[k] + cuts[k + 1]);
    Parameter<2> at;
    at[across] = border;
    at[along] = middle;
    const bool taken = std::any_of(covered.begin(), covered.end(),
      [middle](const std::array<double, 2>& c) { return is_between(c[0], c[1], middle); });
    finish();
    if (!taken && region.contains(at[0], at[1]))
    {
      start = cuts[k];
      end = cuts[k + 1];
    }
  }
  finish();
}

} // namespace

std::vector<TrimEdge> boundary_edges(const Surface& surface, const TrimRegion* region)
{
  std::vector<TrimEdge> edges;
  for (int across = 0; across < 2; ++across)
  {
    for (const double border : { 0.0, surface.direction(across).length })
    {
      if (region)
      {
        append_open_sides(surface, *region, across, border, edges);
      }
      else
      {
        edges.emplace_back(
          surface, side_arcs(surface, across, border, 0.0, surface.direction(1 - across).length));
      }
    }
  }
  std::vector<TrimArc> run;
  const auto finish = [&]()
  {
    if (!run.empty())
    {
      edges.emplace_back(surface, std::move(run));
    }
    run.clear();
  };
  for (std::size_t k = 0; region && k < region->arcs().size(); ++k)
  {
    const TrimArc& arc = region->arcs()[k];
    const bool continues = !run.empty() && arc.loop == run.back().loop &&
      arc.curve == run.back().curve && arc.closes_gap == run.back().closes_gap &&
      (ends_of(arc)[0] - ends_of(run.back())[1]).cwiseAbs().maxCoeff() <=
        1e-9 * (surface.direction(0).length + surface.direction(1).length);
    if (!arc.inside_domain || !continues)
    {
      finish();
    }
    if (arc.inside_domain)
    {
      run.push_back(arc);
    }
  }
  finish();
  return edges;
}

} // namespace footpoint
