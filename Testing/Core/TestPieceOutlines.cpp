// SPDX-License-Identifier: BSD-3-Clause

/// What outlines say of the distances of pieces: judged by samples in long double, from the nets
/// alone.

#include "BlockJudge.h"
#include "RandomPieces.h"
#include "RandomSheets.h"

using footpoint::PieceOutline;
using footpoint::SearchStructure;
using footpoint::Surface;
using footpoint::Vector3;
using namespace blocks;

namespace
{

/// One of the numbers of an outline: x, y, z, a of all k or x, y, z, |x|² of all corners.
Real number(const PieceOutline& outline, int which, int k)
{
  return outline.numbers[which * outline.count + k];
}
Real corner(const PieceOutline& outline, int which, int k)
{
  return outline.numbers[4 * outline.count + which * PieceOutline::kCorners + k];
}

Vector middle_of(const PieceOutline& outline)
{
  return { outline.middle[0], outline.middle[1], outline.middle[2] };
}

/// What a search allows for: roundings of single precision, for terms as large as the outline says.
Real error_of(const PieceOutline& outline, const Vector& r)
{
  return 0x1p-20L * (2.0L * r.lpNorm<1>() * outline.longest + outline.greatest);
}

/// |r|² + min (2 r·x + a), as it is stored.
Real bound_of(const PieceOutline& outline, const Vector& r)
{
  Real least = std::numeric_limits<Real>::infinity();
  for (int k = 0; k < outline.count; ++k)
  {
    const Vector x(number(outline, 0, k), number(outline, 1, k), number(outline, 2, k));
    least = std::min(least, 2.0L * r.dot(x) + number(outline, 3, k));
  }
  return r.dot(r) + least;
}

/// The least |S − P|² of samples and downhill from there.
Real least_squared(const Piece& piece, const Vector& point)
{
  Foot foot;
  foot.t = { { 0.0L, 0.0L } };
  foot.place = evaluate(piece, foot.t);
  foot.r = foot.place.point - point;
  return foot.r.dot(foot.r) + least_excess(piece, foot);
}

/// The square form of an outline at a place, over what it is multiplied with for rational pieces;
/// from a_k alone.
Real form_at(const Piece& piece, const PieceOutline& outline, const Pair& t)
{
  const Basis u(piece.shape->degree[0], t[0]);
  const Basis v(piece.shape->degree[1], t[1]);
  Real sum = 0.0L;
  Real weight = 0.0L;
  int k = 0;
  for (int i = 0; i <= piece.shape->degree[0]; ++i)
  {
    for (int j = 0; j <= piece.shape->degree[1]; ++j, ++k)
    {
      const Real w = u.value[i] * v.value[j] * piece.net[4 * k + 3];
      sum += w * number(outline, 3, k);
      weight += w;
    }
  }
  return sum / weight;
}

/// The numbers themselves: of the right places, no larger than said, and a square form that is
/// neither negative nor above |S − c|².
void judge_numbers(Random& random, const Piece& piece, const PieceOutline& outline)
{
  const int p = piece.shape->degree[0];
  const int q = piece.shape->degree[1];
  const int count = (p + 1) * (q + 1);
  ASSERT_EQ(outline.count, (count + 7) / 8 * 8);
  const Vector middle = middle_of(outline);
  const Real single = 0x1p-23L * piece.reach;
  for (int k = 0; k < outline.count; ++k)
  {
    const double* control = piece.net + 4 * std::min(k, count - 1);
    for (int c = 0; c < 3; ++c)
    {
      const Real x = static_cast<Real>(control[c]) / control[3] + piece.origin[c] - middle[c];
      EXPECT_NEAR(number(outline, c, k), x, single);
      EXPECT_GE(outline.longest, std::abs(number(outline, c, k)));
    }
    EXPECT_GE(outline.greatest, std::abs(number(outline, 3, k)));
  }
  EXPECT_LE((evaluate(piece, { { 0.5L, 0.5L } }).point - middle).norm(),
    1e-14L * (piece.reach + middle.norm()));
  for (int k = 0; k < PieceOutline::kCorners; ++k)
  {
    const Vector there = evaluate(piece, { { k / 2 * 1.0L, k % 2 * 1.0L } }).point - middle;
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_NEAR(corner(outline, c, k), there[c], single) << "corner " << k;
    }
    // Two roundings of x and one of the sum.
    EXPECT_NEAR(corner(outline, 3, k), there.dot(there), 0x1p-22L * outline.greatest)
      << "corner " << k;
    EXPECT_GE(outline.greatest, corner(outline, 3, k));
  }
  for (int k = 0; k < 20; ++k)
  {
    const Pair t{ { random.uniform(0.0, 1.0), random.uniform(0.0, 1.0) } };
    const Vector way = evaluate(piece, t).point - middle;
    const Real form = form_at(piece, outline, t);
    EXPECT_GE(form, -0x1p-22L * outline.greatest);
    EXPECT_LE(form, way.dot(way) + 0x1p-22L * outline.greatest);
  }
}

