// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Nearest points by brute force, sharing no line with the core: dense samples of every span, made
/// once per geometry, and a damped Newton iteration in the span's box from all samples that can
/// still win. It proves nothing; its distance is one that the geometry has, and very often the
/// least.

#include "Oracle.h"

#include <array>
#include <utility>
#include <vector>

namespace oracle
{

/// A nearest point: distance, parameters in the spline's own domain, place.
template <int N>
struct Foot
{
  Real distance = std::numeric_limits<Real>::infinity();
  std::array<Real, N> parameter{};
  Vector point = Vector::Zero();
};

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

/// Nearest points on a spline. Spans are closed boxes of their own, so that boundaries, seams,
/// kinks and gaps need no special care. Distances are good to about 1e-15 of the size.
template <int N>
class Nearest
{
public:
  /// \param samples least number per span and direction; 0: what suits the degree
  explicit Nearest(const Spline<N>& geometry, int samples = 0)
    : Geometry(geometry)
    , Size(static_cast<double>(geometry.size()))
  {
    for (const int v : N == 1 ? std::vector<int>{ 0 } : geometry.spans(N - 1))
    {
      for (const int u : geometry.spans(0))
      {
        typename Spline<N>::Spans spans;
        spans[N - 1] = v;
        spans[0] = u;
        this->sample(this->piece(spans), samples);
      }
    }
  }

  const Spline<N>& spline() const { return this->Geometry; }

  Foot<N> operator()(const Vector& query) const
  {
    const Eigen::Vector3d rounded = query.template cast<double>();
    Foot<N> best;
    std::vector<Ending> endings;
    double bound = std::numeric_limits<double>::infinity();
    // Around the centre of a sphere everything ties: enough is enough.
    constexpr int kTies = 40;
    int ties = 0;
    for (const Start& start : this->starts(rounded))
    {
      if (ties < kTies && start.distance - kReach * start.spacing <= bound)
      {
        const auto [place, distance] =
          Descent<double>(this->Boxes[start.box].fast, rounded)(start.place, 100, true);
        endings.push_back({ start.box, place, distance });
        ties = distance < bound * (1.0 - 1e-12) ? 0 : ties + (distance < bound * (1.0 + 1e-12));
        bound = std::min(bound, distance);
      }
    }
    // === What ties to double precision is decided in long double
    std::vector<Ending> refined;
    for (const Ending& ending : endings)
    {
      const auto same = [&](const Ending& other)
      {
        return other.box == ending.box && std::abs(other.place[0] - ending.place[0]) < 1e-9 &&
          std::abs(other.place[1] - ending.place[1]) < 1e-9;
      };
      if (ending.distance <= bound * (1.0 + 1e-9) + 1e-7 * this->Size &&
        std::none_of(refined.begin(), refined.end(), same))
      {
        refined.push_back(ending);
        this->refine(ending, query, best);
      }
    }
    return best;
  }

private:
  using Place = std::array<double, 2>;

  /// How much nearer than a sample a point of the cells around it may be, by the sample's distance
  /// to its neighbours. One would do on flat cells; twice that finds more on bent ones.
  static constexpr double kReach = 2.0;

  struct Box
  {
    typename Spline<N>::Spans spans;
    Piece<double> fast;
    Piece<Real> exact;
    std::array<std::vector<double>, 2> places;
    Eigen::Matrix<double, 3, Eigen::Dynamic> points;
    Eigen::RowVectorXd spacing; ///< largest distance of a sample to one of its neighbours
    Eigen::Vector3d middle;
    double radius; ///< of a ball about the middle that holds the samples and their spacing
  };

  struct Start
  {
    int box;
    int row;
    int column;
    bool minimum;
    double distance;
    double spacing;
    Place place;
  };

  struct Ending
  {
    int box;
    Place place;
    double distance;
  };

  // === Samples

