// SPDX-License-Identifier: BSD-3-Clause

// The members of CertifiedFeet that fill in what a foot is where a look at its own derivatives is
// enough.
#include "footpoint/model/certified_feet.h"

#include "footpoint/model/plain_conditions.h"
#include "footpoint/solvers/foot_conditions.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace footpoint
{

Parameter<2> CertifiedFeet::domain_parameter(const PieceFoot& foot, const Piece& piece) const
{
  const Patch& patch = *this->Members[piece.patch].patch;
  Parameter<2> parameter = Parameter<2>::Zero();
  for (int i = 0; i < (patch.curve ? 1 : 2); ++i)
  {
    const int from = patch.curve ? 1 : i;
    const double t = foot.t[from];
    const Direction& direction = direction_of(patch, i);
    double local = piece.lower[from] + t * piece.width[from];
    if (t > 0.0 && t < 1.0)
    {
      parameter(i) = direction.origin + local;
      continue;
    }
    // Knots come back as the very numbers that the geometry was given.
    local = t == 0.0 ? piece.lower[from] : piece.upper[from];
    const auto knot = std::lower_bound(direction.spans.begin(), direction.spans.end(), local);
    const bool on_knot =
      !direction.knots.empty() && knot != direction.spans.end() && *knot == local;
    parameter(i) =
      on_knot ? direction.knots[knot - direction.spans.begin()] : direction.origin + local;
  }
  return parameter;
}

/// \pre inside a smooth part of the edge, and orthogonal to it
bool CertifiedFeet::plain_edge_foot(const PieceFoot& found, Foot& foot) const
{
  const Piece& piece = this->Search.piece(found.piece);
  const Member& member = this->Members[piece.patch];
  const Surface& surface = member.edge->surface();
  const Parameter<2> at =
    member.edge->surface_parameter(piece.lower[1] + found.t[1] * piece.width[1]);
  for (int i = 0; i < 2; ++i)
  {
    const Direction& direction = surface.direction(i);
    const auto line = std::lower_bound(direction.breaks.begin(), direction.breaks.end(), at(i),
      [](const Break& one, double where) { return one.at < where; });
    if (line != direction.breaks.end() && line->at == at(i) && at(i) > 0.0 &&
      at(i) < direction.length)
    {
      return false; // the edge runs along a kink of the surface
    }
  }
  const Jet<2> jet = surface.jet(at, Sides<2>::Constant(Side::Right), 1);
  const Vector3 normal = jet.first.col(0).cross(jet.first.col(1));
  const double length = normal.norm();
  if (!(length > kPlainSine * jet.first.col(0).norm() * jet.first.col(1).norm()))
  {
    return false;
  }
  // S(c(t)) itself: the piece is an approximation of it.
  const Vector3 centre = surface.centre() - this->Centre;
  const Vector3 shift = centre + jet.point - vector(found.position);
  const Vector3 offset = vector(found.offset) + shift;
  foot.direction = normal / (member.reversed ? -length : length);
  foot.distance = offset.norm();
  foot.signed_distance = -offset.dot(foot.direction) < 0.0 ? -foot.distance : foot.distance;
  foot.type = FootType::Edge;
  foot.isolated = true;
  foot.iterations = found.iterations;
  foot.face = member.face;
  foot.on_curve = false;
  foot.parameter = surface.to_domain(at);
  foot.point = surface.centre() + jet.point;
  return true;
}

bool CertifiedFeet::plain_foot(const PieceFoot& found, Foot& foot) const
{
  const Piece& piece = this->Search.piece(found.piece);
  const Member& member = this->Members[piece.patch];
  const bool curve = member.patch->curve != nullptr;
  const std::array<double, 2>& metric = found.metric;
  int bounds = 0;
  bool held[2] = { curve, false };
  const double nearly = std::max(kPlainCosine * found.distance, kPlainResidual * this->Size);
  const double steep = kHeldCosine * std::max(found.distance, this->Size);
  for (int i = curve ? 1 : 0; i < 2; ++i)
  {
    const double slowest = kStalledSpeed * direction_of(*member.patch, i).speed * piece.width[i];
    if (!(metric[i] > slowest * slowest))
    {
      return false;
    }
    bool boundary = false;
    if (found.t[i] == 0.0 || found.t[i] == 1.0)
    {
      const PieceSide side = piece.sides[i][found.t[i] == 1.0];
      if (side == PieceSide::Special)
      {
        return false;
      }
      boundary = side == PieceSide::Boundary;
    }
    bounds += boundary;
    // The squares of the residual |r·S_i| / |S_i| and of what it is compared with, times |S_i|².
    const double slope = found.gradient[i] * found.gradient[i];
    held[i] = boundary && slope > steep * steep * metric[i];
    if (!held[i] && slope > nearly * nearly * metric[i])
    {
      return false;
    }
  }
  if (member.edge && bounds > 0)
  {
    return false;
  }
  // The Hessian over the directions that nothing holds, in units of |S_i|; its determinant over its
  // trace is a lower bound of the smaller eigenvalue.
  const double a = held[0] ? 1.0 : found.hessian[0] / metric[0];
  const double c = held[1] ? 1.0 : found.hessian[2] / metric[1];
  const double bb = held[0] || held[1]
    ? 0.0
    : found.hessian[1] * found.hessian[1] / (metric[0] * metric[1]);
  if (!(a > 0.0 && c > 0.0 && a * c - bb > kPlainCurvature * (a + c)))
  {
    return false;
  }
  if (member.edge)
  {
    return this->plain_edge_foot(found, foot);
  }
  if (curve)
  {
    foot.direction = vector(found.first[1]) / std::sqrt(metric[1]);
  }
  else
  {
    const Vector3 normal = vector(found.first[0]).cross(vector(found.first[1]));
    const double squared = normal.squaredNorm();
    if (!(squared > kPlainSine * kPlainSine * metric[0] * metric[1]))
    {
      return false;
    }
    foot.direction = normal / std::copysign(std::sqrt(squared), member.reversed ? -1.0 : 1.0);
    const bool below = -vector(found.offset).dot(foot.direction) < 0.0;
    foot.signed_distance = below ? -found.distance : found.distance;
  }
  foot.type =
    bounds == 0 ? FootType::Interior : (bounds == 2 || curve ? FootType::Vertex : FootType::Edge);
  foot.isolated = true;
  foot.iterations = found.iterations;
  foot.face = member.face;
  foot.on_curve = curve;
  foot.parameter = this->domain_parameter(found, piece);
  foot.point = this->Centre + vector(found.position);
  foot.distance = found.distance;
  return true;
}

std::optional<int> CertifiedFeet::line_between(const PieceFoot& one, const PieceFoot& two) const
{
  const Piece& a = this->Search.piece(one.piece);
  const Piece& b = this->Search.piece(two.piece);
  const Member& member = this->Members[a.patch];
  if (a.patch != b.patch || member.patch->curve || member.edge)
  {
    return {};
  }
  for (int i = 0; i < 2; ++i)
  {
    const int along = 1 - i;
    const bool touch = (one.t[i] == 1.0 && two.t[i] == 0.0 && a.upper[i] == b.lower[i]) ||
      (one.t[i] == 0.0 && two.t[i] == 1.0 && a.lower[i] == b.upper[i]);
    if (touch && std::abs(one.t[along] - two.t[along]) <= kOnePlace &&
      a.lower[along] == b.lower[along] && a.upper[along] == b.upper[along])
    {
      return i;
    }
  }
  return {};
}

/// \pre the feet tie with each other
bool CertifiedFeet::plain_kink_foot(const PieceFoot& one, const PieceFoot& two, Foot& foot) const
{
  const Piece* pieces[2] = { &this->Search.piece(one.piece), &this->Search.piece(two.piece) };
  const PieceFoot* feet[2] = { &one, &two };
  const Member& member = this->Members[pieces[0]->patch];
  const std::optional<int> between = this->line_between(one, two);
  if (!between)
  {
    return false;
  }
  const int across = *between;
  const int along = 1 - across;
  if (!(one.t[along] > 0.0 && one.t[along] < 1.0))
  {
    return false;
  }
  const double knot = one.t[across] == 1.0 ? pieces[0]->upper[across] : pieces[0]->lower[across];
  const Direction& direction = direction_of(*member.patch, across);
  const auto line = std::lower_bound(direction.breaks.begin(), direction.breaks.end(), knot,
    [](const Break& each, double at) { return each.at < at; });
  if (line == direction.breaks.end() || line->at != knot || line->gap)
  {
    return false;
  }
  const double nearly = std::max(kPlainCosine * one.distance, kPlainResidual * this->Size);
  const double steep = kHeldCosine * std::max(one.distance, this->Size);
  Vector3 normals = Vector3::Zero();
  for (int k = 0; k < 2; ++k)
  {
    const PieceFoot& each = *feet[k];
    for (int i = 0; i < 2; ++i)
    {
      const double slowest =
        kStalledSpeed * direction_of(*member.patch, i).speed * pieces[k]->width[i];
      if (!(each.metric[i] > slowest * slowest))
      {
        return false;
      }
    }
    // Each side leads away from the query, and along the line the foot is a minimum.
    const double slope = each.t[across] == 0.0 ? each.gradient[across] : -each.gradient[across];
    const double curvature =
      each.hessian[along == 0 ? 0 : 2] / each.metric[static_cast<std::size_t>(along)];
    if (!(slope > 0.0 && slope * slope > steep * steep * each.metric[across]) ||
      each.gradient[along] * each.gradient[along] > nearly * nearly * each.metric[along] ||
      !(curvature > kPlainCurvature * (1.0 + curvature)))
    {
      return false;
    }
    const Vector3 normal = vector(each.first[0]).cross(vector(each.first[1]));
    const double length = normal.norm();
    if (!(length > kPlainSine * std::sqrt(each.metric[0] * each.metric[1])))
    {
      return false;
    }
    normals += normal / length;
  }
  const double length = normals.norm();
  if (!(length > kPlainSine))
  {
    return false; // folded back onto itself
  }
  foot.direction = normals / (member.reversed ? -length : length);
  const bool below = -vector(one.offset).dot(foot.direction) < 0.0;
  foot.signed_distance = below ? -one.distance : one.distance;
  foot.type = FootType::Kink;
  foot.isolated = true;
  foot.iterations = one.iterations;
  foot.face = member.face;
  foot.on_curve = false;
  foot.parameter = this->domain_parameter(one, *pieces[0]);
  foot.point = this->Centre + vector(one.position);
  foot.distance = one.distance;
  return true;
}

} // namespace footpoint
