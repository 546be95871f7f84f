// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/solvers/local_solver.h"

#include <optional>

namespace footpoint
{

/// Newton's iteration on the gradient itself, Armijo on its length: finds a foot where r = S − P is
/// orthogonal to the geometry, be it minimum, saddle or maximum of the distance.
/// \param query local coordinates; \param start local parameters inside the domain
/// \return nothing where the iteration does not end in an orthogonal foot
template <int N>
std::optional<LocalFoot<N>> find_orthogonal_foot(const ParametricGeometry<N>& geometry,
  const Vector3& query, const Parameter<N>& start, const SolverOptions& options);

/// Whether r is orthogonal to the geometry at a foot: on all smooth pieces that meet there, and at
/// a pole in all its columns.
template <int N>
bool is_orthogonal(const ParametricGeometry<N>& geometry, const Vector3& query,
  const LocalFoot<N>& foot, const SolverOptions& options);

} // namespace footpoint
