// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/solvers/step.h"

#include "footpoint/solvers/curve_step.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <cmath>
#include <stdexcept>

namespace footpoint
{
namespace
{

/// Eigenvalues below this part of the largest are lifted to it: the step stays finite, and the
/// trust radius shortens what is left of it.
constexpr double kEigenvalueFloor = 1e-14;

template <int N>
using Matrix = typename Frame<N>::Matrix;

/// The first derivatives along the free directions; zero columns for the others.
template <int N>
Eigen::Matrix<double, 3, N> free_tangents(const Frame<N>& frame, const StepSettings<N>& settings)
{
  Eigen::Matrix<double, 3, N> tangents = frame.jet.first;
  for (int i = 0; i < N; ++i)
  {
    tangents.col(i) *= settings.free(i) ? 1.0 : 0.0;
  }
  return tangents;
}

/// v in coordinates of the free directions: (JᵀJ)⁻¹ Jᵀ v, column-scaled.
template <int N>
Parameter<N> components(const Frame<N>& frame, const Vector3& v, const StepSettings<N>& settings)
{
  StepSettings<N> plain = settings;
  plain.descend = true;
  const Parameter<N> along = frame.jet.first.transpose() * v;
  return solve_scaled<N>(frame.metric(), -along, plain);
}

/// Newton's step in geodesic coordinates of the part of the geometry that is free to move: the
/// whole of it, or an isoparametric curve. Only what of r is orthogonal to that part meets its
/// curvature; back in parameters the step is Δ − ½ Γ(Δ, Δ), with Γ the tangential part of the
/// second derivatives (Christoffel symbols).
template <int N>
Parameter<N> covariant_step(const Frame<N>& frame, const StepSettings<N>& settings)
{
  const Eigen::Matrix<double, 3, N> tangents = free_tangents<N>(frame, settings);
  const Vector3 across = frame.r - tangents * components<N>(frame, frame.r, settings);
  const Parameter<N> delta =
    solve_scaled<N>(frame.metric() + frame.second_along(across), frame.gradient, settings);
  Vector3 bend = frame.jet.second.col(0) * (delta(0) * delta(0));
  if constexpr (N == 2)
  {
    bend += frame.jet.second.col(1) * (2.0 * delta(0) * delta(1)) +
      frame.jet.second.col(2) * (delta(1) * delta(1));
  }
  const Parameter<N> correction = 0.5 * components<N>(frame, bend, settings);
  // Beyond half of the step the expansion says nothing.
  const bool small = (tangents * correction).norm() <= 0.5 * (tangents * delta).norm();
  return small ? Parameter<N>(delta - correction) : delta;
}

} // namespace

template <int N>
Parameter<N> solve_scaled(const Eigen::Matrix<double, N, N>& matrix, const Parameter<N>& gradient,
  const StepSettings<N>& settings)
{
  Matrix<N> scaled = settings.scale.asDiagonal() * matrix * settings.scale.asDiagonal();
  Parameter<N> right = settings.scale.cwiseProduct(gradient);
  for (int i = 0; i < N; ++i)
  {
    if (!settings.free(i))
    {
      scaled.row(i).setZero();
      scaled.col(i).setZero();
      right(i) = 0.0;
    }
  }
  if (!scaled.allFinite() || !right.allFinite())
  {
    return Parameter<N>::Zero();
  }
  // Where S_i is small beside the curvature (poles, folds of a strip) the scaled diagonal is huge
  // and would drown the other direction in rounding.
  Parameter<N> unit = settings.scale;
  for (int i = 0; i < N; ++i)
  {
    const double shrink = 1.0 / std::sqrt(std::max(1.0, std::abs(scaled(i, i))));
    scaled.row(i) *= shrink;
    scaled.col(i) *= shrink;
    right(i) *= shrink;
    unit(i) *= shrink;
  }
  Eigen::SelfAdjointEigenSolver<Matrix<N>> eigen;
  eigen.computeDirect(scaled);
  const double largest = eigen.eigenvalues().cwiseAbs().maxCoeff();
  if (largest == 0.0)
  {
    return -unit.cwiseProduct(right);
  }
  Parameter<N> values = eigen.eigenvalues().cwiseAbs().cwiseMax(kEigenvalueFloor * largest);
  if (!settings.descend)
  {
    values = values.binaryExpr(
      eigen.eigenvalues(), [](double a, double b) { return std::copysign(a, b); });
  }
  const Parameter<N> delta =
    -(eigen.eigenvectors() * (eigen.eigenvectors().transpose() * right).cwiseQuotient(values));
  return unit.cwiseProduct(delta);
}

template <int N>
Step<N> make_step(Method method)
{
  switch (method)
  {
    case Method::Newton:
      return [](const Frame<N>& frame, const StepSettings<N>& settings)
      { return solve_scaled<N>(frame.hessian(), frame.gradient, settings); };
    case Method::GaussNewton:
      return [](const Frame<N>& frame, const StepSettings<N>& settings)
      { return solve_scaled<N>(frame.metric(), frame.gradient, settings); };
    case Method::LevenbergMarquardt:
      return [](const Frame<N>& frame, const StepSettings<N>& settings)
      {
        const Parameter<N> damping =
          settings.lambda * settings.scale.cwiseProduct(settings.scale).cwiseInverse();
        const Matrix<N> matrix = frame.metric() + Matrix<N>(damping.asDiagonal());
        return solve_scaled<N>(matrix, frame.gradient, settings);
      };
    case Method::SecondOrder:
      return covariant_step<N>;
    default:
      if constexpr (N == 1)
      {
        return make_curve_step(method);
      }
      throw std::invalid_argument("FirstOrder, CurvatureCircle and SecondOrder1 to 3 are steps for "
                                  "curves; surfaces have SecondOrder");
  }
}

int derivative_order(Method method)
{
  return method == Method::SecondOrder3 ? 3 : 2;
}

template Parameter<1> solve_scaled<1>(
  const Eigen::Matrix<double, 1, 1>&, const Parameter<1>&, const StepSettings<1>&);
template Parameter<2> solve_scaled<2>(
  const Eigen::Matrix<double, 2, 2>&, const Parameter<2>&, const StepSettings<2>&);
template Step<1> make_step<1>(Method);
template Step<2> make_step<2>(Method);

} // namespace footpoint
