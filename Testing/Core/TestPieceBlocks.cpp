// SPDX-License-Identifier: BSD-3-Clause

/// How near a query has to be for a foot to be the nearest point of a block of pieces.

#include "BlockJudge.h"
#include "RandomSheets.h"
#include "SlowBuild.h"

using footpoint::Curve;
using footpoint::KnotVector;
using footpoint::Points;
using footpoint::Surface;
using footpoint::Vector3;
using namespace blocks;

namespace
{

constexpr int kShare = kSlowBuild ? 5 : 1;

} // namespace

TEST(PieceBlocks, NothingOfABlockIsNearer)
{
  Counts smooth;
  Counts rational;
  for (int seed = 0; seed < 400 / kShare; ++seed)
  {
    Random random(seed);
    std::string description;
    const shapes::Arrays<2> arrays = shapes::random_sheet(random, description);
    SCOPED_TRACE(::testing::Message() << "seed " << seed << ": " << description);
    const Surface surface = arrays.geometry();
    DistanceForms forms(random.integer(0, 1) == 0 ? 1 : 100); // as it is, or cut
    forms.add(0, surface, Vector3::Zero(), kNoneSpecial);
    judge(random, forms, surface.size(), 25, surface.rational() ? rational : smooth);
  }
  // Some of them are folded, collapsed, rough or far from evenly parametrized.
  EXPECT_GT(smooth.blocks, 0.4 * smooth.pieces);
  EXPECT_GT(rational.blocks, 0.5 * rational.pieces);
  EXPECT_GT(smooth.queries, kSlowBuild ? 700 : 4000);
  EXPECT_GT(rational.queries, kSlowBuild ? 180 : 1000);
}

TEST(PieceBlocks, NothingOfABlockOfACurveIsNearer)
{
  Counts counts;
  for (int seed = 0; seed < 150 / kShare; ++seed)
  {
    SCOPED_TRACE(::testing::Message() << "seed " << seed);
    Random random(seed);
    const Curve curve = shapes::random_curve(random);
    DistanceForms forms(random.integer(0, 1) == 0 ? 1 : 100);
    forms.add(0, curve, Vector3::Zero(), kNoneSpecial);
    judge(random, forms, curve.size(), 40, counts);
  }
  EXPECT_GT(counts.blocks, 0.75 * counts.pieces);
  EXPECT_GT(counts.reached_flat, 15 / kShare);
}

TEST(PieceBlocks, TheBoundIsReachedWhereTheCurvatureIsConstant)
{
  Random random(1);
  const Surface surface = shapes::paraboloid();
  DistanceForms forms;
  forms.add(0, surface, Vector3::Zero(), kNoneSpecial);
  Counts counts;
  judge(random, forms, surface.size(), 1000, counts);
  EXPECT_EQ(counts.queries, 1000);
  EXPECT_GT(counts.reached, 30);
  // Nine tenths of the radius of curvature, but for what the derivatives vary.
  const double limit = footpoint::find_neighbourhoods(forms.pieces())[0].limit;
  EXPECT_GT(limit, 0.8);
  EXPECT_LE(limit, 0.9);
}

TEST(PieceBlocks, SmoothSheetsAreAllBlocks)
{
  const Surface surface = shapes::bumpy(30, 4, 0.01);
  DistanceForms forms;
  forms.add(0, surface, Vector3::Zero(), kNoneSpecial);
  int blocks = 0;
  int whole = 0;
  for (const PieceNeighbourhood& each : footpoint::find_neighbourhoods(forms.pieces()))
  {
    blocks += each.limit > 1e-4 * surface.size();
    whole += each.block == 0x1ff;
  }
  EXPECT_GT(blocks, 0.99 * 27 * 27);
  EXPECT_GT(whole, 0.99 * 25 * 25);
}

