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

/// Reach of a sample in lengths of its edges: at a corner of the grid, where a quarter of the
/// samples is left, still more than the six that a quadratic takes.
constexpr double kReach = 3.5;

/// Least reach across, as a part of that along the longest edge: keeps the plane of the samples
/// well defined on thin cells of a curved surface, and where folded cells have no width.
constexpr double kWidth = 0.3;

/// Stands for edges of no length; far below what tells two points of a grid of unit size.
constexpr double kLeastEdge = 1e-100;

constexpr int kLeaf = 4; ///< samples along each direction of a leaf
constexpr int kProjections = 30;

/// Samples are gathered from so many times their reach, so that they serve for all steps of a
/// projection: those after the first are short.
constexpr double kMargin = 1.05;

constexpr double kSettled = 1e-14; ///< a projection is done, relative to the reach

/// Holds the fit where samples leave it open, as on a line; far below the accuracy of the surface.
constexpr double kRidge = 1e-10;

/// The longer of the two edges at a grid point along a direction.
Vector3 longest_edge(const Grid& grid, int i, int j, int direction)
{
  Vector3 result = Vector3::Zero();
  const int place = direction == 0 ? i : j;
  for (const int step : { -1, 1 })
  {
    if (place + step < 0 || place + step >= grid.count[std::size_t(direction)])
    {
      continue;
    }
    const Eigen::Index other = direction == 0 ? grid.index(i + step, j) : grid.index(i, j + step);
    const Vector3 edge = grid.points.col(other) - grid.points.col(grid.index(i, j));
    if (edge.squaredNorm() > result.squaredNorm())
    {
      result = edge;
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

/// The samples that may reach a point near `centre`, a row each.
struct SampledSurface::Neighbourhood
{
  Vector3 centre;
  std::vector<Eigen::Index> samples;
  Eigen::Array<double, Eigen::Dynamic, 3> offsets; ///< from the centre
  Eigen::Array<double, Eigen::Dynamic, 6> shape; ///< |A d|² as factors of x², y², z², xy, xz, yz
  double largest = 0.0;                          ///< reach
  double slack = 0.0; ///< no other sample reaches a point that is not farther from the centre

  bool fit(const Vector3& point, Fit& result) const;
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
  this->find_reach();
  this->Nodes.push_back(
    { { { 0, grid.count[0], 0, grid.count[1] } }, Vector3::Zero(), Vector3::Zero(), 0 });
  this->build(0);
}

void SampledSurface::find_reach()
{
  const Eigen::Index size = this->Samples.points.cols();
  this->Shape.resize(std::size_t(size));
  this->Extent.resize(3, size);
  this->Reach.resize(size);
  this->LeastReach = std::numeric_limits<double>::infinity();
  for (int j = 0; j < this->Samples.count[1]; ++j)
  {
    for (int i = 0; i < this->Samples.count[0]; ++i)
    {
      Eigen::Matrix<double, 3, 2> edges;
      edges << longest_edge(this->Samples, i, j, 0), longest_edge(this->Samples, i, j, 1);
      // A sample whose edges have no length reaches nothing but itself.
      const double longest = std::max(edges.colwise().norm().maxCoeff(), kLeastEdge);
      const double width = kWidth * longest;
      const Eigen::Matrix3d square =
        kReach * kReach * (edges * edges.transpose() + width * width * Eigen::Matrix3d::Identity());
      const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(square);
      const Eigen::Index k = this->Samples.index(i, j);
      this->Shape[std::size_t(k)] = axes.operatorInverseSqrt();
      this->Extent.col(k) = square.diagonal().cwiseSqrt();
      this->Reach(k) = std::sqrt(axes.eigenvalues()(2));
      this->LeastReach = std::min(this->LeastReach, kReach * width);
    }
  }
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
        const Vector3 reach = kMargin * this->Extent.col(k);
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

void SampledSurface::gather(const Vector3& point, Neighbourhood& near) const
{
  near.centre = point;
  near.samples.clear();
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
        const Vector3 offset = this->Samples.points.col(k) - point;
        if ((this->Shape[std::size_t(k)] * offset).squaredNorm() < kMargin * kMargin)
        {
          near.samples.push_back(k);
        }
      }
    }
  }
  const Eigen::Index size = Eigen::Index(near.samples.size());
  near.offsets.resize(size, 3);
  near.shape.resize(size, 6);
  near.largest = 0.0;
  for (Eigen::Index k = 0; k < size; ++k)
  {
    const Eigen::Index sample = near.samples[std::size_t(k)];
    near.offsets.row(k) = (this->Samples.points.col(sample) - point).transpose();
    const Eigen::Matrix3d& shape = this->Shape[std::size_t(sample)];
    const Eigen::Matrix3d square = shape * shape;
    near.shape.row(k) << square(0, 0), square(1, 1), square(2, 2), 2.0 * square(0, 1),
      2.0 * square(0, 2), 2.0 * square(1, 2);
    near.largest = std::max(near.largest, this->Reach(sample));
  }
  near.slack = (kMargin - 1.0) * this->LeastReach;
}

Vector3 SampledSurface::nearest_sample(const Vector3& point) const
{
  Eigen::Index nearest = 0;
  (this->Samples.points.colwise() - point).colwise().squaredNorm().minCoeff(&nearest);
  return this->Samples.points.col(nearest);
}

/// \return false where no sample reaches the point
bool SampledSurface::Neighbourhood::fit(const Vector3& point, Fit& result) const
{
  const Eigen::Index size = this->offsets.rows();
  result.scale = this->largest;
  thread_local Eigen::Matrix<double, Eigen::Dynamic, 3> local;
  thread_local Eigen::VectorXd weights;
  thread_local Eigen::Matrix<double, Eigen::Dynamic, 7> basis; // 1, x, y, x², xy, y², height
  thread_local Eigen::Matrix<double, Eigen::Dynamic, 6> weighted;
  local = this->offsets.matrix().rowwise() - (point - this->centre).transpose();
  const auto x = local.col(0).array();
  const auto y = local.col(1).array();
  const auto z = local.col(2).array();
  weights = (1.0 - x * (x * this->shape.col(0) + y * this->shape.col(3) + z * this->shape.col(4)) -
    y * (y * this->shape.col(1) + z * this->shape.col(5)) - z * z * this->shape.col(2))
              .max(0.0)
              .square()
              .square();
  const double total = weights.sum();
  if (size == 0 || total == 0.0)
  {
    return false;
  }
  local /= result.scale;

  // === The plane: least spread of the weighted samples
  const Eigen::RowVector3d mean = weights.transpose() * local / total;
  const Eigen::Matrix3d covariance =
    local.transpose() * weights.asDiagonal() * local - total * mean.transpose() * mean;
  const Eigen::Matrix3d axes =
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvectors();
  result.axes << axes.col(2), axes.col(1), axes.col(2).cross(axes.col(1));

  // === The heights above it
  basis.resize(size, 7);
  basis.col(0).setOnes();
  basis.middleCols<2>(1).noalias() = local * result.axes.leftCols<2>();
  basis.col(6).noalias() = local * result.axes.col(2);
  basis.col(3) = basis.col(1).cwiseAbs2();
  basis.col(4) = basis.col(1).cwiseProduct(basis.col(2));
  basis.col(5) = basis.col(2).cwiseAbs2();
  weighted = weights.asDiagonal() * basis.leftCols<6>();
  const Eigen::Matrix<double, 6, 7> system = weighted.transpose() * basis;
  Eigen::Matrix<double, 6, 6> normal = system.leftCols<6>();
  normal.diagonal().tail<5>().array() += kRidge * normal.trace();
  result.height = normal.ldlt().solve(system.col(6));
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
  thread_local Neighbourhood near;
  this->gather(place.point, near);
  for (int k = 0; k < kProjections; ++k)
  {
    if ((place.point - near.centre).norm() > near.slack)
    {
      this->gather(place.point, near);
    }
    if (!near.fit(place.point, local))
    {
      place.point = this->nearest_sample(place.point);
      this->gather(place.point, near);
      near.fit(place.point, local);
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
