// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/grids/winslow_step.h"

#include <Eigen/IterativeLinearSolvers>

namespace footpoint
{
namespace
{

/// Accuracy of the linear solves: each Newton step gains at least so much once it is near.
constexpr double kLinearTolerance = 1e-4;

/// More iterations than that: the preconditioner is made anew.
constexpr int kFewIterations = 12;
constexpr int kMostIterations = 60;

/// Pivots are taken on the diagonal unless another is so many times larger, to keep the ordering.
constexpr double kPivotThreshold = 1e-3;

/// Tᵀ A⁻¹ T with the Picard matrix A applied to each coordinate and the tangents T of the unknowns:
/// a solve that does not depend on which tangents were chosen.
template <class Factors>
Eigen::VectorXd apply_inverse(
  const Factors& factors, const WinslowEquations::Places& places, const Eigen::VectorXd& right)
{
  const Eigen::Index size = Eigen::Index(places.size());
  Eigen::MatrixXd coordinates(size, 3);
  for (Eigen::Index k = 0; k < size; ++k)
  {
    coordinates.row(k) = (places[std::size_t(k)].tangents * right.segment<2>(2 * k)).transpose();
  }
  const Eigen::MatrixXd solved = factors.solve(coordinates);
  Eigen::VectorXd result(2 * size);
  for (Eigen::Index k = 0; k < size; ++k)
  {
    result.segment<2>(2 * k) =
      places[std::size_t(k)].tangents.transpose() * solved.row(k).transpose();
  }
  return result;
}

/// In the form that Eigen's iterative solvers take.
template <class Factors>
class TangentPreconditioner
{
public:
  void set(const Factors& factors, const WinslowEquations::Places& places)
  {
    this->Inverse = &factors;
    this->Tangents = &places;
  }
  template <class Matrix>
  TangentPreconditioner& compute(const Matrix&)
  {
    return *this;
  }
  Eigen::VectorXd solve(const Eigen::VectorXd& right) const
  {
    return apply_inverse(*this->Inverse, *this->Tangents, right);
  }
  Eigen::ComputationInfo info() const { return Eigen::Success; }

private:
  const Factors* Inverse = nullptr;
  const WinslowEquations::Places* Tangents = nullptr;
};

} // namespace

void WinslowStep::factorize(const WinslowState& state)
{
  const Matrix matrix = this->Equations.picard_matrix(state.points);
  if (!this->Analysed)
  {
    this->Picard.setPivotThreshold(kPivotThreshold);
    this->Picard.analyzePattern(matrix);
    this->Analysed = true;
  }
  this->Picard.factorize(matrix);
  this->Serves = true;
}

Eigen::VectorXd WinslowStep::picard(const WinslowState& state)
{
  if (this->Sliding)
  {
    Factors exact;
    exact.compute(this->Equations.newton_matrix(state.points, state.places, true));
    return -exact.solve(state.residual);
  }
  this->factorize(state);
  return -apply_inverse(this->Picard, state.places, state.residual);
}

Eigen::VectorXd WinslowStep::newton(const WinslowState& state)
{
  const Matrix matrix = this->Equations.newton_matrix(state.points, state.places);
  if (this->Sliding)
  {
    Factors exact;
    exact.compute(matrix);
    return -exact.solve(state.residual);
  }
  if (!this->Serves)
  {
    this->factorize(state);
  }
  Eigen::BiCGSTAB<Matrix, TangentPreconditioner<Factors>> solver;
  solver.preconditioner().set(this->Picard, state.places);
  solver.compute(matrix);
  solver.setTolerance(kLinearTolerance);
  solver.setMaxIterations(kMostIterations);
  const Eigen::VectorXd step = solver.solve(-state.residual);
  this->Serves = solver.iterations() <= kFewIterations;
  return step;
}

} // namespace footpoint
