// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/solvers/domain_walk.h"
#include "footpoint/solvers/local_solver.h"

namespace footpoint
{

/// |S_i| below this part of the direction's mean speed counts as standing still: a pole, a cusp.
constexpr double kStalledSpeed = 1e-7;

/// Rounding of the tangential residual r·S_i/|S_i|, as a fraction of the size: a thousand roundings,
/// for knot spans a thousandth of the domain long. Where no step helps any more, a residual below it
/// (or below the tolerances) still counts as zero.
constexpr double kResidualFloor = 1e-13;

/// Below this part of the mean speed the rounding of S_i, relative to S_i, is more than the thousand
/// roundings of kResidualFloor.
constexpr double kSpeedFloor = 1e-3;

/// The conditions of Karush, Kuhn and Tucker for the nearest point on one smooth piece.
template <int N>
class FootConditions
{
public:
  FootConditions(const ParametricGeometry<N>& geometry, const SolverOptions& options);

  const DomainWalk<N>& walk() const { return this->Walk; }

  /// Directions in which the frame may move without leaving its piece: all but those where it sits
  /// on a border and descent leads out.
  Eigen::Matrix<bool, N, 1> free(const Frame<N>& frame) const;

  /// |r·S_i| / |S_i| where free, else 0.
  Parameter<N> residuals(const Frame<N>& frame) const { return this->residuals(frame, frame.speed); }
  /// The same in units of other speeds: near a cusp |S_i| shrinks with r·S_i.
  Parameter<N> residuals(const Frame<N>& frame, const Parameter<N>& speeds) const;

  /// What the residual of a frame has to stay below.
  double tolerance(const Frame<N>& frame) const;
  /// The same where only rounding is left.
  double floor(const Frame<N>& frame) const;

  bool stalled(const Frame<N>& frame, int i) const;

  /// Where the foot lies. \pre the conditions hold on every piece that meets there
  FootType classify(const Frame<N>& frame, const Vector3& query) const;

private:
  const ParametricGeometry<N>& Geometry;
  const SolverOptions& Options;
  DomainWalk<N> Walk;
};

} // namespace footpoint
