// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/grids/curve_network.h"

#include "footpoint/grids/curve_meeting.h"
#include "footpoint/splines/validation.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace footpoint
{
namespace
{

/// Meetings so near to each other along a curve, as a fraction of its domain, are one: as accurate
/// as they are found.
constexpr double kSamePlace = 1e-9;

/// Curves are one curve given twice when they are nowhere farther apart than this fraction of the
/// network's size: above the noise of files, below intersection tolerances.
constexpr double kSameCurve = 1e-6;

constexpr int kSamples = 257; ///< of a curve that is compared with another or whose area is taken

/// A closed curve whose area across the other family is less than this part of the square of its
/// size has no sense of rotation.
constexpr double kNoArea = 1e-9;

struct Meetings
{
  Eigen::MatrixXd on_profile; ///< (profile, guide), in [0, 1]
  Eigen::MatrixXd on_guide;   ///< (guide, profile)
};

std::string numbered(const std::string& name, std::size_t k)
{
  return name + " " + std::to_string(k);
}

/// Place in space at a parameter in [0, 1].
Vector3 point_at(const Curve& curve, double t)
{
  return curve.point(Parameter<1>(t * curve.direction(0).length)) + curve.centre();
}

/// What is told of a family before its curves are put in order.
struct Given
{
  std::string name;
  const std::vector<Curve>& curves;
  bool closed = false;
  int seam = 0;   ///< the curve at which closed curves of the other family start
  int again = -1; ///< the curve that is the seam once more, −1: none
};

void check_count(const Given& family)
{
  if (family.curves.size() < 2)
  {
    throw BoundaryError(BoundaryDefect::Count,
      "a network needs at least two " + family.name + "s; there are " +
        std::to_string(family.curves.size()));
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

void find_closure(Given& family)
{
  const auto closed = [](const Curve& curve) { return curve.direction(0).closed; };
  const auto found = std::find_if(family.curves.begin(), family.curves.end(), closed);
  const auto open = std::find_if_not(family.curves.begin(), family.curves.end(), closed);
  family.closed = found != family.curves.end();
  if (family.closed && open != family.curves.end())
  {
    throw BoundaryError(BoundaryDefect::Branch,
      numbered(family.name, found - family.curves.begin()) + " is closed and " +
        numbered(family.name, open - family.curves.begin()) + " is not, its ends are " +
        to_text((point_at(*open, 1.0) - point_at(*open, 0.0)).norm()) + " apart");
  }
}

bool same_curve(const Curve& a, const Curve& b, bool reversed, double tolerance)
{
  for (int k = 0; k < kSamples; ++k)
  {
    const double t = k / (kSamples - 1.0);
    if ((point_at(a, t) - point_at(b, reversed ? 1.0 - t : t)).norm() > tolerance)
    {
      return false;
    }
  }
  return true;
}

/// A curve may be given twice where the other family is closed: as the first and as the last one.
void find_seam(Given& family, const Given& other, double size)
{
  const std::vector<Curve>& curves = family.curves;
  for (std::size_t b = 0; b < curves.size(); ++b)
  {
    for (std::size_t a = 0; a < b; ++a)
    {
      const double tolerance = kSameCurve * size;
      if (!same_curve(curves[a], curves[b], false, tolerance) &&
        !same_curve(curves[a], curves[b], true, tolerance))
      {
        continue;
      }
      const std::string what =
        numbered(family.name, b) + " is " + numbered(family.name, a) + " once more; ";
      if (!other.closed)
      {
        throw BoundaryError(BoundaryDefect::Branch,
          what + "only a network of closed " + other.name + "s may begin and end with one curve");
      }
      if (family.again >= 0)
      {
        throw BoundaryError(BoundaryDefect::Branch,
          what + numbered(family.name, family.again) + " is given twice already, and closed " +
            other.name + "s have one seam");
      }
      family.seam = static_cast<int>(a);
      family.again = static_cast<int>(b);
    }
  }
  if (other.closed && curves.size() - (family.again >= 0 ? 1 : 0) < 2)
  {
    throw BoundaryError(BoundaryDefect::Count,
      "closed " + other.name + "s need two different " + family.name +
        "s; there is one, given twice");
  }
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
          numbered("profile", i) + " and " + numbered("guide", j) + " pass each other at " +
            to_text(meeting.gap) + "; allowed is " +
            to_text(options.intersection_tolerance * size));
      }
      report.largest_gap = std::max(report.largest_gap, meeting.gap);
      meetings.on_profile(i, j) = meeting.first / profiles[i].direction(0).length;
      meetings.on_guide(j, i) = meeting.second / guides[j].direction(0).length;
    }
  }
  return meetings;
}

