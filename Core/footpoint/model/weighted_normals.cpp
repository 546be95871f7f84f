// SPDX-License-Identifier: BSD-3-Clause
// Of FaceNeighbours what weighs the normals of faces that meet at a point.
#include "footpoint/model/face_neighbours.h"

#include "footpoint/model/evaluation.h"
#include "footpoint/model/pole_normal.h"
#include "footpoint/search/box_traversal.h"

#include <algorithm>
#include <cmath>

namespace footpoint
{
namespace
{

/// Local parameters of one place that differ by more than this part of the domain are two.
constexpr double kOnePlace = 1e-6;

/// A sum of normals shorter than this tells no side.
constexpr double kNoNormal = 1e-9;

/// The angle by which one direction has to be turned to the left about a normal to become another.
double angle_between(const Vector3& from, const Vector3& to, const Vector3& normal)
{
  const double angle = std::atan2(normal.dot(from.cross(to)), from.dot(to));
  return angle < 0.0 ? angle + 2.0 * std::acos(-1.0) : angle;
}

/// The direction of a seam on the left of a rim that ends there or begins.
Vector3 seam_tangent(const Surface& surface, const Parameter<2>& at, int along, const Vector3& rim,
  const Vector3& normal)
{
  const Vector3 tangent = surface.jet(at, sides_at(surface, at), 1).first.col(along).normalized();
  return normal.dot(rim.cross(tangent)) < 0.0 ? Vector3(-tangent) : tangent;
}

} // namespace

Vector3 FaceNeighbours::normal(std::size_t rim, double t) const
{
  const EdgeCurve& curve = *this->Rims[rim].curve;
  const Side side = t >= curve.direction(0).length ? Side::Left : Side::Right;
  const Parameter<2> at = curve.surface_parameter(t, side);
  return unit_normal(curve.surface(), at, sides_at(curve.surface(), at));
}

/// Between where one rim of a face arrives at a vertex, its end or a kink, and where another one or
/// itself leaves: the angle through the face, which lies on the left of its rims, times the normal;
/// where a seam ends, on both sides of it.
Vector3 FaceNeighbours::wedge(const Passage& arriving, const Passage& leaving) const
{
  const EdgeCurve& in = *this->Rims[arriving.rim].curve;
  const EdgeCurve& out = *this->Rims[leaving.rim].curve;
  const Vector3 back = -unit_tangent(in, Parameter<1>(arriving.t), Sides<1>(Side::Left));
  const Vector3 forth = unit_tangent(out, Parameter<1>(leaving.t), Sides<1>(Side::Right));
  const Surface& surface = out.surface();
  const Parameter<2> from = out.surface_parameter(leaving.t);
  const Parameter<2> to = in.surface_parameter(arriving.t, Side::Left);
  for (int i = 0; i < 2; ++i)
  {
    const Direction& direction = surface.direction(i);
    const double way = to(i) - from(i);
    const int other = 1 - i;
    const int end = from(other) > 0.5 * surface.direction(other).length;
    if (std::abs(way) <= kOnePlace * direction.length)
    {
      continue;
    }
    if (surface.direction(other).collapsed[end])
    {
      return pole_fan(surface, from, i, way);
    }
    if (direction.closed && std::abs(way) >= (1.0 - kOnePlace) * direction.length)
    {
      // The face may be bent along the seam, as a wing is at a sharp trailing edge.
      const Vector3 before = this->normal(arriving.rim, arriving.t);
      const Vector3 after = this->normal(leaving.rim, leaving.t);
      const Vector3 seam_after = seam_tangent(surface, from, other, forth, after);
      const Vector3 seam_before = seam_tangent(surface, to, other, -back, before);
      return angle_between(forth, seam_after, after) * after +
        angle_between(seam_before, back, before) * before;
    }
  }
  const Vector3 normal = this->normal(leaving.rim, leaving.t);
  return angle_between(forth, back, normal) * normal;
}

Vector3 FaceNeighbours::wedges(
  const std::vector<Passage>& arriving, const std::vector<Passage>& leaving) const
{
  Vector3 sum = Vector3::Zero();
  std::vector<bool> used(leaving.size(), false);
  for (const Passage& in : arriving)
  {
    // Of several beginnings that one whose place in the parameters is nearest.
    const EdgeCurve& curve = *this->Rims[in.rim].curve;
    const Parameter<2> at = curve.surface_parameter(in.t, Side::Left);
    std::size_t best = leaving.size();
    double nearest = INFINITY;
    for (std::size_t k = 0; k < leaving.size(); ++k)
    {
      const EdgeCurve& other = *this->Rims[leaving[k].rim].curve;
      const double distance = &other.surface() == &curve.surface()
        ? (other.surface_parameter(leaving[k].t) - at).norm()
        : INFINITY;
      if (!used[k] && (distance < nearest || best == leaving.size()))
      {
        best = k;
        nearest = distance;
      }
    }
    if (best < leaving.size())
    {
      used[best] = true;
      sum += this->wedge(in, leaving[best]);
    }
  }
  return sum;
}

Vector3 FaceNeighbours::pseudonormal(const Vector3& point, int face) const
{
  const Vertex* vertex = nullptr;
  double nearest = this->Sewing;
  visit_near_boxes(
    this->VertexTree, point - this->Centre, [&nearest] { return nearest; },
    [&](std::int32_t index)
    {
      const Vertex& here = this->Vertices[index];
      const double distance = (here.point - point).norm();
      if (distance <= nearest)
      {
        vertex = &here;
        nearest = distance;
      }
    });
  return vertex ? vertex->pseudonormal : this->weighted_normals(this->meeting(point, face));
}

/// Adds where a rim arrives at the point and where it leaves it, at an end or a kink; false where
/// it passes smoothly. What is no longer than the reach between two kinks is one of them.
bool FaceNeighbours::add_ends(const Meeting& meeting, const Passage& passage,
  std::vector<Passage>& arriving, std::vector<Passage>& leaving) const
{
  const EdgeCurve& curve = *this->Rims[passage.rim].curve;
  const std::vector<Break>& breaks = curve.direction(0).breaks;
  const auto is_at = [&](double t)
  {
    const Vector3 here = curve.centre() + curve.point(Parameter<1>(t));
    return (here - meeting.point).norm() <= meeting.reach;
  };
  const auto are_one = [&](const Break& a, const Break& b)
  { return is_at(a.at) && is_at(0.5 * a.at + 0.5 * b.at) && is_at(b.at); };
  const std::size_t last = breaks.size() - 1;
  const std::size_t above = std::min(last,
    static_cast<std::size_t>(
      std::lower_bound(breaks.begin(), breaks.end(), passage.t,
        [](const Break& one, double t) { return one.at < t; }) -
      breaks.begin()));
  std::size_t done = 0; // breaks before this one have been looked at
  bool found = false;
  for (const std::size_t k : { std::size_t(0), std::max<std::size_t>(above, 1) - 1, above, last })
  {
    if (k < done || !is_at(breaks[k].at))
    {
      continue;
    }
    found = true;
    std::size_t from = k;
    std::size_t to = k;
    while (from > done && are_one(breaks[from - 1], breaks[from]))
    {
      --from;
    }
    while (to < last && are_one(breaks[to], breaks[to + 1]))
    {
      ++to;
    }
    done = to + 1;
    if (from > 0)
    {
      arriving.push_back({ passage.rim, breaks[from].at, passage.distance });
    }
    if (to < last)
    {
      leaving.push_back({ passage.rim, breaks[to].at, passage.distance });
    }
  }
  return found;
}

Vector3 FaceNeighbours::weighted_normals(const Meeting& meeting) const
{
  const std::vector<Passage>& here = meeting.passages;
  Vector3 sum = Vector3::Zero();
  const double pi = std::acos(-1.0);
  for (std::size_t first = 0; first < here.size();)
  {
    const int face = this->Rims[here[first].rim].face;
    Vector3 of_face = Vector3::Zero();
    std::vector<Passage> arriving;
    std::vector<Passage> leaving;
    std::size_t next = first;
    for (; next < here.size() && this->Rims[here[next].rim].face == face; ++next)
    {
      if (!this->add_ends(meeting, here[next], arriving, leaving))
      {
        of_face += pi * this->normal(here[next].rim, here[next].t);
      }
    }
    first = next;
    of_face += this->wedges(arriving, leaving);
    sum += this->Reversed[face] ? Vector3(-of_face) : of_face;
  }
  return sum.norm() > kNoNormal ? sum : Vector3(Vector3::Zero());
}

} // namespace footpoint
