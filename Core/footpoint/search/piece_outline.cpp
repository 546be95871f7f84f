// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/search/piece_outline.h"

#include "footpoint/search/reduced_squares.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

namespace footpoint
{
namespace
{

/// Squares of what lies between are far from the ends of double precision.
constexpr double kShortest = 1e-140;
constexpr double kLongest = 1e140;
/// The same for the least coefficient of w².
constexpr double kLeastWeight = 1e-140;

/// Numbers of outlines, in their units: greater ones come from steep weights, and tell nothing.
constexpr double kGreatest = 1e10;

/// A number of single precision that is not less than a magnitude.
float bound_of(double magnitude)
{
  return static_cast<float>(magnitude * (1.0 + 0x1p-20));
}

std::int32_t count_of(const PieceShape& shape)
{
  const int all = (raised_degree(shape.degree[0]) + 1) * (raised_degree(shape.degree[1]) + 1);
  return (all + PieceOutline::kWidth - 1) / PieceOutline::kWidth * PieceOutline::kWidth;
}

std::size_t size_of(const PieceShape& shape)
{
  return static_cast<std::size_t>(shape.rational ? 5 : 4) * count_of(shape) +
    4 * PieceOutline::kCorners;
}

bool fits(const Piece& piece)
{
  return piece.reach >= kShortest && piece.reach <= kLongest && piece.least_weight >= kLeastWeight;
}

/// \param squares that have taken the piece \return whether its numbers fit into single precision
bool write(
  const PieceShape& shape, const ReducedSquares& squares, float* numbers, PieceOutline& outline)
{
  const std::array<NumberRows, 4>& net = squares.net();
  const int rows = net[0].rows;
  const int columns = net[0].columns;
  const std::int32_t count = outline.count;
  const double inverse = outline.inverse_unit;
  const bool rational = shape.rational;
  double longest = 0.0;
  double greatest = 0.0;
  int k = 0;
  for (int i = 0; i < rows; ++i)
  {
    const double* x = net[0][i];
    const double* y = net[1][i];
    const double* z = net[2][i];
    const double* w = net[3][i];
    const double* a = squares.squares()[i];
    for (int j = 0; j < columns; ++j, ++k)
    {
      const double factor = rational ? inverse / w[j] : inverse;
      const Vector3 at = factor * Vector3(x[j], y[j], z[j]);
      const double square = a[j] * inverse * inverse;
      for (int c = 0; c < 3; ++c)
      {
        numbers[c * count + k] = static_cast<float>(at(c));
        longest = std::max(longest, std::abs(at(c)));
      }
      numbers[3 * count + k] = static_cast<float>(square);
      if (rational)
      {
        numbers[4 * count + k] = static_cast<float>(w[j]);
      }
      greatest = std::max(greatest, std::max(std::abs(square), at.squaredNorm()));
    }
  }
  for (float* at = numbers; at < outline.corners(rational); at += count)
  {
    std::fill(at + k, at + count, at[k - 1]);
  }
  // A curve has each of its ends twice.
  const int last = columns - 1;
  const int corners[PieceOutline::kCorners] = { 0, last, k - 1 - last, k - 1 };
  float* corner = numbers + size_of(shape) - 4 * PieceOutline::kCorners;
  for (int end = 0; end < PieceOutline::kCorners; ++end)
  {
    double squared = 0.0;
    for (int c = 0; c < 3; ++c)
    {
      const float x = numbers[c * count + corners[end]];
      corner[c * PieceOutline::kCorners + end] = x;
      squared += static_cast<double>(x) * x;
    }
    corner[3 * PieceOutline::kCorners + end] = static_cast<float>(squared);
  }
  outline.longest = bound_of(longest);
  outline.greatest = bound_of(greatest);
  return greatest <= kGreatest;
}

} // namespace

PieceOutlines::PieceOutlines(const AlignedVector<Piece>& pieces, const Execution& execution)
  : Outlines(pieces.size())
{
  std::size_t size = 0;
  std::vector<std::size_t> begins(pieces.size()); // of their numbers
  for (std::size_t k = 0; k < pieces.size(); ++k)
  {
    begins[k] = size;
    size += fits(pieces[k]) ? size_of(*pieces[k].shape) : 0;
  }
  this->Numbers = AlignedArray<float>(size);
  const auto fill = [&](std::int64_t begin, std::int64_t end)
  {
    // Models of many patches come back to the same few shapes.
    std::map<const PieceShape*, ReducedSquares> squares;
    for (std::int64_t k = begin; k < end; ++k)
    {
      prefetch_net_after(pieces, k, end);
      const Piece& piece = pieces[k];
      PieceOutline& outline = this->Outlines[k];
      std::copy(piece.origin.begin(), piece.origin.end(), outline.origin);
      outline.unit = 1.0;
      outline.inverse_unit = 1.0;
      outline.longest = 0.0F;
      outline.greatest = 0.0F;
      outline.numbers = nullptr;
      outline.count = 0;
      if (!fits(piece))
      {
        continue;
      }
      const PieceShape& shape = *piece.shape;
      ReducedSquares& reduced = squares.try_emplace(&shape, shape).first->second;
      float* const numbers = this->Numbers.data() + begins[k];
      outline.unit = std::ldexp(1.0, std::ilogb(piece.reach));
      outline.inverse_unit = 1.0 / outline.unit;
      outline.numbers = numbers;
      outline.count = count_of(shape);
      reduced.take(piece);
      outline.count = write(shape, reduced, numbers, outline) ? outline.count : 0;
    }
  };
  for_ranges(execution, static_cast<std::int64_t>(pieces.size()), kPiecesForThreads, fill);
}

} // namespace footpoint
