// SPDX-License-Identifier: BSD-3-Clause

/// What outlines say of the distances of pieces: judged by samples in long double, from the nets
/// alone.

#include "BlockJudge.h"
#include "RandomPieces.h"
#include "RandomSheets.h"

#include "footpoint/search/outline_form-inl.h"

using footpoint::PieceOutline;
using footpoint::raised_degree;
using footpoint::SearchStructure;
using footpoint::Surface;
using footpoint::Vector3;
using footpoint::HWY_NAMESPACE::OutlineView;
using footpoint::HWY_NAMESPACE::RefinedOutline;
using footpoint::HWY_NAMESPACE::start_of;
using namespace blocks;

namespace
{

/// An outline with the piece that it is of.
struct Outlined
{
  const Piece& piece;
  const PieceOutline& outline;

  int columns() const { return raised_degree(this->piece.shape->degree[1]) + 1; }
  int size() const { return (raised_degree(this->piece.shape->degree[0]) + 1) * this->columns(); }
  /// One of the numbers: x, y, z, a of all k (w is left to weight()).
  Real number(int which, int k) const
  {
    return this->outline.numbers[which * this->outline.count + k];
  }
  Real weight(int k) const
  {
    return this->piece.shape->rational ? this->number(4, k) : Real(1.0L);
  }
  /// x, y, z or |x|² of a corner.
  Real corner(int which, int k) const
  {
    return this->outline.corners(this->piece.shape->rational)[which * PieceOutline::kCorners + k];
  }
  Vector origin() const
  {
    return { this->outline.origin[0], this->outline.origin[1], this->outline.origin[2] };
  }
  /// A point of the piece from the origin, in the outline's units.
  Vector way(const Pair& t) const
  {
    return (evaluate(this->piece, t).point - this->origin()) / this->outline.unit;
  }

  /// Σ B_k w_k of some numbers over Σ B_k w_k.
  template <class Number>
  Real mean(const Pair& t, const Number& number) const
  {
    const Basis u(raised_degree(this->piece.shape->degree[0]), t[0]);
    const Basis v(raised_degree(this->piece.shape->degree[1]), t[1]);
    Real sum = 0.0L;
    Real weight = 0.0L;
    for (int k = 0; k < this->size(); ++k)
    {
      const Real w = u.value[k / this->columns()] * v.value[k % this->columns()] * this->weight(k);
      sum += w * number(k);
      weight += w;
    }
    return sum / weight;
  }
};

/// Roundings of single precision, of what is made of a few numbers up to the greatest.
constexpr Real kSingle = 0x1p-21L;

/// The numbers themselves: no larger than said, control points of the piece, and squares that are
/// nowhere above |S − c|². \return by how much they are below on the average, over the greatest
Real judge_numbers(Random& random, const Piece& piece, const PieceOutline& outline)
{
  const Outlined one{ piece, outline };
  EXPECT_EQ(outline.count, (one.size() + 7) / 8 * 8);
  EXPECT_EQ(outline.unit * outline.inverse_unit, 1.0);
  EXPECT_LE(outline.unit, piece.reach);
  EXPECT_GT(2.0 * outline.unit, piece.reach);
  for (int k = 0; k < outline.count; ++k)
  {
    Real squared = 0.0L;
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_GE(outline.longest, std::abs(one.number(c, k)));
      squared += one.number(c, k) * one.number(c, k);
      EXPECT_EQ(one.number(c, k), one.number(c, std::min(k, one.size() - 1)));
    }
    EXPECT_GE(outline.greatest, std::abs(one.number(3, k)));
    EXPECT_GE(outline.greatest, squared * (1.0L - kSingle));
  }
  for (int k = 0; k < PieceOutline::kCorners; ++k)
  {
    const Vector there = one.way({ { k / 2 * 1.0L, k % 2 * 1.0L } });
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_NEAR(one.corner(c, k), there[c], kSingle) << "corner " << k;
    }
    EXPECT_NEAR(one.corner(3, k), there.dot(there), kSingle * outline.greatest) << "corner " << k;
  }
  constexpr int kPlaces = 20;
  Real below = 0.0L;
  for (int k = 0; k < kPlaces; ++k)
  {
    const Pair t{ { random.uniform(0.0, 1.0), random.uniform(0.0, 1.0) } };
    const Vector way = one.way(t);
    for (int c = 0; c < 3; ++c)
    {
      // Means of numbers that are rounded, by weights that are.
      EXPECT_NEAR(one.mean(t, [&](int i) { return one.number(c, i); }), way[c],
        4.0L * kSingle * outline.longest);
    }
    const Real squares = one.mean(t, [&](int i) { return one.number(3, i); });
    EXPECT_LE(squares, way.dot(way) + 4.0L * kSingle * outline.greatest);
    below += (way.dot(way) - squares) / (kPlaces * outline.greatest);
  }
  return below;
}

