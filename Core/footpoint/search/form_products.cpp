// SPDX-License-Identifier: BSD-3-Clause

// Compiled once for each set of vector instructions, as certified_search.cpp is.
#ifndef FOOTPOINT_TARGETS_LEFT_OUT // a build's own
#define FOOTPOINT_TARGETS_LEFT_OUT 0
#endif
#define HWY_DISABLED_TARGETS (FOOTPOINT_TARGETS_LEFT_OUT | HWY_SSSE3 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "footpoint/search/form_products.cpp"
#include <hwy/foreach_target.h>

#include "footpoint/search/form_products.h"

#include "footpoint/splines/binomials.h"

#include <hwy/highway.h>

#include <algorithm>

#ifndef FOOTPOINT_FORM_PRODUCTS_ONCE
#define FOOTPOINT_FORM_PRODUCTS_ONCE
namespace footpoint
{
namespace form_products
{

/// Zeros before and behind a line, so that a vector at any shift of it may be loaded.
constexpr int kMargin = 8;

/// Numbers from one line to the next: margins, and the line itself in whole vectors.
inline int line_stride(const PieceShape& shape)
{
  return 2 * kMargin + (shape.degree[1] + kMargin) / kMargin * kMargin;
}

} // namespace form_products
} // namespace footpoint
#endif

HWY_BEFORE_NAMESPACE();
namespace footpoint
{
namespace HWY_NAMESPACE
{
namespace
{

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<double, 8>;
using Vector = hn::Vec<Tag>;

/// Coefficients [column, column + lanes) of a row of all forms, times their binomials.
template <bool Rational>
struct Sums
{
  Vector q;
  Vector x;
  Vector y;
  Vector z;
  Vector w2;

  /// Adds a row of the net times another one. \param a, b x of the rows, y, z and w a stride
  /// farther
  HWY_INLINE void add(const double* a, const double* b, int stride, int degree, int column)
  {
    const Tag tag;
    const int lanes = static_cast<int>(hn::Lanes(tag));
    const int first = std::max(0, column - degree);
    const int last = std::min(degree, column + lanes - 1);
    for (int j = first; j <= last; ++j)
    {
      const double* shifted = b + column - j;
      const auto bx = hn::LoadU(tag, shifted);
      const auto by = hn::LoadU(tag, shifted + stride);
      const auto bz = hn::LoadU(tag, shifted + 2 * stride);
      this->q = hn::MulAdd(hn::Set(tag, a[j]), bx, this->q);
      this->q = hn::MulAdd(hn::Set(tag, a[stride + j]), by, this->q);
      this->q = hn::MulAdd(hn::Set(tag, a[2 * stride + j]), bz, this->q);
      if (Rational)
      {
        const auto w = hn::Set(tag, a[3 * stride + j]);
        this->x = hn::MulAdd(w, bx, this->x);
        this->y = hn::MulAdd(w, by, this->y);
        this->z = hn::MulAdd(w, bz, this->z);
        this->w2 = hn::MulAdd(w, hn::LoadU(tag, shifted + 3 * stride), this->w2);
      }
    }
  }
};

template <bool Rational>
HWY_INLINE void multiply(
  const PieceShape& shape, const double* lines, const double* divisors, double* forms)
{
  const Tag tag;
  const int lanes = static_cast<int>(hn::Lanes(tag));
  const int p = shape.degree[0];
  const int stride = form_products::line_stride(shape);
  lines += form_products::kMargin;
  for (int row = 0; row < shape.rows; ++row)
  {
    double* target = forms + row * shape.stride;
    for (int column = 0; column < shape.columns; column += lanes)
    {
      const auto zero = hn::Zero(tag);
      Sums<Rational> sums{ zero, zero, zero, zero, zero };
      for (int i = std::max(0, row - p); i <= std::min(p, row); ++i)
      {
        sums.add(
          lines + 4 * i * stride, lines + 4 * (row - i) * stride, stride, shape.degree[1], column);
      }
      const auto divisor = hn::LoadU(tag, divisors + row * shape.stride + column);
      double* to = target + column;
      hn::StoreU(hn::Mul(divisor, sums.q), tag, to);
      if (Rational)
      {
        hn::StoreU(hn::Mul(divisor, sums.x), tag, to + shape.form_size);
        hn::StoreU(hn::Mul(divisor, sums.y), tag, to + 2 * shape.form_size);
        hn::StoreU(hn::Mul(divisor, sums.z), tag, to + 3 * shape.form_size);
        hn::StoreU(hn::Mul(divisor, sums.w2), tag, to + 4 * shape.form_size);
      }
    }
    for (int form = 0; form < shape.number_of_forms; ++form)
    {
      double* of_form = target + form * shape.form_size;
      std::fill(of_form + shape.columns, of_form + shape.stride, of_form[shape.columns - 1]);
    }
  }
}

} // namespace

void multiply_lines(
  const PieceShape& shape, const double* lines, const double* divisors, double* forms)
{
  if (shape.rational)
  {
    multiply<true>(shape, lines, divisors, forms);
  }
  else
  {
    multiply<false>(shape, lines, divisors, forms);
  }
}

} // namespace HWY_NAMESPACE
} // namespace footpoint
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace footpoint
{
namespace
{
HWY_EXPORT(multiply_lines);
}

FormProducts::FormProducts(const PieceShape& shape)
  : Shape(shape)
  , Divisors(shape.form_size, 0.0)
  , Lines(4 * (shape.degree[0] + 1) * form_products::line_stride(shape), 0.0)
{
  const std::vector<double> p = binomials(shape.degree[0]);
  const std::vector<double> q = binomials(shape.degree[1]);
  for (const double a : p)
  {
    for (const double b : q)
    {
      this->Binomials.push_back(a * b);
    }
  }
  const std::vector<double> p2 = binomials(2 * shape.degree[0]);
  const std::vector<double> q2 = binomials(2 * shape.degree[1]);
  for (int i = 0; i < shape.rows; ++i)
  {
    for (int j = 0; j < shape.columns; ++j)
    {
      this->Divisors[i * shape.stride + j] = 1.0 / (p2[i] * q2[j]);
    }
  }
}

void FormProducts::fill(const double* net, double* forms)
{
  const int stride = form_products::line_stride(this->Shape);
  const int columns = this->Shape.degree[1] + 1;
  const double* binomial = this->Binomials.data();
  double* line = this->Lines.data() + form_products::kMargin;
  for (int i = 0; i <= this->Shape.degree[0]; ++i, line += 4 * stride)
  {
    for (int j = 0; j < columns; ++j, net += 4, ++binomial)
    {
      line[j] = *binomial * net[0];
      line[stride + j] = *binomial * net[1];
      line[2 * stride + j] = *binomial * net[2];
      line[3 * stride + j] = *binomial * net[3];
    }
  }
  HWY_DYNAMIC_DISPATCH(multiply_lines)
  (this->Shape, this->Lines.data(), this->Divisors.data(), forms);
}

} // namespace footpoint

#endif
