// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/common/execution.h"
#include "footpoint/search/box_tree.h"
#include "footpoint/search/distance_forms.h"
#include "footpoint/search/piece_neighbourhood.h"
#include "footpoint/search/piece_outline.h"

namespace footpoint
{

/// The plane that touches a piece in its middle, for a first guess of a foot's parameters:
/// t = ½ + rows · (P − point). A curve has its tangent in the second row, zero in the first.
struct TangentPlane
{
  double point[3]; ///< from the piece's origin
  double rows[2][3];
};

/// What CertifiedSearch builds once: the pieces, a tree over their boxes, and for each
/// piece a plane, an outline and the pieces around it.
struct SearchStructure
{
  SearchStructure() = default;
  /// \param execution whose threads share the pieces if there are many
  explicit SearchStructure(DistanceForms pieces, const Execution& execution = {});

  DistanceForms forms;
  BoxTree tree;
  AlignedVector<TangentPlane> planes;
  AlignedVector<PieceNeighbourhood> neighbourhoods;
  PieceOutlines outlines;
};

} // namespace footpoint
