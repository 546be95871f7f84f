// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/search/box_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace footpoint
{
namespace
{

/// The largest number in single precision that is not above a number.
float rounded_down(double value)
{
  const auto rounded = static_cast<float>(value);
  return rounded > value ? std::nextafter(rounded, -std::numeric_limits<float>::infinity())
                         : rounded;
}

/// Boxes, each some tenths of a microsecond of work, from which on they are shared out among
/// threads.
constexpr std::size_t kBoxesForThreads = 8192;

/// Builds nodes over ranges of an order of boxes.
class Builder
{
public:
  explicit Builder(const AlignedVector<Corners>& boxes)
    : Boxes(boxes)
  {
    this->Order.reserve(boxes.size());
    for (const Corners& box : boxes)
    {
      this->Order.push_back(
        { (box[0] + box[1]).cast<float>(), static_cast<std::int32_t>(this->Order.size()) });
    }
  }

  /// The whole tree: its children are built by themselves and put behind the root, as if one after
  /// the other.
  AlignedVector<BoxTree::Node> build(const Execution& execution);

private:
  struct Range
  {
    std::size_t begin;
    std::size_t end;

    std::size_t size() const { return this->end - this->begin; }
  };
  /// A box, by its middle (twice); precise enough to put them into an order.
  struct Item
  {
    Eigen::Vector3f middle;
    std::int32_t box;
  };

  /// Two parts along the axis in which the middles of the boxes spread most, as even as they come
  /// in multiples of a number of boxes.
  std::array<Range, 2> split(Range range, std::size_t multiple);
  /// What the children of a node hold.
  std::vector<Range> children(Range range);
  /// Adds a node, and those below it behind it.
  std::int32_t add(Range range, AlignedVector<BoxTree::Node>& nodes);
  std::int32_t add_empty(AlignedVector<BoxTree::Node>& nodes) const;
  void set_child(BoxTree::Node& node, int k, Range range, std::int32_t child) const;

  const AlignedVector<Corners>& Boxes;
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

std::vector<Builder::Range> Builder::children(Range range)
{
  // Full trees of as few levels as there can be, but for the last one: few nodes, full ones.
  std::size_t full = 1;
  while (full * BoxTree::kWidth < range.size())
  {
    full *= BoxTree::kWidth;
  }
  std::vector<Range> ranges{ range };
  for (int parts = 1; parts < BoxTree::kWidth; parts *= 2)
  {
    std::vector<Range> next;
    for (const Range& each : ranges)
    {
      if (each.size() <= full)
      {
        next.push_back(each);
        continue;
      }
      for (const Range& half : this->split(each, full))
      {
        next.push_back(half);
      }
    }
    ranges = std::move(next);
  }
  return ranges;
}

std::int32_t Builder::add_empty(AlignedVector<BoxTree::Node>& nodes) const
{
  constexpr float kNowhere = std::numeric_limits<float>::infinity();
  const auto index = static_cast<std::int32_t>(nodes.size());
  nodes.emplace_back();
  BoxTree::Node& node = nodes.back();
  std::fill_n(node.lower[0], 3 * BoxTree::kWidth, kNowhere);
  std::fill_n(node.upper[0], 3 * BoxTree::kWidth, kNowhere);
  std::fill_n(node.child, BoxTree::kWidth, 0);
  node.present = 0;
  return index;
}

void Builder::set_child(BoxTree::Node& node, int k, Range range, std::int32_t child) const
{
  Vector3 lower = Vector3::Constant(std::numeric_limits<double>::infinity());
  Vector3 upper = -lower;
  for (std::size_t i = range.begin; i < range.end; ++i)
  {
    lower = lower.cwiseMin(this->Boxes[this->Order[i].box][0]);
    upper = upper.cwiseMax(this->Boxes[this->Order[i].box][1]);
  }
  for (int i = 0; i < 3; ++i)
  {
    node.lower[i][k] = rounded_down(lower(i));
    node.upper[i][k] = -rounded_down(-upper(i));
  }
  node.child[k] = range.size() == 1 ? -1 - this->Order[range.begin].box : child;
  node.present |= 1U << k;
}

std::int32_t Builder::add(Range range, AlignedVector<BoxTree::Node>& nodes)
{
  const std::vector<Range> ranges = this->children(range);
  const std::int32_t index = this->add_empty(nodes);
  for (std::size_t k = 0; k < ranges.size(); ++k)
  {
    const std::int32_t child = ranges[k].size() == 1 ? 0 : this->add(ranges[k], nodes);
    this->set_child(nodes[index], static_cast<int>(k), ranges[k], child);
  }
  return index;
}

AlignedVector<BoxTree::Node> Builder::build(const Execution& execution)
{
  const Range all{ 0, this->Order.size() };
  const std::vector<Range> ranges = this->children(all);
  const auto count = static_cast<std::int64_t>(ranges.size());
  std::vector<AlignedVector<BoxTree::Node>> below(ranges.size());
  AlignedVector<BoxTree::Node> nodes;
  nodes.reserve(all.size() / 8 + 8);
  this->add_empty(nodes);
  BoxTree::Node root = nodes.front();
  for_each_index(execution, count, all.size() < kBoxesForThreads ? count + 1 : 0,
    [&](std::int64_t k)
    {
      if (ranges[k].size() > 1)
      {
        below[k].reserve(ranges[k].size() / 8 + 8);
        this->add(ranges[k], below[k]);
      }
    });
  for (std::size_t k = 0; k < ranges.size(); ++k)
  {
    const auto first = static_cast<std::int32_t>(nodes.size());
    this->set_child(root, static_cast<int>(k), ranges[k], first);
    for (BoxTree::Node& node : below[k])
    {
      for (std::int32_t& child : node.child)
      {
        child += child > 0 ? first : 0;
      }
    }
    nodes.insert(nodes.end(), below[k].begin(), below[k].end());
  }
  nodes.front() = root;
  return nodes;
}

} // namespace

BoxTree::BoxTree(const AlignedVector<Corners>& boxes, const Execution& execution)
{
  if (!boxes.empty())
  {
    this->Nodes = Builder(boxes).build(execution);
  }
}

} // namespace footpoint
