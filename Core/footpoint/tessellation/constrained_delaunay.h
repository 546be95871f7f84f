// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace footpoint
{

/// What an edge of a triangulation is.
enum class EdgeKind : std::uint8_t
{
  Free,      ///< may be flipped
  Divisible, ///< stays, as itself or in parts
  Fixed      ///< stays as it is
};

/// Thrown where two edges that both have to stay cross.
class CrossingEdges : public std::runtime_error
{
public:
  CrossingEdges(std::array<int, 2> first, std::array<int, 2> second)
    : std::runtime_error("edges cross")
    , edges{ { first, second } }
  {
  }
  std::array<std::array<int, 2>, 2> edges; ///< by vertices
};

/// A constrained Delaunay triangulation of points in the unit square, built by insertion (C. L.
/// Lawson 1977) and by flips for the constraints (S. W. Sloan 1993). Orientation is exact, so its
/// topology is right whatever the points; circles too close to tell count as empty.
class ConstrainedDelaunay
{
public:
  struct Triangle
  {
    std::array<int, 3> vertex;    ///< counter-clockwise
    std::array<int, 3> neighbour; ///< across the edge opposite to the vertex
    std::array<EdgeKind, 3> kind{ { EdgeKind::Free, EdgeKind::Free, EdgeKind::Free } };
    bool kept = false; ///< the triangles that this one is divided into inherit it
  };

  /// Where a point lies.
  struct Place
  {
    int triangle;
    int on_edge;   ///< 0 … 2, or −1
    int on_vertex; ///< of the triangulation, or −1
  };

  /// \param scale powers of two; circles are those of the plane (scale[0]·x, scale[1]·y)
  explicit ConstrainedDelaunay(const Eigen::Vector2d& scale);

  Place locate(const Eigen::Vector2d& point) const;
  /// Inserts a point. \return its number, or that of the vertex which is there already
  int insert(const Eigen::Vector2d& point) { return this->insert(point, this->locate(point)); }
  /// \pre place is where the point lies, on no vertex
  int insert(const Eigen::Vector2d& point, const Place& place);
  /// Makes the segment between two vertices an edge, or several through the vertices on it.
  /// \throw CrossingEdges where it crosses another one that has to stay
  void constrain(int from, int to, EdgeKind kind);

  /// Those with a vertex below first_vertex() are outside.
  const std::vector<Triangle>& triangles() const { return this->Triangles; }
  void set_kept(int triangle, bool kept) { this->Triangles[triangle].kept = kept; }
  /// The vertices before are corners of a triangle around all.
  static constexpr int first_vertex() { return 3; }
  const Eigen::Vector2d& point(int vertex) const { return this->Points[vertex]; }
  int number_of_vertices() const { return static_cast<int>(this->Points.size()); }
  /// Triangles made or changed since this was last cleared.
  std::vector<int>& changed() { return this->Changed; }

private:
  int turn(int a, int b, int c) const;
  int edge_towards(int triangle, int neighbour) const;
  void set(int triangle, const std::array<int, 3>& vertex, const std::array<int, 3>& neighbour,
    const std::array<EdgeKind, 3>& kind);
  void relink(int triangle, int from, int to);
  bool should_flip(int triangle, int edge) const;
  void flip(int triangle, int edge);
  void legalize();
  /// The triangle with the directed edge, the edge being opposite to its vertex `edge`.
  bool find_edge(int from, int to, int& triangle, int& edge) const;
  void mark(int from, int to, EdgeKind kind);
  /// Crossed edges up to the first vertex on the segment, which is returned.
  int crossed(int from, int to, std::vector<std::array<int, 2>>& edges) const;

  Eigen::Vector2d Scale;
  std::vector<Eigen::Vector2d> Points;
  std::vector<Eigen::Vector2d> Scaled;
  std::vector<Triangle> Triangles;
  std::vector<int> OfVertex;             ///< a triangle at each vertex
  std::vector<std::array<int, 2>> Stack; ///< triangle and edge that may have to be flipped
  std::vector<int> Changed;
  mutable int Last = 0;
};

} // namespace footpoint
