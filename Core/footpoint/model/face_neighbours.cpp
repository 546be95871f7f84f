// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/model/face_neighbours.h"

#include "footpoint/model/evaluation.h"
#include "footpoint/model/shared_borders.h"
#include "footpoint/search/box_traversal.h"

#include <algorithm>
#include <cmath>

namespace footpoint
{
namespace
{

/// To which the boxes around rims are known, as a fraction of the model's size: below every
/// tolerance within which borders meet.
constexpr double kRimTolerance = 1e-8;

/// Places of a bent part of a rim from which the nearest point is looked for.
constexpr int kStarts = 4;

/// Steps of Gauss and Newton to the point of a rim that is nearest to one on it, and the step, as a
/// fraction of the rim's part, after which another one changes nothing.
constexpr int kSteps = 10;
constexpr double kLastStep = 1e-9;

/// Parts of a rim between corners at which a neighbour is looked for: a polyline has as many as
/// segments. What turns by less than this cosine says is no corner but the joint of two spans.
constexpr std::size_t kPartsOfRim = 8;
constexpr double kCornerCosine = 0.999;

/// How far from a point the borders of other faces are looked for at first, as a fraction of the
/// model's size, and by how much farther each time that there are none.
constexpr double kFirstReach = 1e-4;
constexpr double kFarther = 10.0;

/// The four sides of a domain, counter-clockwise from v = 0.
TrimLoop sides_of(const Surface& surface)
{
  const Direction& u = surface.direction(0);
  const Direction& v = surface.direction(1);
  const double at[4][2] = { { u.origin, v.origin }, { u.origin + u.length, v.origin },
    { u.origin + u.length, v.origin + v.length }, { u.origin, v.origin + v.length } };
  TrimLoop loop;
  for (int k = 0; k < 4; ++k)
  {
    Points points = Points::Zero(3, 2);
    for (int i = 0; i < 2; ++i)
    {
      points(i, 0) = at[k][i];
      points(i, 1) = at[(k + 1) % 4][i];
    }
    loop.curves.push_back(std::make_shared<Curve>(KnotVector(1, { 0, 0, 1, 1 }), points));
  }
  return loop;
}

/// Whether another patch of the face continues a side, numbered as in sides_of.
bool is_shared(const SharedBorders& shared, int side)
{
  const bool along_u = side % 2 == 0;
  return shared.shared[along_u ? 1 : 0][side == 1 || side == 2];
}

/// Where a curve turns sharply, its ends included.
std::vector<double> corners_of(const EdgeCurve& curve)
{
  const std::vector<Break>& breaks = curve.direction(0).breaks;
  std::vector<double> corners{ 0.0 };
  for (std::size_t k = 1; k + 1 < breaks.size(); ++k)
  {
    const Parameter<1> at(breaks[k].at);
    const Vector3 before = unit_tangent(curve, at, Sides<1>(Side::Left));
    const Vector3 after = unit_tangent(curve, at, Sides<1>(Side::Right));
    if (before.dot(after) < kCornerCosine)
    {
      corners.push_back(breaks[k].at);
    }
  }
  corners.push_back(curve.direction(0).length);
  return corners;
}

} // namespace

std::int64_t number_of_open_sides(const Model& model)
{
  std::int64_t count = 0;
  for (const Face& face : model)
  {
    const std::vector<SharedBorders> shared = find_shared_borders(face);
    for (std::size_t k = 0; k < face.patches.size(); ++k)
    {
      const ParametricSurface* surface = face.patches[k].surface.get();
      for (int i = 0; surface && i < 2; ++i)
      {
        const Direction& direction = surface->direction(i);
        for (int end = 0; end < 2; ++end)
        {
          count += !direction.closed && !direction.collapsed[end] && !shared[k].shared[i][end];
        }
      }
    }
  }
  return count;
}

FaceNeighbours::FaceNeighbours(const Model& model, double size, const Execution& execution)
  : Sewing(kSewing * size)
  , FirstReach(kFirstReach * size)
{
  this->add_rims(model, part_of(execution, 0.0, 0.25));
  this->LargestTolerance = this->Tolerances.empty()
    ? this->Sewing
    : *std::max_element(this->Tolerances.begin(), this->Tolerances.end());
  this->add_parts(size, part_of(execution, 0.25, 0.25));
  this->add_vertices(part_of(execution, 0.5, 0.25));
  this->count_open_edges(part_of(execution, 0.75, 0.25));
}

void FaceNeighbours::count_open_edges(const Execution& execution)
{
  std::vector<char> open(this->Rims.size());
  for_each_index(execution, static_cast<std::int64_t>(open.size()), kFacesForThreads,
    [&](std::int64_t k) { open[k] = this->is_open(k) ? 1 : 0; });
  this->OpenEdges = std::count(open.begin(), open.end(), 1);
}

/// Whether no other rim passes the middle of one of its parts between corners, of which a few are
/// looked at.
bool FaceNeighbours::is_open(std::size_t k) const
{
  const Rim& rim = this->Rims[k];
  const std::vector<double> corners = corners_of(*rim.curve);
  const std::size_t parts = corners.size() - 1;
  const std::size_t count = std::min(parts, kPartsOfRim);
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::size_t part = (2 * i + 1) * parts / (2 * count);
    const Parameter<1> middle(0.5 * corners[part] + 0.5 * corners[part + 1]);
    const std::vector<Passage> here =
      this->meeting(rim.curve->centre() + rim.curve->point(middle), rim.face).passages;
    if (std::none_of(
          here.begin(), here.end(), [k](const Passage& passage) { return passage.rim != k; }))
    {
      return true;
    }
  }
  return false;
}

