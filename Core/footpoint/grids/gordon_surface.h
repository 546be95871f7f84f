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
  /// How far curves may pass each other where they should meet, as a fraction of the network's
  /// size.
  double intersection_tolerance = 1e-3;
  /// The parameters of the meetings have to agree along all curves of a family, to the effect of
  /// intersection_tolerance in space. Where they do not the network is refused; with this on the
  /// curves are reparametrized instead (approximately: a monotone cubic change of parameter,
  /// refitted by polynomials).
  bool reparametrize = false;
  double reparametrization_tolerance =
    1e-4; ///< largest allowed change of a curve, fraction of the size
};

/// What was done to a network to put it in order.
struct NetworkReport
{
  /// Of the guides on the profiles, in [0, 1], ascending. Closed profiles meet the first guide at 0
  /// and once more at 1: there is one number more than guides, also in `guide_order` (where the
  /// last is the guide that is the first again) and `guide_reversed`.
  std::vector<double> parameters_u;
  std::vector<double> parameters_v; ///< of the profiles on the guides, likewise
  std::vector<int> profile_order;   ///< which input became the k-th profile
  std::vector<int> guide_order;
  std::vector<bool> profile_reversed; ///< of the k-th profile, after ordering
  std::vector<bool> guide_reversed;
  double largest_gap = 0.0;             ///< between curves that should meet, model units
  double reparametrization_error = 0.0; ///< largest change of a curve; 0 where none was needed
};

struct GordonResult
{
  Surface surface; ///< domain [0, 1]²
  NetworkReport network;
};

/// The Gordon surface (W. J. Gordon 1969) through a network: profiles run along u, guides along v,
/// every profile meets every guide once. S = S_profiles + S_guides − S_grid, all on one pair of
/// knot vectors; the intersections are found by descents of curve against curve.
///
/// Closed profiles make a surface that is closed along u: they start and end at guide 0, or at the
/// guide that is given twice, which is then the last one too. It is C2 across the seam between
/// profiles that are. Closed guides likewise along v. All curves of a family are closed or none.
///
/// \param profiles at least 2, any order and direction. Rational curves have an exact Gordon
///                 surface where all of a family have the same weights as functions of the
///                 parameter (up to a factor each), as the circles about a tube
/// \throw BoundaryError, GeometryError
GordonResult gordon_surface(const std::vector<Curve>& profiles, const std::vector<Curve>& guides,
  const GordonOptions& options = {});

} // namespace footpoint
