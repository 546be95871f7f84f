// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/grids/sliding_sides.h"

#include <algorithm>

namespace footpoint
{
namespace
{

/// Part of half the way to a neighbour that a point may go at once; less than 1, so that none meet.
constexpr double kLargestMove = 0.9;

} // namespace

SlidingSides::Line SlidingSides::make_line(Points vertices)
{
  const Eigen::Index count = vertices.cols();
  Line line;
  line.lengths = Eigen::VectorXd::Zero(count);
  line.tangents = Points::Zero(3, count);
  for (Eigen::Index k = 1; k < count; ++k)
  {
    const Vector3 edge = vertices.col(k) - vertices.col(k - 1);
    line.lengths(k) = line.lengths(k - 1) + edge.norm();
    line.tangents.col(k - 1) += edge.normalized();
    line.tangents.col(k) += edge.normalized();
  }
  line.tangents.colwise().normalize();
  line.vertices = std::move(vertices);
  return line;
}

SlidingSides::SlidingSides(const Grid& grid)
{
  const Eigen::Index nu = grid.count[0];
  const Eigen::Index nv = grid.count[1];
  const std::array<Eigen::Index, 4> first = { { 0, nu - 1, nu * (nv - 1), 0 } };
  for (int side = 0; side < 4; ++side)
  {
    const Eigen::Index step = side % 2 == 0 ? 1 : nu;
    const Eigen::Index across = (side % 2 == 0 ? nu : 1) * (side == 0 || side == 3 ? 1 : -1);
    const Eigen::Index size = side % 2 == 0 ? nu : nv;
    this->Lines[std::size_t(side)] =
      make_line(grid.points(Eigen::all, Eigen::seqN(first[std::size_t(side)], size, step)));
    for (Eigen::Index place = 1; place + 1 < size; ++place)
    {
      const Eigen::Index point = first[std::size_t(side)] + place * step;
      this->Sliding.push_back({ point, point + across, side, place });
    }
  }
  this->Start.resize(Eigen::Index(this->Sliding.size()));
  for (std::size_t k = 0; k < this->Sliding.size(); ++k)
  {
    const SlidingPoint& which = this->Sliding[k];
    this->Start(Eigen::Index(k)) = this->Lines[std::size_t(which.side)].lengths(which.place);
  }
}

Eigen::Index SlidingSides::segment(const Line& line, double at) const
{
  const double* begin = line.lengths.data();
  const Eigen::Index above = std::upper_bound(begin, begin + line.lengths.size(), at) - begin;
  return std::clamp<Eigen::Index>(above - 1, 0, line.lengths.size() - 2);
}

Vector3 SlidingSides::point(const SlidingPoint& which, double at) const
{
  const Line& line = this->Lines[std::size_t(which.side)];
  const Eigen::Index k = this->segment(line, at);
  const double length = line.lengths(k + 1) - line.lengths(k);
  const double t = length > 0.0 ? (at - line.lengths(k)) / length : 0.0;
  return (1.0 - t) * line.vertices.col(k) + t * line.vertices.col(k + 1);
}

Vector3 SlidingSides::tangent(const SlidingPoint& which, double at) const
{
  const Line& line = this->Lines[std::size_t(which.side)];
  const Eigen::Index k = this->segment(line, at);
  const double length = line.lengths(k + 1) - line.lengths(k);
  const double t = length > 0.0 ? (at - line.lengths(k)) / length : 0.0;
  const Vector3 mixed = (1.0 - t) * line.tangents.col(k) + t * line.tangents.col(k + 1);
  return mixed.normalized();
}

Vector3 SlidingSides::point_derivative(const SlidingPoint& which, double at) const
{
  const Line& line = this->Lines[std::size_t(which.side)];
  const Eigen::Index k = this->segment(line, at);
  return (line.vertices.col(k + 1) - line.vertices.col(k)).normalized();
}

Vector3 SlidingSides::tangent_derivative(const SlidingPoint& which, double at) const
{
  const Line& line = this->Lines[std::size_t(which.side)];
  const Eigen::Index k = this->segment(line, at);
  const double length = line.lengths(k + 1) - line.lengths(k);
  if (!(length > 0.0))
  {
    return Vector3::Zero();
  }
  const double t = (at - line.lengths(k)) / length;
  const Vector3 mixed = (1.0 - t) * line.tangents.col(k) + t * line.tangents.col(k + 1);
  const Vector3 change = (line.tangents.col(k + 1) - line.tangents.col(k)) / length;
  const Vector3 unit = mixed.normalized();
  return (change - unit.dot(change) * unit) / mixed.norm();
}

std::array<double, 2> SlidingSides::limits(const Eigen::VectorXd& at, Eigen::Index number) const
{
  const SlidingPoint& which = this->Sliding[std::size_t(number)];
  const Eigen::VectorXd& lengths = this->Lines[std::size_t(which.side)].lengths;
  const bool first = which.place == 1;
  const bool last = which.place + 2 == lengths.size();
  const double before = first ? 0.0 : at(number - 1);
  const double after = last ? lengths(lengths.size() - 1) : at(number + 1);
  return { { 0.5 * kLargestMove * (before - at(number)),
    0.5 * kLargestMove * (after - at(number)) } };
}

double SlidingSides::allowed(const Eigen::VectorXd& at, const Eigen::VectorXd& move) const
{
  double fraction = 1.0;
  for (Eigen::Index k = 0; k < at.size(); ++k)
  {
    const double limit = this->limits(at, k)[move(k) > 0.0 ? 1 : 0];
    if (std::abs(move(k)) * fraction > std::abs(limit))
    {
      fraction = limit / move(k);
    }
  }
  return fraction;
}

} // namespace footpoint
