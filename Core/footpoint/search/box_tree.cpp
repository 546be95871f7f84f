// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/search/box_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

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
  Builder(const std::vector<Corners>& boxes, AlignedVector<BoxTree::Node>& nodes)
    : Boxes(boxes)
    , Nodes(nodes)
  {
    this->Order.reserve(boxes.size());
    for (const Corners& box : boxes)
    {
      this->Order.push_back(
        { (box[0] + box[1]).cast<float>(), static_cast<std::int32_t>(this->Order.size()) });
    }
  }

  std::int32_t build(std::size_t begin, std::size_t end);

private:
  struct Range
  {
    std::size_t begin;
    std::size_t end;
  };
  /// A box, by its middle (twice); precise enough to put them into an order.
  struct Item
  {
    Eigen::Vector3f middle;
    std::int32_t box;
  };

  /// Two parts along the axis in which the middles of the boxes spread most, as even as they come in
  /// multiples of a number of boxes.
  std::array<Range, 2> split(Range range, std::size_t multiple);

  const std::vector<Corners>& Boxes;
  AlignedVector<BoxTree::Node>& Nodes;
  std::vector<Item> Order;
};

std::array<Builder::Range, 2> Builder::split(Range range, std::size_t multiple)
{
  Eigen::Array3f lower = Eigen::Array3f::Constant(std::numeric_limits<float>::infinity());
  Eigen::Array3f upper = -lower;
  for (std::size_t k = range.begin; k < range.end; ++k)
  {
    lower = lower.min(this->Order[k].middle.array());
    upper = upper.max(this->Order[k].middle.array());
  }
  int axis = 0;
  (upper - lower).maxCoeff(&axis);
  const auto first = this->Order.begin();
  const std::size_t multiples = (range.end - range.begin + multiple - 1) / multiple;
  const std::size_t half = range.begin + multiples / 2 * multiple;
  std::nth_element(first + range.begin, first + half, first + range.end,
    [axis](const Item& a, const Item& b)
    {
      const float at_a = a.middle(axis);
      const float at_b = b.middle(axis);
      return at_a != at_b ? at_a < at_b : a.box < b.box;
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
    if (k < static_cast<int>(ranges.size()))
    {
      const Range& range = ranges[k];
      upper = -lower;
      for (std::size_t i = range.begin; i < range.end; ++i)
      {
        lower = lower.cwiseMin(this->Boxes[this->Order[i].box][0]);
        upper = upper.cwiseMax(this->Boxes[this->Order[i].box][1]);
      }
      child = range.end - range.begin == 1 ? -1 - this->Order[range.begin].box
                                           : this->build(range.begin, range.end);
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
    this->Nodes.reserve(boxes.size() / 8 + 8);
    Builder(boxes, this->Nodes).build(0, boxes.size());
  }
}

} // namespace footpoint
