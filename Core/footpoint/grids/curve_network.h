// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/grids/gordon_surface.h"
#include "footpoint/splines/piecewise_polynomial.h"

namespace footpoint
{

/// Curves of one family, in order and direction, and where they meet the other family.
struct CurveFamily
{
  std::vector<PiecewisePolynomial> curves; ///< homogeneous coordinates (4 rows) over [0, 1]
  /// (k, j): parameter in [0, 1] at which the k-th curve meets the j-th of the other family. Closed
  /// curves start where they meet the first and meet it again at 1, in one more column.
  Eigen::MatrixXd meetings;
  bool closed = false;
  /// Rational: all curves have the weights of the first one (after align_parameters).
  bool weighted = false;

  /// Place of the k-th curve in space.
  Vector3 point(std::size_t k, double t) const;
};

/// A network put in order: profiles along u, guides along v.
struct CurveNetwork
{
  CurveFamily profiles;
  CurveFamily guides;
  double size = 0.0; ///< diagonal of the bounding box
  NetworkReport report;
};

/// Finds all meetings, sorts both families along the other one and turns all curves of a family the
/// way its first one runs. Closed curves start at the first given curve of the other family.
/// \throw BoundaryError (Count, Gap, Branch where curves meet in different orders)
CurveNetwork order_network(const std::vector<Curve>& profiles, const std::vector<Curve>& guides,
  const GordonOptions& options);

/// Brings the meetings of a family to one parameter each: the mean, where all agree to `tolerance`
/// in space; else by reparametrization, if allowed, after which the curves have no weights.
/// \param name of the curves in messages
/// \return the common parameters; changes `family`, adds to `error` the change of its curves
/// \throw BoundaryError (Branch)
std::vector<double> align_parameters(CurveFamily& family, const std::string& name, double size,
  const GordonOptions& options, double& error);

} // namespace footpoint
