// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/search/distance_forms.h"

namespace footpoint
{

/// Computes the distance forms of pieces of one shape, one after the other: products of polynomials
/// in Bernstein form (R. T. Farouki and V. T. Rajan 1988),
///
///   C(n, i) a_i = â_i:   (a b)^_m = Σ_{i + j = m} â_i b̂_j,
///
/// whose factors do not change from piece to piece. The memory is that of one net.
class FormProducts
{
public:
  explicit FormProducts(const PieceShape& shape);

  /// \param net   rows of (w·x, w·y, w·z, w), the second direction fastest, as in Piece
  /// \param forms receives Q and, if rational, Wx, Wy, Wz, W2, every row padded by its last
  ///        coefficient
  void fill(const double* net, double* forms);

private:
  const PieceShape& Shape;
  std::vector<double> Binomials; ///< C(p, i) C(q, j), as the control points of a net
  std::vector<double> Divisors;  ///< 1 / (C(2p, i) C(2q, j)), as the coefficients of a form
  /// The net times Binomials: x, y, z and w of each row apart, between zeros.
  std::vector<double> Lines;
};

} // namespace footpoint
