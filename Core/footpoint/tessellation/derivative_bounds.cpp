// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/tessellation/derivative_bounds.h"

#include "footpoint/splines/bezier.h"
#include "footpoint/splines/validation.h"

#include <algorithm>
#include <cmath>

namespace footpoint
{
namespace
{

using Homogeneous = Eigen::Matrix<double, 4, Eigen::Dynamic>;

/// Boxes that touch more pieces take the bounds of whole pieces.
constexpr std::size_t kFewPieces = 4;

/// Largest magnitudes of a difference of the net: of positions, heights and weights.
struct Magnitudes
{
  double position = 0.0;
  double height = 0.0;
  double weight = 0.0;

  void add(const Eigen::Vector4d& difference, const Vector3& up)
  {
    this->position = std::max(this->position, difference.head<3>().squaredNorm());
    this->height = std::max(this->height, std::abs(difference.head<3>().dot(up)));
    this->weight = std::max(this->weight, std::abs(difference[3]));
  }
  /// Of derivatives. \param factor from differences to derivatives
  Magnitudes scaled(double factor) const
  {
    return { std::sqrt(this->position) * factor, this->height * factor, this->weight * factor };
  }
};

/// (w·S)' = w'·S + w·S', and so on, solved for the derivatives of S. Arguments are bounds of the
/// differences of (w·S, w), of S and of the least weight.
struct ProductRule
{
  double least;
  double radius;

