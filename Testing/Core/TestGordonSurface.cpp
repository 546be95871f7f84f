// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/grids/gordon_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>

using namespace footpoint;

namespace
{

/// A bicubic polynomial surface in Bernstein form, so that its isoparametric curves are cubics.
Vector3 height(double u, double v)
{
  return { 2.0 * u + 0.2 * v * v, 1.5 * v - 0.1 * u * u * u,
    u * u * v - 0.5 * v * v * v * u + 0.3 * u };
}

/// The cubic through four points at 0, 1/3, 2/3, 1.
Curve cubic(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d, bool reversed)
{
  Points points(3, 4);
  points.col(0) = a;
  points.col(1) = (-5.0 * a + 18.0 * b - 9.0 * c + 2.0 * d) / 6.0;
  points.col(2) = (2.0 * a - 9.0 * b + 18.0 * c - 5.0 * d) / 6.0;
  points.col(3) = d;
  if (reversed)
  {
    points = points.rowwise().reverse().eval();
  }
  return Curve(KnotVector(3, { 0, 0, 0, 0, 1, 1, 1, 1 }), points);
}

Curve profile(double v, bool reversed = false)
{
  return cubic(height(0, v), height(1 / 3., v), height(2 / 3., v), height(1, v), reversed);
}

Curve guide(double u, bool reversed = false)
{
  return cubic(height(u, 0), height(u, 1 / 3.), height(u, 2 / 3.), height(u, 1), reversed);
}

Vector3 at(const Surface& surface, double u, double v)
{
  return surface.centre() + surface.point(Parameter<2>(u, v));
}

Curve line(const Vector3& a, const Vector3& b)
{
  Points points(3, 2);
  points << a, b;
  return Curve(KnotVector(1, { 0, 0, 1, 1 }), points);
}

/// A full circle about the z axis, of four rational quadratics, from an angle on; clockwise with a
/// negative turn.
Curve circle(double radius, double height, double from, double turn = 1.0)
{
  Points points(3, 9);
  Eigen::VectorXd weights(9);
  for (int k = 0; k < 9; ++k)
  {
    const double angle = from + turn * k * EIGEN_PI / 4;
    weights(k) = k % 2 == 0 ? 1.0 : std::sqrt(0.5);
    points.col(k) << radius / weights(k) * std::cos(angle), radius / weights(k) * std::sin(angle),
      height;
  }
  points.col(8) = points.col(0);
  return Curve(KnotVector(2, { 0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4 }), points, weights);
}

Vector3 on_circle(double radius, double angle, double height)
{
  return { radius * std::cos(angle), radius * std::sin(angle), height };
}

/// The closed C2 cubic whose control polygon is given, over [0, 1] with the seam at one of its
/// knots, moved.
Curve closed_cubic(const Points& polygon, int from, bool reversed, const Vector3& offset)
{
  const int n = int(polygon.cols());
  Points points(3, n + 3);
  for (int k = 0; k < n + 3; ++k)
  {
    const int which = reversed ? from + 2 - k + n : from + k;
    points.col(k) = polygon.col((which + n) % n) + offset;
  }
  std::vector<double> knots;
  for (int k = -3; k <= n + 3; ++k)
  {
    knots.push_back(k / double(n));
  }
  return Curve(KnotVector(3, knots), points);
}

Points egg_polygon()
{
  Points polygon(3, 7);
  for (int k = 0; k < 7; ++k)
  {
    const double angle = 2 * EIGEN_PI * k / 7;
    polygon.col(k) = on_circle(1 + 0.2 * std::cos(angle), angle, 0.1 * std::sin(2 * angle));
  }
  return polygon;
}

Vector3 on_curve(const Curve& curve, double t)
{
  const Direction& direction = curve.direction(0);
  return curve.point(Parameter<1>(t * direction.length)) + curve.centre();
}

void expect_refused(const std::vector<Curve>& profiles, const std::vector<Curve>& guides,
  const std::vector<std::string>& words)
{
  try
  {
    gordon_surface(profiles, guides);
    ADD_FAILURE() << "accepted; expected " << words.front();
  }
  catch (const BoundaryError& error)
  {
    for (const std::string& word : words)
    {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos)
        << error.what() << "\n  lacks: " << word;
    }
  }
}