/// Where a curve starts and which way it runs.
struct Course
{
  bool closed = false;
  double start = 0.0; ///< of closed curves
  bool reversed = false;

  /// A parameter of the given curve on the one that starts and runs so.
  double operator()(double t) const
  {
    if (!this->closed)
    {
      return this->reversed ? 1.0 - t : t;
    }
    double from_start = t - this->start;
    from_start -= std::floor(from_start);
    from_start = 1.0 - from_start <= kSamePlace ? 0.0 : from_start;
    return this->reversed && from_start > 0.0 ? 1.0 - from_start : from_start;
  }
};

Eigen::RowVectorXd along(const Course& course, const Eigen::RowVectorXd& meetings)
{
  return meetings.unaryExpr([&](double t) { return course(t); });
}

/// The curves of the other family in the order in which a curve meets them.
std::vector<int> order_along(const Eigen::RowVectorXd& parameters, int left_out)
{
  std::vector<int> order(parameters.size());
  std::iota(order.begin(), order.end(), 0);
  order.erase(std::remove(order.begin(), order.end(), left_out), order.end());
  std::stable_sort(
    order.begin(), order.end(), [&](int a, int b) { return parameters(a) < parameters(b); });
  return order;
}

bool ascending(const Eigen::RowVectorXd& parameters, const std::vector<int>& order)
{
  return std::is_sorted(
    order.begin(), order.end(), [&](int a, int b) { return parameters(a) < parameters(b); });
}

/// Courses of a family as far as the order of the meetings tells them: all curves run as the first.
std::vector<Course> find_courses(
  const Given& family, const Eigen::MatrixXd& meetings, const Given& other)
{
  std::vector<Course> courses(family.curves.size());
  std::vector<int> order;
  for (std::size_t k = 0; k < courses.size(); ++k)
  {
    Course& course = courses[k];
    const Eigen::RowVectorXd row = meetings.row(k);
    course.closed = family.closed;
    if (!family.closed)
    {
      const Eigen::RowVectorXd first = meetings.row(0).array() - meetings.row(0).mean();
      course.reversed = (row.array() - row.mean()).matrix().dot(first) < 0.0;
      continue;
    }
    course.start = row(other.seam);
    if (k == 0)
    {
      order = order_along(along(course, row), other.again);
    }
    course.reversed = true;
    course.reversed = order.size() > 2 && ascending(along(course, row), order);
  }
  return courses;
}

/// ½ ∮ r × dr of a closed curve.
Vector3 enclosed_area(const Curve& curve)
{
  Vector3 sum = Vector3::Zero();
  Vector3 before = point_at(curve, 0.0) - curve.centre();
  for (int k = 1; k < kSamples; ++k)
  {
    const Vector3 next = point_at(curve, k / (kSamples - 1.0)) - curve.centre();
    sum += 0.5 * before.cross(next);
    before = next;
  }
  return sum;
}

/// Two meetings have no sense of rotation: closed curves are then turned so that they run about the
/// curves of the other family in one sense.
void turn_by_area(std::vector<Course>& courses, const Given& family, const Given& other,
  const Eigen::MatrixXd& on_other, const std::vector<Course>& other_courses)
{
  double first = 0.0;
  for (std::size_t k = 0; k < courses.size(); ++k)
  {
    Vector3 forward = Vector3::Zero();
    for (std::size_t j = 0; j < other.curves.size(); ++j)
    {
      const Curve& curve = other.curves[j];
      const Parameter<1> at(on_other(j, k) * curve.direction(0).length);
      const Vector3 tangent = curve.jet(at, Sides<1>(Side::Right), 1).first.normalized();
      forward += other_courses[j].reversed ? -tangent : tangent;
    }
    const Curve& curve = family.curves[k];
    const double area = enclosed_area(curve).dot(forward);
    if (!(std::abs(area) > kNoArea * curve.size() * curve.size()))
    {
      throw BoundaryError(BoundaryDefect::Branch,
        "which way " + numbered(family.name, k) + " runs cannot be told: it meets only two " +
          other.name + "s and encloses no area across them; a third " + other.name + " tells it");
    }
    first = k == 0 ? area : first;
    courses[k].reversed = area * first < 0.0;
  }
}

CurveFamily make_family(const Given& given, const Eigen::MatrixXd& meetings,
  const std::vector<int>& order, const std::vector<int>& across, const std::vector<Course>& courses)
{
  CurveFamily family;
  family.closed = given.closed;
  family.meetings = Eigen::MatrixXd::Ones(order.size(), across.size() + (given.closed ? 1 : 0));
  for (std::size_t k = 0; k < order.size(); ++k)
  {
    const Course& course = courses[order[k]];
    const PiecewisePolynomial whole = PiecewisePolynomial::homogeneous(given.curves[order[k]]);
    const PiecewisePolynomial started = given.closed ? whole.started_at(course.start) : whole;
    family.curves.push_back(course.reversed ? started.reversed() : started);
    for (std::size_t j = 0; j < across.size(); ++j)
    {
      family.meetings(k, j) = course(meetings(order[k], across[j]));
    }
  }
  return family;
}

