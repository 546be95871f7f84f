// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/search/rational_derivatives.h"

#include "footpoint/splines/binomials.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace footpoint
{
namespace
{

using Map4 = Eigen::Map<const Eigen::Array4d, Eigen::Aligned16>;

/// C(m, i) C(n, j), j fastest.
std::vector<double> products_of_binomials(int m, int n)
{
  const std::vector<double> rows = binomials(m);
  const std::vector<double> columns = binomials(n);
  std::vector<double> result;
  for (const double row : rows)
  {
    for (const double column : columns)
    {
      result.push_back(row * column);
    }
  }
  return result;
}

/// The derivative of a polynomial of degree n, raised to that degree: coefficient k, from those
/// before, at and after it. The first has none before it, nor the last one after it.
Eigen::Array4d raised_slope(const Eigen::Array4d* at, int k, int n, int step)
{
  Eigen::Array4d slope = Eigen::Array4d::Zero();
  if (k > 0)
  {
    slope += k * (*at - *(at - step));
  }
  if (k < n)
  {
    slope += (n - k) * (*(at + step) - *at);
  }
  return slope;
}

/// The largest slope, and that of the weight, as parts of the weight.
struct Slopes
{
  double squared = 0.0;
  double of_weight = 0.0;

  void add(const Eigen::Array4d& slope, double inverse)
  {
    const Eigen::Array4d part = slope * inverse;
    this->squared = std::max(this->squared, part.head<3>().matrix().squaredNorm());
    this->of_weight = std::max(this->of_weight, std::abs(part(3)));
  }

  double bound(double radius) const { return std::sqrt(this->squared) + this->of_weight * radius; }
};

/// What bounds by the parameters of a piece are multiplied by, after adding the rounding of d / ω.
struct Scales
{
  double factor[2];
  double rounding[2];

  /// A pair of control points contributes (b − a) times 2 w_a w_b × reach at the most, and the
  /// pairs of a coefficient w_a w_b to one of w²; at degree 2p − 2 instead of 2p their binomials
  /// make 2p of it. So magnitudes sum up to p² (2 × reach) × the greatest coefficient, divided by
  /// the least one, and there are no more roundings of them than a form has.
  Scales(const Piece& piece, const DerivativeUnits& units)
  {
    const double unit = units.length * piece.shape->roundings * 0x1p-53 * piece.reach *
      (piece.greatest_weight / piece.least_weight);
    for (int i = 0; i < 2; ++i)
    {
      const double degree = piece.shape->degree[i];
      this->factor[i] = degree > 0.0 ? units.width[i] / piece.width[i] : 0.0;
      this->rounding[i] = 2.0 * degree * degree * unit;
    }
  }
};

} // namespace

void RationalDerivatives::prepare(const PieceShape& shape)
{
  if (this->Degree == shape.degree)
  {
    return;
  }
  this->Degree = shape.degree;
  this->Binomials = products_of_binomials(shape.degree[0], shape.degree[1]);
  this->Divisors = products_of_binomials(2 * shape.degree[0], 2 * shape.degree[1]);
  for (double& divisor : this->Divisors)
  {
    divisor = 1.0 / divisor;
  }
  this->Net.resize(this->Binomials.size());
  this->Inverses.resize(this->Divisors.size());
  for (std::vector<Vector4>& products : this->Products)
  {
    products.resize(this->Divisors.size());
  }
}

/// With control points (N, w) times their binomials,
///
///   u (1 − u) w² S_u = Σ (b − a) (w_ac N_bd − w_bd N_ac) u^{a+b} (1−u)^{2p−a−b} v^{c+d} (1−v)^{…}
///
/// over pairs a < b, all c and d, from B_a B_b' − B_a' B_b = (b − a) B_a B_b / (u (1 − u)); along v
/// likewise.
void RationalDerivatives::multiply(const double* net)
{
  const int p = this->Degree[0];
  const int q = this->Degree[1];
  for (std::size_t k = 0; k < this->Net.size(); ++k)
  {
    this->Net[k] = this->Binomials[k] * Map4(net + 4 * k);
  }
  for (std::vector<Vector4>& products : this->Products)
  {
    std::fill(products.begin(), products.end(), Vector4::Zero());
  }
  const Vector4* one = this->Net.data();
  for (int a = 0; a <= p; ++a)
  {
    for (int c = 0; c <= q; ++c, ++one)
    {
      const Vector4 here = *one;
      // The rest of the row, then the rows after it.
      for (int b = a; b <= p; ++b)
      {
        const int first = b == a ? c + 1 : 0;
        const Vector4* other = this->Net.data() + b * (q + 1) + first;
        const int place = (a + b) * (2 * q + 1) + c + first;
        Vector4* along_u = this->Products[0].data() + place;
        Vector4* along_v = this->Products[1].data() + place;
        const double rows = b - a;
        double columns = first - c;
        for (int d = first; d <= q; ++d, ++other, ++along_u, ++along_v, columns += 1.0)
        {
          const Vector4 across = here(3) * *other - (*other)(3) * here;
          *along_u += rows * across;
          *along_v += columns * across;
        }
      }
    }
  }
}

/// Makes d of the products, in units of length.
void RationalDerivatives::divide(const Piece& piece, double length)
{
  const PieceShape& shape = *piece.shape;
  const double* weights = piece.forms + 4 * shape.form_size;
  for (int row = 0; row < shape.rows; ++row)
  {
    for (int column = 0; column < shape.columns; ++column)
    {
      this->Inverses[row * shape.columns + column] = 1.0 / weights[row * shape.stride + column];
    }
  }
  const int steps[2] = { shape.columns, 1 };
  const int ends[2] = { shape.rows - 1, shape.columns - 1 };
  for (int i = 0; i < 2; ++i)
  {
    // Dividing by u (1 − u) and raising by two degrees, times (u + 1 − u)², sums three in a row.
    for (int line = 0; line <= ends[1 - i]; ++line)
    {
      int place = line * steps[1 - i];
      Vector4 before = Vector4::Zero();
      for (int k = 0; k <= ends[i]; ++k, place += steps[i])
      {
        const Vector4 here = this->Products[i][place];
        Vector4 sum = before + 2.0 * here;
        if (k < ends[i])
        {
          sum += this->Products[i][place + steps[i]];
        }
        before = here;
        this->Products[i][place] = (this->Divisors[place] * length) * sum;
      }
    }
  }
}

/// Boxes and radii; makes (e, ω) of d.
void RationalDerivatives::bound_first(const Piece& piece, PieceDerivatives& result)
{
  const PieceShape& shape = *piece.shape;
  const double* weights = piece.forms + 4 * shape.form_size;
  for (int i = 0; i < 2; ++i)
  {
    Vector4 least = Vector4::Constant(std::numeric_limits<double>::infinity());
    Vector4 most = -least;
    for (std::size_t k = 0; k < this->Inverses.size(); ++k)
    {
      const Vector4 quotient = this->Inverses[k] * this->Products[i][k];
      least = least.min(quotient);
      most = most.max(quotient);
    }
    const Vector4 half = 0.5 * (most - least);
    Vector4 middle = 0.5 * (least + most);
    for (int k = 0; k < 3; ++k)
    {
      result.box[k](i) = middle(k);
      result.box[k](2 + i) = half(k);
    }
    middle(3) = -1.0;
    double squared = 0.0;
    int place = 0;
    for (int row = 0; row < shape.rows; ++row)
    {
      for (int column = 0; column < shape.columns; ++column, ++place)
      {
        Vector4& product = this->Products[i][place];
        product -= weights[row * shape.stride + column] * middle;
        const Vector4 quotient = this->Inverses[place] * product;
        squared = std::max(squared, quotient.head<3>().matrix().squaredNorm());
      }
    }
    this->Radius[i] = std::sqrt(squared);
  }
}

void RationalDerivatives::bound_second(const PieceShape& shape, PieceDerivatives& result) const
{
  Slopes slopes[2][2]; // of e of the first, along the second direction
  int place = 0;
  for (int row = 0; row < shape.rows; ++row)
  {
    for (int column = 0; column < shape.columns; ++column, ++place)
    {
      for (int i = 0; i < 2; ++i)
      {
        const Vector4* at = this->Products[i].data() + place;
        slopes[i][0].add(
          raised_slope(at, row, shape.rows - 1, shape.columns), this->Inverses[place]);
        slopes[i][1].add(raised_slope(at, column, shape.columns - 1, 1), this->Inverses[place]);
      }
    }
  }
  result.second[0] = slopes[0][0].bound(this->Radius[0]);
  result.second[1] =
    std::min(slopes[0][1].bound(this->Radius[0]), slopes[1][0].bound(this->Radius[1]));
  result.second[2] = slopes[1][1].bound(this->Radius[1]);
}

PieceDerivatives RationalDerivatives::bounds(const Piece& piece, const DerivativeUnits& units)
{
  this->prepare(*piece.shape);
  this->multiply(piece.net);
  this->divide(piece, units.length);
  PieceDerivatives result;
  this->bound_first(piece, result);
  this->bound_second(*piece.shape, result);
  const Scales scales(piece, units);
  for (int i = 0; i < 2; ++i)
  {
    for (Vector4& coordinate : result.box)
    {
      coordinate(i) *= scales.factor[i];
      coordinate(2 + i) = scales.factor[i] * (coordinate(2 + i) + scales.rounding[i]);
    }
  }
  for (int k = 0; k < 3; ++k)
  {
    // Slopes along j are differences of two of d or of m ω, 2 degree_j times, and those of the
    // weight are off as much of S_i − m.
    const int i = k / 2;
    const int j = (k + 1) / 2;
    const double most = std::max(
      piece.shape->degree[j] * scales.rounding[i], piece.shape->degree[i] * scales.rounding[j]);
    result.second[k] = scales.factor[i] * scales.factor[j] * (result.second[k] + 16.0 * most);
  }
  return result;
}

double RationalDerivatives::speed(
  const Piece& piece, const DerivativeUnits& units, const BlockFrame& frame)
{
  this->prepare(*piece.shape);
  this->multiply(piece.net);
  this->divide(piece, units.length);
  const Scales scales(piece, units);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < this->Inverses.size(); ++k)
  {
    const Vector3 u =
      this->Inverses[k] * scales.factor[0] * this->Products[0][k].head<3>().matrix();
    const Vector3 v =
      this->Inverses[k] * scales.factor[1] * this->Products[1][k].head<3>().matrix();
    least = std::min(least, frame.least_speed(u, v));
  }
  const double rounding = scales.factor[0] * scales.rounding[0] * frame.inverse[0] +
    scales.factor[1] * scales.rounding[1] * frame.inverse[1];
  return least - 2.0 * rounding;
}

} // namespace footpoint
