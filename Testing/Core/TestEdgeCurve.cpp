// SPDX-License-Identifier: BSD-3-Clause
#include "Shapes.h"

#include "footpoint/trims/edge_curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

using footpoint::BezierPiece;
using footpoint::edge_pieces;
using footpoint::EdgeCurve;
using footpoint::EdgePieces;
using footpoint::Jet;
using footpoint::Parameter;
using footpoint::Side;
using footpoint::Sides;
using footpoint::Surface;
using footpoint::TrimArc;
using footpoint::Vector3;
using oracle::Real;

namespace
{

using Homogeneous3 = Eigen::Matrix<Real, 3, 1>;

/// An arc of local parameters. \param points (u, v) a column
TrimArc arc_of(const Eigen::Matrix2Xd& points, const Eigen::VectorXd& weights, double start = 0.0,
  double end = 1.0)
{
  TrimArc arc{ {}, 0, 0, false, { { start, end } }, { { false, false } }, true };
  arc.control.resize(3, points.cols());
  arc.control << points * weights.asDiagonal(), weights.transpose();
  return arc;
}

TrimArc line(double u0, double v0, double u1, double v1, double start = 0.0, double end = 1.0)
{
  Eigen::Matrix2Xd points(2, 2);
  points << u0, u1, v0, v1;
  return arc_of(points, Eigen::Vector2d(1, 1), start, end);
}

/// A quarter of a circle in (u, v), counter-clockwise from an angle that is a multiple of 90°.
TrimArc quarter(double u, double v, double radius, int number, double start)
{
  const double x[] = { 1, 0, -1, 0, 1 };
  const double y[] = { 0, 1, 0, -1, 0 };
  Eigen::Matrix2Xd points(2, 3);
  points << x[number], x[number] + x[number + 1], x[number + 1], y[number],
    y[number] + y[number + 1], y[number + 1];
  points = (radius * points).colwise() + Eigen::Vector2d(u, v);
  return arc_of(points, Eigen::Vector3d(1, std::sqrt(0.5), 1), start, start + 1.0);
}

EdgeCurve edge_on(const Surface& surface, std::vector<TrimArc> arcs)
{
  return { std::make_shared<Surface>(surface), std::move(arcs) };
}

/// Values of the Bernstein polynomials by their definition.
std::vector<Real> bernstein(int degree, Real x)
{
  std::vector<Real> values;
  Real binomial = 1.0L;
  for (int i = 0; i <= degree; ++i)
  {
    values.push_back(binomial * std::pow(x, static_cast<Real>(i)) *
      std::pow(1.0L - x, static_cast<Real>(degree - i)));
    binomial = binomial * (degree - i) / (i + 1);
  }
  return values;
}

template <int Rows>
Eigen::Matrix<Real, Rows, 1> bezier_sum(
  const Eigen::Matrix<double, Rows, Eigen::Dynamic>& control, Real fraction)
{
  const std::vector<Real> basis = bernstein(static_cast<int>(control.cols()) - 1, fraction);
  Eigen::Matrix<Real, Rows, 1> sum = Eigen::Matrix<Real, Rows, 1>::Zero();
  for (std::size_t i = 0; i < basis.size(); ++i)
  {
    sum += basis[i] * control.col(i).template cast<Real>();
  }
  return sum;
}

/// S(c(t)) in long double, relative to the surface's centre.
class Judge
{
public:
  explicit Judge(const EdgeCurve& edge)
    : Edge(edge)
    , Spline(shapes::local_spline_of(edge.surface()))
  {
  }

  /// \param fraction of an arc; may leave [0, 1] a little, the pieces are continued
  oracle::Vector at(std::size_t arc, Real fraction) const
  {
    const Surface& surface = this->Edge.surface();
    const TrimArc& of = this->Edge.arcs()[arc];
    const Homogeneous3 middle = bezier_sum<3>(of.control, 0.5L);
    const Homogeneous3 sum = bezier_sum<3>(of.control, fraction);
    std::array<int, 2> spans;
    std::array<Real, 2> t;
    for (int i = 0; i < 2; ++i)
    {
      const Real origin = surface.direction(i).origin;
      // An arc on the last line of the domain belongs to the span below.
      spans[i] = this->Spline.span(i, origin + middle[i] / middle[2], false);
      t[i] = origin + sum[i] / sum[2];
    }
    return this->Spline.evaluate(spans, t);
  }

