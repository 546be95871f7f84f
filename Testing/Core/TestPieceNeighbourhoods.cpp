// SPDX-License-Identifier: BSD-3-Clause

/// Which pieces go on smoothly from a piece: judged by looking at all of them.

#include "BlockJudge.h"
#include "RandomSheets.h"
#include "TrimShapes.h"

#include <set>

using footpoint::KnotVector;
using footpoint::Surface;
using footpoint::Vector3;
using namespace blocks;

namespace
{

/// Lines over which a direction is not once continuously differentiable, and its ends.
std::set<double> kinks(const KnotVector& knots)
{
  std::set<double> all;
  for (const footpoint::DistinctKnot& knot : knots.distinct_knots())
  {
    if (knot.multiplicity >= knots.degree() || knot.at == 0.0 || knot.at == knots.length())
    {
      all.insert(knot.at);
    }
  }
  return all;
}

/// The piece beyond an end that is as wide across, by looking at all of them.
std::int32_t piece_beyond(
  const footpoint::AlignedVector<Piece>& pieces, const Piece& piece, int i, int end)
{
  const double border = end == 0 ? piece.lower[i] : piece.upper[i];
  for (std::size_t k = 0; k < pieces.size(); ++k)
  {
    const Piece& other = pieces[k];
    if (other.patch == piece.patch && (end == 0 ? other.upper : other.lower)[i] == border &&
      other.lower[1 - i] == piece.lower[1 - i] && other.upper[1 - i] == piece.upper[1 - i])
    {
      return static_cast<std::int32_t>(k);
    }
  }
  return -1;
}

/// Points and derivatives on both sides of a border are the same.
void expect_smooth(const Piece& here, const Piece& there, int i, int end, double size)
{
  for (const Real along : { 0.0L, 0.3L, 1.0L })
  {
    Pair t{ { along, along } };
    t[i] = end;
    const Place one = evaluate(here, t);
    t[i] = 1 - end;
    const Place other = evaluate(there, t);
    EXPECT_LE((one.point - other.point).norm(), 1e-14L * size);
    for (int k = 0; k < 2; ++k)
    {
      const Real width = std::min(here.width[k], there.width[k]);
      const Vector jump = one.first[k] / static_cast<Real>(here.width[k]) -
        other.first[k] / static_cast<Real>(there.width[k]);
      EXPECT_LE(jump.norm() * width, 1e-12L * size);
    }
  }
}

/// Returns the number of pieces that were found beside others.
int check_neighbours(const DistanceForms& forms, const Surface& surface)
{
  const footpoint::AlignedVector<Piece>& pieces = forms.pieces();
  const footpoint::AlignedVector<PieceNeighbourhood> all = footpoint::find_neighbourhoods(pieces);
  const std::set<double> special[2] = { kinks(surface.knots(0)), kinks(surface.knots(1)) };
  int sides = 0;
  EXPECT_EQ(all.size(), pieces.size());
  for (std::size_t k = 0; k < pieces.size(); ++k)
  {
    const PieceNeighbourhood& each = all[k];
    const Piece& piece = pieces[k];
    EXPECT_EQ(each.pieces[4], static_cast<std::int32_t>(k));
    for (int i = 0; i < 2; ++i)
    {
      for (int end = 0; end < 2; ++end)
      {
        const bool crossed = special[i].count((end == 0 ? piece.lower : piece.upper)[i]) == 0;
        const std::int32_t beyond = crossed ? piece_beyond(pieces, piece, i, end) : -1;
        EXPECT_EQ(each.beside(i, end), beyond)
          << "piece " << k << " direction " << i << " end " << end;
        if (beyond >= 0)
        {
          ++sides;
          expect_smooth(piece, pieces[beyond], i, end, surface.size());
        }
      }
    }
    for (const int at : { 0, 2, 6, 8 })
    {
      const std::int32_t beside_u = each.pieces[3 * (at / 3) + 1];
      const std::int32_t beside_v = each.pieces[3 + at % 3];
      const std::int32_t corner =
        beside_u < 0 || beside_v < 0 ? -1 : piece_beyond(pieces, pieces[beside_u], 1, at % 3 / 2);
      const bool two_ways =
        corner >= 0 && corner == piece_beyond(pieces, pieces[beside_v], 0, at / 3 / 2);
      EXPECT_EQ(each.pieces[at], two_ways ? corner : -1) << "piece " << k << " place " << at;
    }
    for (int at = 0; at < 9; ++at)
    {
      if ((each.block >> at & 1) != 0)
      {
        EXPECT_GE(each.limit, 0.0);
        EXPECT_GE(each.pieces[at], 0);
        EXPECT_TRUE(
          (each.block >> (3 * (at / 3) + 1) & 1) != 0 && (each.block >> (3 + at % 3) & 1) != 0);
      }
    }
    EXPECT_EQ(each.block != 0, each.limit >= 0.0);
  }
  return sides;
}

} // namespace

TEST(PieceNeighbourhoods, AreThePiecesThatGoOnSmoothly)
{
  int sides = 0;
  for (int seed = 0; seed < 60; ++seed)
  {
    Random random(seed);
    std::string description;
    const Surface surface = shapes::random_sheet(random, description).geometry();
    SCOPED_TRACE(::testing::Message() << "seed " << seed << ": " << description);
    DistanceForms forms(seed % 2 == 0 ? 1 : 60); // as it is, or cut
    forms.add(0, surface, Vector3::Zero(), kNoneSpecial);
    forms.add(1, surface, Vector3(surface.size(), 0.0, 0.0), kNoneSpecial);
    sides += check_neighbours(forms, surface);
  }
  EXPECT_GT(sides, 5000);
}

TEST(PieceNeighbourhoods, OfGapsSeamsAndPoles)
{
  for (int seed = 0; seed < 20; ++seed)
  {
    SCOPED_TRACE(::testing::Message() << "seed " << seed);
    Random random(seed);
    const Surface surface =
      shapes::random_arrays<2>(random, { { random.integer(1, 4), random.integer(1, 4) } }, 5,
        seed % 2 == 0, seed % 3 == 0 ? 0.5 : 0.0)
        .geometry();
    DistanceForms forms(60);
    forms.add(0, surface, Vector3::Zero(), kNoneSpecial);
    check_neighbours(forms, surface);
  }
  for (const Surface& surface : { shapes::torus(), shapes::sphere(), shapes::cylinder() })
  {
    DistanceForms forms;
    forms.add(0, surface, Vector3::Zero(), kNoneSpecial);
    EXPECT_GT(check_neighbours(forms, surface), 0);
  }
}

TEST(PieceNeighbourhoods, OfTrimmedPatches)
{
  // A diamond leaves out the corners of the sheet.
  const Surface surface = shapes::bumpy(14, 8);
  const footpoint::TrimRegion region(
    { trims::polygon({ { 0.5, 0.05 }, { 0.95, 0.5 }, { 0.5, 0.95 }, { 0.05, 0.5 } }) }, surface,
    0.0);
  DistanceForms forms(0);
  forms.add(0, surface, Vector3::Zero(), kNoneSpecial, &region);
  EXPECT_LT(forms.pieces().size(), 100U);
  EXPECT_GT(check_neighbours(forms, surface), 100);
  Random random(2);
  Counts counts;
  judge(random, forms, surface.size(), 300, counts);
  EXPECT_EQ(counts.queries, 300);
}