/// From near the piece to where its size is below the rounding of single precision.
Vector random_query(Random& random, const Piece& piece)
{
  const Vector origin(piece.origin[0], piece.origin[1], piece.origin[2]);
  const double length = piece.reach * random.magnitude(random.integer(0, 3) == 0 ? 8.0 : 1.0);
  const Vector point = origin + static_cast<Real>(length) * random.vector(-1.0, 1.0).cast<Real>();
  return point.cast<double>().cast<Real>();
}

struct Tally
{
  int cases = 0;
  int near = 0; ///< where the bound is above 0.8 times the least squared distance
};

void judge_query(const Piece& piece, const PieceOutline& outline, const Vector& point, Tally& tally)
{
  const Vector r = middle_of(outline) - point;
  const Real error = error_of(outline, r);
  const Real rounding = 0x1p-60L * (r.norm() + piece.reach) * (point.norm() + piece.reach);
  const Real least = least_squared(piece, point);
  const Real bound = bound_of(outline, r) - error;
  EXPECT_LE(bound, least + rounding);
  ++tally.cases;
  tally.near += bound >= 0.8L * least;
  for (int k = 0; k < PieceOutline::kCorners; ++k)
  {
    const Vector x(corner(outline, 0, k), corner(outline, 1, k), corner(outline, 2, k));
    const Real stored = r.dot(r) + 2.0L * r.dot(x) + corner(outline, 3, k);
    const Vector way = evaluate(piece, { { k / 2 * 1.0L, k % 2 * 1.0L } }).point - point;
    EXPECT_GE(stored + error, way.dot(way) - rounding) << "corner " << k;
    EXPECT_LE(stored - error, way.dot(way) + rounding) << "corner " << k;
  }
}

void judge(Random& random, const SearchStructure& structure, int pieces, Tally& tally)
{
  const footpoint::AlignedVector<Piece>& all = structure.forms.pieces();
  for (int k = 0; k < pieces; ++k)
  {
    const int index = random.integer(0, static_cast<int>(all.size()) - 1);
    const PieceOutline& outline = structure.outlines[index];
    SCOPED_TRACE(::testing::Message() << "piece " << index);
    judge_numbers(random, all[index], outline);
    judge_query(all[index], outline, random_query(random, all[index]), tally);
  }
}

} // namespace

TEST(PieceOutlines, NothingIsNearerThanTheySay)
{
  Tally tally;
  for (int seed = 0; seed < 500; ++seed)
  {
    Random random(seed);
    std::string description;
    const SearchStructure structure =
      shapes::random_pieces(random, shapes::random_degrees(random), 13.0, description);
    SCOPED_TRACE(::testing::Message() << "seed " << seed << ": " << description);
    judge(random, structure, 2, tally);
  }
  EXPECT_GT(tally.near, 0.35 * tally.cases);
}