  oracle::Vector at_parameter(Real t, std::size_t arc) const
  {
    const std::vector<double>& spans = this->Edge.direction(0).spans;
    const Real start = spans[arc];
    return this->at(arc, (t - start) / (spans[arc + 1] - start));
  }

private:
  const EdgeCurve& Edge;
  oracle::Spline<2> Spline;
};

std::size_t arc_of_piece(const EdgeCurve& edge, const BezierPiece<1>& piece)
{
  const std::vector<double>& spans = edge.direction(0).spans;
  std::size_t arc = 0;
  while (arc + 2 < spans.size() && spans[arc + 1] <= piece.lower[0])
  {
    ++arc;
  }
  return arc;
}

/// The largest distance between the pieces and S(c(t)).
double largest_error(const EdgeCurve& edge, const EdgePieces& pieces, int samples = 24)
{
  const Judge judge(edge);
  double worst = 0.0;
  for (const BezierPiece<1>& piece : pieces.pieces)
  {
    const std::size_t arc = arc_of_piece(edge, piece);
    for (int i = 0; i <= samples; ++i)
    {
      const Real fraction = static_cast<Real>(i) / samples;
      const Real lower = piece.lower[0];
      const Eigen::Matrix<Real, 4, 1> sum = bezier_sum<4>(piece.control, fraction);
      const oracle::Vector point = sum.head<3>() / sum[3];
      const Real t = lower + fraction * (static_cast<Real>(piece.upper[0]) - lower);
      const Real error = (point - judge.at_parameter(t, arc)).norm();
      worst = std::max(worst, static_cast<double>(error));
    }
  }
  return worst;
}

/// The pieces cover the edge, end where arcs end, and their joints are closed to rounding.
void expect_chain(const EdgeCurve& edge, const EdgePieces& pieces, double rounding)
{
  const std::vector<double>& spans = edge.direction(0).spans;
  ASSERT_FALSE(pieces.pieces.empty());
  EXPECT_EQ(pieces.pieces.front().lower[0], 0.0);
  EXPECT_EQ(pieces.pieces.back().upper[0], edge.direction(0).length);
  for (const double end : spans)
  {
    EXPECT_TRUE(std::any_of(pieces.pieces.begin(), pieces.pieces.end(),
      [end](const BezierPiece<1>& piece)
      { return piece.lower[0] == end || piece.upper[0] == end; }));
  }
  for (std::size_t k = 0; k + 1 < pieces.pieces.size(); ++k)
  {
    const auto& a = pieces.pieces[k];
    const auto& b = pieces.pieces[k + 1];
    EXPECT_EQ(a.upper[0], b.lower[0]);
    const Eigen::Vector4d end = a.control.rightCols<1>();
    const Eigen::Vector4d start = b.control.col(0);
    const Vector3 apart = end.head<3>() / end[3] - start.head<3>() / start[3];
    EXPECT_LE(apart.norm(), rounding);
  }
}

/// Pieces to 1e-13 of the surface's size: the bound holds, and is not larger than asked for.
EdgePieces expect_accurate(const EdgeCurve& edge, double relative = 1e-13)
{
  const double size = edge.surface().size();
  const EdgePieces pieces = edge_pieces(edge, relative * size);
  EXPECT_LE(largest_error(edge, pieces), pieces.error);
  EXPECT_LE(pieces.error, relative * size);
  expect_chain(edge, pieces, 1e-14 * size);
  return pieces;
}

} // namespace

TEST(EdgeCurve, CircleOnAPlaneIsRationalArcs)
{
  const EdgeCurve edge = edge_on(shapes::square(),
    { quarter(5, 4, 3, 0, 0), quarter(5, 4, 3, 1, 1), quarter(5, 4, 3, 2, 2),
      quarter(5, 4, 3, 3, 3) });
  EXPECT_TRUE(edge.direction(0).closed);
  EXPECT_EQ(edge.direction(0).length, 4.0);
  EXPECT_EQ(edge.direction(0).breaks.size(), 2u) << "a circle has no kink";
  const EdgePieces pieces = expect_accurate(edge, 1e-14);
  ASSERT_EQ(pieces.pieces.size(), 4u);
  for (const BezierPiece<1>& piece : pieces.pieces)
  {
    EXPECT_EQ(piece.degree[0], 2);
  }
  for (double t = 0.0; t <= 4.0; t += 0.1)
  {
    const Vector3 point = edge.centre() + edge.point(Parameter<1>(t));
    EXPECT_NEAR(point.x(), 0.0, 1e-15);
    EXPECT_NEAR(std::hypot(point.y() - 5.0, point.z() - 4.0), 3.0, 4e-15);
  }
}

