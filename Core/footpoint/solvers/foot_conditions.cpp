// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/solvers/foot_conditions.h"

#include <algorithm>

namespace footpoint
{

template <int N>
FootConditions<N>::FootConditions(
  const ParametricGeometry<N>& geometry, const SolverOptions& options)
  : Geometry(geometry)
  , Options(options)
  , Walk(geometry)
{
}

template <int N>
Eigen::Matrix<bool, N, 1> FootConditions<N>::free(const Frame<N>& frame) const
{
  const typename DomainWalk<N>::Place place{ frame.t, frame.sides };
  Eigen::Matrix<bool, N, 1> result;
  for (int i = 0; i < N; ++i)
  {
    const bool held = (frame.gradient(i) > 0.0 && this->Walk.at_lower_border(place, i)) ||
      (frame.gradient(i) < 0.0 && this->Walk.at_upper_border(place, i));
    // Along a collapsed side nothing moves, and columns of no slope are no way down.
    result(i) = !held && !(N == 2 && this->Walk.on_collapsed_side(place, N - 1 - i));
  }
  return result;
}

template <int N>
Parameter<N> FootConditions<N>::residuals(const Frame<N>& frame, const Parameter<N>& speeds) const
{
  const Eigen::Matrix<bool, N, 1> free = this->free(frame);
  Parameter<N> result;
  for (int i = 0; i < N; ++i)
  {
    // Where S_i stands still its direction is rounding, and the mean speed has to judge.
    const double slowest = kStalledSpeed * this->Geometry.direction(i).speed;
    const double speed = std::max(speeds(i), slowest);
    result(i) = free(i) && speed > 0.0 ? std::abs(frame.gradient(i)) / speed : 0.0;
  }
  return result;
}

template <int N>
double FootConditions<N>::tolerance(const Frame<N>& frame) const
{
  return std::max(this->Options.cosine_tolerance * frame.distance,
    this->Options.point_tolerance * this->Geometry.size());
}

template <int N>
double FootConditions<N>::floor(const Frame<N>& frame, int i) const
{
  const Direction& direction = this->Geometry.direction(i);
  const double size = this->Geometry.size();
  const double speed = std::max(frame.speed(i), kStalledSpeed * direction.speed);
  if (speed == 0.0)
  {
    return this->tolerance(frame);
  }
  const double cancelled = std::max(1.0, size / (speed * direction.length));
  const double bend = std::abs(frame.r.dot(frame.jet.second.col(i == 0 ? 0 : 2)));
  const double placed =
    kPlaceRounding * direction.length * (frame.speed(i) * frame.speed(i) + bend) / speed;
  return std::max(
    { this->tolerance(frame), kResidualFloor * (size + cancelled * frame.distance), placed });
}

template <int N>
double FootConditions<N>::excess(const Frame<N>& frame) const
{
  const Parameter<N> residuals = this->residuals(frame);
  double result = 0.0;
  for (int i = 0; i < N; ++i)
  {
    // Both are 0 where the geometry is a point and the query on it.
    result = residuals(i) > 0.0 ? std::max(result, residuals(i) / this->floor(frame, i)) : result;
  }
  return result;
}

template <int N>
bool FootConditions<N>::stalled(const Frame<N>& frame, int i) const
{
  return frame.speed(i) <= kStalledSpeed * this->Geometry.direction(i).speed;
}

template <int N>
FootType FootConditions<N>::classify(const Frame<N>& frame, const Vector3& query) const
{
  const typename DomainWalk<N>::Place place{ frame.t, frame.sides };
  int bounds = 0;
  for (int i = 0; i < N; ++i)
  {
    if (this->Walk.on_collapsed_side(place, i) || this->stalled(frame, i))
    {
      return FootType::Degenerate;
    }
    bounds += this->Walk.on_boundary(place, i) ? 1 : 0;
  }
  if (bounds > 0)
  {
    return bounds == N ? FootType::Vertex : FootType::Edge;
  }
  auto orthogonal = [&](const Frame<N>& side)
  {
    for (int i = 0; i < N; ++i)
    {
      if (std::abs(side.gradient(i)) > this->floor(side, i) * side.speed(i))
      {
        return false;
      }
    }
    return true;
  };
  bool smooth = orthogonal(frame);
  for (const auto& neighbour : this->Walk.neighbours(place))
  {
    smooth =
      smooth && orthogonal(make_frame<N>(this->Geometry, query, neighbour.t, neighbour.sides));
  }
  return smooth ? FootType::Interior : FootType::Kink;
}

template class FootConditions<1>;
template class FootConditions<2>;

} // namespace footpoint
