// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/search/distance_forms.h"

#include "footpoint/search/form_products.h"
#include "footpoint/search/piece_cutting.h"
#include "footpoint/search/trimmed_pieces.h"
#include "footpoint/splines/binomials.h"

#include <hwy/cache_control.h>

#include <algorithm>
#include <cmath>

namespace footpoint
{
namespace
{

/// Numbers in a row of a form are padded to whole vectors of eight.
int padded(int count)
{
  return (count + 7) / 8 * 8;
}

/// Every row goes on with its entry n.
void pad(std::vector<double>& rows, int n, int stride)
{
  for (std::size_t row = 0; row < rows.size(); row += stride)
  {
    std::fill(rows.begin() + row + n + 1, rows.begin() + row + stride, rows[row + n]);
  }
}

/// Weights of the coefficients of a polynomial of degree n in those of its half.
std::vector<double> halving_weights(int n, int end, int stride)
{
  std::vector<double> weights((n + 1) * stride, 0.0);
  for (int j = 0; j <= n; ++j)
  {
    const int level = end == 0 ? j : n - j;
    const std::vector<double> row = binomials(level);
    for (int k = 0; k <= level; ++k)
    {
      weights[(end == 0 ? k : j + k) * stride + j] = std::ldexp(row[k], -level);
    }
  }
  pad(weights, n, stride);
  return weights;
}

/// Weights of the coefficients of a polynomial of degree n in those of degree 2 n.
std::vector<double> raising_weights(int n, int stride)
{
  std::vector<double> weights((n + 1) * stride, 0.0);
  const std::vector<double> row = binomials(n);
  const std::vector<double> raised = binomials(2 * n);
  for (int j = 0; j <= 2 * n; ++j)
  {
    for (int k = std::max(0, j - n); k <= std::min(n, j); ++k)
    {
      weights[k * stride + j] = row[k] * row[j - k] / raised[j];
    }
  }
  pad(weights, 2 * n, stride);
  return weights;
}

/// Weights of the coefficients of a polynomial of degree n in those of its two halves.
std::vector<float> weights_of_halves(int n, int stride)
{
  std::vector<float> weights((n + 1) * stride);
  const std::vector<double> lower = halving_weights(n, 0, n + 1);
  const std::vector<double> upper = halving_weights(n, 1, n + 1);
  for (int k = 0; k <= n; ++k)
  {
    for (int j = 0; j < stride; ++j)
    {
      const int of = std::min(j, 2 * n);
      const double weight = of < n ? lower[k * (n + 1) + of] : upper[k * (n + 1) + of - n];
      weights[k * stride + j] = static_cast<float>(weight);
    }
  }
  return weights;
}

/// Where positions of a piece are measured from: a point at which a derivative vanishes (a
/// collapsed side; a curve's repeated end), so that it comes out with all digits near there, else
/// the middle. \param points of the control net; a curve's are one line
template <int N>
Vector3 origin_of(
  const std::array<int, N>& degree, const Points& points, const Vector3& middle, double size)
{
  auto collapsed = [&](Eigen::Index first, Eigen::Index step, Eigen::Index count)
  {
    bool result = true;
    for (Eigen::Index k = 1; k < count; ++k)
    {
      result = result &&
        (points.col(first + k * step) - points.col(first)).norm() <= kClosureTolerance * size;
    }
    return result;
  };
  const Eigen::Index along_u = degree[0] + 1;
  const Eigen::Index along_v = points.cols() / along_u;
  const Eigen::Index last = points.cols() - 1;
  if (N == 1)
  {
    const bool start = along_u > 2 && collapsed(0, 1, 2);
    const bool end = along_u > 2 && collapsed(last - 1, 1, 2);
    return start ? Vector3(points.col(0)) : (end ? Vector3(points.col(last)) : middle);
  }
  if (collapsed(0, 1, along_u) || collapsed(0, along_u, along_v))
  {
    return points.col(0);
  }
  if (collapsed(last - along_u + 1, 1, along_u) || collapsed(along_u - 1, along_u, along_v))
  {
    return points.col(last);
  }
  return middle;
}

bool is_rational(const BezierPiece<1>& piece)
{
  return (piece.control.row(3).array() != piece.control(3, 0)).any();
}

PieceSide side_of(const Direction& direction, double at, const std::array<bool, 2>& special)
{
  const bool start = at == 0.0;
  const bool end = at == direction.length;
  if (start || end)
  {
    const bool open = !direction.closed && !direction.collapsed[end] && !special[end];
    return open ? PieceSide::Boundary : PieceSide::Special;
  }
  const auto line = std::lower_bound(direction.breaks.begin(), direction.breaks.end(), at,
    [](const Break& one, double where) { return one.at < where; });
  const bool is_break = line != direction.breaks.end() && line->at == at;
  return is_break ? PieceSide::Special : PieceSide::Smooth;
}

/// Pieces that were cut; SurfacePieces gives those that are not.
template <int N>
struct KeptPieces
{
  std::vector<BezierPiece<N>> all;

