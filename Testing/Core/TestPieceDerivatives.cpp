// SPDX-License-Identifier: BSD-3-Clause

/// Bounds of a piece's derivatives, and what a block makes of them, each for itself.

#include "BlockJudge.h"
#include "RandomSheets.h"

#include "footpoint/search/rational_derivatives.h"

using footpoint::BlockFrame;
using footpoint::Curve;
using footpoint::PieceDerivatives;
using footpoint::DerivativeUnits;
using footpoint::Surface;
using footpoint::Vector3;
using footpoint::WaySpeed;
using namespace blocks;

namespace
{

/// How much of its bounds a piece makes use of, at the most, and how much of them all pieces do.
struct Use
{
  Real first = 0.0L;
  Real second = 0.0L;
  Real shares = 0.0L; ///< of the boxes' diagonals that samples span, and of the largest bound
  int count = 0;

  Real share() const { return this->shares / this->count; }
};

PieceDerivatives bounds_of(const Piece& piece, const DerivativeUnits& units)
{
  footpoint::RationalDerivatives rational;
  return piece.shape->rational ? rational.bounds(piece, units)
                               : footpoint::piece_derivatives(piece, units);
}

/// Derivatives by the units' parameters.
std::array<Vector, 2> derivatives(const Piece& piece, const DerivativeUnits& units, const Pair& t)
{
  std::array<Vector, 2> first = evaluate(piece, t).first;
  for (int i = 0; i < 2; ++i)
  {
    const Real width = piece.width[i];
    first[i] *= width > 0.0L ? units.length * units.width[i] / width : 0.0L;
  }
  return first;
}

/// The derivatives at 6 by 6 places keep to the bounds.
void check_piece(const Piece& piece, Use& use)
{
  const DerivativeUnits units{ 0.25, { { 3.0, 0.5 } } };
  const PieceDerivatives bounds = bounds_of(piece, units);
  std::array<Real, 2> scale;
  for (int i = 0; i < 2; ++i)
  {
    scale[i] = piece.width[i] > 0.0 ? units.width[i] / static_cast<Real>(piece.width[i]) : 0.0L;
  }
  std::array<Vector, 2> lower;
  std::array<Vector, 2> upper;
  lower.fill(Vector::Constant(std::numeric_limits<Real>::infinity()));
  upper.fill(-lower[0]);
  constexpr Real kStep = 1e-6L;
  constexpr Real kAllowed = 1.0L + 1e-12L;
  for (int sample = 0; sample < 36; ++sample)
  {
    // Second derivatives are central differences of first ones.
    Pair t{ { sample / 6 / 5.0L, sample % 6 / 5.0L } };
    const std::array<Vector, 2> first = derivatives(piece, units, t);
    for (int i = 0; i < 2; ++i)
    {
      lower[i] = lower[i].cwiseMin(first[i]);
      upper[i] = upper[i].cwiseMax(first[i]);
      for (int k = 0; k < 3; ++k)
      {
        const Real value = first[i][k];
        const Real off = std::abs(value - bounds.box[k](i));
        const Real half = bounds.box[k](2 + i);
        const Real rounding = 1e-14L * units.length * scale[i] * piece.reach;
        EXPECT_LE(off, half * kAllowed + rounding) << "direction " << i << " coordinate " << k;
        use.first = std::max(use.first, half > rounding ? off / half : 0.0L);
      }
      for (int j = i; j < 2; ++j)
      {
        Pair before = t;
        Pair after = t;
        before[j] -= kStep;
        after[j] += kStep;
        const Vector difference =
          evaluate(piece, after).first[i] - evaluate(piece, before).first[i];
        const Real value = units.length * scale[i] * scale[j] * difference.norm() / (2.0L * kStep);
        const Real bound = bounds.second[i + j];
        const Real off = 1e-12L * units.length * scale[i] * scale[j] * piece.reach;
        EXPECT_LE(value, bound * (1.0L + 1e-7L) + off) << "directions " << i << " and " << j;
        use.second = std::max(use.second, value > 1e3L * off ? value / bound : 0.0L);
      }
    }
  }
  for (int i = 0; i < 2; ++i)
  {
    const Real spanned = 0.5L * (upper[i] - lower[i]).norm();
    const Real half =
      Vector(bounds.box[0](2 + i), bounds.box[1](2 + i), bounds.box[2](2 + i)).norm();
    if (spanned > 1e-9L * units.length * scale[i] * piece.reach)
    {
      use.shares += spanned / half;
      ++use.count;
    }
  }
}

/// The pieces of a random sheet and a random curve, cut where they are bent or not.
DistanceForms random_forms(int seed, std::string& description)
{
  Random random(seed);
  const Surface surface = shapes::random_sheet(random, description).geometry();
  const Curve curve = shapes::random_curve(random);
  DistanceForms forms(random.integer(0, 1) == 0 ? 1 : 50);
  forms.add(0, surface, Vector3::Zero(), kNoneSpecial);
  forms.add(1, curve, Vector3::Zero(), kNoneSpecial);
  return forms;
}

} // namespace

