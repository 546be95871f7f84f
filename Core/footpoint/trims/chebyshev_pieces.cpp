// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/trims/chebyshev_pieces.h"

#include "footpoint/splines/binomials.h"

#include <algorithm>
#include <cmath>

namespace footpoint
{
namespace
{

using Homogeneous = ArcPatch::Homogeneous;

/// (x, y, z, w) at the nodes, one a column; or their Chebyshev coefficients.
using Samples = Eigen::Matrix<double, 4, Eigen::Dynamic>;

/// Highest degree of a piece. Of random edges, degree 7 needs three times the pieces and twice the
/// memory, degree 15 half the pieces, which cost the search twice the work each.
constexpr int kHighestDegree = 11;

/// Halvings of an arc at most; further ones would be below the rounding of its parameter.
constexpr int kDeepest = 24;

/// How often a higher degree is tried before halving.
constexpr int kAttempts = 3;

/// What evaluating S(c(t)) may add to a residual: some roundings in each of the samples.
constexpr double kNoise = 8.0 * 0x1p-53;

/// Bernstein coefficients of the Chebyshev polynomials on [0, 1], all in one degree.
struct ChebyshevBasis
{
  long double value[kHighestDegree + 1][kHighestDegree + 1]; ///< row k: of T_k

  explicit ChebyshevBasis(int degree)
  {
    for (int k = 0; k <= degree; ++k)
    {
      // T_k = Σ (−1)^(k−i) binomial(2k, 2i) / binomial(k, i) B_i^k, elevated to the degree.
      long double* row = this->value[k];
      for (int i = 0; i <= k; ++i)
      {
        const long double sign = (k - i) % 2 == 0 ? 1.0L : -1.0L;
        row[i] = sign * static_cast<long double>(kBinomials.value[2 * k][2 * i]) /
          static_cast<long double>(kBinomials.value[k][i]);
      }
      for (int d = k + 1; d <= degree; ++d)
      {
        row[d] = row[d - 1];
        for (int i = d - 1; i >= 1; --i)
        {
          row[i] = (i * row[i - 1] + (d - i) * row[i]) / d;
        }
      }
    }
  }
};

/// The tables of all degrees.
const ChebyshevBasis& chebyshev_basis(int degree)
{
  static const std::vector<ChebyshevBasis> all = []()
  {
    std::vector<ChebyshevBasis> made;
    for (int d = 0; d <= kHighestDegree; ++d)
    {
      made.emplace_back(d);
    }
    return made;
  }();
  return all[degree];
}

/// The lowest degree, from `first` on, above which the terms of a series sum up to what is allowed;
/// kHighestDegree where there is none.
int lowest_degree(const Eigen::RowVectorXd& magnitudes, double allowed, int first)
{
  int degree = kHighestDegree;
  double above = magnitudes.tail(magnitudes.size() - 1 - degree).sum();
  while (degree > first && above + magnitudes[degree] <= allowed)
  {
    above += magnitudes[degree--];
  }
  return degree;
}

/// Control points, with the weight 1, of a Chebyshev series cut off above a degree. The sums have
/// large terms of both signs, which is why they are taken in long double.
Homogeneous bernstein_form(const Samples& series, int degree)
{
  const ChebyshevBasis& basis = chebyshev_basis(degree);
  Homogeneous control = Homogeneous::Ones(4, degree + 1);
  for (int i = 0; i <= degree; ++i)
  {
    for (int x = 0; x < 3; ++x)
    {
      long double sum = 0.0L;
      for (int k = 0; k <= degree; ++k)
      {
        sum += basis.value[k][i] * static_cast<long double>(series(x, k));
      }
      control(x, i) = static_cast<double>(sum);
    }
  }
  return control;
}

class Approximation
{
public:
  Approximation(const ArcPatch& patch, const std::array<double, 2>& range, double tolerance,
    std::vector<BezierPiece<1>>& pieces)
    : Patch(patch)
    , Range(range)
    , Tolerance(tolerance)
    , Count(patch.composed_degree() + kHighestDegree + 1)
    , Cosines(4 * Count)
    , Pieces(pieces)
  {
    for (int i = 0; i < 4 * this->Count; ++i)
    {
      this->Cosines[i] = std::cos(std::acos(-1.0) * i / (2 * this->Count));
    }
    const double noise = kNoise * patch.magnitude * std::sqrt(2.0 * this->Count);
    this->Tolerance = std::max(this->Tolerance, 4.0 * noise);
  }

