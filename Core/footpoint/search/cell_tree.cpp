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

/// A cell is simple where the legs of its control net point the same way within about 37°: the
/// surface then bends little over the cell, and one descent finds what there is to be found. Legs
/// shorter than a part of the cell do not count, nor do cells smaller than a part of the whole.
/// Where steep weights put much of the surface into few parameters, cells are cut until they are no
/// large part of it.
constexpr double kSimpleCosine = 0.8;
constexpr double kShortLeg = 1e-2;
constexpr double kSmallCell = 1e-3;
constexpr double kLargeCell = 0.1;

/// Cells that refinement may make of one.
constexpr std::size_t kRefinement = 8;

template <int N>
double diagonal(const BezierPiece<N>& piece)
{
  const std::array<Vector3, 2> corners = bounding_box<N>(piece);
  return (corners[1] - corners[0]).norm();
}

/// How a piece runs along direction i: the smallest cosine between a leg of the control net and
/// their sum, and the mean length of its rows.
struct Run
{
  double straightness = 1.0;
  double length = 0.0;
};

template <int N>
Run run_along(const BezierPiece<N>& piece, int i, double cell)
{
  const Eigen::Index stride = i == 0 ? 1 : piece.degree[0] + 1;
  const int other = piece.degree[N - 1 - i];
  std::vector<Vector3> legs;
  Vector3 sum = Vector3::Zero();
  double length = 0.0;
  for (Eigen::Index k = 0; k < piece.control.cols(); ++k)
  {
    if ((k / stride) % (piece.degree[i] + 1) < piece.degree[i])
    {
      const Vector3 leg =
        piece.control.col(k + stride).hnormalized() - piece.control.col(k).hnormalized();
      sum += leg;
      length += leg.norm();
      if (leg.norm() > kShortLeg * cell)
      {
        legs.push_back(leg.normalized());
      }
    }
  }
  Run run;
  run.length = N == 1 ? length : length / (other + 1);
  for (const Vector3& leg : legs)
  {
    run.straightness = std::min(run.straightness, leg.dot(sum.stableNormalized()));
  }
  return run;
}

/// Halves what is not simple, in the direction that bends more, until all is or the limit is
/// reached.
template <int N>
std::vector<BezierPiece<N>> refine(std::vector<BezierPiece<N>> pieces, double size)
{
  const std::size_t limit = kRefinement * pieces.size();
  std::vector<BezierPiece<N>> simple;
  while (!pieces.empty() && simple.size() + pieces.size() < limit)
  {
    std::vector<BezierPiece<N>> halves;
    for (BezierPiece<N>& piece : pieces)
    {
      const double cell = diagonal<N>(piece);
      std::array<Run, 2> runs;
      for (int i = 0; i < N; ++i)
      {
        runs[i] = run_along<N>(piece, i, cell);
      }
      const bool straight = std::min(runs[0].straightness, runs[1].straightness) >= kSimpleCosine;
      if (cell <= kSmallCell * size || (straight && cell <= kLargeCell * size))
      {
        simple.push_back(std::move(piece));
        continue;
      }
      const bool second =
        straight ? runs[1].length > runs[0].length : runs[1].straightness < runs[0].straightness;
      for (BezierPiece<N>& half : halve<N>(piece, second ? 1 : 0))
      {
        halves.push_back(std::move(half));
      }
    }
    pieces = std::move(halves);
  }
  simple.insert(simple.end(), pieces.begin(), pieces.end());
  return simple;
}

/// Whether a local parameter is an open end of its direction or the side of a gap.
bool bounds(const Direction& direction, double t)
{
  if (t == 0.0 || t == direction.length)
  {
    return !direction.closed;
  }
  return std::any_of(direction.breaks.begin(), direction.breaks.end(),
    [t](const Break& line) { return line.gap && line.at == t; });
}

/// The start of a descent and the box of what it stands for.
template <int N>
struct Cell
{
  Parameter<N> start;
  Box box;
  double reach; ///< diagonal of the piece
};

/// The box of the control points of a piece, or of those on its borders: border(i) is −1 on the
/// lower one, 1 on the upper one, 0 on none.
template <int N>
Cell<N> make_cell(
  const BezierPiece<N>& piece, const Eigen::Matrix<int, N, 1>& border, double margin)
{
  /// A start on a border is moved inside by this part of the piece: there the sides of a gap
  /// differ.
  constexpr double kInside = 1e-3;
  Cell<N> cell;
  for (int i = 0; i < N; ++i)
  {
    const double fraction = 0.5 + (0.5 - kInside) * border(i);
    cell.start(i) = piece.lower(i) + fraction * (piece.upper(i) - piece.lower(i));
  }
  for (Eigen::Index k = 0; k < piece.control.cols(); ++k)
  {
    bool on_border = true;
    Eigen::Index rest = k;
    for (int i = 0; i < N; ++i)
    {
      const Eigen::Index at = rest % (piece.degree[i] + 1);
      rest /= piece.degree[i] + 1;
      on_border = on_border && (border(i) == 0 || at == (border(i) < 0 ? 0 : piece.degree[i]));
    }
    if (on_border)
    {
      const Vector3 point = piece.control.col(k).hnormalized();
      cell.box.add({ point, point });
    }
  }
  cell.reach = diagonal<N>(piece);
  cell.box.lower.array() -= margin;
  cell.box.upper.array() += margin;
  return cell;
}

/// The cell of a piece, and those of its sides and corners that bound the geometry: minima on the
/// boundary are not always downhill from inside.
template <int N>
void append_cells(
  const BezierPiece<N>& piece, const ParametricGeometry<N>& geometry, std::vector<Cell<N>>& cells)
{
  // Rounding of the extraction: the boxes have to hold the surface as it is evaluated.
  const double margin = 1e-13 * geometry.size();
  std::vector<Eigen::Matrix<int, N, 1>> borders{ Eigen::Matrix<int, N, 1>::Zero() };
  for (int i = 0; i < N; ++i)
  {
    const std::size_t count = borders.size();
    for (const int end : { -1, 1 })
    {
      const bool bound = bounds(geometry.direction(i), end < 0 ? piece.lower(i) : piece.upper(i));
      for (std::size_t k = 0; k < count && bound; ++k)
      {
        borders.push_back(borders[k]);
        borders.back()(i) = end;
      }
    }
  }
  for (const Eigen::Matrix<int, N, 1>& border : borders)
  {
    cells.push_back(make_cell<N>(piece, border, margin));
  }
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
  std::vector<Cell<N>> cells;
  for (const BezierPiece<N>& piece : refine<N>(std::move(pieces), geometry.size()))
  {
    append_cells<N>(piece, geometry, cells);
  }
  std::vector<Box> boxes;
  for (const Cell<N>& cell : cells)
  {
    boxes.push_back(cell.box);
    this->Cells.push_back({ cell.start, cell.reach });
  }
  std::vector<std::int32_t> order(cells.size());
  std::iota(order.begin(), order.end(), 0);
  this->Nodes.reserve(2 * cells.size());
  this->build(order, 0, order.size(), boxes);
}

template <int N>
std::int32_t CellTree<N>::build(std::vector<std::int32_t>& order, std::size_t begin,
  std::size_t end, const std::vector<Box>& boxes)
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
