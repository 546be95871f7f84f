// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/search/distance_forms.h"

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

/// Binomial coefficients of one degree.
std::vector<double> binomials(int n)
{
  std::vector<double> row{ 1.0 };
  for (int k = 1; k <= n; ++k)
  {
    row.push_back(row.back() * (n - k + 1) / k);
  }
  return row;
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
  for (int k = 0; k <= n; ++k)
  {
    for (int j = n + 1; j < stride; ++j)
    {
      weights[k * stride + j] = weights[k * stride + n];
    }
  }
  return weights;
}

/// A piece is cut until its weights differ by no more than this ratio, and its control net is no
/// farther from straight than this part of its extent; the latter only while there are few pieces,
/// since cells that are small beside the distances in question need no better shape.
constexpr double kWeightRatio = 3.0;
constexpr double kStraightness = 0.1;
constexpr int kWeightCuts = 50;
constexpr std::size_t kWeightPieces = 4; ///< that many times few_pieces more, at most

/// How far a net is from straight along one direction: its largest second difference over its
/// largest extent; and the ratio of neighbouring weights.
template <int N>
double bend(const BezierPiece<N>& piece, int direction)
{
  const Eigen::Index stride = direction == 0 ? 1 : piece.degree[0] + 1;
  const int degree = piece.degree[direction];
  double second = 0.0;
  for (Eigen::Index k = 0; k < piece.control.cols(); ++k)
  {
    if ((k / stride) % (degree + 1) + 2 <= degree)
    {
      const Vector3 a = piece.control.col(k).hnormalized();
      const Vector3 b = piece.control.col(k + stride).hnormalized();
      const Vector3 c = piece.control.col(k + 2 * stride).hnormalized();
      second = std::max(second, (a - 2.0 * b + c).norm() * degree * (degree - 1));
    }
  }
  const std::array<Vector3, 2> corners = bounding_box<N>(piece);
  const double extent = (corners[1] - corners[0]).norm();
  return extent > 0.0 ? second / (8.0 * extent) : 0.0;
}

/// Largest ratio of weights along lines of one direction.
template <int N>
double weight_ratio(const BezierPiece<N>& piece, int direction)
{
  const Eigen::Index stride = direction == 0 ? 1 : piece.degree[0] + 1;
  const int degree = piece.degree[direction];
  double ratio = 1.0;
  for (Eigen::Index k = 0; k < piece.control.cols(); ++k)
  {
    if ((k / stride) % (degree + 1) != 0)
    {
      continue;
    }
    double least = piece.control(3, k);
    double greatest = least;
    for (int i = 1; i <= degree; ++i)
    {
      least = std::min(least, piece.control(3, k + i * stride));
      greatest = std::max(greatest, piece.control(3, k + i * stride));
    }
    ratio = std::max(ratio, greatest / least);
  }
  return ratio;
}

template <int N, typename Measure>
std::vector<BezierPiece<N>> cut_while(
  std::vector<BezierPiece<N>> pieces, double allowed, std::size_t limit, int rounds, Measure measure)
{
  for (int round = 0; round < rounds; ++round)
  {
    std::vector<BezierPiece<N>> next;
    bool cut = false;
    std::size_t count = pieces.size();
    for (BezierPiece<N>& piece : pieces)
    {
      int worst = 0;
      double value = measure(piece, 0);
      if (N == 2 && measure(piece, N - 1) > value)
      {
        worst = N - 1;
        value = measure(piece, worst);
      }
      if (value <= allowed || count >= limit)
      {
        next.push_back(std::move(piece));
        continue;
      }
      cut = true;
      ++count;
      for (BezierPiece<N>& half : halve<N>(piece, worst))
      {
        next.push_back(std::move(half));
      }
    }
    pieces = std::move(next);
    if (!cut)
    {
      break;
    }
  }
  return pieces;
}

template <int N>
std::vector<BezierPiece<N>> refine(std::vector<BezierPiece<N>> pieces, std::size_t few_pieces)
{
  const std::size_t limit = pieces.size() + kWeightPieces * few_pieces;
  pieces = cut_while<N>(std::move(pieces), kWeightRatio, limit, kWeightCuts,
    [](const BezierPiece<N>& piece, int i) { return weight_ratio<N>(piece, i); });
  return cut_while<N>(std::move(pieces), kStraightness, few_pieces, 8,
    [](const BezierPiece<N>& piece, int i) { return bend<N>(piece, i); });
}

