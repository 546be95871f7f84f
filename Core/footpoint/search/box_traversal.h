// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/search/box_tree.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace footpoint
{

/// A lower bound of the distance of a point from a box, rounding included.
inline double box_distance(const Vector3& lower, const Vector3& upper, const Vector3& point)
{
  constexpr double kMargin = 32.0 * 0x1p-53;
  return (lower - point).cwiseMax(point - upper).cwiseMax(0.0).norm() * (1.0 - kMargin);
}

/// Visits the boxes of a tree whose bound does not exceed limit(), near ones first.
/// \param bound double(const Vector3& lower, const Vector3& upper): what is sought in the box is no
///              nearer than that
/// \param limit double(); visits may lower it
/// \param visit void(std::int32_t box)
template <typename Bound, typename Limit, typename Visit>
void visit_boxes(const BoxTree& tree, const Bound& bound, const Limit& limit, const Visit& visit)
{
  using Entry = std::pair<double, std::int32_t>;
  if (tree.nodes().empty())
  {
    return;
  }
  std::vector<Entry> stack{ { 0.0, 0 } };
  while (!stack.empty())
  {
    const auto [nearest, index] = stack.back();
    stack.pop_back();
    if (nearest > limit())
    {
      continue;
    }
    if (index < 0)
    {
      visit(-1 - index);
      continue;
    }
    const BoxTree::Node& node = tree.nodes()[index];
    const std::size_t first = stack.size();
    for (int k = 0; k < BoxTree::kWidth; ++k)
    {
      if (node.child[k] == 0)
      {
        continue; // the root is no child: there is none here
      }
      const Vector3 lower(node.lower[0][k], node.lower[1][k], node.lower[2][k]);
      const Vector3 upper(node.upper[0][k], node.upper[1][k], node.upper[2][k]);
      stack.emplace_back(bound(lower, upper), node.child[k]);
    }
    // The nearest on top; equal ones in the order of their numbers.
    std::sort(
      stack.begin() + first, stack.end(), [](const Entry& a, const Entry& b) { return a > b; });
  }
}

/// The same with the distance of the boxes from a point.
template <typename Limit, typename Visit>
void visit_near_boxes(
  const BoxTree& tree, const Vector3& point, const Limit& limit, const Visit& visit)
{
  visit_boxes(
    tree,
    [&point](const Vector3& lower, const Vector3& upper)
    { return box_distance(lower, upper, point); },
    limit, visit);
}

} // namespace footpoint
