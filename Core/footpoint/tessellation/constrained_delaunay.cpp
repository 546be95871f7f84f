// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/tessellation/constrained_delaunay.h"

#include "footpoint/tessellation/orientation.h"

#include <algorithm>
#include <deque>

namespace footpoint
{
namespace
{

/// Corners of a triangle around the unit square, far enough that circles through them are nearly
/// lines.
constexpr double kFar = 1024.0;

int next(int i)
{
  return i == 2 ? 0 : i + 1;
}
int previous(int i)
{
  return i == 0 ? 2 : i - 1;
}

} // namespace

ConstrainedDelaunay::ConstrainedDelaunay(const Eigen::Vector2d& scale)
  : Scale(scale)
{
  for (const auto& corner :
    { Eigen::Vector2d(-kFar, -kFar), Eigen::Vector2d(kFar, -kFar), Eigen::Vector2d(0.5, kFar) })
  {
    this->Points.push_back(corner);
    this->Scaled.push_back(corner.cwiseProduct(scale));
    this->OfVertex.push_back(0);
  }
  Triangle around;
  around.vertex = { { 0, 1, 2 } };
  around.neighbour = { { -1, -1, -1 } };
  this->Triangles.push_back(around);
}

int ConstrainedDelaunay::turn(int a, int b, int c) const
{
  return orientation(this->Points[a], this->Points[b], this->Points[c]);
}

ConstrainedDelaunay::Place ConstrainedDelaunay::locate(const Eigen::Vector2d& point) const
{
  int at = this->Last;
  std::uint32_t random = 1;
  for (;;)
  {
    const Triangle& triangle = this->Triangles[at];
    // Where constraints bend the mesh a walk could run in circles, but for the changing start.
    random = random * 1664525u + 1013904223u;
    const int first = static_cast<int>((random >> 16) % 3);
    Place place{ at, -1, -1 };
    int onward = -1;
    for (int k = 0; k < 3 && onward < 0; ++k)
    {
      const int i = (first + k) % 3;
      const int side = orientation(
        this->Points[triangle.vertex[next(i)]], this->Points[triangle.vertex[previous(i)]], point);
      if (side < 0)
      {
        onward = triangle.neighbour[i];
        if (onward < 0)
        {
          throw std::out_of_range("a point far outside the unit square was inserted");
        }
      }
      else if (side == 0)
      {
        // On two edges: at the corner that they share.
        place.on_vertex = place.on_edge < 0 ? -1 : triangle.vertex[3 - i - place.on_edge];
        place.on_edge = i;
      }
    }
    if (onward < 0)
    {
      this->Last = at;
      return place;
    }
    at = onward;
  }
}

int ConstrainedDelaunay::edge_towards(int triangle, int neighbour) const
{
  const auto& all = this->Triangles[triangle].neighbour;
  return static_cast<int>(std::find(all.begin(), all.end(), neighbour) - all.begin());
}

void ConstrainedDelaunay::relink(int triangle, int from, int to)
{
  if (triangle >= 0)
  {
    this->Triangles[triangle].neighbour[this->edge_towards(triangle, from)] = to;
  }
}

void ConstrainedDelaunay::set(int triangle, const std::array<int, 3>& vertex,
  const std::array<int, 3>& neighbour, const std::array<EdgeKind, 3>& kind)
{
  Triangle& set = this->Triangles[triangle];
  set.vertex = vertex;
  set.neighbour = neighbour;
  set.kind = kind;
  for (const int corner : vertex)
  {
    this->OfVertex[corner] = triangle;
  }
  this->Changed.push_back(triangle);
}

int ConstrainedDelaunay::insert(const Eigen::Vector2d& point, const Place& place)
{
  if (place.on_vertex >= 0)
  {
    return place.on_vertex;
  }
  const int added = this->number_of_vertices();
  this->Points.push_back(point);
  this->Scaled.push_back(point.cwiseProduct(this->Scale));
  this->OfVertex.push_back(place.triangle);
  const auto more = [this](bool kept)
  {
    this->Triangles.emplace_back();
    this->Triangles.back().kept = kept;
    return static_cast<int>(this->Triangles.size()) - 1;
  };
  const int t = place.triangle;
  const Triangle old = this->Triangles[t];
  if (place.on_edge < 0)
  {
    const int t1 = more(old.kept);
    const int t2 = more(old.kept);
    const auto [a, b, c] = old.vertex;
    const auto [na, nb, nc] = old.neighbour;
    const auto [ka, kb, kc] = old.kind;
    this->relink(na, t, t1);
    this->relink(nb, t, t2);
    this->set(
      t, { { a, b, added } }, { { t1, t2, nc } }, { { EdgeKind::Free, EdgeKind::Free, kc } });
    this->set(
      t1, { { b, c, added } }, { { t2, t, na } }, { { EdgeKind::Free, EdgeKind::Free, ka } });
    this->set(
      t2, { { c, a, added } }, { { t, t1, nb } }, { { EdgeKind::Free, EdgeKind::Free, kb } });
    this->Stack.insert(this->Stack.end(), { { { t, 2 } }, { { t1, 2 } }, { { t2, 2 } } });
  }
  else
  {
    // The edge from b to c between the triangles a b c and d c b.
    const int i = place.on_edge;
    const int s = old.neighbour[i];
    const Triangle beyond = this->Triangles[s];
    const int j = this->edge_towards(s, t);
    const int a = old.vertex[i];
    const int b = old.vertex[next(i)];
    const int c = old.vertex[previous(i)];
    const int d = beyond.vertex[j];
    const EdgeKind cut = old.kind[i];
    const int t1 = more(old.kept);
    const int s1 = more(beyond.kept);
    const int nca = old.neighbour[next(i)];
    const int nab = old.neighbour[previous(i)];
    const int nbd = beyond.neighbour[next(j)];
    const int ndc = beyond.neighbour[previous(j)];
    this->relink(nca, t, t1);
    this->relink(nbd, s, s1);
    this->set(t, { { a, b, added } }, { { s1, t1, nab } },
      { { cut, EdgeKind::Free, old.kind[previous(i)] } });
    this->set(
      t1, { { c, a, added } }, { { t, s, nca } }, { { EdgeKind::Free, cut, old.kind[next(i)] } });
    this->set(s, { { d, c, added } }, { { t1, s1, ndc } },
      { { cut, EdgeKind::Free, beyond.kind[previous(j)] } });
    this->set(s1, { { b, d, added } }, { { s, t, nbd } },
      { { EdgeKind::Free, cut, beyond.kind[next(j)] } });
    this->Stack.insert(
      this->Stack.end(), { { { t, 2 } }, { { t1, 2 } }, { { s, 2 } }, { { s1, 2 } } });
  }
  this->Last = t;
  this->legalize();
  return added;
}

bool ConstrainedDelaunay::should_flip(int triangle, int edge) const
{
  const Triangle& here = this->Triangles[triangle];
  const int beyond = here.neighbour[edge];
  if (beyond < 0 || here.kind[edge] != EdgeKind::Free)
  {
    return false;
  }
  const int opposite = this->Triangles[beyond].vertex[this->edge_towards(beyond, triangle)];
  const int a = here.vertex[edge];
  const int b = here.vertex[next(edge)];
  const int c = here.vertex[previous(edge)];
  return in_circle(this->Scaled[a], this->Scaled[b], this->Scaled[c], this->Scaled[opposite]) > 0 &&
    this->turn(a, b, opposite) > 0 && this->turn(a, opposite, c) > 0;
}

/// Turns the edge b c of the triangles a b c and d c b into a d: a b d and a d c.
void ConstrainedDelaunay::flip(int triangle, int edge)
{
  const Triangle here = this->Triangles[triangle];
  const int other = here.neighbour[edge];
  const Triangle beyond = this->Triangles[other];
  const int j = this->edge_towards(other, triangle);
  const int a = here.vertex[edge];
  const int b = here.vertex[next(edge)];
  const int c = here.vertex[previous(edge)];
  const int d = beyond.vertex[j];
  const int nca = here.neighbour[next(edge)];
  const int nab = here.neighbour[previous(edge)];
  const int nbd = beyond.neighbour[next(j)];
  const int ndc = beyond.neighbour[previous(j)];
  this->relink(nbd, other, triangle);
  this->relink(nca, triangle, other);
  this->set(triangle, { { a, b, d } }, { { nbd, other, nab } },
    { { beyond.kind[next(j)], EdgeKind::Free, here.kind[previous(edge)] } });
  this->set(other, { { a, d, c } }, { { ndc, nca, triangle } },
    { { beyond.kind[previous(j)], here.kind[next(edge)], EdgeKind::Free } });
}

void ConstrainedDelaunay::legalize()
{
  while (!this->Stack.empty())
  {
    const auto [triangle, edge] = this->Stack.back();
    this->Stack.pop_back();
    if (this->should_flip(triangle, edge))
    {
      const int other = this->Triangles[triangle].neighbour[edge];
      this->flip(triangle, edge);
      this->Stack.insert(this->Stack.end(),
        { { { triangle, 0 } }, { { triangle, 2 } }, { { other, 0 } }, { { other, 1 } } });
    }
  }
}

bool ConstrainedDelaunay::find_edge(int from, int to, int& triangle, int& edge) const
{
  const int start = this->OfVertex[from];
  int at = start;
  bool backwards = false;
  do
  {
    const Triangle& here = this->Triangles[at];
    const int i = static_cast<int>(
      std::find(here.vertex.begin(), here.vertex.end(), from) - here.vertex.begin());
    if (here.vertex[next(i)] == to)
    {
      triangle = at;
      edge = previous(i);
      return true;
    }
    at = here.neighbour[backwards ? previous(i) : next(i)];
    if (at < 0 && !backwards) // a corner of the triangle around all: the other way round
    {
      backwards = true;
      const Triangle& first = this->Triangles[start];
      const int k = static_cast<int>(
        std::find(first.vertex.begin(), first.vertex.end(), from) - first.vertex.begin());
      at = first.neighbour[previous(k)];
    }
  } while (at >= 0 && at != start);
  return false;
}

void ConstrainedDelaunay::mark(int from, int to, EdgeKind kind)
{
  for (const auto& [a, b] : { std::array<int, 2>{ from, to }, std::array<int, 2>{ to, from } })
  {
    int triangle = -1;
    int edge = -1;
    if (this->find_edge(a, b, triangle, edge))
    {
      EdgeKind& marked = this->Triangles[triangle].kind[edge];
      marked = std::max(marked, kind);
    }
  }
}

int ConstrainedDelaunay::crossed(int from, int to, std::vector<std::array<int, 2>>& edges) const
{
  const auto on_ray = [&](int vertex)
  {
    return this->turn(from, to, vertex) == 0 &&
      (this->Points[vertex] - this->Points[from]).dot(this->Points[to] - this->Points[from]) > 0.0;
  };
  // === The triangle at `from` that the segment leaves through
  int at = this->OfVertex[from];
  int right = -1;
  int left = -1;
  int beyond = -1;
  for (;;)
  {
    const Triangle& here = this->Triangles[at];
    const int i = static_cast<int>(
      std::find(here.vertex.begin(), here.vertex.end(), from) - here.vertex.begin());
    right = here.vertex[next(i)];
    left = here.vertex[previous(i)];
    if (right == to || on_ray(right))
    {
      return right;
    }
    if (left == to || on_ray(left))
    {
      return left;
    }
    if (this->turn(from, to, right) < 0 && this->turn(from, to, left) > 0)
    {
      if (here.kind[i] != EdgeKind::Free)
      {
        throw CrossingEdges({ { from, to } }, { { right, left } });
      }
      beyond = here.neighbour[i];
      break;
    }
    at = here.neighbour[next(i)];
  }
  // === Onward through the edges between a right and a left vertex
  edges.push_back({ { right, left } });
  int before = at;
  at = beyond;
  for (;;)
  {
    const Triangle& here = this->Triangles[at];
    const int i = this->edge_towards(at, before);
    const int apex = here.vertex[i];
    const int side = apex == to ? 0 : this->turn(from, to, apex);
    if (side == 0)
    {
      return apex;
    }
    // This triangle is (apex, left, right).
    const int edge = side > 0 ? next(i) : previous(i);
    (side > 0 ? left : right) = apex;
    if (here.kind[edge] != EdgeKind::Free)
    {
      throw CrossingEdges({ { from, to } }, { { right, left } });
    }
    edges.push_back({ { right, left } });
    before = at;
    at = here.neighbour[edge];
  }
}

void ConstrainedDelaunay::constrain(int from, int to, EdgeKind kind)
{
  while (from != to)
  {
    std::vector<std::array<int, 2>> edges;
    const int end = this->crossed(from, to, edges);
    std::deque<std::array<int, 2>> waiting(edges.begin(), edges.end());
    std::vector<std::array<int, 2>> made;
    while (!waiting.empty())
    {
      const std::array<int, 2> pair = waiting.front();
      waiting.pop_front();
      int triangle = -1;
      int edge = -1;
      this->find_edge(pair[0], pair[1], triangle, edge);
      const Triangle& here = this->Triangles[triangle];
      const int beyond = here.neighbour[edge];
      const int a = here.vertex[edge];
      const int d = this->Triangles[beyond].vertex[this->edge_towards(beyond, triangle)];
      if (this->turn(a, here.vertex[next(edge)], d) <= 0 ||
        this->turn(a, d, here.vertex[previous(edge)]) <= 0)
      {
        waiting.push_back(pair); // not convex: another flip comes first
        continue;
      }
      this->flip(triangle, edge);
      const bool across = a != from && a != end && d != from && d != end &&
        this->turn(from, end, a) * this->turn(from, end, d) < 0;
      if (across)
      {
        waiting.push_back({ { a, d } });
      }
      else
      {
        made.push_back({ { a, d } });
      }
    }
    this->mark(from, end, kind);
    for (const std::array<int, 2>& pair : made)
    {
      int triangle = -1;
      int edge = -1;
      if (this->find_edge(pair[0], pair[1], triangle, edge))
      {
        this->Stack.push_back({ { triangle, edge } });
      }
    }
    this->legalize();
    from = end;
  }
}

} // namespace footpoint
