// SPDX-License-Identifier: BSD-3-Clause

/// What height forms prove of pieces: judged by samples in long double, from the nets alone.

#include "BlockJudge.h"
#include "RandomPieces.h"
#include "RandomSheets.h"
#include "SlowBuild.h"

#include "footpoint/search/height_form-inl.h"

using footpoint::Points;
using footpoint::SearchStructure;
using footpoint::Surface;
using footpoint::Vector3;
using footpoint::HWY_NAMESPACE::HeightForm;
using footpoint::HWY_NAMESPACE::HeightView;
using namespace blocks;

namespace
{

constexpr int kShare = kSlowBuild ? 8 : 1;

/// A foot rounded to double precision. The form speaks of the query for which its r is exact: S(t)
/// − r.
struct Case
{
  Foot foot;
  HeightView view;
};

Case case_of(const Piece& piece, std::int32_t index, const std::array<double, 2>& t,
  const Vector& r, const std::array<double, 3>& metric)
{
  Case result;
  result.foot.piece = index;
  result.foot.t = { { t[0], t[1] } };
  result.foot.place = evaluate(piece, result.foot.t);
  for (int k = 0; k < 3; ++k)
  {
    result.view.f[k] = static_cast<double>(result.foot.place.point[k] - piece.origin[k]);
    result.view.r[k] = static_cast<double>(r[k]);
    result.foot.r[k] = result.view.r[k];
  }
  result.view.t = t;
  result.view.metric = metric;
  result.view.allowed = 0.0;
  return result;
}

Vector normal_at(Random& random, const Piece& piece, const Pair& t)
{
  const Place place = evaluate(piece, t);
  const Vector across =
    piece.shape->degree[0] == 0 ? Vector(random.vector(-1.0, 1.0).cast<Real>()) : place.first[0];
  const Vector normal = across.cross(place.first[1]);
  return normal.norm() > 0.0L ? Vector(normal.normalized()) : Vector(0.0L, 0.0L, 1.0L);
}

/// Nearly or far from orthogonal, from a hundredth of the piece's size up to where squares of its
/// size are below the rounding.
Case random_case(Random& random, const SearchStructure& structure, std::int32_t index)
{
  const Piece& piece = structure.forms.pieces()[index];
  const PieceNeighbourhood& around = structure.neighbourhoods[index];
  const std::array<double, 2> t = shapes::random_place(random, piece);
  Foot foot;
  foot.t = { { t[0], t[1] } };
  foot.place = evaluate(piece, foot.t);
  const Vector direction = turned(random, around, foot, normal_at(random, piece, foot.t));
  const double length = piece.reach * random.magnitude(random.integer(0, 4) == 0 ? 17.0 : 2.0);
  const std::array<double, 3> none{};
  return case_of(
    piece, index, t, length * direction, random.integer(0, 4) == 0 ? none : around.metric);
}

/// In memory that ends where it may end and holds nothing that was set before.
template <int P, int Q>
bool proves(const Piece& piece, const HeightView& view)
{
  using Form = HeightForm<P, Q>;
  std::vector<double> memory(
    Form::size_of_memory(*piece.shape), std::numeric_limits<double>::quiet_NaN());
  return Form::proves(piece, view, memory.data());
}

Real length_of(const Case& each)
{
  return each.foot.r.norm();
}

/// Of the samples, in long double.
Real rounding_of(const Case& each, const Piece& piece)
{
  const Vector origin(piece.origin[0], piece.origin[1], piece.origin[2]);
  return 0x1p-57L * (length_of(each) + piece.reach) * (piece.reach + origin.norm());
}

struct Tally
{
  int cases = 0;
  int nearest = 0; ///< where no sample is nearer than the foot …
  int proved = 0;  ///< … and the form says so
  int allowed = 0; ///< where a tenth more than the samples need is allowed …
  int enough = 0;  ///< … and the form says so
};

/// Asks for what holds and for what does not hold, close to the limit between them.
void judge_case(const Piece& piece, Case each, Tally& tally)
{
  const Real rounding = rounding_of(each, piece);
  const Real least = std::min(least_excess(piece, each.foot), 0.0L);
  ++tally.cases;
  for (const double factor : { 0.5, 0.9, 0.999, 1.1, 4.0 })
  {
    each.view.allowed = static_cast<double>(-least) * factor;
    const bool proved = proves<-1, -1>(piece, each.view);
    if (proved)
    {
      EXPECT_GE(least, -static_cast<Real>(each.view.allowed) - rounding)
        << "at " << each.view.t[0] << ' ' << each.view.t[1] << ", |r| " << length_of(each)
        << ", allowed " << each.view.allowed;
    }
    if (factor == 1.1 && -least > 1e-12L * length_of(each) * piece.reach)
    {
      ++tally.allowed;
      tally.enough += proved;
    }
  }
  // What is asked for in earnest: a small part of the distance.
  each.view.allowed = static_cast<double>(1e-12L * (length_of(each) + piece.reach) * piece.reach);
  const bool proved = proves<-1, -1>(piece, each.view);
  const bool nearest = least >= -rounding;
  tally.nearest += nearest;
  tally.proved += nearest && proved;
  EXPECT_TRUE(!proved || least >= -static_cast<Real>(each.view.allowed) - rounding)
    << "at " << each.view.t[0] << ' ' << each.view.t[1] << ", |r| " << length_of(each);
}

} // namespace

