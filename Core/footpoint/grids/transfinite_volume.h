// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/common/execution.h"
#include "footpoint/grids/boundary_error.h"
#include "footpoint/grids/structured_points.h"

namespace footpoint
{

/// Six faces of a volume, each a grid: u = 0, u = 1 (over v, w), v = 0, v = 1 (over u, w), w = 0,
/// w = 1 (over u, v), the first named direction fastest.
using VolumeFaces = std::array<Grid, 6>;

struct VolumeResult
{
  VolumeGrid grid;
  bool mirrored = false;    ///< the input was left-handed; u was reversed
  double largest_gap = 0.0; ///< between faces along their common edges
};

/// Transfinite interpolation of six faces: faces − edges + corners (W. J. Gordon and C. A. Hall
/// 1973). The faces come out bit for bit on the border, but for their edges, which lie in the
/// middle of gaps.
/// \throw BoundaryError (Count, Resolution, Gap beyond corner_tolerance of the size, NotFinite)
VolumeResult transfinite_volume(
  const VolumeFaces& faces, double corner_tolerance = 1e-8, const Execution& execution = {});

/// The faces of twelve edges, each by bilinear transfinite interpolation.
/// \param edges 4 along u at (v, w) = 00, 10, 01, 11; 4 along v at (u, w); 4 along w at (u, v);
///              those with fewer points than others of their direction are resampled evenly in the
///              index
/// \throw BoundaryError (Count, NotFinite, Gap), naming face and edges
VolumeFaces faces_from_edges(const std::array<Points, 12>& edges, double corner_tolerance = 1e-8);

} // namespace footpoint
