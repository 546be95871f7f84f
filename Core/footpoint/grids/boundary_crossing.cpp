// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/grids/boundary_crossing.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace footpoint
{

namespace
{

using Point2 = Eigen::Vector2d;

constexpr double kPlanar = 1e-9;
constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

/// Consecutive different points of the loop in a plane of two coordinates (dropping the third is an
/// affine map of the loop's plane and adds no rounding); empty where the loop is not planar.
std::vector<Point2> flatten(const Points& loop)
{
  const Vector3 middle = loop.rowwise().mean();
  const Points local = loop.colwise() - middle;
  const double size = local.colwise().norm().maxCoeff();
  if (!(size > 0.0))
  {
    return {};
  }
  const Points unit = local / size;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(unit * unit.transpose());
  const Vector3 normal = axes.eigenvectors().col(0);
  const double rounding = 4.0 * kEpsilon * loop.cwiseAbs().maxCoeff() / size;
  if ((normal.transpose() * unit).cwiseAbs().maxCoeff() > std::max(kPlanar, rounding))
  {
    return {};
  }
  Eigen::Index dropped = 0;
  normal.cwiseAbs().maxCoeff(&dropped);
  std::vector<Point2> flat;
  for (Eigen::Index i = 0; i < loop.cols(); ++i)
  {
    const Point2 point(local((dropped + 1) % 3, i), local((dropped + 2) % 3, i));
    if (flat.empty() || point != flat.back())
    {
      flat.push_back(point);
    }
  }
  while (flat.size() > 1 && flat.back() == flat.front())
  {
    flat.pop_back();
  }
  return flat;
}

/// Which side of the line through `from` and `to` a point is on, 0 where rounding decides.
int side(const Point2& from, const Point2& to, const Point2& point)
{
  const Point2 along = to - from;
  const Point2 towards = point - from;
  const double first = along.x() * towards.y();
  const double second = along.y() * towards.x();
  const double noise = 8.0 * kEpsilon * (std::abs(first) + std::abs(second));
  const double area = first - second;
  return area > noise ? 1 : (area < -noise ? -1 : 0);
}

/// Counter-clockwise angle in [0, 2π) from one direction to another.
double angle(const Point2& from, const Point2& to)
{
  const double turn = std::atan2(from.x() * to.y() - from.y() * to.x(), from.dot(to));
  return turn < 0.0 ? turn + 2.0 * M_PI : turn;
}

/// A closed polyline of different consecutive points.
class Loop
{
public:
  explicit Loop(std::vector<Point2> points)
    : Corners(std::move(points))
  {
  }

  std::size_t count() const { return this->Corners.size(); }
  /// \param i may exceed the count by less than itself
  const Point2& point(std::size_t i) const { return this->Corners[i % this->Corners.size()]; }

  /// Whether the segments i and j, or the ends of them, are places where the loop passes through
  /// itself.
  bool crossing(std::size_t i, std::size_t j) const
  {
    const Point2& a0 = this->point(i);
    const Point2& a1 = this->point(i + 1);
    const Point2& b0 = this->point(j);
    const Point2& b1 = this->point(j + 1);
    if (a1 == b1)
    {
      return this->passes_at_point(i + 1, j + 1);
    }
    const int b0_of_a = side(a0, a1, b0);
    const int b1_of_a = side(a0, a1, b1);
    const int a0_of_b = side(b0, b1, a0);
    const int a1_of_b = side(b0, b1, a1);
    if (b0_of_a * b1_of_a < 0 && a0_of_b * a1_of_b < 0)
    {
      return true;
    }
    // A segment may end on the other; the next one then goes on to the other side, or not.
    if (a1_of_b == 0 && b0_of_a * b1_of_a < 0)
    {
      return a0_of_b * side(b0, b1, this->point(i + 2)) < 0;
    }
    if (b1_of_a == 0 && a0_of_b * a1_of_b < 0)
    {
      return b0_of_a * side(a0, a1, this->point(j + 2)) < 0;
    }
    return false;
  }

private:
  /// Two strands share a point: they pass through each other where one leaves on either side of the
  /// other.
  bool passes_at_point(std::size_t i, std::size_t j) const
  {
    const std::size_t n = this->count();
    const Point2& centre = this->point(i);
    const Point2 start = this->point(i + n - 1) - centre;
    const double end = angle(start, this->point(i + 1) - centre);
    const double first = angle(start, this->point(j + n - 1) - centre);
    const double second = angle(start, this->point(j + 1) - centre);
    constexpr double kSameDirection = 1e-12;
    for (const double other : { first, second })
    {
      if (other < kSameDirection || other > 2.0 * M_PI - kSameDirection ||
        std::abs(other - end) < kSameDirection)
      {
        return false;
      }
    }
    return (first < end) != (second < end);
  }

  std::vector<Point2> Corners;
};

} // namespace

bool crosses_itself(const Points& points)
{
  const Loop loop(flatten(points));
  const std::size_t n = loop.count();
  if (n < 4)
  {
    return false;
  }

  // === Compare segments whose boxes overlap, by a sweep along x
  const auto low = [&](std::size_t i) { return loop.point(i).cwiseMin(loop.point(i + 1)).eval(); };
  const auto high = [&](std::size_t i) { return loop.point(i).cwiseMax(loop.point(i + 1)).eval(); };
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::sort(order.begin(), order.end(),
    [&](std::size_t a, std::size_t b) { return low(a).x() < low(b).x(); });
  for (std::size_t a = 0; a < n; ++a)
  {
    const std::size_t i = order[a];
    for (std::size_t b = a + 1; b < n && low(order[b]).x() <= high(i).x(); ++b)
    {
      const std::size_t j = order[b];
      const bool neighbours = (i + 1) % n == j || (j + 1) % n == i;
      if (!neighbours && low(j).y() <= high(i).y() && low(i).y() <= high(j).y() &&
        loop.crossing(i, j))
      {
        return true;
      }
    }
  }
  return false;
}

} // namespace footpoint