  double first(double product, double weight) const
  {
    return (product + weight * this->radius) / this->least;
  }
  /// \param a, b and wa, wb first derivatives of S and w by two directions
  double second(double product, double weight, double a, double b, double wa, double wb) const
  {
    return (product + wa * b + wb * a + weight * this->radius) / this->least;
  }
};

/// Turns the net of a rational piece S into that of S − L, one degree higher in directions with
/// extent, L being affine in the parameters and nearly S. Second derivatives stay; but values and
/// first derivatives, which bounds of rational pieces add to them, become small with the box.
/// \return the first derivatives of L by each direction of the unit square
std::array<Vector3, 2> subtract_affine(Homogeneous& net, std::array<int, 2>& degree)
{
  const auto at = [&](int i, int j) -> Vector3
  {
    const auto column = net.col(j * degree[1] * (degree[0] + 1) + i * degree[0]);
    return column.head<3>() / column[3];
  };
  const std::array<Vector3, 2> slope{ { 0.5 * (at(1, 0) - at(0, 0) + at(1, 1) - at(0, 1)),
    0.5 * (at(0, 1) - at(0, 0) + at(1, 1) - at(1, 0)) } };
  for (int d = 0; d < 2; ++d)
  {
    if (degree[d] == 0)
    {
      continue;
    }
    // One degree more, less w·(x − 1/2)·slope: x·w has the control points i/(p + 1)·w of i − 1.
    const int p = degree[d];
    const int step = d == 0 ? 1 : degree[0] + 1;
    const int lines = d == 0 ? degree[1] + 1 : degree[0] + 1;
    const int stride = d == 0 ? degree[0] + 1 : 1;
    Homogeneous higher(4, (p + 2) * lines);
    for (int line = 0; line < lines; ++line)
    {
      for (int i = 0; i <= p + 1; ++i)
      {
        const double part = static_cast<double>(i) / (p + 1);
        const int from = line * stride;
        const Eigen::Vector4d low = i > 0 ? Eigen::Vector4d(part * net.col(from + (i - 1) * step))
                                          : Eigen::Vector4d(Eigen::Vector4d::Zero());
        const Eigen::Vector4d high = i <= p
          ? Eigen::Vector4d((1.0 - part) * net.col(from + i * step))
          : Eigen::Vector4d(Eigen::Vector4d::Zero());
        Eigen::Vector4d sum = low + high;
        sum.head<3>() -= (low[3] - 0.5 * sum[3]) * slope[d];
        higher.col(d == 0 ? line * (p + 2) + i : i * lines + line) = sum;
      }
    }
    net = std::move(higher);
    degree[d] = p + 1;
  }
  return slope;
}

/// \param net    (w·x, w·y, w·z, w), u fastest; is moved to its own middle
/// \param degree, extent per direction; a direction without extent has degree 0
DerivativeBounds bounds_of_net(
  Homogeneous& net, const std::array<int, 2>& degree, const Parameter<2>& extent, const Vector3& up)
{
  const int nu = degree[0] + 1;
  const int nv = degree[1] + 1;
  const auto middle = net.col((nv / 2) * nu + nu / 2);
  const Vector3 origin = middle.head<3>() / middle[3];
  double radius = 0.0;
  double height = 0.0;
  double least = net(3, 0);
  for (Eigen::Index k = 0; k < net.cols(); ++k)
  {
    const double w = net(3, k);
    net.col(k).head<3>() -= w * origin;
    radius = std::max(radius, net.col(k).head<3>().squaredNorm() / (w * w));
    height = std::max(height, std::abs(net.col(k).head<3>().dot(up)) / w);
    least = std::min(least, w);
  }

  Magnitudes u, v, uu, uv, vv;
  for (int j = 0; j < nv; ++j)
  {
    for (int i = 0; i < nu; ++i)
    {
      const int at = j * nu + i;
      if (i + 1 < nu)
      {
        u.add(net.col(at + 1) - net.col(at), up);
      }
      if (j + 1 < nv)
      {
        v.add(net.col(at + nu) - net.col(at), up);
      }
      if (i + 1 < nu && j + 1 < nv)
      {
        uv.add(net.col(at + nu + 1) - net.col(at + nu) - net.col(at + 1) + net.col(at), up);
      }
      if (i + 2 < nu)
      {
        uu.add(net.col(at + 2) - 2.0 * net.col(at + 1) + net.col(at), up);
      }
      if (j + 2 < nv)
      {
        vv.add(net.col(at + 2 * nu) - 2.0 * net.col(at + nu) + net.col(at), up);
      }
    }
  }
  const double p = extent[0] > 0.0 ? degree[0] / extent[0] : 0.0;
  const double q = extent[1] > 0.0 ? degree[1] / extent[1] : 0.0;
  u = u.scaled(p);
  v = v.scaled(q);
  uv = uv.scaled(p * q);
  uu = uu.scaled(extent[0] > 0.0 ? p * (degree[0] - 1) / extent[0] : 0.0);
  vv = vv.scaled(extent[1] > 0.0 ? q * (degree[1] - 1) / extent[1] : 0.0);

  DerivativeBounds bounds;
  const ProductRule whole{ least, std::sqrt(radius) };
  bounds.u = whole.first(u.position, u.weight);
  bounds.v = whole.first(v.position, v.weight);
  bounds.second = {
    whole.second(uu.position, uu.weight, bounds.u, bounds.u, u.weight, u.weight),
    whole.second(uv.position, uv.weight, bounds.u, bounds.v, u.weight, v.weight),
    whole.second(vv.position, vv.weight, bounds.v, bounds.v, v.weight, v.weight),
  };
  const ProductRule along{ least, height };
  const double hu = along.first(u.height, u.weight);
  const double hv = along.first(v.height, v.weight);
  bounds.height = {
    along.second(uu.height, uu.weight, hu, hu, u.weight, u.weight),
    along.second(uv.height, uv.weight, hu, hv, u.weight, v.weight),
    along.second(vv.height, vv.weight, hv, hv, v.weight, v.weight),
  };
  return bounds;
}

DerivativeBounds bounds_of(Homogeneous& net, std::array<int, 2> degree, const Parameter<2>& extent,
  const Vector3& up, bool rational)
{
  if (!rational)
  {
    return bounds_of_net(net, degree, extent, up);
  }
  const std::array<Vector3, 2> slope = subtract_affine(net, degree);
  DerivativeBounds bounds = bounds_of_net(net, degree, extent, up);
  bounds.u += extent[0] > 0.0 ? slope[0].norm() / extent[0] : 0.0;
  bounds.v += extent[1] > 0.0 ? slope[1].norm() / extent[1] : 0.0;
  return bounds;
}

} // namespace

SecondBounds SecondBounds::joined_with(const SecondBounds& other) const
{
  return { std::max(this->uu, other.uu), std::max(this->uv, other.uv),
    std::max(this->vv, other.vv) };
}

DerivativeBounds DerivativeBounds::joined_with(const DerivativeBounds& other) const
{
  return { std::max(this->u, other.u), std::max(this->v, other.v),
    this->second.joined_with(other.second), this->height.joined_with(other.height) };
}

double SecondBounds::chord(const std::array<Parameter<2>, 3>& corners) const
{
  const Parameter<2> extent = corners[0].cwiseMax(corners[1]).cwiseMax(corners[2]) -
    corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]);
  if (!(extent[0] > 0.0) || !(extent[1] > 0.0))
  {
    return this->chord(extent);
  }
  const double ratio = extent[1] / extent[0];
  const Parameter<2> metric(this->uu + this->uv * ratio, this->vv + this->uv / ratio);
  std::array<Parameter<2>, 3> edges;
  std::array<double, 3> squared;
  for (int i = 0; i < 3; ++i)
  {
    edges[i] = (corners[(i + 2) % 3] - corners[(i + 1) % 3]).cwiseProduct(metric.cwiseSqrt());
    squared[i] = edges[i].squaredNorm();
  }
  std::sort(squared.begin(), squared.end());
  const double area = std::abs(edges[0][0] * edges[1][1] - edges[0][1] * edges[1][0]);
  // An obtuse triangle lies in the circle over its longest side, others in the one around them.
  if (squared[2] >= squared[0] + squared[1] || !(area > 0.0))
  {
    return squared[2] / 8.0;
  }
  return 0.5 * (squared[0] / area) * (squared[1] / area) * squared[2] / 4.0;
}

