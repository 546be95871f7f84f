// SPDX-License-Identifier: BSD-3-Clause
//
// The guarded engine: every method from many starts, and each situation that it knows of.

#include "MeasuredSteps.h"

#include "footpoint/solvers/domain_walk.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

namespace
{

using namespace measured;

template <int N>
Parameter<N> random_start(shapes::Random& random, const ParametricGeometry<N>& geometry)
{
  Parameter<N> t;
  for (int i = 0; i < N; ++i)
  {
    t(i) = random.uniform(0.0, geometry.direction(i).length);
  }
  return t;
}

/// The foot of an absolute point from a start in the geometry's own domain.
template <int N>
LocalFoot<N> foot_of(const ParametricGeometry<N>& geometry, const Vector3& point,
  const Parameter<N>& start, const SolverOptions& options = {})
{
  return find_local_foot<N>(geometry, point - geometry.centre(), geometry.to_local(start), options);
}

LocalFoot<1> foot_of(
  const Curve& curve, const Vector3& point, double start, const SolverOptions& options = {})
{
  return foot_of<1>(curve, point, Parameter<1>(start), options);
}

LocalFoot<2> foot_of(const Surface& surface, const Vector3& point, double u, double v,
  const SolverOptions& options = {})
{
  return foot_of<2>(surface, point, Parameter<2>(u, v), options);
}

SolverOptions with(Method method)
{
  SolverOptions options;
  options.method = method;
  return options;
}

// === Every method converges, everywhere

/// Converged, finite, no farther than the start, and a minimum among its neighbours.
template <int N>
void expect_minimum(const ParametricGeometry<N>& geometry, const Vector3& query,
  const Parameter<N>& start, const LocalFoot<N>& foot)
{
  ASSERT_TRUE(foot.parameter.allFinite() && foot.point.allFinite());
  EXPECT_TRUE(foot.converged) << "residual " << foot.residual;
  const double rounding = 1e-13 * (geometry.size() + foot.distance);
  EXPECT_NEAR(foot.distance, (geometry.point(foot.parameter) - query).norm(),
    1e-8 * geometry.size() + rounding);
  EXPECT_LE(foot.distance, (geometry.point(start) - query).norm() + rounding);
  const DomainWalk<N> walk(geometry);
  for (int i = 0; i < N; ++i)
  {
    for (const double h : { -1e-4, 1e-4 })
    {
      const Parameter<N> near =
        walk.enter(foot.parameter + Parameter<N>::Unit(i) * h * geometry.direction(i).length).t;
      EXPECT_GE((geometry.point(near) - query).norm(), foot.distance - rounding);
    }
  }
}

/// Queries inside, around and a million sizes away.
template <int N>
void expect_convergence(const char* name, const ParametricGeometry<N>& geometry)
{
  for (const Method method : methods_for<N>())
  {
    for (const double reach : { 0.5, 2.0, 1e6 })
    {
      shapes::Random random(1);
      for (int k = 0; k < 100; ++k)
      {
        SCOPED_TRACE(testing::Message()
          << name << ", " << kMethodNames.at(method) << ", reach " << reach << ", no. " << k);
        const Vector3 query = random.vector(-1.0, 1.0) * (reach * geometry.size());
        const Parameter<N> start = random_start(random, geometry);
        expect_minimum<N>(
          geometry, query, start, find_local_foot<N>(geometry, query, start, with(method)));
      }
    }
  }
}

TEST(LocalSolver, EveryMethodConvergesOnCurves)
{
  expect_convergence<1>("example 1", paper::first_example().curve);
  expect_convergence<1>("example 2", paper::second_example().curve);
  expect_convergence<1>("quintic", space_curve());
  expect_convergence<1>("corner", shapes::closed_with_corner());
  expect_convergence<1>("circle", shapes::circle());
  expect_convergence<1>("periodic", shapes::periodic());
  expect_convergence<1>("tent", shapes::tent());
  expect_convergence<1>("stalled", shapes::stalled_line());
  expect_convergence<1>("parabola", shapes::parabola());
}

TEST(LocalSolver, EveryMethodConvergesOnSurfaces)
{
  expect_convergence<2>("bumpy", shapes::bumpy(8, 3));
  expect_convergence<2>("octant", octant());
  expect_convergence<2>("sphere", shapes::sphere());
  expect_convergence<2>("torus", shapes::torus());
  expect_convergence<2>("saddle", shapes::saddle());
  expect_convergence<2>("cylinder", shapes::cylinder());
  expect_convergence<2>("square", shapes::square());
  expect_convergence<2>("triangle", shapes::triangle());
  expect_convergence<2>("cusp", shapes::cusp());
  expect_convergence<2>("ribbon", shapes::helical_ribbon());
}

// === Seams, kinks, gaps

TEST(LocalSolver, CrossesASmoothSeam)
{
  const Curve circle = shapes::circle(10.0);
  const double angle = -0.3;
  const Vector3 query(12.0 * std::cos(angle), 12.0 * std::sin(angle), 0.0);
  for (const Method method : methods_for<1>())
  {
    const auto foot = foot_of(circle, query, 10.0, with(method));
    EXPECT_TRUE(foot.converged) << kMethodNames.at(method);
    EXPECT_NEAR(foot.distance, 2.0, 1e-12);
    EXPECT_GT(foot.parameter(0), 270.0);
    EXPECT_EQ(foot.type, FootType::Interior);
  }
  const Surface torus = shapes::torus();
  const double tube = 3.0 + 1.5 * std::cos(angle);
  const Vector3 beyond_both(tube * std::cos(angle), tube * std::sin(angle), 1.5 * std::sin(angle));
  for (const Method method : methods_for<2>())
  {
    const auto foot = foot_of(torus, beyond_both, 10.0, 10.0, with(method));
    EXPECT_TRUE(foot.converged) << kMethodNames.at(method);
    EXPECT_NEAR(foot.distance, 0.5, 1e-12);
    EXPECT_GT(foot.parameter.minCoeff(), 270.0);
  }
}

TEST(LocalSolver, SeamIsReportedAtItsStart)
{
  const Curve circle = shapes::circle(10.0);
  for (const double start : { 20.0, 340.0, 360.0 })
  {
    const auto foot = foot_of(circle, { 12, 0, 0 }, start);
    EXPECT_NEAR(foot.distance, 2.0, 1e-13);
    EXPECT_LT(std::min(foot.parameter(0), 360.0 - foot.parameter(0)), 1e-9);
    EXPECT_LT(foot.parameter(0), 360.0);
    EXPECT_EQ(foot.type, FootType::Interior);
  }
}

TEST(LocalSolver, StopsAtAKinkedSeam)
{
  const Curve curve = shapes::closed_with_corner();
  for (const double start : { 0.02, 0.98, 0.0, 1.0 })
  {
    const auto foot = foot_of(curve, { 0, -1, 0 }, start);
    EXPECT_TRUE(foot.converged) << start;
    EXPECT_NEAR(foot.distance, 1.0, 1e-14);
    EXPECT_EQ(foot.parameter(0), 0.0);
    EXPECT_EQ(foot.type, FootType::Kink);
  }
}

TEST(LocalSolver, StopsAtAKinkAndCrossesIt)
{
  const Curve tent = shapes::tent();
  for (const double start : { 0.0, 0.3, 1.0, 1.7 })
  {
    const auto foot = foot_of(tent, { 1, 2, 0 }, start);
    EXPECT_TRUE(foot.converged);
    EXPECT_EQ(foot.parameter(0), 1.0);
    EXPECT_EQ(foot.distance, 1.0);
    EXPECT_EQ(foot.type, FootType::Kink);
  }
  const auto over = foot_of(tent, { 1.75, 0.75, 0 }, 0.2); // above the right leg at (1.5, 0.5)
  EXPECT_NEAR(over.parameter(0), 1.5, 1e-12);
  EXPECT_EQ(over.type, FootType::Interior);
}

// === Bounds

TEST(LocalSolver, BoundsAreHeldAndReleased)
{
  const Surface square = shapes::square();
  for (const Method method : methods_for<2>())
  {
    shapes::Random random(3);
    for (int k = 0; k < 20; ++k)
    {
      const double u =
        k == 0 ? 0.0 : random.uniform(0.0, 10.0); // no. 0: a corner far from the foot
      const double v = k == 0 ? 0.0 : random.uniform(0.0, 10.0);
      const auto edge = foot_of(square, { 5, 5, 100 }, u, v, with(method));
      EXPECT_TRUE(edge.converged);
      EXPECT_EQ(edge.type, FootType::Edge);
      EXPECT_NEAR((edge.point + square.centre() - Vector3(0, 5, 10)).norm(), 0.0, 1e-12);
      EXPECT_LE(edge.residual, 1e-12 * edge.distance);
      const auto vertex = foot_of(square, { 5, -20, 100 }, u, v, with(method));
      EXPECT_TRUE(vertex.converged);
      EXPECT_EQ(vertex.type, FootType::Vertex);
      EXPECT_EQ(vertex.parameter, Parameter<2>(0, 10));
      EXPECT_EQ(vertex.residual, 0.0);
    }
  }
}

TEST(LocalSolver, BoundaryOfAnAlmostClosedCylinder)
{
  const Vector3 query(std::sqrt(2.0), -std::sqrt(2.0), 5.0);
  const auto foot = foot_of(shapes::cylinder(), query, 250.0, 0.0);
  EXPECT_TRUE(foot.converged);
  EXPECT_EQ(foot.type, FootType::Edge);
  EXPECT_NEAR(foot.distance, (Vector3(0, -10, 5) - query).norm(), 1e-12);
  EXPECT_NEAR(foot.distance, 8.7015, 1e-4);
}

// === Stationary points that are no minima

TEST(LocalSolver, EscapesSaddlesAndMaxima)
{
  for (const Method method : methods_for<2>())
  {
    const auto foot = foot_of(shapes::saddle(), { 0, 0, 1.5 }, 0.0, 0.0, with(method));
    EXPECT_TRUE(foot.converged);
    EXPECT_NEAR(foot.distance, std::sqrt(2.0), 1e-12) << kMethodNames.at(method);
  }
  for (const Method method : methods_for<1>())
  {
    const auto foot = foot_of(shapes::parabola(), { 0, 0.75, 0 }, 0.0, with(method));
    EXPECT_TRUE(foot.converged);
    EXPECT_NEAR(foot.distance, std::sqrt(0.5), 1e-12) << kMethodNames.at(method);
    // A quartic minimum: t itself is known to a third of the digits.
    const auto flat = foot_of(shapes::parabola(), { 0, 0.5, 0 }, 0.7, with(method));
    EXPECT_TRUE(flat.converged);
    EXPECT_NEAR(flat.distance, 0.5, 1e-14);
  }
}

// === Poles and stalled parameters

TEST(LocalSolver, LeavesAPoleAndFindsIt)
{
  const Surface sphere = shapes::sphere();
  for (const Method method : methods_for<2>())
  {
    for (const double column : { 0.0, 100.0, 225.0, 360.0 })
    {
      const auto away = foot_of(sphere, { 1.2, 1.6, 0 }, column, 90.0, with(method));
      EXPECT_TRUE(away.converged) << kMethodNames.at(method) << " from column " << column;
      EXPECT_NEAR(away.distance, 1.0, 1e-12);
      const auto pole = foot_of(sphere, { 0, 0, 2 }, column, -10.0, with(method));
      EXPECT_TRUE(pole.converged);
      EXPECT_NEAR(pole.distance, 1.0, 1e-13);
      EXPECT_EQ(pole.type, FootType::Degenerate);
      const auto near = foot_of(sphere, { 1e-9, 0, 2 }, column, 10.0, with(method));
      EXPECT_TRUE(near.converged);
      EXPECT_NEAR(near.distance, 1.0, 1e-13);
    }
    const auto apex = foot_of(shapes::triangle(), { -1, -1, 1 }, 0.7, 0.4, with(method));
    EXPECT_TRUE(apex.converged);
    EXPECT_NEAR(apex.distance, std::sqrt(3.0), 1e-13);
    EXPECT_EQ(apex.type, FootType::Degenerate);
  }
}

TEST(LocalSolver, StalledParameters)
{
  for (const Method method : methods_for<1>())
  {
    for (const double start : { 0.0, 1e-9, 0.5, 1.0 })
    {
      const auto foot = foot_of(shapes::stalled_line(), { 0.001, 1, 0 }, start, with(method));
      EXPECT_TRUE(foot.converged) << kMethodNames.at(method) << " from " << start;
      EXPECT_NEAR(foot.parameter(0), 0.1, 1e-9);
    }
  }
  for (const Method method : methods_for<2>())
  {
    for (const double start : { -0.9, 0.0, 0.4 })
    {
      const auto foot = foot_of(shapes::cusp(), { -1, 0, 0.3 }, start, 0.8, with(method));
      EXPECT_TRUE(foot.converged) << kMethodNames.at(method) << " from " << start;
      EXPECT_NEAR(foot.distance, 1.0, 1e-12);
      EXPECT_EQ(foot.type, FootType::Degenerate);
    }
  }
}

// === Options

template <int N>
int total_iterations(const ParametricGeometry<N>& geometry, const SolverOptions& options)
{
  shapes::Random random(9);
  int total = 0;
  for (int k = 0; k < 50; ++k)
  {
    const Vector3 query = random.vector(-1.0, 1.0) * geometry.size();
    total +=
      find_local_foot<N>(geometry, query, random_start(random, geometry), options).iterations;
  }
  return total;
}

TEST(SolverOptions, TrustRadiusLimitsTheFirstStep)
{
  const Surface square = shapes::square();
  for (const double radius : { 0.01, 0.1 })
  {
    SolverOptions options;
    options.trust_radius = radius;
    options.maximum_iterations = 2;
    const auto foot = foot_of(square, { 3, 9, 9 }, 1.0, 1.0, options);
    const double way = (foot.point + square.centre() - Vector3(0, 1, 1)).norm();
    EXPECT_NEAR(way, radius * square.size(), 1e-12);
  }
}

TEST(SolverOptions, IterationLimitKeepsTheBestPoint)
{
  const Surface bumpy = shapes::bumpy(8, 3);
  const Vector3 query(0.2, 0.7, 0.4);
  double last = std::numeric_limits<double>::infinity();
  for (int limit = 1; limit <= 4; ++limit)
  {
    SolverOptions options = with(Method::GaussNewton);
    options.maximum_iterations = limit;
    const auto foot = foot_of(bumpy, query, 0.9, 0.1, options);
    EXPECT_EQ(foot.termination, Termination::IterationLimit);
    EXPECT_EQ(foot.iterations, limit);
    EXPECT_FALSE(foot.converged);
    EXPECT_LT(foot.distance, last);
    last = foot.distance;
  }
}

/// S9: |S_u| : |S_v| = 1 : 1e8. Unscaled, any damping of v stops u altogether.
TEST(SolverOptions, ColumnScaling)
{
  shapes::Random random(4);
  Points net(3, 64);
  for (int k = 0; k < 64; ++k)
  {
    net.col(k) = Vector3(k % 8 / 7.0, k / 8 / 7.0, random.uniform(-0.1, 0.1));
  }
  const KnotVector unit(3, shapes::clamped_knots(3, 5));
  const Surface twin(unit, unit, net);
  const Surface stretched(KnotVector(3, shapes::clamped_knots(3, 5, 0.0, 1e8)), unit, net);
  SolverOptions options = with(Method::LevenbergMarquardt);
  const int well_scaled = total_iterations<2>(twin, options);
  EXPECT_NEAR(total_iterations<2>(stretched, options), well_scaled, 0.1 * well_scaled);
  options.column_scaling = false;
  EXPECT_GT(total_iterations<2>(stretched, options), 2 * well_scaled);
  for (const Method method : methods_for<2>())
  {
    const auto one = foot_of(twin, { 0.3, 0.6, 0.4 }, 0.5, 0.5, with(method));
    const auto other = foot_of(stretched, { 0.3, 0.6, 0.4 }, 0.5e8, 0.5, with(method));
    EXPECT_NEAR((one.point - other.point).norm(), 0.0, 1e-10) << kMethodNames.at(method);
  }
}

TEST(SolverOptions, EachHasAnEffect)
{
  using Change = std::function<void(SolverOptions&)>;
  const auto changes = [](Method method, const Change& change)
  {
    const Surface bumpy = shapes::bumpy(8, 3, 0.5);
    SolverOptions options = with(method);
    const int before = total_iterations<2>(bumpy, options);
    change(options);
    return total_iterations<2>(bumpy, options) - before;
  };
  const Method damped = Method::LevenbergMarquardt;
  EXPECT_GT(changes(damped, [](auto& o) { o.initial_lambda = 1e4; }), 0);
  EXPECT_GT(changes(damped, [](auto& o) { o.minimum_lambda = 1.0; }), 0);
  EXPECT_NE(changes(damped, [](auto& o) { o.maximum_lambda = 1e-3; }), 0);
  EXPECT_LT(changes(Method::Newton, [](auto& o) { o.cosine_tolerance = 1e-3; }), 0);
  EXPECT_LT(changes(Method::Newton, [](auto& o) { o.step_tolerance = 1e-3; }), 0);
  EXPECT_LT(changes(Method::Newton, [](auto& o) { o.point_tolerance = 0.2; }), 0);
  EXPECT_GT(changes(Method::Newton, [](auto& o) { o.trust_radius = 0.01; }), 0);
}

/// Where the method has nothing to offer, 1-D Newton steps are taken, or else steepest descent.
TEST(SolverOptions, IsocurveFallback)
{
  const Surface bumpy = shapes::bumpy(8, 3, 0.5);
  const Step<2> nothing = [](const Frame<2>&, const StepSettings<2>&) -> Parameter<2>
  { return Parameter<2>::Zero(); };
  const auto search = [&](bool fallback)
  {
    SolverOptions options;
    options.isocurve_fallback = fallback;
    options.maximum_iterations = 9; // before Newton takes over from what is slow
    const Vector3 query = Vector3(0.4, 0.6, 1.0) - bumpy.centre();
    return find_local_foot<2>(bumpy, query, Parameter<2>(0.5, 0.5), options, nothing);
  };
  const auto with_fallback = search(true);
  const auto without = search(false);
  EXPECT_GT(with_fallback.iterations, 2);
  EXPECT_LT(with_fallback.residual, without.residual);
}

TEST(SolverOptions, TerminationsNameTheirTest)
{
  const Surface bumpy = shapes::bumpy(8, 3);
  const Vector3 on = bumpy.point(Parameter<2>(0.3, 0.6)) + bumpy.centre();
  const auto coincident = foot_of(bumpy, on, 0.35, 0.55);
  EXPECT_TRUE(coincident.converged);
  EXPECT_EQ(coincident.termination, Termination::PointCoincidence);
  EXPECT_EQ(foot_of(bumpy, { 0.3, 0.6, 0.3 }, 0.35, 0.55).termination, Termination::ZeroCosine);
  SolverOptions options;
  options.step_tolerance = 0.1;
  const auto shortened = foot_of(bumpy, { 0.3, 0.6, 0.3 }, 0.35, 0.55, options);
  EXPECT_EQ(shortened.termination, Termination::SmallStep);
  EXPECT_FALSE(shortened.converged); // its residual is more than rounding
}

} // namespace
