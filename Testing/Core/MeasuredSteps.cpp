// SPDX-License-Identifier: BSD-3-Clause

#include "MeasuredSteps.h"

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>

namespace measured
{

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

Curve space_curve()
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

Surface octant()
{
  const double half = std::sqrt(0.5);
  return shapes::revolve({ 0, 0, 0, 1, 1, 1 }, 2,
    shapes::points({ { 1, 0, 0 }, { 1, 0, 1 }, { 0, 0, 1 } }), Vector3(1, half, 1), 90.0, 1);
}

// === One step

namespace
{

template <int N>
Frame<N> frame_at(
  const ParametricGeometry<N>& geometry, const Vector3& query, const Parameter<N>& t)
{
  return make_frame<N>(geometry, query, t, Sides<N>::Constant(Side::Right), N == 1 ? 3 : 2);
}

/// The least and the greatest eigenvalue of the Hessian in units of the metric.
template <int N>
std::array<double, 2> curvatures(const Frame<N>& frame)
{
  const typename Frame<N>::Matrix ratio = frame.metric().inverse() * frame.hessian();
  const double mean = ratio.trace() / N;
  const double product = N == 1 ? mean * mean : ratio.determinant();
  const double root = std::sqrt(std::max(mean * mean - product, 0.0));
  return { { mean - root, mean + root } };
}

} // namespace

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
    away -= flat.jet.first * (flat.metric().inverse() * (flat.jet.first.transpose() * away));
    const double distance = on ? 0.0 : random.uniform(0.0, 0.5) * geometry.size();
    one.query = flat.jet.point + distance * away.normalized();
    const Frame<N> frame = frame_at<N>(geometry, one.query, one.foot);
    const auto [least, greatest] = curvatures(frame);
    const bool regular = least > 0.3 && greatest < 3.0 &&
      (on || std::max(std::abs(least - 1.0), std::abs(greatest - 1.0)) > 0.2);
    if (inside && regular)
    {
      cases.push_back(one);
    }
  }
  return cases;
}

double median(std::vector<double> values)
{
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

template std::vector<Method> methods_for<1>();
template Parameter<1> lengths<1>(const ParametricGeometry<1>&);
template Parameter<1> bare_step<1>(
  const ParametricGeometry<1>&, const Vector3&, const Parameter<1>&, const Step<1>&);
template std::vector<Case<1>> random_cases<1>(const ParametricGeometry<1>&, bool, bool);
template std::vector<Method> methods_for<2>();
template Parameter<2> lengths<2>(const ParametricGeometry<2>&);
template Parameter<2> bare_step<2>(
  const ParametricGeometry<2>&, const Vector3&, const Parameter<2>&, const Step<2>&);
template std::vector<Case<2>> random_cases<2>(const ParametricGeometry<2>&, bool, bool);

} // namespace measured
