// SPDX-License-Identifier: BSD-3-Clause

#include "BlockJudge.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace blocks
{

Basis::Basis(int n, Real t)
{
  std::array<Real, 10> lower{};
  this->value[0] = 1.0L;
  for (int degree = 1; degree <= n; ++degree)
  {
    std::copy_n(this->value.begin(), degree, lower.begin());
    for (int k = 0; k <= degree; ++k)
    {
      this->value[k] =
        (k < degree ? (1.0L - t) * lower[k] : 0.0L) + (k > 0 ? t * lower[k - 1] : 0.0L);
    }
  }
  for (int k = 0; k <= n && n > 0; ++k)
  {
    this->slope[k] = n * ((k > 0 ? lower[k - 1] : 0.0L) - (k < n ? lower[k] : 0.0L));
  }
}

// === Pieces in long double, from their nets alone

Place evaluate(const Piece& piece, const Pair& t)
{
  const Basis u(piece.shape->degree[0], t[0]);
  const Basis v(piece.shape->degree[1], t[1]);
  using Homogeneous = Eigen::Matrix<Real, 4, 1>;
  Homogeneous s = Homogeneous::Zero();
  Homogeneous su = s;
  Homogeneous sv = s;
  const double* net = piece.net;
  for (int i = 0; i <= piece.shape->degree[0]; ++i)
  {
    for (int j = 0; j <= piece.shape->degree[1]; ++j, net += 4)
    {
      const Homogeneous control(net[0], net[1], net[2], net[3]);
      s += u.value[i] * v.value[j] * control;
      su += u.slope[i] * v.value[j] * control;
      sv += u.value[i] * v.slope[j] * control;
    }
  }
  Place place;
  const Vector local = s.head<3>() / s[3];
  place.first = { { (su.head<3>() - su[3] * local) / s[3],
    (sv.head<3>() - sv[3] * local) / s[3] } };
  place.point = local + Vector(piece.origin[0], piece.origin[1], piece.origin[2]);
  return place;
}

// === The judge

Real excess(const Foot& foot, const Vector& point)
{
  const Vector way = point - foot.place.point;
  return way.dot(way + 2.0L * foot.r);
}

Real least_excess(const Piece& piece, const Foot& foot)
{
  constexpr int kSamples = 9;
  const bool curve = piece.shape->degree[0] == 0;
  Real least = std::numeric_limits<Real>::infinity();
  Pair best{ { 0.0L, 0.0L } };
  const auto look = [&](const Pair& t)
  {
    const Real value = excess(foot, evaluate(piece, t).point);
    const bool better = value < least;
    least = better ? value : least;
    best = better ? t : best;
    return better;
  };
  for (int i = 0; i <= (curve ? 0 : kSamples); ++i)
  {
    for (int j = 0; j <= kSamples; ++j)
    {
      look({ { i / Real(kSamples), j / Real(kSamples) } });
    }
  }
  constexpr int kMostRounds = 100; // along narrow valleys it would take many more
  Real step = 0.5L / kSamples;
  for (int round = 0; step > 1e-7L && round < kMostRounds; ++round)
  {
    bool better = false;
    for (int k = curve ? 2 : 0; k < 4; ++k)
    {
      Pair t = best;
      t[k / 2] = std::clamp(t[k / 2] + (k % 2 == 0 ? step : -step), Real(0), Real(1));
      better = look(t) || better;
    }
    step = better ? step : 0.5L * step;
  }
  return least;
}

Vector turned(
  Random& random, const PieceNeighbourhood& around, const Foot& foot, const Vector& normal)
{
  Vector r = (random.integer(0, 1) == 0 ? -1.0L : 1.0L) * normal;
  for (int i = 0; i < 2; ++i)
  {
    const Vector& along = foot.place.first[i];
    const Vector across = normal.cross(foot.place.first[1 - i]);
    const Vector conormal = across.norm() > 0.0L ? across.normalized() : along.normalized();
    const int end = foot.t[i] == 0.0L ? 0 : 1;
    if (along.norm() > 0.0L && (foot.t[i] == 0.0L || foot.t[i] == 1.0L) &&
      !around.continues(i, end))
    {
      const Real sign = (conormal.dot(along) > 0.0L) == (end == 0) ? 1.0L : -1.0L;
      r += sign * static_cast<Real>(random.magnitude(2.0)) * conormal;
    }
  }
  if (random.integer(0, 2) > 0)
  {
    const double angle =
      random.integer(0, 1) == 0 ? random.uniform(0.0, 1.0) : 1e-3 * random.magnitude(2.0);
    r = r.normalized() + static_cast<Real>(angle) * random.vector(-1.0, 1.0).cast<Real>();
  }
  return r.normalized();
}

void judge_foot(Random& random, const footpoint::AlignedVector<Piece>& pieces,
  const footpoint::AlignedVector<PieceNeighbourhood>& all, std::int32_t index, double size,
  Counts& counts)
{
  const PieceNeighbourhood& around = all[index];
  const Piece& piece = pieces[index];
  Foot foot;
  foot.piece = index;
  for (int i = 0; i < 2; ++i)
  {
    const int where = random.integer(0, 5);
    foot.t[i] = where < 2 ? where : static_cast<Real>(random.uniform(0.0, 1.0));
  }
  foot.t[0] = piece.shape->degree[0] == 0 ? 0.0L : foot.t[0];
  foot.place = evaluate(piece, foot.t);
  const Vector across = piece.shape->degree[0] == 0 ? Vector(random.vector(-1.0, 1.0).cast<Real>())
                                                    : foot.place.first[0];
  const Vector normal = across.cross(foot.place.first[1]).normalized();
  const Real longest = std::min(static_cast<Real>(around.limit), 100.0L * size);
  const Real distance = random.integer(0, 1) == 0 ? longest : longest * random.uniform(0.0, 1.0);
  foot.r = distance * turned(random, around, foot, normal);
  Real gradient = 0.0L;
  for (int i = 0; i < 2; ++i)
  {
    const Real slope = foot.r.dot(foot.place.first[i]);
    const bool held = (foot.t[i] == 0.0L && slope >= 0.0L && !around.continues(i, 0)) ||
      (foot.t[i] == 1.0L && slope <= 0.0L && !around.continues(i, 1));
    gradient += held ? 0.0L : around.inverse_speed[i] * std::abs(slope);
  }
  const Real allowed = around.square_factor * gradient * gradient;
  // The nets are rounded to double precision.
  const Real rounding = 1e-14L * size;
  Real least = 0.0L;
  for (int at = 0; at < 9; ++at)
  {
    if ((around.block >> at & 1) != 0)
    {
      least = std::min(least, least_excess(pieces[around.pieces[at]], foot));
    }
  }
  ++counts.queries;
  const bool counted = allowed > 10.0L * rounding * distance;
  counts.reached += counted && -least > 0.5L * allowed;
  counts.reached_flat += counted && -least > 0.05L * allowed;
  EXPECT_GE(least, -allowed - rounding * (2.0L * distance + rounding))
    << "piece " << index << " at " << foot.t[0] << ' ' << foot.t[1] << ", distance " << distance
    << ", limit " << around.limit << ", allowed " << allowed;
}

void judge(Random& random, const DistanceForms& forms, double size, int queries, Counts& counts)
{
  const footpoint::AlignedVector<Piece>& pieces = forms.pieces();
  const footpoint::AlignedVector<PieceNeighbourhood> all = footpoint::find_neighbourhoods(pieces);
  std::vector<std::int32_t> blocks;
  for (std::size_t k = 0; k < pieces.size(); ++k)
  {
    if (all[k].limit >= 0.0)
    {
      blocks.push_back(static_cast<std::int32_t>(k));
    }
  }
  counts.pieces += static_cast<int>(pieces.size());
  counts.blocks += static_cast<int>(blocks.size());
  for (int k = 0; k < queries && !blocks.empty(); ++k)
  {
    judge_foot(random, pieces, all, blocks[random.integer(0, static_cast<int>(blocks.size()) - 1)],
      size, counts);
  }
}

} // namespace blocks
