// SPDX-License-Identifier: BSD-3-Clause
// Circle, sphere, torus, cylinder and cone.
#include "footpoint/shapes/shape_checks.h"
#include "footpoint/shapes/shapes.h"

namespace footpoint
{

namespace
{

/// A rational quadratic profile or circle in the plane: columns (x, y), weights and knots.
struct PlaneCurve
{
  Eigen::Matrix2Xd points;
  Eigen::VectorXd weights;
  std::vector<double> knots;
};

/// The circle of four quarters, on [0, 1]; its coordinates are exact, so that its seam is closed to
/// the bit.
PlaneCurve unit_circle()
{
  const double w = std::sqrt(0.5);
  PlaneCurve circle;
  circle.points.resize(2, 9);
  circle.points << 1, 1, 0, -1, -1, -1, 0, 1, 1, //
    0, 1, 1, 1, 0, -1, -1, -1, 0;
  circle.weights.resize(9);
  circle.weights << 1, w, 1, w, 1, w, 1, w, 1;
  circle.knots = { 0, 0, 0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1, 1, 1 };
  return circle;
}

/// The half circle from (0, −1) through (1, 0) to (0, 1), on [0, 1].
PlaneCurve unit_half_circle()
{
  const double w = std::sqrt(0.5);
  PlaneCurve half;
  half.points.resize(2, 5);
  half.points << 0, 1, 1, 1, 0, //
    -1, -1, 0, 1, 1;
  half.weights.resize(5);
  half.weights << 1, w, 1, w, 1;
  half.knots = { 0, 0, 0, 0.5, 0.5, 1, 1, 1 };
  return half;
}

/// A straight line on [0, 1].
PlaneCurve line(const Eigen::Vector2d& start, const Eigen::Vector2d& end)
{
  PlaneCurve line;
  line.points.resize(2, 2);
  line.points << start, end;
  line.weights = Eigen::Vector2d::Ones();
  line.knots = { 0, 0, 1, 1 };
  return line;
}

KnotVector knots_of(const PlaneCurve& curve, const char* name)
{
  const auto count = static_cast<int>(curve.points.cols());
  return KnotVector(static_cast<int>(curve.knots.size()) - count - 1, curve.knots, name);
}

/// The surface of revolution about z of a profile with points (r, z), which runs along v; u is the
/// angle, so that S_u × S_v is to the right of the profile's direction (Piegl and Tiller, section
/// 8.5).
Surface revolve(const PlaneCurve& profile)
{
  const PlaneCurve circle = unit_circle();
  const Eigen::Index count = profile.points.cols();
  Points points(3, 9 * count);
  Eigen::VectorXd weights(9 * count);
  for (Eigen::Index j = 0; j < count; ++j)
  {
    for (Eigen::Index i = 0; i < 9; ++i)
    {
      const double r = profile.points(0, j);
      points.col(9 * j + i) << r * circle.points(0, i), r * circle.points(1, i),
        profile.points(1, j);
      weights[9 * j + i] = circle.weights[i] * profile.weights[j];
    }
  }
  return Surface(knots_of(circle, "KnotsU"), knots_of(profile, "KnotsV"), points, weights);
}

} // namespace

Curve circle(double radius)
{
  check_length("Radius", radius);
  const PlaneCurve plane = unit_circle();
  Points points = Points::Zero(3, 9);
  points.topRows<2>() = radius * plane.points;
  return Curve(knots_of(plane, "KnotsU"), points, plane.weights);
}

Shape sphere(double radius)
{
  check_length("Radius", radius);
  PlaneCurve profile = unit_half_circle();
  profile.points *= radius;
  return { { "Sphere", revolve(profile) } };
}

Shape torus(double radius, double cross_section_radius)
{
  check_length("Radius", radius);
  check_length("CrossSectionRadius", cross_section_radius);
  if (cross_section_radius >= radius)
  {
    throw ShapeError("CrossSectionRadius = " + to_text(cross_section_radius) +
      "; it must be less than Radius = " + to_text(radius) + ", or the torus cuts itself");
  }
  PlaneCurve profile = unit_circle();
  profile.points *= cross_section_radius;
  profile.points.row(0).array() += radius;
  return { { "Torus", revolve(profile) } };
}

Shape cylinder(double radius, double height, bool capping)
{
  check_length("Radius", radius);
  check_length("Height", height);
  const double h = 0.5 * height;
  Shape shape{ { "Cylinder", revolve(line({ radius, -h }, { radius, h })) } };
  if (capping)
  {
    shape.push_back({ "Bottom", revolve(line({ 0.0, -h }, { radius, -h })) });
    shape.push_back({ "Top", revolve(line({ radius, h }, { 0.0, h })) });
  }
  return shape;
}

Shape cone(double radius, double height, bool capping)
{
  check_length("Radius", radius);
  check_length("Height", height);
  const double h = 0.5 * height;
  Shape shape{ { "Cone", revolve(line({ radius, -h }, { 0.0, h })) } };
  if (capping)
  {
    shape.push_back({ "Bottom", revolve(line({ 0.0, -h }, { radius, -h })) });
  }
  return shape;
}

} // namespace footpoint
