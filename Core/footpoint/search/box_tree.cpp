// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/search/box_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace footpoint
{
namespace
{

using Corners = std::array<Vector3, 2>;

/// The largest number in single precision that is not above a number.
float rounded_down(double value)
{
  const auto rounded = static_cast<float>(value);
  return rounded > value ? std::nextafter(rounded, -std::numeric_limits<float>::infinity())
                         : rounded;
}

/// Builds nodes over ranges of an order of boxes.
class Builder
{
public:
  Builder(const std::vector<Corners>& boxes, std::vector<BoxTree::Node>& nodes)
    : Boxes(boxes)
    , Nodes(nodes)
    , Order(boxes.size())
  {
    std::iota(this->Order.begin(), this->Order.end(), 0);
  }

  std::int32_t build(std::size_t begin, std::size_t end);

private:
  struct Range
  {
    std::size_t begin;
    std::size_t end;
  };

  /// Two parts along the axis in which the middles of the boxes spread most, as even as they come in
  /// multiples of a number of boxes.
  std::array<Range, 2> split(Range range, std::size_t multiple);

  const std::vector<Corners>& Boxes;
  std::vector<BoxTree::Node>& Nodes;
  std::vector<std::int32_t> Order;
};

std::array<Builder::Range, 2> Builder::split(Range range, std::size_t multiple)
{
  Vector3 lower = Vector3::Constant(std::numeric_limits<double>::infinity());
  Vector3 upper = -lower;
  auto middle = [&](std::int32_t k) { return Vector3(this->Boxes[k][0] + this->Boxes[k][1]); };
  for (std::size_t k = range.begin; k < range.end; ++k)
  {
    lower = lower.cwiseMin(middle(this->Order[k]));
    upper = upper.cwiseMax(middle(this->Order[k]));
  }
  int axis = 0;
  (upper - lower).maxCoeff(&axis);
  const auto first = this->Order.begin();
  const std::size_t multiples = (range.end - range.begin + multiple - 1) / multiple;
  const std::size_t half = range.begin + multiples / 2 * multiple;
  std::nth_element(first + range.begin, first + half, first + range.end,
    [&](std::int32_t a, std::int32_t b)
    {
      const double at_a = this->Boxes[a][0](axis) + this->Boxes[a][1](axis);
      const double at_b = this->Boxes[b][0](axis) + this->Boxes[b][1](axis);
      return at_a != at_b ? at_a < at_b : a < b;
    });
  return { { { range.begin, half }, { half, range.end } } };
}

std::int32_t Builder::build(std::size_t begin, std::size_t end)
{
  // Children are full trees of as few levels as there can be, but for the last one: few nodes, full ones.
  std::size_t full = 1;
  while (full * BoxTree::kWidth < end - begin)
  {
    full *= BoxTree::kWidth;
  }
  std::vector<Range> ranges{ { begin, end } };
  for (int parts = 1; parts < BoxTree::kWidth; parts *= 2)
  {
    std::vector<Range> next;
    for (const Range& range : ranges)
    {
      if (range.end - range.begin <= full)
      {
        next.push_back(range);
        continue;
      }
      for (const Range& half : this->split(range, full))
      {
        next.push_back(half);
      }
    }
    ranges = std::move(next);
  }
  const auto index = static_cast<std::int32_t>(this->Nodes.size());
  this->Nodes.emplace_back();
  for (int k = 0; k < BoxTree::kWidth; ++k)
  {
    Vector3 lower = Vector3::Constant(std::numeric_limits<double>::infinity());
    Vector3 upper = lower;
    std::int32_t child = 0;
    if (k < static_cast<int>(ranges.size()) && ranges[k].begin < ranges[k].end)
    {
      upper = -lower;
      for (std::size_t i = ranges[k].begin; i < ranges[k].end; ++i)
      {
        lower = lower.cwiseMin(this->Boxes[this->Order[i]][0]);
        upper = upper.cwiseMax(this->Boxes[this->Order[i]][1]);
      }
      child = ranges[k].end - ranges[k].begin == 1 ? -1 - this->Order[ranges[k].begin]
                                                   : this->build(ranges[k].begin, ranges[k].end);
    }
    BoxTree::Node& node = this->Nodes[index];
    for (int i = 0; i < 3; ++i)
    {
      node.lower[i][k] = rounded_down(lower(i));
      node.upper[i][k] = -rounded_down(-upper(i));
    }
    node.child[k] = child;
    node.present |= child != 0 ? 1U << k : 0U;
  }
  return index;
}

} // namespace

BoxTree::BoxTree(const std::vector<Corners>& boxes)
{
  if (!boxes.empty())
  {
    this->Nodes.reserve(boxes.size() / 6 + 8);
    Builder(boxes, this->Nodes).build(0, boxes.size());
  }
}

} // namespace footpoint