  /// Rows j of the Bézier poles on [a, b] = [t_k, t_k+1] as combinations of the poles of the span:
  /// values of the blossom at (a, …, a, b, …, b), b taken j times (Ramshaw 1989).
  Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic> extraction(int direction, int k) const
  {
    const int p = this->Geometry.degree(direction);
    const auto knot = [&](int i) { return this->Geometry.knot(direction, i); };
    Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic> all(p + 1, p + 1);
    for (int j = 0; j <= p; ++j)
    {
      Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic> rows =
        Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>::Identity(p + 1, p + 1);
      for (int r = 1; r <= p; ++r)
      {
        const Real t = r <= p - j ? knot(k) : knot(k + 1);
        for (int m = p; m >= r; --m)
        {
          const int i = k - p + m;
          const Real alpha = (t - knot(i)) / (knot(i + p + 1 - r) - knot(i));
          rows.row(m) = ((1.0L - alpha) * rows.row(m - 1) + alpha * rows.row(m)).eval();
        }
      }
      all.row(j) = rows.row(p);
    }
    return all;
  }

  /// A span without samples.
  Box piece(const typename Spline<N>::Spans& spans) const
  {
    Box box;
    box.spans = spans;
    // === Bézier net
    std::array<int, 2> degrees{ { this->Geometry.degree(0), 0 } };
    std::array<Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>, 2> factors;
    factors[0] = this->extraction(0, spans[0]);
    factors[1] = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>::Ones(1, 1);
    if (N == 2)
    {
      degrees[1] = this->Geometry.degree(N - 1);
      factors[1] = this->extraction(N - 1, spans[N - 1]);
    }
    const int rows = degrees[1] + 1;
    const int columns = degrees[0] + 1;
    Eigen::Matrix<Real, 4, Eigen::Dynamic> net =
      Eigen::Matrix<Real, 4, Eigen::Dynamic>::Zero(4, rows * columns);
    for (int n = 0; n < rows; ++n)
    {
      Eigen::Matrix<Real, 4, Eigen::Dynamic> poles(4, columns);
      for (int m = 0; m < columns; ++m)
      {
        const int row = N == 1 ? 0 : spans[N - 1] - degrees[1] + n;
        poles.col(m) =
          this->Geometry.homogeneous(row * this->Geometry.count(0) + spans[0] - degrees[0] + m);
      }
      const Eigen::Matrix<Real, 4, Eigen::Dynamic> along = poles * factors[0].transpose();
      for (int j = 0; j < rows; ++j)
      {
        net.middleCols(j * columns, columns) += factors[1](j, n) * along;
      }
    }
    box.fast = Piece<double>(degrees, net);
    box.exact = Piece<Real>(degrees, net);
    for (int i = 0; i < 2; ++i)
    {
      box.places[i] = i < N ? std::vector<double>{ 0.0, 1.0 } : std::vector<double>{ 0.0 };
    }
    return box;
  }

  /// Fills the part of a span between the ends of `places` with samples: equally spaced, then
  /// closer where neighbours are far apart in space. Where steep weights crowd much of the geometry
  /// into few parameters, that takes several boxes.
  void sample(Box box, int samples, int depth = 0)
  {
    constexpr int kDeepest = N == 1 ? 0 : 4;
    for (int i = 0; i < N; ++i)
    {
      const int degree = this->Geometry.degree(i);
      const int usual = N == 1 ? 6 * degree + 20 : 3 * degree + 6;
      const int count = samples > 0 ? samples : depth == 0 ? usual : degree + 2;
      const double first = box.places[i].front();
      const double last = box.places[i].back();
      box.places[i].clear();
      for (int k = 0; k < count; ++k)
      {
        box.places[i].push_back(k == count - 1 ? last : first + (last - first) * k / (count - 1.0));
      }
    }
    for (int pass = 0; pass < 24; ++pass)
    {
      const bool first = this->split(box, 0);
      const bool second = N == 2 && this->split(box, 1);
      if (!first && !second)
      {
        break;
      }
    }
    this->measure(box);
    int longest = 0;
    if (box.spacing.maxCoeff() > 2.0 * this->farthest() && depth < kDeepest &&
      this->splittable(box, longest))
    {
      const std::vector<double> places = box.places[longest];
      const std::size_t middle = places.size() / 2;
      box.places[longest] = { places.front(), places[middle] };
      this->sample(box, samples, depth + 1);
      box.places[longest] = { places[middle], places.back() };
      this->sample(box, samples, depth + 1);
      return;
    }
    this->Boxes.push_back(box);
  }