/// Largest difference of value and first derivatives across the seam of u.
double seam_step(const Surface& surface)
{
  double worst = 0.0;
  for (int k = 0; k <= 50; ++k)
  {
    const Sides<2> right(Side::Right, Side::Right);
    const Sides<2> left(Side::Left, Side::Right);
    const Jet<2> a = surface.jet(Parameter<2>(0, k / 50.0), right, 1);
    const Jet<2> b = surface.jet(Parameter<2>(1, k / 50.0), left, 1);
    worst = std::max({ worst, (a.point - b.point).norm(), (a.first - b.first).norm() });
  }
  return worst;
}

/// The curves of a file with one JSON object a line.
std::vector<Curve> read_curves(const std::string& name)
{
  std::ifstream file(name);
  std::vector<Curve> curves;
  for (std::string text; std::getline(file, text);)
  {
    auto numbers = [&](const std::string& key)
    {
      std::vector<double> result;
      const std::size_t at = text.find('"' + key + '"');
      for (const char* c = text.c_str() + text.find('[', at) + 1; *c != '"' && *c != '}';)
      {
        char* end = nullptr;
        const double number = std::strtod(c, &end);
        if (end != c)
        {
          result.push_back(number);
        }
        c = end == c ? c + 1 : end;
      }
      return result;
    };
    if (text.find("\"cp\"") == std::string::npos)
    {
      continue;
    }
    const std::vector<double> poles = numbers("cp");
    const Eigen::Map<const Eigen::Matrix4Xd> columns(
      poles.data(), 4, Eigen::Index(poles.size() / 4));
    curves.emplace_back(KnotVector(3, numbers("knots")), columns.topRows<3>());
  }
  return curves;
}

} // namespace

TEST(GordonSurface, ReproducesABicubicFromShuffledAndReversedCurves)
{
  const std::vector<Curve> profiles{ profile(0.4), profile(1.0, true), profile(0.0),
    profile(0.7, true) };
  const std::vector<Curve> guides{ guide(0.0), guide(1.0), guide(0.25, true), guide(0.6) };
  const GordonResult result = gordon_surface(profiles, guides);
  EXPECT_EQ(result.network.profile_order, (std::vector<int>{ 2, 0, 3, 1 }));
  EXPECT_EQ(result.network.guide_order, (std::vector<int>{ 0, 2, 3, 1 }));
  EXPECT_EQ(result.network.profile_reversed, (std::vector<bool>{ false, false, true, true }));
  EXPECT_EQ(result.network.reparametrization_error, 0.0);
  EXPECT_LE(result.network.largest_gap, 1e-14);
  for (int i = 0; i <= 20; ++i)
  {
    for (int j = 0; j <= 20; ++j)
    {
      const double u = i / 20.0;
      const double v = j / 20.0;
      ASSERT_LE((at(result.surface, u, v) - height(u, v)).norm(), 1e-12) << u << ", " << v;
    }
  }
}

TEST(GordonSurface, GapNamesTheCurvesAndTheDistance)
{
  Curve far = profile(0.5);
  const Points moved =
    (far.local_control_points().colwise() + far.centre()).colwise() + Vector3(0, 0, 3);
  const std::vector<Curve> profiles{ profile(0.0), Curve(far.knots(), moved), profile(1.0) };
  try
  {
    gordon_surface(profiles, { guide(0.0), guide(1.0) });
    FAIL() << "a curve three units above the network was accepted";
  }
  catch (const BoundaryError& error)
  {
    EXPECT_EQ(error.defect(), BoundaryDefect::Gap);
    EXPECT_NE(std::string(error.what()).find("profile 1 and guide 0"), std::string::npos)
      << error.what();
  }
}

