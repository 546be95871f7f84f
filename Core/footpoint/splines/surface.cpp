// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/splines/surface.h"

#include "footpoint/splines/validation.h"

#include <algorithm>
#include <utility>

namespace footpoint
{

namespace
{

constexpr int kHighestOrder = 2;

/// Derivatives of (w·S, w) in the order of the jet: point, u, v, uu, uv, vv.
using Sums = std::array<Eigen::Vector4d, 6>;

/// Rows of basis functions and of their derivatives.
using BasisRows = double[(kHighestOrder + 1) * (kMaximumDegree + 1)];

void check_count(const std::array<KnotVector, 2>& knots, Eigen::Index control_points)
{
  const Eigen::Index nu = knots[0].number_of_control_points();
  const Eigen::Index nv = knots[1].number_of_control_points();
  if (nu * nv != control_points)
  {
    throw GeometryError(GeometryDefect::Count,
      knots[0].name() + " and " + knots[1].name() + " need " + std::to_string(nu) + " x " +
        std::to_string(nv) + " = " + std::to_string(nu * nv) + " control points; there are " +
        std::to_string(control_points));
  }
}

/// Rows of the net are summed along u; each sum is then spread over the derivatives along v.
/// \param net   of the first control point that counts, nu of them to the next row
/// \param basis values and derivatives of the basis functions along either direction
template <int Order>
Sums sum(const double* net, Eigen::Index nu, const BasisRows (&basis)[2],
  const std::array<int, 2>& count)
{
  Sums sums;
  sums.fill(Eigen::Vector4d::Zero());
  for (int j = 0; j < count[1]; ++j, net += 4 * nu)
  {
    std::array<Eigen::Vector4d, Order + 1> row;
    row.fill(Eigen::Vector4d::Zero());
    for (int i = 0; i < count[0]; ++i)
    {
      const Eigen::Vector4d control = Eigen::Map<const Eigen::Vector4d>(net + 4 * i);
      for (int a = 0; a <= Order; ++a)
      {
        row[a] += basis[0][a * count[0] + i] * control;
      }
    }
    for (int a = 0; a <= Order; ++a)
    {
      for (int b = 0; a + b <= Order; ++b)
      {
        sums[(a + b) * (a + b + 1) / 2 + b] += basis[1][b * count[1] + j] * row[a];
      }
    }
  }
  return sums;
}

Jet<2> polynomial_jet(const Sums& sums, int order)
{
  Jet<2> jet;
  jet.point = sums[0].head<3>();
  if (order >= 1)
  {
    jet.first << sums[1].head<3>(), sums[2].head<3>();
  }
  if (order >= 2)
  {
    jet.second << sums[3].head<3>(), sums[4].head<3>(), sums[5].head<3>();
  }
  return jet;
}

/// Solves the product rule for w·S for the derivatives of S; Piegl and Tiller (1997), A4.4.
Jet<2> rational_jet(const Sums& sums, int order)
{
  Jet<2> jet;
  const double w = sums[0][3];
  const Vector3 s = sums[0].head<3>() / w;
  jet.point = s;
  if (order >= 1)
  {
    const Vector3 su = (sums[1].head<3>() - sums[1][3] * s) / w;
    const Vector3 sv = (sums[2].head<3>() - sums[2][3] * s) / w;
    jet.first << su, sv;
    if (order >= 2)
    {
      const double wu = sums[1][3];
      const double wv = sums[2][3];
      jet.second.col(0) = (sums[3].head<3>() - 2.0 * wu * su - sums[3][3] * s) / w;
      jet.second.col(1) = (sums[4].head<3>() - wu * sv - wv * su - sums[4][3] * s) / w;
      jet.second.col(2) = (sums[5].head<3>() - 2.0 * wv * sv - sums[5][3] * s) / w;
    }
  }
  return jet;
}

} // namespace

Surface::Surface(
  KnotVector knots_u, KnotVector knots_v, const Points& control_points, Eigen::VectorXd weights)
  : Knots{ { std::move(knots_u), std::move(knots_v) } }
{
  check_count(this->Knots, control_points.cols());
  check_control_points(control_points);
  this->Weights = check_weights(std::move(weights), control_points.cols());
  this->ControlPoints = this->recentre(control_points);
  this->Homogeneous = homogeneous(this->ControlPoints, this->Weights);
  std::array<int, 2> samples;
  for (int i = 0; i < 2; ++i)
  {
    this->Directions[i] = make_direction(this->Knots[i]);
    samples[i] = closure_samples(this->Knots[i].degree(), this->rational());
  }
  this->analyse(samples);
}

Jet<2> Surface::jet(const Parameter<2>& t, const Sides<2>& sides, int order) const
{
  order = std::clamp(order, 0, kHighestOrder);
  std::array<int, 2> count;
  std::array<int, 2> first;
  BasisRows basis[2];
  for (int i = 0; i < 2; ++i)
  {
    const int span = this->Knots[i].find_span(t[i], sides[i]);
    this->Knots[i].basis(span, t[i], order, basis[i]);
    count[i] = this->Knots[i].degree() + 1;
    first[i] = span - count[i] + 1;
  }

  const Eigen::Index nu = this->Knots[0].number_of_control_points();
  const double* net = this->Homogeneous.data() + 4 * (first[1] * nu + first[0]);
  const Sums sums = order == 0 ? sum<0>(net, nu, basis, count)
    : order == 1               ? sum<1>(net, nu, basis, count)
                               : sum<2>(net, nu, basis, count);
  return this->rational() ? rational_jet(sums, order) : polynomial_jet(sums, order);
}

} // namespace footpoint