TEST(HeightForm, NothingIsNearerThanItSays)
{
  Tally tally;
  for (int seed = 0; seed < 500 / kShare; ++seed)
  {
    Random random(seed);
    std::string description;
    const SearchStructure structure =
      shapes::random_pieces(random, shapes::random_degrees(random), 120.0, description);
    SCOPED_TRACE(::testing::Message() << "seed " << seed << ": " << description);
    const footpoint::AlignedVector<Piece>& pieces = structure.forms.pieces();
    for (int k = 0; k < 3; ++k)
    {
      const int index = random.integer(0, static_cast<int>(pieces.size()) - 1);
      judge_case(pieces[index], random_case(random, structure, index), tally);
    }
  }
  EXPECT_GT(tally.nearest, 0.35 * tally.cases);
  EXPECT_GT(tally.proved, 0.7 * tally.nearest);
  EXPECT_GT(tally.enough, 0.15 * tally.allowed);
}

namespace
{

/// Judges parallelograms, of which the square form is exact.
/// \param decades of |r|, in sizes
Tally judge_parallelograms(double from, double to, bool orthogonal)
{
  Tally tally;
  Random random(7);
  for (int k = 0; k < 2000 / kShare; ++k)
  {
    const Vector3 corner = random.vector(-1.0, 1.0);
    const Vector3 u = random.vector(-1.0, 1.0);
    const DistanceForms forms =
      shapes::straight_piece({ { 1, 1 } }, corner, u, random.vector(-1.0, 1.0));
    const Piece& piece = forms.pieces()[0];
    const std::array<double, 2> t = shapes::random_place(random, piece);
    const Real length = piece.reach * std::pow(10.0L, random.uniform(from, to));
    const Vector direction = orthogonal ? normal_at(random, piece, { { t[0], t[1] } })
                                        : Vector(random.vector(-1.0, 1.0).cast<Real>());
    judge_case(piece,
      case_of(
        piece, 0, t, length * direction, footpoint::find_neighbourhoods(forms.pieces())[0].metric),
      tally);
  }
  return tally;
}

} // namespace

TEST(HeightForm, RoundingIsLeftOver)
{
  // So far away that 2 r·S is rounded by about the square of the size.
  const Tally tally = judge_parallelograms(14.0, 17.0, true);
  EXPECT_LT(tally.nearest, 0.9 * tally.cases);
  EXPECT_EQ(tally.proved, tally.nearest);
}

TEST(HeightForm, IsExactOfParallelograms)
{
  const Tally tally = judge_parallelograms(-1.0, 1.0, false);
  EXPECT_GT(tally.allowed, 0.7 * tally.cases);
  EXPECT_GT(tally.enough, 0.5 * tally.allowed); // the others would need more cells
}

TEST(HeightForm, ScalesWithTheModel)
{
  int proved = 0;
  int cases = 0;
  for (int seed = 0; seed < 400 / kShare; ++seed)
  {
    Random random(seed);
    std::string description;
    const SearchStructure structure =
      shapes::random_pieces(random, shapes::random_degrees(random), 0.0, description);
    SCOPED_TRACE(::testing::Message() << "seed " << seed << ": " << description);
    const Piece& piece = structure.forms.pieces()[0];
    Case each = random_case(random, structure, 0);
    for (int k = 0; k < 4; ++k)
    {
      each.view.allowed =
        static_cast<double>(length_of(each)) * piece.reach * random.magnitude(2.0) * 1e-2;
      const bool answer = proves<-1, -1>(piece, each.view);
      for (const int exponent : { -420, -300, -265, -257, -200, -30, 30, 200, 257, 300, 420 })
      {
        Piece scaled = piece;
        std::vector<double> net(piece.net, piece.net + piece.shape->net_size);
        for (std::size_t i = 0; i < net.size(); ++i)
        {
          net[i] = std::ldexp(net[i], i % 4 == 3 ? 0 : exponent);
        }
        scaled.net = net.data();
        scaled.reach = std::ldexp(piece.reach, exponent);
        HeightView view = each.view;
        for (int i = 0; i < 3; ++i)
        {
          view.f[i] = std::ldexp(view.f[i], exponent);
          view.r[i] = std::ldexp(view.r[i], exponent);
          view.metric[i] = std::ldexp(view.metric[i], 2 * exponent);
        }
        view.allowed = std::ldexp(view.allowed, 2 * exponent);
        const bool same = proves<-1, -1>(scaled, view);
        // Where squares of squares are lost less may be proved, but no more.
        EXPECT_TRUE(same == answer || (std::abs(exponent) > 200 && !same))
          << "2^" << exponent << ": " << same << " instead of " << answer;
      }
      proved += answer;
      ++cases;
    }
  }
  EXPECT_GT(proved, 0.2 * cases);
  EXPECT_LT(proved, 0.8 * cases);
}