TEST(GordonSurface, DifferingParametersAreRefusedOrReparametrizedOnRequest)
{
  // The middle profile runs unevenly: t² in place of t along a straight line.
  auto uneven = [](const Vector3& a, const Vector3& b)
  {
    Points points(3, 3);
    points << a, a + 0.2 * (b - a), b;
    return Curve(KnotVector(2, { 0, 0, 0, 1, 1, 1 }), points);
  };
  const std::vector<Curve> profiles{ line({ 0, 0, 0 }, { 1, 0, 0 }),
    uneven({ 0, 0.5, 0 }, { 1, 0.5, 0 }), line({ 0, 1, 0 }, { 1, 1, 0 }) };
  const std::vector<Curve> guides{ line({ 0, 0, 0 }, { 0, 1, 0 }),
    line({ 0.5, 0, 0 }, { 0.5, 1, 0 }), line({ 1, 0, 0 }, { 1, 1, 0 }) };
  EXPECT_THROW(gordon_surface(profiles, guides), BoundaryError);
  GordonOptions options;
  options.reparametrize = true;
  const GordonResult result = gordon_surface(profiles, guides, options);
  EXPECT_GT(result.network.reparametrization_error, 0.0);
  EXPECT_LE(result.network.reparametrization_error, 1e-4);
  for (int i = 0; i <= 10; ++i)
  {
    for (int j = 0; j <= 10; ++j)
    {
      EXPECT_NEAR(at(result.surface, i / 10.0, j / 10.0).z(), 0.0, 1e-12);
    }
  }
  // The network's curves lie on the surface.
  const double u = result.network.parameters_u[1];
  EXPECT_NEAR(at(result.surface, u, 0.3).x(), 0.5, 1e-9);
}

TEST(GordonSurface, TooFewCurvesAreRefused)
{
  EXPECT_THROW(gordon_surface({ profile(0.0) }, { guide(0.0), guide(1.0) }), BoundaryError);
}

TEST(GordonSurface, CirclesAndRulingsMakeTheCylinderClosedAtTheFirstGuide)
{
  const double quarter = EIGEN_PI / 2;
  const std::vector<double> heights{ 3.0, 0.0, 1.0 };
  const std::vector<Curve> circles{ circle(2, 3, 0), circle(2, 0, quarter, -1),
    circle(2, 1, 2 * quarter) };
  std::vector<Curve> rulings;
  for (const double angle : { 0.3, 4.9, 2.0 })
  {
    rulings.push_back(line(on_circle(2, angle, 0), on_circle(2, angle, 3)));
  }
  for (const bool swapped : { false, true })
  {
    const GordonResult result =
      swapped ? gordon_surface(rulings, circles) : gordon_surface(circles, rulings);
    const NetworkReport& report = result.network;
    const auto& around = swapped ? report.parameters_v : report.parameters_u;
    EXPECT_EQ(
      swapped ? report.profile_order : report.guide_order, (std::vector<int>{ 0, 2, 1, 0 }));
    EXPECT_EQ(swapped ? report.guide_order : report.profile_order, (std::vector<int>{ 1, 2, 0 }));
    EXPECT_EQ(swapped ? report.guide_reversed : report.profile_reversed,
      (std::vector<bool>{ true, false, false }));
    ASSERT_EQ(around.size(), 4u);
    EXPECT_EQ(around.front(), 0.0);
    EXPECT_EQ(around.back(), 1.0);
    EXPECT_EQ(report.reparametrization_error, 0.0);
    EXPECT_TRUE(result.surface.rational());
    EXPECT_TRUE(result.surface.direction(swapped ? 1 : 0).closed);
    double angle_before = 0.3;
    for (int i = 0; i <= 40; ++i)
    {
      for (int j = 0; j <= 6; ++j)
      {
        const double u = i / 40.0;
        const double v = j / 6.0;
        const Vector3 p = swapped ? at(result.surface, v, u) : at(result.surface, u, v);
        ASSERT_NEAR(p.head<2>().norm(), 2.0, 1e-13) << u << ", " << v;
        ASSERT_NEAR(p.z(), 3 * v, 1e-13);
        const double turned = std::remainder(std::atan2(p.y(), p.x()) - angle_before, 4 * quarter);
        ASSERT_GE(turned, -1e-12);
        ASSERT_LE(turned, 0.4);
        angle_before = j == 6 ? angle_before + turned : angle_before;
      }
    }
    EXPECT_NEAR(angle_before, 0.3 + 4 * quarter, 1e-12);
  }
}

