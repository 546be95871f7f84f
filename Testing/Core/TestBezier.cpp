// SPDX-License-Identifier: BSD-3-Clause
#include "OracleShapes.h"
#include "Shapes.h"

#include "footpoint/splines/bezier.h"

#include <gtest/gtest.h>

using footpoint::BezierPiece;
using footpoint::bounding_box;
using footpoint::Curve;
using footpoint::extract_bezier;
using footpoint::halve;
using footpoint::Side;
using footpoint::Surface;
using footpoint::Vector3;
using oracle::Real;

namespace
{

/// Bernstein polynomials of a degree at x in [0, 1], in long double.
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

/// Point of a piece at local parameters, relative to the centre.
template <int N>
oracle::Vector point(const BezierPiece<N>& piece, const std::array<Real, N>& fraction)
{
  const std::vector<Real> u = bernstein(piece.degree[0], fraction[0]);
  const std::vector<Real> v =
    N == 1 ? std::vector<Real>{ 1.0L } : bernstein(piece.degree[N - 1], fraction[N - 1]);
  Eigen::Matrix<Real, 4, 1> sum = Eigen::Matrix<Real, 4, 1>::Zero();
  for (std::size_t j = 0; j < v.size(); ++j)
  {
    for (std::size_t i = 0; i < u.size(); ++i)
    {
      sum += u[i] * v[j] * piece.control.col(j * u.size() + i).template cast<Real>();
    }
  }
  return sum.template head<3>() / sum[3];
}

/// Largest distance, relative to the size, between all pieces and the oracle's spline (both
/// relative to the centre), also at the corners where the piece's own side counts.
template <int N, class Geometry>
double extraction_error(const Geometry& geometry)
{
  const oracle::Spline<N> judge = shapes::local_spline_of(geometry);
  double worst = 0.0;
  for (const BezierPiece<N>& piece : extract_bezier(geometry))
  {
    for (int k = 0; k < (N == 1 ? 5 : 25); ++k)
    {
      std::array<Real, N> fraction;
      std::array<Real, N> t;
      std::array<bool, N> left;
      for (int i = 0; i < N; ++i)
      {
        fraction[i] = (i == 0 ? k % 5 : k / 5) / 4.0L;
        const Real lower = piece.lower[i];
        const Real upper = piece.upper[i];
        t[i] = geometry.direction(i).origin + lower + fraction[i] * (upper - lower);
        left[i] = fraction[i] == 1.0L;
      }
      const Real error = (point<N>(piece, fraction) - judge.point(t, left)).norm();
      worst = std::max(worst, static_cast<double>(error) / geometry.size());
    }
  }
  return worst;
}

} // namespace

TEST(Bezier, PiecesOfCurvesAreTheCurve)
{
  shapes::Random random(31);
  for (int degree = 1; degree <= 30; ++degree)
  {
    for (const double decades : { 0.0, 3.0, 6.0 })
    {
      const auto arrays = shapes::random_arrays<1>(random, { degree }, 5, degree % 2 == 0, decades);
      const Curve curve = arrays.geometry();
      EXPECT_LE(extraction_error<1>(curve), 1e-14) << "degree " << degree << " decades " << decades;
    }
  }
}

TEST(Bezier, PiecesOfSurfacesAreTheSurface)
{
  shapes::Random random(32);
  for (int degree = 1; degree <= 20; degree += degree < 8 ? 1 : 4)
  {
    for (const double decades : { 0.0, 3.0, 6.0 })
    {
      const auto arrays =
        shapes::random_arrays<2>(random, { degree, 21 - degree }, 2, degree % 2 == 0, decades);
      EXPECT_LE(extraction_error<2>(arrays.geometry()), 1e-14) << "degree " << degree;
    }
  }
}

