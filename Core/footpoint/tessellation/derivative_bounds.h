// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/splines/surface.h"

#include <vector>

namespace footpoint
{

/// A box of local parameters.
struct ParameterBox
{
  Parameter<2> lower;
  Parameter<2> upper;

  Parameter<2> extent() const { return this->upper - this->lower; }
};

/// Bounds of a second derivative in the parameters' directions: |d²f(a, a)| for a = (a_u, a_v) is
/// at most uu·a_u² + 2·uv·|a_u·a_v| + vv·a_v².
struct SecondBounds
{
  double uu = 0.0;
  double uv = 0.0;
  double vv = 0.0;

  SecondBounds joined_with(const SecondBounds& other) const;

  /// Of |f − its linear interpolant| over a triangle within a box of these extents (D. Filip, R.
  /// Magedson and R. Markot 1986).
  double chord(const Parameter<2>& extent) const
  {
    return (this->uu * extent[0] * extent[0] + 2.0 * this->uv * extent[0] * extent[1] +
             this->vv * extent[1] * extent[1]) /
      8.0;
  }
  /// The same over a triangle: R²/2, R being the radius of the least circle around its corners in
  /// the metric (uu + uv·r, vv + uv/r), for which the triangle's box has the sides 1 : r (S.
  /// Waldron 1998).
  double chord(const std::array<Parameter<2>, 3>& corners) const;
};

/// Upper bounds of the magnitudes of a surface's derivatives over a box (model units by
/// parameters). Those by a direction in which the box has no extent are 0.
struct DerivativeBounds
{
  double u = 0.0;
  double v = 0.0;
  SecondBounds second; ///< of the whole vectors
  SecondBounds height; ///< of their components along a given direction

  DerivativeBounds joined_with(const DerivativeBounds& other) const;
};

/// Bounds from the control nets of a surface's Bézier pieces, restricted to boxes: second
/// derivatives of nets are differences, those of rational pieces follow from the product rule for
/// w·S, after an affine map near S was subtracted. They converge to the derivatives as boxes
/// shrink. Const and thread-safe.
class SurfaceBounds
{
public:
  /// \param surface outlives this
  explicit SurfaceBounds(const ParametricSurface& surface);

  const Surface& surface() const { return *this->Base; }
  std::size_t rows() const { return this->Knots[1].size() - 1; }
  /// Computes what over() needs for a row of knot spans; rows may be computed at once by threads.
  void prepare_row(std::size_t row);
  /// Whether the bounds of all pieces are numbers, once all rows are prepared.
  bool finite() const;

  /// Over a box: of restricted pieces where it touches few, else of whole ones.
  /// \param up the unit vector of heights; where whole pieces are taken heights are those of the
  /// vectors
  DerivativeBounds over(const ParameterBox& box, const Vector3& up = Vector3::Zero()) const;
  /// Of the whole pieces that a box touches: larger, but fast.
  DerivativeBounds of_pieces(const ParameterBox& box) const;

  /// The knot spans that a box touches, [first, last] per direction.
  std::array<std::array<std::size_t, 2>, 2> spans(const ParameterBox& box) const;
  const std::vector<double>& knots(int direction) const { return this->Knots[direction]; }

private:
  DerivativeBounds of_span(
    std::size_t i, std::size_t j, const ParameterBox& box, const Vector3& up) const;

  const Surface* Base;
  std::array<std::vector<double>, 2> Knots; ///< local parameters of the knot lines
  Eigen::Matrix<double, 4, Eigen::Dynamic> Net;
  std::vector<DerivativeBounds> Pieces; ///< u fastest
};

/// The largest |C''| of a curve over a part of one knot span, or more.
double second_derivative_bound(const class Curve& curve, double lower, double upper);

} // namespace footpoint
