// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/solvers/curve_step.h"

#include <cmath>
#include <stdexcept>

namespace footpoint
{
namespace
{

/// The query in the osculating plane.
struct OsculatingFrame
{
  double speed;     ///< |c'|
  double curvature; ///< κ ≥ 0
  double along;     ///< a = (P − c)·t
  double across;    ///< b = (P − c)·n
};

OsculatingFrame osculating_frame(const Frame<1>& frame)
{
  const Vector3 first = frame.jet.first;
  const Vector3 second = frame.jet.second;
  const double speed = frame.speed(0);
  const Vector3 tangent = first / speed;
  const Vector3 bend = second - tangent * second.dot(tangent);
  const double bend_length = bend.norm();
  OsculatingFrame osculating;
  osculating.speed = speed;
  osculating.curvature = bend_length / (speed * speed);
  osculating.along = -frame.r.dot(tangent);
  osculating.across = bend_length > 0.0 ? -frame.r.dot(bend) / bend_length : 0.0;
  return osculating;
}

/// dκ/ds, eq. (30), for κ ≥ 0 in space.
double curvature_rate(const Frame<1>& frame, const OsculatingFrame& osculating)
{
  const Vector3 first = frame.jet.first;
  const Vector3 second = frame.jet.second;
  const Vector3 binormal = first.cross(second);
  const double area = binormal.norm();
  if (area == 0.0)
  {
    return 0.0;
  }
  const double speed = osculating.speed;
  const Vector3 third = frame.jet.third;
  const double by_parameter = binormal.dot(first.cross(third)) / (area * speed * speed * speed) -
    3.0 * osculating.curvature * first.dot(second) / (speed * speed);
  return by_parameter / speed;
}

/// Eq. (24): the parameter step whose parabola has the same height over the tangent as Q.
/// \param height (Q − c)·n
/// \param along  (Q − c)·t, which gives the step its sign, eq. (25)
double step_from_height(double height, double along, const OsculatingFrame& osculating)
{
  const double length = std::sqrt(2.0 * std::abs(height) / osculating.curvature);
  return std::copysign(length, along) / osculating.speed;
}

/// (Q − c)·t of eq. (22). Its last term turns a step longer than √6 radii of curvature round:
/// without it the published counts do not come out for starts beyond the centre of curvature.
double along_tangent(double s, const OsculatingFrame& o)
{
  const double turned = o.curvature * s;
  return s * (1.0 - turned * turned / 6.0);
}

/// Eq. (23): arc length to the foot on the osculating parabola, linearised.
double linear_arc(const OsculatingFrame& o)
{
  return o.along / (1.0 - o.curvature * o.across);
}

double first_order(const Frame<1>&, const OsculatingFrame& o)
{
  return o.along / o.speed;
}

/// Eqs. (9)–(13). With the centre at (0, ρ), h = |P − O|: the height of Q is ρ (1 + (b − ρ)/h),
/// without cancellation ρ a² / (h (h − (b − ρ))) where P is on the curve's side of the centre.
double curvature_circle(const Frame<1>& frame, const OsculatingFrame& o)
{
  if (o.curvature == 0.0)
  {
    return first_order(frame, o);
  }
  const double radius = 1.0 / o.curvature;
  const double below = o.across - radius;
  const double reach = std::hypot(o.along, below);
  if (!std::isfinite(radius) || reach == 0.0)
  {
    return first_order(frame, o);
  }
  const double height = below < 0.0 ? radius * o.along * o.along / (reach * (reach - below))
                                    : radius * (1.0 + below / reach);
  return step_from_height(height, o.along, o);
}

/// Eqs. (22)–(25), Q without the change of curvature.
double second_order_1(const Frame<1>& frame, const OsculatingFrame& o)
{
  if (o.curvature == 0.0)
  {
    return first_order(frame, o);
  }
  const double s = linear_arc(o);
  return step_from_height(0.5 * o.curvature * s * s, along_tangent(s, o), o);
}

/// Eq. (27), which is |Δt| = |s| / |c'| in exact arithmetic, with the sign of eq. (25).
double second_order_2(const Frame<1>&, const OsculatingFrame& o)
{
  const double s = linear_arc(o);
  return std::copysign(s, along_tangent(s, o)) / o.speed;
}

/// Eqs. (20), (22) with the change of curvature, (24), (25); the root of smaller magnitude. NaN
/// where the roots are complex: the model has no foot, and the method nothing to propose.
double second_order_3(const Frame<1>& frame, const OsculatingFrame& o)
{
  if (o.curvature == 0.0)
  {
    return first_order(frame, o);
  }
  const double rate = curvature_rate(frame, o);
  const double k = o.curvature;
  const double quadratic = 0.5 * rate * o.across - 0.5 * k * k * o.along;
  const double linear = k * o.across - 1.0;
  const double discriminant = linear * linear - 4.0 * quadratic * o.along;
  // NaN for a negative discriminant. In this form the smaller root loses no digits.
  const double s = -2.0 * o.along / (linear + std::copysign(std::sqrt(discriminant), linear));
  const double height = 0.5 * k * s * s + rate * s * s * s / 6.0;
  return step_from_height(height, along_tangent(s, o), o);
}

} // namespace

Step<1> make_curve_step(Method method)
{
  double (*formula)(const Frame<1>&, const OsculatingFrame&) = nullptr;
  switch (method)
  {
    case Method::FirstOrder:
      formula = first_order;
      break;
    case Method::CurvatureCircle:
      formula = curvature_circle;
      break;
    case Method::SecondOrder1:
      formula = second_order_1;
      break;
    case Method::SecondOrder2:
      formula = second_order_2;
      break;
    case Method::SecondOrder3:
      formula = second_order_3;
      break;
    default:
      throw std::invalid_argument("not a geometric step for curves");
  }
  return [formula](const Frame<1>& frame, const StepSettings<1>& settings) -> Parameter<1>
  {
    // Where the curve stands still there is no tangent, and nothing to be said.
    if (!settings.free(0) || frame.speed(0) == 0.0)
    {
      return Parameter<1>::Zero();
    }
    return Parameter<1>(formula(frame, osculating_frame(frame)));
  };
}

} // namespace footpoint
