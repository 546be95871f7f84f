// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/splines/bezier.h"

#include "footpoint/splines/de_boor.h"
#include "footpoint/splines/validation.h"

namespace footpoint
{

namespace
{

using Homogeneous = Eigen::Matrix<double, 4, Eigen::Dynamic>;

} // namespace

// Bézier point j of the piece [a, b] is the blossom with degree − j arguments a and j arguments b
// (L. Ramshaw 1989). All its coefficients are sums of positive products; at high degree nothing
// cancels.
BezierSpan bezier_span(const KnotVector& knots, int span, double a, double b)
{
  const int p = knots.degree();
  BezierSpan piece{ a, b, span - p, Eigen::MatrixXd(p + 1, p + 1) };
  for (int j = 0; j <= p; ++j)
  {
    double* column = piece.matrix.col(j).data();
    column[0] = 1.0;
    for (int degree = 1; degree <= p; ++degree)
    {
      raise_degree(knots.local_knots().data(), span, degree, degree <= j ? b : a, column);
    }
  }
  return piece;
}

std::vector<BezierSpan> bezier_spans(const KnotVector& knots)
{
  std::vector<BezierSpan> pieces;
  const std::vector<DistinctKnot>& distinct = knots.distinct_knots();
  for (std::size_t i = 0; i + 1 < distinct.size(); ++i)
  {
    const int span = knots.find_span(distinct[i].at, Side::Right);
    pieces.push_back(bezier_span(knots, span, distinct[i].at, distinct[i + 1].at));
  }
  return pieces;
}

std::vector<BezierPiece<1>> extract_bezier(const Curve& curve)
{
  const Homogeneous net = homogeneous(curve.local_control_points(), curve.weights());
  const int p = curve.knots().degree();
  std::vector<BezierPiece<1>> pieces;
  for (const BezierSpan& u : bezier_spans(curve.knots()))
  {
    pieces.push_back({ { { p } }, Parameter<1>(u.lower), Parameter<1>(u.upper),
      net.middleCols(u.first, p + 1) * u.matrix });
  }
  return pieces;
}

std::vector<BezierPiece<2>> extract_bezier(const Surface& surface)
{
  const SurfacePieces source(surface);
  std::vector<BezierPiece<2>> pieces;
  pieces.reserve(source.size());
  source.for_each([&pieces](const BezierPiece<2>& piece) { pieces.push_back(piece); });
  return pieces;
}

SurfacePieces::SurfacePieces(const Surface& surface)
  : Degree{ { surface.knots(0).degree(), surface.knots(1).degree() } }
  , Spans{ { bezier_spans(surface.knots(0)), bezier_spans(surface.knots(1)) } }
  , Length(surface.knots(0).number_of_control_points())
  , Net(homogeneous(surface.local_control_points(), surface.weights()))
{
}

void SurfacePieces::extract_row(const BezierSpan& v, Homogeneous& row) const
{
  const int lines = this->Degree[1] + 1;
  row.resize(4, this->Length * lines);
  // Column j of these views is line j of the net and of the row.
  const Eigen::Map<const Eigen::MatrixXd> acting(
    this->Net.col(v.first * this->Length).data(), 4 * this->Length, lines);
  Eigen::Map<Eigen::MatrixXd>(row.data(), 4 * this->Length, lines).noalias() = acting * v.matrix;
}

void SurfacePieces::extract_piece(
  const BezierSpan& u, const BezierSpan& v, const Homogeneous& row, BezierPiece<2>& piece) const
{
  const int along_u = this->Degree[0] + 1;
  const int along_v = this->Degree[1] + 1;
  piece.degree = this->Degree;
  piece.lower = { u.lower, v.lower };
  piece.upper = { u.upper, v.upper };
  piece.control.resize(4, along_u * along_v);
  for (int j = 0; j < along_v; ++j)
  {
    const auto acting = row.middleCols(j * this->Length + u.first, along_u);
    for (int i = 0; i < along_u; ++i)
    {
      // Column by column: so small a matrix product is not worth its preparation.
      Eigen::Vector4d point = u.matrix(0, i) * acting.col(0);
      for (int k = 1; k < along_u; ++k)
      {
        point += u.matrix(k, i) * acting.col(k);
      }
      piece.control.col(j * along_u + i) = point;
    }
  }
}

template <int N>
std::array<BezierPiece<N>, 2> halve(const BezierPiece<N>& piece, int direction)
{
  const int degree = piece.degree[direction];
  const int step = direction == 0 ? 1 : piece.degree[0] + 1;
  const int lines = static_cast<int>(piece.control.cols()) / (degree + 1);
  std::array<BezierPiece<N>, 2> halves{ { piece, piece } };
  Homogeneous& left = halves[0].control;
  Homogeneous& right = halves[1].control; // is overwritten from the front by de Casteljau's columns
  for (int line = 0; line < lines; ++line)
  {
    const int start = direction == 0 ? line * (degree + 1) : line;
    for (int level = 1; level <= degree; ++level)
    {
      for (int j = 0; j <= degree - level; ++j)
      {
        const int here = start + j * step;
        right.col(here) = 0.5 * (right.col(here) + right.col(here + step));
      }
      left.col(start + level * step) = right.col(start);
    }
  }
  const double middle =
    piece.lower[direction] + 0.5 * (piece.upper[direction] - piece.lower[direction]);
  halves[0].upper[direction] = middle;
  halves[1].lower[direction] = middle;
  return halves;
}

template <int N>
std::array<Vector3, 2> bounding_box(const BezierPiece<N>& piece)
{
  std::array<Vector3, 2> box{ { piece.control.template block<3, 1>(0, 0) / piece.control(3, 0),
    piece.control.template block<3, 1>(0, 0) / piece.control(3, 0) } };
  for (Eigen::Index i = 1; i < piece.control.cols(); ++i)
  {
    const Vector3 point = piece.control.template block<3, 1>(0, i) / piece.control(3, i);
    box[0] = box[0].cwiseMin(point);
    box[1] = box[1].cwiseMax(point);
  }
  return box;
}

template std::array<BezierPiece<1>, 2> halve(const BezierPiece<1>&, int);
template std::array<BezierPiece<2>, 2> halve(const BezierPiece<2>&, int);
template std::array<Vector3, 2> bounding_box(const BezierPiece<1>&);
template std::array<Vector3, 2> bounding_box(const BezierPiece<2>&);

} // namespace footpoint
