// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Judges the blocks of pieces that find_neighbourhoods makes, by sampling their nets in long
/// double.

#include "Oracle.h"
#include "Shapes.h"

#include "footpoint/search/piece_neighbourhood.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>

namespace blocks
{

using footpoint::DistanceForms;
using footpoint::Piece;
using footpoint::PieceNeighbourhood;
using oracle::Real;
using oracle::Vector;
using shapes::Random;

constexpr std::array<std::array<bool, 2>, 2> kNoneSpecial{};
using Pair = std::array<Real, 2>;

// === Pieces in long double, from their nets alone

/// Bernstein polynomials of degree n < 10, and their derivatives.
struct Basis
{
  std::array<Real, 10> value{};
  std::array<Real, 10> slope{};

  Basis(int n, Real t);
};

struct Place
{
  Vector point;
  std::array<Vector, 2> first; ///< derivatives by the piece's parameters
};

Place evaluate(const Piece& piece, const Pair& t);

// === The judge

struct Counts
{
  int pieces = 0;
  int blocks = 0;
  int queries = 0;
  /// Where the least distance is below by more than half of what the bound allows, or would where
  /// there is no curvature: a tenth of it.
  int reached = 0;
  int reached_flat = 0;
};

/// A foot, and S − P there.
struct Foot
{
  std::int32_t piece;
  Pair t;
  Place place;
  Vector r;
};

/// |S − P|² − |r|², without cancellation.
Real excess(const Foot& foot, const Vector& point);

/// The least excess of a piece: of 10 by 10 samples, then downhill from the best by halving steps.
Real least_excess(const Piece& piece, const Foot& foot);

/// Turns r, that is normal to the surface, so that P moves away from an end of the block, and now
/// and then by any angle, which leaves a gradient.
Vector turned(
  Random& random, const PieceNeighbourhood& around, const Foot& foot, const Vector& normal);

/// No point of the block of a random foot is nearer than the bound says.
void judge_foot(Random& random, const footpoint::AlignedVector<Piece>& pieces,
  const footpoint::AlignedVector<PieceNeighbourhood>& all, std::int32_t index, double size,
  Counts& counts);

/// Judges some feet of some pieces that have a limit.
void judge(Random& random, const DistanceForms& forms, double size, int queries, Counts& counts);

} // namespace blocks
