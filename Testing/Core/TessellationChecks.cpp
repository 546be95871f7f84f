// SPDX-License-Identifier: BSD-3-Clause

#include "TessellationChecks.h"

#include <algorithm>
#include <map>
#include <memory>

namespace tessellations
{

Model one(const footpoint::Surface& surface)
{
  return { solids::whole(surface) };
}

Model one(const footpoint::Curve& curve)
{
  footpoint::Face face;
  face.patches.push_back({ std::make_shared<footpoint::Curve>(curve), nullptr });
  return { face };
}

double distance(const Vector3& p, const Vector3& a, const Vector3& b, const Vector3& c)
{
  const Vector3 ab = b - a;
  const Vector3 ac = c - a;
  const double d1 = ab.dot(p - a);
  const double d2 = ac.dot(p - a);
  const double d3 = ab.dot(p - b);
  const double d4 = ac.dot(p - b);
  const double d5 = ab.dot(p - c);
  const double d6 = ac.dot(p - c);
  const double va = d3 * d6 - d5 * d4;
  const double vb = d5 * d2 - d1 * d6;
  const double vc = d1 * d4 - d3 * d2;
  Vector3 foot;
  if (d1 <= 0 && d2 <= 0)
    foot = a;
  else if (d3 >= 0 && d4 <= d3)
    foot = b;
  else if (d6 >= 0 && d5 <= d6)
    foot = c;
  else if (vc <= 0 && d1 >= 0 && d3 <= 0)
    foot = a + d1 / (d1 - d3) * ab;
  else if (vb <= 0 && d2 >= 0 && d6 <= 0)
    foot = a + d2 / (d2 - d6) * ac;
  else if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
    foot = b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
  else
    foot = a + (vb * ab + vc * ac) / (va + vb + vc);
  return (p - foot).norm();
}

std::array<Vector3, 3> corners(const Tessellation& mesh, std::size_t triangle)
{
  const auto& t = mesh.triangles[triangle];
  return { { mesh.points.col(t[0]), mesh.points.col(t[1]), mesh.points.col(t[2]) } };
}

double largest_distance(const Model& model, const Tessellation& mesh, double limit, int samples)
{
  double largest = 0.0;
  for (std::size_t k = 0; k < mesh.triangles.size() && largest <= limit; ++k)
  {
    const auto& surface =
      *model[static_cast<std::size_t>(mesh.triangle_faces[k])].patches.front().surface;
    const auto [a, b, c] = corners(mesh, k);
    const auto& t = mesh.triangles[k];
    for (int i = 0; i <= samples; ++i)
    {
      for (int j = 0; i + j <= samples; ++j)
      {
        const double x = static_cast<double>(i) / samples;
        const double y = static_cast<double>(j) / samples;
        Parameter<2> local = surface.to_local(mesh.parameters.col(t[0]) * (1 - x - y) +
          mesh.parameters.col(t[1]) * x + mesh.parameters.col(t[2]) * y);
        for (int d = 0; d < 2; ++d)
        {
          local[d] = std::clamp(local[d], 0.0, surface.direction(d).length);
        }
        const Vector3 point = surface.centre() + surface.point(local);
        double least = distance(point, a, b, c);
        for (std::size_t m = 0; m < mesh.triangles.size() && least > limit; ++m)
        {
          const auto [p, q, r] = corners(mesh, m);
          least = std::min(least, distance(point, p, q, r));
        }
        largest = std::max(largest, least);
      }
    }
  }
  return largest;
}

Counts count(const Model& model, const Tessellation& mesh)
{
  Counts counts;
  std::map<std::array<double, 3>, int> numbers;
  std::map<std::array<int, 2>, int> edges;
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k)
  {
    const std::array<Vector3, 3> corner = corners(mesh, k);
    std::array<int, 3> id;
    for (int i = 0; i < 3; ++i)
    {
      const std::array<double, 3> key{ { corner[i].x() + 0.0, corner[i].y() + 0.0,
        corner[i].z() + 0.0 } };
      id[i] = numbers.emplace(key, static_cast<int>(numbers.size())).first->second;
    }
    counts.degenerate += id[0] == id[1] || id[1] == id[2] || id[0] == id[2];
    for (int i = 0; i < 3; ++i)
    {
      const int from = id[i];
      const int to = id[(i + 1) % 3];
      edges[{ { std::min(from, to), std::max(from, to) } }] += from < to ? 1 : -1;
    }
    counts.area += 0.5 * (corner[1] - corner[0]).cross(corner[2] - corner[0]).norm();
    counts.volume += corner[0].dot(corner[1].cross(corner[2])) / 6.0;
    const auto face = static_cast<std::size_t>(mesh.triangle_faces[k]);
    const auto& surface = *model[face].patches.front().surface;
    const auto& t = mesh.triangles[k];
    const Parameter<2> u = mesh.parameters.col(t[1]) - mesh.parameters.col(t[0]);
    const Parameter<2> v = mesh.parameters.col(t[2]) - mesh.parameters.col(t[0]);
    const double area = 0.5 * (u[0] * v[1] - u[1] * v[0]) * (model[face].reversed ? -1.0 : 1.0) /
      (surface.direction(0).length * surface.direction(1).length);
    counts.parameter_area += area;
    counts.least_parameter_area = std::min(counts.least_parameter_area, area);
  }
  for (const auto& edge : edges)
  {
    counts.open += edge.second != 0;
  }
  return counts;
}

TessellationOptions chord(double tolerance, double angle)
{
  TessellationOptions options;
  options.chord_tolerance = tolerance;
  options.angle_tolerance = angle;
  return options;
}

} // namespace tessellations
