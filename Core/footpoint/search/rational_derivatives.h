// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/search/block_frame.h"

#include <Eigen/Core>

#include <vector>

namespace footpoint
{

/// Bounds the derivatives of rational pieces S = N / w, one after the other, from the Bernstein
/// coefficients d_k of w² S_u = w N_u − w_u N and ω_k of w² at the degree of the forms: S_u lies in
/// the hull of d_k / ω_k, as all ω_k are positive. The same for S_v.
///
/// Of the second derivatives, with m any vector and e = w² (S_i − m) in Bernstein form,
///
///   w² S_ij = e_j − (w²)_j (S_i − m),
///
/// where S_i − m is small for m in the middle of the box: |S_ij| is at most the largest of
/// |(e_j)_k| / ω_k and that of |((w²)_j)_k| / ω_k times the radius of S_i about m.
///
/// The work is that of the squares of the forms, (p + 1)² (q + 1)² / 2 products of vectors. The
/// memory is that of two forms of vectors.
class RationalDerivatives
{
public:
  /// A curve's first direction has derivatives of zero. Where the weights leave no bound, it is
  /// infinite or NaN. \pre the piece is rational
  PieceDerivatives bounds(const Piece& piece, const DerivativeUnits& units);

  /// BlockFrame::speed_of's bound from both derivatives together instead of a box of each: the
  /// least eigenvalue is a concave function of them, least at one of the pairs of coefficients.
  double speed(const Piece& piece, const DerivativeUnits& units, const BlockFrame& frame);

private:
  using Vector4 = Eigen::Array4d;

  void prepare(const PieceShape& shape);
  void multiply(const double* net);
  void divide(const Piece& piece, double length);
  void bound_first(const Piece& piece, PieceDerivatives& result);
  void bound_second(const PieceShape& shape, PieceDerivatives& result) const;

  std::array<int, 2> Degree{ { -1, -1 } }; ///< of the last piece
  std::vector<double> Binomials;           ///< C(p, a) C(q, c), as the control points of a net
  std::vector<double> Divisors;            ///< 1 / (C(2p, k) C(2q, l)), rows without padding
  std::vector<Vector4> Net;                ///< times Binomials
  /// Sums of pairs of control points, then d and e, for either direction; rows without padding.
  std::vector<Vector4> Products[2];
  std::vector<double> Inverses; ///< 1 / ω_k
  double Radius[2];             ///< of S_i about the middle of its box
};

} // namespace footpoint
