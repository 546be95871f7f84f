// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/solvers/frame.h"
#include "footpoint/solvers/solver_options.h"

#include <functional>

namespace footpoint
{

/// What a step may look at besides the frame.
template <int N>
struct StepSettings
{
  Eigen::Matrix<bool, N, 1> free; ///< directions not held by a bound; the others get Δ = 0
  Parameter<N> scale;             ///< unit of each parameter in the linear system (column scaling)
  double lambda = 0.0;            ///< damping; only Levenberg–Marquardt reads it
  /// Take eigenvalues of the matrix by magnitude, so that Δ is a descent direction whatever their
  /// signs (saddle-free Newton, Y. Dauphin et al. 2014); false: the bare A Δ = −g.
  bool descend = true;
};

/// Proposes Δt from a frame; the engine around it decides how much of it is taken.
template <int N>
using Step = std::function<Parameter<N>(const Frame<N>&, const StepSettings<N>&)>;

/// The step of a method.
/// \pre the paper's geometric methods (FirstOrder … SecondOrder3) are for curves
/// \throw std::invalid_argument where a surface is given one of them
template <int N>
Step<N> make_step(Method method);

/// Highest derivative that a method reads.
int derivative_order(Method method);

/// Solves A Δ = −g over the free directions, in the unit `settings.scale` of each.
template <int N>
Parameter<N> solve_scaled(const Eigen::Matrix<double, N, N>& matrix, const Parameter<N>& gradient,
  const StepSettings<N>& settings);

} // namespace footpoint
