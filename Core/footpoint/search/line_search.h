// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/search/box_tree.h"
#include "footpoint/search/distance_forms.h"
#include "footpoint/search/piece_start.h"

namespace footpoint
{

struct LineQuery
{
  Vector3 point;     ///< of the line, in the model's centred coordinates
  Vector3 direction; ///< unit vector
  double tolerance;  ///< the line meets what it passes closer than this
  double limit;      ///< nothing farther from the point is sought
};

/// Where a line meets the pieces.
///
/// The line is the intersection of two planes; the distances of S from both, times w, are
/// polynomials with the degree of the piece, and their common zeros are isolated (BernsteinZeros;
/// T. W. Sederberg and T. Nishita 1990 for rays and Bézier patches). Every meeting is a simple
/// start, or lies in the part of one that is not: where the line touches the piece or lies in it.
void visit_meeting_starts(
  const DistanceForms& forms, const BoxTree& tree, const LineQuery& query, const VisitStart& visit);

} // namespace footpoint
