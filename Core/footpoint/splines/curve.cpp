// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/splines/curve.h"

#include "footpoint/splines/validation.h"

#include <algorithm>
#include <utility>

namespace footpoint
{

namespace
{

constexpr int kHighestOrder = 3;

constexpr double kBinomial[4][4] = { { 1, 0, 0, 0 }, { 1, 1, 0, 0 }, { 1, 2, 1, 0 },
  { 1, 3, 3, 1 } };

void check_count(const KnotVector& knots, Eigen::Index control_points)
{
  if (knots.number_of_control_points() != control_points)
  {
    throw GeometryError(GeometryDefect::Count,
      knots.name() + " holds " + std::to_string(knots.knots().size()) + " knots; degree " +
        std::to_string(knots.degree()) + " and " + std::to_string(control_points) +
        " control points need " + std::to_string(control_points + knots.degree() + 1));
  }
}

} // namespace

Curve::Curve(KnotVector knots, const Points& control_points, Eigen::VectorXd weights)
  : Knots(std::move(knots))
{
  check_count(this->Knots, control_points.cols());
  check_control_points(control_points);
  this->Weights = check_weights(std::move(weights), control_points.cols());
  this->ControlPoints = this->recentre(control_points);
  this->Homogeneous = homogeneous(this->ControlPoints, this->Weights);
  this->Directions[0] = make_direction(this->Knots);
  this->analyse();
}

Jet<1> Curve::jet(const Parameter<1>& t, const Sides<1>& sides, int order) const
{
  order = std::clamp(order, 0, kHighestOrder);
  const int count = this->Knots.degree() + 1;
  const int span = this->Knots.find_span(t[0], sides[0]);
  double basis[(kHighestOrder + 1) * (kMaximumDegree + 1)];
  this->Knots.basis(span, t[0], order, basis);

  Eigen::Vector4d sums[kHighestOrder + 1]; // derivatives of (w·C, w)
  for (int k = 0; k <= order; ++k)
  {
    sums[k].setZero();
    for (int j = 0; j < count; ++j)
    {
      sums[k] += basis[k * count + j] * this->Homogeneous.col(span - count + 1 + j);
    }
  }

  // Leibniz: (w·C)^(k) = Σ binomial(k, i) w^(i) C^(k−i), solved for C^(k). Piegl and Tiller, A4.2.
  Vector3 c[kHighestOrder + 1];
  if (!this->rational())
  {
    std::transform(
      sums, sums + order + 1, c, [](const Eigen::Vector4d& sum) { return sum.head<3>(); });
  }
  else
  {
    for (int k = 0; k <= order; ++k)
    {
      c[k] = sums[k].head<3>();
      for (int i = 1; i <= k; ++i)
      {
        c[k] -= kBinomial[k][i] * sums[i][3] * c[k - i];
      }
      c[k] /= sums[0][3];
    }
  }

  Jet<1> jet;
  jet.point = c[0];
  if (order >= 1)
  {
    jet.first = c[1];
  }
  if (order >= 2)
  {
    jet.second = c[2];
  }
  if (order >= 3)
  {
    jet.third = c[3];
  }
  return jet;
}

} // namespace footpoint
