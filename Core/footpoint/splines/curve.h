// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/splines/knot_vector.h"
#include "footpoint/splines/parametric_geometry.h"

namespace footpoint
{

/// A NURBS curve in space; a planar one has z = 0.
class Curve : public ParametricCurve
{
public:
  /// \param knots          degree and full knot vector
  /// \param control_points #n columns, Cartesian (not multiplied by the weight)
  /// \param weights        #n positive numbers; empty: all 1 (a polynomial spline)
  /// \throw GeometryError (Count, NotFinite, Weight)
  Curve(KnotVector knots, const Points& control_points, Eigen::VectorXd weights = {});

  Jet<1> jet(const Parameter<1>& t, const Sides<1>& sides, int order) const override;

  const KnotVector& knots() const { return this->Knots; }
  bool rational() const { return this->Weights.size() > 0; }
  const Eigen::VectorXd& weights() const { return this->Weights; } ///< empty where all are equal
  /// Control points relative to centre().
  const Points& local_control_points() const { return this->ControlPoints; }

private:
  KnotVector Knots;
  Points ControlPoints;
  Eigen::VectorXd Weights;
  Eigen::Matrix<double, 4, Eigen::Dynamic> Homogeneous; ///< (w·x, w·y, w·z, w), local
};

} // namespace footpoint
