// SPDX-License-Identifier: BSD-3-Clause

// Compiled once for each set of vector instructions.
#include "footpoint/search/vector_targets.h"

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

/// Numbers from one line of a polynomial of a degree to the next: margins, and the line itself in
/// whole vectors.
constexpr int line_stride(int degree)
{
  return 2 * kMargin + (degree + kMargin) / kMargin * kMargin;
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

/// Coefficients [column, column + lanes) of a row of all forms, times their binomials. What adds up
/// to Q is summed by coordinates, so that no sum waits long for the one before.
template <bool Rational>
struct Sums
{
  Vector q[3];
  Vector xyz[3];
  Vector w2;

  HWY_INLINE Sums()
  {
    const auto zero = hn::Zero(Tag());
    std::fill_n(this->q, 3, zero);
    std::fill_n(this->xyz, 3, zero);
    this->w2 = zero;
  }

  /// Adds a coefficient of a line of the net times another line. \param factor x of the
  /// coefficient, y, z and w a stride farther \param line likewise
  HWY_INLINE void add(const double* factor, const double* line, int stride)
  {
    const Tag tag;
    for (int k = 0; k < 3; ++k)
    {
      const auto b = hn::LoadU(tag, line + k * stride);
      this->q[k] = hn::MulAdd(hn::Set(tag, factor[k * stride]), b, this->q[k]);
      if (Rational)
      {
        this->xyz[k] = hn::MulAdd(hn::Set(tag, factor[3 * stride]), b, this->xyz[k]);
      }
    }
    if (Rational)
    {
      const auto w = hn::LoadU(tag, line + 3 * stride);
      this->w2 = hn::MulAdd(hn::Set(tag, factor[3 * stride]), w, this->w2);
    }
  }

  /// \param divisors of these coefficients \param size from form to form
  HWY_INLINE void store(const double* divisors, int size, double* forms) const
  {
    const Tag tag;
    const auto divisor = hn::LoadU(tag, divisors);
    const auto sum = hn::Add(hn::Add(this->q[0], this->q[1]), this->q[2]);
    hn::StoreU(hn::Mul(divisor, sum), tag, forms);
    if (Rational)
    {
      for (int k = 0; k < 3; ++k)
      {
        hn::StoreU(hn::Mul(divisor, this->xyz[k]), tag, forms + (k + 1) * size);
      }
      hn::StoreU(hn::Mul(divisor, this->w2), tag, forms + 4 * size);
    }
  }
};

/// \tparam Degree of the second direction, −1: any
template <int Degree, bool Rational>
HWY_NOINLINE void multiply(
  const PieceShape& shape, const double* lines, const double* divisors, double* forms)
{
  constexpr int kLanes = static_cast<int>(hn::MaxLanes(Tag()));
  constexpr int kVectors = Rational || kLanes == 8 ? 1 : 2; // as the registers have room for
  const int p = shape.degree[0];
  const int q = Degree >= 0 ? Degree : shape.degree[1];
  const int columns = 2 * q + 1;
  const int row_stride = (columns + 7) / 8 * 8;
  const int stride = form_products::line_stride(q);
  lines += form_products::kMargin;
  for (int row = 0; row < shape.rows; ++row)
  {
    for (int column = 0; column < columns; column += kVectors * kLanes)
    {
      // Zeros on either side of the lines make up for bounds that do not depend on the column.
      const int first_factor = Degree >= 0 ? 0 : std::max(0, column - q);
      const int last_factor = Degree >= 0 ? q : std::min(q, column + kVectors * kLanes - 1);
      const int last = std::min(p, row);
      Sums<Rational> sums[kVectors];
      for (int i = std::max(0, row - p); i <= last; ++i)
      {
        const double* factors = lines + 4 * i * stride;
        const double* other = lines + 4 * (row - i) * stride + column;
        for (int j = first_factor; j <= last_factor; ++j)
        {
          for (int v = 0; v < kVectors; ++v)
          {
            sums[v].add(factors + j, other + v * kLanes - j, stride);
          }
        }
      }
      for (int v = 0; v < kVectors; ++v)
      {
        sums[v].store(
          divisors + column + v * kLanes, shape.form_size, forms + column + v * kLanes);
      }
    }
    for (int form = 0; form < shape.number_of_forms; ++form)
    {
      double* of_form = forms + form * shape.form_size;
      std::fill(of_form + columns, of_form + row_stride, of_form[columns - 1]);
    }
    divisors += row_stride;
    forms += row_stride;
  }
}

template <int Degree>
void multiply_by_degree(
  const PieceShape& shape, const double* lines, const double* divisors, double* forms)
{
  if (shape.rational)
  {
    multiply<Degree, true>(shape, lines, divisors, forms);
  }
  else
  {
    multiply<Degree, false>(shape, lines, divisors, forms);
  }
}

} // namespace

void multiply_lines(
  const PieceShape& shape, const double* lines, const double* divisors, double* forms)
{
  switch (shape.degree[1])
  {
    case 2:
      return multiply_by_degree<2>(shape, lines, divisors, forms);
    case 3:
      return multiply_by_degree<3>(shape, lines, divisors, forms);
    default:
      return multiply_by_degree<-1>(shape, lines, divisors, forms);
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
  , Lines(4 * (shape.degree[0] + 1) * form_products::line_stride(shape.degree[1]), 0.0)
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
  const int stride = form_products::line_stride(this->Shape.degree[1]);
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
