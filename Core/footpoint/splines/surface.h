// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/splines/knot_vector.h"
#include "footpoint/splines/parametric_geometry.h"

namespace footpoint
{

/// A tensor-product NURBS surface.
class Surface : public ParametricSurface
{
public:
  /// \param knots_u, knots_v degrees and full knot vectors, nu and nv control points
  /// \param control_points   nu·nv columns, u fastest, Cartesian (not multiplied by the weight)
  /// \param weights          nu·nv positive numbers, u fastest; empty: all 1
  /// \throw GeometryError (Count, NotFinite, Weight)
  Surface(KnotVector knots_u, KnotVector knots_v, const Points& control_points,
    Eigen::VectorXd weights = {});

  Jet<2> jet(const Parameter<2>& t, const Sides<2>& sides, int order) const override;

  const KnotVector& knots(int direction) const { return this->Knots[direction]; }
  bool rational() const { return this->Weights.size() > 0; }
  const Eigen::VectorXd& weights() const { return this->Weights; } ///< empty where all are equal
  /// Control points relative to centre(), u fastest.
  const Points& local_control_points() const { return this->ControlPoints; }

private:
  std::array<KnotVector, 2> Knots;
  Points ControlPoints;
  Eigen::VectorXd Weights;
  Eigen::Matrix<double, 4, Eigen::Dynamic> Homogeneous; ///< (w·x, w·y, w·z, w), local
};

} // namespace footpoint