void FaceNeighbours::add_parts(double size, const Execution& execution)
{
  struct PartsOfRim
  {
    std::vector<Part> parts;
    std::vector<Corners> boxes;
  };
  std::vector<PartsOfRim> rims(this->Rims.size());
  this->Centre = rims.empty() ? this->Centre : this->Rims.front().curve->centre();
  for_each_index(execution, static_cast<std::int64_t>(rims.size()), kFacesForThreads,
    [&](std::int64_t k)
    {
      const EdgeCurve& curve = *this->Rims[k].curve;
      const EdgePieces pieces = edge_pieces(curve, kRimTolerance * size);
      const Vector3 around = Vector3::Constant(pieces.error);
      const Vector3 shift = curve.centre() - this->Centre;
      for (const BezierPiece<1>& piece : pieces.pieces)
      {
        const Corners box = bounding_box<1>(piece);
        rims[k].boxes.push_back({ { box[0] + shift - around, box[1] + shift + around } });
        const auto last = piece.control.cols() - 1;
        rims[k].parts.push_back({ static_cast<std::size_t>(k), piece.lower(0), piece.upper(0),
          piece.control.col(0).head<3>() / piece.control(3, 0),
          piece.control.col(last).head<3>() / piece.control(3, last), piece.degree[0] == 1 });
      }
    });
  AlignedVector<Corners> boxes;
  for (const PartsOfRim& rim : rims)
  {
    boxes.insert(boxes.end(), rim.boxes.begin(), rim.boxes.end());
    this->Parts.insert(this->Parts.end(), rim.parts.begin(), rim.parts.end());
  }
  this->Tree = BoxTree(boxes, execution);
}

/// The ends of all rims, those that are one by their files' digits once.
void FaceNeighbours::add_vertices(const Execution& execution)
{
  std::vector<Vector3> points;
  AlignedVector<Corners> boxes;
  for (const Rim& rim : this->Rims)
  {
    for (const double t : { 0.0, rim.curve->direction(0).length })
    {
      points.push_back(rim.curve->centre() + rim.curve->point(Parameter<1>(t)));
      boxes.push_back({ { points.back() - this->Centre, points.back() - this->Centre } });
    }
  }
  const BoxTree ends(boxes, execution);
  std::vector<bool> done(points.size(), false);
  std::vector<int> faces;
  boxes.clear();
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    if (done[k])
    {
      continue;
    }
    const Vector3 at = points[k] - this->Centre;
    visit_near_boxes(
      ends, at, [this] { return this->Sewing; },
      [&](std::int32_t index) { done[index] = true; });
    this->Vertices.push_back({ points[k], Vector3::Zero() });
    faces.push_back(this->Rims[k / 2].face);
    boxes.push_back({ { at, at } });
  }
  for_each_index(execution, static_cast<std::int64_t>(faces.size()), kFacesForThreads,
    [&](std::int64_t k)
    {
      Vertex& vertex = this->Vertices[k];
      vertex.pseudonormal = this->weighted_normals(this->meeting(vertex.point, faces[k]));
    });
  this->VertexTree = BoxTree(boxes, execution);
}

