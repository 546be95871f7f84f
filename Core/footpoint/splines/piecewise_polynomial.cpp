// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/splines/piecewise_polynomial.h"

#include "footpoint/splines/bezier.h"
#include "footpoint/splines/binomials.h"

#include <algorithm>
#include <cmath>

namespace footpoint
{
namespace
{

/// Knots of two curves closer than this part of the domain are meant to be one.
constexpr double kSameKnot = 1e-12;

/// A start so near to a breakpoint is meant to be there: as accurate as a foot on a curve is found.
constexpr double kSameStart = 1e-9;

/// Derivatives at a joint agree when what they differ by moves the function less than this part of
/// its values: some rounding errors of the differences.
constexpr double kSameDerivative = 1e-13;

/// Blossom of a Bernstein polynomial on [0, 1]: de Casteljau with another argument in each step.
Eigen::VectorXd blossom(Eigen::MatrixXd control, const std::vector<double>& arguments)
{
  for (Eigen::Index level = control.cols() - 1, k = 0; level > 0; --level, ++k)
  {
    const double t = arguments[k];
    for (Eigen::Index j = 0; j < level; ++j)
    {
      control.col(j) = (1.0 - t) * control.col(j) + t * control.col(j + 1);
    }
  }
  return control.col(0);
}

Eigen::MatrixXd elevate_once(const Eigen::MatrixXd& control)
{
  const Eigen::Index degree = control.cols() - 1;
  Eigen::MatrixXd result(control.rows(), degree + 2);
  result.col(0) = control.col(0);
  result.col(degree + 1) = control.col(degree);
  for (Eigen::Index j = 1; j <= degree; ++j)
  {
    const double part = static_cast<double>(j) / static_cast<double>(degree + 1);
    result.col(j) = part * control.col(j - 1) + (1.0 - part) * control.col(j);
  }
  return result;
}

/// How many derivatives are continuous from the end of one Bernstein polynomial to the start of
/// another.
int joint_smoothness(
  Eigen::MatrixXd before, double before_length, Eigen::MatrixXd after, double after_length)
{
  const int degree = static_cast<int>(before.cols()) - 1;
  const double scale = std::max(before.cwiseAbs().maxCoeff(), after.cwiseAbs().maxCoeff());
  const double unit = std::min(before_length, after_length);
  for (int order = 1; order <= degree; ++order)
  {
    const Eigen::Index count = before.cols() - 1;
    before = (unit / before_length * (before.rightCols(count) - before.leftCols(count))).eval();
    after = (unit / after_length * (after.rightCols(count) - after.leftCols(count))).eval();
    const double step = (before.col(count - 1) - after.col(0)).cwiseAbs().maxCoeff();
    if (step > kSameDerivative * std::pow(2.0, order) * scale)
    {
      return order - 1;
    }
  }
  return degree;
}

} // namespace

PiecewisePolynomial::PiecewisePolynomial(
  std::vector<double> breakpoints, std::vector<int> smoothness, std::vector<Eigen::MatrixXd> pieces)
  : Breakpoints(std::move(breakpoints))
  , Smoothness(std::move(smoothness))
  , Pieces(std::move(pieces))
{
}

PiecewisePolynomial PiecewisePolynomial::spline(
  const KnotVector& knots, const Eigen::MatrixXd& control)
{
  std::vector<double> breakpoints;
  std::vector<int> smoothness;
  for (const DistinctKnot& knot : knots.distinct_knots())
  {
    breakpoints.push_back(knot.at / knots.length());
    smoothness.push_back(knots.degree() - knot.multiplicity);
  }
  std::vector<Eigen::MatrixXd> pieces;
  for (const BezierSpan& span : bezier_spans(knots))
  {
    pieces.push_back(control.middleCols(span.first, knots.degree() + 1) * span.matrix);
  }
  return { std::move(breakpoints), std::move(smoothness), std::move(pieces) };
}

PiecewisePolynomial PiecewisePolynomial::homogeneous(const Curve& curve)
{
  const Points points = curve.local_control_points().colwise() + curve.centre();
  Eigen::MatrixXd control(4, points.cols());
  control.topRows<3>() = points;
  control.row(3).setOnes();
  if (curve.rational())
  {
    control *= curve.weights().asDiagonal();
  }
  return spline(curve.knots(), control);
}

PiecewisePolynomial PiecewisePolynomial::single(const Eigen::MatrixXd& control)
{
  return { { 0.0, 1.0 }, { -1, -1 }, { control } };
}

std::size_t PiecewisePolynomial::piece_at(double t) const
{
  const auto above = std::upper_bound(this->Breakpoints.begin(), this->Breakpoints.end(), t);
  const std::ptrdiff_t last = static_cast<std::ptrdiff_t>(this->Pieces.size()) - 1;
  return std::clamp<std::ptrdiff_t>(above - this->Breakpoints.begin() - 1, 0, last);
}

Eigen::VectorXd PiecewisePolynomial::value(double t) const
{
  const std::size_t k = this->piece_at(t);
  const double from = this->Breakpoints[k];
  const double local = (t - from) / (this->Breakpoints[k + 1] - from);
  return blossom(this->Pieces[k], std::vector<double>(this->degree(), local));
}

PiecewisePolynomial PiecewisePolynomial::reversed() const
{
  PiecewisePolynomial result = *this;
  const double sum = this->Breakpoints.front() + this->Breakpoints.back();
  std::reverse(result.Breakpoints.begin(), result.Breakpoints.end());
  for (double& at : result.Breakpoints)
  {
    at = sum - at;
  }
  std::reverse(result.Smoothness.begin(), result.Smoothness.end());
  std::reverse(result.Pieces.begin(), result.Pieces.end());
  for (Eigen::MatrixXd& piece : result.Pieces)
  {
    piece = piece.rowwise().reverse().eval();
  }
  return result;
}

PiecewisePolynomial PiecewisePolynomial::started_at(double start) const
{
  for (const double at : this->Breakpoints)
  {
    start = std::abs(at - start) <= kSameStart ? at : start;
  }
  const PiecewisePolynomial cut = this->refined({ start });
  const auto found = std::find(cut.Breakpoints.begin(), cut.Breakpoints.end(), start);
  const std::size_t first = static_cast<std::size_t>(found - cut.Breakpoints.begin());
  const std::size_t count = cut.Pieces.size();
  if (first == 0 || first >= count)
  {
    return *this;
  }
  PiecewisePolynomial result({ 0.0 }, { -1 }, {});
  for (std::size_t k = 1; k <= count; ++k)
  {
    const std::size_t from = (first + k) % count;
    const double turned = first + k >= count ? 1.0 : 0.0;
    result.Breakpoints.push_back(k < count ? cut.Breakpoints[from] - start + turned : 1.0);
    result.Smoothness.push_back(cut.Smoothness[from]);
    result.Pieces.push_back(cut.Pieces[(first + k - 1) % count]);
  }
  const std::vector<double>& at = cut.Breakpoints;
  result.Smoothness[count - first] = joint_smoothness(
    cut.Pieces.back(), at[count] - at[count - 1], cut.Pieces.front(), at[1] - at[0]);
  return result;
}

PiecewisePolynomial PiecewisePolynomial::rows(int first, int count) const
{
  PiecewisePolynomial result = *this;
  for (Eigen::MatrixXd& piece : result.Pieces)
  {
    piece = piece.middleRows(first, count).eval();
  }
  return result;
}

PiecewisePolynomial PiecewisePolynomial::scaled(double factor) const
{
  PiecewisePolynomial result = *this;
  for (Eigen::MatrixXd& piece : result.Pieces)
  {
    piece *= factor;
  }
  return result;
}

PiecewisePolynomial PiecewisePolynomial::elevated(int degree) const
{
  PiecewisePolynomial result = *this;
  for (Eigen::MatrixXd& piece : result.Pieces)
  {
    while (piece.cols() <= degree)
    {
      piece = elevate_once(piece);
    }
  }
  return result;
}

PiecewisePolynomial PiecewisePolynomial::refined(const std::vector<double>& breakpoints) const
{
  PiecewisePolynomial result({ this->Breakpoints.front() }, { this->Smoothness.front() }, {});
  const int degree = this->degree();
  for (std::size_t k = 0; k < this->Pieces.size(); ++k)
  {
    const double from = this->Breakpoints[k];
    const double length = this->Breakpoints[k + 1] - from;
    std::vector<double> cuts{ 0.0 };
    for (const double at : breakpoints)
    {
      const double local = (at - from) / length;
      if (at - from > kSameKnot && this->Breakpoints[k + 1] - at > kSameKnot && local > cuts.back())
      {
        cuts.push_back(local);
        result.Breakpoints.push_back(at);
        result.Smoothness.push_back(degree); // nothing happens there
      }
    }
    cuts.push_back(1.0);
    result.Breakpoints.push_back(this->Breakpoints[k + 1]);
    result.Smoothness.push_back(this->Smoothness[k + 1]);
    for (std::size_t c = 0; c + 1 < cuts.size(); ++c)
    {
      Eigen::MatrixXd piece(this->Pieces[k].rows(), degree + 1);
      for (int j = 0; j <= degree; ++j)
      {
        std::vector<double> arguments(degree, cuts[c]);
        std::fill(arguments.begin(), arguments.begin() + j, cuts[c + 1]);
        piece.col(j) = blossom(this->Pieces[k], arguments);
      }
      result.Pieces.push_back(std::move(piece));
    }
  }
  return result;
}

PiecewisePolynomial PiecewisePolynomial::times(const PiecewisePolynomial& factor) const
{
  PiecewisePolynomial a = this->refined(factor.Breakpoints);
  const PiecewisePolynomial b = factor.refined(this->Breakpoints);
  const int p = a.degree();
  const int q = b.degree();
  const std::vector<double> of_a = binomials(p);
  const std::vector<double> of_b = binomials(q);
  const std::vector<double> of_product = binomials(p + q);
  for (std::size_t k = 0; k < a.Pieces.size(); ++k)
  {
    Eigen::MatrixXd product = Eigen::MatrixXd::Zero(a.Pieces[k].rows(), p + q + 1);
    for (int i = 0; i <= p; ++i)
    {
      for (int j = 0; j <= q; ++j)
      {
        const double weight = of_a[i] * of_b[j] / of_product[i + j];
        product.col(i + j) += weight * b.Pieces[k](0, j) * a.Pieces[k].col(i);
      }
    }
    a.Pieces[k] = product;
  }
  for (std::size_t k = 0; k < a.Smoothness.size(); ++k)
  {
    // A factor without a knot there does not limit the product.
    const bool free_a = a.Smoothness[k] >= p;
    const bool free_b = b.Smoothness[k] >= q;
    a.Smoothness[k] = free_a
      ? (free_b ? p + q : b.Smoothness[k])
      : (free_b ? a.Smoothness[k] : std::min(a.Smoothness[k], b.Smoothness[k]));
  }
  return a;
}

Eigen::MatrixXd PiecewisePolynomial::control_points(const KnotVector& knots) const
{
  const int p = knots.degree();
  const std::vector<double>& t = knots.local_knots();
  const PiecewisePolynomial all = this->elevated(p);
  Eigen::MatrixXd result(all.Pieces.front().rows(), knots.number_of_control_points());
  for (int i = 0; i < knots.number_of_control_points(); ++i)
  {
    // Of the pieces under the basis function the one in its middle: there the blossom's arguments
    // are nearest and its numbers smallest.
    const double middle = 0.5 * (t[i] + t[i + p + 1]);
    const std::size_t piece = all.piece_at(middle);
    const double from = all.Breakpoints[piece];
    const double length = all.Breakpoints[piece + 1] - from;
    std::vector<double> arguments;
    for (int j = 1; j <= p; ++j)
    {
      arguments.push_back((t[i + j] - from) / length);
    }
    result.col(i) = blossom(all.Pieces[piece], arguments);
  }
  return result;
}

KnotVector common_knots(const PiecewisePolynomial& a, const PiecewisePolynomial& b, int degree)
{
  const PiecewisePolynomial first = a.refined(b.Breakpoints);
  const PiecewisePolynomial second = b.refined(a.Breakpoints);
  const int p = std::max({ degree, a.degree(), b.degree() });
  std::vector<double> knots(p + 1, first.Breakpoints.front());
  for (std::size_t k = 1; k + 1 < first.Breakpoints.size(); ++k)
  {
    const int smooth_a = first.Smoothness[k] >= a.degree() ? p : first.Smoothness[k];
    const int smooth_b = second.Smoothness[k] >= b.degree() ? p : second.Smoothness[k];
    knots.insert(knots.end(), p - std::min(smooth_a, smooth_b), first.Breakpoints[k]);
  }
  knots.insert(knots.end(), p + 1, first.Breakpoints.back());
  return { p, std::move(knots) };
}

} // namespace footpoint
