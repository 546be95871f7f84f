// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/splines/parametric_geometry.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace footpoint
{

/// An axis-parallel box, in the geometry's local coordinates.
struct Box
{
  Vector3 lower = Vector3::Constant(std::numeric_limits<double>::infinity());
  Vector3 upper = Vector3::Constant(-std::numeric_limits<double>::infinity());

  void add(const Box& other)
  {
    this->lower = this->lower.cwiseMin(other.lower);
    this->upper = this->upper.cwiseMax(other.upper);
  }

  /// Distance of a point from the box, 0 inside.
  double distance(const Vector3& point) const
  {
    return (this->lower - point).cwiseMax(point - this->upper).cwiseMax(0.0).norm();
  }
};

/// The Bézier pieces of a curve or surface, split further where there are few of them or they bend,
/// and those sides and corners of theirs that bound the geometry, in a hierarchy of the boxes of
/// their control points: no point of a cell lies outside its box.
///
/// Built once; const and thread-safe.
template <int N>
class CellTree
{
public:
  /// \param minimum_cells pieces are halved until there are about as many; the finer, the closer
  ///                      the boxes and the fewer descents a query takes
  /// Geometry that is no spline has no boxes: the tree is then empty.
  CellTree(const ParametricGeometry<N>& geometry, int minimum_cells);

  bool empty() const { return this->Cells.empty(); }
  /// The box of the whole. \pre not empty
  const Box& box() const { return this->Nodes.front().box; }

  /// Calls visit(start, reach) for the cells whose bound does not exceed limit(), near ones first:
  /// where to start from in local parameters, and how far the piece reaches that the cell belongs
  /// to. Either callable may change what the other will say. \param bound double(const Box&): what
  /// is sought in the box is no nearer than that
  template <typename Bound, typename Limit, typename Visit>
  void traverse(const Bound& bound, const Limit& limit, const Visit& visit) const
  {
    if (this->empty())
    {
      return;
    }
    // A hierarchy of n cells is log2 n deep and leaves one sibling a level behind.
    std::array<std::pair<double, std::int32_t>, 64> stack;
    int top = 0;
    stack[top++] = { bound(this->Nodes[0].box), 0 };
    while (top > 0)
    {
      const auto [nearest, index] = stack[--top];
      if (nearest > limit())
      {
        continue;
      }
      const Node& node = this->Nodes[index];
      if (node.cell >= 0)
      {
        visit(this->Cells[node.cell].at, this->Cells[node.cell].reach);
        continue;
      }
      std::pair<double, std::int32_t> near = { bound(this->Nodes[node.first].box), node.first };
      std::pair<double, std::int32_t> far = { bound(this->Nodes[node.second].box), node.second };
      if (far.first < near.first)
      {
        std::swap(near, far);
      }
      stack[top++] = far;
      stack[top++] = near;
    }
  }

private:
  struct Node
  {
    Box box;
    std::int32_t first = -1; ///< children, where cell < 0
    std::int32_t second = -1;
    std::int32_t cell = -1;
  };

  std::int32_t build(std::vector<std::int32_t>& order, std::size_t begin, std::size_t end,
    const std::vector<Box>& boxes);

  struct Start
  {
    Parameter<N> at;
    double reach; ///< diagonal of the piece's box
  };

  std::vector<Start> Cells;
  std::vector<Node> Nodes; ///< the first is the root
};

} // namespace footpoint