TEST(Bezier, PiecesOfNamedShapes)
{
  EXPECT_LE(extraction_error<1>(shapes::circle()), 1e-15);
  EXPECT_LE(extraction_error<1>(shapes::periodic()), 1e-15);
  EXPECT_LE(extraction_error<1>(shapes::open_with_matching_poles()), 1e-15);
  EXPECT_LE(extraction_error<1>(shapes::line_with_gap()), 1e-15);
  EXPECT_LE(extraction_error<2>(shapes::torus()), 1e-15);
  EXPECT_LE(extraction_error<2>(shapes::sphere()), 1e-15);
  EXPECT_LE(extraction_error<2>(shapes::helical_ribbon()), 1e-15);
  EXPECT_LE(extraction_error<2>(shapes::bumpy(12, 33)), 1e-15);
}

TEST(Bezier, PiecesLieBetweenAllKnotLinesFirstDirectionFastest)
{
  const auto pieces = extract_bezier(shapes::torus());
  ASSERT_EQ(pieces.size(), 16u);
  for (int k = 0; k < 16; ++k)
  {
    EXPECT_EQ(pieces[k].lower, Eigen::Vector2d(90 * (k % 4), 90 * (k / 4)));
    EXPECT_EQ(pieces[k].upper, Eigen::Vector2d(90 * (k % 4 + 1), 90 * (k / 4 + 1)));
    EXPECT_EQ(pieces[k].control.cols(), 9);
  }
}

TEST(Bezier, NeighboursShareTheirBorderBitForBit)
{
  // Clamped and of multiplicity degree inside: both neighbours copy the same control point.
  const auto pieces = extract_bezier(shapes::circle());
  ASSERT_EQ(pieces.size(), 4u);
  for (int i = 0; i < 4; ++i)
  {
    EXPECT_EQ(pieces[i].control.col(2), pieces[(i + 1) % 4].control.col(0));
  }
}

TEST(Bezier, BordersAreSharedAtEveryMultiplicity)
{
  shapes::Random random(37);
  for (int round = 0; round < 60; ++round)
  {
    const std::array<int, 2> degree{ { 1 + round % 9, 1 + 7 * round % 25 } };
    auto arrays = shapes::random_arrays<2>(random, degree, 4, round % 2 == 0, 3.0);
    for (std::vector<double>& knots : arrays.knots)
    {
      std::transform(knots.begin(), knots.end(), knots.begin(),
        [](double knot) { return knot / 3.0; }); // differences are not exact
    }
    const Surface surface = arrays.geometry();
    const auto pieces = extract_bezier(surface);
    const auto& u = surface.knots(0).distinct_knots();
    const auto& v = surface.knots(1).distinct_knots();
    const std::size_t row = u.size() - 1;
    for (std::size_t k = 0; k < pieces.size(); ++k)
    {
      const int p = degree[0];
      const int q = degree[1];
      if (k % row + 1 < row && u[k % row + 1].multiplicity <= p)
      {
        for (int j = 0; j <= q; ++j)
        {
          EXPECT_EQ(pieces[k].control.col((p + 1) * j + p), pieces[k + 1].control.col((p + 1) * j));
        }
      }
      if (k + row < pieces.size() && v[k / row + 1].multiplicity <= q)
      {
        EXPECT_EQ(pieces[k].control.rightCols(p + 1), pieces[k + row].control.leftCols(p + 1));
      }
    }
  }
}

TEST(Bezier, CurvePiecesShareTheirEndsBitForBit)
{
  shapes::Random random(38);
  for (int degree = 1; degree <= 12; ++degree)
  {
    const auto arrays = shapes::random_arrays<1>(random, { degree }, 6, degree % 2 == 0, 3.0);
    const Curve curve = arrays.geometry();
    const auto pieces = extract_bezier(curve);
    const auto& knots = curve.knots().distinct_knots();
    for (std::size_t k = 0; k + 1 < pieces.size(); ++k)
    {
      if (knots[k + 1].multiplicity <= degree)
      {
        EXPECT_EQ(pieces[k].control.rightCols(1), pieces[k + 1].control.leftCols(1));
      }
    }
  }
}

