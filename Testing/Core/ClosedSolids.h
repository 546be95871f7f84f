// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Closed solids of trimmed and untrimmed faces whose normals point outward, each with a closed
/// form that tells inside from outside.

#include "TrimShapes.h"

#include "footpoint/model/model.h"

#include <functional>
#include <string>
#include <vector>

namespace solids
{

using footpoint::Face;
using footpoint::Model;
using footpoint::Surface;
using footpoint::TrimLoop;
using footpoint::Vector3;
using trims::Point2;

struct Solid
{
  std::string name;
  Model faces;
  std::function<bool(const Vector3&)> inside;
  std::vector<Vector3> targets; ///< points of edges and vertices
  double size;
};

/// The plane o + u·a + v·b over a box of parameters around `corners`, which it is trimmed to.
Face plane(const Vector3& o, const Vector3& a, const Vector3& b, const std::vector<TrimLoop>& loops,
  double low = -4.0, double high = 4.0);

Face whole(const Surface& surface, bool reversed = false);

/// A polygon in the plane z = 0, counter-clockwise, raised to a height: two trimmed faces and one a
/// side.
Model prism(const std::vector<Point2>& corners, double height);

std::vector<Vector3> edges_of_prism(const std::vector<Point2>& corners, double height);
Solid box(const char* name, double a, double b, double c);

/// With a concave edge at (1, 1).
Solid l_shape();

/// Radius 1 from z = 0 to 2, caps trimmed by circles.
Solid cylinder();

/// Base radius 1 at z = 0, apex (0, 0, 1.5).
Solid cone();

/// A box [-2, 2]² × [0, 1] with a round hole of radius 1 through it.
Solid box_with_hole();

/// x, y, z > 0 of the unit ball.
Solid sphere_octant();

std::vector<Solid> all();

} // namespace solids
