// SPDX-License-Identifier: BSD-3-Clause
#include "Oracle.h"
#include "TrimFaces.h"
#include "TrimShapes.h"

#include "footpoint/trims/edge_curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

using footpoint::BezierPiece;
using footpoint::edge_pieces;
using footpoint::EdgeArcs;
using footpoint::EdgeCurve;
using footpoint::EdgePieces;
using footpoint::Jet;
using footpoint::KnotVector;
using footpoint::Parameter;
using footpoint::Points;
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

/// S(c(t)) in long double, in local parameters and relative to the surface's centre.
class Judge
{
public:
  explicit Judge(const EdgeCurve& edge)
    : Edge(edge)
    , Spline({ { edge.surface().knots(0).degree(), edge.surface().knots(1).degree() } },
        { { edge.surface().knots(0).local_knots(), edge.surface().knots(1).local_knots() } },
        edge.surface().local_control_points(), edge.surface().weights())
  {
  }

  /// \param fraction of an arc; may leave [0, 1] a little, the pieces are continued
  oracle::Vector at(std::size_t arc, Real fraction) const
  {
    const TrimArc& of = this->Edge.arcs()[arc];
    const Homogeneous3 middle = bezier_sum<3>(of.control, 0.5L);
    const Homogeneous3 sum = bezier_sum<3>(of.control, fraction);
    std::array<int, 2> spans;
    std::array<Real, 2> t;
    for (int i = 0; i < 2; ++i)
    {
      // An arc on the last line of the domain belongs to the span below.
      spans[i] = this->Spline.span(i, middle[i] / middle[2], false);
      t[i] = sum[i] / sum[2];
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

// === Any surface, any arc

namespace
{

/// An arc that is monotone in both directions, from one corner of a rectangle to another.
TrimArc monotone_arc(shapes::Random& random, int degree, const std::array<double, 2>& lower,
  const std::array<double, 2>& upper, double decades)
{
  Eigen::Matrix2Xd points(2, degree + 1);
  Eigen::VectorXd weights(degree + 1);
  for (int i = 0; i < 2; ++i)
  {
    std::vector<double> at;
    for (int j = 0; j <= degree; ++j)
    {
      at.push_back(random.uniform(lower[i], upper[i]));
    }
    std::sort(at.begin(), at.end());
    if (random.integer(0, 1) == 0)
    {
      std::reverse(at.begin(), at.end());
    }
    points.row(i) = Eigen::Map<Eigen::RowVectorXd>(at.data(), degree + 1);
  }
  for (double& w : weights)
  {
    w = decades > 0.0 ? random.magnitude(decades) : 1.0;
  }
  return arc_of(points, weights);
}

/// Some arcs in a random cell of a surface.
EdgeCurve random_edge(
  shapes::Random& random, const Surface& surface, int degree, double decades, double part = 1.0)
{
  std::array<double, 2> lower;
  std::array<double, 2> upper;
  for (int i = 0; i < 2; ++i)
  {
    const std::vector<double>& spans = surface.direction(i).spans;
    const int k = random.integer(0, static_cast<int>(spans.size()) - 2);
    lower[i] = spans[k];
    upper[i] = spans[k] + part * (spans[k + 1] - spans[k]);
  }
  return edge_on(surface, { monotone_arc(random, degree, lower, upper, decades) });
}

/// A derivative of S(c(t)) on the first arc by extrapolated central differences in long double.
oracle::Vector difference(const Judge& judge, Real t, Real length, int order)
{
  static const std::array<std::vector<Real>, 4> stencils{ { { 0, 1, 0 }, { -0.5L, 0, 0.5L },
    { 1, -2, 1 }, { -0.5L, 1, 0, -1, 0.5L } } };
  const std::vector<Real>& stencil = stencils[order];
  const auto half = static_cast<int>(stencil.size() / 2);
  const auto central = [&](Real h)
  {
    oracle::Vector sum = oracle::Vector::Zero();
    for (int k = -half; k <= half; ++k)
    {
      sum += stencil[k + half] / std::pow(h, static_cast<Real>(order)) *
        judge.at_parameter(t + static_cast<Real>(k) * h, 0);
    }
    return sum;
  };
  return oracle::extrapolated(central, 0.01L * length);
}

/// Derivatives against long double differences of S(c(t)), continued beyond the arc's ends; as
/// fractions of what the edge's size and the arc's length let expect.
void expect_derivatives(const EdgeCurve& edge, double relative)
{
  const Judge judge(edge);
  const double length = edge.direction(0).length;
  for (const double t : { 0.0, 0.3 * length, length })
  {
    const Side side = t == length ? Side::Left : Side::Right;
    const Jet<1> jet = edge.jet(Parameter<1>(t), Sides<1>(side), 3);
    const std::array<Vector3, 4> found{ { jet.point, jet.first, jet.second, jet.third } };
    for (int order = 0; order <= 3; ++order)
    {
      const oracle::Vector expected = difference(judge, t, length, order);
      const double scale =
        std::max(found[order].norm(), edge.size() / std::pow(length, static_cast<double>(order)));
      EXPECT_LE(static_cast<double>((found[order].cast<Real>() - expected).norm()),
        (order == 0 ? 1e-14 * edge.surface().size() : relative * scale))
        << "order " << order << " at " << t;
    }
  }
}

} // namespace

TEST(EdgeCurve, PiecesOfAnyEdgeKeepTheirBound)
{
  shapes::Random random(71);
  for (int p = 1; p <= 6; ++p)
  {
    for (int q = 1; q <= 6; ++q)
    {
      for (const double decades : { 0.0, 0.5, 2.0 })
      {
        const int degree = 1 + (p + q) % 5;
        const auto arrays = shapes::random_arrays<2>(random, { p, q }, 2, q % 2 == 0, decades);
        const double of_arc = p % 2 == 0 ? decades : 0.0;
        SCOPED_TRACE(testing::Message() << p << " x " << q << ", arc " << degree << ", weights "
                                        << decades << ", of the arc " << of_arc);
        expect_accurate(random_edge(random, arrays.geometry(), degree, of_arc));
      }
    }
  }
}

TEST(EdgeCurve, LooserTolerancesTakeFewerPieces)
{
  shapes::Random random(72);
  const auto arrays = shapes::random_arrays<2>(random, { 4, 5 }, 2, true, 1.0);
  const EdgeCurve edge = random_edge(random, arrays.geometry(), 4, 1.0);
  std::size_t before = expect_accurate(edge, 1e-13).pieces.size();
  for (const double relative : { 1e-10, 1e-7, 1e-4 })
  {
    const std::size_t count = expect_accurate(edge, relative).pieces.size();
    EXPECT_LT(count, before);
    before = count;
  }
  // More than rounding allows cannot be had: that is said, and work stays within bounds.
  const EdgePieces finest = edge_pieces(edge, 0.0);
  EXPECT_GT(finest.error, 0.0);
  EXPECT_LE(finest.error, 1e-13 * edge.surface().size());
  EXPECT_LE(largest_error(edge, finest), finest.error);
}

TEST(EdgeCurve, LooseBoundsHoldWithUnevenWeights)
{
  // Few terms, and a slow decay: here the sum of those that are left out is no bound.
  shapes::Random random(75);
  for (int k = 0; k < 300; ++k)
  {
    const int degree = random.integer(1, 3);
    const auto arrays = shapes::random_arrays<2>(random, { degree, 1 }, 1, true, 3.0);
    const EdgeCurve edge = random_edge(random, arrays.geometry(), 5, 3.0);
    for (const double relative : { 0.3, 3e-2, 1e-3 })
    {
      const EdgePieces pieces = edge_pieces(edge, relative * edge.surface().size());
      EXPECT_LE(largest_error(edge, pieces, 100), pieces.error) << "edge " << k << ", " << relative;
    }
  }
}

TEST(EdgeCurve, PiecesAtAnyScale)
{
  shapes::Random random(73);
  for (const double scale : { 1e-6, 1.0, 1e6 })
  {
    for (const double offset : { 0.0, 1e6 })
    {
      for (const double start : { 0.0, 1e6 })
      {
        Points net(3, 36);
        for (Eigen::Index i = 0; i < net.cols(); ++i)
        {
          net.col(i) = Vector3::Constant(offset) + scale * random.vector(-1.0, 1.0);
        }
        const std::vector<double> knots = shapes::clamped_knots(3, 3, start, start + 1.0);
        const Surface surface(KnotVector(3, knots, "KnotsU"), KnotVector(3, knots, "KnotsV"), net);
        SCOPED_TRACE(
          testing::Message() << "scale " << scale << " offset " << offset << " start " << start);
        const EdgeCurve edge = random_edge(random, surface, 3, 1.0);
        expect_accurate(edge);
        expect_derivatives(edge, 1e-7);
        expect_accurate(random_edge(random, surface, 3, 0.0, 1e-6)); // a short one
      }
    }
  }
}

TEST(EdgeCurve, DerivativesAreThoseOfTheComposedCurve)
{
  shapes::Random random(74);
  for (int p = 1; p <= 6; ++p)
  {
    for (const double decades : { 0.0, 0.5 })
    {
      const auto arrays = shapes::random_arrays<2>(random, { p, 7 - p }, 2, true, decades);
      SCOPED_TRACE(testing::Message() << p << " x " << 7 - p << ", weights " << decades);
      expect_derivatives(random_edge(random, arrays.geometry(), 1 + p % 5, decades), 1e-7);
    }
  }
}

// === Joints, sides, ends

TEST(EdgeCurve, BreaksAreKinksOfTheTrimCurveAndOfTheSurface)
{
  // A corner in (u, v) on a plane, then a smooth joint.
  const EdgeCurve corner = edge_on(
    shapes::square(), { line(1, 1, 5, 1, 0, 4), line(5, 1, 5, 5, 4, 8), line(5, 5, 5, 9, 8, 12) });
  ASSERT_EQ(corner.direction(0).breaks.size(), 3u);
  EXPECT_EQ(corner.direction(0).breaks[1].at, 4.0);
  EXPECT_FALSE(corner.direction(0).breaks[1].gap);
  EXPECT_EQ(corner.direction(0).spans, (std::vector<double>{ 0, 4, 8, 12 }));
  EXPECT_FALSE(corner.direction(0).closed);
  const Jet<1> before = corner.jet(Parameter<1>(4.0), Sides<1>(Side::Left), 1);
  const Jet<1> after = corner.jet(Parameter<1>(4.0), Sides<1>(Side::Right), 1);
  EXPECT_EQ(before.point, after.point);
  EXPECT_LE((before.first - Vector3(0, 1, 0)).norm(), 1e-15);
  EXPECT_LE((after.first - Vector3(0, 0, 1)).norm(), 1e-15);

  // A roof, straight in (u, v): z = |u − 1| has its ridge at u = 1; then the same with a step.
  for (const bool gap : { false, true })
  {
    const std::vector<double> knots =
      gap ? std::vector<double>{ 0, 0, 1, 1, 2, 2 } : std::vector<double>{ 0, 0, 1, 2, 2 };
    const int nu = gap ? 4 : 3;
    Points net(3, 2 * nu);
    for (int j = 0; j < 2; ++j)
    {
      net.col(j * nu) << 0, j, 1;
      net.col(j * nu + 1) << 1, j, 0;
      net.col(j * nu + 2) << 1, j, 3; // of the gap only
      net.col(j * nu + nu - 1) << 2, j, 1;
    }
    const Surface roof(
      KnotVector(1, knots, "KnotsU"), KnotVector(1, { 0, 0, 1, 1 }, "KnotsV"), net);
    const EdgeCurve over =
      edge_on(roof, { line(0, 0.2, 1, 0.4, 0, 1), line(1, 0.4, 2, 0.6, 1, 2) });
    ASSERT_EQ(over.direction(0).breaks.size(), 3u);
    EXPECT_EQ(over.direction(0).breaks[1].at, 1.0);
    EXPECT_EQ(over.direction(0).breaks[1].gap, gap);
    const auto height = [&](Side side)
    { return over.centre().z() + over.jet(Parameter<1>(1.0), Sides<1>(side), 0).point.z(); };
    EXPECT_EQ(height(Side::Left), 0.0);
    EXPECT_EQ(height(Side::Right), gap ? 3.0 : 0.0);
    const Jet<1> up = over.jet(Parameter<1>(1.0), Sides<1>(Side::Left), 1);
    EXPECT_LE((up.first - Vector3(1, 0.2, -1)).norm(), 1e-15);
    const EdgePieces pieces = edge_pieces(over, 1e-13);
    EXPECT_EQ(pieces.pieces.size(), 2u);
    EXPECT_LE(largest_error(over, pieces), pieces.error);
  }
}

TEST(EdgeCurve, RoundingOfAnArcsEndStaysOnItsSideOfAKink)
{
  // The arc ends one rounding beyond the ridge at u = 1, where another slope begins.
  const Surface roof(KnotVector(1, { 0, 0, 1, 2, 2 }, "KnotsU"),
    KnotVector(1, { 0, 0, 1, 1 }, "KnotsV"),
    shapes::points(
      { { 0, 0, 1 }, { 1, 0, 0 }, { 2, 0, 1 }, { 0, 1, 1 }, { 1, 1, 0 }, { 2, 1, 1 } }));
  const EdgeCurve edge = edge_on(roof, { line(0, 0.5, 1 + 0x1p-52, 0.5) });
  for (const Side side : { Side::Left, Side::Right })
  {
    const Jet<1> jet = edge.jet(Parameter<1>(1.0), Sides<1>(side), 1);
    EXPECT_LE((jet.first - Vector3(1, 0, -1)).norm(), 1e-15);
  }
  EXPECT_EQ(edge.surface_parameter(1.0)[0], 1.0);
  EXPECT_LE(largest_error(edge, edge_pieces(edge, 1e-13)), 1e-15);
}

TEST(EdgeCurve, TellsWhereOnTheSurfaceItIs)
{
  const EdgeCurve edge =
    edge_on(shapes::square(), { line(1, 2, 3, 4, 5, 7), line(3, 4, 3, 10 + 1e-9, 7, 8) });
  EXPECT_EQ(edge.direction(0).length, 3.0);
  EXPECT_EQ(edge.surface_parameter(0.0), Eigen::Vector2d(1, 2));
  EXPECT_EQ(edge.surface_parameter(1.0), Eigen::Vector2d(2, 3));
  EXPECT_EQ(edge.surface_parameter(2.0, Side::Left), Eigen::Vector2d(3, 4));
  EXPECT_EQ(edge.surface_parameter(2.0, Side::Right), Eigen::Vector2d(3, 4));
  EXPECT_EQ(edge.surface_parameter(3.0), Eigen::Vector2d(3, 10)) << "clamped into the domain";
  EXPECT_EQ(edge.centre(), edge.surface().centre());
  EXPECT_NEAR(edge.size(), std::hypot(2.0, 8.0), 1e-8);
}

TEST(EdgeCurve, AnArcShorterThanTheRoundingOfItsParameterIsKept)
{
  const EdgeCurve edge = edge_on(shapes::square(),
    { line(1, 1, 2, 1, 0, 1), line(2, 1, 3, 2, 1, 1 + 1e-17), line(3, 2, 4, 4, 1, 2) });
  ASSERT_EQ(edge.direction(0).spans.size(), 4u);
  EXPECT_LT(edge.direction(0).spans[1], edge.direction(0).spans[2]);
  TrimArc short_arc = line(2, 1, 3, 2);
  short_arc.range = { { 4e10, 4e10 + 1e-5 } }; // 1.3 roundings
  const EdgeCurve far =
    edge_on(shapes::square(), { line(1, 1, 2, 1, 0, 4e10), short_arc, line(3, 2, 4, 4, 0, 1) });
  const std::vector<double>& spans = far.direction(0).spans;
  EXPECT_LT(spans[1], spans[2]);
  EXPECT_EQ(far.surface_parameter(spans[1]), Eigen::Vector2d(2, 1));
  EXPECT_EQ(far.surface_parameter(spans[2]), Eigen::Vector2d(3, 2));
}

TEST(EdgeCurve, RefusesWhatIsNoCurve)
{
  EXPECT_THROW(edge_on(shapes::square(), {}), footpoint::GeometryError);
  EXPECT_THROW(edge_on(shapes::triangle(), { line(0, 0, 0, 1) }), footpoint::GeometryError);
}

/// x = u (u − ¼) (u − ½) (u − ¾) (u − 1) along an edge of the strip: it passes through its start at
/// every quarter of its parameter.
TEST(EdgeCurve, AnEdgeThatReturnsToItsStartHasASize)
{
  Points points = Points::Zero(3, 12);
  const double quintic[6] = { 0.0, 0.01875, -0.040625, 0.040625, -0.01875, 0.0 };
  for (int k = 0; k < 12; ++k)
  {
    points(0, k) = quintic[k % 6];
    points(1, k) = k / 6;
  }
  const Surface strip(KnotVector(5, { 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1 }),
    KnotVector(1, { 0, 0, 1, 1 }), points);
  const EdgeCurve edge = edge_on(strip, { line(0, 0, 1, 0) });
  const Vector3 start = edge.point(Parameter<1>(0.0));
  for (const double t : { 0.25, 0.5, 0.75, 1.0 })
  {
    EXPECT_LE((edge.point(Parameter<1>(t)) - start).norm(), 1e-16);
  }
  EXPECT_NEAR(edge.size(), 0.0071, 5e-4);
}

TEST(EdgeCurve, AGapIsAnArcOfLengthOne)
{
  TrimArc gap = line(2, 2, 2.5, 2.25, 7.0, 7.0);
  gap.closes_gap = true;
  const EdgeCurve edge = edge_on(shapes::square(), { gap });
  EXPECT_EQ(edge.direction(0).length, 1.0);
  EXPECT_EQ(edge.surface_parameter(0.5), Eigen::Vector2d(2.25, 2.125));
}

// === Edges of faces

namespace
{

using EdgePointers = std::vector<std::shared_ptr<const EdgeCurve>>;

EdgePointers edges_of(const Surface& surface, const std::vector<footpoint::TrimLoop>& loops,
  EdgeArcs which = EdgeArcs::NoSeams)
{
  const auto shared = std::make_shared<const Surface>(surface);
  return edge_curves(shared, footpoint::TrimRegion(loops, surface, 0.0), which);
}

} // namespace

TEST(EdgeCurve, AFaceHasAnEdgeForEachCurve)
{
  const EdgePointers edges = edges_of(
    shapes::square(), { trims::rectangle(1, 1, 9, 8), trims::reversed(trims::circle(4, 4, 2)) });
  ASSERT_EQ(edges.size(), 5u);
  EXPECT_TRUE(edges[4]->direction(0).closed);
  EXPECT_NEAR(edges[0]->size(), 8.0, 1e-14);
  for (const auto& edge : edges)
  {
    EXPECT_EQ(edge->direction(0).breaks.size(), 2u);
    expect_accurate(*edge, 1e-14);
  }
}

TEST(EdgeCurve, EdgesThatAreOnePointAreLeftOut)
{
  // Of three quarters of a sphere both poles drop out, the meridians remain.
  const EdgePointers edges = edges_of(shapes::sphere(), { trims::rectangle(0, -90, 270, 90) });
  ASSERT_EQ(edges.size(), 2u);
  for (const auto& edge : edges)
  {
    EXPECT_EQ(edge->arcs().size(), 2u);
    EXPECT_EQ(edge->direction(0).breaks.size(), 2u) << "a meridian has no kink";
    expect_accurate(*edge, 1e-14);
  }
}

TEST(EdgeCurve, SeamsAndBordersOfTheDomainAreNoEdgesOfTheirOwn)
{
  // All of a sphere: over the seam the face goes on.
  EXPECT_TRUE(edges_of(shapes::sphere(), { trims::rectangle(0, -90, 360, 90) }).empty());
  // On three sides the square itself ends.
  const std::vector<footpoint::TrimLoop> loops{ trims::rectangle(0, 0, 10, 8) };
  EXPECT_EQ(edges_of(shapes::square(), loops).size(), 4u);
  const EdgePointers inside = edges_of(shapes::square(), loops, EdgeArcs::InsideDomain);
  ASSERT_EQ(inside.size(), 1u);
  EXPECT_EQ(inside[0]->surface_parameter(0.0), Eigen::Vector2d(10, 8));
  EXPECT_EQ(inside[0]->surface_parameter(1.0), Eigen::Vector2d(0, 8));
}

TEST(EdgeCurve, CurvesThatLeaveTheDomainAreCut)
{
  // A circle over the side u = 0 of the domain: one half of it lies inside.
  const EdgePointers edges = edges_of(shapes::square(), { trims::circle(0, 5, 2) });
  double length = 0.0;
  for (const auto& edge : edges)
  {
    for (const TrimArc& arc : edge->arcs())
    {
      EXPECT_TRUE(arc.inside_domain);
    }
    length += edge->direction(0).length;
  }
  EXPECT_DOUBLE_EQ(length, 2.0) << "two of the four arcs";
}

// === Real faces

TEST(EdgeCurve, EdgesOfRealFaces)
{
  int edges = 0;
  int arcs = 0;
  int pieces = 0;
  double worst = 0.0;
  for (const trims::RealFace& face : trims::real_faces())
  {
    SCOPED_TRACE(face.name);
    const double size = face.surface->size();
    const footpoint::TrimRegion region(face.loops, *face.surface, 0.0);
    for (const auto& edge : edge_curves(face.surface, region, EdgeArcs::NoSeams))
    {
      const EdgePieces found = edge_pieces(*edge, 1e-13 * size);
      const double error = largest_error(*edge, found, 6);
      EXPECT_LE(error, found.error);
      EXPECT_LE(found.error, 1e-13 * size);
      expect_chain(*edge, found, 1e-14 * size);
      worst = std::max(worst, error / size);
      ++edges;
      arcs += static_cast<int>(edge->arcs().size());
      pieces += static_cast<int>(found.pieces.size());
    }
  }
  if (edges == 0)
  {
    GTEST_SKIP() << "FOOTPOINT_SHARED_DATA names no folder with json/*.jsonl";
  }
  RecordProperty("edges", edges);
  RecordProperty("pieces", pieces);
  RecordProperty("error", std::to_string(worst));
  EXPECT_GT(edges, 1000);
  EXPECT_LE(pieces, 1.1 * arcs) << "nearly every arc of a real face is one piece";
}
