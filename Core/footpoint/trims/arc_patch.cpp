// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/trims/arc_patch.h"

#include "footpoint/splines/bezier.h"
#include "footpoint/splines/binomials.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace footpoint
{
namespace
{

using Homogeneous = ArcPatch::Homogeneous;
using Box = std::array<std::array<double, 2>, 2>;

/// An extent below this part of the domain is rounding: the arc is taken as constant there.
constexpr double kConstant = 4.0 * 0x1p-52;

/// The ranges of u and v over the arc's control points, within the cell.
Box box_of(const TrimArc& arc, const ArcCell& cell)
{
  Box box;
  for (int i = 0; i < 2; ++i)
  {
    const auto coordinates = arc.control.row(i).array() / arc.control.row(2).array();
    box[i] = { { coordinates.minCoeff(), coordinates.maxCoeff() } };
    for (Eigen::Index j = 0; j < arc.control.cols(); ++j)
    {
      // Quotients are rounded; not to have the arc outside, the box grows by a rounding.
      const double w = arc.control(2, j);
      const double wu = arc.control(i, j);
      const double infinity = std::numeric_limits<double>::infinity();
      box[i][0] =
        std::fma(-w, box[i][0], wu) < 0.0 ? std::nextafter(box[i][0], -infinity) : box[i][0];
      box[i][1] =
        std::fma(w, box[i][1], -wu) < 0.0 ? std::nextafter(box[i][1], infinity) : box[i][1];
    }
    box[i][0] = std::clamp(box[i][0], cell.lower[i], cell.upper[i]);
    box[i][1] = std::clamp(box[i][1], cell.lower[i], cell.upper[i]);
  }
  return box;
}

/// Rows b and a: u = u0 b / (a + b) + u1 a / (a + b), each to a rounding of its own.
/// \return by how much the arc was moved into the box, as a part of it
double set_arc(
  const TrimArc& from, int direction, const std::array<double, 2>& box, Homogeneous& arc)
{
  const double length = box[1] - box[0];
  double moved = 0.0;
  for (Eigen::Index j = 0; j < arc.cols(); ++j)
  {
    const double w = from.control(2, j);
    const double wu = from.control(direction, j);
    const double before = length > 0.0 ? std::fma(w, box[1], -wu) / length : w;
    const double after = length > 0.0 ? std::fma(-w, box[0], wu) / length : 0.0;
    // At a border of the cell the box cannot grow.
    moved = std::max({ moved, -before / w, -after / w });
    arc(2 * direction, j) = std::max(before, 0.0);
    arc(2 * direction + 1, j) = std::max(after, 0.0);
  }
  return moved;
}

Homogeneous net_of_span(const Surface& surface, const std::array<BezierSpan, 2>& spans)
{
  const Eigen::Index along_u = spans[0].matrix.rows();
  const Eigen::Index along_v = spans[1].matrix.rows();
  const Eigen::Index nu = surface.knots(0).number_of_control_points();
  Homogeneous net(4, along_u * along_v);
  for (Eigen::Index j = 0; j < along_v; ++j)
  {
    for (Eigen::Index i = 0; i < along_u; ++i)
    {
      const Eigen::Index at = (spans[1].first + j) * nu + spans[0].first + i;
      const double w = surface.rational() ? surface.weights()[at] : 1.0;
      net.col(j * along_u + i) << w * surface.local_control_points().col(at), w;
    }
  }
  return net;
}

/// Applies an operator to each line of a net along a direction.
Homogeneous apply(const Homogeneous& net, int direction, Eigen::Index along_u,
  const Eigen::Ref<const Eigen::MatrixXd>& matrix)
{
  const Eigen::Index along_v = net.cols() / along_u;
  const Eigen::Index lines = direction == 0 ? along_v : along_u;
  const Eigen::Index step = direction == 0 ? 1 : along_u;
  const Eigen::Index new_step = direction == 0 ? 1 : along_u;
  Homogeneous result(4, lines * matrix.cols());
  for (Eigen::Index line = 0; line < lines; ++line)
  {
    const Eigen::Index from = direction == 0 ? line * along_u : line;
    const Eigen::Index to = direction == 0 ? line * matrix.cols() : line;
    for (Eigen::Index j = 0; j < matrix.cols(); ++j)
    {
      Eigen::Vector4d point = matrix(0, j) * net.col(from);
      for (Eigen::Index k = 1; k < matrix.rows(); ++k)
      {
        point += matrix(k, j) * net.col(from + k * step);
      }
      result.col(to + j * new_step) = point;
    }
  }
  return result;
}

/// Bound of the derivative by a direction over the box's unit square: with X = A / w,
/// X' = (A' − w' X) / w, and A', w' are within the differences of their control points.
double speed_bound(const ArcPatch& patch, int direction)
{
  const Eigen::Index along_u = patch.degree[0] + 1;
  const Eigen::Index step = direction == 0 ? 1 : along_u;
  double points = 0.0;
  double weights = 0.0;
  for (Eigen::Index k = 0; k < patch.control.cols(); ++k)
  {
    const Eigen::Index place = direction == 0 ? k % along_u : k / along_u;
    if (place < patch.degree[direction])
    {
      const Eigen::Vector4d difference = patch.control.col(k + step) - patch.control.col(k);
      points = std::max(points, difference.head<3>().norm());
      weights = std::max(weights, std::abs(difference[3]));
    }
  }
  return patch.degree[direction] * (points + weights * patch.magnitude) /
    patch.control.row(3).minCoeff();
}

/// The largest distance of the control points from the affine map through three corners; the
/// polynomial itself is not farther from it.
double distance_from_affine(const ArcPatch& patch)
{
  const Eigen::Index along_u = patch.degree[0] + 1;
  const Eigen::Vector4d corner = patch.control.col(0);
  const Eigen::Vector4d u = patch.control.col(patch.degree[0]) - corner;
  const Eigen::Vector4d v = patch.control.col(patch.degree[1] * along_u) - corner;
  double worst = 0.0;
  for (Eigen::Index k = 0; k < patch.control.cols(); ++k)
  {
    const double s = static_cast<double>(k % along_u) / std::max(patch.degree[0], 1);
    const double t = static_cast<double>(k / along_u) / std::max(patch.degree[1], 1);
    worst = std::max(worst, (patch.control.col(k) - corner - s * u - t * v).norm());
  }
  return worst;
}

/// How far a polynomial arc's a, b are from the linear ones between the same ends.
double distance_from_line(const Homogeneous& arc, int direction)
{
  const Eigen::Index degree = arc.cols() - 1;
  const auto a = arc.row(2 * direction + 1);
  double worst = 0.0;
  for (Eigen::Index j = 0; j <= degree; ++j)
  {
    const double part = static_cast<double>(j) / static_cast<double>(degree);
    worst = std::max(worst, std::abs(a[j] - (1.0 - part) * a[0] - part * a[degree]));
  }
  return worst;
}

/// Values of the Bernstein polynomials a^i b^(n−i) binomial(n, i).
void bernstein(int n, double a, double b, double* values)
{
  double power = 1.0;
  for (int i = 0; i <= n; ++i, power *= a)
  {
    values[i] = kBinomials.value[n][i] * power;
  }
  power = 1.0;
  for (int i = n; i >= 0; --i, power *= b)
  {
    values[i] *= power;
  }
}

/// Product of a scalar and a vector polynomial in Bernstein form.
Homogeneous multiply(const Eigen::RowVectorXd& a, const Homogeneous& b)
{
  const int p = static_cast<int>(a.size()) - 1;
  const int q = static_cast<int>(b.cols()) - 1;
  Homogeneous product = Homogeneous::Zero(4, p + q + 1);
  for (int i = 0; i <= p; ++i)
  {
    for (int j = 0; j <= q; ++j)
    {
      const double factor =
        kBinomials.value[p][i] * kBinomials.value[q][j] / kBinomials.value[p + q][i + j];
      product.col(i + j) += factor * a[i] * b.col(j);
    }
  }
  return product;
}

/// de Casteljau's algorithm on polynomials: all of `points` are of one degree.
Homogeneous casteljau(std::vector<Homogeneous> points, const Homogeneous& arc, int direction)
{
  const Eigen::RowVectorXd b = arc.row(2 * direction);
  const Eigen::RowVectorXd a = arc.row(2 * direction + 1);
  for (std::size_t left = points.size() - 1; left > 0; --left)
  {
    for (std::size_t i = 0; i < left; ++i)
    {
      points[i] = multiply(b, points[i]) + multiply(a, points[i + 1]);
    }
  }
  return points.front();
}

} // namespace

ArcPatch::ArcPatch(const Surface& surface, const TrimArc& from, const ArcCell& cell, double allowed)
{
  // === The surface over the box
  const Box box = box_of(from, cell);
  std::array<BezierSpan, 2> spans;
  for (int i = 0; i < 2; ++i)
  {
    spans[i] = bezier_span(surface.knots(i), cell.span[i], box[i][0], box[i][1]);
    this->degree[i] = surface.knots(i).degree();
  }
  this->control = net_of_span(surface, spans);
  for (int i = 0; i < 2; ++i)
  {
    this->control = apply(this->control, i, this->degree[0] + 1, spans[i].matrix);
  }
  this->magnitude =
    (this->control.topRows<3>().colwise().norm().array() / this->control.row(3).array()).maxCoeff();
  this->change = 0.0;

  // === The arc within it
  const bool rational_arc = (from.control.row(2).array() != from.control(2, 0)).any();
  this->arc.resize(4, from.control.cols());
  for (int i = 0; i < 2; ++i)
  {
    const double moved = set_arc(from, i, box[i], this->arc);
    this->change += moved > 0.0 ? 2.0 * moved * speed_bound(*this, i) : 0.0;
    const double extent = box[i][1] - box[i][0];
    if (extent <= kConstant * surface.direction(i).length)
    {
      this->change += extent > 0.0 ? speed_bound(*this, i) : 0.0;
      const Eigen::Index along_u = this->degree[0] + 1;
      this->control =
        apply(this->control, i, along_u, Eigen::VectorXd::Unit(this->degree[i] + 1, 0));
      this->degree[i] = 0;
      this->arc.row(2 * i) = from.control.row(2);
      this->arc.row(2 * i + 1).setZero();
    }
  }
  if (!rational_arc)
  {
    this->arc /= from.control(2, 0);
  }

  // === Simplifications
  const std::array<double, 2> off{ distance_from_line(this->arc, 0),
    distance_from_line(this->arc, 1) };
  const double bent = off[0] * speed_bound(*this, 0) + off[1] * speed_bound(*this, 1);
  if (!rational_arc && this->arc.cols() > 2 && bent <= allowed)
  {
    this->change += bent;
    Homogeneous line(4, 2);
    line << this->arc.col(0), this->arc.col(this->arc.cols() - 1);
    this->arc = line;
  }
  const double twisted = distance_from_affine(*this);
  this->affine = !surface.rational() && twisted <= allowed;
  this->change += this->affine ? twisted : 0.0;
  this->rational = surface.rational() || rational_arc;
}

int ArcPatch::composed_degree() const
{
  return this->affine ? this->arc_degree()
                      : (this->degree[0] + this->degree[1]) * this->arc_degree();
}

Eigen::Vector4d ArcPatch::at(const Homogeneous& along, double t) const
{
  double basis[kMaximumDegree + 1];
  const int arc_degree = static_cast<int>(along.cols()) - 1;
  bernstein(arc_degree, t, 1.0 - t, basis);
  Eigen::Vector4d place = Eigen::Vector4d::Zero();
  for (int j = 0; j <= arc_degree; ++j)
  {
    place += basis[j] * along.col(j);
  }
  double second[kMaximumDegree + 1];
  bernstein(this->degree[0], place[1], place[0], basis);
  bernstein(this->degree[1], place[3], place[2], second);
  Eigen::Vector4d sum = Eigen::Vector4d::Zero();
  for (int j = 0, k = 0; j <= this->degree[1]; ++j)
  {
    Eigen::Vector4d row = Eigen::Vector4d::Zero();
    for (int i = 0; i <= this->degree[0]; ++i, ++k)
    {
      row += basis[i] * this->control.col(k);
    }
    sum += second[j] * row;
  }
  return sum;
}

Homogeneous ArcPatch::compose() const
{
  Homogeneous result;
  if (this->affine)
  {
    const Eigen::Index last = this->degree[1] * (this->degree[0] + 1);
    const Eigen::Vector4d corner = this->control.col(0);
    const Eigen::Vector4d u = this->control.col(this->degree[0]) - corner;
    const Eigen::Vector4d v = this->control.col(last) - corner;
    result =
      corner * (this->arc.row(0) + this->arc.row(1)) + u * this->arc.row(1) + v * this->arc.row(3);
  }
  else
  {
    std::vector<Homogeneous> rows;
    for (int j = 0; j <= this->degree[1]; ++j)
    {
      std::vector<Homogeneous> points;
      for (int i = 0; i <= this->degree[0]; ++i)
      {
        points.emplace_back(this->control.col(j * (this->degree[0] + 1) + i));
      }
      rows.push_back(casteljau(std::move(points), this->arc, 0));
    }
    result = casteljau(std::move(rows), this->arc, 1);
  }
  if (!this->rational)
  {
    result.row(3).setOnes(); // but for rounding they are
  }
  return result;
}

std::array<Homogeneous, 2> halve_arc(const Homogeneous& arc)
{
  std::array<Homogeneous, 2> halves{ { arc, arc } };
  const Eigen::Index degree = arc.cols() - 1;
  for (Eigen::Index level = 1; level <= degree; ++level)
  {
    for (Eigen::Index j = 0; j <= degree - level; ++j)
    {
      halves[1].col(j) = 0.5 * (halves[1].col(j) + halves[1].col(j + 1));
    }
    halves[0].col(level) = halves[1].col(0);
  }
  return halves;
}

} // namespace footpoint
