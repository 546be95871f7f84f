// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/search/seeded_search.h"

#include "footpoint/search/better_foot.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace footpoint
{
namespace
{

/// Half width of the 3 × 3 micro-grid in cells of the coarse grid: ±10 % of the domain at the
/// guide's seven samples; after a descent that stagnated half of that.
constexpr double kMicroGrid = 0.6;
constexpr double kMicroGridAfterStagnation = 0.3;

/// Samples that share the domain evenly, both ends included; a closed direction's second end left
/// out.
std::vector<double> samples(const Direction& direction, int resolution)
{
  const int count = std::max(resolution, 2);
  const int intervals = direction.closed ? count : count - 1;
  std::vector<double> result(count);
  for (int k = 0; k < count; ++k)
  {
    result[k] = k == intervals ? direction.length : direction.length * k / intervals;
  }
  return result;
}

} // namespace

template <int N>
SeededSearch<N>::SeededSearch(const ParametricGeometry<N>& geometry, const SeedOptions& options)
  : Geometry(geometry)
  , Options(options)
{
  Eigen::Index count = 1;
  for (int i = 0; i < N; ++i)
  {
    this->Grid[i] = samples(geometry.direction(i), options.resolution);
    count *= static_cast<Eigen::Index>(this->Grid[i].size());
  }
  this->Samples.resize(3, count);
  for (Eigen::Index k = 0; k < count; ++k)
  {
    this->Samples.col(k) = geometry.point(this->parameter(k));
  }
}

template <int N>
Parameter<N> SeededSearch<N>::parameter(Eigen::Index sample) const
{
  Parameter<N> t;
  for (int i = 0; i < N; ++i)
  {
    const Eigen::Index count = static_cast<Eigen::Index>(this->Grid[i].size());
    t(i) = this->Grid[i][sample % count];
    sample /= count;
  }
  return t;
}

template <int N>
bool SeededSearch<N>::is_local_minimum(Eigen::Index sample, const Eigen::VectorXd& distances) const
{
  Eigen::Index stride = 1;
  for (int i = 0; i < N; ++i)
  {
    const Eigen::Index count = static_cast<Eigen::Index>(this->Grid[i].size());
    const Eigen::Index at = (sample / stride) % count;
    for (const Eigen::Index step : { Eigen::Index(-1), Eigen::Index(1) })
    {
      Eigen::Index other = at + step;
      if (other < 0 || other >= count)
      {
        if (!this->Geometry.direction(i).closed)
        {
          continue;
        }
        other = (other + count) % count;
      }
      if (distances(sample + (other - at) * stride) < distances(sample))
      {
        return false;
      }
    }
    stride *= count;
  }
  return true;
}

template <int N>
Parameter<N> SeededSearch<N>::refine(
  const Vector3& query, const Parameter<N>& around, double half_width) const
{
  Parameter<N> best = around;
  double smallest = (this->Geometry.point(around) - query).squaredNorm();
  const int last = N == 1 ? 3 : 9;
  for (int k = 0; k < last; ++k)
  {
    Parameter<N> t = around;
    for (int i = 0, code = k; i < N; ++i, code /= 3)
    {
      const Direction& direction = this->Geometry.direction(i);
      t(i) += (code % 3 - 1) * half_width * direction.length / this->Grid[i].size();
      if (direction.closed)
      {
        t(i) -= direction.length * std::floor(t(i) / direction.length);
      }
      t(i) = std::min(std::max(t(i), 0.0), direction.length);
    }
    const double distance = (this->Geometry.point(t) - query).squaredNorm();
    if (distance < smallest)
    {
      smallest = distance;
      best = t;
    }
  }
  return best;
}

template <int N>
std::vector<Parameter<N>> SeededSearch<N>::seeds(const Vector3& query, int count) const
{
  const Eigen::VectorXd distances = (this->Samples.colwise() - query).colwise().squaredNorm();
  std::vector<Eigen::Index> order;
  for (Eigen::Index k = 0; k < distances.size(); ++k)
  {
    if (this->is_local_minimum(k, distances))
    {
      order.push_back(k);
    }
  }
  std::stable_sort(order.begin(), order.end(),
    [&](Eigen::Index a, Eigen::Index b) { return distances(a) < distances(b); });
  order.resize(std::min<std::size_t>(order.size(), std::max(count, 1)));
  std::vector<Parameter<N>> result;
  for (const Eigen::Index k : order)
  {
    result.push_back(this->refine(query, this->parameter(k), kMicroGrid));
  }
  return result;
}

template <int N>
LocalFoot<N> SeededSearch<N>::find_from(
  const Vector3& query, const Parameter<N>& start, const SolverOptions& options) const
{
  LocalFoot<N> foot = find_local_foot<N>(this->Geometry, query, start, options);
  if (foot.termination == Termination::Stagnation && !foot.converged)
  {
    const Parameter<N> again = this->refine(query, foot.parameter, kMicroGridAfterStagnation);
    LocalFoot<N> other = find_local_foot<N>(this->Geometry, query, again, options);
    other.iterations += foot.iterations;
    return is_better(other, foot, this->Geometry) ? other : foot;
  }
  return foot;
}

template <int N>
LocalFoot<N> SeededSearch<N>::find(
  const Vector3& query, const SolverOptions& options, const Parameter<N>& start) const
{
  std::vector<Parameter<N>> starts = this->seeds(query, this->Options.number_of_seeds);
  if (start.allFinite())
  {
    starts.push_back(start);
  }
  LocalFoot<N> best = this->find_from(query, starts.front(), options);
  for (std::size_t k = 1; k < starts.size(); ++k)
  {
    const LocalFoot<N> foot = this->find_from(query, starts[k], options);
    best = is_better(foot, best, this->Geometry) ? foot : best;
  }
  return best;
}

template <int N>
Box SeededSearch<N>::box() const
{
  return { this->Samples.rowwise().minCoeff(), this->Samples.rowwise().maxCoeff() };
}

template class SeededSearch<1>;
template class SeededSearch<2>;

} // namespace footpoint
