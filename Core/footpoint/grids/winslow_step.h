// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/grids/winslow_equations.h"

#include <Eigen/SparseLU>

namespace footpoint
{

/// A grid on its surface and how far it is from solving the equations.
struct WinslowState
{
  Points points;
  WinslowEquations::Places places;
  Eigen::VectorXd along_sides; ///< arc lengths of the points that slide, else empty
  Eigen::VectorXd residual;
  double norm = 0.0;
};

/// Steps along the tangents, two numbers per unknown.
class WinslowStep
{
public:
  /// \param equations must outlive this
  /// \param sliding   points of the sides are unknowns
  explicit WinslowStep(const WinslowEquations& equations, bool sliding = false)
    : Equations(equations)
    , Sliding(sliding)
  {
  }

  /// Solves the equations with α, β and γ held.
  Eigen::VectorXd picard(const WinslowState& state);

  /// Solves the linearized equations by BiCGSTAB, preconditioned with a Picard matrix that is kept
  /// as long as it serves; with sliding sides by factors of its own, because a matrix that is the
  /// same for each coordinate does not know a point that has one direction only.
  Eigen::VectorXd newton(const WinslowState& state);

private:
  using Matrix = WinslowEquations::Matrix;
  // The unknowns are numbered by nested dissection already.
  using Factors = Eigen::SparseLU<Matrix, Eigen::NaturalOrdering<int>>;

  void factorize(const WinslowState& state);

  const WinslowEquations& Equations;
  bool Sliding;
  Factors Picard;
  bool Analysed = false;
  bool Serves = false;
};

} // namespace footpoint