TEST(EdgeCurve, SlantedLineOnASaddleIsAParabola)
{
  // Local u and v are x + 1 and y + 1.
  const EdgeCurve edge = edge_on(shapes::saddle(), { line(0.25, 0.5, 1.75, 1.0) });
  const EdgePieces pieces = expect_accurate(edge, 1e-14);
  ASSERT_EQ(pieces.pieces.size(), 1u);
  EXPECT_EQ(pieces.pieces[0].degree[0], 2);
  for (double t = 0.0; t <= 1.0; t += 0.125)
  {
    const double x = -0.75 + 1.5 * t;
    const double y = -0.5 + 0.5 * t;
    const Jet<1> jet = edge.jet(Parameter<1>(t), Sides<1>(Side::Right), 3);
    EXPECT_LE((edge.centre() + jet.point - Vector3(x, y, x * y)).norm(), 1e-15);
    EXPECT_LE((jet.first - Vector3(1.5, 0.5, 1.5 * y + 0.5 * x)).norm(), 4e-15);
    EXPECT_LE((jet.second - Vector3(0, 0, 2 * 1.5 * 0.5)).norm(), 4e-15);
    EXPECT_LE(jet.third.norm(), 1e-14);
  }
}

TEST(EdgeCurve, SlantedLineOnACylinderWindsAroundIt)
{
  const EdgeCurve edge = edge_on(shapes::cylinder(),
    { line(0, 1, 90, 7, 0, 90), line(90, 7, 180, 13, 90, 180), line(180, 13, 270, 19, 180, 270) });
  const EdgePieces pieces = expect_accurate(edge);
  for (const BezierPiece<1>& piece : pieces.pieces)
  {
    for (int i = 0; i <= 16; ++i)
    {
      const Eigen::Matrix<Real, 4, 1> sum = bezier_sum<4>(piece.control, i / 16.0L);
      const oracle::Vector point = sum.head<3>() / sum[3] + edge.centre().cast<Real>();
      const Real t = piece.lower[0] + i / 16.0L * (piece.upper[0] - piece.lower[0]);
      EXPECT_NEAR(static_cast<double>(std::hypot(point.x(), point.y())), 10.0, pieces.error);
      EXPECT_NEAR(
        static_cast<double>(point.z()), static_cast<double>(-9.0L + t / 15.0L), pieces.error);
    }
  }
}

TEST(EdgeCurve, LinesAlongUOrVAreTheSurfacesOwnArcs)
{
  // A circle of latitude, backwards, and one of longitude, in part.
  const std::vector<std::array<double, 2>> ends{ { { 10, 80 } }, { { 170, 95 } } };
  for (const auto& [from, to] : ends)
  {
    for (const bool along_u : { false, true })
    {
      const EdgeCurve edge =
        edge_on(shapes::torus(), { along_u ? line(from, 120, to, 120) : line(120, from, 120, to) });
      const EdgePieces pieces = expect_accurate(edge, 1e-14);
      ASSERT_EQ(pieces.pieces.size(), 1u);
      EXPECT_EQ(pieces.pieces[0].degree[0], 2);
    }
  }
  const EdgeCurve meridian =
    edge_on(shapes::sphere(), { line(45, 0, 45, 90), line(45, 90, 45, 180) });
  const EdgePieces pieces = expect_accurate(meridian, 1e-14);
  ASSERT_EQ(pieces.pieces.size(), 2u);
  for (double t = 0.0; t <= 2.0; t += 0.1)
  {
    EXPECT_NEAR((meridian.centre() + meridian.point(Parameter<1>(t))).norm(), 1.0, 1e-15);
  }
}
