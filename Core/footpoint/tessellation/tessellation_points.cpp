// SPDX-License-Identifier: BSD-3-Clause
// What of Tessellator numbers and evaluates the points of the result.
#include "footpoint/tessellation/tessellator.h"

#include "footpoint/model/evaluation.h"
#include "footpoint/model/face_neighbours.h"

#include <algorithm>

namespace footpoint
{

/// The triangles of a patch, with a vertex for each side of a kink.
void Tessellator::add_triangles(
  std::size_t index, std::vector<Vertex>& vertices, Tessellation& result) const
{
  const Work& work = this->Works[index];
  const Surface& surface = work.bounds->surface();
  const auto side_of = [&](const Parameter<2>& place, const Parameter<2>& middle)
  {
    Sides<2> sides;
    for (int i = 0; i < 2; ++i)
    {
      sides[i] = place[i] > middle[i] ? Side::Left : Side::Right;
    }
    return sides;
  };
  const auto is_kink = [&](const Parameter<2>& place)
  {
    for (int i = 0; i < 2; ++i)
    {
      const std::vector<Break>& breaks = surface.direction(i).breaks;
      const auto at = std::lower_bound(
        breaks.begin(), breaks.end(), place[i], [](const Break& b, double x) { return b.at < x; });
      if (at != breaks.end() && at->at == place[i] && at != breaks.begin() &&
        at + 1 != breaks.end())
      {
        return true;
      }
    }
    return false;
  };
  std::vector<bool> kink;
  for (const Parameter<2>& place : work.mesh.places)
  {
    kink.push_back(is_kink(place));
  }
  std::vector<std::array<std::int64_t, 4>> numbers(work.mesh.places.size(), { { -1, -1, -1, -1 } });
  for (const std::array<int, 3>& triangle : work.mesh.triangles)
  {
    Parameter<2> middle = Parameter<2>::Zero();
    for (const int corner : triangle)
    {
      middle += work.mesh.places[corner] / 3.0;
    }
    std::array<std::int64_t, 3> corners;
    for (int i = 0; i < 3; ++i)
    {
      const int corner = triangle[i];
      const Parameter<2>& place = work.mesh.places[corner];
      const Sides<2> sides = side_of(place, middle);
      const int which =
        kink[corner] ? (sides[0] == Side::Left ? 1 : 0) + (sides[1] == Side::Left ? 2 : 0) : 0;
      std::int64_t& number = numbers[corner][which];
      if (number < 0)
      {
        number = static_cast<std::int64_t>(vertices.size());
        vertices.push_back({ index, place, sides, work.mesh.nodes[corner] });
      }
      corners[work.reversed ? 2 - i : i] = number;
    }
    result.triangles.push_back(corners);
    result.triangle_faces.push_back(static_cast<int>(work.face));
  }
}

bool Tessellator::evaluate(Tessellation& result)
{
  // === Number the points
  std::vector<Vertex> vertices;
  for (std::size_t k = 0; k < this->Works.size(); ++k)
  {
    const Work& work = this->Works[k];
    if (!work.problem.empty())
    {
      result.problems.push_back({ work.face, work.problem });
      continue;
    }
    if (work.bounds)
    {
      this->add_triangles(k, vertices, result);
    }
    if (work.mesh.too_coarse > 0)
    {
      result.problems.push_back({ work.face,
        std::to_string(work.mesh.too_coarse) +
          " of its triangles are coarser than the tolerances and cannot be divided" });
    }
    for (const std::vector<CurvePlace>& places : work.lines)
    {
      std::vector<std::int64_t> line;
      for (const CurvePlace& place : places)
      {
        line.push_back(static_cast<std::int64_t>(vertices.size()));
        vertices.push_back({ k, { place.t, 0.0 }, { place.side, Side::Right }, -1 });
      }
      result.lines.push_back(std::move(line));
      result.line_faces.push_back(static_cast<int>(work.face));
    }
  }

  // === Evaluate them
  const auto count = static_cast<Eigen::Index>(vertices.size());
  result.points.resize(3, count);
  result.normals.resize(3, count);
  result.parameters.resize(2, count);
  this->each(vertices.size(),
    [&](std::size_t k)
    {
      const auto at = static_cast<Eigen::Index>(k);
      const Vertex& vertex = vertices[k];
      const Work& work = this->Works[vertex.work];
      if (!work.bounds)
      {
        const auto& curve = *work.patch->curve;
        const Parameter<1> t(vertex.place[0]);
        result.points.col(at) = curve.centre() + curve.jet(t, Sides<1>(vertex.sides[0]), 0).point;
        result.normals.col(at).setZero();
        result.parameters(0, at) = curve.to_domain(t)[0];
        result.parameters(1, at) = 0.0;
        return;
      }
      const Surface& surface = work.bounds->surface();
      result.points.col(at) = surface.centre() + surface.jet(vertex.place, vertex.sides, 0).point;
      if (vertex.node >= 0 &&
        (this->Nodes[vertex.node] - result.points.col(at)).norm() <=
          2.0 * std::max(kSewing * this->Size, work.tolerance) + this->Rule.tolerance)
      {
        result.points.col(at) = this->Nodes[vertex.node]; // elsewhere only across a gap
      }
      result.normals.col(at) =
        unit_normal(surface, vertex.place, vertex.sides) * (work.reversed ? -1.0 : 1.0);
      result.parameters.col(at) = surface.to_domain(vertex.place);
    });
  this->fill_missing_normals(result);
  return this->Run.proceed(1.0);
}

/// Where a surface has no normal, as at the tip of a cusp, that of the triangles around.
void Tessellator::fill_missing_normals(Tessellation& result) const
{
  std::vector<bool> missing(static_cast<std::size_t>(result.normals.cols()), false);
  bool any = false;
  for (const auto& triangle : result.triangles)
  {
    for (const std::int64_t corner : triangle)
    {
      missing[corner] = result.normals.col(corner).isZero();
      any = any || missing[corner];
    }
  }
  if (!any)
  {
    return;
  }
  for (const auto& triangle : result.triangles)
  {
    const Vector3 a = result.points.col(triangle[1]) - result.points.col(triangle[0]);
    const Vector3 b = result.points.col(triangle[2]) - result.points.col(triangle[0]);
    for (const std::int64_t corner : triangle)
    {
      if (missing[corner])
      {
        result.normals.col(corner) += a.cross(b) / (this->Size * this->Size);
      }
    }
  }
  for (Eigen::Index k = 0; k < result.normals.cols(); ++k)
  {
    if (missing[k])
    {
      result.normals.col(k).stableNormalize();
    }
  }
}

} // namespace footpoint
