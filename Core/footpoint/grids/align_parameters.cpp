// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/grids/curve_network.h"

#include "footpoint/splines/interpolation.h"
#include "footpoint/splines/validation.h"

#include <algorithm>
#include <cmath>

namespace footpoint
{
namespace
{

/// Points a span of the original that a reparametrized curve is refitted through.
constexpr int kSamplesPerSpan = 12;
constexpr int kLeastSamples = 101;

/// Weights agree up to rounding of their refinement.
constexpr double kSameWeight = 1e-12;

/// A monotone piecewise cubic through (x, y) (F. N. Fritsch and R. E. Carlson 1980).
/// \param periodic the ends have one slope
class MonotoneCubic
{
public:
  MonotoneCubic(std::vector<double> x, std::vector<double> y, bool periodic)
    : X(std::move(x))
    , Y(std::move(y))
    , Slope(this->X.size())
  {
    const std::size_t n = this->X.size();
    for (std::size_t k = 1; k + 1 < n; ++k)
    {
      this->Slope[k] = between(this->secant(k - 1), this->secant(k));
    }
    const double first = this->secant(0);
    const double last = this->secant(n - 2);
    this->Slope[0] = periodic ? between(last, first) : first;
    this->Slope[n - 1] = periodic ? this->Slope[0] : last;
  }

  double operator()(double at) const
  {
    const auto above = std::upper_bound(this->X.begin(), this->X.end(), at);
    const auto k = std::clamp<std::ptrdiff_t>(
      above - this->X.begin() - 1, 0, static_cast<std::ptrdiff_t>(this->X.size()) - 2);
    const double length = this->X[k + 1] - this->X[k];
    const double t = (at - this->X[k]) / length;
    const double s = 1.0 - t;
    return this->Y[k] * s * s * (1.0 + 2.0 * t) + this->Y[k + 1] * t * t * (1.0 + 2.0 * s) +
      length * (this->Slope[k] * t * s * s - this->Slope[k + 1] * t * t * s);
  }

private:
  /// The harmonic mean; secants of rising data are positive.
  static double between(double before, double after)
  {
    return 2.0 * before * after / (before + after);
  }
  double secant(std::size_t k) const
  {
    return (this->Y[k + 1] - this->Y[k]) / (this->X[k + 1] - this->X[k]);
  }

