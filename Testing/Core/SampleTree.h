// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// The nearest of many samples: a k-d tree over points, for oracles that start from samples.

#include <Eigen/Core>

#include <cstddef>
#include <utility>
#include <vector>

namespace oracle
{

class SampleTree
{
public:
  SampleTree() = default;
  explicit SampleTree(std::vector<Eigen::Vector3d> samples);

  bool empty() const { return this->Order.empty(); }

  /// Numbers of the nearest samples, nearest first.
  std::vector<std::size_t> nearest(const Eigen::Vector3d& point, std::size_t count) const;

private:
  /// A heap, farthest on top: squared distance and number.
  using Best = std::vector<std::pair<double, std::size_t>>;

  void build(std::size_t begin, std::size_t end);

  void search(std::size_t begin, std::size_t end, const Eigen::Vector3d& point, std::size_t count,
    Best& best) const;

  std::vector<Eigen::Vector3d> Samples;
  std::vector<std::size_t> Order; ///< the middle of a range is its node
  std::vector<char> Axes;
};

} // namespace oracle
