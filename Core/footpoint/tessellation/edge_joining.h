// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/common/execution.h"
#include "footpoint/tessellation/trim_edge.h"

#include <vector>

namespace footpoint
{

/// An edge of a patch of a face.
struct PatchEdge
{
  int patch; ///< to which it belongs
  const SurfaceBounds* bounds;
  double tolerance; ///< of the face, model units
  TrimEdge edge;
};

/// Places of an edge in ascending order, from its start to its end, and their numbers among all
/// nodes.
struct EdgeSamples
{
  std::vector<double> parameters;
  std::vector<int> nodes;
  std::vector<int> groups; ///< of the piece between a sample and the next
};

/// Which edges of all faces run along each other, found by distance, and one sampling for those
/// that do.
///
/// Ends of edges that are no farther apart than the tolerances of their faces (at least `sewing`)
/// become one node, and cut other edges that pass there. Pieces between the same two nodes that run
/// along each other form a group. The finest of a group is sampled, and the others are where they
/// are nearest to its points; where a chord is too long for one of them all get another sample.
class EdgeJoining
{
public:
  /// \param edges outlive this
  /// \param sewing, gap model units; arcs that close gaps in loops and are no longer than `gap`
  /// become
  ///               one node
  EdgeJoining(const std::vector<PatchEdge>& edges, double sewing, double gap);

  /// Samples all groups, at first, and later those that were refined; the nodes of others stay.
  void sample(const SamplingRule& rule, const Execution& execution);
  /// Makes a group's chords half as long at the next sampling.
  void refine(int group);

  const std::vector<Vector3>& nodes() const { return this->Nodes; }
  const std::vector<EdgeSamples>& samples() const { return this->Samples; }

private:
  struct Cut
  {
    double t;
    int node;
  };
  struct Piece
  {
    std::size_t edge;
    double from;
    double to;
    int start; ///< nodes
    int end;
    bool collapsed; ///< all of it is its node
  };
  struct Group
  {
    std::vector<std::size_t> pieces;
    int level = 0;
    bool stale = true;
    int first_node = 0;                          ///< of the points
    std::vector<Vector3> points;                 ///< strictly inside
    std::vector<std::vector<double>> parameters; ///< for each piece, of the points
  };

  double tolerance(std::size_t a, std::size_t b) const;
  void cut_at_ends();
  void cut_where_others_end();
  void make_pieces();
  void group_pieces();
  bool run_along(const Piece& a, const Piece& b) const;
  void sample_group(Group& group, const SamplingRule& rule) const;
  bool map(const Group& group, std::size_t member, const std::vector<Vector3>& points,
    std::vector<double>& parameters) const;

  const std::vector<PatchEdge>& Edges;
  double Sewing;
  double Gap;
  std::vector<std::vector<Cut>> Cuts; ///< of each edge, ascending
  std::vector<Vector3> Vertices;      ///< the nodes at ends
  std::vector<Piece> Pieces;
  std::vector<std::vector<std::size_t>> PiecesOfEdge;
  std::vector<Group> Groups;
  std::vector<int> GroupOfPiece;
  std::vector<Vector3> Nodes;
  std::vector<EdgeSamples> Samples;
};

} // namespace footpoint