/// Where positions of a piece are measured from: a point at which a derivative vanishes (a collapsed
/// side; a curve's repeated end), so that it comes out with all digits near there, else the middle.
template <int N>
Vector3 origin_of(const BezierPiece<N>& piece, double size)
{
  auto point = [&](Eigen::Index k) { return Vector3(piece.control.col(k).hnormalized()); };
  const std::array<Vector3, 2> corners = bounding_box<N>(piece);
  const Eigen::Index along_u = piece.degree[0] + 1;
  const Eigen::Index along_v = piece.control.cols() / along_u;
  auto collapsed = [&](Eigen::Index first, Eigen::Index step, Eigen::Index count)
  {
    bool result = true;
    for (Eigen::Index k = 1; k < count; ++k)
    {
      result = result && (point(first + k * step) - point(first)).norm() <= kClosureTolerance * size;
    }
    return result;
  };
  const Eigen::Index last = piece.control.cols() - 1;
  if (N == 1)
  {
    const bool start = along_u > 2 && collapsed(0, 1, 2);
    const bool end = along_u > 2 && collapsed(last - 1, 1, 2);
    return start ? point(0) : (end ? point(last) : Vector3(0.5 * (corners[0] + corners[1])));
  }
  if (collapsed(0, 1, along_u) || collapsed(0, along_u, along_v))
  {
    return point(0);
  }
  if (collapsed(last - along_u + 1, 1, along_u) || collapsed(along_u - 1, along_u, along_v))
  {
    return point(last);
  }
  return 0.5 * (corners[0] + corners[1]);
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
  const bool is_break = std::any_of(direction.breaks.begin(), direction.breaks.end(),
    [at](const Break& line) { return line.at == at; });
  return is_break ? PieceSide::Special : PieceSide::Smooth;
}

