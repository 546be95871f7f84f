// SPDX-License-Identifier: BSD-3-Clause
//
// Order of convergence of every step, measured.

#include "MeasuredSteps.h"

#include <gtest/gtest.h>

#include <cstdio>

namespace
{

using namespace measured;

/// Order p and constant C of |e'| = C |e|^p, with e in fractions of the domain; medians over cases.
struct Order
{
  double by_halving = 0.0;  ///< p of one step from distances h and h / 2
  double by_sequence = 0.0; ///< log(e_{k+1}/e_k) / log(e_k/e_{k−1}) at the end of an iteration
  double constant = 0.0;
};

template <int N>
Order measure(
  const ParametricGeometry<N>& geometry, const std::vector<Case<N>>& cases, Method method)
{
  const Step<N> step = make_step<N>(method);
  const Parameter<N> length = lengths(geometry);
  shapes::Random random(11);
  std::vector<double> halving, sequence, constant;
  for (const Case<N>& one : cases)
  {
    Parameter<N> direction;
    for (int i = 0; i < N; ++i)
    {
      direction(i) = random.uniform(0.5, 1.0) * (random.integer(0, 1) ? 1.0 : -1.0);
    }
    direction.normalize();
    const auto error = [&](const Parameter<N>& t)
    { return (t - one.foot).cwiseQuotient(length).norm(); };
    const auto next = [&](const Parameter<N>& t) -> Parameter<N>
    { return t + bare_step<N>(geometry, one.query, t, step); };
    const double h = 1e-3;
    const Parameter<N> offset = h * direction.cwiseProduct(length);
    const double whole = error(next(one.foot + offset));
    const double half = error(next(one.foot + 0.5 * offset));
    const double order = std::log2(whole / half);
    halving.push_back(order);
    constant.push_back(whole / std::pow(h, std::round(order)));

    std::vector<double> errors;
    Parameter<N> t = one.foot + 20.0 * offset;
    while (errors.size() < 30 && error(t) > 1e-13 && error(t) < 0.1)
    {
      errors.push_back(error(t));
      t = next(t);
    }
    if (errors.size() >= 3)
    {
      const double* e = &errors[errors.size() - 3];
      sequence.push_back(std::log(e[2] / e[1]) / std::log(e[1] / e[0]));
    }
  }
  return { median(halving), sequence.empty() ? 0.0 : median(sequence), median(constant) };
}

template <int N>
std::map<Method, Order> print_orders(
  const char* name, const ParametricGeometry<N>& geometry, bool on, bool planar = false)
{
  const auto cases = random_cases<N>(geometry, on, planar);
  std::map<Method, Order> orders;
  std::printf("\n%s, queries %s the geometry\n%-20s%8s%10s%12s\n", name, on ? "on" : "off", "step",
    "order", "sequence", "constant");
  for (const Method method : methods_for<N>())
  {
    const Order order = measure<N>(geometry, cases, method);
    orders[method] = order;
    std::printf("%-20s%8.2f%10.2f%12.2g\n", kMethodNames.at(method), order.by_halving,
      order.by_sequence, order.constant);
  }
  return orders;
}

void expect_order(const std::map<Method, Order>& orders, Method method, double order)
{
  EXPECT_NEAR(orders.at(method).by_halving, order, 0.15) << kMethodNames.at(method);
  // Above order 2 two steps are down to rounding, which leaves no sequence.
  if (order <= 2.0)
  {
    EXPECT_NEAR(orders.at(method).by_sequence, order, 0.3) << kMethodNames.at(method);
  }
}

/// Off a curve: first derivatives give order 1, curvature order 2, in the plane and in space.
void expect_curve_orders(const std::map<Method, Order>& orders)
{
  for (const auto& entry : orders)
  {
    const bool linear = entry.first == Method::GaussNewton ||
      entry.first == Method::LevenbergMarquardt || entry.first == Method::FirstOrder;
    expect_order(orders, entry.first, linear ? 1.0 : 2.0);
  }
}

TEST(ConvergenceOrder, PlaneCurves)
{
  expect_curve_orders(
    print_orders<1>("plane cubic (example 1)", paper::first_example().curve, false, true));
  expect_curve_orders(
    print_orders<1>("plane cubic (example 2)", paper::second_example().curve, false, true));
}

TEST(ConvergenceOrder, SpaceCurves)
{
  expect_curve_orders(print_orders<1>("rational quintic in space", space_curve(), false));
  const auto on = print_orders<1>("rational quintic in space", space_curve(), true);
  for (const auto& entry : on)
  {
    // Where r vanishes, E is even along the geodesic: the covariant step gains an order.
    expect_order(on, entry.first, entry.first == Method::SecondOrder ? 3.0 : 2.0);
  }
}

TEST(ConvergenceOrder, Surfaces)
{
  const Surface bumpy = shapes::bumpy(8, 3);
  const Surface torus = shapes::torus();
  for (const auto& orders : { print_orders<2>("bicubic, 8 x 8 poles", bumpy, false),
         print_orders<2>("torus", torus, false) })
  {
    expect_order(orders, Method::Newton, 2.0);
    expect_order(orders, Method::SecondOrder, 2.0);
    expect_order(orders, Method::GaussNewton, 1.0);
    expect_order(orders, Method::LevenbergMarquardt, 1.0);
  }
  for (const auto& orders :
    { print_orders<2>("bicubic, 8 x 8 poles", bumpy, true), print_orders<2>("torus", torus, true) })
  {
    expect_order(orders, Method::Newton, 2.0);
    expect_order(orders, Method::SecondOrder, 3.0);
    expect_order(orders, Method::GaussNewton, 2.0);
    expect_order(orders, Method::LevenbergMarquardt, 2.0);
  }
  // On a sphere E depends on the arc alone, and is even in it.
  const auto orders = print_orders<2>("octant of a sphere", octant(), false);
  expect_order(orders, Method::Newton, 2.0);
  expect_order(orders, Method::SecondOrder, 3.0);
}

} // namespace