void FaceNeighbours::add_rims(const Model& model, const Execution& execution)
{
  std::vector<std::vector<Rim>> rims(model.size());
  for (const Face& face : model)
  {
    this->Reversed.push_back(face.reversed);
    this->Tolerances.push_back(std::max(face.tolerance, this->Sewing));
  }
  for_each_index(execution, static_cast<std::int64_t>(model.size()), kFacesForThreads,
    [&](std::int64_t f)
    {
      const Face& face = model[f];
      const std::vector<SharedBorders> shared = find_shared_borders(face);
      for (std::size_t i = 0; i < face.patches.size(); ++i)
      {
        const auto surface = std::dynamic_pointer_cast<const Surface>(face.patches[i].surface);
        if (!surface)
        {
          continue;
        }
        const auto region = face.region
          ? face.region
          : std::make_shared<const TrimRegion>(
              std::vector<TrimLoop>{ sides_of(*surface) }, *surface, 0.0);
        for (const auto& edge : edge_curves(surface, *region, EdgeArcs::NoSeams))
        {
          if (face.region || !is_shared(shared[i], edge->arcs().front().curve))
          {
            rims[f].push_back({ static_cast<int>(f), edge });
          }
        }
      }
    });
  for (const std::vector<Rim>& of_face : rims)
  {
    this->Rims.insert(this->Rims.end(), of_face.begin(), of_face.end());
  }
}

/// From where the chord is nearest and, where that leads away from the point on a part that is not
/// straight, from other places.
FaceNeighbours::Passage FaceNeighbours::nearest_on(
  const Part& part, const Vector3& point, double tolerance) const
{
  const Vector3 local = point - this->Rims[part.rim].curve->centre();
  const Vector3 chord = part.end - part.start;
  const double squared = chord.squaredNorm();
  const double along = squared > 0.0 ? (local - part.start).dot(chord) / squared : 0.0;
  Passage best = this->descend(part, local, std::clamp(along, 0.0, 1.0));
  for (int k = 0; k < kStarts && best.distance > tolerance && !part.straight; ++k)
  {
    const Passage other = this->descend(part, local, (k + 0.5) / kStarts);
    best = other.distance < best.distance ? other : best;
  }
  return best;
}

FaceNeighbours::Passage FaceNeighbours::descend(
  const Part& part, const Vector3& local, double fraction) const
{
  const EdgeCurve& curve = *this->Rims[part.rim].curve;
  const double length = part.upper - part.lower;
  double t = part.lower + fraction * length;
  Passage result{ part.rim, t, INFINITY };
  for (int k = 0; k < kSteps; ++k)
  {
    const Sides<1> side(t >= part.upper ? Side::Left : Side::Right);
    const Jet<1> jet = curve.jet(Parameter<1>(t), side, 1);
    const Vector3 off = jet.point - local;
    const double distance = off.norm();
    result = distance < result.distance ? Passage{ part.rim, t, distance } : result;
    const double speed = jet.first.squaredNorm();
    // Where the curve passes through the point, the curvature does not matter.
    const double step = speed > 0.0 ? -off.dot(jet.first.col(0)) / speed : 0.0;
    const double next = std::clamp(t + step, part.lower, part.upper);
    if (std::abs(next - t) <= kLastStep * length)
    {
      break;
    }
    t = next;
  }
  return result;
}

std::vector<FaceNeighbours::Passage> FaceNeighbours::passages(
  const Vector3& point, int face, double reach) const
{
  std::vector<Passage> result;
  visit_near_boxes(
    this->Tree, point - this->Centre, [reach] { return reach; },
    [&](std::int32_t index)
    {
      const Part& part = this->Parts[index];
      const double within = std::min(
        reach, std::max(this->Tolerances[face], this->Tolerances[this->Rims[part.rim].face]));
      const Passage here = this->nearest_on(part, point, within);
      if (here.distance > within)
      {
        return;
      }
      const auto known = std::find_if(result.begin(), result.end(),
        [&](const Passage& passage) { return passage.rim == part.rim; });
      if (known == result.end())
      {
        result.push_back(here);
      }
      else if (here.distance < known->distance)
      {
        *known = here;
      }
    });
  // In the order of the rims, not of the tree.
  std::sort(result.begin(), result.end(),
    [](const Passage& a, const Passage& b) { return a.rim < b.rim; });
  return result;
}

/// Within a small reach first, since a large tolerance is no reason to take an edge for its end;
/// where no other face is met, farther, up to the tolerances.
FaceNeighbours::Meeting FaceNeighbours::meeting(const Vector3& point, int face) const
{
  Meeting result;
  result.point = point;
  result.reach = std::min(this->Tolerances[face], this->FirstReach);
  for (;;)
  {
    result.passages = this->passages(point, face, result.reach);
    const bool met = std::any_of(result.passages.begin(), result.passages.end(),
      [&](const Passage& passage) { return this->Rims[passage.rim].face != face; });
    if (met || result.reach >= this->LargestTolerance)
    {
      return result;
    }
    result.reach = std::min(kFarther * result.reach, this->LargestTolerance);
  }
}

} // namespace footpoint
