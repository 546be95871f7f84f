// SPDX-License-Identifier: BSD-3-Clause

/// How far points of a piece are apart at the least, by their parameters: judged by random pairs.

#include "BlockJudge.h"
#include "RandomPieces.h"
#include "RandomSheets.h"
#include "SlowBuild.h"

using footpoint::Surface;
using footpoint::Vector3;
using namespace blocks;

namespace
{

constexpr int kShare = kSlowBuild ? 8 : 1;

/// |S − f|² over the square form, at the least, of random pairs of points of a piece; infinite
/// where the form is zero.
Real least_ratio(Random& random, const Piece& piece, const std::array<double, 3>& metric, int pairs)
{
  Real least = std::numeric_limits<Real>::infinity();
  for (int k = 0; k < pairs; ++k)
  {
    const std::array<double, 2> a = shapes::random_place(random, piece);
    std::array<double, 2> b = shapes::random_place(random, piece);
    if (random.integer(0, 1) == 0)
    {
      for (int i = 0; i < 2; ++i)
      {
        b[i] = std::clamp(a[i] + 1e-3 * (b[i] - a[i]), 0.0, 1.0);
      }
    }
    const Real du = static_cast<Real>(b[0]) - a[0];
    const Real dv = static_cast<Real>(b[1]) - a[1];
    const Real form = metric[0] * du * du + 2.0L * metric[1] * du * dv + metric[2] * dv * dv;
    const Real length =
      (evaluate(piece, { { b[0], b[1] } }).point - evaluate(piece, { { a[0], a[1] } }).point)
        .norm();
    if (form > 0.0L)
    {
      least = std::min(least, length * length / form);
    }
  }
  return least;
}

} // namespace

TEST(PieceMetric, PointsAreNotNearerThanItSays)
{
  int pieces = 0;
  int known = 0;
  int sharp = 0;
  const auto judge_pieces = [&](Random& random, const DistanceForms& forms)
  {
    const footpoint::AlignedVector<PieceNeighbourhood> all =
      footpoint::find_neighbourhoods(forms.pieces());
    for (int k = 0; k < 8; ++k)
    {
      const int index = random.integer(0, static_cast<int>(all.size()) - 1);
      const Real ratio = least_ratio(random, forms.pieces()[index], all[index].metric, 20);
      EXPECT_GE(ratio, 1.0L) << "piece " << index;
      ++pieces;
      known += ratio < std::numeric_limits<Real>::infinity();
      sharp += ratio < 4.0L;
    }
  };
  for (int seed = 0; seed < 300 / kShare; ++seed)
  {
    Random random(seed);
    std::string description;
    const Surface sheet = shapes::random_sheet(random, description).geometry();
    SCOPED_TRACE(::testing::Message() << "seed " << seed << ": " << description);
    DistanceForms forms(random.integer(0, 1) == 0 ? 1 : 100);
    forms.add(0, sheet, Vector3::Zero(), kNoneSpecial);
    judge_pieces(random, forms);
    DistanceForms curve(1);
    curve.add(0, shapes::random_curve(random), Vector3::Zero(), kNoneSpecial);
    judge_pieces(random, curve);
    judge_pieces(random,
      shapes::random_pieces(random, shapes::random_degrees(random), 60.0, description).forms);
  }
  EXPECT_GT(known, 0.65 * pieces);
  EXPECT_GT(sharp, 0.55 * pieces);
}

TEST(PieceMetric, IsExactOfParallelograms)
{
  for (int seed = 0; seed < 50; ++seed)
  {
    Random random(seed);
    const Vector3 u = random.vector(-1.0, 1.0);
    const Vector3 v = random.vector(-1.0, 1.0);
    const DistanceForms forms = shapes::straight_piece({ { 1, 1 } }, Vector3::Zero(), u, v);
    const std::array<double, 3> metric = footpoint::find_neighbourhoods(forms.pieces())[0].metric;
    EXPECT_NEAR(metric[0], u.dot(u), 1e-5 * u.dot(u));
    EXPECT_NEAR(metric[1], u.dot(v), 1e-5 * u.norm() * v.norm());
    EXPECT_NEAR(metric[2], v.dot(v), 1e-5 * v.dot(v));
  }
}