/// The forms of a net whose rows run along the first direction.
void fill_forms(const PieceShape& shape, const double* net, double* forms)
{
  const int p = shape.degree[0];
  const int q = shape.degree[1];
  std::fill(forms, forms + shape.number_of_forms * shape.form_size, 0.0);
  const std::vector<double> cp = binomials(p);
  const std::vector<double> cq = binomials(q);
  std::vector<double> scaled(4 * (p + 1) * (q + 1)); // x, y, z, w of all columns of a row
  for (int i = 0; i <= p; ++i)
  {
    for (int j = 0; j <= q; ++j)
    {
      for (int k = 0; k < 4; ++k)
      {
        scaled[(i * 4 + k) * (q + 1) + j] = cp[i] * cq[j] * net[(i * (q + 1) + j) * 4 + k];
      }
    }
  }
  for (int i = 0; i <= p; ++i)
  {
    for (int k = 0; k <= p; ++k)
    {
      double* row = forms + (i + k) * shape.stride;
      const double* a = &scaled[i * 4 * (q + 1)];
      const double* b = &scaled[k * 4 * (q + 1)];
      for (int j = 0; j <= q; ++j)
      {
        const double x = a[j];
        const double y = a[(q + 1) + j];
        const double z = a[2 * (q + 1) + j];
        const double w = a[3 * (q + 1) + j];
        for (int l = 0; l <= q; ++l)
        {
          const double bx = b[l];
          const double by = b[(q + 1) + l];
          const double bz = b[2 * (q + 1) + l];
          row[j + l] += x * bx + y * by + z * bz;
          row[shape.form_size + j + l] += w * bx;
          row[2 * shape.form_size + j + l] += w * by;
          row[3 * shape.form_size + j + l] += w * bz;
          if (shape.rational)
          {
            row[4 * shape.form_size + j + l] += w * b[3 * (q + 1) + l];
          }
        }
      }
    }
  }
  const std::vector<double> cp2 = binomials(2 * p);
  const std::vector<double> cq2 = binomials(2 * q);
  for (int f = 0; f < shape.number_of_forms; ++f)
  {
    for (int i = 0; i < shape.rows; ++i)
    {
      double* row = forms + f * shape.form_size + i * shape.stride;
      for (int j = 0; j < shape.columns; ++j)
      {
        row[j] /= cp2[i] * cq2[j];
      }
      std::fill(row + shape.columns, row + shape.stride, row[shape.columns - 1]);
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
  , number_of_forms(is_rational ? 5 : 4)
  , roundings(3.0 * (p + 1) * (q + 1) + 32.0)
{
  for (int end = 0; end < 2; ++end)
  {
    this->halving[0][end] = halving_weights(2 * p, end, 2 * p + 1);
    this->halving[1][end] = halving_weights(2 * q, end, this->stride);
  }
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

template <int N>
void DistanceForms::append(std::int32_t patch, std::vector<BezierPiece<N>> pieces,
  const ParametricGeometry<N>& geometry, bool rational, const Vector3& offset,
  const std::array<std::array<bool, 2>, 2>& special)
{
  if (pieces.empty())
  {
    return;
  }
  const int p = N == 2 ? pieces.front().degree[0] : 0;
  const int q = pieces.front().degree[N - 1];
  const PieceShape* shape = this->shape(p, q, rational);
  const std::size_t forms = static_cast<std::size_t>(shape->number_of_forms) * shape->form_size;
  const std::size_t count = shape->net_size + forms;
  this->Numbers.emplace_back(count * pieces.size() + 8); // vector loads may read beyond the end
  double* numbers = this->Numbers.back().data();
  std::fill(numbers + count * pieces.size(), numbers + this->Numbers.back().size(), 0.0);
  for (const BezierPiece<N>& source : pieces)
  {
    const std::array<Vector3, 2> corners = bounding_box<N>(source);
    const Vector3 local_origin = origin_of<N>(source, geometry.size());
    const Vector3 origin = offset + local_origin;
    // A common factor of the weights changes nothing: a power of two, so that the largest is near 1.
    const double scale = std::ldexp(1.0, -std::ilogb(source.control.row(3).maxCoeff()));
    Piece piece;
    piece.shape = shape;
    piece.patch = patch;
    double* net = numbers;
    double* form = numbers + shape->net_size;
    numbers += count;
    piece.net = net;
    piece.forms = form;
    std::fill(net, net + shape->net_size, 0.0);
    double reach = 0.0;
    for (int i = 0; i <= p; ++i)
    {
      for (int j = 0; j <= q; ++j)
      {
        const auto control = source.control.col(N == 2 ? j * (p + 1) + i : j);
        const double w = rational ? scale * control(3) : 1.0;
        const Vector3 at = control.template head<3>() / control(3) - local_origin;
        reach = std::max(reach, at.norm());
        double* target = net + (i * (q + 1) + j) * 4;
        target[0] = w * at(0);
        target[1] = w * at(1);
        target[2] = w * at(2);
        target[3] = w;
      }
    }
    fill_forms(*shape, net, form);
    piece.reach = reach;
    piece.least_weight = 1.0;
    piece.greatest_weight = 1.0;
    if (rational)
    {
      const double* first = form + 4 * shape->form_size;
      piece.least_weight = *std::min_element(first, first + shape->form_size);
      piece.greatest_weight = *std::max_element(first, first + shape->form_size);
    }
    for (int i = 0; i < 2; ++i)
    {
      piece.origin = { { origin(0), origin(1), origin(2) } };
      const int from = N == 2 ? i : 0;
      const bool used = N == 2 || i == 1;
      piece.lower[i] = used ? source.lower(from) : 0.0;
      piece.upper[i] = used ? source.upper(from) : 0.0;
      piece.width[i] = piece.upper[i] - piece.lower[i];
      for (int end = 0; end < 2; ++end)
      {
        piece.sides[i][end] = used
          ? side_of(geometry.direction(from), end == 0 ? piece.lower[i] : piece.upper[i],
              special[from])
          : PieceSide::Smooth;
      }
    }
    this->Pieces.push_back(piece);
    this->Boxes.push_back({ { corners[0] + offset, corners[1] + offset } });
  }
}

void DistanceForms::add(std::int32_t patch, const Curve& curve, const Vector3& offset,
  const std::array<std::array<bool, 2>, 2>& special)
{
  this->append<1>(patch, refine<1>(extract_bezier(curve), this->FewPieces), curve, curve.rational(), offset,
    special);
}

void DistanceForms::add(std::int32_t patch, const Surface& surface, const Vector3& offset,
  const std::array<std::array<bool, 2>, 2>& special)
{
  this->append<2>(patch, refine<2>(extract_bezier(surface), this->FewPieces), surface,
    surface.rational(), offset, special);
}

} // namespace footpoint
