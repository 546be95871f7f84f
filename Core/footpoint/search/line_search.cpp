// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/search/line_search.h"

#include "footpoint/search/bernstein_zeros.h"
#include "footpoint/search/box_traversal.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace footpoint
{
namespace
{

/// Roundings in a scalar product of differences, with room.
constexpr double kRoundings = 32.0 * 0x1p-53;

/// Two unit vectors orthogonal to a unit vector and to each other.
std::array<Vector3, 2> normals_of(const Vector3& direction)
{
  const Vector3 first = direction.unitOrthogonal();
  return { first, direction.cross(first) };
}

/// Whether a line passes a box within a tolerance: no axis d × e_i separates them.
bool meets(const LineQuery& query, const Vector3& lower, const Vector3& upper)
{
  const Vector3 half = 0.5 * (upper - lower);
  const Vector3 to = 0.5 * (lower + upper) - query.point;
  const double margin = query.tolerance + kRoundings * (to.lpNorm<1>() + half.lpNorm<1>());
  const Vector3& d = query.direction;
  bool met = true;
  for (int i = 0; i < 3; ++i)
  {
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    const double apart = std::abs(to(j) * d(k) - to(k) * d(j));
    met = met && apart <= half(j) * std::abs(d(k)) + half(k) * std::abs(d(j)) + margin;
  }
  return met;
}

void look_at_side(std::int32_t index, const BernsteinSystem& system, int direction, int end,
  BernsteinZeros& zeros, const VisitStart& visit)
{
  const int along = 1 - direction;
  const int columns = system.degree[1] + 1;
  const int step = direction == 0 ? 1 : columns;
  const int first = end == 0 ? 0 : system.degree[direction] * (direction == 0 ? columns : 1);
  BernsteinSystem side;
  side.equations = 2;
  side.margin = system.margin;
  side.degree[along] = system.degree[along];
  for (int e = 0; e < 2; ++e)
  {
    for (int k = 0; k <= system.degree[along]; ++k)
    {
      side.forms[e].push_back(system.forms[e][first + k * step]);
    }
  }
  zeros.find(side,
    [&](const BernsteinZero& zero)
    {
      PieceStart start{ index, zero.at, zero.lower, zero.upper, zero.simple };
      start.t[direction] = start.lower[direction] = start.upper[direction] = end;
      return visit(start);
    });
}

void look_at(const Piece& piece, std::int32_t index, const LineQuery& query,
  const std::array<Vector3, 2>& normals, BernsteinSystem& system, BernsteinZeros& zeros,
  const VisitStart& visit)
{
  system.degree = piece.shape->degree;
  const int size = system.size();
  const Vector3 p = query.point - Vector3(piece.origin[0], piece.origin[1], piece.origin[2]);
  double weight = 0.0;
  for (int k = 0; k < size; ++k)
  {
    weight = std::max(weight, piece.net[4 * k + 3]);
  }
  const double margin = query.tolerance + kRoundings * (piece.reach + p.lpNorm<1>());
  for (int e = 0; e < 2; ++e)
  {
    const double height = normals[e].dot(p);
    system.margin[e] = weight * margin;
    system.forms[e].resize(size);
    for (int k = 0; k < size; ++k)
    {
      const double* x = piece.net + 4 * k;
      system.forms[e][k] =
        normals[e](0) * x[0] + normals[e](1) * x[1] + normals[e](2) * x[2] - height * x[3];
    }
  }
  bool settled = false;
  zeros.find(system,
    [&](const BernsteinZero& zero)
    {
      const bool settles = visit({ index, zero.at, zero.lower, zero.upper, zero.simple });
      settled = settled || (settles && !zero.simple);
      return settles;
    });
  // A line that lies in the piece comes in and goes out over its sides.
  for (int direction = 0; direction < 2 && settled && system.degree[0] > 0; ++direction)
  {
    for (int end = 0; end < 2; ++end)
    {
      look_at_side(index, system, direction, end, zeros, visit);
    }
  }
}

} // namespace

void visit_meeting_starts(
  const DistanceForms& forms, const BoxTree& tree, const LineQuery& query, const VisitStart& visit)
{
  const std::array<Vector3, 2> normals = normals_of(query.direction);
  BernsteinZeros zeros;
  BernsteinSystem system;
  system.equations = 2;
  visit_boxes(
    tree,
    [&query](const Vector3& lower, const Vector3& upper)
    {
      if (!meets(query, lower, upper))
      {
        return std::numeric_limits<double>::infinity();
      }
      return box_distance(lower, upper, query.point);
    },
    [&query] { return std::min(query.limit, std::numeric_limits<double>::max()); },
    [&](std::int32_t index)
    { look_at(forms.pieces()[index], index, query, normals, system, zeros, visit); });
}

} // namespace footpoint
