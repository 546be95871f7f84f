// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Judges for the core, in long double, that share no line with it: B-splines by the definition of
/// Cox and de Boor, nearest points by brute force without derivatives. Slow and plain on purpose.

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace oracle
{

using Real = long double;
using Vector = Eigen::Matrix<Real, 3, 1>;

/// A NURBS curve (N = 1) or surface (N = 2) in its own domain and in space, nothing shifted.
template <int N>
class Spline
{
public:
  using Parameters = std::array<Real, N>;
  using Spans = std::array<int, N>;

  /// \param control_points one a column, first direction fastest; weights may be empty (all 1)
  Spline(const std::array<int, N>& degrees, const std::array<std::vector<double>, N>& knots,
    const Eigen::Matrix<double, 3, Eigen::Dynamic>& control_points,
    const Eigen::VectorXd& weights = {})
    : Degrees(degrees)
    , Positions(control_points.cast<Real>())
    , Weights(Eigen::Matrix<Real, Eigen::Dynamic, 1>::Ones(control_points.cols()))
  {
    for (int i = 0; i < N; ++i)
    {
      this->Knots[i].assign(knots[i].begin(), knots[i].end());
    }
    if (weights.size() > 0)
    {
      this->Weights = weights.cast<Real>();
    }
  }

  int degree(int i) const { return this->Degrees[i]; }
  int count(int i) const { return static_cast<int>(this->Knots[i].size()) - this->Degrees[i] - 1; }
  Real knot(int i, int k) const { return this->Knots[i][k]; }

  /// Indices k of all spans [k, k + 1) of positive length in the domain.
  std::vector<int> spans(int i) const
  {
    std::vector<int> all;
    for (int k = this->Degrees[i]; k < this->count(i); ++k)
    {
      if (this->Knots[i][k] < this->Knots[i][k + 1])
      {
        all.push_back(k);
      }
    }
    return all;
  }

  /// The span that holds t, at a knot the one on the left or on the right of it.
  int span(int i, Real t, bool left) const
  {
    const std::vector<int> all = this->spans(i);
    int found = all.front();
    for (const int k : all)
    {
      if (left ? this->Knots[i][k] < t : this->Knots[i][k] <= t)
      {
        found = k;
      }
    }
    return found;
  }

  /// The polynomial or rational piece of the given spans, inside them or continued.
  Vector evaluate(const Spans& span, const Parameters& t) const
  {
    const std::vector<Real> u = this->basis(0, span[0], t[0]);
    const std::vector<Real> v =
      N == 1 ? std::vector<Real>{ 1.0L } : this->basis(N - 1, span[N - 1], t[N - 1]);
    const int row = N == 1 ? 0 : span[N - 1] - this->Degrees[N - 1];
    Vector sum = Vector::Zero();
    Real weight = 0.0L;
    for (std::size_t j = 0; j < v.size(); ++j)
    {
      for (std::size_t i = 0; i < u.size(); ++i)
      {
        const Eigen::Index at = (row + static_cast<int>(j)) * this->count(0) + span[0] -
          this->Degrees[0] + static_cast<int>(i);
        const Real factor = u[i] * v[j] * this->Weights[at];
        sum += factor * this->Positions.col(at);
        weight += factor;
      }
    }
    return sum / weight;
  }

  /// The point at t; on knots the limit from the left where asked for, else from the right.
  Vector point(const Parameters& t, const std::array<bool, N>& left = {}) const
  {
    Spans spans;
    for (int i = 0; i < N; ++i)
    {
      spans[i] = this->span(i, t[i], left[i]);
    }
    return this->evaluate(spans, t);
  }

private:
  /// N_{i,p}(t) for i = k − p … k by its definition, where N_{i,0} is 1 for i = k alone.
  std::vector<Real> basis(int direction, int k, Real t) const
  {
    const std::vector<Real>& knots = this->Knots[direction];
    const int p = this->Degrees[direction];
    std::vector<Real> values(p + 2, 0.0L); // entry j is N_{k − p + j, q}
    values[p] = 1.0L;
    for (int q = 1; q <= p; ++q)
    {
      for (int j = p - q; j <= p; ++j)
      {
        const int i = k - p + j;
        Real value = 0.0L;
        if (values[j] != 0.0L)
        {
          value += (t - knots[i]) / (knots[i + q] - knots[i]) * values[j];
        }
        if (values[j + 1] != 0.0L)
        {
          value += (knots[i + q + 1] - t) / (knots[i + q + 1] - knots[i + 1]) * values[j + 1];
        }
        values[j] = value;
      }
    }
    values.pop_back();
    return values;
  }

  std::array<int, N> Degrees;
  std::array<std::vector<Real>, N> Knots;
  Eigen::Matrix<Real, 3, Eigen::Dynamic> Positions;
  Eigen::Matrix<Real, Eigen::Dynamic, 1> Weights;
};

/// A nearest point: distance, parameters in the spline's own domain, place.
template <int N>
struct Foot
{
  Real distance = std::numeric_limits<Real>::infinity();
  std::array<Real, N> parameter{};
  Vector point = Vector::Zero();
};

/// Nearest points on a spline: a dense grid in every span, then every grid minimum that can still
/// win is refined inside its span. Spans are closed boxes of their own, so that boundaries, seams,
/// kinks and gaps need no special care. Distances are good to about 1e-15 of the size.
template <int N>
class Nearest
{
public:
  using Parameters = std::array<Real, N>;

  /// \param samples per span and direction; 0: 2·degree + 4
  explicit Nearest(const Spline<N>& geometry, int samples = 0)
    : Geometry(geometry)
  {
    for (int i = 0; i < N; ++i)
    {
      this->Samples[i] = samples > 0 ? samples : 2 * geometry.degree(i) + 4;
    }
    for (const int v : N == 1 ? std::vector<int>{ 0 } : geometry.spans(N - 1))
    {
      for (const int u : geometry.spans(0))
      {
        typename Spline<N>::Spans spans;
        spans[N - 1] = v;
        spans[0] = u;
        this->Boxes.push_back(this->sample(spans));
      }
    }
  }

  Foot<N> operator()(const Vector& query) const
  {
    // === Upper bound from the grid
    std::vector<Real> lower(this->Boxes.size());
    Real bound = std::numeric_limits<Real>::infinity();
    for (std::size_t b = 0; b < this->Boxes.size(); ++b)
    {
      const Box& box = this->Boxes[b];
      lower[b] = (query - box.middle).norm() - box.radius - box.spacing;
      if (lower[b] <= bound)
      {
        bound = std::min(
          bound, std::sqrt((box.points.colwise() - query).colwise().squaredNorm().minCoeff()));
      }
    }
    // === Refine what can still win
    Foot<N> best;
    for (std::size_t b = 0; b < this->Boxes.size(); ++b)
    {
      if (lower[b] <= bound)
      {
        this->refine_minima(this->Boxes[b], query, bound, best);
      }
    }
    return best;
  }

private:
  struct Box
  {
    typename Spline<N>::Spans spans;
    Eigen::Matrix<Real, 3, Eigen::Dynamic> points;
    Vector middle;
    Real radius;
    Real spacing; ///< twice the largest distance of neighbouring samples
  };

  int rows() const { return N == 1 ? 1 : this->Samples[N - 1]; }

  /// Own parameters of a place given as fractions of the span.
  Parameters at(const Box& box, const Parameters& fraction) const
  {
    Parameters t;
    for (int i = 0; i < N; ++i)
    {
      const Real a = this->Geometry.knot(i, box.spans[i]);
      const Real b = this->Geometry.knot(i, box.spans[i] + 1);
      t[i] = fraction[i] == 1.0L ? b : a + fraction[i] * (b - a);
    }
    return t;
  }

  Parameters grid_fraction(int i, int j) const
  {
    Parameters fraction;
    fraction[N - 1] = static_cast<Real>(j) / std::max(1, this->rows() - 1);
    fraction[0] = static_cast<Real>(i) / (this->Samples[0] - 1);
    return fraction;
  }

  Box sample(const typename Spline<N>::Spans& spans) const
  {
    Box box;
    box.spans = spans;
    const int columns = this->Samples[0];
    box.points.resize(3, columns * this->rows());
    box.spacing = 0.0L;
    for (int j = 0; j < this->rows(); ++j)
    {
      for (int i = 0; i < columns; ++i)
      {
        const int k = j * columns + i;
        box.points.col(k) =
          this->Geometry.evaluate(spans, this->at(box, this->grid_fraction(i, j)));
        for (const int neighbour : { i > 0 ? k - 1 : k, j > 0 ? k - columns : k })
        {
          const Real gap = (box.points.col(k) - box.points.col(neighbour)).norm();
          box.spacing = std::max(box.spacing, 2.0L * gap);
        }
      }
    }
    box.middle = box.points.rowwise().mean();
    box.radius = (box.points.colwise() - box.middle).colwise().norm().maxCoeff();
    return box;
  }

  void refine_minima(const Box& box, const Vector& query, Real bound, Foot<N>& best) const
  {
    const int columns = this->Samples[0];
    const Eigen::Matrix<Real, 1, Eigen::Dynamic> squares =
      (box.points.colwise() - query).colwise().squaredNorm();
    for (int j = 0; j < this->rows(); ++j)
    {
      for (int i = 0; i < columns; ++i)
      {
        const Real here = squares[j * columns + i];
        bool minimum = std::sqrt(here) - box.spacing <= std::min(bound, best.distance);
        for (int b = std::max(j - 1, 0); b <= std::min(j + 1, this->rows() - 1); ++b)
        {
          for (int a = std::max(i - 1, 0); a <= std::min(i + 1, columns - 1); ++a)
          {
            minimum = minimum && here <= squares[b * columns + a];
          }
        }
        if (minimum)
        {
          this->refine(box, query, this->grid_fraction(i, j), best);
        }
      }
    }
  }

  /// Shrinking pattern search; a parabola through the pattern proposes further trial points, since
  /// coordinate steps alone creep in oblique valleys. Only real improvements are accepted.
  void refine(const Box& box, const Vector& query, Parameters place, Foot<N>& best) const
  {
    const auto square = [&](const Parameters& fraction)
    { return (this->Geometry.evaluate(box.spans, this->at(box, fraction)) - query).squaredNorm(); };
    Real value = square(place);
    Real step = 0.5L / (this->Samples[0] - 1);
    for (int iteration = 0; iteration < 400 && step > 1e-19L && value > 0.0L; ++iteration)
    {
      Parameters next = place;
      Real least = value;
      for (const Parameters& trial : this->trials(place, step, square))
      {
        const Real here = square(trial);
        if (here < least)
        {
          least = here;
          next = trial;
        }
      }
      Real moved = 0.0L;
      for (int i = 0; i < N; ++i)
      {
        moved = std::max(moved, std::abs(next[i] - place[i]));
      }
      place = next;
      value = least;
      step = moved >= 0.9L * step ? std::min(1.5L * step, 0.25L) : 0.3L * step;
    }
    if (std::sqrt(value) < best.distance)
    {
      best.distance = std::sqrt(value);
      best.parameter = this->at(box, place);
      best.point = this->Geometry.evaluate(box.spans, best.parameter);
    }
  }

  static Real clamp(Real fraction) { return std::min(std::max(fraction, 0.0L), 1.0L); }

  template <class Square>
  std::vector<Parameters> trials(const Parameters& place, Real step, const Square& square) const
  {
    std::vector<Parameters> all;
    // The parabola's pattern is pushed inside the span, where the piece has no pole.
    Parameters middle;
    for (int i = 0; i < N; ++i)
    {
      middle[i] = std::min(std::max(place[i], step), 1.0L - step);
    }
    std::array<Real, N> gradient;
    std::array<Real, N> curvature;
    const Real centre = square(middle);
    for (int i = 0; i < N; ++i)
    {
      Parameters low = middle;
      Parameters high = middle;
      low[i] -= step;
      high[i] += step;
      const Real a = square(low);
      const Real b = square(high);
      gradient[i] = (b - a) / 2.0L;
      curvature[i] = a - 2.0L * centre + b;
      for (const Real sign : { -1.0L, 1.0L })
      {
        Parameters beside = place;
        beside[i] = clamp(place[i] + sign * step);
        all.push_back(beside);
      }
      Parameters along = middle; // minimum of the parabola in this direction alone
      along[i] = clamp(middle[i] - step * gradient[i] / curvature[i]);
      all.push_back(along);
      for (int other = 0; other < N; ++other)
      {
        if (other != i)
        {
          along[other] = place[other]; // also from where we stand, which may be a border
          all.push_back(along);
        }
      }
    }
    if constexpr (N == 2)
    {
      Real mixed = 0.0L;
      for (const Real a : { -1.0L, 1.0L })
      {
        for (const Real b : { -1.0L, 1.0L })
        {
          mixed += a * b / 4.0L * square({ middle[0] + a * step, middle[1] + b * step });
          all.push_back({ clamp(place[0] + a * step), clamp(place[1] + b * step) });
        }
      }
      const Real determinant = curvature[0] * curvature[1] - mixed * mixed;
      const Real du = (mixed * gradient[1] - curvature[1] * gradient[0]) / determinant;
      const Real dv = (mixed * gradient[0] - curvature[0] * gradient[1]) / determinant;
      all.push_back({ clamp(middle[0] + step * du), clamp(middle[1] + step * dv) });
    }
    // 0/0 in flat patterns proposes nothing.
    all.erase(std::remove_if(all.begin(), all.end(),
                [](const Parameters& t)
                { return !(std::abs(t[0]) <= 1.0L && std::abs(t[N - 1]) <= 1.0L); }),
      all.end());
    return all;
  }

  Spline<N> Geometry;
  std::array<int, N> Samples;
  std::vector<Box> Boxes;
};

/// Derivatives of order a (in u) and b (in v; 0 on curves) of the piece on the given spans, by
/// central differences with Richardson extrapolation (Ridders 1982); the continued piece is
/// evaluated, so that one-sided derivatives at knots are central ones here. \param step first step
/// as a fraction of the span's length
template <int N>
Vector derivative(const Spline<N>& geometry, const typename Spline<N>::Spans& spans,
  const typename Spline<N>::Parameters& t, const std::array<int, N>& orders, Real step = 0.02L)
{
  static const std::array<std::vector<Real>, 4> stencils{ { { 0, 1, 0 }, { -0.5L, 0, 0.5L },
    { 1, -2, 1 }, { -0.5L, 1, 0, -1, 0.5L } } };
  const auto difference = [&](Real fraction)
  {
    std::array<Real, N> h;
    Real scale = 1.0L;
    for (int i = 0; i < N; ++i)
    {
      h[i] = fraction * (geometry.knot(i, spans[i] + 1) - geometry.knot(i, spans[i]));
      scale *= std::pow(h[i], static_cast<Real>(orders[i]));
    }
    const std::vector<Real>& su = stencils[orders[0]];
    const std::vector<Real>& sv = N == 1 ? std::vector<Real>{ 1 } : stencils[orders[N - 1]];
    Vector sum = Vector::Zero();
    for (std::size_t b = 0; b < sv.size(); ++b)
    {
      for (std::size_t a = 0; a < su.size(); ++a)
      {
        auto place = t;
        if (N > 1)
        {
          place[N - 1] += (static_cast<Real>(b) - static_cast<Real>(sv.size() / 2)) * h[N - 1];
        }
        place[0] += (static_cast<Real>(a) - static_cast<Real>(su.size() / 2)) * h[0];
        const Real factor = su[a] * sv[b];
        if (factor != 0.0L)
        {
          sum += factor * geometry.evaluate(spans, place);
        }
      }
    }
    return Vector(sum / scale);
  };
  constexpr int kLevels = 7;
  std::array<std::array<Vector, kLevels>, kLevels> table;
  Vector best = Vector::Zero();
  Real error = std::numeric_limits<Real>::infinity();
  for (int i = 0; i < kLevels; ++i, step /= 2.0L)
  {
    table[i][0] = difference(step);
    Real factor = 4.0L;
    for (int j = 1; j <= i; ++j, factor *= 4.0L)
    {
      table[i][j] = (factor * table[i][j - 1] - table[i - 1][j - 1]) / (factor - 1.0L);
      const Real change = std::max(
        (table[i][j] - table[i][j - 1]).norm(), (table[i][j] - table[i - 1][j - 1]).norm());
      if (change < error)
      {
        error = change;
        best = table[i][j];
      }
    }
  }
  return best;
}

} // namespace oracle