/// From near the piece to where its size is below the rounding of single precision.
Vector random_query(Random& random, const Piece& piece)
{
  const Vector origin(piece.origin[0], piece.origin[1], piece.origin[2]);
  const double length = piece.reach * random.magnitude(random.integer(0, 3) == 0 ? 8.0 : 1.0);
  const Vector point = origin + static_cast<Real>(length) * random.vector(-1.0, 1.0).cast<Real>();
  return point.cast<double>().cast<Real>();
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

struct Tally
{
  int cases = 0;
  int near = 0;    ///< where the bound is above 0.8 times the least squared distance
  int refined = 0; ///< where the refined one is above 0.9 times that
  Real below = 0.0L;
};

void judge_query(const Piece& piece, const PieceOutline& outline, const Vector& point, Tally& tally)
{
  const double query[3] = { static_cast<double>(point[0]), static_cast<double>(point[1]),
    static_cast<double>(point[2]) };
  const Vector r = Outlined{ piece, outline }.origin() - point;
  // What a search says of positions within twice their own distance from the origin.
  const Real far = r.norm() + point.norm() + piece.reach;
  const OutlineView view(outline, query, static_cast<double>(0x1p-50L * far));
  ASSERT_TRUE(view.is_usable());
  const Real rounding = 0x1p-58L * far * (r.norm() + piece.reach);
  const Real least = least_squared(piece, point);
  EXPECT_LE(view.bound(), least + rounding);
  ++tally.cases;
  tally.near += view.bound() >= 0.8L * least;
  double corner = 0.0;
  const int nearest = view.nearest_corner(piece.shape->rational, corner);
  const Real unit = outline.unit;
  const Real above =
    0x1p-18L * unit * (2.0L * r.lpNorm<1>() * outline.longest + unit * outline.greatest) +
    0x1p-47L * far * r.lpNorm<1>();
  for (int k = 0; k < PieceOutline::kCorners; ++k)
  {
    const Vector way = evaluate(piece, { { k / 2 * 1.0L, k % 2 * 1.0L } }).point - point;
    EXPECT_TRUE(k != nearest || corner >= way.dot(way) - rounding) << "corner " << k;
    EXPECT_LE(corner, way.dot(way) + above) << "corner " << k;
  }
  for (const double part : { 0.9, 0.999, 1.001, 2.0 })
  {
    const Real squared = r.dot(r) - part * least;
    RefinedOutline refined;
    view.refine(*piece.shape, static_cast<double>(squared - 0x1p-50L * r.dot(r)), refined);
    EXPECT_FALSE(part > 1.0 && refined.is_positive() && least > rounding) << part;
    tally.refined += part == 0.9 && refined.is_positive();
    if (!refined.is_positive())
    {
      const std::array<double, 2> start = start_of(*piece.shape, refined);
      for (int i = 0; i < 2; ++i)
      {
        EXPECT_GE(start[i], 0.0);
        EXPECT_LE(start[i], 1.0);
      }
    }
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
    tally.below += judge_numbers(random, all[index], outline);
    judge_query(all[index], outline, random_query(random, all[index]), tally);
  }
}

} // namespace

TEST(PieceOutlines, NothingIsNearerThanTheySay)
{
  Tally tally;
  for (int seed = 0; seed < 800; ++seed)
  {
    Random random(seed);
    std::string description;
    const SearchStructure structure =
      shapes::random_pieces(random, shapes::random_degrees(random), 13.0, description);
    SCOPED_TRACE(::testing::Message() << "seed " << seed << ": " << description);
    judge(random, structure, 2, tally);
  }
  // Most of these pieces are rough, and cut by nothing.
  EXPECT_GT(tally.near, 0.4 * tally.cases);
  EXPECT_GT(tally.refined, 0.35 * tally.cases);
  EXPECT_LT(tally.below, 0.2 * tally.cases);
}

TEST(PieceOutlines, OfSheetsAndCurvesTogether)
{
  // Patches of several degrees, with several pieces each, far from the origin and from each other.
  Tally tally;
  for (int seed = 0; seed < 200; ++seed)
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
  EXPECT_GT(tally.near, 0.4 * tally.cases);
  EXPECT_GT(tally.refined, 0.4 * tally.cases);
}

