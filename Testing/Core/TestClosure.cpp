// SPDX-License-Identifier: BSD-3-Clause
#include "Shapes.h"

#include <gtest/gtest.h>

using footpoint::Curve;
using footpoint::KnotVector;
using footpoint::ParametricGeometry;
using footpoint::Points;
using footpoint::Surface;
using footpoint::Vector3;

namespace
{

/// An unclamped closed cubic times a line along z; `lift` opens it at one height only.
Surface periodic_tube(double lift)
{
  const int n = 8;
  const Curve ring = shapes::periodic(n);
  const Points section = ring.local_control_points().colwise() + ring.centre();
  const std::vector<double> knots_v = shapes::clamped_knots(3, 5);
  const int nv = 8;
  Points net(3, section.cols() * nv);
  for (int j = 0; j < nv; ++j)
  {
    for (int i = 0; i < section.cols(); ++i)
    {
      const bool opened = j == 3 && i >= n;
      net.col(j * section.cols() + i) =
        section.col(i) + Vector3(0, 0, j) + (opened ? lift : 0.0) * Vector3::UnitX();
    }
  }
  return Surface(KnotVector(3, ring.knots().knots()), KnotVector(3, knots_v), net);
}

void expect_closed(const Surface& surface, bool u, bool v)
{
  EXPECT_EQ(surface.direction(0).closed, u);
  EXPECT_EQ(surface.direction(1).closed, v);
}

void expect_collapsed(const Surface& surface, int direction, bool start, bool end)
{
  EXPECT_EQ(surface.direction(direction).collapsed[0], start);
  EXPECT_EQ(surface.direction(direction).collapsed[1], end);
}

/// Known by its values alone, as functions of VTK are.
class Cylinder : public ParametricGeometry<2>
{
public:
  explicit Cylinder(double angle)
  {
    this->Size = 2.0;
    this->Directions[0].length = angle;
    this->Directions[0].spans = { 0.0, angle };
    this->Directions[1].spans = { 0.0, 1.0 };
    this->analyse();
  }
  footpoint::Jet<2> jet(
    const footpoint::Parameter<2>& t, const footpoint::Sides<2>&, int) const override
  {
    footpoint::Jet<2> jet;
    jet.point = Vector3(std::cos(t[0]), std::sin(t[0]), t[1]);
    jet.first << Vector3(-std::sin(t[0]), std::cos(t[0]), 0), Vector3::UnitZ();
    return jet;
  }
};

} // namespace

TEST(Closure, OfCurvesIsJudgedByEvaluating)
{
  EXPECT_TRUE(shapes::circle().direction(0).closed);
  EXPECT_TRUE(shapes::closed_with_corner().direction(0).closed);
  EXPECT_TRUE(shapes::periodic().direction(0).closed); // its end poles differ
  EXPECT_FALSE(shapes::open_with_matching_poles().direction(0).closed);
  EXPECT_FALSE(shapes::parabola().direction(0).closed);
  EXPECT_FALSE(shapes::line_with_gap().direction(0).closed);
}

TEST(Closure, FarAwayIsTheSame)
{
  EXPECT_TRUE(shapes::circle(1.0, { 1e7, 1e7, 1e7 }).direction(0).closed);
}

TEST(Closure, ToleranceIsRelativeToTheSize)
{
  for (const double scale : { 1e-6, 1.0, 1e6 })
  {
    for (const double gap : { 0.5e-9, 2e-9 })
    {
      // A loop with a box of 3 by 4, diagonal 5.
      const Curve curve = shapes::polynomial_curve(1, { 0, 0, 1, 2, 3, 3 },
        scale * shapes::points({ { 0, 0, 0 }, { 3, 0, 0 }, { 3, 4, 0 }, { 5.0 * gap, 0, 0 } }));
      EXPECT_EQ(curve.direction(0).closed, gap < 1e-9) << scale << " " << gap;
    }
  }
}

TEST(Closure, OfSurfaces)
{
  expect_closed(shapes::torus(), true, true);
  expect_closed(shapes::sphere(), true, false);
  expect_closed(shapes::cylinder(), false, false);
  expect_closed(shapes::cylinder(10.0, 360.0, 4), true, false);
  expect_closed(shapes::saddle(), false, false);
  expect_closed(shapes::helical_ribbon(), false, false);
}

TEST(Closure, HoldsAlongTheWholeSeamOrNotAtAll)
{
  expect_closed(periodic_tube(0.0), true, false);
  expect_closed(periodic_tube(1e-3), false, false); // open in the middle of the seam alone
}

