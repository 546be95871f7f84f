// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/grids/curve_network.h"

#include "footpoint/grids/curve_meeting.h"
#include "footpoint/splines/validation.h"

#include <algorithm>
#include <numeric>

namespace footpoint
{
namespace
{

struct Meetings
{
  Eigen::MatrixXd on_profile; ///< (profile, guide), in [0, 1]
  Eigen::MatrixXd on_guide;   ///< (guide, profile)
};

void check(const std::vector<Curve>& curves, const std::string& name)
{
  if (curves.size() < 2)
  {
    throw BoundaryError(BoundaryDefect::Count,
      "a network needs at least two " + name + "s; there are " + std::to_string(curves.size()));
  }
  for (std::size_t k = 0; k < curves.size(); ++k)
  {
    if (curves[k].rational())
    {
      throw BoundaryError(BoundaryDefect::Count,
        name + " " + std::to_string(k) +
          " is rational; a Gordon surface is made of polynomial curves");
    }
  }
}

double size_of(const std::vector<Curve>& profiles, const std::vector<Curve>& guides)
{
  Vector3 lower = profiles.front().centre();
  Vector3 upper = lower;
  for (const std::vector<Curve>* family : { &profiles, &guides })
  {
    for (const Curve& curve : *family)
    {
      const Points points = curve.local_control_points().colwise() + curve.centre();
      lower = lower.cwiseMin(points.rowwise().minCoeff());
      upper = upper.cwiseMax(points.rowwise().maxCoeff());
    }
  }
  return (upper - lower).norm();
}

Meetings find_meetings(const std::vector<Curve>& profiles, const std::vector<Curve>& guides,
  double size, const GordonOptions& options, NetworkReport& report)
{
  Meetings meetings{ Eigen::MatrixXd(profiles.size(), guides.size()),
    Eigen::MatrixXd(guides.size(), profiles.size()) };
  for (std::size_t i = 0; i < profiles.size(); ++i)
  {
    for (std::size_t j = 0; j < guides.size(); ++j)
    {
      const CurveMeeting meeting = find_meeting(profiles[i], guides[j]);
      if (meeting.gap > options.intersection_tolerance * size)
      {
        throw BoundaryError(BoundaryDefect::Gap,
          "profile " + std::to_string(i) + " and guide " + std::to_string(j) +
            " pass each other at " + to_text(meeting.gap) + "; allowed is " +
            to_text(options.intersection_tolerance * size));
      }
      report.largest_gap = std::max(report.largest_gap, meeting.gap);
      meetings.on_profile(i, j) = meeting.first / profiles[i].direction(0).length;
      meetings.on_guide(j, i) = meeting.second / guides[j].direction(0).length;
    }
  }
  return meetings;
}

/// Whether the meetings along a row rise (or fall) as those along the first row do.
std::vector<bool> find_reversals(const Eigen::MatrixXd& meetings)
{
  std::vector<bool> reversed;
  const Eigen::RowVectorXd first = meetings.row(0).array() - meetings.row(0).mean();
  for (Eigen::Index k = 0; k < meetings.rows(); ++k)
  {
    const Eigen::RowVectorXd row = meetings.row(k).array() - meetings.row(k).mean();
    reversed.push_back(row.dot(first) < 0.0);
  }
  return reversed;
}

std::vector<int> order_along(const Eigen::RowVectorXd& parameters)
{
  std::vector<int> order(parameters.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(
    order.begin(), order.end(), [&](int a, int b) { return parameters(a) < parameters(b); });
  return order;
}

/// Cartesian coordinates over [0, 1], turned round where needed.
PiecewisePolynomial coordinates(const Curve& curve, bool reversed)
{
  const PiecewisePolynomial all = PiecewisePolynomial::homogeneous(curve).rows(0, 3);
  return reversed ? all.reversed() : all;
}

CurveFamily make_family(const std::vector<Curve>& curves, const Eigen::MatrixXd& meetings,
  const std::vector<int>& order, const std::vector<int>& across, const std::vector<bool>& reversed)
{
  CurveFamily family;
  family.meetings.resize(order.size(), across.size());
  for (std::size_t k = 0; k < order.size(); ++k)
  {
    const bool turned = reversed[order[k]];
    family.curves.push_back(coordinates(curves[order[k]], turned));
    for (std::size_t j = 0; j < across.size(); ++j)
    {
      const double t = meetings(order[k], across[j]);
      family.meetings(k, j) = turned ? 1.0 - t : t;
    }
  }
  return family;
}

void check_order(const CurveFamily& family, const std::string& name, const std::vector<int>& order)
{
  for (Eigen::Index k = 0; k < family.meetings.rows(); ++k)
  {
    for (Eigen::Index j = 1; j < family.meetings.cols(); ++j)
    {
      if (!(family.meetings(k, j) > family.meetings(k, j - 1)))
      {
        throw BoundaryError(BoundaryDefect::Branch,
          name + " " + std::to_string(order[k]) + " meets the other curves in another order than " +
            name + " " + std::to_string(order[0]) + " does, at its parameter " +
            to_text(family.meetings(k, j)));
      }
    }
  }
}

std::vector<bool> reordered(const std::vector<bool>& flags, const std::vector<int>& order)
{
  std::vector<bool> result;
  for (const int k : order)
  {
    result.push_back(flags[k]);
  }
  return result;
}

} // namespace

CurveNetwork order_network(const std::vector<Curve>& profiles, const std::vector<Curve>& guides,
  const GordonOptions& options)
{
  check(profiles, "profile");
  check(guides, "guide");
  CurveNetwork network;
  network.size = size_of(profiles, guides);
  const Meetings meetings = find_meetings(profiles, guides, network.size, options, network.report);
  NetworkReport& report = network.report;
  const std::vector<bool> profile_reversed = find_reversals(meetings.on_profile);
  const std::vector<bool> guide_reversed = find_reversals(meetings.on_guide);
  report.guide_order = order_along(meetings.on_profile.row(0));
  report.profile_order = order_along(meetings.on_guide.row(0));
  report.profile_reversed = reordered(profile_reversed, report.profile_order);
  report.guide_reversed = reordered(guide_reversed, report.guide_order);
  network.profiles = make_family(
    profiles, meetings.on_profile, report.profile_order, report.guide_order, profile_reversed);
  network.guides = make_family(
    guides, meetings.on_guide, report.guide_order, report.profile_order, guide_reversed);
  check_order(network.profiles, "profile", report.profile_order);
  check_order(network.guides, "guide", report.guide_order);
  return network;
}

} // namespace footpoint
