// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// The nearest of many samples: a k-d tree over points, for oracles that start from samples.

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace oracle
{

class SampleTree
{
public:
  SampleTree() = default;
  explicit SampleTree(std::vector<Eigen::Vector3d> samples)
    : Samples(std::move(samples))
    , Order(this->Samples.size())
    , Axes(this->Samples.size(), 0)
  {
    std::iota(this->Order.begin(), this->Order.end(), std::size_t{ 0 });
    this->build(0, this->Order.size());
  }

  bool empty() const { return this->Order.empty(); }

  /// Numbers of the nearest samples, nearest first.
  std::vector<std::size_t> nearest(const Eigen::Vector3d& point, std::size_t count) const
  {
    Best best;
    this->search(0, this->Order.size(), point, count, best);
    std::sort_heap(best.begin(), best.end());
    std::vector<std::size_t> result;
    for (const auto& one : best)
    {
      result.push_back(one.second);
    }
    return result;
  }

private:
  /// A heap, farthest on top: squared distance and number.
  using Best = std::vector<std::pair<double, std::size_t>>;

  void build(std::size_t begin, std::size_t end)
  {
    if (end - begin < 2)
    {
      return;
    }
    Eigen::Vector3d low = this->Samples[this->Order[begin]];
    Eigen::Vector3d high = low;
    for (std::size_t k = begin; k < end; ++k)
    {
      low = low.cwiseMin(this->Samples[this->Order[k]]);
      high = high.cwiseMax(this->Samples[this->Order[k]]);
    }
    Eigen::Index axis = 0;
    (high - low).maxCoeff(&axis);
    const std::size_t middle = begin + (end - begin) / 2;
    const auto first = this->Order.begin();
    std::nth_element(first + static_cast<std::ptrdiff_t>(begin),
      first + static_cast<std::ptrdiff_t>(middle), first + static_cast<std::ptrdiff_t>(end),
      [&](std::size_t a, std::size_t b)
      { return this->Samples[a](axis) < this->Samples[b](axis); });
    this->Axes[middle] = static_cast<char>(axis);
    this->build(begin, middle);
    this->build(middle + 1, end);
  }

  void search(std::size_t begin, std::size_t end, const Eigen::Vector3d& point, std::size_t count,
    Best& best) const
  {
    if (begin == end)
    {
      return;
    }
    const std::size_t middle = begin + (end - begin) / 2;
    const std::size_t number = this->Order[middle];
    const double distance = (this->Samples[number] - point).squaredNorm();
    if (best.size() < count || distance < best.front().first)
    {
      if (best.size() == count)
      {
        std::pop_heap(best.begin(), best.end());
        best.pop_back();
      }
      best.emplace_back(distance, number);
      std::push_heap(best.begin(), best.end());
    }
    if (end - begin == 1)
    {
      return;
    }
    const int axis = this->Axes[middle];
    const double apart = point(axis) - this->Samples[number](axis);
    const bool below = apart < 0.0;
    this->search(below ? begin : middle + 1, below ? middle : end, point, count, best);
    if (best.size() < count || apart * apart < best.front().first)
    {
      this->search(below ? middle + 1 : begin, below ? end : middle, point, count, best);
    }
  }

  std::vector<Eigen::Vector3d> Samples;
  std::vector<std::size_t> Order; ///< the middle of a range is its node
  std::vector<char> Axes;
};

} // namespace oracle
