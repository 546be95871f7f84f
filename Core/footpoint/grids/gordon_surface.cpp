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

  const PiecewisePolynomial across_u = cardinal_splines(report.parameters_u);
  const PiecewisePolynomial across_v = cardinal_splines(report.parameters_v);
  const KnotVector knots_u = knots_of(network.profiles, across_u, "KnotsU");
  const KnotVector knots_v = knots_of(network.guides, across_v, "KnotsV");
  const Eigen::MatrixXd m = control_points(across_u, knots_u); // guides × nu
  const Eigen::MatrixXd l = control_points(across_v, knots_v); // profiles × nv

  // S = Σ_i P_i(u) L_i(v) + Σ_j M_j(u) G_j(v) − Σ_ij Q_ij M_j(u) L_i(v), each a sum of products.
  const Eigen::Index nu = knots_u.number_of_control_points();
  const Eigen::Index nv = knots_v.number_of_control_points();
  std::array<Eigen::MatrixXd, 3> net;
  net.fill(Eigen::MatrixXd::Zero(nu, nv));
  for (std::size_t i = 0; i < network.profiles.curves.size(); ++i)
  {
    const Eigen::MatrixXd profile = control_points(network.profiles.curves[i], knots_u);
    for (int axis = 0; axis < 3; ++axis)
    {
      net[axis] += profile.row(axis).transpose() * l.row(i);
    }
  }
  for (std::size_t j = 0; j < network.guides.curves.size(); ++j)
  {
    const Eigen::MatrixXd guide = control_points(network.guides.curves[j], knots_v);
    for (int axis = 0; axis < 3; ++axis)
    {
      net[axis] += m.row(j).transpose() * guide.row(axis);
    }
    for (std::size_t i = 0; i < network.profiles.curves.size(); ++i)
    {
      const Vector3 meeting = 0.5 *
        (network.profiles.curves[i].value(report.parameters_u[j]) +
          network.guides.curves[j].value(report.parameters_v[i]));
      for (int axis = 0; axis < 3; ++axis)
      {
        net[axis] -= meeting(axis) * m.row(j).transpose() * l.row(i);
      }
    }
  }
  Points points(3, nu * nv);
  for (int axis = 0; axis < 3; ++axis)
  {
    points.row(axis) = Eigen::Map<const Eigen::RowVectorXd>(net[axis].data(), nu * nv);
  }
  return { Surface(knots_u, knots_v, points), std::move(report) };
}

} // namespace footpoint
