// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// How clearly the derivatives of a foot on a piece have to say what it is, for no more to be asked.

namespace footpoint
{

/// A foot is plain where r is orthogonal to this cosine, or to this fraction of the size, …
constexpr double kPlainCosine = 1e-12;
constexpr double kPlainResidual = 1e-13;
/// … where a boundary holds it with at least this cosine, …
constexpr double kHeldCosine = 1e-6;
/// … where the Hessian's smallest eigenvalue, in units of |S_i|, is above this, …
constexpr double kPlainCurvature = 1e-5;
/// … and where the sine between S_u and S_v is above this.
constexpr double kPlainSine = 1e-6;

/// Two pieces' feet on the line between them are one point where they are no farther apart than
/// this part of the pieces.
constexpr double kOnePlace = 1e-9;

} // namespace footpoint
