// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/search/box.h"
#include "footpoint/solvers/local_solver.h"

#include <array>
#include <cmath>
#include <vector>

namespace footpoint
{

/// Where the starts of a seeded search come from.
struct SeedOptions
{
  int resolution = 7; ///< samples a direction of the coarse grid over the domain (guide: 7 × 7)
  int number_of_seeds = 4; ///< that many of the grid's best local minima are descended from
};

/// Starts for the local solver: a coarse grid over the domain, then a 3 × 3 micro-grid of ±10 % of
/// a grid cell around the best samples; where a descent stagnates, again with ±5 %.
///
/// Built once per geometry; queries are const and thread-safe. Seeds find a local minimum, mostly
/// the global one; they prove nothing.
template <int N>
class SeededSearch
{
public:
  SeededSearch(const ParametricGeometry<N>& geometry, const SeedOptions& options);

  /// The best local minima of the sampled distance, nearest first, refined on the micro-grid.
  std::vector<Parameter<N>> seeds(const Vector3& query, int count) const;

  /// The nearest of the feet found from the seeds and, where finite, from the given start.
  LocalFoot<N> find(const Vector3& query, const SolverOptions& options,
    const Parameter<N>& start = Parameter<N>::Constant(NAN)) const;

  /// A descent from one start, started again nearby where it stagnates.
  LocalFoot<N> find_from(
    const Vector3& query, const Parameter<N>& start, const SolverOptions& options) const;

  /// The samples of the coarse grid, first direction fastest, and the box they lie in.
  Eigen::Index number_of_samples() const { return this->Samples.cols(); }
  Parameter<N> parameter(Eigen::Index sample) const;
  Box box() const;

private:
  bool is_local_minimum(Eigen::Index sample, const Eigen::VectorXd& distances) const;
  /// The nearest of the 3 × 3 points around a parameter.
  Parameter<N> refine(const Vector3& query, const Parameter<N>& around, double half_width) const;

  const ParametricGeometry<N>& Geometry;
  SeedOptions Options;
  std::array<std::vector<double>, N> Grid;
  Points Samples;
};

} // namespace footpoint
