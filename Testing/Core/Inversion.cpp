// SPDX-License-Identifier: BSD-3-Clause

#include "Inversion.h"

#include <cmath>
#include <memory>
#include <sstream>
#include <utility>

namespace inversion
{

Patch patch_of(const footpoint::Curve& curve)
{
  return { std::make_shared<footpoint::Curve>(curve), nullptr };
}

Patch patch_of(const footpoint::Surface& surface)
{
  return { nullptr, std::make_shared<footpoint::Surface>(surface) };
}

Face face_of_patches(std::vector<Patch> patches, bool reversed)
{
  Face face;
  face.patches = std::move(patches);
  face.reversed = reversed;
  return face;
}

footpoint::Surface plate(double x0, double x1, double height, double slope)
{
  const double rise = slope * (x1 - x0);
  return footpoint::Surface(footpoint::KnotVector(1, { x0, x0, x1, x1 }, "KnotsU"),
    footpoint::KnotVector(1, { 0, 0, 1, 1 }, "KnotsV"),
    shapes::points({ { x0, 0, height }, { x1, 0, height + rise }, { x0, 1, height },
      { x1, 1, height + rise } }));
}

footpoint::Points random_points(int count, std::uint64_t seed, double low, double high)
{
  shapes::Random random(seed);
  footpoint::Points points(3, count);
  for (int k = 0; k < count; ++k)
  {
    points.col(k) = random.vector(low, high);
  }
  return points;
}

InversionOptions searching(footpoint::Search search)
{
  InversionOptions options;
  options.search = search;
  return options;
}

InversionOptions all_feet()
{
  InversionOptions options;
  options.all_feet = true;
  return options;
}

InversionOptions orthogonal_only()
{
  InversionOptions options;
  options.orthogonal_only = true;
  return options;
}

InversionOptions along(const Vector3& direction)
{
  InversionOptions options;
  options.fixed_direction = direction;
  return options;
}

double domain_length(const Patch& patch, int i)
{
  return patch.curve ? patch.curve->direction(0).length : patch.surface->direction(i).length;
}

void expect_foot(const PointInverter& inverter, const Foot& foot, const Expected& expected,
  const std::string& what)
{
  SCOPED_TRACE(what);
  if (expected.status != Status::Converged || foot.status != Status::Certified)
  {
    EXPECT_EQ(foot.status, expected.status);
  }
  EXPECT_EQ(foot.type, expected.type);
  EXPECT_EQ(foot.isolated, expected.isolated);
  EXPECT_GE(foot.iterations, 1);
  ASSERT_GE(foot.face, 0);
  const Patch& patch = inverter.model()[foot.face].patches.front();
  const double tolerance = expected.tolerance * inverter.size();
  EXPECT_NEAR(foot.distance, expected.distance, tolerance);
  for (int i = 0; i < 2; ++i)
  {
    if (!std::isnan(expected.parameter(i)))
    {
      EXPECT_NEAR(foot.parameter(i), expected.parameter(i),
        expected.parameter_tolerance * domain_length(patch, i))
        << "parameter " << i;
    }
  }
  for (int i = 0; i < 3; ++i)
  {
    if (!std::isnan(expected.point(i)))
    {
      EXPECT_NEAR(foot.point(i), expected.point(i), tolerance) << "coordinate " << i;
    }
  }
  EXPECT_EQ(foot.on_curve, patch.curve != nullptr);
  if (foot.on_curve)
  {
    EXPECT_EQ(foot.parameter(1), 0.0);
    EXPECT_TRUE(std::isnan(foot.signed_distance));
  }
  else
  {
    EXPECT_EQ(std::abs(foot.signed_distance), foot.distance);
  }
}

void expect_foot(const PointInverter& inverter, const Vector3& query, Expected expected)
{
  std::ostringstream what;
  what << "query " << query.transpose();
  const InversionOptions& options = inverter.options();
  const bool certifies = options.search == footpoint::Search::Global && !options.orthogonal_only &&
    options.fixed_direction.isZero();
  if (expected.status == Status::Converged && certifies)
  {
    expected.status = Status::Certified;
  }
  expect_foot(inverter, inverter.find(query), expected, what.str());
}

void expect_all(
  const PointInverter& inverter, const Vector3& query, const std::vector<Expected>& expected)
{
  std::ostringstream what;
  what << "query " << query.transpose();
  const std::vector<Foot> feet = inverter.find_all(query);
  ASSERT_EQ(feet.size(), expected.size()) << what.str();
  for (std::size_t k = 0; k < feet.size(); ++k)
  {
    expect_foot(inverter, feet[k], expected[k], what.str() + ", foot " + std::to_string(k));
  }
}

bool identical(const Foot& a, const Foot& b)
{
  const auto same = [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); };
  bool equal = a.status == b.status && a.type == b.type && a.isolated == b.isolated &&
    a.iterations == b.iterations && a.face == b.face && a.on_curve == b.on_curve &&
    same(a.distance, b.distance) && same(a.signed_distance, b.signed_distance);
  for (int i = 0; i < 3; ++i)
  {
    equal = equal && same(a.point(i), b.point(i)) && same(a.direction(i), b.direction(i)) &&
      (i == 2 || same(a.parameter(i), b.parameter(i)));
  }
  return equal;
}

} // namespace inversion