TEST(GordonSurface, ClosedCurvesBothWaysMakeATorus)
{
  // S(u, v) = c(u) + d(v), which the Gordon surface reproduces.
  const Points c = egg_polygon();
  Points d(3, 5);
  for (int k = 0; k < 5; ++k)
  {
    const double angle = 2 * EIGEN_PI * k / 5;
    d.col(k) << 4 * std::cos(angle), 0, 5 * std::sin(angle);
  }
  const Curve around = closed_cubic(c, 0, false, Vector3::Zero());
  const Curve along = closed_cubic(d, 0, false, Vector3::Zero());
  std::vector<Curve> profiles;
  std::vector<Curve> guides;
  int k = 0;
  for (const double t : { 0.4, 0.1, 0.87 })
  {
    profiles.push_back(closed_cubic(c, 2 * k, k == 2, on_curve(along, t)));
    guides.push_back(closed_cubic(d, k + 1, k == 1, on_curve(around, t)));
    ++k;
  }
  const GordonResult result = gordon_surface(profiles, guides);
  EXPECT_EQ(result.network.profile_order, (std::vector<int>{ 0, 2, 1, 0 }));
  EXPECT_EQ(result.network.guide_order, (std::vector<int>{ 0, 2, 1, 0 }));
  EXPECT_EQ(result.network.profile_reversed, (std::vector<bool>{ false, true, false, false }));
  EXPECT_EQ(result.network.reparametrization_error, 0.0);
  EXPECT_TRUE(result.surface.direction(0).closed);
  EXPECT_TRUE(result.surface.direction(1).closed);
  for (int i = 0; i <= 20; ++i)
  {
    for (int j = 0; j <= 20; ++j)
    {
      double u = 0.4 + i / 20.0;
      double v = 0.4 + j / 20.0;
      u -= std::floor(u);
      v -= std::floor(v);
      ASSERT_LE(
        (at(result.surface, i / 20.0, j / 20.0) - on_curve(around, u) - on_curve(along, v)).norm(),
        1e-12)
        << i << ", " << j;
    }
  }
  EXPECT_LE(seam_step(result.surface), 1e-11);
}

TEST(GordonSurface, TwoGuidesOneOfThemGivenTwiceTellTheDirectionByTheArea)
{
  // A quarter bend: consecutive circles are turned by 45°, the last is clockwise.
  std::vector<Curve> profiles;
  for (int k = 0; k < 3; ++k)
  {
    const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(-k * EIGEN_PI / 4, Vector3::UnitY()).toRotationMatrix();
    const Curve flat = circle(1, 0, 0.0, k == 2 ? -1 : 1);
    const Points points =
      turn * ((flat.local_control_points().colwise() + flat.centre()).colwise() + Vector3(5, 0, 0));
    profiles.emplace_back(flat.knots(), points, flat.weights());
  }
  auto arc = [](double radius)
  {
    Points points(3, 3);
    points << radius, radius, 0, 0, 0, 0, 0, radius, radius;
    return Curve(
      KnotVector(2, { 0, 0, 0, 1, 1, 1 }), points, Eigen::Vector3d(1, std::sqrt(0.5), 1));
  };
  const std::vector<Curve> guides{ arc(4), arc(6), arc(6) };
  const GordonResult result = gordon_surface(profiles, guides);
  EXPECT_EQ(result.network.guide_order, (std::vector<int>{ 1, 0, 2 }));
  EXPECT_EQ(result.network.profile_reversed, (std::vector<bool>{ false, false, true }));
  EXPECT_TRUE(result.surface.direction(0).closed);
  for (int k = 0; k <= 20; ++k)
  {
    // The middle profile lies on the surface.
    const Vector3 p = at(result.surface, k / 20.0, 0.5);
    EXPECT_NEAR((p - 5 * Vector3(std::sqrt(0.5), 0, std::sqrt(0.5))).norm(), 1.0, 1e-12);
  }
  expect_refused({ profiles[0], profiles[1] }, { guides[1], guides[2] },
    { "closed profiles need two different guides" });
}

TEST(GordonSurface, ClosesSmoothlyWhereTheProfilesDo)
{
  // Eggs of different widths, joined by curved guides: no part of the sum is smooth by itself.
  std::vector<Curve> profiles;
  std::vector<Curve> guides;
  const Points egg = egg_polygon();
  auto scaled = [&](double factor, double height)
  { return closed_cubic(factor * egg, 3, false, Vector3(0.2 * height, 0, height)); };
  const std::vector<double> widths{ 1.0, 1.4, 0.8, 1.1 };
  for (int k = 0; k < 4; ++k)
  {
    profiles.push_back(scaled(widths[k], k / 3.0));
  }
  for (const double t : { 0.11, 0.42, 0.77 })
  {
    guides.push_back(cubic(on_curve(profiles[0], t), on_curve(profiles[1], t),
      on_curve(profiles[2], t), on_curve(profiles[3], t), t > 0.5));
  }
  const GordonResult result = gordon_surface(profiles, guides);
  EXPECT_LE(seam_step(result.surface), 1e-11);
  EXPECT_LE(result.network.largest_gap, 1e-12);
}

