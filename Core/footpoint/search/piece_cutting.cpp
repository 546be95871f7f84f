// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/search/piece_cutting.h"

#include <algorithm>

namespace footpoint
{
namespace
{

/// A piece is cut until its weights differ by no more than this ratio, and its control net is no
/// farther from straight than this part of its extent; the latter only while there are few pieces,
/// since cells that are small beside the distances in question need no better shape.
constexpr double kWeightRatio = 3.0;
constexpr double kStraightness = 0.1;
/// How often a piece of the patch is halved, at most, for its weights and for its shape.
constexpr int kWeightCuts = 50;
constexpr int kShapeCuts = 8;
/// Cuts for the weights make that many times few_pieces more, at most.
constexpr std::size_t kWeightPieces = 4;

/// Calls visit(first, step) for each line of a control net along one direction: the index of its
/// first control point, and from one to the next.
template <int N, class Visit>
void for_each_line(const BezierPiece<N>& piece, int direction, const Visit& visit)
{
  const Eigen::Index step = direction == 0 ? 1 : piece.degree[0] + 1;
  const Eigen::Index points = piece.degree[direction] + 1;
  for (Eigen::Index k = 0; k < piece.control.cols(); ++k)
  {
    if (k / step % points == 0)
    {
      visit(k, step);
    }
  }
}

/// How far a net is from straight along one direction: the part of its extent that the bound of its
/// second derivative allows it to leave the chord.
template <int N>
double bend(const BezierPiece<N>& piece, int direction)
{
  const Points points = piece.control.colwise().hnormalized();
  const int degree = piece.degree[direction];
  double second = 0.0;
  for_each_line<N>(piece, direction,
    [&](Eigen::Index first, Eigen::Index step)
    {
      for (Eigen::Index k = first; k < first + (degree - 1) * step; k += step)
      {
        const Vector3 difference =
          points.col(k) - 2.0 * points.col(k + step) + points.col(k + 2 * step);
        second = std::max(second, difference.norm());
      }
    });
  const double extent = (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).norm();
  return extent > 0.0 ? degree * (degree - 1) * second / (8.0 * extent) : 0.0;
}

/// Largest ratio of weights along lines of one direction.
template <int N>
double weight_ratio(const BezierPiece<N>& piece, int direction)
{
  double ratio = 1.0;
  for_each_line<N>(piece, direction,
    [&](Eigen::Index first, Eigen::Index step)
    {
      double least = piece.control(3, first);
      double greatest = least;
      for (int i = 1; i <= piece.degree[direction]; ++i)
      {
        least = std::min(least, piece.control(3, first + i * step));
        greatest = std::max(greatest, piece.control(3, first + i * step));
      }
      ratio = std::max(ratio, greatest / least);
    });
  return ratio;
}

/// Halves, in rounds, every piece whose measure is too large, along the direction where it is
/// worst. \param limit of the number of pieces
template <int N, typename Measure>
std::vector<BezierPiece<N>> cut_while(std::vector<BezierPiece<N>> pieces, double allowed,
  std::size_t limit, int rounds, const Measure& measure)
{
  for (int round = 0; round < rounds && pieces.size() < limit; ++round)
  {
    std::vector<BezierPiece<N>> next;
    std::size_t count = pieces.size();
    for (BezierPiece<N>& piece : pieces)
    {
      int worst = 0;
      double value = count < limit ? measure(piece, 0) : 0.0;
      const double other = N == 2 && count < limit ? measure(piece, N - 1) : 0.0;
      if (other > value)
      {
        worst = N - 1;
        value = other;
      }
      if (value <= allowed)
      {
        next.push_back(std::move(piece));
        continue;
      }
      ++count;
      for (BezierPiece<N>& half : halve<N>(piece, worst))
      {
        next.push_back(std::move(half));
      }
    }
    const bool cut = next.size() > pieces.size();
    pieces = std::move(next);
    if (!cut)
    {
      break;
    }
  }
  return pieces;
}

} // namespace

template <int N>
bool has_uneven_weights(const BezierPiece<N>& piece)
{
  return weight_ratio<N>(piece, 0) > kWeightRatio || weight_ratio<N>(piece, N - 1) > kWeightRatio;
}

template <int N>
std::vector<BezierPiece<N>> cut_pieces(std::vector<BezierPiece<N>> pieces, std::size_t few_pieces)
{
  const std::size_t limit = pieces.size() + kWeightPieces * few_pieces;
  pieces = cut_while<N>(std::move(pieces), kWeightRatio, limit, kWeightCuts, weight_ratio<N>);
  return cut_while<N>(std::move(pieces), kStraightness, few_pieces, kShapeCuts, bend<N>);
}

template bool has_uneven_weights(const BezierPiece<1>&);
template bool has_uneven_weights(const BezierPiece<2>&);
template std::vector<BezierPiece<1>> cut_pieces(std::vector<BezierPiece<1>>, std::size_t);
template std::vector<BezierPiece<2>> cut_pieces(std::vector<BezierPiece<2>>, std::size_t);

} // namespace footpoint
