// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/splines/curve.h"
#include "footpoint/splines/surface.h"

#include <vector>

namespace footpoint
{

/// A polynomial or rational Bézier piece of a curve (N = 1) or surface (N = 2).
///
/// Columns of `control` are homogeneous control points (w·x, w·y, w·z, w), positions relative to
/// the geometry's centre, first direction fastest, (degree[0] + 1)(·(degree[1] + 1)) of them.
template <int N>
struct BezierPiece
{
  std::array<int, N> degree;
  Parameter<N> lower; ///< local parameters of the piece's corner …
  Parameter<N> upper; ///< … and of the opposite one
  Eigen::Matrix<double, 4, Eigen::Dynamic> control;
};

/// One span of a knot vector and how its control points make the Bézier points of that span.
struct BezierSpan
{
  double lower; ///< local parameters
  double upper;
  int first;              ///< the first of the degree + 1 control points that act on the span
  Eigen::MatrixXd matrix; ///< Bézier point j = Σ_i control point (first + i) · matrix(i, j)
};

/// The operator for [a, b], a span or a part of one. \param span from KnotVector::find_span
BezierSpan bezier_span(const KnotVector& knots, int span, double a, double b);

/// The extraction operators of all spans (M. J. Borden et al. 2011), ascending. Neighbours have the
/// same border point bit for bit, except at a gap.
std::vector<BezierSpan> bezier_spans(const KnotVector& knots);

/// The pieces between all knot lines, first direction fastest. Exact up to rounding: each
/// control point is the blossom of its piece (L. Ramshaw 1989; the result of inserting all knots to
/// full multiplicity, W. Boehm 1980), so unclamped ends and gaps need no special care. Neighbours
/// share the control points on their border bit for bit, except at a gap.
std::vector<BezierPiece<1>> extract_bezier(const Curve& curve);
std::vector<BezierPiece<2>> extract_bezier(const Surface& surface);

/// The same pieces of a surface one at a time, in memory of one row: for nets of many spans.
///
/// The operators of all spans are made once. For a span of the second direction its operator is
/// applied to the whole net first, which all pieces of that row then share.
class SurfacePieces
{
public:
  explicit SurfacePieces(const Surface& surface);

  std::size_t size() const { return this->Spans[0].size() * this->Spans[1].size(); }

  /// Calls visit(const BezierPiece<2>&) for each piece, or each of a range; the next one overwrites
  /// it.
  template <class Visit>
  void for_each(const Visit& visit) const
  {
    this->for_each(0, this->size(), visit);
  }
  template <class Visit>
  void for_each(std::size_t begin, std::size_t end, const Visit& visit) const;

private:
  using Homogeneous = Eigen::Matrix<double, 4, Eigen::Dynamic>;

  /// The net of a row of pieces: Bézier along the second direction, as it was along the first.
  void extract_row(const BezierSpan& v, Homogeneous& row) const;
  void extract_piece(
    const BezierSpan& u, const BezierSpan& v, const Homogeneous& row, BezierPiece<2>& piece) const;

  std::array<int, 2> Degree;
  std::array<std::vector<BezierSpan>, 2> Spans;
  Eigen::Index Length; ///< control points of a line of the net along the first direction
  Homogeneous Net;
};

/// Cuts a piece in two at the middle of a direction (de Casteljau 1959).
template <int N>
std::array<BezierPiece<N>, 2> halve(const BezierPiece<N>& piece, int direction);

/// Corners of the bounding box of the control points; it holds the piece (convex-hull property).
template <int N>
std::array<Vector3, 2> bounding_box(const BezierPiece<N>& piece);

template <class Visit>
void SurfacePieces::for_each(std::size_t begin, std::size_t end, const Visit& visit) const
{
  Homogeneous row;
  BezierPiece<2> piece;
  const std::size_t columns = this->Spans[0].size();
  for (std::size_t k = begin; k < end; ++k)
  {
    const BezierSpan& v = this->Spans[1][k / columns];
    if (k == begin || k % columns == 0)
    {
      this->extract_row(v, row);
    }
    this->extract_piece(this->Spans[0][k % columns], v, row, piece);
    visit(static_cast<const BezierPiece<2>&>(piece));
  }
}

} // namespace footpoint
