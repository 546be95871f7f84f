// SPDX-License-Identifier: BSD-3-Clause

// The members of CertifiedFeet that tell whether a foot where the parametrization stands still, a
// pole or the line of a cusp, is a minimum of the whole patch: then no descent has to look for a
// way on.
#include "footpoint/model/certified_feet.h"

#include "footpoint/model/plain_conditions.h"
#include "footpoint/solvers/foot_conditions.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace footpoint
{
namespace
{

/// The pieces around a pole add up to the whole of its side within this part of it: roundings.
constexpr double kWholeSide = 1e-13;

} // namespace

bool CertifiedFeet::is_held(const CertifiedAnswer& answer) const
{
  return this->is_held_at_pole(answer) ||
    (answer.count == 2 && this->is_held_at_cusp(answer.feet[0], answer.feet[1]));
}

/// With A = wS and S₀ the pole, (A − S₀ w)_i = Σ_j n B_j(t) w_j (P_j − S₀) across the collapsed
/// side, inwards, for the row of control points P_j beside it: where all of them lie on the far
/// side, E rises in all directions in which the surface leaves the pole.
bool CertifiedFeet::is_held_at_pole(const CertifiedAnswer& answer) const
{
  if (answer.count == 0)
  {
    return false;
  }
  const PieceFoot& first = answer.feet[0];
  const Member& member = this->Members[this->member(first)];
  if (member.patch->curve || member.region)
  {
    return false;
  }
  const auto end_of = [](const PieceFoot& foot, int i) { return foot.t[i] == 1.0 ? 1 : 0; };
  const int across = this->at_pole(first, 0, end_of(first, 0)) ? 0 : 1;
  const int end = end_of(first, across);
  double covered = 0.0;
  for (int k = 0; k < answer.count; ++k)
  {
    const PieceFoot& foot = answer.feet[k];
    const auto before = answer.feet.begin() + k;
    if (this->member(foot) != this->member(first) || !this->at_pole(foot, across, end) ||
      std::any_of(answer.feet.begin(), before,
        [&foot](const PieceFoot& other) { return other.piece == foot.piece; }) ||
      !this->rises_beside(foot, across, end))
    {
      return false;
    }
    covered += this->Search.piece(foot.piece).width[1 - across];
  }
  const double around = member.patch->surface->direction(1 - across).length;
  return std::abs(covered - around) <= kWholeSide * around;
}

/// Whether a side is one point, up to rounding, and all control points next to it lie away from the
/// query.
bool CertifiedFeet::rises_beside(const PieceFoot& foot, int across, int end) const
{
  const Piece& piece = this->Search.piece(foot.piece);
  const int rows = piece.shape->degree[0] + 1;
  const int columns = piece.shape->degree[1] + 1;
  const int last = (across == 0 ? rows : columns) - 1;
  const Vector3 pole = vector(foot.position) - vector(piece.origin);
  const Vector3 offset = vector(foot.offset);
  const double steep = kHeldCosine * std::max(foot.distance, this->Size);
  const double shortest = kStalledSpeed *
    direction_of(*this->Members[piece.patch].patch, across).speed * piece.width[across];
  const auto way_to = [&](int row, int k) -> Vector3
  {
    const int index = across == 0 ? row * columns + k : k * columns + row;
    const Eigen::Map<const Eigen::Vector4d> control(piece.net + 4 * index);
    return control.head<3>() / (piece.shape->rational ? control(3) : 1.0) - pole;
  };
  for (int k = 0; k < (across == 0 ? columns : rows); ++k)
  {
    const Vector3 way = way_to(end == 0 ? 1 : last - 1, k);
    const double length = way.norm();
    if (!(way_to(end == 0 ? 0 : last, k).norm() <= kPlainResidual * this->Size &&
          length > shortest && offset.dot(way) > steep * length))
    {
      return false;
    }
  }
  return true;
}

/// Where the parametrization stands still the slope says little; the Hessian of either side does.
bool CertifiedFeet::is_held_at_cusp(const PieceFoot& one, const PieceFoot& two) const
{
  const std::optional<int> between = this->line_between(one, two);
  if (!between || this->Members[this->member(one)].region)
  {
    return false;
  }
  const int across = *between;
  const int along = 1 - across;
  const double nearly = std::max(kPlainCosine * one.distance, kPlainResidual * this->Size);
  const double steep = kHeldCosine * std::max(one.distance, this->Size);
  for (const PieceFoot* foot : { &one, &two })
  {
    const Piece& piece = this->Search.piece(foot->piece);
    const Patch& patch = *this->Members[piece.patch].patch;
    const double speed = direction_of(patch, across).speed * piece.width[across];
    const double slowest = kStalledSpeed * direction_of(patch, along).speed * piece.width[along];
    const double metric = foot->metric[along];
    if (!(foot->metric[across] <= kStalledSpeed * kStalledSpeed * speed * speed &&
          metric > slowest * slowest))
    {
      return false;
    }
    const double t = foot->t[along];
    const double slope = foot->gradient[along];
    const double inward = t == 0.0 ? slope : -slope;
    const bool held = (t == 0.0 || t == 1.0) &&
      piece.sides[along][t == 1.0] == PieceSide::Boundary && inward > 0.0 &&
      slope * slope > steep * steep * metric;
    if (!held && !(t > 0.0 && t < 1.0 && slope * slope <= nearly * nearly * metric))
    {
      return false;
    }
    const double a = foot->hessian[2 * across];
    const double c = held ? metric : foot->hessian[2 * along];
    const double b = held ? 0.0 : foot->hessian[1];
    // What slope there is leads no farther on than to the same place.
    const double uphill = foot->t[across] == 0.0 ? foot->gradient[across] : -foot->gradient[across];
    if (!(uphill >= -kOnePlace * a && a > kPlainCurvature * foot->distance * speed &&
          c > kPlainCurvature * metric && a * c - b * b > kPlainCurvature * a * c))
    {
      return false;
    }
  }
  return true;
}

} // namespace footpoint