SurfaceBounds::SurfaceBounds(const ParametricSurface& surface)
  : Base(dynamic_cast<const Surface*>(&surface))
{
  if (!this->Base)
  {
    throw GeometryError(
      GeometryDefect::Format, "it is no NURBS surface, and only those have bounds");
  }
  for (int i = 0; i < 2; ++i)
  {
    this->Knots[i] = this->Base->direction(i).spans;
  }
  this->Net = homogeneous(this->Base->local_control_points(), this->Base->weights());
  this->Pieces.resize((this->Knots[0].size() - 1) * (this->Knots[1].size() - 1));
}

void SurfaceBounds::prepare_row(std::size_t row)
{
  const std::size_t count = this->Knots[0].size() - 1;
  for (std::size_t i = 0; i < count; ++i)
  {
    const ParameterBox box{ { this->Knots[0][i], this->Knots[1][row] },
      { this->Knots[0][i + 1], this->Knots[1][row + 1] } };
    DerivativeBounds& piece = this->Pieces[row * count + i];
    piece = this->of_span(i, row, box, Vector3::Zero());
    piece.height = piece.second;
  }
}

bool SurfaceBounds::finite() const
{
  return std::all_of(this->Pieces.begin(), this->Pieces.end(),
    [](const DerivativeBounds& piece)
    {
      const SecondBounds& second = piece.second;
      return std::isfinite(piece.u + piece.v + second.uu + second.uv + second.vv);
    });
}

