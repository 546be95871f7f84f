// SPDX-License-Identifier: BSD-3-Clause
// What of PatchTriangulation divides triangles until they keep to the rule.
#include "footpoint/tessellation/patch_triangulation.h"

#include "footpoint/model/evaluation.h"

#include <algorithm>
#include <cmath>

namespace footpoint
{
namespace
{

/// Cosine of the angle between a triangle at a pole and the normals of its corners, at least.
constexpr double kUpright = 0.5;

/// Triangles that are lower than this part of the tolerance are not divided for the sake of
/// normals.
constexpr double kLow = 0.1;

/// Triangles whose box is smaller, as a part of the domain, are not divided: at rounding.
constexpr double kSmallest = 1e-12;

/// Where normals turn by more the triangles are no graph over a plane.
constexpr double kSteepest = 1.0;
constexpr double kSteep = 1e6;

/// No face has more triangles; what asks for them is no shape.
constexpr std::size_t kMostTriangles = std::size_t{ 1 } << 26;

} // namespace

/// The point and the normal at a vertex, of the piece in which the middle of a triangle lies.
const PatchTriangulation::Evaluated& PatchTriangulation::evaluated(
  int vertex, const Parameter<2>& middle)
{
  if (this->Known.size() < this->Places.size())
  {
    this->Known.resize(this->Places.size());
  }
  Evaluated& result = this->Known[vertex];
  if (result.valid)
  {
    return result;
  }
  const Parameter<2>& place = this->Places[vertex];
  Sides<2> sides;
  result.valid = true;
  for (int i = 0; i < 2; ++i)
  {
    sides[i] = middle[i] < place[i] ? Side::Left : Side::Right;
    const std::vector<Break>& breaks = this->Base.direction(i).breaks;
    for (std::size_t k = 1; k + 1 < breaks.size(); ++k)
    {
      // At kinks normals depend on the triangle.
      result.valid = result.valid && breaks[k].at != place[i];
    }
  }
  result.normal = unit_normal(this->Base, place, sides);
  result.point = this->Base.jet(place, sides, 0).point;
  return result;
}

bool PatchTriangulation::keeps_to_rule(int triangle)
{
  const std::array<Parameter<2>, 3> corner = this->corners(triangle);
  const ParameterBox box{ corner[0].cwiseMin(corner[1]).cwiseMin(corner[2]),
    corner[0].cwiseMax(corner[1]).cwiseMax(corner[2]) };
  const bool near = this->Bounds.of_pieces(box).second.chord(corner) <= this->Rule.tolerance;
  const auto& vertex = this->Mesh.triangles()[triangle].vertex;
  const bool at_pole = std::any_of(corner.begin(), corner.end(),
    [this](const auto& place) { return this->pole_node(place) >= 0; });
  if (near && !at_pole && !(this->Rule.angle > 0.0))
  {
    return true;
  }
  const Parameter<2> middle = (corner[0] + corner[1] + corner[2]) / 3.0;
  std::array<Vector3, 3> normal;
  std::array<Vector3, 3> point; // in tolerances: areas of tiny models would be no numbers
  for (int k = 0; k < 3; ++k)
  {
    const Evaluated& evaluated = this->evaluated(vertex[k], middle);
    normal[k] = evaluated.normal;
    point[k] = evaluated.point / this->Rule.tolerance;
  }
  double largest = 0.0;
  double longest = 0.0;
  for (int k = 0; k < 3; ++k)
  {
    longest = std::max(longest, (point[(k + 1) % 3] - point[k]).norm());
  }
  const Vector3 area = (point[1] - point[0]).cross(point[2] - point[0]);
  const bool is_low = area.norm() <= kLow * longest;
  const Vector3 sum = normal[0] + normal[1] + normal[2];
  if (at_pole && !this->is_collapsed(vertex) && !is_low &&
    area.dot(sum) <= kUpright * area.norm() * sum.norm())
  {
    return false; // stands on the surface: a pole and two points of one line towards it
  }
  for (int k = 0; k < 3; ++k)
  {
    const int other = (k + 1) % 3;
    const double angle = angle_between(normal[k], normal[other]);
    largest = std::max(largest, angle);
    if (this->Rule.angle > 0.0 && !is_low && angle > this->Rule.angle * (1.0 + 1e-9) &&
      (point[k] - point[other]).norm() > 1.0)
    {
      return false;
    }
  }
  if (near)
  {
    return true;
  }
  // Where there is no normal nothing tells that triangles are a graph over a plane.
  const bool graph =
    std::none_of(normal.begin(), normal.end(), [](const Vector3& at) { return at.isZero(); });
  const Vector3 up = sum.normalized();
  const DerivativeBounds bounds = this->Bounds.over(box, up);
  // Of this triangle and of those beside it, twice the angle from its middle to its corners.
  const double slope = graph && largest < kSteepest ? std::tan(1.2 * largest) : kSteep;
  return off_triangles(bounds.second.chord(corner), bounds.height.chord(corner), slope,
           this->Rule.tolerance) <= 1.0;
}

bool PatchTriangulation::divide(int triangle)
{
  const ConstrainedDelaunay::Triangle here = this->Mesh.triangles()[triangle];
  const std::array<Parameter<2>, 3> corner = this->corners(triangle);
  const Parameter<2> extent = corner[0].cwiseMax(corner[1]).cwiseMax(corner[2]) -
    corner[0].cwiseMin(corner[1]).cwiseMin(corner[2]);
  if (this->unit(extent).maxCoeff() <= kSmallest || this->Mesh.triangles().size() > kMostTriangles)
  {
    return false;
  }
  const Eigen::Vector2d a = this->unit(corner[1] - corner[0]);
  const Eigen::Vector2d b = this->unit(corner[2] - corner[0]);
  if (std::abs(a[0] * b[1] - a[1] * b[0]) <= kSmallest * kSmallest)
  {
    return false;
  }
  // The longest edge that may be divided, as the surface is bent.
  const ParameterBox box{ corner[0].cwiseMin(corner[1]).cwiseMin(corner[2]),
    corner[0].cwiseMax(corner[1]).cwiseMax(corner[2]) };
  const DerivativeBounds bounds = this->Bounds.over(box);
  const Parameter<2> speed =
    Parameter<2>(bounds.u * bounds.u, bounds.v * bounds.v) * (1e-6 / (1e-300 + this->Base.size()));
  Parameter<2> place = (corner[0] + corner[1] + corner[2]) / 3.0;
  double longest = 0.0;
  for (int i = 0; i < 3; ++i)
  {
    const Parameter<2>& from = corner[(i + 1) % 3];
    const Parameter<2>& to = corner[(i + 2) % 3];
    const Parameter<2> way = (to - from).cwiseAbs();
    const double length = 8.0 * bounds.second.chord(way) + speed.dot(way.cwiseProduct(way));
    if (here.kind[i] != EdgeKind::Fixed && length > longest)
    {
      longest = length;
      place = from + 0.5 * (to - from);
    }
  }
  for (const Parameter<2>& at : { place, Parameter<2>((corner[0] + corner[1] + corner[2]) / 3.0) })
  {
    const ConstrainedDelaunay::Place found = this->Mesh.locate(this->unit(at));
    const ConstrainedDelaunay::Triangle& into = this->Mesh.triangles()[found.triangle];
    const bool fixed = found.on_edge >= 0 && into.kind[found.on_edge] == EdgeKind::Fixed;
    if (found.on_vertex < 0 && into.kept && !fixed)
    {
      this->Mesh.insert(this->unit(at), found);
      this->Places.push_back(at);
      this->Nodes.push_back(this->pole_node(at));
      return true;
    }
  }
  return false;
}

void PatchTriangulation::refine()
{
  std::vector<int> waiting;
  for (std::size_t k = 0; k < this->Mesh.triangles().size(); ++k)
  {
    waiting.push_back(static_cast<int>(k));
  }
  this->Mesh.changed().clear();
  for (std::size_t k = 0; k < waiting.size(); ++k)
  {
    const int triangle = waiting[k];
    if (!this->Mesh.triangles()[triangle].kept || this->keeps_to_rule(triangle))
    {
      continue;
    }
    if (!this->divide(triangle))
    {
      ++this->TooCoarse;
    }
    std::vector<int>& changed = this->Mesh.changed();
    if (!changed.empty())
    {
      changed.push_back(triangle); // also where its neighbour alone was divided
    }
    std::sort(changed.begin(), changed.end());
    changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
    waiting.insert(waiting.end(), changed.begin(), changed.end());
    changed.clear();
  }
}

} // namespace footpoint