void check_order(const CurveFamily& family, const Given& given, const Given& other,
  const std::vector<int>& order, const std::vector<int>& across)
{
  for (Eigen::Index k = 0; k < family.meetings.rows(); ++k)
  {
    for (std::size_t j = 1; j < across.size(); ++j)
    {
      const double step = family.meetings(k, j) - family.meetings(k, j - 1);
      const std::string curve = numbered(given.name, order[k]);
      const std::string before = numbered(other.name, across[j - 1]);
      const std::string after = numbered(other.name, across[j]);
      if (std::abs(step) <= kSamePlace)
      {
        throw BoundaryError(BoundaryDefect::Branch,
          before + " and " + after + " meet " + curve + " at one place, its parameter " +
            to_text(family.meetings(k, j)) + " of [0, 1]");
      }
      if (step < 0.0)
      {
        throw BoundaryError(BoundaryDefect::Branch,
          curve + " meets " + after + " before " + before + ", at " +
            to_text(family.meetings(k, j)) + " and " + to_text(family.meetings(k, j - 1)) +
            " of [0, 1]; " + numbered(given.name, order[0]) + " meets them the other way round");
      }
    }
  }
}

/// Orders and directions as they are reported: closed curves meet the seam twice.
void report_order(const Given& family, const Given& other, const std::vector<Course>& courses,
  std::vector<int> order, std::vector<int>& report, std::vector<bool>& reversed)
{
  if (other.closed)
  {
    order.push_back(family.again >= 0 ? family.again : family.seam);
  }
  for (const int k : order)
  {
    reversed.push_back(courses[k].reversed);
  }
  report = std::move(order);
}

} // namespace

Vector3 CurveFamily::point(std::size_t k, double t) const
{
  return this->curves[k].value(t).hnormalized();
}

CurveNetwork order_network(const std::vector<Curve>& profiles, const std::vector<Curve>& guides,
  const GordonOptions& options)
{
  Given of_profiles{ "profile", profiles };
  Given of_guides{ "guide", guides };
  for (Given* family : { &of_profiles, &of_guides })
  {
    check_count(*family);
    find_closure(*family);
  }
  CurveNetwork network;
  network.size = size_of(profiles, guides);
  find_seam(of_profiles, of_guides, network.size);
  find_seam(of_guides, of_profiles, network.size);
  const Meetings meetings = find_meetings(profiles, guides, network.size, options, network.report);

  // === Which way the curves run, and in which order they are met
  std::vector<Course> profile_courses = find_courses(of_profiles, meetings.on_profile, of_guides);
  std::vector<Course> guide_courses = find_courses(of_guides, meetings.on_guide, of_profiles);
  const std::vector<int> guide_order =
    order_along(along(profile_courses[0], meetings.on_profile.row(0)), of_guides.again);
  const std::vector<int> profile_order =
    order_along(along(guide_courses[0], meetings.on_guide.row(0)), of_profiles.again);
  const bool turn_profiles = of_profiles.closed && guide_order.size() == 2;
  const bool turn_guides = of_guides.closed && profile_order.size() == 2;
  if (turn_profiles && turn_guides)
  {
    throw BoundaryError(BoundaryDefect::Count,
      "two closed profiles and two closed guides leave it open which way they run; a third of "
      "either tells it");
  }
  if (turn_profiles)
  {
    turn_by_area(profile_courses, of_profiles, of_guides, meetings.on_guide, guide_courses);
  }
  if (turn_guides)
  {
    turn_by_area(guide_courses, of_guides, of_profiles, meetings.on_profile, profile_courses);
  }
  NetworkReport& report = network.report;
  report_order(of_profiles, of_guides, profile_courses, profile_order, report.profile_order,
    report.profile_reversed);
  report_order(
    of_guides, of_profiles, guide_courses, guide_order, report.guide_order, report.guide_reversed);

  network.profiles =
    make_family(of_profiles, meetings.on_profile, profile_order, guide_order, profile_courses);
  network.guides =
    make_family(of_guides, meetings.on_guide, guide_order, profile_order, guide_courses);
  check_order(network.profiles, of_profiles, of_guides, profile_order, guide_order);
  check_order(network.guides, of_guides, of_profiles, guide_order, profile_order);
  return network;
}

} // namespace footpoint