TEST(Closure, OpeningInOneSpanOfManyIsSeen)
{
  // A degree 1 tube of square section with 40 rings, one of which does not close.
  for (const int bad : { -1, 0, 17, 39 })
  {
    Points net(3, 5 * 40);
    for (int j = 0; j < 40; ++j)
    {
      const double x[] = { 0, 1, 1, 0, 0 };
      const double y[] = { 0, 0, 1, 1, 0 };
      for (int i = 0; i < 5; ++i)
      {
        net.col(5 * j + i) = Vector3(x[i], j == bad && i == 4 ? 1e-3 : y[i], j);
      }
    }
    const Surface tube(
      KnotVector(1, shapes::clamped_knots(1, 4)), KnotVector(1, shapes::clamped_knots(1, 39)), net);
    expect_closed(tube, bad < 0, false);
  }
}

TEST(Closure, RationalSidesThatMeetOnlyAtSomePlacesAreOpen)
{
  // Both sides run along the same line from 0 to 1, at speeds that differ by the weights alone;
  // they agree at the ends and nowhere else.
  const KnotVector line(1, { 0, 0, 1, 1 });
  const Points net = shapes::points(
    { { 0, 0, 0 }, { 0, 1, 0 }, { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 1, 0, 0 } });
  Eigen::VectorXd weights(6);
  weights << 1, 1, 1, 1, 1, 4;
  const KnotVector three(1, { 0, 0, 1, 2, 2 });
  expect_closed(Surface(three, line, net), true, false);
  expect_closed(Surface(three, line, net, weights), false, false);
}

TEST(Closure, SidesOfHighDegreeThatMeetAtManyPlacesAreOpen)
{
  // Polynomial sides that differ by a multiple of Π (v − place_k), at the Chebyshev–Lobatto points
  // of every number that is too small for the degree.
  for (int degree = 2; degree <= 12; ++degree)
  {
    std::vector<double> difference{ 1.0 }; // Bernstein ordinates
    for (int k = 0; k < degree; ++k)
    {
      const double place = 0.5 - 0.5 * std::cos(std::acos(-1.0) * k / (degree - 1));
      std::vector<double> product(k + 2);
      for (int i = 0; i <= k + 1; ++i)
      {
        const double low = i <= k ? -place * (k + 1 - i) * difference[i] : 0.0;
        const double high = i > 0 ? (1.0 - place) * i * difference[i - 1] : 0.0;
        product[i] = (low + high) / (k + 1);
      }
      difference = product;
    }
    const double largest =
      Eigen::Map<const Eigen::VectorXd>(difference.data(), degree + 1).cwiseAbs().maxCoeff();
    Points net(3, 3 * (degree + 1));
    for (int j = 0; j <= degree; ++j)
    {
      net.col(3 * j + 0) = Vector3(0, j, 0);
      net.col(3 * j + 1) = Vector3(1, j, 0);
      net.col(3 * j + 2) = Vector3(difference[j] / largest, j, 0);
    }
    const Surface surface(
      KnotVector(1, { 0, 0, 1, 2, 2 }), KnotVector(degree, shapes::clamped_knots(degree, 1)), net);
    expect_closed(surface, false, false);
  }
}

TEST(Closure, CollapsedSides)
{
  expect_collapsed(shapes::sphere(), 1, true, true);
  expect_collapsed(shapes::sphere(), 0, false, false);
  expect_collapsed(shapes::triangle(), 0, true, false);
  expect_collapsed(shapes::triangle(), 1, false, false);
  expect_collapsed(shapes::torus(), 0, false, false);
  expect_collapsed(shapes::torus(), 1, false, false);
  // A side that starts and ends in one point has not collapsed.
  expect_collapsed(shapes::cylinder(10.0, 360.0, 4), 1, false, false);
}

TEST(Closure, CurvesHaveNoSidesThatCollapse)
{
  EXPECT_FALSE(shapes::circle().direction(0).collapsed[0]);
  EXPECT_FALSE(shapes::circle().direction(0).collapsed[1]);
}

TEST(Closure, OnePointIsClosedAndCollapsed)
{
  const KnotVector line(1, { 0, 0, 1, 1 });
  const Surface surface(line, line, Vector3(1, 2, 3).replicate(1, 4));
  expect_closed(surface, true, true);
  expect_collapsed(surface, 0, true, true);
  expect_collapsed(surface, 1, true, true);
}

TEST(Closure, OfGeometryWithoutKnots)
{
  const double turn = 2.0 * std::acos(-1.0);
  const Cylinder full(turn);
  EXPECT_TRUE(full.direction(0).closed);
  EXPECT_FALSE(full.direction(1).closed);
  EXPECT_NEAR(full.direction(0).speed, 1.0, 1e-14);
  EXPECT_FALSE(Cylinder(0.75 * turn).direction(0).closed);
  // Without a list of knots origin + local stands in.
  EXPECT_EQ(full.to_domain({ 1.25, 0.5 }), Eigen::Vector2d(1.25, 0.5));
  EXPECT_EQ(full.to_domain({ 0.0, 1.0 }), Eigen::Vector2d(0.0, 1.0));
}
