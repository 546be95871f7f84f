// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/tessellation/constrained_delaunay.h"
#include "footpoint/tessellation/edge_joining.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace footpoint
{

/// The triangles over what is kept of a surface's domain.
struct PatchMesh
{
  std::vector<Parameter<2>> places;          ///< local parameters of the vertices
  std::vector<int> nodes;                    ///< of the joined edges; −1 inside
  std::vector<std::array<int, 3>> triangles; ///< counter-clockwise in (u, v), three different nodes
  std::size_t too_coarse = 0; ///< triangles that miss the rule and cannot be divided further
  /// Not empty: nothing else is set, since chords of these groups of edges cross each other.
  std::vector<int> crossing_groups;
};

/// Triangulates a face in the plane of its parameters: a constrained Delaunay triangulation of its
/// sampled edges, then of the corners of its cells, then of middles of edges until all triangles
/// keep to the rule. Kinks are edges, so that no triangle lies on both sides of one.
class PatchTriangulation
{
public:
  /// \param region null: all is kept
  /// All but the rule outlive this.
  PatchTriangulation(
    const SurfaceBounds& bounds, const TrimRegion* region, const SamplingRule& rule);

  /// \param samples for each of the edges
  PatchMesh run(const std::vector<const PatchEdge*>& edges,
    const std::vector<const EdgeSamples*>& samples, const std::vector<SurfaceCells>& cells);

private:
  struct NamedPlace
  {
    Parameter<2> place;
    int vertex;
  };
  struct Evaluated
  {
    Vector3 point;
    Vector3 normal;
    bool valid = false; ///< for all triangles at the vertex
  };

  int add(const Parameter<2>& place, int node);
  int add_boundary(const Parameter<2>& place, int node);
  void constrain_boundary(
    const std::vector<const PatchEdge*>& edges, const std::vector<const EdgeSamples*>& samples);
  void constrain_kinks(const std::vector<SurfaceCells>& cells);
  void classify();
  bool is_kept(const std::vector<int>& component) const;
  void add_corners(const std::vector<SurfaceCells>& cells);
  bool is_clear(const ConstrainedDelaunay::Place& at, const Parameter<2>& place,
    const Parameter<2>& cell) const;
  void refine();
  const Evaluated& evaluated(int vertex, const Parameter<2>& middle);
  bool keeps_to_rule(int triangle);
  bool divide(int triangle);
  int pole_node(const Parameter<2>& place) const;
  std::array<Parameter<2>, 3> corners(int triangle) const;
  bool is_collapsed(const std::array<int, 3>& vertex) const;
  Eigen::Vector2d unit(const Parameter<2>& place) const;
  PatchMesh finish() const;

  const SurfaceBounds& Bounds;
  const Surface& Base;
  const TrimRegion* Region;
  SamplingRule Rule;
  Parameter<2> Length;
  ConstrainedDelaunay Mesh;
  std::vector<Parameter<2>> Places; ///< of the mesh's vertices
  std::vector<int> Nodes;
  std::map<int, std::vector<NamedPlace>> OfNode;  ///< vertices on the boundary
  std::map<int, std::vector<int>> GroupsOfVertex; ///< of edges, for messages of crossings
  std::array<std::array<int, 2>, 2> Poles{ { { { -1, -1 } }, { { -1, -1 } } } }; ///< nodes
  std::vector<Evaluated> Known; ///< of the mesh's vertices
  std::size_t TooCoarse = 0;
};

} // namespace footpoint
