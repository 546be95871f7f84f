// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/splines/parametric_geometry.h"

namespace footpoint
{

/// The geometry seen from a query point at one parameter: E = ½|r|², r = S − P.
template <int N>
struct Frame
{
  using Matrix = Eigen::Matrix<double, N, N>;

  Parameter<N> t; ///< local parameters
  Sides<N> sides; ///< the smooth piece that is meant where t lies on a knot line
  Jet<N> jet;
  Vector3 r;             ///< S − P
  double distance;       ///< |r|
  Parameter<N> gradient; ///< ∂E/∂t_i = r·S_i
  Parameter<N> speed;    ///< |S_i|

  double energy() const { return 0.5 * this->distance * this->distance; }

  /// JᵀJ, the first fundamental form.
  Matrix metric() const { return this->jet.first.transpose() * this->jet.first; }

  /// The matrix v·S_ij for a vector v.
  Matrix second_along(const Vector3& v) const
  {
    Matrix m;
    m(0, 0) = v.dot(this->jet.second.col(0));
    if constexpr (N == 2)
    {
      m(0, 1) = m(1, 0) = v.dot(this->jet.second.col(1));
      m(1, 1) = v.dot(this->jet.second.col(2));
    }
    return m;
  }

  /// Second derivatives of E: JᵀJ + r·S_ij.
  Matrix hessian() const { return this->metric() + this->second_along(this->r); }
};

template <int N>
Frame<N> make_frame(const ParametricGeometry<N>& geometry, const Vector3& query,
  const Parameter<N>& t, const Sides<N>& sides, int order = 2)
{
  Frame<N> frame;
  frame.t = t;
  frame.sides = sides;
  frame.jet = geometry.jet(t, sides, order);
  frame.r = frame.jet.point - query;
  frame.distance = frame.r.norm();
  frame.gradient = frame.jet.first.transpose() * frame.r;
  frame.speed = frame.jet.first.colwise().norm().transpose();
  return frame;
}

} // namespace footpoint
