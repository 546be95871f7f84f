// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// What the judge of nearest points descends with: one span as a Bézier piece, in double for speed
/// or in long double, and a damped Newton iteration in its box.

#include "Oracle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace oracle
{

/// Values and first and second derivatives of the Bernstein polynomials of a degree.
template <class T>
struct Bernstein
{
  static constexpr int kMost = 32;
  std::array<std::array<T, kMost>, 3> rows; ///< rows[k][i]: k-th derivative of B_i

  Bernstein(int degree, T t)
  {
    this->rows[1].fill(T(0));
    this->rows[2].fill(T(0));
    std::array<T, kMost>& values = this->rows[0];
    values.fill(T(0));
    values[0] = T(1);
    const auto lower = [&](int i) { return i < 0 ? T(0) : values[i]; };
    for (int p = 1; p <= degree; ++p)
    {
      for (int i = 0; i <= degree && p == degree - 1; ++i)
      {
        this->rows[2][i] =
          T(degree * (degree - 1)) * (lower(i - 2) - T(2) * lower(i - 1) + lower(i));
      }
      for (int i = 0; i <= degree && p == degree; ++i)
      {
        this->rows[1][i] = T(degree) * (lower(i - 1) - lower(i));
      }
      for (int i = p; i >= 0; --i)
      {
        values[i] = (T(1) - t) * values[i] + t * lower(i - 1);
      }
    }
  }
};

/// A rational Bézier piece over [0, 1]²; curves have degree 0 in the second direction.
template <class T>
class Piece
{
public:
  using Place = std::array<T, 2>;
  using Point = Eigen::Matrix<T, 3, 1>;
  using Homogeneous = Eigen::Matrix<T, 4, 1>;

  /// S, S_u, S_v, S_uu, S_uv, S_vv
  using Jet = std::array<Point, 6>;

  Piece() = default;
  /// \param net first direction fastest
  Piece(const std::array<int, 2>& degrees, const Eigen::Matrix<Real, 4, Eigen::Dynamic>& net)
    : Degrees(degrees)
    , Net(net.cast<T>())
  {
  }

  int degree(int i) const { return this->Degrees[i]; }

  Point point(const Place& place) const { return this->jet(place, 0)[0]; }

  Jet jet(const Place& place, int order = 2) const
  {
    const Bernstein<T> u(this->Degrees[0], place[0]);
    const Bernstein<T> v(this->Degrees[1], place[1]);
    std::array<Homogeneous, 6> sum;
    sum.fill(Homogeneous::Zero());
    for (int j = 0; j <= this->Degrees[1]; ++j)
    {
      std::array<Homogeneous, 3> row;
      row.fill(Homogeneous::Zero());
      for (int i = 0; i <= this->Degrees[0]; ++i)
      {
        const auto pole = this->Net.col(j * (this->Degrees[0] + 1) + i);
        for (int k = 0; k <= order; ++k)
        {
          row[k] += u.rows[k][i] * pole;
        }
      }
      sum[0] += v.rows[0][j] * row[0];
      if (order > 0)
      {
        sum[1] += v.rows[0][j] * row[1];
        sum[2] += v.rows[1][j] * row[0];
        sum[3] += v.rows[0][j] * row[2];
        sum[4] += v.rows[1][j] * row[1];
        sum[5] += v.rows[2][j] * row[0];
      }
    }
    // Quotient rule, from X = w S.
    std::array<T, 6> w;
    Jet jet;
    for (int k = 0; k < 6; ++k)
    {
      w[k] = sum[k][3] / sum[0][3];
      jet[k] = sum[k].template head<3>() / sum[0][3];
    }
    jet[1] -= w[1] * jet[0];
    jet[2] -= w[2] * jet[0];
    jet[3] -= T(2) * w[1] * jet[1] + w[3] * jet[0];
    jet[4] -= w[1] * jet[2] + w[2] * jet[1] + w[4] * jet[0];
    jet[5] -= T(2) * w[2] * jet[2] + w[5] * jet[0];
    return jet;
  }

  /// All points of a grid, first direction fastest.
  Eigen::Matrix<T, 3, Eigen::Dynamic> grid(const std::array<std::vector<T>, 2>& places) const
  {
    const Eigen::Index columns = static_cast<Eigen::Index>(places[0].size());
    std::array<Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>, 2> basis;
    for (int i = 0; i < 2; ++i)
    {
      basis[i].resize(static_cast<Eigen::Index>(places[i].size()), this->Degrees[i] + 1);
      for (Eigen::Index k = 0; k < basis[i].rows(); ++k)
      {
        const Bernstein<T> values(this->Degrees[i], places[i][k]);
        for (int j = 0; j <= this->Degrees[i]; ++j)
        {
          basis[i](k, j) = values.rows[0][j];
        }
      }
    }
    Eigen::Matrix<T, 4, Eigen::Dynamic> sums(4, columns * basis[1].rows());
    for (int c = 0; c < 4; ++c)
    {
      const Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic> net =
        this->Net.row(c).reshaped(this->Degrees[0] + 1, this->Degrees[1] + 1);
      const Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic> all =
        basis[0] * net * basis[1].transpose();
      sums.row(c) = all.reshaped().transpose();
    }
    return sums.template topRows<3>().array().rowwise() / sums.row(3).array();
  }

private:
  std::array<int, 2> Degrees{};
  Eigen::Matrix<T, 4, Eigen::Dynamic> Net;
};

/// Minimises the distance from a piece to a point inside the piece's box, by a Newton iteration
/// with the curvature made positive, step control, and the sides as active constraints.
template <class T>
class Descent
{
public:
  using Place = typename Piece<T>::Place;
  using Point = typename Piece<T>::Point;

  Descent(const Piece<T>& piece, const Point& query)
    : Geometry(piece)
    , Query(query)
  {
  }

  /// \return where it ends, and the distance there
  std::pair<Place, T> operator()(Place place, int iterations, bool probing) const
  {
    Point at = this->Geometry.point(place);
    for (int restart = 0; restart < 4; ++restart)
    {
      this->descend(place, at, iterations);
      if (!probing || !this->probe(place, at))
      {
        break;
      }
    }
    return { place, (at - this->Query).norm() };
  }

private:
  /// Change of the squared distance, without cancellation.
  T change(const Point& from, const Point& to) const
  {
    return (to - from).dot((to - this->Query) + (from - this->Query));
  }

  bool move(Place& place, Point& at, const Place& step, T factor) const
  {
    Place trial;
    for (int i = 0; i < 2; ++i)
    {
      trial[i] = std::min(std::max(place[i] + factor * step[i], T(0)), T(1));
    }
    if (trial == place)
    {
      return false;
    }
    const Point there = this->Geometry.point(trial);
    if (!(this->change(at, there) < T(0)))
    {
      return false;
    }
    place = trial;
    at = there;
    return true;
  }

  void descend(Place& place, Point& at, int iterations) const
  {
    const T least = T(2) * std::numeric_limits<T>::epsilon();
    T damping = T(0);
    for (int iteration = 0; iteration < iterations; ++iteration)
    {
      const Model model = this->model(place);
      const Place before = place;
      bool moved = this->move(place, at, model.step(damping), T(1));
      while (!moved && damping < T(1e8))
      {
        damping = std::max(T(10) * damping, T(1e-8));
        moved = this->move(place, at, model.step(damping), T(1));
      }
      const T length = std::max(std::abs(place[0] - before[0]), std::abs(place[1] - before[1]));
      if (!moved || (length < least && damping == T(0)))
      {
        return;
      }
      damping = damping > T(1e-7) ? damping / T(30) : T(0);
    }
  }

  /// The squared distance about a place to second order, with the directions scaled to equal
  /// speeds, in the frame of the eigenvectors of its curvature.
  struct Model
  {
    std::array<T, 2> scale; ///< 0: the direction is stuck at a side, or stands still
    T x, y;                 ///< first eigenvector; the second is (−y, x)
    std::array<T, 2> gradient;
    std::array<T, 2> curvature; ///< made positive

    /// The minimum with a damping added to the curvature (Levenberg 1944): in bent valleys it
    /// shortens steps along them first.
    Place step(T damping) const
    {
      const T first = this->gradient[0] / (this->curvature[0] + damping);
      const T second = this->gradient[1] / (this->curvature[1] + damping);
      const Place step{ { -this->scale[0] * (this->x * first - this->y * second),
        -this->scale[1] * (this->y * first + this->x * second) } };
      const T longest = std::max(std::abs(step[0]), std::abs(step[1]));
      const T factor = longest > T(0.3) ? T(0.3) / longest : T(1);
      return { { factor * step[0], factor * step[1] } };
    }
  };

  Model model(const Place& place) const
  {
    const typename Piece<T>::Jet jet = this->Geometry.jet(place);
    const Point r = jet[0] - this->Query;
    Model model;
    std::array<T, 2> gradient;
    std::array<T, 2>& scale = model.scale;
    for (int i = 0; i < 2; ++i)
    {
      const T speed = jet[1 + i].norm();
      gradient[i] = r.dot(jet[1 + i]);
      const bool stuck = (place[i] <= T(0) && gradient[i] > T(0)) ||
        (place[i] >= T(1) && gradient[i] < T(0)) || !(speed > T(1e-30)) ||
        this->Geometry.degree(i) == 0;
      scale[i] = stuck ? T(0) : T(1) / speed;
      gradient[i] *= scale[i];
    }
    const T a = scale[0] > T(0) ? T(1) + scale[0] * scale[0] * r.dot(jet[3]) : T(1);
    const T c = scale[1] > T(0) ? T(1) + scale[1] * scale[1] * r.dot(jet[5]) : T(1);
    const T b = scale[0] * scale[1] * (jet[1].dot(jet[2]) + r.dot(jet[4]));
    const T angle = T(0.5) * std::atan2(T(2) * b, a - c);
    const T x = model.x = std::cos(angle);
    const T y = model.y = std::sin(angle);
    const T floor = T(1e-14);
    model.gradient = { { x * gradient[0] + y * gradient[1], x * gradient[1] - y * gradient[0] } };
    model.curvature = { { std::max(std::abs(a * x * x + T(2) * b * x * y + c * y * y), floor),
      std::max(std::abs(a * y * y - T(2) * b * x * y + c * x * x), floor) } };
    return model;
  }

  /// Looks around for something lower, as there is at saddles and where a derivative vanishes.
  bool probe(Place& place, Point& at) const
  {
    const int rows = this->Geometry.degree(1) > 0 ? 1 : 0;
    for (const T reach : { T(3e-3), T(1e-5) })
    {
      for (int j = -rows; j <= rows; ++j)
      {
        for (int i = -1; i <= 1; ++i)
        {
          if (this->move(place, at, { { reach * T(i), reach * T(j) } }, T(1)))
          {
            return true;
          }
        }
      }
    }
    return false;
  }

  const Piece<T>& Geometry;
  Point Query;
};

} // namespace oracle