std::array<std::array<std::size_t, 2>, 2> SurfaceBounds::spans(const ParameterBox& box) const
{
  std::array<std::array<std::size_t, 2>, 2> result;
  for (int i = 0; i < 2; ++i)
  {
    const std::vector<double>& knots = this->Knots[i];
    const auto last_span = static_cast<std::ptrdiff_t>(knots.size()) - 2;
    const auto low = std::upper_bound(knots.begin(), knots.end(), box.lower[i]);
    const auto high = std::lower_bound(knots.begin(), knots.end(), box.upper[i]);
    result[i][0] =
      static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(low - knots.begin() - 1, 0, last_span));
    result[i][1] = std::max(result[i][0],
      static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(high - knots.begin() - 1, 0, last_span)));
  }
  return result;
}

DerivativeBounds SurfaceBounds::of_pieces(const ParameterBox& box) const
{
  const auto touched = this->spans(box);
  DerivativeBounds bounds;
  for (std::size_t j = touched[1][0]; j <= touched[1][1]; ++j)
  {
    for (std::size_t i = touched[0][0]; i <= touched[0][1]; ++i)
    {
      bounds = bounds.joined_with(this->Pieces[j * (this->Knots[0].size() - 1) + i]);
    }
  }
  return bounds;
}

DerivativeBounds SurfaceBounds::over(const ParameterBox& box, const Vector3& up) const
{
  const auto touched = this->spans(box);
  const std::size_t count =
    (touched[0][1] - touched[0][0] + 1) * (touched[1][1] - touched[1][0] + 1);
  if (count > kFewPieces)
  {
    return this->of_pieces(box);
  }
  DerivativeBounds bounds;
  for (std::size_t j = touched[1][0]; j <= touched[1][1]; ++j)
  {
    for (std::size_t i = touched[0][0]; i <= touched[0][1]; ++i)
    {
      bounds = bounds.joined_with(this->of_span(i, j, box, up));
    }
  }
  return bounds;
}

DerivativeBounds SurfaceBounds::of_span(
  std::size_t i, std::size_t j, const ParameterBox& box, const Vector3& up) const
{
  const std::array<std::size_t, 2> span{ { i, j } };
  std::array<BezierSpan, 2> parts;
  std::array<int, 2> degree;
  Parameter<2> extent;
  for (int k = 0; k < 2; ++k)
  {
    const KnotVector& knots = this->Base->knots(k);
    const double low = this->Knots[k][span[k]];
    const double high = this->Knots[k][span[k] + 1];
    const double a = std::clamp(box.lower[k], low, high);
    const double b = std::clamp(box.upper[k], low, high);
    parts[k] = bezier_span(knots, knots.find_span(low, Side::Right), a, b);
    extent[k] = b - a;
    degree[k] = extent[k] > 0.0 ? knots.degree() : 0;
  }
  const Eigen::Index nu = this->Base->knots(0).number_of_control_points();
  Homogeneous row(4, this->Base->knots(0).degree() + 1);
  Homogeneous net(4, (degree[0] + 1) * (degree[1] + 1));
  for (int b = 0; b <= degree[1]; ++b)
  {
    row.setZero();
    for (Eigen::Index k = 0; k < parts[1].matrix.rows(); ++k)
    {
      row += parts[1].matrix(k, b) *
        this->Net.middleCols((parts[1].first + k) * nu + parts[0].first, row.cols());
    }
    net.middleCols(b * (degree[0] + 1), degree[0] + 1) =
      row.lazyProduct(parts[0].matrix.leftCols(degree[0] + 1));
  }
  return bounds_of(net, degree, extent, up, this->Base->rational());
}

double second_derivative_bound(const Curve& curve, double lower, double upper)
{
  const KnotVector& knots = curve.knots();
  const int span = knots.find_span(lower, Side::Right);
  const BezierSpan part = bezier_span(knots, span, lower, upper);
  Homogeneous net = homogeneous(curve.local_control_points(), curve.weights())
                      .middleCols(part.first, part.matrix.rows()) *
    part.matrix;
  return bounds_of(
    net, { { knots.degree(), 0 } }, { upper - lower, 0.0 }, Vector3::Zero(), curve.rational())
    .second.uu;
}

} // namespace footpoint
