// SPDX-License-Identifier: BSD-3-Clause

// What the outline of a piece says for a query. Compiled once for each set of vector instructions
// (the guard of Highway's "-inl.h" headers).
#if defined(FOOTPOINT_OUTLINE_FORM_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FOOTPOINT_OUTLINE_FORM_INL_H
#undef FOOTPOINT_OUTLINE_FORM_INL_H
#else
#define FOOTPOINT_OUTLINE_FORM_INL_H
#endif

#include "footpoint/search/piece_evaluation-inl.h"
#include "footpoint/search/piece_outline.h"

#include <algorithm>
#include <cmath>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace footpoint
{
namespace HWY_NAMESPACE
{
namespace
{

/// Queries beyond this, in units of an outline, have no squares in single precision.
constexpr double kFarthest = 1e18;

/// A sum of four products of single precision numbers and a fifth one is off by less than this part
/// of what they are at the most: two roundings each and five of the sum.
constexpr double kOutlineRounding = 0x1p-20;
/// A rounding of single precision.
constexpr double kSingleRounding = 0x1p-24;

/// Coefficients on the halves of a piece, in a row and in all, with what pads them.
constexpr int kMostRefinedColumns = (2 * kMaximumDegree + 8) / 8 * 8;
constexpr int kMostRefined = (2 * kMaximumDegree + 1) * kMostRefinedColumns;

/// Coefficients on the halves of a piece.
struct RefinedOutline
{
  /// Rows of PieceShape::halves_stride numbers, padded by the last one.
  HWY_ALIGN float f[kMostRefined];
  float least;
  float error; ///< of each of them

  bool is_positive() const { return this->least > this->error; }
};

/// The outline of a piece as a query sees it: r = c − P in its units, and
///
///   |S − P|² ≥ |r|² + Σ R_k g_k,   g_k = 2 r·x_k + a_k.
class OutlineView
{
public:
  /// \param query P, in the model's centred coordinates \param rounding of a coordinate of r
  OutlineView(const PieceOutline& outline, const double* query, double rounding)
    : Outline(outline)
  {
    double r[3];
    for (int k = 0; k < 3; ++k)
    {
      r[k] = outline.origin[k] - query[k];
      this->TwiceR[k] = static_cast<float>(2.0 * r[k] * outline.inverse_unit);
    }
    this->Squared = dot(r, r);
    this->Length = bound_of_length(r);
    this->Rounding = 4.0 * rounding * this->Length;
  }

  /// Whether there is anything to see.
  bool is_usable() const
  {
    return this->Outline.count > 0 &&
      this->Length * this->Outline.inverse_unit <= kFarthest;
  }

  /// A lower bound of the squared distance of the piece.
  HWY_INLINE double bound() const
  {
    const hn::CappedTag<float, PieceOutline::kWidth> tag;
    auto least = hn::Set(tag, std::numeric_limits<float>::infinity());
    for (int k = 0; k < this->Outline.count; k += static_cast<int>(hn::Lanes(tag)))
    {
      least = hn::Min(least, this->bracket(tag, this->Outline.numbers + k, this->Outline.count));
    }
    return this->Squared - this->error() +
      this->squared_unit() * static_cast<double>(hn::GetLane(hn::MinOfLanes(tag, least)));
  }

  /// The nearest corner. \param squared receives an upper bound of its squared distance
  HWY_INLINE int nearest_corner(bool rational, double& squared) const
  {
    constexpr int kCorners = PieceOutline::kCorners;
    const hn::CappedTag<float, kCorners> tag;
    HWY_ALIGN float value[kCorners];
    const float* corner = this->Outline.corners(rational);
    for (int k = 0; k < kCorners; k += static_cast<int>(hn::Lanes(tag)))
    {
      hn::StoreU(this->bracket(tag, corner + k, kCorners), tag, value + k);
    }
    const int low = value[1] < value[0] ? 1 : 0;
    const int high = value[3] < value[2] ? 3 : 2;
    const int nearest = value[high] < value[low] ? high : low;
    squared = this->Squared + this->error() +
      this->squared_unit() * static_cast<double>(value[nearest]);
    return nearest;
  }

  /// The coefficients of w (|r|² + Σ R_k g_k − T) on the halves of the piece. Where all of them are
  /// positive, nothing is nearer than √T.
  /// \param constant |r|² − T, or less
  void refine(const PieceShape& shape, double constant, RefinedOutline& result) const
  {
    const double level = constant * this->Outline.inverse_unit * this->Outline.inverse_unit;
    with_shape(shape,
      [&](auto p, auto q, auto rational)
      { this->refine_by<p(), q(), rational()>(shape, static_cast<float>(level), result); });
    // Sums as in error(), of which weighted means are taken along both directions: a rounding for
    // each of their terms, one for their weights and one for w, which is below 2.
    const double roundings =
      24.0 + raised_degree(shape.degree[0]) + raised_degree(shape.degree[1]);
    result.error = static_cast<float>(
      2.0 * roundings * kSingleRounding * (this->greatest_bracket() + std::abs(level)));
  }

private:
  double squared_unit() const { return this->Outline.unit * this->Outline.unit; }

  /// Magnitudes of what is summed in a bracket.
  double greatest_bracket() const
  {
    return 2.0 * this->Length * this->Outline.inverse_unit * this->Outline.longest +
      this->Outline.greatest;
  }

  double error() const
  {
    return kOutlineRounding * this->squared_unit() * this->greatest_bracket() + this->Rounding;
  }

  template <class Tag>
  HWY_INLINE hn::Vec<Tag> bracket(Tag tag, const float* number, int count) const
  {
    auto g = hn::MulAdd(
      hn::Set(tag, this->TwiceR[0]), hn::LoadU(tag, number), hn::LoadU(tag, number + 3 * count));
    g = hn::MulAdd(hn::Set(tag, this->TwiceR[1]), hn::LoadU(tag, number + count), g);
    return hn::MulAdd(hn::Set(tag, this->TwiceR[2]), hn::LoadU(tag, number + 2 * count), g);
  }

  static constexpr int kMost = (kMaximumDegree + 1) * (kMaximumDegree + 1) + PieceOutline::kWidth;

  template <int P, int Q, bool Rational>
  HWY_NOINLINE void refine_by(const PieceShape& shape, float constant, RefinedOutline& result) const
  {
    const hn::CappedTag<float, PieceOutline::kWidth> tag;
    constexpr int kLanes = static_cast<int>(hn::MaxLanes(tag)); // of one size where this compiles
    const int n = raised_degree(P >= 0 ? P : shape.degree[0]);
    const int m = raised_degree(Q >= 0 ? Q : shape.degree[1]);
    const int stride = Q >= 0 ? (2 * m + 8) / 8 * 8 : shape.halves_stride;
    const int count = this->Outline.count;
    HWY_ALIGN float g[kMost];
    for (int k = 0; k < count; k += kLanes)
    {
      auto value =
        hn::Add(this->bracket(tag, this->Outline.numbers + k, count), hn::Set(tag, constant));
      if (Rational)
      {
        value = hn::Mul(value, hn::LoadU(tag, this->Outline.numbers + 4 * count + k));
      }
      hn::StoreU(value, tag, g + k);
    }
    HWY_ALIGN float rows[(kMaximumDegree + 1) * kMostRefinedColumns];
    for (int i = 0; i <= n; ++i)
    {
      const float* row = g + i * (m + 1);
      for (int j = 0; j < stride; j += kLanes)
      {
        const float* weight = shape.halves[1].data() + j;
        auto sum = hn::Mul(hn::Set(tag, row[0]), hn::LoadU(tag, weight));
        for (int k = 1; k <= m; ++k)
        {
          sum = hn::MulAdd(hn::Set(tag, row[k]), hn::LoadU(tag, weight + k * stride), sum);
        }
        hn::StoreU(sum, tag, rows + i * stride + j);
      }
    }
    const float* weight = shape.halves[0].data();
    auto least = hn::Set(tag, std::numeric_limits<float>::infinity());
    for (int i = 0; i <= 2 * n; ++i)
    {
      for (int j = 0; j < stride; j += kLanes)
      {
        auto sum = hn::Zero(tag);
        for (int k = std::max(0, i - n); k <= std::min(n, i); ++k)
        {
          sum = hn::MulAdd(
            hn::Set(tag, weight[k * (2 * n + 1) + i]), hn::LoadU(tag, rows + k * stride + j), sum);
        }
        hn::StoreU(sum, tag, result.f + i * stride + j);
        least = hn::Min(least, sum);
      }
    }
    result.least = hn::GetLane(hn::MinOfLanes(tag, least));
  }

  const PieceOutline& Outline;
  float TwiceR[3];
  double Squared;  ///< |r|²
  double Length;   ///< not smaller than |r|
  double Rounding; ///< of what r adds
};

/// Near the minimum along one direction: the control points of a parabola c(t − t0)² are those of a
/// parabola themselves, with its vertex at t0 (n − 1) + ½ (from raising its degree to n).
/// \param f of both halves, one after the other \param at the smallest one
HWY_INLINE double start_in_half(const float* f, int stride, int at, int n)
{
  const int half = at >= n ? 1 : 0;
  const int middle = std::clamp(at - half * n, 1, n - 1);
  const float* here = f + (half * n + middle) * stride;
  const double bend = here[-stride] - 2.0 * here[0] + here[stride];
  const double vertex =
    bend > 0.0 ? middle + 0.5 * (here[-stride] - here[stride]) / bend : at - half * n;
  return 0.5 * (half + std::clamp((vertex - 0.5) / (n - 1), 0.0, 1.0));
}

/// Where to start from, near the smallest coefficient.
inline Pair start_of(const PieceShape& shape, const RefinedOutline& outline)
{
  const hn::CappedTag<float, PieceOutline::kWidth> tag;
  const int stride = shape.halves_stride;
  const int n = raised_degree(shape.degree[0]);
  const int m = raised_degree(shape.degree[1]);
  const auto least = hn::Set(tag, outline.least);
  int k = 0;
  for (int i = 0; i < (2 * n + 1) * stride; i += static_cast<int>(hn::Lanes(tag)))
  {
    const auto at = hn::FindFirstTrue(tag, hn::Eq(hn::LoadU(tag, outline.f + i), least));
    if (at >= 0)
    {
      k = i + static_cast<int>(at);
      break;
    }
  }
  const int row = k / stride;
  const int column = std::min(k % stride, 2 * m);
  return { { n > 0 ? start_in_half(outline.f + column, stride, row, n) : 0.0,
    start_in_half(outline.f + row * stride, 1, column, m) } };
}

} // namespace
} // namespace HWY_NAMESPACE
} // namespace footpoint
HWY_AFTER_NAMESPACE();

#endif