  /// Whether there is an interval to split, and the direction of the widest gap between samples.
  bool splittable(const Box& box, int& direction) const
  {
    double widest = 0.0;
    for (int i = 0; i < N; ++i)
    {
      const auto lengths = this->intervals(box, i);
      if (!lengths.empty() && lengths.front().first > widest)
      {
        widest = lengths.front().first;
        direction = i;
      }
    }
    return widest > 0.0;
  }

  double farthest() const { return (N == 1 ? 1.0 / 256.0 : 1.0 / 96.0) * this->Size; }

  /// Intervals over which samples are farther apart than they should be: length and number.
  std::vector<std::pair<double, std::size_t>> intervals(const Box& box, int i) const
  {
    constexpr double kShortest = 1e-9; // below it is taken for a jump
    const Eigen::Matrix<double, 3, Eigen::Dynamic> points = box.fast.grid(box.places);
    const std::vector<double>& places = box.places[i];
    const Eigen::Index columns = static_cast<Eigen::Index>(box.places[0].size());
    const Eigen::Index rows = static_cast<Eigen::Index>(box.places[1].size());
    std::vector<std::pair<double, std::size_t>> lengths;
    for (std::size_t k = 0; k + 1 < places.size(); ++k)
    {
      const Eigen::Index at = static_cast<Eigen::Index>(k);
      double longest = 0.0;
      for (Eigen::Index other = 0; other < (i == 0 ? rows : columns); ++other)
      {
        const Eigen::Index here = i == 0 ? other * columns + at : at * columns + other;
        const Eigen::Index next = here + (i == 0 ? 1 : columns);
        longest = std::max(longest, (points.col(next) - points.col(here)).squaredNorm());
      }
      if (std::sqrt(longest) > this->farthest() && places[k + 1] - places[k] > kShortest)
      {
        lengths.push_back({ longest, k });
      }
    }
    std::sort(lengths.rbegin(), lengths.rend());
    return lengths;
  }

  /// Halves the longest intervals.
  bool split(Box& box, int i) const
  {
    constexpr std::size_t kMost = N == 1 ? 1000 : 72;
    std::vector<double>& places = box.places[i];
    std::vector<double> added;
    for (const auto& [length, k] : this->intervals(box, i))
    {
      if (places.size() + added.size() < kMost)
      {
        added.push_back(0.5 * (places[k] + places[k + 1]));
      }
    }
    places.insert(places.end(), added.begin(), added.end());
    std::sort(places.begin(), places.end());
    return !added.empty();
  }

  void measure(Box& box) const
  {
    box.points = box.fast.grid(box.places);
    const Eigen::Index columns = static_cast<Eigen::Index>(box.places[0].size());
    box.spacing.setZero(box.points.cols());
    for (Eigen::Index k = 0; k < box.points.cols(); ++k)
    {
      const Eigen::Index beside = k % columns > 0 ? k - 1 : k;
      const Eigen::Index below = k >= columns ? k - columns : k;
      for (const Eigen::Index neighbour : { beside, below })
      {
        const double gap = (box.points.col(k) - box.points.col(neighbour)).norm();
        box.spacing[k] = std::max(box.spacing[k], gap);
        box.spacing[neighbour] = std::max(box.spacing[neighbour], gap);
      }
    }
    box.middle = box.points.rowwise().mean();
    box.radius = (box.points.colwise() - box.middle).colwise().norm().maxCoeff() +
      2.0 * box.spacing.maxCoeff();
  }

  // === Starts

