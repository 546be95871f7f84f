// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/solvers/step.h"

namespace footpoint
{

/// Why the iteration ended.
enum class Termination
{
  PointCoincidence, ///< the point lies on the geometry
  ZeroCosine,       ///< r is orthogonal to every direction that is free
  SmallStep,        ///< the step fell below its tolerance
  Stagnation,       ///< no step brought the point nearer
  IterationLimit
};

/// Where on the geometry a foot lies; numbers are those of the array FootType.
enum class FootType
{
  Interior = 0,  ///< an orthogonal foot
  Edge = 1,      ///< boundary of a surface, side of a gap
  Vertex = 2,    ///< corner of a surface, end of a curve
  Kink = 3,      ///< C0 line or point inside, where r is not orthogonal
  Degenerate = 4 ///< pole, collapsed side, or a place where a derivative vanishes
};

/// The best point that a local search has found, converged or not.
template <int N>
struct LocalFoot
{
  Parameter<N> parameter; ///< local parameters
  Sides<N> sides;         ///< of which smooth piece `parameter` is a border, where it is one
  Vector3 point;          ///< S, relative to the geometry's centre
  double distance = 0.0;  ///< |S − P|
  /// Largest |r·S_i| / |S_i| over the free directions (those not held by a bound): how far, to
  /// first order, the foot is from orthogonality, in model units.
  double residual = 0.0;
  int iterations = 0;     ///< the start counts as the first
  bool converged = false; ///< the conditions of the constrained minimum hold (Karush, Kuhn, Tucker)
  Termination termination = Termination::IterationLimit;
  FootType type = FootType::Interior;
};

/// Descends from a start to a nearby local minimum of the distance, over knot lines, kinks and
/// seams. \param query local coordinates: P − geometry.centre() \param start local parameters,
/// brought into the domain (wrapped where closed, else clamped)
template <int N>
LocalFoot<N> find_local_foot(const ParametricGeometry<N>& geometry, const Vector3& query,
  const Parameter<N>& start, const SolverOptions& options = {});

/// The same engine with a step of one's own in place of `options.method`.
template <int N>
LocalFoot<N> find_local_foot(const ParametricGeometry<N>& geometry, const Vector3& query,
  const Parameter<N>& start, const SolverOptions& options, const Step<N>& step);

} // namespace footpoint
