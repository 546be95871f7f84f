// SPDX-License-Identifier: BSD-3-Clause

// HeightForm: a lower bound of the squared distance over a piece that has only the degree of the
// piece, not twice that. Compiled once for each set of vector instructions (the guard of Highway's
// "-inl.h" headers).
#if defined(FOOTPOINT_HEIGHT_FORM_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FOOTPOINT_HEIGHT_FORM_INL_H
#undef FOOTPOINT_HEIGHT_FORM_INL_H
#else
#define FOOTPOINT_HEIGHT_FORM_INL_H
#endif

#include "footpoint/search/positive_form-inl.h"

#include <algorithm>
#include <array>
#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace footpoint
{
namespace HWY_NAMESPACE
{
namespace
{

/// A foot on a piece as its height form sees it.
struct HeightView
{
  double f[3]; ///< the foot, relative to the piece's origin
  double r[3]; ///< f − P
  Pair t;      ///< its parameters
  /// E below: by how much |S − P|² may fall short of |r|², not negative.
  double allowed;
  /// |S − f|² is at least a Δu² + 2 b Δu Δv + c Δv² for Δ = t − its parameters, anywhere on the
  /// piece; a, b, c. Zeros are always true.
  std::array<double, 3> metric;
};

/// For S(t) on a piece w S = N and a foot f = S(t₀) on it, r = f − P and a square form
/// A(Δ) ≤ |S − f|²,
///
///   w (|S − P|² − |r|² + E) = w |S − f|² + 2 r·(N − w f) + w E
///                           ≥ 2 r·(N − w f) + min w (A(t − t₀) + E)
///
/// has the degree of the piece (two or three where that is one), and so less than a third of the
/// coefficients that the distance form of a bicubic piece has. Where the curvature is what decides,
/// far from the surface, little is lost.
///
/// Rounding: a coefficient of 2 r·(N − w f) is off by
/// 2 (24 + roundings × max w / min w) u |r| × reach × max w at the most, of which the second part
/// is that of f; one of the square form by 32 u (a + 2|b| + c). min w is the root of the smallest
/// coefficient of w², which at a corner is a square rounded once.
///
/// \tparam P, Q degrees of the piece; −1: any
template <int P, int Q>
class HeightForm
{
public:
  /// Numbers of memory that it needs.
  static int size_of_memory(const PieceShape& shape)
  {
    const std::array<int, 2>& degree = shape.degree;
    return Form::size_of_memory(
      form_degree(degree[0], degree[1]), form_degree(degree[1], degree[0]));
  }

  /// Whether |S − P|² ≥ |r|² − E is proved for all of the piece.
  /// \param memory of so many numbers
  static bool proves(const Piece& piece, const HeightView& view, double* memory)
  {
    const std::array<int, 2>& degree = piece.shape->degree;
    Form form(
      form_degree(degree[0], degree[1]), form_degree(degree[1], degree[0]), view.t, memory);
    return form.is_positive(fill(piece, view, form, memory), kMostCells);
  }

private:
  static constexpr int kWidth = 4;
  static constexpr int kMostCells = 16;
  /// Linear directions have at least degree two, which the square form is of; three beside a cubic
  /// one, since a vector holds as much and both are equal then.
  static constexpr int form_degree(int degree, int other)
  {
    return degree == 1 ? (other == 3 ? 3 : 2) : degree;
  }
  using Form = PositiveForm<form_degree(P, Q), form_degree(Q, P), kWidth>;

  /// Bernstein coefficient of (t − t₀)².
  static HWY_INLINE double square(int k, int n, double t0)
  {
    return n < 2 ? 0.0 : t0 * t0 - t0 * (2.0 * k / n) + k * (k - 1.0) / (n * (n - 1.0));
  }

  /// Number k of a straight line from a to b raised to degree n.
  static HWY_INLINE double between(double a, double b, int k, int n)
  {
    return k == n ? b : a + k * (1.0 / n) * (b - a);
  }

  /// \param f receives the coefficients \return the greatest of them, by magnitude
  static double fill(const Piece& piece, const HeightView& view, const Form& form, double* f)
  {
    const PieceShape& shape = *piece.shape;
    const int p = P >= 0 ? P : shape.degree[0];
    const int q = Q >= 0 ? Q : shape.degree[1];
    const int n = form.n();
    const int m = form.m();
    const int stride = form.stride();
    const double r[4] = { 2.0 * view.r[0], 2.0 * view.r[1], 2.0 * view.r[2],
      -2.0 * dot(view.r, view.f) };
    double greatest_weight = 1.0;
    for (int i = 0; i <= p; ++i)
    {
      double* row = f + i * stride;
      for (int j = 0; j <= q; ++j)
      {
        const double* control = piece.net + 4 * (i * (q + 1) + j);
        row[j] = (control[0] * r[0] + control[1] * r[1]) + (control[2] * r[2] + control[3] * r[3]);
        greatest_weight =
          shape.rational ? std::max(greatest_weight, control[3]) : greatest_weight;
      }
      if (q == 1)
      {
        for (int j = m; j > 0; --j)
        {
          row[j] = between(row[0], row[1], j, m);
        }
      }
      for (int j = m + 1; j < stride; ++j)
      {
        row[j] = row[m];
      }
    }
    const hn::CappedTag<double, kWidth> tag;
    constexpr int kLanes = static_cast<int>(hn::MaxLanes(hn::CappedTag<double, kWidth>()));
    if (p == 1)
    {
      for (int i = n; i > 0; --i)
      {
        for (int j = 0; j < stride; ++j)
        {
          f[i * stride + j] = between(f[j], f[stride + j], i, n);
        }
      }
    }
    const double least_weight =
      shape.rational ? std::sqrt(piece.least_weight) * (1.0 - 4.0 * kRounding) : 1.0;
    const double a = least_weight * view.metric[0];
    const double b = least_weight * view.metric[1];
    const double c = least_weight * view.metric[2];
    const double margin = kRounding *
      (2.0 * (24.0 + shape.roundings * greatest_weight / least_weight) *
          bound_of_length(view.r) * piece.reach * greatest_weight +
        32.0 * (a + 2.0 * std::abs(b) + c));
    const double constant = least_weight * view.allowed - margin;
    auto greatest = hn::Zero(tag);
    for (int j = 0; j < stride; j += kLanes)
    {
      HWY_ALIGN double along_v[kLanes];
      HWY_ALIGN double step_v[kLanes];
      for (int lane = 0; lane < kLanes; ++lane)
      {
        const int k = std::min(j + lane, m);
        along_v[lane] = c * square(k, m, view.t[1]) + constant;
        step_v[lane] = 2.0 * b * (k * (1.0 / m) - view.t[1]);
      }
      const auto along = hn::Load(tag, along_v);
      const auto step = hn::Load(tag, step_v);
      for (int i = 0; i <= n; ++i)
      {
        const auto along_u = hn::Set(tag, a * square(i, n, view.t[0]));
        const auto step_u = hn::Set(tag, n > 0 ? i * (1.0 / n) - view.t[0] : 0.0);
        double* at = f + i * stride + j;
        const auto square = hn::Add(hn::MulAdd(step_u, step, along_u), along);
        const auto value = hn::Add(hn::LoadU(tag, at), square);
        greatest = hn::Max(greatest, hn::Abs(value));
        hn::StoreU(value, tag, at);
      }
    }
    return hn::GetLane(hn::MaxOfLanes(tag, greatest));
  }
};

} // namespace
} // namespace HWY_NAMESPACE
} // namespace footpoint
HWY_AFTER_NAMESPACE();

#endif
