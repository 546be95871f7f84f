// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/grids/gordon_surface.h"

#include "footpoint/grids/curve_network.h"
#include "footpoint/splines/interpolation.h"

#include <algorithm>

namespace footpoint
{
namespace
{

/// Degree of the splines that are interpolated across a family.
constexpr int kBlendDegree = 3;

/// The cardinal splines of given parameters: the k-th component is 1 at the k-th parameter, 0 at
/// others.
PiecewisePolynomial cardinal_splines(const std::vector<double>& parameters)
{
  const KnotVector knots = averaged_knots(parameters, kBlendDegree);
  const auto count = static_cast<Eigen::Index>(parameters.size());
  return PiecewisePolynomial::spline(
    knots, interpolate(knots, parameters, Eigen::MatrixXd::Identity(count, count)));
}

/// The same for closed curves: C2 across the seam too, so that the surface closes smoothly where
/// the curves do. Cubic, with the parameters as knots. \param parameters from 0 to 1, which is 0
/// once more
PiecewisePolynomial periodic_cardinal_splines(const std::vector<double>& parameters)
{
  // === Slopes at the parameters (C. de Boor 1978, ch. IV), a row for each spline
  const Eigen::Index count = static_cast<Eigen::Index>(parameters.size()) - 1;
  const Eigen::MatrixXd values = Eigen::MatrixXd::Identity(count, count);
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(count, count);
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(count, count);
  for (Eigen::Index k = 0; k < count; ++k)
  {
    const Eigen::Index next = (k + 1) % count;
    const double length = parameters[k + 1] - parameters[k];
    const Eigen::VectorXd rise = 3.0 / (length * length) * (values.col(next) - values.col(k));
    system(k, k) += 2.0 / length;
    system(k, next) += 1.0 / length;
    system(next, k) += 1.0 / length;
    system(next, next) += 2.0 / length;
    right.col(k) += rise;
    right.col(next) += rise;
  }
  // The system is symmetric, so that it stands on either side.
  const Eigen::MatrixXd slopes = system.partialPivLu().solve(right.transpose()).transpose();

  std::vector<Eigen::MatrixXd> pieces;
  for (Eigen::Index k = 0; k < count; ++k)
  {
    const Eigen::Index next = (k + 1) % count;
    const double third = (parameters[k + 1] - parameters[k]) / 3.0;
    Eigen::MatrixXd piece(count, kBlendDegree + 1);
    piece << values.col(k), values.col(k) + third * slopes.col(k),
      values.col(next) - third * slopes.col(next), values.col(next);
    pieces.push_back(std::move(piece));
  }
  return { parameters, std::vector<int>(parameters.size(), kBlendDegree - 1), std::move(pieces) };
}

/// Where the other family meets a family of curves, what its curves are multiplied by: cardinal
/// splines times the family's weights.
PiecewisePolynomial blending(const CurveFamily& family, const std::vector<double>& parameters)
{
  const PiecewisePolynomial cardinal =
    family.closed ? periodic_cardinal_splines(parameters) : cardinal_splines(parameters);
  return family.weighted ? cardinal.times(family.curves.front().rows(3, 1)) : cardinal;
}

/// The least knot vector that holds all curves of a family and the cardinal splines along it.
KnotVector knots_of(
  const CurveFamily& family, const PiecewisePolynomial& cardinal, const char* name)
{
  KnotVector knots = common_knots(cardinal, cardinal, 1);
  for (const PiecewisePolynomial& curve : family.curves)
  {
    // A spline whose pieces are all there is, is its knot vector: any function of that space will
    // do.
    const auto count = knots.number_of_control_points();
    const auto holder = PiecewisePolynomial::spline(knots, Eigen::MatrixXd::Zero(1, count));
    knots = common_knots(holder, curve, 1);
  }
  return { knots.degree(), knots.knots(), name };
}

Eigen::MatrixXd control_points(const PiecewisePolynomial& function, const KnotVector& knots)
{
  return function.refined(knots.knots()).control_points(knots);
}

} // namespace

GordonResult gordon_surface(const std::vector<Curve>& profiles, const std::vector<Curve>& guides,
  const GordonOptions& options)
{
  CurveNetwork network = order_network(profiles, guides, options);
  NetworkReport& report = network.report;
  double& error = report.reparametrization_error;
  report.parameters_u = align_parameters(network.profiles, "profile", network.size, options, error);
  report.parameters_v = align_parameters(network.guides, "guide", network.size, options, error);

  const PiecewisePolynomial across_u = blending(network.profiles, report.parameters_u);
  const PiecewisePolynomial across_v = blending(network.guides, report.parameters_v);
  const KnotVector knots_u = knots_of(network.profiles, across_u, "KnotsU");
  const KnotVector knots_v = knots_of(network.guides, across_v, "KnotsV");
  const Eigen::MatrixXd m = control_points(across_u, knots_u); // guides × nu
  const Eigen::MatrixXd l = control_points(across_v, knots_v); // profiles × nv

  // S = Σ_i P_i(u) L_i(v) + Σ_j M_j(u) G_j(v) − Σ_ij Q_ij M_j(u) L_i(v), each a sum of products.
  // With the weights w of all profiles and z of all guides, w z S is that sum of w P_i, z L_i, w
  // M_j and z G_j: a spline again.
  const Eigen::Index nu = knots_u.number_of_control_points();
  const Eigen::Index nv = knots_v.number_of_control_points();
  std::array<Eigen::MatrixXd, 4> net;
  net.fill(Eigen::MatrixXd::Zero(nu, nv));
  for (std::size_t i = 0; i < network.profiles.curves.size(); ++i)
  {
    const Eigen::MatrixXd profile = control_points(network.profiles.curves[i], knots_u);
    for (int axis = 0; axis < 4; ++axis)
    {
      net[axis] += profile.row(axis).transpose() * l.row(i);
    }
  }
  for (std::size_t j = 0; j < network.guides.curves.size(); ++j)
  {
    const Eigen::MatrixXd guide = control_points(network.guides.curves[j], knots_v);
    for (int axis = 0; axis < 4; ++axis)
    {
      net[axis] += m.row(j).transpose() * guide.row(axis);
    }
    for (std::size_t i = 0; i < network.profiles.curves.size(); ++i)
    {
      Eigen::Vector4d meeting;
      meeting << 0.5 *
          (network.profiles.point(i, report.parameters_u[j]) +
            network.guides.point(j, report.parameters_v[i])),
        1.0;
      for (int axis = 0; axis < 4; ++axis)
      {
        net[axis] -= meeting(axis) * m.row(j).transpose() * l.row(i);
      }
    }
  }
  const bool rational = network.profiles.weighted || network.guides.weighted;
  const Eigen::VectorXd weights = net[3].reshaped();
  Points points(3, nu * nv);
  for (int axis = 0; axis < 3; ++axis)
  {
    points.row(axis) = net[axis].reshaped().transpose();
    if (rational)
    {
      points.row(axis).array() /= weights.transpose().array();
    }
  }
  return { Surface(knots_u, knots_v, points, rational ? weights : Eigen::VectorXd()),
    std::move(report) };
}

} // namespace footpoint
