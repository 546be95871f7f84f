// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Random single Bézier patches and curves of any degree, size and weights, and what the search
/// keeps of their pieces.

#include "Shapes.h"

#include "footpoint/search/search_structure.h"

#include <array>
#include <string>
#include <vector>

namespace shapes
{

std::vector<double> bezier_knots(int degree);

/// The pieces of a random patch, or of a curve where the first degree is 0: one, or several where
/// its weights are uneven. \param decades of the size
footpoint::SearchStructure random_pieces(
  Random& random, const std::array<int, 2>& degrees, double decades, std::string& description);

/// Up to nine, mostly low; one in four is of a curve.
std::array<int, 2> random_degrees(Random& random);

/// A plane piece, or a straight curve where the first degree is 0, evenly parametrized: corner + s
/// u + t v.
footpoint::DistanceForms straight_piece(
  const std::array<int, 2>& degrees, const Vector3& corner, const Vector3& u, const Vector3& v);

/// Parameters of a place on a piece, often on its sides.
std::array<double, 2> random_place(Random& random, const footpoint::Piece& piece);

} // namespace shapes
