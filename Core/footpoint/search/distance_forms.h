// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/common/execution.h"
#include "footpoint/search/aligned_array.h"
#include "footpoint/search/box_tree.h"
#include "footpoint/splines/bezier.h"
#include "footpoint/trims/edge_curve.h"

#include <array>
#include <cstdint>
#include <vector>

namespace footpoint
{

/// Two along directions of degree one, where the square of the way has no coefficients otherwise.
constexpr int raised_degree(int degree)
{
  return degree == 1 ? 2 : degree;
}

/// What a side of a piece is.
enum class PieceSide : std::uint8_t
{
  Smooth,   ///< the geometry goes on, once continuously differentiable
  Boundary, ///< an open end
  Special   ///< kink, gap, seam, pole or a border with another patch
};

/// Degrees of a piece and what follows from them for the layout of its numbers.
///
/// Rows run along the first direction, columns along the second. A curve is one row: its only
/// direction is the second one, and the degree of the first is 0.
struct PieceShape
{
  std::array<int, 2> degree;
  bool rational;
  int rows;            ///< of a form, 2 degree[0] + 1
  int columns;         ///< of a form, 2 degree[1] + 1
  int stride;          ///< numbers from one row of a form to the next, a multiple of 8
  int net_size;        ///< numbers of the control net, padded to a multiple of 8
  int form_size;       ///< rows × stride
  int number_of_forms; ///< Q; if rational also Wx, Wy, Wz and W2
  double
    roundings; ///< roundings (units of 2^-53) in the computed value of a form, see DistanceForms
  /// halving[i][end]: column k, row j is the weight of coefficient k in coefficient j of the half
  /// at that end (de Casteljau 1959), along direction i; columns are padded like rows of a form for
  /// the second direction.
  std::array<std::array<std::vector<double>, 2>, 2> halving;
  /// raising[i]: column k, row j is the weight of coefficient k of a polynomial of the piece's
  /// degree in coefficient j of a form (degree elevation; A. R. Forrest 1972), padded likewise.
  std::array<std::vector<double>, 2> raising;
  /// halves[i]: column k, row j is the weight of coefficient k of a polynomial of the outline's
  /// degree (ReducedSquares) in coefficient j of its two halves, one after the other and with one
  /// in common; padded to halves_stride for the second direction.
  std::array<std::vector<float>, 2> halves;
  int halves_stride;

  PieceShape(int p, int q, bool is_rational);
};

/// Pieces, each some microseconds of work, from which on they are shared out among threads.
constexpr std::int64_t kPiecesForThreads = 2048;

/// One Bézier piece. Positions are relative to the piece's origin.
struct Piece
{
  const double* net;   ///< rows of (w·x, w·y, w·z, w)
  const double* forms; ///< Q and, if rational, Wx, Wy, Wz, W2, one after the other
  const PieceShape* shape;
  std::array<double, 3> origin; ///< in the model's centred coordinates
  double reach;                 ///< the largest distance of a control point from the origin
  double greatest_weight;       ///< largest coefficient of W2
  double least_weight;          ///< smallest one
  std::array<double, 2> lower;  ///< local parameter of the patch at the piece's start …
  std::array<double, 2> width;  ///< … and how far it reaches
  std::array<double, 2> upper;
  std::int32_t patch;
  std::array<std::array<PieceSide, 2>, 2> sides; ///< [direction][end]
  const TrimRegion* region; ///< of which the piece's points have to be; null: all of them count
  std::array<double, 2> kept; ///< a point of the piece that the region keeps
  bool edge;    ///< of a trimmed face
  double error; ///< how far the piece may be from the geometry, beyond rounding
};

/// For loops over the nets of pieces, which lie far apart in memory: asks for the start of the net
/// of a piece a few after this one, if it is before the end.
void prefetch_net_after(const AlignedVector<Piece>& pieces, std::int64_t index, std::int64_t end);

/// The Bézier pieces of all splines of a model, each with its *distance form*: for a query P and a
/// number T the polynomial
///
///   F(u, v) = w²(|S − P|² − T) = Q − 2 P·W + (|P|² − T) W2,   Q = N·N, W = w N, W2 = w²,
///
/// N = w S being the homogeneous coordinates. F is affine in P, and so are its Bernstein
/// coefficients; where all of them are positive, no point of the piece is nearer than √T
/// (convex-hull property; T. W. Sederberg and T. Nishita 1990 for the idea). Of polynomial pieces,
/// whose W = N is the net itself raised to the degree of F, only Q is stored: two fifths of the
/// numbers, and memory is what large models wait for.
///
/// Built once; const.
class DistanceForms
{
public:
  /// \param few_pieces bent pieces are cut as long as their patch has fewer than so many: speed for
  ///                   patches of few pieces, bounded memory for models of many patches
  explicit DistanceForms(std::size_t few_pieces = 1024)
    : FewPieces(few_pieces)
  {
  }

  /// Adds the pieces of a patch.
  /// \param offset of the patch's centre from the model's
  /// \param special sides that are no boundary: [direction][end]
  void add(std::int32_t patch, const Curve& curve, const Vector3& offset,
    const std::array<std::array<bool, 2>, 2>& special);
  /// \param region outlives the forms; what it does not keep is left out. Null: not trimmed.
  /// \param execution whose threads share the pieces of a large one that is not trimmed
  void add(std::int32_t patch, const Surface& surface, const Vector3& offset,
    const std::array<std::array<bool, 2>, 2>& special, const TrimRegion* region = nullptr,
    const Execution& execution = {});
  void add(std::int32_t patch, const EdgeCurve& edge, const EdgePieces& pieces,
    const Vector3& offset);

  const AlignedVector<Piece>& pieces() const { return this->Pieces; }

  /// The largest error of a piece.
  double greatest_error() const { return this->GreatestError; }

  /// Corners of the box of a piece's control points, in the model's centred coordinates.
  const AlignedVector<Corners>& boxes() const { return this->Boxes; }

private:
  const PieceShape* shape(int p, int q, bool rational);
  const PieceShape* shape_of(const Surface& surface);
  void add_trimmed(std::int32_t patch, const Surface& surface, const Vector3& offset,
    const std::array<std::array<bool, 2>, 2>& special, const TrimRegion& region);
  /// \param source of size() Bézier pieces, whose for_each(begin, end, visit) gives them one after
  ///        the other
  template <int N, class Source>
  void append(std::int32_t patch, const Source& source, const ParametricGeometry<N>& geometry,
    const PieceShape* shape, const Vector3& offset,
    const std::array<std::array<bool, 2>, 2>& special, const Execution& execution = {});

  std::size_t FewPieces;
  std::vector<std::unique_ptr<PieceShape>> Shapes;
  std::vector<AlignedArray<double>> Numbers;
  AlignedVector<Piece> Pieces;
  AlignedVector<Corners> Boxes;
  double GreatestError = 0.0;
};

} // namespace footpoint
