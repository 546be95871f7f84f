// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/search/piece_outline.h"

#include <algorithm>
#include <cmath>

namespace footpoint
{
namespace
{

/// Squares of what lies between are far from the ends of single precision.
constexpr double kShortest = 1e-15;
constexpr double kLongest = 1e15;

/// A number of single precision that is not less than a magnitude.
float bound_of(double magnitude)
{
  return static_cast<float>(magnitude * (1.0 + 0x1p-20));
}

/// Bernstein coefficients of 1, t − ½ and (t − ½)²; of the last one none at degrees below two.
struct Powers
{
  std::vector<double> first;
  std::vector<double> second;

  explicit Powers(int n)
    : first(n + 1, 0.0)
    , second(n + 1, 0.0)
  {
    for (int k = 0; k <= n && n > 0; ++k)
    {
      const double at = static_cast<double>(k) / n;
      this->first[k] = at - 0.5;
      this->second[k] = n > 1 ? 0.25 - at + at * ((k - 1.0) / (n - 1.0)) : 0.0;
    }
  }
};

/// A square form that is nowhere greater and has no part along a direction of a degree below two.
std::array<double, 3> without_lines(const std::array<double, 3>& form, const PieceShape& shape)
{
  const double a = form[0];
  const double b = form[1];
  const double c = form[2];
  const bool lines[2] = { shape.degree[0] < 2, shape.degree[1] < 2 };
  // a u² + 2 b u v + c v² is least at u = −v b / a.
  if (lines[0])
  {
    const double left = a > 0.0 ? c - b * (b / a) * (1.0 + 0x1p-40) : c;
    return { { 0.0, 0.0, lines[1] ? 0.0 : std::max(left, 0.0) } };
  }
  if (lines[1])
  {
    const double left = c > 0.0 ? a - b * (b / c) * (1.0 + 0x1p-40) : a;
    return { { std::max(left, 0.0), 0.0, 0.0 } };
  }
  return form;
}

/// Writes the numbers of pieces of one shape.
class Writer
{
public:
  explicit Writer(const PieceShape& shape)
    : Shape(shape)
    , U(shape.degree[0])
    , V(shape.degree[1])
    , Count(count(shape))
  {
  }

  static std::int32_t count(const PieceShape& shape)
  {
    const int all = (shape.degree[0] + 1) * (shape.degree[1] + 1);
    return (all + PieceOutline::kWidth - 1) / PieceOutline::kWidth * PieceOutline::kWidth;
  }
  static std::size_t size(const PieceShape& shape)
  {
    return 4 * static_cast<std::size_t>(count(shape) + PieceOutline::kCorners);
  }

  /// \param middle of the piece, from its origin
  void write(const Piece& piece, const double* middle, const std::array<double, 3>& metric,
    float* numbers, PieceOutline& outline) const
  {
    const int p = this->Shape.degree[0];
    const int q = this->Shape.degree[1];
    const std::array<double, 3> form = without_lines(metric, this->Shape);
    const double least_weight = this->Shape.rational ? std::sqrt(piece.least_weight) : 1.0;
    float* corner = numbers + 4 * this->Count;
    double longest = 0.0;
    double greatest = 0.0;
    int k = 0;
    for (int i = 0; i <= p; ++i)
    {
      const double along_u = form[0] * this->U.second[i];
      const double slope = 2.0 * form[1] * this->U.first[i];
      for (int j = 0; j <= q; ++j, ++k)
      {
        const double* control = piece.net + 4 * k;
        const double inverse = this->Shape.rational ? 1.0 / control[3] : 1.0;
        double squared = 0.0;
        for (int c = 0; c < 3; ++c)
        {
          const double x = control[c] * inverse - middle[c];
          numbers[c * this->Count + k] = static_cast<float>(x);
          longest = std::max(longest, std::abs(x));
          squared += x * x;
        }
        const double a = (along_u + slope * this->V.first[j] + form[2] * this->V.second[j]) *
          (least_weight * inverse);
        numbers[3 * this->Count + k] = static_cast<float>(a);
        greatest = std::max({ greatest, std::abs(a), squared });
      }
    }
    // A curve has each of its ends twice.
    const int corners[PieceOutline::kCorners] = { 0, q, p * (q + 1), p * (q + 1) + q };
    for (int end = 0; end < PieceOutline::kCorners; ++end)
    {
      double squared = 0.0;
      for (int c = 0; c < 3; ++c)
      {
        const float x = numbers[c * this->Count + corners[end]];
        corner[c * PieceOutline::kCorners + end] = x;
        squared += static_cast<double>(x) * x;
      }
      corner[3 * PieceOutline::kCorners + end] = static_cast<float>(squared);
    }
    for (int c = 0; c < 4; ++c)
    {
      float* at = numbers + c * this->Count;
      std::fill(at + k, at + this->Count, at[k - 1]);
    }
    outline.numbers = numbers;
    outline.count = this->Count;
    outline.longest = bound_of(longest);
    outline.greatest = bound_of(greatest);
  }

private:
  const PieceShape& Shape;
  Powers U;
  Powers V;
  std::int32_t Count;
};

bool fits(const Piece& piece)
{
  return piece.reach >= kShortest && piece.reach <= kLongest;
}

} // namespace

PieceOutlines::PieceOutlines(const AlignedVector<Piece>& pieces,
  const AlignedVector<TangentPlane>& planes, const AlignedVector<PieceNeighbourhood>& neighbourhoods)
  : Outlines(pieces.size())
{
  std::size_t size = 0;
  for (const Piece& piece : pieces)
  {
    size += fits(piece) ? Writer::size(*piece.shape) : 0;
  }
  this->Numbers = AlignedArray<float>(size);
  float* numbers = this->Numbers.data();
  std::size_t first = 0;
  while (first < pieces.size())
  {
    const Writer writer(*pieces[first].shape);
    std::size_t k = first;
    for (; k < pieces.size() && pieces[k].shape == pieces[first].shape; ++k)
    {
      const Piece& piece = pieces[k];
      PieceOutline& outline = this->Outlines[k];
      for (int c = 0; c < 3; ++c)
      {
        outline.middle[c] = piece.origin[c] + planes[k].point[c];
      }
      if (fits(piece))
      {
        writer.write(piece, planes[k].point, neighbourhoods[k].metric, numbers, outline);
        numbers += Writer::size(*piece.shape);
      }
      else
      {
        outline.numbers = nullptr;
        outline.count = 0;
      }
    }
    first = k;
  }
}

} // namespace footpoint
