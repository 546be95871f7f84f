// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/splines/interpolation.h"

#include <Eigen/SparseLU>

#include <algorithm>

namespace footpoint
{

KnotVector averaged_knots(const std::vector<double>& parameters, int degree)
{
  const int count = static_cast<int>(parameters.size());
  const int p = std::min(degree, count - 1);
  std::vector<double> knots(p + 1, 0.0);
  for (int j = 1; j + p < count; ++j)
  {
    double sum = 0.0;
    for (int i = j; i < j + p; ++i)
    {
      sum += parameters[i];
    }
    knots.push_back(sum / p);
  }
  knots.insert(knots.end(), p + 1, 1.0);
  return { p, std::move(knots) };
}

Eigen::MatrixXd interpolate(
  const KnotVector& knots, const std::vector<double>& parameters, const Eigen::MatrixXd& values)
{
  const int p = knots.degree();
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<double> basis(p + 1);
  for (std::size_t k = 0; k < parameters.size(); ++k)
  {
    const int span = knots.find_span(parameters[k], Side::Right);
    knots.basis(span, parameters[k], 0, basis.data());
    for (int j = 0; j <= p; ++j)
    {
      entries.emplace_back(static_cast<int>(k), span - p + j, basis[j]);
    }
  }
  const auto count = static_cast<Eigen::Index>(parameters.size());
  Eigen::SparseMatrix<double> matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::SparseLU<Eigen::SparseMatrix<double>> solver(matrix);
  const Eigen::MatrixXd right = values.transpose();
  return solver.solve(right).transpose();
}

} // namespace footpoint