TEST(PieceOutlines, OfSheetsAndCurvesTogether)
{
  // Patches of several degrees, with several pieces each, far from the origin and from each other.
  Tally tally;
  for (int seed = 0; seed < 100; ++seed)
  {
    Random random(seed);
    std::string description;
    const Surface sheet = shapes::random_sheet(random, description).geometry();
    SCOPED_TRACE(::testing::Message() << "seed " << seed << ": " << description);
    DistanceForms forms(random.integer(0, 1) == 0 ? 1 : 100);
    forms.add(0, sheet, 10.0 * random.vector(-1.0, 1.0), kNoneSpecial);
    forms.add(1, shapes::random_curve(random), 10.0 * random.vector(-1.0, 1.0), kNoneSpecial);
    forms.add(2, shapes::saddle(), Vector3::Zero(), kNoneSpecial);
    forms.add(3, shapes::torus(), Vector3::Zero(), kNoneSpecial);
    judge(random, SearchStructure(std::move(forms)), 5, tally);
  }
  EXPECT_GT(tally.near, 0.3 * tally.cases);
}

TEST(PieceOutlines, SquareFormsOfStraightPieces)
{
  // Plane, evenly parametrized and sheared: what the form has is known.
  Random random(5);
  for (int p = 0; p <= 4; ++p)
  {
    for (int q = 1; q <= 4; ++q)
    {
      const Vector3 u = p > 0 ? random.vector(-1.0, 1.0) : Vector3(Vector3::Zero());
      const Vector3 v = random.vector(-1.0, 1.0);
      const SearchStructure structure(shapes::straight_piece({ { p, q } }, Vector3::Zero(), u, v));
      const Piece& piece = structure.forms.pieces()[0];
      for (int k = 0; k < 10; ++k)
      {
        const Pair t{ { random.uniform(0.0, 1.0), random.uniform(0.0, 1.0) } };
        const double du = p > 0 ? static_cast<double>(t[0]) - 0.5 : 0.0;
        const double dv = static_cast<double>(t[1]) - 0.5;
        // A direction of degree one is left out: what is beside it is left.
        const bool along_u = p >= 2;
        const bool along_v = q >= 2;
        Vector3 way = (along_u ? du : 0.0) * u + (along_v ? dv : 0.0) * v;
        way -= along_u != along_v && p > 0
          ? Vector3((along_u ? v : u) * way.dot(along_u ? v : u) / (along_u ? v : u).squaredNorm())
          : Vector3(Vector3::Zero());
        EXPECT_NEAR(form_at(piece, structure.outlines[0], t), way.squaredNorm(),
          1e-5 * piece.reach * piece.reach)
          << p << " by " << q;
      }
    }
  }
}

TEST(PieceOutlines, NoneBeyondSinglePrecision)
{
  Random random(9);
  const Surface bumpy = shapes::bumpy(6, 5);
  DistanceForms forms(1);
  const double sizes[] = { 1e-200, 1e-30, 1e-16, 1e-13, 1.0, 1e13, 1e17, 1e30, 1e120 };
  int patch = 0;
  for (const double size : sizes)
  {
    forms.add(patch++, Surface(bumpy.knots(0), bumpy.knots(1), size * bumpy.local_control_points()),
      Vector3::Zero(), kNoneSpecial);
  }
  const SearchStructure structure(std::move(forms));
  const footpoint::AlignedVector<Piece>& pieces = structure.forms.pieces();
  ASSERT_EQ(pieces.size(), 9U * 9U);
  Tally tally;
  for (std::size_t k = 0; k < pieces.size(); ++k)
  {
    const PieceOutline& outline = structure.outlines[static_cast<std::int32_t>(k)];
    const double size = sizes[pieces[k].patch];
    SCOPED_TRACE(::testing::Message() << "size " << size);
    if (size < 1e-15 || size > 1e15)
    {
      EXPECT_EQ(outline.count, 0);
      EXPECT_EQ(outline.numbers, nullptr);
      continue;
    }
    judge_numbers(random, pieces[k], outline);
    judge_query(pieces[k], outline, random_query(random, pieces[k]), tally);
  }
  EXPECT_EQ(tally.cases, 27);
}
