// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/search/box_tree.h"
#include "footpoint/search/distance_forms.h"
#include "footpoint/search/piece_start.h"

#include <functional>

namespace footpoint
{

struct StationaryQuery
{
  Vector3 point; ///< in the model's centred coordinates
  /// False: minima of the distance, those on open ends, kinks, gaps, seams and poles among them.
  /// True: all places inside, and on the border of, a piece where the derivatives of the distance
  /// vanish.
  bool all_stationary;
};

/// Where |S − P| is stationary on the pieces, nearest boxes first.
///
/// The derivatives of D = |S − P|² along a piece have the signs of polynomials. A piece on which
/// the coefficients of one of them have one sign is passed over; else the zeros that they have in
/// common are isolated (BernsteinZeros), and of the sides and corners where the geometry is not
/// smooth those that satisfy the conditions of a minimum (Karush, Kuhn and Tucker) are visited as
/// well. Every local minimum (every stationary point) is a simple start, or lies in the part of one
/// that is not.
///
/// \param limit nothing farther is sought; visits may lower it
void visit_stationary_starts(const DistanceForms& forms, const BoxTree& tree,
  const StationaryQuery& query, const std::function<double()>& limit, const VisitStart& visit);

} // namespace footpoint
