// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/common/execution.h"
#include "footpoint/model/model.h"
#include "footpoint/search/box_tree.h"
#include "footpoint/trims/edge_curve.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace footpoint
{

/// Borders of faces that are no farther apart than this fraction of the model's size are one, also
/// where no face has a tolerance: files are written with six digits and more.
constexpr double kSewing = 1e-6;

/// Sides of the surfaces of a model that are neither closed, nor one point, nor shared with another
/// patch of the face: its borders, where it is known that no two of them meet.
std::int64_t number_of_open_sides(const Model& model);

/// Which faces of a model meet at their borders, found by distance, so that distances from edges
/// and vertices get their sign: of the sum of the normals of all faces that meet there, each
/// weighted by the angle that the face fills (J. A. Bærentzen and H. Aanæs 2005). Built once; const
/// and thread-safe.
class FaceNeighbours
{
public:
  /// \param model outlives this \param size of the model
  /// \param execution whose threads share the work of building
  FaceNeighbours(const Model& model, double size, const Execution& execution);

  /// The weighted sum at a point on the border of a face; zero where no other border meets there.
  Vector3 pseudonormal(const Vector3& point, int face) const;

  /// Borders of faces without a neighbour in their middle or, where they have kinks, in the middles
  /// of up to eight of their smooth parts: 0 on a closed solid.
  std::int64_t number_of_open_edges() const { return this->OpenEdges; }

private:
  /// An edge of a face.
  struct Rim
  {
    int face;
    std::shared_ptr<const EdgeCurve> curve;
  };
  /// A part of a rim, in a box of the tree.
  struct Part
  {
    std::size_t rim;
    double lower; ///< parameters of the rim's curve
    double upper;
    Vector3 start; ///< relative to the centre of the rim's curve
    Vector3 end;
    bool straight;
  };
  /// Where rims begin or end.
  struct Vertex
  {
    Vector3 point;
    Vector3 pseudonormal;
  };
  /// Where a rim passes through a point.
  struct Passage
  {
    std::size_t rim;
    double t;
    double distance;
  };

  /// All rims that pass through a point, to within a reach.
  struct Meeting
  {
    Vector3 point;
    double reach;
    std::vector<Passage> passages;
  };

  void add_rims(const Model& model, const Execution& execution);
  void add_parts(double size, const Execution& execution);
  void add_vertices(const Execution& execution);
  void count_open_edges(const Execution& execution);
  bool is_open(std::size_t rim) const;
  Meeting meeting(const Vector3& point, int face) const;
  Vector3 weighted_normals(const Meeting& meeting) const;
  std::vector<Passage> passages(const Vector3& point, int face, double reach) const;
  Passage nearest_on(const Part& part, const Vector3& point, double tolerance) const;
  Passage descend(const Part& part, const Vector3& local, double fraction) const;
  Vector3 normal(std::size_t rim, double t) const;
  bool add_ends(const Meeting& meeting, const Passage& passage, std::vector<Passage>& arriving,
    std::vector<Passage>& leaving) const;
  /// Of all rims of one face that begin or end at a vertex: the normals times the angles.
  Vector3 wedges(const std::vector<Passage>& arriving, const std::vector<Passage>& leaving) const;
  Vector3 wedge(const Passage& arriving, const Passage& leaving) const;

  std::vector<Rim> Rims;
  std::vector<bool> Reversed; ///< of each face
  std::vector<double> Tolerances; ///< of each face, in model units
  double LargestTolerance = 0.0;
  double Sewing;
  double FirstReach;
  std::vector<Part> Parts;
  BoxTree Tree;
  std::vector<Vertex> Vertices;
  BoxTree VertexTree;
  Vector3 Centre = Vector3::Zero();
  std::int64_t OpenEdges = 0;
};

} // namespace footpoint
