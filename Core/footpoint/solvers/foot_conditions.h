// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/solvers/domain_walk.h"
#include "footpoint/solvers/local_solver.h"

#include <cmath>

namespace footpoint
{

/// |S_i| below this part of the direction's mean speed counts as standing still: a pole, a cusp.
constexpr double kStalledSpeed = 1e-7;

/// Rounding of the tangential residual r·S_i/|S_i|, as a fraction of the size: a thousand
/// roundings, for knot spans a thousandth of the domain long; more where |S_i| is small beside size
/// / domain, since S_i is a difference of positions. Where no step helps any more, a residual below
/// it (or below the tolerances) still counts as zero.
constexpr double kResidualFloor = 1e-13;

/// Rounding of a parameter, a few times over, as a fraction of the domain: where S_i changes fast,
/// one step of it moves the residual by more than kResidualFloor.
constexpr double kPlaceRounding = 1e-15;

/// A Newton step that moves a parameter by more than this part of the domain leaves the place of a
/// foot unsure.
constexpr double kPlaceTolerance = 1e-12;

template <int N>
bool is_noticeable(const Parameter<N>& step, const ParametricGeometry<N>& geometry)
{
  bool noticeable = false;
  for (int i = 0; i < N; ++i)
  {
    noticeable = noticeable || std::abs(step(i)) > kPlaceTolerance * geometry.direction(i).length;
  }
  return noticeable;
}

/// The conditions of Karush, Kuhn and Tucker for the nearest point on one smooth piece.
template <int N>
class FootConditions
{
public:
  FootConditions(const ParametricGeometry<N>& geometry, const SolverOptions& options);

  const DomainWalk<N>& walk() const { return this->Walk; }

  /// Directions in which the frame may move without leaving its piece: all but those where it sits
  /// on a border and descent leads out, or along a collapsed side.
  Eigen::Matrix<bool, N, 1> free(const Frame<N>& frame) const;

  /// |r·S_i| / |S_i| where free, else 0.
  Parameter<N> residuals(const Frame<N>& frame) const
  {
    return this->residuals(frame, frame.speed);
  }
  /// The same in units of other speeds: near a cusp |S_i| shrinks with r·S_i.
  Parameter<N> residuals(const Frame<N>& frame, const Parameter<N>& speeds) const;

  /// What the residual of a frame has to stay below.
  double tolerance(const Frame<N>& frame) const;
  /// The same in one direction where only rounding is left. \pre the frame has second derivatives
  double floor(const Frame<N>& frame, int i) const;
  /// The largest residual over its floor: above 1 there is a slope.
  double excess(const Frame<N>& frame) const;

  bool stalled(const Frame<N>& frame, int i) const;

  /// Where the foot lies. \pre the conditions hold on every piece that meets there
  FootType classify(const Frame<N>& frame, const Vector3& query) const;

private:
  const ParametricGeometry<N>& Geometry;
  const SolverOptions& Options;
  DomainWalk<N> Walk;
};

} // namespace footpoint