  std::size_t size() const { return this->all.size(); }

  template <class Visit>
  void for_each(std::size_t begin, std::size_t end, const Visit& visit) const
  {
    std::for_each(this->all.data() + begin, this->all.data() + end, visit);
  }
};

/// Writes the control net as rows along the second direction, relative to the piece's origin.
/// \param points of the control net \return the largest distance of one from the origin
template <int N>
double fill_net(const PieceShape& shape, const BezierPiece<N>& source, const Points& points,
  const Vector3& origin, double* net)
{
  // A common factor of the weights changes nothing: a power of two, so that the largest is near 1.
  const double scale =
    shape.rational ? std::ldexp(1.0, -std::ilogb(source.control.row(3).maxCoeff())) : 1.0;
  double squared_reach = 0.0;
  double* target = net;
  for (int i = 0; i <= shape.degree[0]; ++i)
  {
    for (int j = 0; j <= shape.degree[1]; ++j, target += 4)
    {
      const int column = N == 2 ? j * (shape.degree[0] + 1) + i : j;
      const double w = shape.rational ? scale * source.control(3, column) : 1.0;
      const Vector3 at = points.col(column) - origin;
      squared_reach = std::max(squared_reach, at.squaredNorm());
      target[0] = w * at(0);
      target[1] = w * at(1);
      target[2] = w * at(2);
      target[3] = w;
    }
  }
  std::fill(target, net + shape.net_size, 0.0);
  return std::sqrt(squared_reach);
}

/// Where a piece lies in its patch.
template <int N>
void fill_place(const ParametricGeometry<N>& geometry,
  const std::array<std::array<bool, 2>, 2>& special, const BezierPiece<N>& source, Piece& piece)
{
  for (int i = 0; i < 2; ++i)
  {
    const int from = N == 2 ? i : 0;
    const bool used = N == 2 || i == 1;
    piece.lower[i] = used ? source.lower(from) : 0.0;
    piece.upper[i] = used ? source.upper(from) : 0.0;
    piece.width[i] = piece.upper[i] - piece.lower[i];
    const Direction& direction = geometry.direction(from);
    for (int end = 0; end < 2; ++end)
    {
      piece.sides[i][end] = used
        ? side_of(direction, end == 0 ? piece.lower[i] : piece.upper[i], special[from])
        : PieceSide::Smooth;
    }
  }
}

} // namespace

PieceShape::PieceShape(int p, int q, bool is_rational)
  : degree{ { p, q } }
  , rational(is_rational)
  , rows(2 * p + 1)
  , columns(2 * q + 1)
  , stride(padded(columns))
  , net_size(padded(4 * (p + 1) * (q + 1)))
  , form_size(rows * stride)
  , number_of_forms(is_rational ? 5 : 1)
  , roundings(3.0 * (p + 1) * (q + 1) + 32.0)
{
  for (int end = 0; end < 2; ++end)
  {
    this->halving[0][end] = halving_weights(2 * p, end, 2 * p + 1);
    this->halving[1][end] = halving_weights(2 * q, end, this->stride);
  }
  this->raising = { { raising_weights(p, 2 * p + 1), raising_weights(q, this->stride) } };
  const int n = raised_degree(p);
  const int m = raised_degree(q);
  this->halves_stride = padded(2 * m + 1);
  this->halves = { { weights_of_halves(n, 2 * n + 1), weights_of_halves(m, this->halves_stride) } };
}

void prefetch_net_after(const AlignedVector<Piece>& pieces, std::int64_t index, std::int64_t end)
{
  constexpr std::int64_t kAhead = 4;
  constexpr int kMostNumbers = 256;
  if (index + kAhead < end)
  {
    const Piece& piece = pieces[index + kAhead];
    const int size = std::min(piece.shape->net_size, kMostNumbers);
    for (int k = 0; k < size; k += 8) // of 64 bytes
    {
      hwy::Prefetch(piece.net + k);
    }
  }
}

const PieceShape* DistanceForms::shape_of(const Surface& surface)
{
  return this->shape(surface.knots(0).degree(), surface.knots(1).degree(), surface.rational());
}

const PieceShape* DistanceForms::shape(int p, int q, bool rational)
{
  for (const auto& known : this->Shapes)
  {
    if (known->degree[0] == p && known->degree[1] == q && known->rational == rational)
    {
      return known.get();
    }
  }
  this->Shapes.push_back(std::make_unique<PieceShape>(p, q, rational));
  return this->Shapes.back().get();
}

template <int N, class Source>
void DistanceForms::append(std::int32_t patch, const Source& source,
  const ParametricGeometry<N>& geometry, const PieceShape* shape, const Vector3& offset,
  const std::array<std::array<bool, 2>, 2>& special, const Execution& execution)
{
  const std::size_t count = source.size();
  const std::size_t forms = static_cast<std::size_t>(shape->number_of_forms) * shape->form_size;
  const std::size_t numbers_of_piece = shape->net_size + forms;
  this->Numbers.emplace_back(numbers_of_piece * count + 8); // loads may read beyond the end
  double* const numbers = this->Numbers.back().data();
  std::fill(numbers + numbers_of_piece * count, numbers + this->Numbers.back().size(), 0.0);
  const std::size_t before = this->Pieces.size();
  const std::size_t needed = before + count;
  if (needed > this->Pieces.capacity())
  {
    this->Pieces.reserve(std::max(needed, 2 * before));
    this->Boxes.reserve(std::max(needed, 2 * before));
  }
  this->Pieces.resize(needed);
  this->Boxes.resize(needed);
  const auto fill = [&](std::int64_t begin, std::int64_t end)
  {
    FormProducts products(*shape);
    Points points;
    double* net = numbers + numbers_of_piece * begin;
    Piece* next = this->Pieces.data() + before + begin;
    Corners* box = this->Boxes.data() + before + begin;
    const auto take = [&](const BezierPiece<N>& bezier)
    {
      points = bezier.control.template topRows<3>();
      if (shape->rational || bezier.control(3, 0) != 1.0)
      {
        points.array().rowwise() /= bezier.control.row(3).array();
      }
      const Vector3 lower = points.rowwise().minCoeff();
      const Vector3 upper = points.rowwise().maxCoeff();
      const Vector3 origin =
        origin_of<N>(bezier.degree, points, 0.5 * (lower + upper), geometry.size());
      double* const form = net + shape->net_size;
      Piece& piece = *next++;
      piece.shape = shape;
      piece.patch = patch;
      piece.net = net;
      piece.forms = form;
      piece.reach = fill_net<N>(*shape, bezier, points, origin, net);
      products.fill(net, form);
      piece.least_weight = 1.0;
      piece.greatest_weight = 1.0;
      if (shape->rational)
      {
        const double* first = form + 4 * shape->form_size;
        piece.least_weight = *std::min_element(first, first + shape->form_size);
        piece.greatest_weight = *std::max_element(first, first + shape->form_size);
      }
      for (int i = 0; i < 3; ++i)
      {
        piece.origin[i] = offset(i) + origin(i);
      }
      fill_place<N>(geometry, special, bezier, piece);
      piece.region = nullptr;
      piece.kept = { { 0.5, 0.5 } };
      piece.edge = false;
      piece.error = 0.0;
      *box++ = { { lower + offset, upper + offset } };
      net += numbers_of_piece;
    };
    source.for_each(begin, end, take);
  };
  for_ranges(execution, static_cast<std::int64_t>(count), kPiecesForThreads, fill);
}

void DistanceForms::add(std::int32_t patch, const Curve& curve, const Vector3& offset,
  const std::array<std::array<bool, 2>, 2>& special)
{
  const KeptPieces<1> pieces{ cut_pieces<1>(extract_bezier(curve), this->FewPieces) };
  this->append<1>(patch, pieces, curve,
    this->shape(0, curve.knots().degree(), curve.rational()), offset, special);
}

void DistanceForms::add(std::int32_t patch, const Surface& surface, const Vector3& offset,
  const std::array<std::array<bool, 2>, 2>& special, const TrimRegion* region,
  const Execution& execution)
{
  if (region)
  {
    this->add_trimmed(patch, surface, offset, special, *region);
    return;
  }
  const PieceShape* shape = this->shape_of(surface);
  const SurfacePieces extracted(surface);
  bool cut = extracted.size() < this->FewPieces;
  if (!cut && surface.rational())
  {
    extracted.for_each(
      [&cut](const BezierPiece<2>& piece) { cut = cut || has_uneven_weights<2>(piece); });
  }
  if (!cut)
  {
    this->append<2>(patch, extracted, surface, shape, offset, special, execution);
    return;
  }
  const KeptPieces<2> pieces{ cut_pieces<2>(extract_bezier(surface), this->FewPieces) };
  this->append<2>(patch, pieces, surface, shape, offset, special, execution);
}

void DistanceForms::add_trimmed(std::int32_t patch, const Surface& surface, const Vector3& offset,
  const std::array<std::array<bool, 2>, 2>& special, const TrimRegion& region)
{
  const KeptPieces<2> pieces{ kept_pieces(surface, region, this->FewPieces) };
  const std::size_t begin = this->Pieces.size();
  this->append<2>(patch, pieces, surface, this->shape_of(surface), offset, special);
  for (std::size_t k = begin; k < this->Pieces.size(); ++k)
  {
    Piece& piece = this->Pieces[k];
    if (keeps_all(region, piece.lower, piece.upper))
    {
      continue;
    }
    piece.region = &region;
    const std::array<double, 2> kept = kept_point(region, piece.lower, piece.upper);
    for (int i = 0; i < 2; ++i)
    {
      piece.kept[i] = (kept[i] - piece.lower[i]) / piece.width[i];
    }
  }
}

void DistanceForms::add(std::int32_t patch, const EdgeCurve& edge, const EdgePieces& pieces,
  const Vector3& offset)
{
  // Pieces of one degree and kind lie one after the other.
  for (auto first = pieces.pieces.begin(); first != pieces.pieces.end();)
  {
    const bool rational = is_rational(*first);
    const auto last = std::find_if(first, pieces.pieces.end(),
      [&](const BezierPiece<1>& piece)
      { return piece.degree != first->degree || is_rational(piece) != rational; });
    const KeptPieces<1> alike{ { first, last } };
    const std::size_t begin = this->Pieces.size();
    this->append<1>(patch, alike, edge, this->shape(0, first->degree[0], rational), offset,
      { { { { false, false } }, { { false, false } } } });
    const Vector3 around = Vector3::Constant(pieces.error);
    for (std::size_t k = begin; k < this->Pieces.size(); ++k)
    {
      this->Pieces[k].edge = true;
      this->Pieces[k].error = pieces.error;
      this->GreatestError = std::max(this->GreatestError, pieces.error);
      this->Boxes[k][0] -= around;
      this->Boxes[k][1] += around;
    }
    first = last;
  }
}

} // namespace footpoint
