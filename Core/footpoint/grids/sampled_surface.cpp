// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/grids/sampled_surface.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <limits>

namespace footpoint
{
namespace
{

/// Reach of a sample in lengths of its longest edge: at a corner of the grid, where a quarter of
/// the samples is left, still more than the six that a quadratic takes.
constexpr double kReach = 3.5;

constexpr int kLeaf = 4; ///< samples along each direction of a leaf
constexpr int kProjections = 30;
constexpr double kSettled = 1e-14; ///< a projection is done, relative to the reach

/// Holds the fit where samples leave it open, as on a line; far below the accuracy of the surface.
constexpr double kRidge = 1e-10;

Eigen::VectorXd sample_reach(const Grid& grid)
{
  Eigen::VectorXd result = Eigen::VectorXd::Zero(grid.points.cols());
  auto edge = [&](Eigen::Index a, Eigen::Index b)
  {
    const double length = kReach * (grid.points.col(a) - grid.points.col(b)).norm();
    result(a) = std::max(result(a), length);
    result(b) = std::max(result(b), length);
  };
  for (int j = 0; j < grid.count[1]; ++j)
  {
    for (int i = 0; i < grid.count[0]; ++i)
    {
      if (i + 1 < grid.count[0])
      {
        edge(grid.index(i, j), grid.index(i + 1, j));
      }
      if (j + 1 < grid.count[1])
      {
        edge(grid.index(i, j), grid.index(i, j + 1));
      }
    }
  }
  return result;
}

} // namespace

/// A height h(x, y) over a plane: h = c0 + c1 x + c2 y + c3 x² + c4 xy + c5 y².
struct SampledSurface::Fit
{
  Eigen::Matrix3d axes; ///< x, y and the normal of the plane
  Eigen::Matrix<double, 6, 1> height;
  double scale; ///< the largest reach
};

SampledSurface::SampledSurface(const Grid& grid)
  : Samples(grid)
  , Flat(fit_plane(grid.points))
{
  if (this->Flat.planar)
  {
    const Vector3 normal = this->Flat.normal;
    const Vector3 first =
      std::abs(normal(2)) == 1.0 ? Vector3(Vector3::UnitX()) : Vector3(normal.unitOrthogonal());
    this->FlatTangents << first, normal.cross(first);
    return;
  }
  this->Reach = sample_reach(grid);
  this->Nodes.push_back({ { { 0, grid.count[0], 0, grid.count[1] } }, {}, {}, 0 });
  this->build(0);
}

void SampledSurface::build(int node)
{
  const std::array<int, 4> range = this->Nodes[std::size_t(node)].range;
  Vector3 low = Vector3::Constant(std::numeric_limits<double>::infinity());
  Vector3 high = -low;
  const int wide = range[1] - range[0] >= range[3] - range[2] ? 0 : 2;
  if (range[1] - range[0] <= kLeaf && range[3] - range[2] <= kLeaf)
  {
    for (int j = range[2]; j < range[3]; ++j)
    {
      for (int i = range[0]; i < range[1]; ++i)
      {
        const Eigen::Index k = this->Samples.index(i, j);
        const Vector3 reach = Vector3::Constant(this->Reach(k));
        low = low.cwiseMin(this->Samples.points.col(k) - reach);
        high = high.cwiseMax(this->Samples.points.col(k) + reach);
      }
    }
  }
  else
  {
    const int first = int(this->Nodes.size());
    this->Nodes[std::size_t(node)].children = first;
    const int middle = (range[wide] + range[wide + 1]) / 2;
    for (int half = 0; half < 2; ++half)
    {
      Node child{ range, Vector3::Zero(), Vector3::Zero(), 0 };
      child.range[std::size_t(half == 0 ? wide + 1 : wide)] = middle;
      this->Nodes.push_back(child);
    }
    for (int half = 0; half < 2; ++half)
    {
      this->build(first + half);
      low = low.cwiseMin(this->Nodes[std::size_t(first + half)].low);
      high = high.cwiseMax(this->Nodes[std::size_t(first + half)].high);
    }
  }
  this->Nodes[std::size_t(node)].low = low;
  this->Nodes[std::size_t(node)].high = high;
}

void SampledSurface::gather(const Vector3& point, std::vector<Eigen::Index>& samples) const
{
  std::array<int, 64> stack;
  int depth = 0;
  stack[std::size_t(depth++)] = 0;
  while (depth > 0)
  {
    const Node& node = this->Nodes[std::size_t(stack[std::size_t(--depth)])];
    if ((point.array() < node.low.array()).any() || (point.array() > node.high.array()).any())
    {
      continue;
    }
    if (node.children > 0)
    {
      stack[std::size_t(depth++)] = node.children;
      stack[std::size_t(depth++)] = node.children + 1;
      continue;
    }
    for (int j = node.range[2]; j < node.range[3]; ++j)
    {
      for (int i = node.range[0]; i < node.range[1]; ++i)
      {
        const Eigen::Index k = this->Samples.index(i, j);
        if ((this->Samples.points.col(k) - point).norm() < this->Reach(k))
        {
          samples.push_back(k);
        }
      }
    }
  }
}

Vector3 SampledSurface::nearest_sample(const Vector3& point) const
{
  Eigen::Index nearest = 0;
  (this->Samples.points.colwise() - point).colwise().squaredNorm().minCoeff(&nearest);
  return this->Samples.points.col(nearest);
}

bool SampledSurface::fit(const Vector3& point, Fit& result) const
{
  thread_local std::vector<Eigen::Index> samples;
  samples.clear();
  this->gather(point, samples);
  if (samples.empty())
  {
    return false;
  }
  // === The plane: least spread of the weighted samples
  const Eigen::Index size = Eigen::Index(samples.size());
  Points offsets(3, size);
  Eigen::VectorXd weights(size);
  result.scale = 0.0;
  for (Eigen::Index k = 0; k < size; ++k)
  {
    const double reach = this->Reach(samples[std::size_t(k)]);
    offsets.col(k) = this->Samples.points.col(samples[std::size_t(k)]) - point;
    const double inside = 1.0 - offsets.col(k).squaredNorm() / (reach * reach);
    weights(k) = inside * inside * inside * inside;
    result.scale = std::max(result.scale, reach);
  }
  offsets /= result.scale;
  const Vector3 mean = offsets * weights / weights.sum();
  const Points spread = offsets.colwise() - mean;
  const Eigen::Matrix3d covariance = spread * weights.asDiagonal() * spread.transpose();
  const Eigen::Matrix3d axes =
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvectors();
  result.axes << axes.col(2), axes.col(1), axes.col(2).cross(axes.col(1));

  // === The heights above it
  Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 1> right = Eigen::Matrix<double, 6, 1>::Zero();
  for (Eigen::Index k = 0; k < size; ++k)
  {
    const Vector3 local = result.axes.transpose() * offsets.col(k);
    const double x = local(0);
    const double y = local(1);
    Eigen::Matrix<double, 6, 1> basis;
    basis << 1.0, x, y, x * x, x * y, y * y;
    normal += weights(k) * basis * basis.transpose();
    right += weights(k) * local(2) * basis;
  }
  normal.diagonal().tail<5>().array() += kRidge * normal.trace();
  result.height = normal.ldlt().solve(right);
  return true;
}

SurfacePlace SampledSurface::project(const Vector3& point) const
{
  if (this->Flat.planar)
  {
    return { point, this->FlatTangents, Eigen::Matrix2d::Zero() };
  }
  SurfacePlace place;
  place.point = point;
  Fit local;
  for (int k = 0; k < kProjections; ++k)
  {
    if (!this->fit(place.point, local))
    {
      place.point = this->nearest_sample(place.point);
      this->fit(place.point, local);
    }
    place.point += local.height(0) * local.scale * local.axes.col(2);
    if (std::abs(local.height(0)) <= kSettled)
    {
      break;
    }
  }
  // === Tangents L⁻¹ (x, y) with the metric L Lᵀ = 1 + g gᵀ of the gradient g
  const Eigen::Vector2d gradient = local.height.segment<2>(1);
  Eigen::Matrix2d second;
  second << 2.0 * local.height(3), local.height(4), local.height(4), 2.0 * local.height(5);
  Eigen::Matrix<double, 3, 2> slopes;
  slopes << Eigen::Matrix2d::Identity(), gradient.transpose();
  const Eigen::Matrix2d metric = slopes.transpose() * slopes;
  const Eigen::Matrix2d inverse = Eigen::Matrix2d(metric.llt().matrixL()).inverse();
  place.tangents = local.axes * slopes * inverse.transpose();
  place.curvature = inverse * second * inverse.transpose() /
    (std::sqrt(1.0 + gradient.squaredNorm()) * local.scale);
  return place;
}

} // namespace footpoint