  /// \param arc the part [from, to] of the whole arc, [0, 1]
  void run(const Homogeneous& arc, double from, double to, int depth);

  double error() const { return this->Error; }

private:
  /// cos(k (2j + 1) π / (2 Count)): T_k at node j.
  double cosine(int k, int j) const { return this->Cosines[k * (2 * j + 1) % (4 * this->Count)]; }

  /// Chebyshev coefficients of the polynomial with these values at the nodes.
  Samples coefficients(const Samples& values) const;

  /// Bound of |S(c(t)) − q(t)|, q being the series cut off above a degree.
  double rational_bound(
    const Homogeneous& arc, const Samples& values, const Samples& series, int degree) const;

  /// The edge's parameter at a fraction of the arc.
  double parameter(double fraction) const
  {
    return fraction == 1.0 ? this->Range[1]
                           : this->Range[0] + fraction * (this->Range[1] - this->Range[0]);
  }
  /// How far a parameter is from that of a fraction.
  double parameter_error(double fraction, double parameter) const
  {
    const long double start = this->Range[0];
    const long double exact = start + fraction * (this->Range[1] - start);
    return static_cast<double>(std::abs(exact - parameter) + 0x1p-63L * std::abs(exact));
  }

  const ArcPatch& Patch;
  std::array<double, 2> Range;
  double Tolerance;
  int Count; ///< of nodes
  std::vector<double> Cosines;
  std::vector<BezierPiece<1>>& Pieces;
  double Error = 0.0;
};

Samples Approximation::coefficients(const Samples& values) const
{
  // Even and odd T_k have equal and opposite values at opposite nodes.
  const int half = this->Count / 2;
  std::array<Samples, 2> folded{ { Samples(4, half), Samples(4, half) } };
  for (int j = 0; j < half; ++j)
  {
    folded[0].col(j) = values.col(j) + values.col(this->Count - 1 - j);
    folded[1].col(j) = values.col(j) - values.col(this->Count - 1 - j);
  }
  Samples result(4, this->Count);
  const int period = 4 * this->Count;
  for (int k = 0; k < this->Count; ++k)
  {
    const Samples& of = folded[k % 2];
    Eigen::Vector4d sum = Eigen::Vector4d::Zero();
    if (this->Count % 2 == 1)
    {
      sum = this->cosine(k, half) * values.col(half);
    }
    for (int j = 0, angle = k; j < half; ++j)
    {
      sum += this->Cosines[angle] * of.col(j);
      angle += 2 * k;
      angle -= angle >= period ? period : 0;
    }
    result.col(k) = (k == 0 ? 1.0 : 2.0) / this->Count * sum;
  }
  return result;
}

void Approximation::run(const Homogeneous& arc, double from, double to, int depth)
{
  // === Samples at the nodes, relative to the middle
  const auto point = [](const Eigen::Vector4d& sum) { return Vector3(sum.head<3>() / sum[3]); };
  const Vector3 middle = point(this->Patch.at(arc, 0.5));
  Samples values(4, this->Count);
  for (int j = 0; j < this->Count; ++j)
  {
    const Eigen::Vector4d sum = this->Patch.at(arc, 0.5 + 0.5 * this->cosine(1, j));
    values.col(j) << point(sum) - middle, sum[3];
  }
  const Samples series = this->coefficients(values);

  // === The lowest degree that will do
  const Eigen::RowVectorXd magnitudes = series.topRows<3>().colwise().norm();
  const double accepted = 0.5 * this->Tolerance;
  double allowed = 0.5 * accepted;
  double error = 0.0;
  int degree = 0;
  for (int attempt = 0; attempt < kAttempts && degree < kHighestDegree; ++attempt)
  {
    degree = lowest_degree(magnitudes, allowed, std::min(degree + 1, kHighestDegree));
    error = magnitudes.tail(this->Count - 1 - degree).sum();
    // Weights that vary let the bound be larger than the terms that are cut off.
    const bool small = error <= accepted || depth == kDeepest;
    if (this->Patch.rational && small)
    {
      error = this->rational_bound(arc, values, series, degree);
    }
    if (error <= accepted)
    {
      break;
    }
    allowed = std::min(allowed, allowed * allowed / error);
  }
  if (!(error <= accepted) && depth < kDeepest)
  {
    const std::array<Homogeneous, 2> halves = halve_arc(arc);
    const double half = 0.5 * (from + to);
    this->run(halves[0], from, half, depth + 1);
    this->run(halves[1], half, to, depth + 1);
    return;
  }

  // === The piece, which ends where the arc does
  const Vector3 start = point(this->Patch.at(arc, 0.0));
  const Vector3 end = point(this->Patch.at(arc, 1.0));
  const std::array<double, 2> ends{ this->parameter(from), this->parameter(to) };
  BezierPiece<1> piece{ { { degree } }, Parameter<1>(ends[0]), Parameter<1>(ends[1]),
    bernstein_form(series, degree) };
  piece.control.topRows<3>().colwise() += middle;
  const Vector3 start_off = start - piece.control.col(0).head<3>();
  const Vector3 end_off = end - piece.control.col(degree).head<3>();
  for (int i = 1; i < degree; ++i)
  {
    const double part = static_cast<double>(i) / degree;
    piece.control.col(i).head<3>() += (1.0 - part) * start_off + part * end_off;
  }
  piece.control.col(0).head<3>() = start;
  piece.control.col(degree).head<3>() = end;
  error += std::max(start_off.norm(), end_off.norm());

  // The parameters of its ends are rounded.
  const Homogeneous steps = piece.control.rightCols(degree) - piece.control.leftCols(degree);
  const double speed = degree * steps.colwise().norm().maxCoeff() / (ends[1] - ends[0]);
  error +=
    speed * std::max(this->parameter_error(from, ends[0]), this->parameter_error(to, ends[1]));
  this->Error = std::max(this->Error, error);
  this->Pieces.push_back(std::move(piece));
}

double Approximation::rational_bound(
  const Homogeneous& arc, const Samples& values, const Samples& series, int degree) const
{
  // w from below by its own series, or where that says nothing by its factors.
  const double by_series = series(3, 0) - series.row(3).tail(this->Count - 1).cwiseAbs().sum();
  const double by_factors = this->Patch.control.row(3).minCoeff() *
    std::pow((arc.row(0) + arc.row(1)).minCoeff(), this->Patch.degree[0]) *
    std::pow((arc.row(2) + arc.row(3)).minCoeff(), this->Patch.degree[1]);

  Samples residual(4, this->Count);
  for (int j = 0; j < this->Count; ++j)
  {
    Eigen::Vector4d q = series.col(0);
    for (int k = 1; k <= degree; ++k)
    {
      q += this->cosine(k, j) * series.col(k);
    }
    residual.col(j) = values(3, j) * (values.col(j) - q);
  }
  return this->coefficients(residual).topRows<3>().colwise().norm().sum() /
    std::max(by_series, by_factors);
}

} // namespace

double append_chebyshev_pieces(const ArcPatch& patch, double start, double end, double tolerance,
  std::vector<BezierPiece<1>>& pieces)
{
  Approximation approximation(patch, { { start, end } }, tolerance, pieces);
  approximation.run(patch.arc, 0.0, 1.0, 0);
  return approximation.error();
}

} // namespace footpoint
