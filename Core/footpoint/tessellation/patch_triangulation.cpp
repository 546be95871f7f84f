// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/tessellation/patch_triangulation.h"

#include "footpoint/model/evaluation.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace footpoint
{
namespace
{

/// Places of the same node that differ by no more than this part of the domain are one.
constexpr double kSamePlace = 1e-9;

/// A corner of a cell this near to an edge of the boundary, in cells, is left out: it would make
/// thin triangles.
constexpr double kClear = 0.3;
/// And this near to another vertex it is the same, computed in another way.
constexpr double kSameCorner = 1e-6;

/// The power of two below a number.
double power_of_two(double x)
{
  return x > 0.0 && std::isfinite(x) ? std::ldexp(1.0, std::ilogb(x)) : 1.0;
}

/// So that circles of the plane are about circles on the surface.
Eigen::Vector2d scale_of(const Surface& surface)
{
  Eigen::Vector2d scale;
  for (int i = 0; i < 2; ++i)
  {
    const Direction& direction = surface.direction(i);
    scale[i] = direction.speed * direction.length;
  }
  const double largest = scale.maxCoeff();
  for (double& s : scale)
  {
    s = std::max(power_of_two(s / largest), 0x1p-20);
  }
  return scale;
}

} // namespace

PatchTriangulation::PatchTriangulation(
  const SurfaceBounds& bounds, const TrimRegion* region, const SamplingRule& rule)
  : Bounds(bounds)
  , Base(bounds.surface())
  , Region(region)
  , Rule(rule)
  , Length(this->Base.direction(0).length, this->Base.direction(1).length)
  , Mesh(scale_of(this->Base))
  , Places(ConstrainedDelaunay::first_vertex(), Parameter<2>::Zero())
  , Nodes(ConstrainedDelaunay::first_vertex(), -1)
{
}

/// Onto the unit square. Places on one line of constant parameter stay on one.
Eigen::Vector2d PatchTriangulation::unit(const Parameter<2>& place) const
{
  return place.cwiseQuotient(this->Length);
}

int PatchTriangulation::add(const Parameter<2>& place, int node)
{
  const int vertex = this->Mesh.insert(this->unit(place));
  if (vertex == static_cast<int>(this->Places.size()))
  {
    this->Places.push_back(place);
    this->Nodes.push_back(node);
  }
  return vertex;
}

int PatchTriangulation::add_boundary(const Parameter<2>& place, int node)
{
  std::vector<NamedPlace>& known = this->OfNode[node];
  for (const NamedPlace& named : known)
  {
    if ((this->unit(named.place) - this->unit(place)).cwiseAbs().maxCoeff() <= kSamePlace)
    {
      return named.vertex;
    }
  }
  known.push_back({ place, this->add(place, node) });
  return known.back().vertex;
}

void PatchTriangulation::constrain_boundary(
  const std::vector<const PatchEdge*>& edges, const std::vector<const EdgeSamples*>& samples)
{
  // What closes a gap that is one node is one vertex: were it an edge it might cross its
  // neighbours.
  for (std::size_t k = 0; k < edges.size(); ++k)
  {
    const std::vector<int>& nodes = samples[k]->nodes;
    if (edges[k]->edge.closes_gap() &&
      std::adjacent_find(nodes.begin(), nodes.end(), std::not_equal_to<>()) == nodes.end())
    {
      const int vertex =
        this->add_boundary(edges[k]->edge.place(samples[k]->parameters.front()), nodes.front());
      for (const double t : samples[k]->parameters)
      {
        this->OfNode[nodes.front()].push_back({ edges[k]->edge.place(t), vertex });
      }
    }
  }
  std::vector<std::vector<int>> chains;
  for (std::size_t k = 0; k < edges.size(); ++k)
  {
    chains.emplace_back();
    for (std::size_t i = 0; i < samples[k]->parameters.size(); ++i)
    {
      const int vertex =
        this->add_boundary(edges[k]->edge.place(samples[k]->parameters[i]), samples[k]->nodes[i]);
      chains.back().push_back(vertex);
      for (const std::size_t piece : { i, i - 1 })
      {
        if (piece < samples[k]->groups.size())
        {
          this->GroupsOfVertex[vertex].push_back(samples[k]->groups[piece]);
        }
      }
    }
  }
  for (std::size_t k = 0; k < edges.size(); ++k)
  {
    for (std::size_t i = 0; i + 1 < chains[k].size(); ++i)
    {
      if (chains[k][i] == chains[k][i + 1])
      {
        continue;
      }
      const bool pole = samples[k]->nodes[i] == samples[k]->nodes[i + 1];
      this->Mesh.constrain(
        chains[k][i], chains[k][i + 1], pole ? EdgeKind::Divisible : EdgeKind::Fixed);
      for (int direction = 0; pole && direction < 2; ++direction)
      {
        const double at = this->Places[chains[k][i]][direction];
        const int end = at == 0.0 ? 0 : 1;
        if (this->Base.direction(direction).collapsed[end] &&
          at == (end == 0 ? 0.0 : this->Length[direction]) &&
          at == this->Places[chains[k][i + 1]][direction])
        {
          this->Poles[direction][end] = samples[k]->nodes[i];
        }
      }
    }
  }
}

int PatchTriangulation::pole_node(const Parameter<2>& place) const
{
  for (int i = 0; i < 2; ++i)
  {
    const int end = place[i] == 0.0 ? 0 : 1;
    if (this->Poles[i][end] >= 0 && place[i] == (end == 0 ? 0.0 : this->Length[i]))
    {
      return this->Poles[i][end];
    }
  }
  return -1;
}

void PatchTriangulation::constrain_kinks(const std::vector<SurfaceCells>& cells)
{
  for (int i = 0; i < 2; ++i)
  {
    const std::vector<Break>& breaks = this->Base.direction(i).breaks;
    for (std::size_t k = 1; k + 1 < breaks.size(); ++k)
    {
      const double at = breaks[k].at;
      std::vector<std::pair<double, int>> line;
      for (std::size_t vertex = ConstrainedDelaunay::first_vertex(); vertex < this->Places.size();
           ++vertex)
      {
        if (this->Places[vertex][i] == at)
        {
          line.emplace_back(this->Places[vertex][1 - i], static_cast<int>(vertex));
        }
      }
      std::vector<double> corners; // and where kinks cross
      for (const Break& other : this->Base.direction(1 - i).breaks)
      {
        corners.push_back(other.at);
      }
      for (const SurfaceCells& cell : cells)
      {
        for (int j = 0;
             (cell.box.lower[i] == at || cell.box.upper[i] == at) && j <= cell.count[1 - i]; ++j)
        {
          corners.push_back(cell.line(1 - i, j));
        }
      }
      std::sort(corners.begin(), corners.end());
      const double same = kSamePlace * this->Length[1 - i];
      const std::size_t on_boundary = line.size();
      double before = -1.0;
      for (const double corner : corners)
      {
        const bool inside = corner > 0.0 && corner < this->Length[1 - i];
        const bool taken =
          std::any_of(line.begin(), line.begin() + static_cast<std::ptrdiff_t>(on_boundary),
            [&](const auto& known) { return std::abs(known.first - corner) <= same; });
        if (inside && !taken && corner - before > same)
        {
          Parameter<2> place;
          place[i] = at;
          place[1 - i] = corner;
          line.emplace_back(corner, this->add(place, -1));
          before = corner;
        }
      }
      std::sort(line.begin(), line.end());
      for (std::size_t j = 0; j + 1 < line.size(); ++j)
      {
        this->Mesh.constrain(line[j].second, line[j + 1].second, EdgeKind::Divisible);
      }
    }
  }
}

std::array<Parameter<2>, 3> PatchTriangulation::corners(int triangle) const
{
  const auto& vertex = this->Mesh.triangles()[triangle].vertex;
  return { { this->Places[vertex[0]], this->Places[vertex[1]], this->Places[vertex[2]] } };
}

/// Parts of the plane between edges that stay are kept or left out as a whole.
void PatchTriangulation::classify()
{
  const auto& triangles = this->Mesh.triangles();
  std::vector<bool> seen(triangles.size(), false);
  for (std::size_t start = 0; start < triangles.size(); ++start)
  {
    if (seen[start])
    {
      continue;
    }
    std::vector<int> component{ static_cast<int>(start) };
    seen[start] = true;
    for (std::size_t k = 0; k < component.size(); ++k)
    {
      const ConstrainedDelaunay::Triangle& here = triangles[component[k]];
      for (int i = 0; i < 3; ++i)
      {
        const int beyond = here.neighbour[i];
        if (beyond >= 0 && here.kind[i] == EdgeKind::Free && !seen[beyond])
        {
          seen[beyond] = true;
          component.push_back(beyond);
        }
      }
    }
    const bool kept = this->is_kept(component);
    for (const int triangle : component)
    {
      this->Mesh.set_kept(triangle, kept);
    }
  }
}

bool PatchTriangulation::is_kept(const std::vector<int>& component) const
{
  // The largest triangles tell: small ones may lie between the chords of an edge and itself.
  constexpr std::size_t kVotes = 5;
  std::vector<std::pair<double, int>> largest;
  for (const int triangle : component)
  {
    const auto& vertex = this->Mesh.triangles()[triangle].vertex;
    if (*std::min_element(vertex.begin(), vertex.end()) < ConstrainedDelaunay::first_vertex())
    {
      return false; // connected with the outside of the domain
    }
    const Eigen::Vector2d a = this->Mesh.point(vertex[1]) - this->Mesh.point(vertex[0]);
    const Eigen::Vector2d b = this->Mesh.point(vertex[2]) - this->Mesh.point(vertex[0]);
    largest.emplace_back(-std::abs(a[0] * b[1] - a[1] * b[0]), triangle);
  }
  if (!this->Region)
  {
    return true;
  }
  const std::size_t votes = std::min(kVotes, largest.size());
  std::partial_sort(
    largest.begin(), largest.begin() + static_cast<std::ptrdiff_t>(votes), largest.end());
  double sum = 0.0;
  for (std::size_t k = 0; k < votes; ++k)
  {
    const std::array<Parameter<2>, 3> corner = this->corners(largest[k].second);
    const Parameter<2> middle = (corner[0] + corner[1] + corner[2]) / 3.0;
    sum += largest[k].first * (this->Region->contains(middle[0], middle[1]) ? -1.0 : 1.0);
  }
  return sum > 0.0;
}

/// Whether a corner of a cell is far enough from the boundary and from other vertices.
bool PatchTriangulation::is_clear(
  const ConstrainedDelaunay::Place& at, const Parameter<2>& place, const Parameter<2>& cell) const
{
  const ConstrainedDelaunay::Triangle& here = this->Mesh.triangles()[at.triangle];
  const bool beyond = at.on_edge >= 0 && here.neighbour[at.on_edge] >= 0 &&
    this->Mesh.triangles()[here.neighbour[at.on_edge]].kept;
  if (!here.kept && !beyond)
  {
    return false;
  }
  for (int i = 0; i < 3; ++i)
  {
    const Parameter<2> a = (this->Places[here.vertex[(i + 1) % 3]] - place).cwiseQuotient(cell);
    const Parameter<2> b = (this->Places[here.vertex[(i + 2) % 3]] - place).cwiseQuotient(cell);
    if (a.norm() <= kSameCorner)
    {
      return false;
    }
    if (here.kind[i] == EdgeKind::Fixed)
    {
      const Parameter<2> way = b - a;
      const double along = std::clamp(-a.dot(way) / way.squaredNorm(), 0.0, 1.0);
      if ((a + along * way).norm() <= kClear)
      {
        return false;
      }
    }
  }
  return true;
}

void PatchTriangulation::add_corners(const std::vector<SurfaceCells>& cells)
{
  for (const SurfaceCells& cell : cells)
  {
    const Parameter<2> size =
      cell.box.extent().cwiseQuotient(Parameter<2>(cell.count[0], cell.count[1]));
    for (int j = 0; j <= cell.count[1]; ++j)
    {
      for (int i = 0; i <= cell.count[0]; ++i)
      {
        const Parameter<2> place(cell.line(0, i), cell.line(1, j));
        const ConstrainedDelaunay::Place at = this->Mesh.locate(this->unit(place));
        if (at.on_vertex < 0 && this->is_clear(at, place, size))
        {
          this->Mesh.insert(this->unit(place), at);
          this->Places.push_back(place);
          this->Nodes.push_back(this->pole_node(place));
        }
      }
    }
  }
}

PatchMesh PatchTriangulation::finish() const
{
  PatchMesh mesh;
  std::vector<int> number(this->Places.size(), -1);
  for (const ConstrainedDelaunay::Triangle& triangle : this->Mesh.triangles())
  {
    if (!triangle.kept || this->is_collapsed(triangle.vertex))
    {
      continue;
    }
    std::array<int, 3> corner;
    for (int i = 0; i < 3; ++i)
    {
      int& vertex = number[triangle.vertex[i]];
      if (vertex < 0)
      {
        vertex = static_cast<int>(mesh.places.size());
        mesh.places.push_back(this->Places[triangle.vertex[i]]);
        mesh.nodes.push_back(this->Nodes[triangle.vertex[i]]);
      }
      corner[i] = vertex;
    }
    mesh.triangles.push_back(corner);
  }
  mesh.too_coarse = this->TooCoarse;
  return mesh;
}

/// Whether two corners are one node: the triangle has no area.
bool PatchTriangulation::is_collapsed(const std::array<int, 3>& vertex) const
{
  const int a = this->Nodes[vertex[0]];
  const int b = this->Nodes[vertex[1]];
  const int c = this->Nodes[vertex[2]];
  return (a >= 0 && (a == b || a == c)) || (b >= 0 && b == c);
}

PatchMesh PatchTriangulation::run(const std::vector<const PatchEdge*>& edges,
  const std::vector<const EdgeSamples*>& samples, const std::vector<SurfaceCells>& cells)
{
  try
  {
    this->constrain_boundary(edges, samples);
    this->constrain_kinks(cells);
  }
  catch (const CrossingEdges& crossing)
  {
    PatchMesh failed;
    for (const std::array<int, 2>& edge : crossing.edges)
    {
      std::vector<int> of[2];
      for (int i = 0; i < 2; ++i)
      {
        of[i] = this->GroupsOfVertex[edge[i]];
        std::sort(of[i].begin(), of[i].end());
      }
      const auto before = failed.crossing_groups.size();
      std::set_intersection(of[0].begin(), of[0].end(), of[1].begin(), of[1].end(),
        std::back_inserter(failed.crossing_groups));
      if (failed.crossing_groups.size() == before)
      {
        failed.crossing_groups.insert(failed.crossing_groups.end(), of[0].begin(), of[0].end());
        failed.crossing_groups.insert(failed.crossing_groups.end(), of[1].begin(), of[1].end());
      }
    }
    std::vector<int>& groups = failed.crossing_groups;
    std::sort(groups.begin(), groups.end());
    groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
    if (groups.empty())
    {
      groups.push_back(-1); // only kinks, of which shorter chords know nothing
    }
    return failed;
  }
  this->classify();
  this->add_corners(cells);
  if (this->Rule.adaptive)
  {
    this->refine();
  }
  return this->finish();
}

} // namespace footpoint