TEST(HeightForm, ProvesPlanes)
{
  for (int p = 0; p <= 9; ++p)
  {
    for (int q = 1; q <= 9; ++q)
    {
      Random random(10 * p + q);
      const Vector3 corner = random.vector(-1.0, 1.0);
      const Vector3 u = random.vector(-1.0, 1.0);
      const DistanceForms forms =
        shapes::straight_piece({ { p, q } }, corner, u, random.vector(-1.0, 1.0));
      const Piece& piece = forms.pieces()[0];
      const PieceNeighbourhood around = footpoint::find_neighbourhoods(forms.pieces())[0];
      for (int k = 0; k < 10; ++k)
      {
        const std::array<double, 2> t = shapes::random_place(random, piece);
        const Vector normal = normal_at(random, piece, { { t[0], t[1] } });
        const Real length = random.magnitude(3.0);
        Case each = case_of(piece, 0, t, length * normal, around.metric);
        each.view.allowed = static_cast<double>(1e-12L * (length + piece.reach) * piece.reach);
        EXPECT_TRUE((proves<-1, -1>(piece, each.view)))
          << p << " by " << q << " at " << t[0] << ' ' << t[1] << ", |r| " << length;
        each.view.metric = {};
        EXPECT_TRUE((proves<-1, -1>(piece, each.view)));
      }
    }
  }
}

TEST(HeightForm, ProvesUpToTheRadiusOfCurvature)
{
  // Nothing else is lost where derivatives hardly vary: with all places of the foot in its cell.
  Random random(3);
  for (const double twist : { 0.0, 0.6, -0.6 })
  {
    // (x, y, (x² + y²)/2 + twist x y) for small x and y: radii of curvature 1/(1 ± |twist|).
    Points net = shapes::paraboloid().local_control_points();
    for (int k = 0; k < 9; ++k)
    {
      net(2, k) += twist * net(0, k) * net(1, k);
    }
    const footpoint::KnotVector knots(2, shapes::bezier_knots(2));
    DistanceForms forms(1);
    forms.add(0, Surface(knots, knots, net), Vector3::Zero(), kNoneSpecial);
    const Piece& piece = forms.pieces()[0];
    const PieceNeighbourhood around = footpoint::find_neighbourhoods(forms.pieces())[0];
    for (const double u : { 0.0, 0.3, 1.0 })
    {
      for (const double v : { 0.0, 0.45, 1.0 })
      {
        const auto proved = [&](double height)
        {
          const Vector normal = normal_at(random, piece, { { u, v } });
          Case each = case_of(piece, 0, { { u, v } }, -height * normal, around.metric);
          each.view.allowed = 1e-12 * std::abs(height) * piece.reach;
          return proves<-1, -1>(piece, each.view);
        };
        const double radius = 1.0 / (1.0 + std::abs(twist));
        const bool at_corner = u != 0.3 && v != 0.45;
        SCOPED_TRACE(::testing::Message() << "twist " << twist << " at " << u << ' ' << v);
        EXPECT_TRUE(proved(-1e4 * radius)); // the convex side
        EXPECT_TRUE(proved(0.01 * radius));
        EXPECT_TRUE(proved(0.98 * radius));
        // From a corner the piece need not lead along the direction of the smaller radius.
        EXPECT_FALSE(proved((at_corner ? 2.0 : 1.02) * radius));
      }
    }
  }
}

namespace
{

/// Whether fixed degrees are told to give the same answers.
template <int P, int Q>
void expect_same_answers(const std::array<int, 2>& degrees)
{
  int proved = 0;
  int cases = 0;
  for (int seed = 0; seed < 60 / kShare; ++seed)
  {
    Random random(seed);
    std::string description;
    const SearchStructure structure = shapes::random_pieces(random, degrees, 60.0, description);
    const footpoint::AlignedVector<Piece>& pieces = structure.forms.pieces();
    SCOPED_TRACE(::testing::Message() << "seed " << seed << ": " << description);
    for (int k = 0; k < 20; ++k)
    {
      const int index = random.integer(0, static_cast<int>(pieces.size()) - 1);
      const Piece& piece = pieces[index];
      Case each = random_case(random, structure, index);
      each.view.allowed = static_cast<double>(length_of(each)) * piece.reach *
        std::pow(10.0, random.uniform(-14.0, 0.0));
      const bool answer = proves<-1, -1>(piece, each.view);
      EXPECT_EQ((proves<P, Q>(piece, each.view)), answer);
      proved += answer;
      ++cases;
    }
  }
  EXPECT_GT(proved, 0.1 * cases);
  EXPECT_LT(proved, 0.9 * cases);
}

} // namespace

TEST(HeightForm, FixedDegreesAnswerTheSame)
{
  expect_same_answers<3, 3>({ { 3, 3 } });
  expect_same_answers<2, 2>({ { 2, 2 } });
  expect_same_answers<1, 1>({ { 1, 1 } });
  expect_same_answers<2, 1>({ { 2, 1 } });
  expect_same_answers<1, 2>({ { 1, 2 } });
  expect_same_answers<0, 3>({ { 0, 3 } });
  expect_same_answers<0, -1>({ { 0, 5 } });
}
