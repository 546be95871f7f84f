// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/grids/boundary_error.h"
#include "footpoint/splines/curve.h"
#include "footpoint/splines/surface.h"

#include <vector>

namespace footpoint
{

struct GordonOptions
{
  /// How far curves may pass each other where they should meet, as a fraction of the network's size.
  double intersection_tolerance = 1e-3;
  /// The parameters of the intersections have to agree along all curves of a family; where they do not
  /// the curves are reparametrized (approximately, by a monotone cubic, refitted) only if this is on,
  /// else the network is refused.
  bool reparametrize = false;
  double reparametrization_tolerance = 1e-4; ///< largest allowed change of a curve, fraction of the size
};

struct GordonResult
{
  Surface surface;
  std::vector<double> parameters_u; ///< of the guides on the profiles, ascending
  std::vector<double> parameters_v; ///< of the profiles on the guides
  std::vector<int> profile_order;   ///< which input became the k-th profile
  std::vector<int> guide_order;
  std::vector<bool> profile_reversed;
  std::vector<bool> guide_reversed;
  double largest_gap = 0.0;              ///< between curves that should meet
  double reparametrization_error = 0.0;  ///< 0 where none was needed
};

/// The Gordon surface (W. J. Gordon 1969) through a network: profiles run along u, guides along v, every
/// profile meets every guide once. S = S_profiles + S_guides − S_grid, all on one pair of knot vectors;
/// the intersections are found by descents of curve against curve.
/// \param profiles at least 2, any order and direction; non-rational (rational ones are refused: the
///                 network of rational curves has no exact Gordon surface of this kind)
/// \throw BoundaryError, GeometryError
GordonResult gordon_surface(const std::vector<Curve>& profiles, const std::vector<Curve>& guides,
  const GordonOptions& options = {});

} // namespace footpoint