  /// Samples that can still win; minima among their neighbours first, then by distance, no two side
  /// by side.
  std::vector<Start> starts(const Eigen::Vector3d& query) const
  {
    constexpr std::size_t kMost = 128;
    constexpr std::size_t kSorted = 600;
    std::vector<Eigen::RowVectorXd> squares(this->Boxes.size());
    std::vector<std::pair<double, int>> order;
    for (std::size_t b = 0; b < this->Boxes.size(); ++b)
    {
      const double lower = (query - this->Boxes[b].middle).norm() - this->Boxes[b].radius;
      order.push_back({ lower, static_cast<int>(b) });
    }
    std::sort(order.begin(), order.end());
    double bound = std::numeric_limits<double>::infinity();
    for (const auto& [lower, b] : order)
    {
      if (lower <= bound)
      {
        squares[b] = (this->Boxes[b].points.colwise() - query).colwise().squaredNorm();
        bound = std::min(bound, std::sqrt(squares[b].minCoeff()));
      }
    }
    std::vector<Start> all;
    for (const auto& [lower, b] : order)
    {
      if (lower <= bound)
      {
        this->collect(b, squares[b], bound, all);
      }
    }
    const auto better = [](const Start& a, const Start& b)
    { return std::make_pair(!a.minimum, a.distance) < std::make_pair(!b.minimum, b.distance); };
    if (all.size() > kSorted)
    {
      std::nth_element(all.begin(), all.begin() + kSorted, all.end(), better);
      all.resize(kSorted);
    }
    std::sort(all.begin(), all.end(), better);
    std::vector<Start> kept;
    for (const Start& start : all)
    {
      const auto close = [&](const Start& other)
      {
        return other.box == start.box && std::abs(other.row - start.row) <= 1 &&
          std::abs(other.column - start.column) <= 1;
      };
      if (kept.size() < kMost && std::none_of(kept.begin(), kept.end(), close))
      {
        kept.push_back(start);
      }
    }
    return kept;
  }

  void collect(
    int b, const Eigen::RowVectorXd& squares, double bound, std::vector<Start>& all) const
  {
    const Box& box = this->Boxes[b];
    const int columns = static_cast<int>(box.places[0].size());
    const int rows = static_cast<int>(box.places[1].size());
    for (int k = 0; k < squares.size(); ++k)
    {
      const double reach = bound + kReach * box.spacing[k];
      if (squares[k] > reach * reach * (1.0 + 1e-14))
      {
        continue;
      }
      Start start{ b, k / columns, k % columns, true, std::sqrt(squares[k]), box.spacing[k], {} };
      start.place = { { box.places[0][start.column], box.places[1][start.row] } };
      for (int j = std::max(start.row - 1, 0); j <= std::min(start.row + 1, rows - 1); ++j)
      {
        for (int i = std::max(start.column - 1, 0); i <= std::min(start.column + 1, columns - 1);
             ++i)
        {
          start.minimum = start.minimum && squares[k] <= squares[j * columns + i];
        }
      }
      all.push_back(start);
    }
  }

  // === The end

  void refine(const Ending& ending, const Vector& query, Foot<N>& best) const
  {
    const Box& box = this->Boxes[ending.box];
    const auto [place, distance] =
      Descent<Real>(box.exact, query)({ { ending.place[0], ending.place[1] } }, 60, false);
    typename Spline<N>::Parameters t;
    for (int i = 0; i < N; ++i)
    {
      const Real a = this->Geometry.knot(i, box.spans[i]);
      const Real b = this->Geometry.knot(i, box.spans[i] + 1);
      t[i] = place[i] == 1.0L ? b : a + place[i] * (b - a);
    }
    const Vector point = this->Geometry.evaluate(box.spans, t);
    if ((point - query).norm() < best.distance)
    {
      best.distance = (point - query).norm();
      best.parameter = t;
      best.point = point;
    }
  }

  Spline<N> Geometry;
  double Size;
  std::vector<Box> Boxes;
};

} // namespace oracle
