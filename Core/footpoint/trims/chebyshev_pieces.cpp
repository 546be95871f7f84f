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

/// Highest degree of a piece.
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
Homogeneous bernstein_form(const Eigen::MatrixXd& series, int degree)
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
  Approximation(const ArcPatch& patch, double tolerance, std::vector<BezierPiece<1>>& pieces)
    : Patch(patch)
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

  /// \param lower, upper the part of the edge
  void run(const Homogeneous& arc, double lower, double upper, int depth);

  double error() const { return this->Error; }

private:
  /// cos(k (2j + 1) π / (2 Count)): T_k at node j.
  double cosine(int k, int j) const { return this->Cosines[k * (2 * j + 1) % (4 * this->Count)]; }

  /// Chebyshev coefficients of the polynomial with these values (columns) at the nodes.
  Eigen::MatrixXd coefficients(const Eigen::MatrixXd& values) const
  {
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(values.rows(), this->Count);
    for (int k = 0; k < this->Count; ++k)
    {
      for (int j = 0; j < this->Count; ++j)
      {
        result.col(k) += this->cosine(k, j) * values.col(j);
      }
      result.col(k) *= (k == 0 ? 1.0 : 2.0) / this->Count;
    }
    return result;
  }

  /// Bound of |S(c(t)) − q(t)|, q being the series cut off above a degree.
  double rational_bound(const Homogeneous& arc, const Eigen::MatrixXd& points,
    const Eigen::RowVectorXd& weights, const Eigen::MatrixXd& series, int degree) const;

  const ArcPatch& Patch;
  double Tolerance;
  int Count; ///< of nodes
  std::vector<double> Cosines;
  std::vector<BezierPiece<1>>& Pieces;
  double Error = 0.0;
};

void Approximation::run(const Homogeneous& arc, double lower, double upper, int depth)
{
  // === Samples at the nodes, relative to the middle
  const auto point = [](const Eigen::Vector4d& sum) { return Vector3(sum.head<3>() / sum[3]); };
  const Vector3 middle = point(this->Patch.at(arc, 0.5));
  Eigen::MatrixXd points(3, this->Count);
  Eigen::RowVectorXd weights(this->Count);
  for (int j = 0; j < this->Count; ++j)
  {
    const Eigen::Vector4d sum = this->Patch.at(arc, 0.5 + 0.5 * this->cosine(1, j));
    points.col(j) = point(sum) - middle;
    weights[j] = sum[3];
  }
  const Eigen::MatrixXd series = this->coefficients(points);

  // === The lowest degree that will do
  const Eigen::RowVectorXd magnitudes = series.colwise().norm();
  const double accepted = 0.5 * this->Tolerance;
  double allowed = 0.5 * accepted;
  double error = 0.0;
  int degree = 0;
  for (int attempt = 0; attempt < kAttempts && degree < kHighestDegree; ++attempt)
  {
    degree = lowest_degree(magnitudes, allowed, std::min(degree + 1, kHighestDegree));
    error = magnitudes.tail(this->Count - 1 - degree).sum();
    // Weights that vary let the bound be larger than the terms that are cut off.
    const bool small = error <= allowed || depth == kDeepest;
    if (this->Patch.rational && small)
    {
      error = this->rational_bound(arc, points, weights, series, degree);
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
    const double half = 0.5 * (lower + upper);
    this->run(halves[0], lower, half, depth + 1);
    this->run(halves[1], half, upper, depth + 1);
    return;
  }

  // === The piece, which ends where the arc does
  const Vector3 start = point(this->Patch.at(arc, 0.0));
  const Vector3 end = point(this->Patch.at(arc, 1.0));
  BezierPiece<1> piece{ { { degree } }, Parameter<1>(lower), Parameter<1>(upper),
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

  // The ends of halves are rounded parameters.
  const Homogeneous steps = piece.control.rightCols(degree) - piece.control.leftCols(degree);
  const double speed = degree * steps.colwise().norm().maxCoeff() / (upper - lower);
  error += depth > 0 ? speed * 0x1p-52 * upper : 0.0;
  this->Error = std::max(this->Error, error);
  this->Pieces.push_back(std::move(piece));
}

double Approximation::rational_bound(const Homogeneous& arc, const Eigen::MatrixXd& points,
  const Eigen::RowVectorXd& weights, const Eigen::MatrixXd& series, int degree) const
{
  // w from below by its own series, or where that says nothing by its factors.
  const Eigen::MatrixXd of_weights = this->coefficients(weights);
  const double by_series =
    of_weights(0, 0) - of_weights.rightCols(this->Count - 1).cwiseAbs().sum();
  const double by_factors = this->Patch.control.row(3).minCoeff() *
    std::pow((arc.row(0) + arc.row(1)).minCoeff(), this->Patch.degree[0]) *
    std::pow((arc.row(2) + arc.row(3)).minCoeff(), this->Patch.degree[1]);

  Eigen::MatrixXd residual(3, this->Count);
  for (int j = 0; j < this->Count; ++j)
  {
    Vector3 q = series.col(0);
    for (int k = 1; k <= degree; ++k)
    {
      q += this->cosine(k, j) * series.col(k);
    }
    residual.col(j) = weights[j] * (points.col(j) - q);
  }
  return this->coefficients(residual).colwise().norm().sum() / std::max(by_series, by_factors);
}

} // namespace

double append_chebyshev_pieces(const ArcPatch& patch, double start, double end, double tolerance,
  std::vector<BezierPiece<1>>& pieces)
{
  Approximation approximation(patch, tolerance, pieces);
  approximation.run(patch.arc, start, end, 0);
  return approximation.error();
}

} // namespace footpoint