  std::vector<double> X;
  std::vector<double> Y;
  std::vector<double> Slope;
};

/// The curve with its parameter t replaced by change(t), refitted; the largest change of its
/// points, seen between the samples, goes into `error`. Its weights are all 1.
PiecewisePolynomial reparametrized(const PiecewisePolynomial& curve, const MonotoneCubic& change,
  const std::vector<double>& keep, double& error)
{
  const int spans = static_cast<int>(curve.breakpoints().size()) - 1;
  const int count = std::max(kLeastSamples, kSamplesPerSpan * spans);
  std::vector<double> at;
  for (int k = 0; k < count; ++k)
  {
    at.push_back(k / (count - 1.0));
  }
  at.insert(at.end(), keep.begin(), keep.end());
  std::sort(at.begin(), at.end());
  // Samples next to a meeting give way to it.
  const double near = 0.25 / (count - 1.0);
  std::vector<double> thinned;
  for (const double t : at)
  {
    const bool kept = t == 0.0 || t == 1.0 || std::find(keep.begin(), keep.end(), t) != keep.end();
    const bool crowded =
      std::any_of(keep.begin(), keep.end(), [&](double k) { return std::abs(k - t) < near; });
    if ((kept || !crowded) && (thinned.empty() || t > thinned.back()))
    {
      thinned.push_back(t);
    }
  }
  auto at_changed = [&](double t) -> Vector3 { return curve.value(change(t)).hnormalized(); };
  Eigen::MatrixXd points = Eigen::MatrixXd::Ones(4, thinned.size());
  for (std::size_t k = 0; k < thinned.size(); ++k)
  {
    points.col(k).head<3>() = at_changed(thinned[k]);
  }
  const KnotVector knots = averaged_knots(thinned, 3);
  const PiecewisePolynomial result =
    PiecewisePolynomial::spline(knots, interpolate(knots, thinned, points));
  for (std::size_t k = 0; k + 1 < thinned.size(); ++k)
  {
    const double middle = 0.5 * (thinned[k] + thinned[k + 1]);
    error = std::max(error, (result.value(middle).head<3>() - at_changed(middle)).norm());
  }
  return result;
}

/// Brings the weights of all curves to those of the first, as functions of the parameter: a common
/// factor is free. \return the curve whose weights are not a multiple of the first one's, 0: none
std::size_t unite_weights(CurveFamily& family)
{
  const PiecewisePolynomial first = family.curves.front().rows(3, 1);
  family.weighted = false;
  for (std::size_t k = 0; k < family.curves.size(); ++k)
  {
    const PiecewisePolynomial own = family.curves[k].rows(3, 1);
    const double factor = first.value(0.0)(0) / own.value(0.0)(0);
    const KnotVector knots = common_knots(first, own, 1);
    const Eigen::MatrixXd wanted = first.refined(knots.knots()).control_points(knots);
    const Eigen::MatrixXd scaled = factor * own.refined(knots.knots()).control_points(knots);
    if ((wanted - scaled).cwiseAbs().maxCoeff() > kSameWeight * wanted.cwiseAbs().maxCoeff())
    {
      return k;
    }
    family.curves[k] = family.curves[k].scaled(factor);
    family.weighted = family.weighted || (scaled.array() - 1.0).abs().maxCoeff() > kSameWeight;
  }
  return 0;
}

} // namespace

std::vector<double> align_parameters(CurveFamily& family, const std::string& name, double size,
  const GordonOptions& options, double& error)
{
  const Eigen::Index count = family.meetings.rows();
  std::vector<double> common;
  for (Eigen::Index j = 0; j < family.meetings.cols(); ++j)
  {
    const double mean = family.meetings.col(j).mean();
    // The ends of curves are ends of the surface.
    const bool end = (family.meetings.col(j).array() - std::round(mean)).abs().maxCoeff() < 1e-9;
    common.push_back(end ? std::round(mean) : mean);
  }
  double worst = 0.0;
  Eigen::Index worst_curve = 0;
  for (Eigen::Index k = 0; k < count; ++k)
  {
    for (std::size_t j = 0; j < common.size(); ++j)
    {
      const double off =
        (family.point(k, family.meetings(k, j)) - family.point(k, common[j])).norm();
      worst_curve = off > worst ? k : worst_curve;
      worst = std::max(worst, off);
    }
  }
  const std::size_t other_weights = unite_weights(family);
  if (worst <= 1e-9 * size && other_weights == 0)
  {
    return common;
  }
  if (!options.reparametrize && worst <= 1e-9 * size)
  {
    throw BoundaryError(BoundaryDefect::Branch,
      "the weights of " + name + " " + std::to_string(other_weights) + " and " + name +
        " 0 (in order) differ as functions of the parameter, and their Gordon surface is no "
        "rational spline of the curves; reparametrization, which makes polynomials of them, is "
        "off");
  }
  if (!options.reparametrize)
  {
    throw BoundaryError(BoundaryDefect::Branch,
      "the parameters at which the " + name + "s are met differ between them, on " + name + " " +
        std::to_string(worst_curve) + " (in order) by " + to_text(worst) +
        " in space; reparametrization is off");
  }
  for (Eigen::Index k = 0; k < count; ++k)
  {
    std::vector<double> from{ 0.0 };
    std::vector<double> to{ 0.0 };
    for (std::size_t j = 0; j < common.size(); ++j)
    {
      if (common[j] > 0.0 && common[j] < 1.0)
      {
        from.push_back(common[j]);
        to.push_back(family.meetings(k, j));
      }
    }
    from.push_back(1.0);
    to.push_back(1.0);
    family.curves[k] =
      reparametrized(family.curves[k], MonotoneCubic(from, to, family.closed), common, error);
  }
  family.weighted = false;
  if (error > options.reparametrization_tolerance * size)
  {
    throw BoundaryError(BoundaryDefect::Branch,
      "reparametrization changes the " + name + "s by " + to_text(error) + "; allowed is " +
        to_text(options.reparametrization_tolerance * size));
  }
  return common;
}

} // namespace footpoint