TEST(Bezier, ABezierNetIsItself)
{
  shapes::Random random(34);
  auto arrays = shapes::random_arrays<2>(random, { 20, 3 }, 1, true, 3.0);
  const Surface surface = arrays.geometry();
  const auto pieces = extract_bezier(surface);
  ASSERT_EQ(pieces.size(), 1u);
  EXPECT_EQ(pieces[0].control.row(3).transpose(), surface.weights());
  for (Eigen::Index i = 0; i < pieces[0].control.cols(); ++i)
  {
    const Vector3 expected = surface.weights()[i] * surface.local_control_points().col(i);
    EXPECT_EQ(Vector3(pieces[0].control.col(i).head<3>()), expected);
  }
}

TEST(Bezier, HalvesAreTheWhole)
{
  shapes::Random random(35);
  const auto arrays = shapes::random_arrays<2>(random, { 20, 7 }, 1, false, 3.0);
  const Surface surface = arrays.geometry();
  const BezierPiece<2> whole = extract_bezier(surface).front();
  for (int direction = 0; direction < 2; ++direction)
  {
    const auto halves = halve(whole, direction);
    const double middle = 0.5 * (whole.lower[direction] + whole.upper[direction]);
    EXPECT_EQ(halves[0].lower, whole.lower);
    EXPECT_EQ(halves[1].upper, whole.upper);
    EXPECT_NEAR(halves[0].upper[direction], middle, 1e-16);
    EXPECT_EQ(halves[1].lower[direction], halves[0].upper[direction]);
    EXPECT_EQ(halves[0].upper[1 - direction], whole.upper[1 - direction]);
    EXPECT_EQ(halves[1].lower[1 - direction], whole.lower[1 - direction]);
    for (int k = 0; k < 50; ++k)
    {
      const int half = k % 2;
      const std::array<Real, 2> part{ random.uniform(0, 1), random.uniform(0, 1) };
      std::array<Real, 2> full = part;
      full[direction] = (part[direction] + half) / 2.0L;
      const Real error = (point<2>(halves[half], part) - point<2>(whole, full)).norm();
      EXPECT_LE(error, 4e-15 * surface.size());
    }
  }
}

TEST(Bezier, HalvesOfCurves)
{
  const BezierPiece<1> whole = extract_bezier(shapes::parabola()).front();
  const auto halves = halve(whole, 0);
  // x² on [−1, 0] and [0, 1]; the whole has its middle control point at (0, −1).
  const Vector3 centre = shapes::parabola().centre();
  EXPECT_EQ(Vector3(halves[0].control.col(1).head<3>()) + centre, Vector3(-0.5, 0, 0));
  EXPECT_EQ(Vector3(halves[0].control.col(2).head<3>()) + centre, Vector3(0, 0, 0));
  EXPECT_EQ(Vector3(halves[1].control.col(0).head<3>()) + centre, Vector3(0, 0, 0));
  EXPECT_EQ(Vector3(halves[1].control.col(1).head<3>()) + centre, Vector3(0.5, 0, 0));
}

TEST(Bezier, BoxesHoldTheirPieces)
{
  shapes::Random random(36);
  const auto arrays = shapes::random_arrays<2>(random, { 3, 2 }, 3, true, 3.0);
  const Surface surface = arrays.geometry();
  for (const BezierPiece<2>& piece : extract_bezier(surface))
  {
    const auto box = bounding_box(piece);
    const double slack = 1e-15 * surface.size();
    for (int k = 0; k < 100; ++k)
    {
      const Vector3 inside =
        point<2>(piece, { random.uniform(0, 1), random.uniform(0, 1) }).cast<double>();
      EXPECT_TRUE(((inside - box[0]).array() >= -slack).all());
      EXPECT_TRUE(((box[1] - inside).array() >= -slack).all());
    }
  }
}

TEST(Bezier, BoxesAreThoseOfTheControlPoints)
{
  // Weights must be divided out: corners (0, 0, 0) and (1, 2, 3) with weights 1 and 4.
  BezierPiece<1> piece;
  piece.degree = { 1 };
  piece.control.resize(4, 2);
  piece.control << 0, 4, 0, -8, 0, 12, 1, 4;
  const auto box = bounding_box(piece);
  EXPECT_EQ(box[0], Vector3(0, -2, 0));
  EXPECT_EQ(box[1], Vector3(1, 0, 3));
}
