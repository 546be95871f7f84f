// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/shapes/shape_checks.h"
#include "footpoint/shapes/shapes.h"

namespace footpoint
{

// 1 − u² on [−1, 1] has the Bernstein coefficients 0, 2, 0; with |v| = 1 + z/draft, 1 − (z/draft)²
// = 2|v| − v² has 0, 1, 1 on [0, 1].
Shape ship_hull(double length, double beam, double draft, bool capping)
{
  check_length("Length", length);
  check_length("Beam", beam);
  check_length("Draft", draft);
  const std::array<double, 3> x{ { -0.5 * length, 0.0, 0.5 * length } };
  const std::array<double, 3> waterline{ { 0.0, beam, 0.0 } };
  const KnotVector knots_u(2, { -1, -1, -1, 1, 1, 1 }, "KnotsU");
  const KnotVector knots_v(2, { -1, -1, -1, 0, 0, 0 }, "KnotsV"); // v = z / draft

  const auto side = [&](int sign)
  {
    const std::array<double, 3> fullness{ { 0.0, 1.0, 1.0 } };
    Points points(3, 9);
    for (int j = 0; j < 3; ++j)
    {
      for (int i = 0; i < 3; ++i)
      {
        // S_u × S_v points to −y where x grows along u: to port it falls.
        points.col(3 * j + i) << -sign * x[i], sign * waterline[i] * fullness[j],
          0.5 * draft * (j - 2);
      }
    }
    return Surface(knots_u, knots_v, points);
  };
  Shape shape{ { "Port", side(1) }, { "Starboard", side(-1) } };
  if (capping)
  {
    Points deck(3, 6);
    for (int i = 0; i < 3; ++i)
    {
      deck.col(i) << x[i], -waterline[i], 0.0;
      deck.col(3 + i) << x[i], waterline[i], 0.0;
    }
    shape.push_back({ "Deck", Surface(knots_u, KnotVector(1, { -1, -1, 1, 1 }, "KnotsV"), deck) });
  }
  return shape;
}

} // namespace footpoint