TEST(PieceBlocks, PiecesOfSurfacesOfRevolutionHaveSome)
{
  const auto share = [](const Surface& surface)
  {
    Random random(3);
    DistanceForms forms;
    forms.add(0, surface, Vector3::Zero(), kNoneSpecial);
    Counts counts;
    judge(random, forms, surface.size(), 500, counts);
    EXPECT_EQ(counts.queries, 500);
    int blocks = 0;
    for (const PieceNeighbourhood& each : footpoint::find_neighbourhoods(forms.pieces()))
    {
      blocks += each.limit > 2e-3 * surface.size();
    }
    return static_cast<double>(blocks) / static_cast<double>(forms.pieces().size());
  };
  EXPECT_EQ(share(shapes::torus()), 1.0);
  EXPECT_EQ(share(shapes::cylinder()), 1.0);
  EXPECT_EQ(share(shapes::sphere()), 0.5); // none at the poles
}

TEST(PieceBlocks, PlanesHaveNoCurvature)
{
  for (const double turn : { 0.0, 0.3 })
  {
    Points net(3, 4);
    net << 0, 1, 0, 1, 0, 0, 1, 1, 0, turn, 2.0 * turn, 3.0 * turn;
    const Surface surface(KnotVector(1, { 0, 0, 1, 1 }), KnotVector(1, { 0, 0, 1, 1 }), net);
    DistanceForms forms;
    forms.add(0, surface, Vector3::Zero(), kNoneSpecial);
    EXPECT_GT(footpoint::find_neighbourhoods(forms.pieces())[0].limit, 1e9);
  }
}

namespace
{

/// \param weights none: not rational
void expect_to_scale(const Eigen::VectorXd& weights)
{
  const Surface surface = shapes::bumpy(8, 5);
  const Points net = surface.local_control_points();
  const auto neighbourhoods = [&](int exponent)
  {
    DistanceForms forms(1);
    const Surface scaled(
      surface.knots(0), surface.knots(1), std::ldexp(1.0, exponent) * net, weights);
    forms.add(0, scaled, Vector3::Zero(), kNoneSpecial);
    return footpoint::find_neighbourhoods(forms.pieces());
  };
  const footpoint::AlignedVector<PieceNeighbourhood> all = neighbourhoods(0);
  EXPECT_GT(all[12].limit, 0.0);
  for (const int exponent : { -400, -130, -30, 30, 130, 400 })
  {
    const footpoint::AlignedVector<PieceNeighbourhood> scaled = neighbourhoods(exponent);
    for (std::size_t k = 0; k < all.size(); ++k)
    {
      EXPECT_EQ(scaled[k].pieces, all[k].pieces);
      EXPECT_EQ(scaled[k].block, all[k].block);
      EXPECT_EQ(scaled[k].limit, all[k].limit < 0.0 ? -1.0 : std::ldexp(all[k].limit, exponent));
      EXPECT_EQ(scaled[k].square_factor, all[k].square_factor);
      EXPECT_EQ(scaled[k].rounding, all[k].rounding);
      for (int i = 0; i < 2; ++i)
      {
        EXPECT_EQ(scaled[k].inverse_speed[i], std::ldexp(all[k].inverse_speed[i], -exponent));
      }
    }
  }
  // Where squares of roundings are lost nothing is known.
  for (const int exponent : { -1000, -530, -450, 450, 530, 1000 })
  {
    for (const PieceNeighbourhood& each : neighbourhoods(exponent))
    {
      EXPECT_EQ(each.block, 0);
      EXPECT_LT(each.limit, 0.0);
    }
  }
}

} // namespace

TEST(PieceBlocks, ScaleWithTheModel)
{
  expect_to_scale({});
}

TEST(PieceBlocks, ScaleWithTheModelThatIsRational)
{
  Random random(4);
  Eigen::VectorXd weights(64);
  for (double& each : weights)
  {
    each = random.uniform(0.7, 1.4);
  }
  expect_to_scale(weights);
}

TEST(PieceBlocks, ModelsOfOnePointHaveNone)
{
  const Surface surface(
    KnotVector(1, { 0, 0, 1, 1 }), KnotVector(1, { 0, 0, 1, 1 }), Points::Zero(3, 4));
  DistanceForms forms;
  EXPECT_TRUE(footpoint::find_neighbourhoods(forms.pieces()).empty());
  forms.add(0, surface, Vector3::Zero(), kNoneSpecial);
  EXPECT_LT(footpoint::find_neighbourhoods(forms.pieces())[0].limit, 0.0);
}
