// SPDX-License-Identifier: BSD-3-Clause

#include "PaperExamples.h"

#include <cmath>

namespace paper
{

Example first_example()
{
  return { shapes::polynomial_curve(3, { 0, 0, 0, 0, 1, 1, 1, 1 },
             shapes::points({ { -2, 0, 0 }, { 0, 3, 0 }, { 2, -7, 0 }, { 6, 0, 0 } })),
    { 0, 2, 0 }, 0.20301655993621742 };
}

Example second_example()
{
  return { shapes::polynomial_curve(3, { 0, 0, 0, 0, 0.2, 0.4, 0.6, 0.8, 1, 1, 1, 1 },
             shapes::points({ { 100, 100, 0 }, { 140, 196, 0 }, { 200, 240, 0 }, { 260, 164, 0 },
               { 340, 164, 0 }, { 400, 240, 0 }, { 460, 196, 0 }, { 500, 100, 0 } })),
    { 310, 200, 0 }, 0.54652 };
}

SolverOptions bare_options(Method method, double tolerance, int limit)
{
  SolverOptions options;
  options.method = method;
  options.safeguards = false;
  options.point_tolerance = 0.0;
  options.cosine_tolerance = 0.0;
  options.step_tolerance = 0.0;
  options.parameter_tolerance = tolerance;
  options.maximum_iterations = limit;
  return options;
}

// === The formulas as printed: Q from absolute coordinates

double cross(const Vector3& a, const Vector3& b)
{
  return a.x() * b.y() - a.y() * b.x();
}

PlaneFrame plane_frame(const Curve& curve, const Frame<1>& frame)
{
  const Vector3 first = frame.jet.first;
  const double speed = first.norm();
  const Vector3 t = first / speed;
  return { frame.jet.point + curve.centre(), first, t, Vector3(-t.y(), t.x(), 0.0),
    cross(first, frame.jet.second) / (speed * speed * speed) };
}

Parameter<1> step_to(const Vector3& q, const PlaneFrame& f)
{
  const double speed = f.first.norm();
  const double square =
    2.0 * std::abs(cross(f.first, q - f.c)) / (std::abs(f.curvature) * speed * speed * speed);
  return Parameter<1>(std::copysign(std::sqrt(square), f.first.dot(q - f.c)));
}

Step<1> printed_first_order(const Curve& curve, const Vector3& p)
{
  return [&curve, p](const Frame<1>& frame, const StepSettings<1>&)
  {
    const PlaneFrame f = plane_frame(curve, frame);
    return Parameter<1>((p - f.c).dot(f.t) / f.first.squaredNorm());
  };
}

Step<1> printed_circle_step(const Curve& curve, const Vector3& p)
{
  return [&curve, p](const Frame<1>& frame, const StepSettings<1>&)
  {
    const PlaneFrame f = plane_frame(curve, frame);
    const Vector3 o = f.c + f.n / f.curvature;
    const double e = 1.0 - 1.0 / (std::abs(f.curvature) * (p - o).norm());
    return step_to(p * (1.0 - e) + o * e, f);
  };
}

Step<1> printed_method_1(const Curve& curve, const Vector3& p)
{
  return [&curve, p](const Frame<1>& frame, const StepSettings<1>&)
  {
    const PlaneFrame f = plane_frame(curve, frame);
    const double k = f.curvature;
    const double s = (p - f.c).dot(f.t) / (1.0 - k * (p - f.c).dot(f.n));
    const Vector3 q = f.c + s * f.t + 0.5 * k * s * s * f.n - k * k * s * s * s / 6.0 * f.t;
    return step_to(q, f);
  };
}

Step<1> printed_method_3(const Curve& curve, const Vector3& p)
{
  return [&curve, p](const Frame<1>& frame, const StepSettings<1>&)
  {
    const PlaneFrame f = plane_frame(curve, frame);
    const double k = f.curvature;
    const double speed = f.first.norm();
    const double rate = (cross(f.first, frame.jet.third) / (speed * speed * speed) -
                          3.0 * k * f.first.dot(frame.jet.second) / (speed * speed)) /
      speed;
    const double along = (p - f.c).dot(f.t);
    const double across = (p - f.c).dot(f.n);
    const double a = 0.5 * rate * across - 0.5 * k * k * along;
    const double b = k * across - 1.0;
    const double root = std::sqrt(b * b - 4.0 * a * along);
    const double one = (-b + root) / (2.0 * a);
    const double other = (-b - root) / (2.0 * a);
    const double s = std::abs(one) < std::abs(other) ? one : other;
    const Vector3 q =
      f.c + s * f.t + 0.5 * k * s * s * f.n + s * s * s / 6.0 * (rate * f.n - k * k * f.t);
    return step_to(q, f);
  };
}

} // namespace paper
