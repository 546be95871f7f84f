// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/search/cell_tree.h"

#include "footpoint/splines/bezier.h"

#include <numeric>

namespace footpoint
{
namespace
{

/// The Bézier pieces of a geometry that is a spline; none of another.
std::vector<BezierPiece<1>> pieces_of(const ParametricCurve& geometry)
{
  const auto* curve = dynamic_cast<const Curve*>(&geometry);
  return curve ? extract_bezier(*curve) : std::vector<BezierPiece<1>>{};
}

std::vector<BezierPiece<2>> pieces_of(const ParametricSurface& geometry)
{
  const auto* surface = dynamic_cast<const Surface*>(&geometry);
  return surface ? extract_bezier(*surface) : std::vector<BezierPiece<2>>{};
}

/// All pieces halved in every direction.
template <int N>
std::vector<BezierPiece<N>> halve_all(std::vector<BezierPiece<N>> pieces)
{
  for (int i = 0; i < N; ++i)
  {
    std::vector<BezierPiece<N>> halves;
    halves.reserve(2 * pieces.size());
    for (const BezierPiece<N>& piece : pieces)
    {
      for (BezierPiece<N>& half : halve<N>(piece, i))
      {
        halves.push_back(std::move(half));
      }
    }
    pieces = std::move(halves);
  }
  return pieces;
}

} // namespace

template <int N>
CellTree<N>::CellTree(const ParametricGeometry<N>& geometry, int minimum_cells)
{
  std::vector<BezierPiece<N>> pieces = pieces_of(geometry);
  if (pieces.empty())
  {
    return;
  }
  while (pieces.size() < static_cast<std::size_t>(minimum_cells))
  {
    pieces = halve_all<N>(std::move(pieces));
  }
  std::vector<Box> boxes;
  // Rounding of the extraction: the boxes have to hold the surface as it is evaluated.
  const Vector3 margin = Vector3::Constant(1e-13 * geometry.size());
  for (const BezierPiece<N>& piece : pieces)
  {
    const std::array<Vector3, 2> corners = bounding_box<N>(piece);
    boxes.push_back({ corners[0] - margin, corners[1] + margin });
    this->Cells.push_back(0.5 * (piece.lower + piece.upper));
  }
  std::vector<std::int32_t> order(pieces.size());
  std::iota(order.begin(), order.end(), 0);
  this->Nodes.reserve(2 * pieces.size());
  this->build(order, 0, order.size(), boxes);
}

template <int N>
std::int32_t CellTree<N>::build(std::vector<std::int32_t>& order, std::size_t begin, std::size_t end,
  const std::vector<Box>& boxes)
{
  const auto index = static_cast<std::int32_t>(this->Nodes.size());
  this->Nodes.emplace_back();
  Box box;
  for (std::size_t k = begin; k < end; ++k)
  {
    box.add(boxes[order[k]]);
  }
  this->Nodes[index].box = box;
  if (end - begin == 1)
  {
    this->Nodes[index].cell = order[begin];
    return index;
  }
  int axis = 0;
  (box.upper - box.lower).maxCoeff(&axis);
  const std::size_t middle = begin + (end - begin) / 2;
  auto middle_of = [&](std::int32_t k) { return boxes[k].lower(axis) + boxes[k].upper(axis); };
  std::nth_element(order.begin() + begin, order.begin() + middle, order.begin() + end,
    [&](std::int32_t a, std::int32_t b)
    { return middle_of(a) != middle_of(b) ? middle_of(a) < middle_of(b) : a < b; });
  const std::int32_t first = this->build(order, begin, middle, boxes);
  const std::int32_t second = this->build(order, middle, end, boxes);
  this->Nodes[index].first = first;
  this->Nodes[index].second = second;
  return index;
}

template class CellTree<1>;
template class CellTree<2>;

} // namespace footpoint
