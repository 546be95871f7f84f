// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/grids/coons_surface.h"

#include "footpoint/grids/boundary.h"
#include "footpoint/splines/piecewise_polynomial.h"

#include <algorithm>
#include <charconv>

namespace footpoint
{
namespace
{

/// Two denominators that agree to this relative difference are one.
constexpr double kSameWeights = 1e-12;

const char* const kNames[4] = { "bottom", "right", "top", "left" };

/// Two facing sides over one denominator: numerators (3 rows) and the denominator (1 row).
struct FacingSides
{
  PiecewisePolynomial start; ///< bottom or left
  PiecewisePolynomial end;   ///< top or right
  PiecewisePolynomial weight;
};

Vector3 end_point(const Curve& curve, int end)
{
  return curve.centre() + curve.point(Parameter<1>(end == 0 ? 0.0 : curve.direction(0).length));
}

std::string text(double number)
{
  char buffer[32];
  return { buffer, std::to_chars(buffer, buffer + sizeof buffer, number).ptr };
}

void check_corners(const std::array<Curve, 4>& curves, double tolerance)
{
  double size = 0.0;
  for (const Curve& curve : curves)
  {
    size = std::max(size, curve.size());
  }
  // Per corner: the side and its end that meet there.
  const std::array<std::array<int, 4>, 4> corners{ { { kBottom, 0, kLeft, 0 },
    { kBottom, 1, kRight, 0 }, { kTop, 1, kRight, 1 }, { kTop, 0, kLeft, 1 } } };
  for (const auto& [a, end_a, b, end_b] : corners)
  {
    const double gap = (end_point(curves[a], end_a) - end_point(curves[b], end_b)).norm();
    if (gap > tolerance * size)
    {
      throw BoundaryError(BoundaryDefect::Gap,
        std::string("the ") + (end_a == 0 ? "start" : "end") + " of " + kNames[a] + " and the " +
          (end_b == 0 ? "start" : "end") + " of " + kNames[b] + " are " + text(gap) +
          " apart; allowed is " + text(tolerance * size));
    }
  }
}

/// Whether b = factor · a, by the control points in a common space; the factor, or 0.
double proportion(const PiecewisePolynomial& a, const PiecewisePolynomial& b)
{
  const KnotVector knots = common_knots(a, b, 1);
  const Eigen::MatrixXd first = a.refined(b.breakpoints()).control_points(knots);
  const Eigen::MatrixXd second = b.refined(a.breakpoints()).control_points(knots);
  const double factor = second(0, 0) / first(0, 0);
  const double difference = (second - factor * first).cwiseAbs().maxCoeff();
  return difference <= kSameWeights * second.cwiseAbs().maxCoeff() ? factor : 0.0;
}

FacingSides common_denominator(const Curve& start, const Curve& end)
{
  const PiecewisePolynomial a = PiecewisePolynomial::homogeneous(start);
  const PiecewisePolynomial b = PiecewisePolynomial::homogeneous(end);
  const PiecewisePolynomial weight_a = a.rows(3, 1);
  const PiecewisePolynomial weight_b = b.rows(3, 1);
  if (const double factor = proportion(weight_a, weight_b))
  {
    return { a.rows(0, 3), b.rows(0, 3).scaled(1.0 / factor), weight_a };
  }
  return { a.rows(0, 3).times(weight_b), b.rows(0, 3).times(weight_a), weight_a.times(weight_b) };
}

/// The functions of one parameter that the surface is made of, as control points on one knot
/// vector.
struct Factors
{
  KnotVector knots;
  Eigen::MatrixXd start;      ///< numerator of bottom or left
  Eigen::MatrixXd end;        ///< numerator of top or right
  Eigen::RowVectorXd weight;  ///< w
  Eigen::RowVectorXd falling; ///< (1 − t) w
  Eigen::RowVectorXd rising;  ///< t w
};

Factors make_factors(const FacingSides& sides, bool polynomial)
{
  const PiecewisePolynomial falling =
    PiecewisePolynomial::single(Eigen::RowVector2d(1.0, 0.0)).times(sides.weight);
  const PiecewisePolynomial rising =
    PiecewisePolynomial::single(Eigen::RowVector2d(0.0, 1.0)).times(sides.weight);
  // Over a constant denominator the products keep the degree 1 of their linear factor.
  const int least = polynomial ? 1 : rising.degree();
  KnotVector knots = common_knots(sides.start, sides.end, least);
  auto control = [&knots](const PiecewisePolynomial& part)
  { return part.refined(knots.knots()).control_points(knots); };
  if (polynomial)
  {
    const PiecewisePolynomial one = PiecewisePolynomial::single(Eigen::RowVector2d(1.0, 1.0));
    const PiecewisePolynomial down = PiecewisePolynomial::single(Eigen::RowVector2d(1.0, 0.0));
    const PiecewisePolynomial up = PiecewisePolynomial::single(Eigen::RowVector2d(0.0, 1.0));
    return { knots, control(sides.start), control(sides.end), control(one), control(down),
      control(up) };
  }
  return { knots, control(sides.start), control(sides.end), control(sides.weight), control(falling),
    control(rising) };
}

} // namespace

Surface coons_surface(const std::array<Curve, 4>& curves, double corner_tolerance)
{
  check_corners(curves, corner_tolerance);
  const Factors u = make_factors(common_denominator(curves[kBottom], curves[kTop]),
    !curves[kBottom].rational() && !curves[kTop].rational());
  const Factors v = make_factors(common_denominator(curves[kLeft], curves[kRight]),
    !curves[kLeft].rational() && !curves[kRight].rational());
  const Vector3 c00 = end_point(curves[kBottom], 0);
  const Vector3 c10 = end_point(curves[kBottom], 1);
  const Vector3 c01 = end_point(curves[kTop], 0);
  const Vector3 c11 = end_point(curves[kTop], 1);
  const Eigen::Index nu = u.weight.size();
  const Eigen::Index nv = v.weight.size();
  Points points(3, nu * nv);
  Eigen::VectorXd weights(nu * nv);
  // Numerator over w(u) w(v): each part times the denominator of the other.
  for (Eigen::Index j = 0; j < nv; ++j)
  {
    for (Eigen::Index i = 0; i < nu; ++i)
    {
      const Vector3 numerator = v.falling(j) * u.start.col(i) + v.rising(j) * u.end.col(i) +
        u.falling(i) * v.start.col(j) + u.rising(i) * v.end.col(j) -
        u.falling(i) * v.falling(j) * c00 - u.rising(i) * v.falling(j) * c10 -
        u.falling(i) * v.rising(j) * c01 - u.rising(i) * v.rising(j) * c11;
      weights(i + nu * j) = u.weight(i) * v.weight(j);
      points.col(i + nu * j) = numerator / weights(i + nu * j);
    }
  }
  auto named = [](const KnotVector& knots, const char* name)
  { return KnotVector(knots.degree(), knots.knots(), name); };
  return Surface(named(u.knots, "KnotsU"), named(v.knots, "KnotsV"), points, weights);
}

} // namespace footpoint