TEST(GordonSurface, ClosedNetworksAreRefusedInPlainWords)
{
  const std::vector<Curve> rulings{ line({ 2, 0, 0 }, { 2, 0, 3 }), line({ 0, 2, 0 }, { 0, 2, 3 }),
    line({ 0, -2, 0 }, { 0, -2, 3 }) };
  const std::vector<Curve> circles{ circle(2, 0, 0), circle(2, 3, 0) };
  expect_refused({ circles[0], line({ 2, 0, 3 }, { 0, 2, 3 }) }, rulings,
    { "profile 0 is closed", "profile 1 is not", "2.828" });
  expect_refused(circles, { rulings[0], rulings[1], rulings[1], rulings[0] },
    { "once more", "given twice already" });
  expect_refused(circles, { rulings[0], rulings[1], line({ 2, 0, 0 }, { 0, 0, 3 }) },
    { "profile 1 and guide 2 pass each other at 1.66" });
  // A guide that leans to the next one.
  expect_refused(circles, { rulings[0], rulings[1], line({ 0, -2, 0 }, { 0, 2, 3 }) },
    { "meet profile 1 at one place" });
  const double diagonal = std::sqrt(2.0);
  expect_refused(circles,
    { rulings[0], line({ 0, 2, 0 }, { -2, 0, 3 }), line({ -2, 0, 0 }, { diagonal, diagonal, 3 }),
      rulings[2] },
    { "profile 1 meets guide", "the other way round" });
  // The same curve twice in an open network.
  expect_refused({ profile(0), profile(1) }, { guide(0), guide(1), guide(0, true) },
    { "guide 2 is guide 0 once more", "only a network of closed profiles" });
  // Circles of other weights.
  Eigen::VectorXd weights = circles[1].weights();
  weights(4) *= 1.1;
  const Curve uneven(
    circles[1].knots(), circles[1].local_control_points().colwise() + circles[1].centre(), weights);
  expect_refused(
    { circles[0], uneven }, rulings, { "the weights of profile 1 and profile 0", "is off" });
}

TEST(GordonSurface, ClosedProfilesOfARealWing)
{
  const char* folder = std::getenv("FOOTPOINT_SHARED_DATA");
  const std::string stem = std::string(folder ? folder : "") + "/json/tigl__net_spiralwing_";
  const std::vector<Curve> profiles = read_curves(stem + "profiles.brep.jsonl");
  const std::vector<Curve> guides = read_curves(stem + "guides.brep.jsonl");
  if (profiles.empty() || guides.empty())
  {
    GTEST_SKIP() << "FOOTPOINT_SHARED_DATA names no folder with json/tigl__net_spiralwing_*";
  }
  ASSERT_EQ(profiles.size(), 6u);
  ASSERT_EQ(guides.size(), 3u);
  GordonOptions options;
  options.reparametrize = true;
  options.reparametrization_tolerance = 1e-3;
  const GordonResult result = gordon_surface(profiles, guides, options);
  EXPECT_EQ(result.network.guide_order, (std::vector<int>{ 0, 1, 2 }));
  EXPECT_EQ(result.network.profile_order, (std::vector<int>{ 0, 1, 2, 3, 4, 5 }));
  EXPECT_TRUE(result.surface.direction(0).closed);
  RecordProperty("gap", std::to_string(result.network.largest_gap));
  RecordProperty("change", std::to_string(result.network.reparametrization_error));
  // The profiles lie on the surface as far as they were changed.
  for (std::size_t i = 0; i < profiles.size(); ++i)
  {
    for (int k = 0; k <= 40; ++k)
    {
      const Vector3 p = at(result.surface, k / 40.0, result.network.parameters_v[i]);
      double nearest = 1.0;
      for (int s = 0; s <= 20000; ++s)
      {
        nearest = std::min(nearest, (on_curve(profiles[i], s / 20000.0) - p).norm());
      }
      EXPECT_LE(nearest, 2e-3) << i << ", " << k;
    }
  }
}
