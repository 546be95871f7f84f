// SPDX-License-Identifier: BSD-3-Clause

// Compiled once for each set of vector instructions.
#include "footpoint/search/vector_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "footpoint/search/reduced_squares.cpp"
#include <hwy/foreach_target.h>

#include "footpoint/search/reduced_squares.h"

#include "footpoint/splines/binomials.h"

#include <hwy/highway.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace footpoint
{
namespace HWY_NAMESPACE
{

namespace hn = hwy::HWY_NAMESPACE;

namespace
{

/// Columns [column, column + Vectors × lanes) of a product. \tparam Inner columns of the left
/// factor, −1: any
template <int Inner, int Vectors>
HWY_INLINE void multiply_columns(
  const NumberRows& left, const double* right, int stride, int column, NumberRows& product)
{
  const hn::CappedTag<double, 4> tag;
  constexpr int kLanes = static_cast<int>(hn::MaxLanes(tag));
  const int inner = Inner >= 0 ? Inner : left.columns;
  const double* factor = left[0];
  double* target = product[0] + column;
  for (int i = 0; i < left.rows; ++i, factor += left.stride, target += product.stride)
  {
    hn::Vec<decltype(tag)> sums[Vectors];
    std::fill_n(sums, Vectors, hn::Zero(tag));
    for (int k = 0; k < inner; ++k)
    {
      const auto a = hn::Set(tag, factor[k]);
      for (int v = 0; v < Vectors; ++v)
      {
        const auto b = hn::LoadU(tag, right + k * stride + column + v * kLanes);
        sums[v] = hn::MulAdd(a, b, sums[v]);
      }
    }
    for (int v = 0; v < Vectors; ++v)
    {
      hn::StoreU(sums[v], tag, target + v * kLanes);
    }
  }
}

template <int Inner>
void multiply_by(const NumberRows& left, const double* right, int stride, NumberRows& product)
{
  constexpr int kLanes = static_cast<int>(hn::MaxLanes(hn::CappedTag<double, 4>()));
  int column = 0;
  for (; column + 2 * kLanes <= product.stride; column += 2 * kLanes)
  {
    multiply_columns<Inner, 2>(left, right, stride, column, product);
  }
  for (; column < product.stride; column += kLanes)
  {
    multiply_columns<Inner, 1>(left, right, stride, column, product);
  }
}

} // namespace

/// product = left × right. \param stride of right; its rows reach as far as those of the product
void multiply_rows(const NumberRows& left, const double* right, int stride, NumberRows& product)
{
  switch (left.columns)
  {
    case 3: // of degree two, and their forms
      return multiply_by<3>(left, right, stride, product);
    case 4: // of degree three
      return multiply_by<4>(left, right, stride, product);
    case 5:
      return multiply_by<5>(left, right, stride, product);
    case 7:
      return multiply_by<7>(left, right, stride, product);
    default:
      return multiply_by<-1>(left, right, stride, product);
  }
}

/// The greatest of all a − b, whose rows are padded by their last numbers. \param stride of b
double greatest_difference(const NumberRows& a, const double* b, int stride)
{
  const hn::CappedTag<double, 4> tag;
  auto greatest = hn::Set(tag, -std::numeric_limits<double>::infinity());
  for (int i = 0; i < a.rows; ++i)
  {
    for (int j = 0; j < a.stride; j += static_cast<int>(hn::Lanes(tag)))
    {
      greatest = hn::Max(
        greatest, hn::Sub(hn::LoadU(tag, a[i] + j), hn::LoadU(tag, b + i * stride + j)));
    }
  }
  return hn::GetLane(hn::MaxOfLanes(tag, greatest));
}

} // namespace HWY_NAMESPACE
} // namespace footpoint
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace footpoint
{
namespace
{
HWY_EXPORT(multiply_rows);
HWY_EXPORT(greatest_difference);

/// A rounding.
constexpr double kRounding = 0x1p-53;

using Dense = Eigen::MatrixXd;

NumberRows rows_of(const Dense& dense)
{
  NumberRows result(static_cast<int>(dense.rows()), static_cast<int>(dense.cols()));
  for (int i = 0; i < result.rows; ++i)
  {
    for (int j = 0; j < result.columns; ++j)
    {
      result[i][j] = dense(i, j);
    }
  }
  return result;
}

/// The Bernstein polynomials of degree n, one column each, at Chebyshev's nodes for polynomials of
/// degree `nodes`.
Dense bernstein_at_nodes(int n, int nodes)
{
  const std::vector<double> binomial = binomials(n);
  Dense result(nodes + 1, n + 1);
  for (int i = 0; i <= nodes; ++i)
  {
    const double t = 0.5 * (1.0 - std::cos((2 * i + 1) * EIGEN_PI / (2 * nodes + 2)));
    for (int k = 0; k <= n; ++k)
    {
      result(i, k) = binomial[k] * std::pow(t, k) * std::pow(1.0 - t, n - k);
    }
  }
  return result;
}

/// Coefficients of a higher degree from those of degree n.
Dense raising(int n, int to)
{
  const std::vector<double> row = binomials(n);
  const std::vector<double> more = binomials(to - n);
  const std::vector<double> raised = binomials(to);
  Dense result = Dense::Zero(to + 1, n + 1);
  for (int k = 0; k <= n; ++k)
  {
    for (int j = k; j <= k + to - n; ++j)
    {
      result(j, k) = row[k] * more[j - k] / raised[j];
    }
  }
  return result;
}

} // namespace

ReducedSquares::ReducedSquares(const PieceShape& shape)
  : Shape(shape)
{
  const std::array<int, 2>& from = shape.degree;
  const std::array<int, 2> to{ { raised_degree(from[0]), raised_degree(from[1]) } };
  const auto along_both = [](const Dense& u, const Dense& v)
  {
    return Operator{ rows_of(u), rows_of(v.transpose()),
      NumberRows(static_cast<int>(u.rows()), static_cast<int>(v.cols())) };
  };
  const Dense sampling[2] = { bernstein_at_nodes(2 * from[0], to[0]),
    bernstein_at_nodes(2 * from[1], to[1]) };
  const Dense interpolating[2] = { bernstein_at_nodes(to[0], to[0]).inverse(),
    bernstein_at_nodes(to[1], to[1]).inverse() };
  this->Raises = to != from;
  this->Reducing = along_both(interpolating[0] * sampling[0], interpolating[1] * sampling[1]);
  this->Sampling = along_both(sampling[0], sampling[1]);
  this->Weights =
    along_both(bernstein_at_nodes(from[0], to[0]), bernstein_at_nodes(from[1], to[1]));
  this->Interpolating = along_both(interpolating[0], interpolating[1]);
  this->RaisingNet = along_both(raising(from[0], to[0]), raising(from[1], to[1]));
  this->RaisingForm =
    along_both(raising(2 * from[0], from[0] + to[0]), raising(2 * from[1], from[1] + to[1]));
  this->RaisingResult = along_both(raising(to[0], 2 * from[0]), raising(to[1], 2 * from[1]));
  // As the rows of Q that it is compared with.
  NumberRows& last = this->RaisingResult.second;
  for (int i = 0; i < last.rows; ++i)
  {
    std::fill(last[i] + last.columns, last[i] + last.stride, last[i][last.columns - 1]);
  }
  const std::vector<double> u = binomials(from[0] + to[0]);
  const std::vector<double> v = binomials(from[1] + to[1]);
  this->Divisors = NumberRows(from[0] + to[0] + 1, from[1] + to[1] + 1);
  for (int i = 0; i < this->Divisors.rows; ++i)
  {
    for (int j = 0; j < this->Divisors.columns; ++j)
    {
      this->Divisors[i][j] = 1.0 / (u[i] * v[j]);
    }
  }
  for (int k = 0; k < 4; ++k)
  {
    this->Own[k] = NumberRows(from[0] + 1, from[1] + 1);
    this->Net[k] = NumberRows(to[0] + 1, to[1] + 1);
  }
  this->Squares = this->Net[0];
}

void ReducedSquares::apply(Operator& what, const double* source, int stride, NumberRows& result)
{
  if (result.rows != what.first.rows || result.columns != what.second.columns)
  {
    result = NumberRows(what.first.rows, what.second.columns);
  }
  HWY_DYNAMIC_DISPATCH(multiply_rows)(what.first, source, stride, what.between);
  HWY_DYNAMIC_DISPATCH(multiply_rows)
  (what.between, what.second[0], what.second.stride, result);
}

void ReducedSquares::take_net(const Piece& piece)
{
  std::array<NumberRows, 4>& net = this->Raises ? this->Own : this->Net;
  const int rows = net[0].rows;
  const int columns = net[0].columns;
  for (int k = 0; k < 4; ++k)
  {
    const double* number = piece.net + k;
    double* row = net[k][0];
    for (int i = 0; i < rows; ++i, row += net[k].stride)
    {
      for (int j = 0; j < columns; ++j, number += 4)
      {
        row[j] = *number;
      }
    }
  }
  for (int k = 0; k < 4 && this->Raises; ++k)
  {
    this->apply(this->RaisingNet, this->Own[k][0], this->Own[k].stride, this->Net[k]);
  }
}

double ReducedSquares::rounding(const Piece& piece) const
{
  double greatest = piece.reach * piece.reach;
  for (const double number : this->Squares.numbers)
  {
    greatest = std::max(greatest, std::abs(number));
  }
  // Weights are below 2.
  return 8.0 * this->Shape.roundings * kRounding * greatest;
}

double ReducedSquares::excess(const Piece& piece)
{
  this->apply(this->RaisingResult, this->Squares[0], this->Squares.stride, this->Product);
  return HWY_DYNAMIC_DISPATCH(greatest_difference)(
           this->Product, piece.forms, this->Shape.stride) +
    this->rounding(piece);
}

double ReducedSquares::rational_excess(const Piece& piece)
{
  const NumberRows& weights = this->Raises ? this->Own[3] : this->Net[3];
  const int p = this->Shape.degree[0];
  const int q = this->Shape.degree[1];
  const int n = this->Squares.rows - 1;
  const int m = this->Squares.columns - 1;
  // The product of w and what is in Squares (R. T. Farouki and V. T. Rajan 1988).
  NumberRows& product = this->Product;
  product = this->Divisors;
  std::fill(product.numbers.begin(), product.numbers.end(), 0.0);
  for (int k = 0; k <= n; ++k)
  {
    for (int l = 0; l <= m; ++l)
    {
      const double a = kBinomials.value[n][k] * kBinomials.value[m][l] * this->Squares[k][l];
      for (int i = 0; i <= p; ++i)
      {
        for (int j = 0; j <= q; ++j)
        {
          product[i + k][j + l] +=
            a * kBinomials.value[p][i] * kBinomials.value[q][j] * weights[i][j];
        }
      }
    }
  }
  const int stride = this->Shape.stride;
  this->apply(this->RaisingForm, piece.forms, stride, this->Form);
  this->apply(
    this->RaisingForm, piece.forms + 4 * this->Shape.form_size, stride, this->SquaredWeights);
  const double rounding = this->rounding(piece);
  double greatest = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < product.rows; ++i)
  {
    for (int j = 0; j < product.columns; ++j)
    {
      const double above = product[i][j] * this->Divisors[i][j] - this->Form[i][j] + rounding;
      greatest = std::max(greatest, above / this->SquaredWeights[i][j]);
    }
  }
  return greatest * (greatest > 0.0 ? 1.0 + 0x1p-40 : 1.0 - 0x1p-40);
}

void ReducedSquares::take(const Piece& piece)
{
  this->take_net(piece);
  const int stride = this->Shape.stride;
  if (!this->Shape.rational)
  {
    this->apply(this->Reducing, piece.forms, stride, this->Squares);
    const double sigma = this->excess(piece);
    for (double& a : this->Squares.numbers)
    {
      a -= sigma;
    }
    return;
  }
  const NumberRows& weights = this->Raises ? this->Own[3] : this->Net[3];
  this->apply(this->Sampling, piece.forms, stride, this->Samples);
  this->apply(this->Weights, weights[0], weights.stride, this->WeightSamples);
  for (int i = 0; i < this->Samples.rows; ++i)
  {
    for (int j = 0; j < this->Samples.columns; ++j)
    {
      this->Samples[i][j] /= this->WeightSamples[i][j];
    }
  }
  this->apply(this->Interpolating, this->Samples[0], this->Samples.stride, this->Squares);
  const double sigma = this->rational_excess(piece);
  for (int i = 0; i < this->Squares.rows; ++i)
  {
    for (int j = 0; j < this->Squares.columns; ++j)
    {
      this->Squares[i][j] = this->Squares[i][j] / this->Net[3][i][j] - sigma;
    }
  }
}

} // namespace footpoint

#endif
