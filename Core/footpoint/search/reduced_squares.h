// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/search/distance_forms.h"

#include <array>
#include <vector>

namespace footpoint
{

/// Numbers in rows, each padded to a multiple of four, by zeros where nothing else is said.
struct NumberRows
{
  int rows = 0;
  int columns = 0;
  int stride = 0; ///< from row to row
  std::vector<double> numbers;

  NumberRows() = default;
  NumberRows(int row_count, int column_count)
    : rows(row_count)
    , columns(column_count)
    , stride((column_count + 3) / 4 * 4)
    , numbers(static_cast<std::size_t>(rows) * stride, 0.0)
  {
  }
  double* operator[](int row) { return this->numbers.data() + row * this->stride; }
  const double* operator[](int row) const { return this->numbers.data() + row * this->stride; }
};

/// The square of the distance from a piece's origin brought down to the degree of the piece: for
/// pieces of one shape, one after the other, numbers a_k with
///
///   |S|² ≥ Σ R_k a_k,   R_k = w_k B_k / w the rational basis.
///
/// Σ B_k w_k a_k is w |S|² interpolated at Chebyshev's nodes, less σ w: σ is the least number for
/// which all coefficients of Q − w Σ B_k w_k a_k, which has twice the degree, are seen to be
/// positive. Directions of degree one are raised to two first, so that the square of the way along
/// them is kept. The memory is that of one piece.
class ReducedSquares
{
public:
  explicit ReducedSquares(const PieceShape& shape);

  /// \param piece of that shape, with its forms
  void take(const Piece& piece);

  // Of the piece taken, coefficient (i, j) in row i and column j.

  const NumberRows& squares() const { return this->Squares; } ///< a
  /// w x, w y, w z and w, to the same degree
  const std::array<NumberRows, 4>& net() const { return this->Net; }

private:
  /// X → first X second, of coefficients along both directions.
  struct Operator
  {
    NumberRows first;
    NumberRows second;
    NumberRows between; ///< first X
  };
  /// \param stride of the rows of the source
  static void apply(Operator& what, const double* source, int stride, NumberRows& result);
  void take_net(const Piece& piece);
  /// σ, for what Squares has to be lowered by yet.
  double excess(const Piece& piece);
  double rational_excess(const Piece& piece);
  /// Of a coefficient of what is to be positive.
  double rounding(const Piece& piece) const;

  const PieceShape& Shape;
  bool Raises;            ///< whether the degree is another one than that of the piece
  Operator Reducing;      ///< from Q to what interpolates it
  Operator Sampling;      ///< of Q, at the nodes …
  Operator Weights;       ///< … and of w
  Operator Interpolating; ///< coefficients from samples
  Operator RaisingNet;    ///< to the degree of the result
  Operator RaisingForm;   ///< from the degree of Q to that of w Σ B_k w_k a_k
  Operator RaisingResult; ///< of a polynomial to the degree of Q, rows padded as those of a form
  NumberRows Divisors;    ///< binomial coefficients of w Σ B_k w_k a_k

  std::array<NumberRows, 4> Net;
  NumberRows Squares;
  // While a piece is taken:
  std::array<NumberRows, 4> Own; ///< the net as it is
  NumberRows Samples;
  NumberRows WeightSamples;
  NumberRows Product;
  NumberRows Form;
  NumberRows SquaredWeights;
};

} // namespace footpoint
