// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/solvers/step.h"

namespace footpoint
{

/// The geometric steps of the paper on orthogonal projection onto planar curves, carried to space
/// by working in the osculating plane: t the unit tangent, n the principal normal, κ the curvature,
/// (a, b) = ((P − c)·t, (P − c)·n). Everything is formed in the frame (t, n), never from absolute
/// coordinates, whose difference Q − c loses half the digits under the root of eq. (24).
/// \pre method is FirstOrder, CurvatureCircle, SecondOrder1, SecondOrder2 or SecondOrder3
Step<1> make_curve_step(Method method);

} // namespace footpoint