TEST(PieceDerivatives, HoldTheDerivatives)
{
  Use polynomial;
  Use rational;
  for (int seed = 0; seed < 200; ++seed)
  {
    std::string description;
    const DistanceForms forms = random_forms(seed, description);
    SCOPED_TRACE(::testing::Message() << "seed " << seed << ": " << description);
    for (const Piece& piece : forms.pieces())
    {
      check_piece(piece, piece.shape->rational ? rational : polynomial);
    }
  }
  // They are no wider than needed: exact at the ends of a piece where the weights are equal.
  EXPECT_GT(polynomial.first, 0.999L);
  EXPECT_GT(polynomial.second, 0.95L);
  EXPECT_GT(rational.first, 0.999L);
  EXPECT_GT(rational.second, 0.95L);
  EXPECT_GT(polynomial.share(), 0.9L);
  EXPECT_GT(rational.share(), 0.9L);
}

TEST(RationalDerivatives, SpeedIsTheLeastOverThePiece)
{
  int judged = 0;
  int close = 0;
  int sharper = 0;
  const DerivativeUnits units{ 0.25, { { 3.0, 0.5 } } };
  footpoint::RationalDerivatives rational;
  for (int seed = 0; seed < 400; ++seed)
  {
    std::string description;
    const DistanceForms forms = random_forms(seed, description);
    SCOPED_TRACE(::testing::Message() << "seed " << seed << ": " << description);
    for (const Piece& piece : forms.pieces())
    {
      if (!piece.shape->rational)
      {
        continue;
      }
      const PieceDerivatives bounds = bounds_of(piece, units);
      const BlockFrame frame(bounds.box, piece.shape->degree[0] == 0);
      if (!frame.valid)
      {
        continue;
      }
      Real least = std::numeric_limits<Real>::infinity();
      for (int sample = 0; sample < 36; ++sample)
      {
        const std::array<Vector, 2> first =
          derivatives(piece, units, { { sample / 6 / 5.0L, sample % 6 / 5.0L } });
        // The symmetric part of the derivatives by the block's parameters, and its lower
        // eigenvalue.
        Eigen::Matrix<Real, 2, 2> part;
        for (int i = 0; i < 2; ++i)
        {
          const Vector axis(frame.axes[i][0](0), frame.axes[i][1](0), frame.axes[i][2](0));
          for (int j = 0; j < 2; ++j)
          {
            part(i, j) = axis.dot(first[0] * static_cast<Real>(frame.rows[0][j]) +
              first[1] * static_cast<Real>(frame.rows[1][j]));
          }
        }
        const Real lower = 0.5L *
          (part(0, 0) + part(1, 1) -
            std::hypot(part(0, 0) - part(1, 1), part(0, 1) + part(1, 0)));
        least = std::min(least, frame.curve ? part(1, 1) : lower);
      }
      const double found = rational.speed(piece, units, frame);
      const double of_boxes = frame.speed_of(bounds).speed;
      EXPECT_LE(found, least + 1e-12L);
      EXPECT_GE(found, of_boxes - 1e-9 * (1.0 + std::abs(of_boxes)));
      ++judged;
      close += found > least - 0.05L;
      sharper += found > of_boxes + 0.1;
    }
  }
  EXPECT_GT(judged, 5000);
  EXPECT_GT(close, 0.85 * judged);
  EXPECT_GT(sharper, 0.5 * judged);
}

