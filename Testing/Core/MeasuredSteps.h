// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// What the measurements of orders and basins share: methods, geometries, bare steps, known feet.

#include "PaperExamples.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <map>
#include <vector>

namespace measured
{

using namespace footpoint;

const std::map<Method, const char*> kMethodNames = { { Method::Newton, "Newton" },
  { Method::GaussNewton, "GaussNewton" }, { Method::LevenbergMarquardt, "LevenbergMarquardt" },
  { Method::SecondOrder, "SecondOrder" }, { Method::FirstOrder, "FirstOrder" },
  { Method::CurvatureCircle, "CurvatureCircle" }, { Method::SecondOrder1, "SecondOrder1" },
  { Method::SecondOrder2, "SecondOrder2" }, { Method::SecondOrder3, "SecondOrder3" } };

template <int N>
std::vector<Method> methods_for()
{
  std::vector<Method> methods = { Method::Newton, Method::GaussNewton, Method::LevenbergMarquardt,
    Method::SecondOrder };
  if constexpr (N == 1)
  {
    methods.insert(methods.end(),
      { Method::FirstOrder, Method::CurvatureCircle, Method::SecondOrder1, Method::SecondOrder2,
        Method::SecondOrder3 });
  }
  return methods;
}

// === Geometries

/// Helix-like, of degree 5, with weights between 0.5 and 1.5.
inline Curve space_curve()
{
  Points net(3, 12);
  Eigen::VectorXd weights(12);
  for (int i = 0; i < 12; ++i)
  {
    net.col(i) = Vector3(std::cos(0.7 * i), std::sin(0.7 * i), 0.15 * i);
    weights[i] = 1.0 + 0.5 * std::sin(2.0 * i);
  }
  return Curve(KnotVector(5, shapes::clamped_knots(5, 7)), net, weights);
}

inline Surface octant()
{
  const double half = std::sqrt(0.5);
  return shapes::revolve({ 0, 0, 0, 1, 1, 1 }, 2,
    shapes::points({ { 1, 0, 0 }, { 1, 0, 1 }, { 0, 0, 1 } }), Vector3(1, half, 1), 90.0, 1);
}

// === One step

template <int N>
Frame<N> frame_at(
  const ParametricGeometry<N>& geometry, const Vector3& query, const Parameter<N>& t)
{
  return make_frame<N>(geometry, query, t, Sides<N>::Constant(Side::Right), N == 1 ? 3 : 2);
}

template <int N>
Parameter<N> lengths(const ParametricGeometry<N>& geometry)
{
  Parameter<N> result;
  for (int i = 0; i < N; ++i)
  {
    result(i) = geometry.direction(i).length;
  }
  return result;
}

/// The bare step of a method.
template <int N>
Parameter<N> bare_step(const ParametricGeometry<N>& geometry, const Vector3& query,
  const Parameter<N>& t, const Step<N>& step)
{
  StepSettings<N> settings;
  settings.free.setConstant(true);
  settings.descend = false;
  settings.lambda = SolverOptions().initial_lambda;
  const Frame<N> frame = frame_at<N>(geometry, query, t);
  settings.scale = frame.speed.cwiseInverse();
  return step(frame, settings);
}

/// A query whose foot is known.
template <int N>
struct Case
{
  Vector3 query;     ///< local
  Parameter<N> foot; ///< local
};

/// Queries over random places inside knot spans. On the geometry, or so far away that the curvature
/// counts: the eigenvalues of the Hessian in units of the metric lie in [0.3, 3], and one of them
/// is 0.2 or more from 1.
template <int N>
std::vector<Case<N>> random_cases(const ParametricGeometry<N>& geometry, bool on, bool planar)
{
  shapes::Random random(7);
  const Parameter<N> length = lengths(geometry);
  std::vector<Case<N>> cases;
  while (cases.size() < 40)
  {
    Case<N> one;
    bool inside = true;
    for (int i = 0; i < N; ++i)
    {
      one.foot(i) = random.uniform(0.05, 0.95) * length(i);
      for (const double knot : geometry.direction(i).spans)
      {
        inside = inside && std::abs(knot - one.foot(i)) > 0.005 * length(i);
      }
    }
    const Frame<N> flat = frame_at<N>(geometry, Vector3::Zero(), one.foot);
    Vector3 away = random.vector(-1.0, 1.0);
    away.z() *= planar ? 0.0 : 1.0;
    away -= flat.jet.first * flat.metric().ldlt().solve(flat.jet.first.transpose() * away);
    const double distance = on ? 0.0 : random.uniform(0.0, 0.5) * geometry.size();
    one.query = flat.jet.point + distance * away.normalized();
    const Frame<N> frame = frame_at<N>(geometry, one.query, one.foot);
    const Eigen::GeneralizedSelfAdjointEigenSolver<typename Frame<N>::Matrix> eigen(
      frame.hessian(), frame.metric());
    const auto values = eigen.eigenvalues();
    const bool regular = values.minCoeff() > 0.3 && values.maxCoeff() < 3.0 &&
      (on || (values.array() - 1.0).abs().maxCoeff() > 0.2);
    if (inside && regular)
    {
      cases.push_back(one);
    }
  }
  return cases;
}

inline double median(std::vector<double> values)
{
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

} // namespace measured
