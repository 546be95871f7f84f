// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/model/shared_borders.h"

#include <algorithm>

namespace footpoint
{
namespace
{

/// A border by its ends and its middle; for a curve all three are the end point.
struct Border
{
  std::size_t patch;
  int direction;
  int end;
  double tolerance;
  std::array<Vector3, 3> points;
};

Border surface_border(const ParametricSurface& surface, std::size_t patch, int direction, int end)
{
  Border border{ patch, direction, end, kClosureTolerance * surface.size(), {} };
  const int along = 1 - direction;
  for (int k = 0; k < 3; ++k)
  {
    Parameter<2> t;
    t(direction) = end == 0 ? 0.0 : surface.direction(direction).length;
    t(along) = 0.5 * k * surface.direction(along).length;
    border.points[k] = surface.centre() + surface.point(t);
  }
  return border;
}

Border curve_border(const ParametricCurve& curve, std::size_t patch, int end)
{
  const Parameter<1> t(end == 0 ? 0.0 : curve.direction(0).length);
  const Vector3 point = curve.centre() + curve.point(t);
  return { patch, 0, end, kClosureTolerance * curve.size(), { point, point, point } };
}

bool coincide(const Border& a, const Border& b)
{
  const double tolerance = std::max(a.tolerance, b.tolerance);
  auto close = [tolerance](const Vector3& p, const Vector3& q)
  { return (p - q).norm() <= tolerance; };
  const bool forward = close(a.points[0], b.points[0]) && close(a.points[2], b.points[2]);
  const bool backward = close(a.points[0], b.points[2]) && close(a.points[2], b.points[0]);
  return close(a.points[1], b.points[1]) && (forward || backward);
}

} // namespace

bool SharedBorders::cover(const Patch& patch, const Parameter<2>& local) const
{
  const int directions = patch.curve ? 1 : 2;
  bool covered = false;
  for (int i = 0; i < directions; ++i)
  {
    const Direction& direction =
      patch.curve ? patch.curve->direction(0) : patch.surface->direction(i);
    for (const Break& line : direction.breaks)
    {
      const bool end = line.at == 0.0 || line.at == direction.length;
      if (local(i) != line.at || !(end ? !direction.closed : line.gap))
      {
        continue;
      }
      // The side of a gap inside the patch is a border that nothing continues.
      if (!end || !this->shared[i][line.at == 0.0 ? 0 : 1])
      {
        return false;
      }
      covered = true;
    }
  }
  return covered;
}

std::vector<SharedBorders> find_shared_borders(const Face& face)
{
  std::vector<SharedBorders> result(face.patches.size());
  if (face.patches.size() < 2)
  {
    return result;
  }
  std::vector<Border> borders;
  for (std::size_t k = 0; k < face.patches.size(); ++k)
  {
    const Patch& patch = face.patches[k];
    for (int end = 0; end < 2; ++end)
    {
      if (patch.curve)
      {
        borders.push_back(curve_border(*patch.curve, k, end));
        continue;
      }
      borders.push_back(surface_border(*patch.surface, k, 0, end));
      borders.push_back(surface_border(*patch.surface, k, 1, end));
    }
  }
  // Sorted by the middle's x, so that only neighbours within the tolerance are compared.
  std::sort(borders.begin(), borders.end(),
    [](const Border& a, const Border& b) { return a.points[1].x() < b.points[1].x(); });
  for (std::size_t a = 0; a < borders.size(); ++a)
  {
    for (std::size_t b = a + 1; b < borders.size() &&
         borders[b].points[1].x() - borders[a].points[1].x() <=
           std::max(borders[a].tolerance, borders[b].tolerance);
         ++b)
    {
      if (borders[a].patch != borders[b].patch && coincide(borders[a], borders[b]))
      {
        result[borders[a].patch].shared[borders[a].direction][borders[a].end] = true;
        result[borders[b].patch].shared[borders[b].direction][borders[b].end] = true;
      }
    }
  }
  return result;
}

} // namespace footpoint