TEST(BlockFrame, SpeedsAreTheLeastOverAllDerivativesAndWays)
{
  constexpr int kDirections = 180;
  int close = 0;
  for (int seed = 0; seed < 200; ++seed)
  {
    SCOPED_TRACE(::testing::Message() << "seed " << seed);
    Random random(seed);
    PieceDerivatives::Box mean;
    PieceDerivatives bounds{};
    Vector3 first[2];
    for (Vector3& each : first)
    {
      each = random.magnitude(1.0) * random.vector(-1.0, 1.0);
    }
    const double width = 0.3 * random.uniform(0.0, 1.0);
    for (int k = 0; k < 3; ++k)
    {
      mean[k] << first[0](k), first[1](k), 0.0, 0.0;
      bounds.box[k] = mean[k];
      for (int i = 0; i < 2; ++i)
      {
        bounds.box[k](i) += 0.1 * first[i].norm() * random.uniform(-1.0, 1.0);
        bounds.box[k](2 + i) = width * first[i].norm() * random.uniform(0.0, 1.0);
      }
      bounds.second[k] = random.uniform(0.0, 1.0);
    }
    const BlockFrame frame(mean, false);
    ASSERT_TRUE(frame.valid);
    const WaySpeed found = frame.speed_of(bounds);
    double least = std::numeric_limits<double>::infinity();
    double greatest = 0.0;
    for (int direction = 0; direction < kDirections; ++direction)
    {
      const double angle = 2.0 * std::acos(-1.0) * direction / kDirections;
      // A way of length 1 on the plane of the mean derivatives, and its parameters.
      const Vector3 one = first[1].normalized();
      const Vector3 two = (first[0] - first[0].dot(one) * one).normalized();
      const Vector3 way = std::cos(angle) * one + std::sin(angle) * two;
      Eigen::Vector2d t;
      t(0) = std::sin(angle) / first[0].dot(two);
      t(1) = (std::cos(angle) - t(0) * first[0].dot(one)) / first[1].norm();
      EXPECT_LE((t(0) * first[0] + t(1) * first[1] - way).norm(), 1e-10);
      double along = 0.0; // of the way in space along itself, at the least
      for (int i = 0; i < 2; ++i)
      {
        for (int k = 0; k < 3; ++k)
        {
          const double factor = t(i) * way(k);
          along += factor * bounds.box[k](i) - std::abs(factor) * bounds.box[k](2 + i);
        }
      }
      least = std::min(least, along);
      const Eigen::Vector2d size = t.cwiseAbs();
      greatest = std::max(greatest,
        bounds.second[0] * size(0) * size(0) + 2.0 * bounds.second[1] * size(0) * size(1) +
          bounds.second[2] * size(1) * size(1));
    }
    EXPECT_LE(found.speed, least + 1e-12);
    EXPECT_GE(found.bend, greatest * (1.0 - 1e-12));
    EXPECT_LE(found.bend, 2.0 * greatest);
    close += found.speed > least - 0.1;
  }
  EXPECT_GT(close, 50);
}

TEST(BlockFrame, OfDerivativesThatAreParallelOrVanishThereIsNone)
{
  const auto frame = [](const Vector3& u, const Vector3& v, bool curve)
  {
    PieceDerivatives::Box mean;
    for (int k = 0; k < 3; ++k)
    {
      mean[k] << u(k), v(k), 0.0, 0.0;
    }
    return BlockFrame(mean, curve);
  };
  const Vector3 x = Vector3::UnitX();
  const Vector3 y = Vector3::UnitY();
  const Vector3 none = Vector3::Zero();
  EXPECT_TRUE(frame(x, y, false).valid);
  EXPECT_TRUE(frame(none, y, true).valid);
  EXPECT_FALSE(frame(x, x, false).valid);
  EXPECT_FALSE(frame(x + 1e-4 * y, x, false).valid);
  EXPECT_FALSE(frame(none, y, false).valid);
  EXPECT_FALSE(frame(x, none, false).valid);
  EXPECT_FALSE(frame(none, none, true).valid);
  EXPECT_FALSE(frame(x, 1e-50 * y, false).valid);
  EXPECT_FALSE(frame(1e50 * x, y, false).valid);
  EXPECT_FALSE(frame(x, NAN * y, false).valid);
  EXPECT_FALSE(frame(NAN * x, y, false).valid);
  EXPECT_FALSE(frame(none, INFINITY * Vector3::Ones(), true).valid);
}
