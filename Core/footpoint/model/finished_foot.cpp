// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/model/inverter_implementation.h"

#include "footpoint/model/edge_feet.h"
#include "footpoint/model/evaluation.h"

#include <algorithm>

namespace footpoint
{

Vector3 PointInverter::Implementation::direction(const Candidate& candidate) const
{
  const PreparedPatch& prepared = this->Patches[candidate.patch];
  const Patch& patch = *prepared.patch;
  const bool reversed = this->Prepared->model()[prepared.face].reversed;
  if (prepared.edge)
  {
    const PatchFoot foot = on_surface(*prepared.edge, candidate.foot);
    const Vector3 normal = mean_normal(prepared.edge->surface(), foot.local, foot.sides);
    return reversed ? Vector3(-normal) : normal;
  }
  if (patch.curve)
  {
    return unit_tangent(
      *patch.curve, candidate.foot.local.head<1>(), candidate.foot.sides.head<1>());
  }
  const Vector3 normal = mean_normal(*patch.surface, candidate.foot.local, candidate.foot.sides);
  return reversed ? Vector3(-normal) : normal;
}

/// A foot on borders that other patches of the face continue is interior, or on a kink, and its
/// normal is the mean of theirs.
void PointInverter::Implementation::settle_shared_border(Foot& foot, const Vector3& point,
  const Candidate& candidate, const std::vector<Candidate>& others) const
{
  const PreparedPatch& prepared = this->Patches[candidate.patch];
  if ((foot.type != FootType::Edge && foot.type != FootType::Vertex) || prepared.edge ||
    !prepared.shared.cover(*prepared.patch, candidate.foot.local))
  {
    return;
  }
  bool orthogonal = prepared.search->orthogonal(point, candidate.foot);
  std::vector<std::size_t> seen{ candidate.patch };
  for (const Candidate& other : others)
  {
    if (this->same(candidate, other) &&
      std::find(seen.begin(), seen.end(), other.patch) == seen.end())
    {
      seen.push_back(other.patch);
      orthogonal = orthogonal && this->Patches[other.patch].search->orthogonal(point, other.foot);
      foot.direction += foot.on_curve ? Vector3(Vector3::Zero()) : this->direction(other);
    }
  }
  if (!foot.direction.isZero())
  {
    foot.direction.normalize();
  }
  foot.type = orthogonal ? FootType::Interior : FootType::Kink;
}

/// The sign of the distance from an edge or a vertex, where the faces that meet there decide, or
/// from a pole inside a face.
void PointInverter::Implementation::settle_sign(Foot& foot, const Vector3& point) const
{
  const FaceNeighbours* neighbours = this->Prepared->neighbours();
  Vector3 normal = Vector3::Zero();
  if (foot.type == FootType::Degenerate)
  {
    normal = this->Prepared->pole_normals().at(foot.face, foot.parameter);
  }
  else if (neighbours && (foot.type == FootType::Edge || foot.type == FootType::Vertex))
  {
    normal = neighbours->pseudonormal(foot.point, foot.face);
  }
  if (!normal.isZero(0.0))
  {
    foot.signed_distance =
      (point - foot.point).dot(normal) < 0.0 ? -foot.distance : foot.distance;
  }
}

Foot PointInverter::Implementation::finish(
  const Vector3& point, const Candidate& candidate, const std::vector<Candidate>& others) const
{
  const PreparedPatch& prepared = this->Patches[candidate.patch];
  const PatchFoot found =
    prepared.edge ? on_surface(*prepared.edge, candidate.foot) : candidate.foot;
  Foot foot;
  foot.status = found.converged ? Status::Converged : Status::NotConverged;
  foot.type = found.type;
  foot.iterations = found.iterations;
  foot.face = prepared.face;
  foot.on_curve = prepared.patch->curve && !prepared.edge;
  foot.parameter = found.parameter;
  foot.point = found.point;
  foot.distance = found.distance;
  foot.direction = this->direction(candidate);
  this->settle_shared_border(foot, point, candidate, others);
  foot.isolated =
    this->wants_lines() ? found.isolated : prepared.search->isolated(point, candidate.foot);
  if (!foot.on_curve)
  {
    const bool below = -found.offset.dot(foot.direction) < 0.0;
    foot.signed_distance = below ? -foot.distance : foot.distance;
    this->settle_sign(foot, point);
  }
  return foot;
}

} // namespace footpoint
