// SPDX-License-Identifier: BSD-3-Clause

#include "SampleTree.h"

#include <algorithm>
#include <numeric>

namespace oracle
{

SampleTree::SampleTree(std::vector<Eigen::Vector3d> samples)
  : Samples(std::move(samples))
  , Order(this->Samples.size())
  , Axes(this->Samples.size(), 0)
{
  std::iota(this->Order.begin(), this->Order.end(), std::size_t{ 0 });
  this->build(0, this->Order.size());
}

std::vector<std::size_t> SampleTree::nearest(const Eigen::Vector3d& point, std::size_t count) const
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

void SampleTree::build(std::size_t begin, std::size_t end)
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
    [&](std::size_t a, std::size_t b) { return this->Samples[a](axis) < this->Samples[b](axis); });
  this->Axes[middle] = static_cast<char>(axis);
  this->build(begin, middle);
  this->build(middle + 1, end);
}

void SampleTree::search(std::size_t begin, std::size_t end, const Eigen::Vector3d& point,
  std::size_t count, Best& best) const
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

} // namespace oracle
