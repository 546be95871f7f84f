// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/model/model.h"

namespace footpoint
{

/// A point of a face with its normal or tangent, in model coordinates.
struct Evaluation
{
  Vector3 point;
  /// Surfaces: unit normal S_u × S_v, reversed with the face. Curves: unit tangent.
  Vector3 direction;
  bool on_curve = false;
  bool clamped = false; ///< the parameter lay outside the domain
};

/// Unit tangent of a curve; where C' vanishes the direction in which the curve leaves.
/// \param t local parameter
Vector3 unit_tangent(const ParametricCurve& curve, const Parameter<1>& t, const Sides<1>& sides);

/// Unit normal S_u × S_v of one smooth piece. Where that vanishes (pole, collapsed side, cusp) the
/// limit from inside the domain along the vanishing direction; the zero vector where there is none.
/// \param t local parameters
Vector3 unit_normal(const ParametricSurface& surface, const Parameter<2>& t, const Sides<2>& sides);

/// The same on a kink or seam: the mean of the unit normals of the pieces that meet there, which
/// gives the distance its right sign (J. A. Bærentzen and H. Aanæs 2005).
Vector3 mean_normal(const ParametricSurface& surface, const Parameter<2>& t, const Sides<2>& sides);

/// Evaluates a face at parameters of its own domain (curves: the first one counts). Closed
/// directions are wrapped, open ones clamped; of several patches the one whose domain is nearest to
/// the parameter. \pre the face has a patch and the parameter is finite
Evaluation evaluate(const Face& face, const Parameter<2>& parameter);

} // namespace footpoint
