// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// What trim loops keep, in long double and without the core: polygons through the loops, refined
/// where a point is nearer to a side than the side is to its curve.

#include "FastSpline.h"
#include "TrimShapes.h"

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

namespace oracle
{

using Place = std::array<Real, 2>;

/// A curve of a loop, or the line over a gap.
class LoopCurve
{
public:
  explicit LoopCurve(const footpoint::Curve& curve);
  LoopCurve(const Place& from, const Place& to);

  bool is_gap() const { return !this->Spline; }
  std::vector<Real> breaks() const;
  Place at(Real t) const;

private:
  std::shared_ptr<const FastSpline<1>> Spline;
  Place From{};
  Place To{};
};

class LoopOracle
{
public:
  /// \param width of the surface's domain: distances are in parts of it
  LoopOracle(const std::vector<footpoint::TrimLoop>& loops, const Place& width);

  const std::vector<LoopCurve>& curves() const { return this->Curves; }
  /// Of each curve, the number of its loop.
  const std::vector<int>& loops() const { return this->Loops; }
  const Place& lower() const { return this->Low; }
  const Place& upper() const { return this->High; }

  /// Whether the loops keep a point: the winding number by crossings of a ray along u. A point that
  /// is nearer to a loop than long double tells may be either.
  bool keeps(const Place& at) const;

  /// How far a point is from the loops, in parts of the domain.
  Real distance(const Place& at) const;

  /// Whether anything is kept just beside the loops within a distance of a point, in parts of the
  /// domain: also in the tip of a cusp between two curves that touch, which no direction from the
  /// point meets.
  bool keeps_beside_loops(const Place& at, Real within) const;

private:
  static constexpr int kLooks = 200;         ///< along a side
  static constexpr Real kBesideLoop = 1e-9L; ///< in parts of the domain
  static constexpr int kOfSpan = 24;         ///< sides of a span
  static constexpr int kDeepest = 40;        ///< halvings of a side
  static constexpr Real kRounding = 1e-17L;  ///< of points of curves, in parts of the domain
  static constexpr std::size_t kSlabs = 256;

  struct Side
  {
    std::size_t curve;
    Real t[2];
    Place end[2];
    Real bulge; ///< at least the distance of the curve from the side, in parts of the domain
  };

  Side side(std::size_t curve, Real t0, Real t1, const Place& from, const Place& to) const;
  void add(const footpoint::TrimLoop& loop);
  void fill_slabs();
  std::size_t slab(Real v) const;
  Real distance_to_chord(const Side& one, const Place& at) const;
  std::array<Side, 2> halves(const Side& one) const;
  int crossings(const Side& one, const Place& at, int deeper) const;
  void refine_distance(const Side& one, const Place& at, Real& best, int deeper) const;

  Place Width;
  Place Low;
  Place High;
  std::vector<LoopCurve> Curves;
  std::vector<int> Loops;
  std::vector<Side> Sides;
  std::vector<std::vector<std::size_t>> Slabs; ///< numbers of the sides that a ray in them meets
};

} // namespace oracle