TEST(PieceOutlines, SquaresOfStraightPiecesAreExact)
{
  // Plane, evenly parametrized and sheared: |S − c|² has degree two.
  Random random(5);
  for (int p = 0; p <= 4; ++p)
  {
    for (int q = 1; q <= 4; ++q)
    {
      const Vector3 u = p > 0 ? random.vector(-1.0, 1.0) : Vector3(Vector3::Zero());
      const Vector3 v = random.vector(-1.0, 1.0);
      const SearchStructure structure(shapes::straight_piece({ { p, q } }, Vector3::Zero(), u, v));
      const Outlined one{ structure.forms.pieces()[0], structure.outlines[0] };
      for (int k = 0; k < 10; ++k)
      {
        const Pair t{ { random.uniform(0.0, 1.0), random.uniform(0.0, 1.0) } };
        EXPECT_NEAR(one.mean(t, [&](int i) { return one.number(3, i); }),
          one.way(t).squaredNorm(), kSingle * one.outline.greatest)
          << p << " by " << q;
      }
    }
  }
}

TEST(PieceOutlines, TheyStartAtTheFootOfStraightPieces)
{
  Random random(6);
  for (int p = 0; p <= 4; ++p)
  {
    for (int q = 1; q <= 4; ++q)
    {
      const Vector3 u = p > 0 ? Vector3(2.0, 0.0, 0.0) : Vector3(Vector3::Zero());
      const Vector3 v(0.0, 3.0, 0.0);
      const SearchStructure structure(shapes::straight_piece({ { p, q } }, Vector3::Zero(), u, v));
      const Piece& piece = structure.forms.pieces()[0];
      for (int k = 0; k < 10; ++k)
      {
        // In one of the halves, and not beside an end.
        const double s = p > 0 ? random.uniform(0.1, 0.9) : 0.0;
        const double t = random.uniform(0.1, 0.9);
        const Vector point = evaluate(piece, { { s, t } }).point + Vector(0.0L, 0.0L, 5.0L);
        const double query[3] = { static_cast<double>(point[0]), static_cast<double>(point[1]),
          static_cast<double>(point[2]) };
        const OutlineView view(structure.outlines[0], query, 1e-14);
        RefinedOutline refined;
        const Vector3 r(piece.origin[0] - query[0], piece.origin[1] - query[1],
          piece.origin[2] - query[2]);
        view.refine(*piece.shape, r.squaredNorm() - 26.0, refined);
        ASSERT_FALSE(refined.is_positive());
        const std::array<double, 2> start = start_of(*piece.shape, refined);
        EXPECT_NEAR(start[0], s, 1e-4) << p << " by " << q << " at " << s << ' ' << t;
        EXPECT_NEAR(start[1], t, 1e-4) << p << " by " << q << " at " << s << ' ' << t;
        // Coefficients of (t − t₀)² on a half of length 1.5 reach down to −0.57.
        view.refine(*piece.shape, r.squaredNorm() - 24.0, refined);
        EXPECT_TRUE(refined.is_positive());
      }
    }
  }
}

TEST(PieceOutlines, OfAllSizesWhoseSquaresAreNumbers)
{
  Random random(9);
  const Surface bumpy = shapes::bumpy(6, 5);
  DistanceForms forms(1);
  const double sizes[] = { 1e-200, 1e-120, 1e-30, 1e-16, 1.0, 1e17, 1e30, 1e120, 1e150 };
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
    if (size < 1e-140 || size > 1e140)
    {
      EXPECT_EQ(outline.count, 0);
      EXPECT_EQ(outline.numbers, nullptr);
      const double origin[3] = {};
      EXPECT_FALSE(OutlineView(outline, origin, 0.0).is_usable());
      continue;
    }
    judge_numbers(random, pieces[k], outline);
    judge_query(pieces[k], outline, random_query(random, pieces[k]), tally);
  }
  EXPECT_EQ(tally.cases, 63);
}

TEST(PieceOutlines, FromTooFarAwayNothingIsSeen)
{
  const SearchStructure structure(
    shapes::straight_piece({ { 3, 3 } }, Vector3::Zero(), Vector3::UnitX(), Vector3::UnitY()));
  const double far[3] = { 1e17, 0.0, 0.0 };
  const double too_far[3] = { 0.0, 1e19, 0.0 };
  EXPECT_TRUE(OutlineView(structure.outlines[0], far, 1.0).is_usable());
  EXPECT_FALSE(OutlineView(structure.outlines[0], too_far, 1.0).is_usable());
}
