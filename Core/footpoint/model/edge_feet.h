// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/search/patch_search.h"
#include "footpoint/trims/edge_curve.h"

namespace footpoint
{

/// A foot on an edge of a trimmed face, as one on the face's surface: local parameters (u, v), the
/// geometry's own, and the type Edge or, where trim curves meet or have a corner, Vertex.
PatchFoot on_surface(const EdgeCurve& edge, const PatchFoot& foot);

/// Whether the distance does not decrease from a foot on an edge into the face.
/// \param foot on the edge
bool is_minimum_on_face(const EdgeCurve& edge, const TrimRegion& region, const PatchFoot& foot);

} // namespace footpoint
