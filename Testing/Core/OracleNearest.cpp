// SPDX-License-Identifier: BSD-3-Clause

#include "OracleNearest.h"

#include "OracleDescent.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace oracle
{

template <int N>
class Nearest<N>::Samples
{
public:
  Samples(const Spline<N>& geometry, int samples)
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

template <int N>
Nearest<N>::Nearest(const Spline<N>& geometry, int samples)
  : Made(std::make_shared<const Samples>(geometry, samples))
{
}

template <int N>
const Spline<N>& Nearest<N>::spline() const
{
  return this->Made->spline();
}

template <int N>
Foot<N> Nearest<N>::operator()(const Vector& query) const
{
  return (*this->Made)(query);
}

template class Nearest<1>;
template class Nearest<2>;

} // namespace oracle
