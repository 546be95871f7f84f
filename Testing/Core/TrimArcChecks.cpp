// SPDX-License-Identifier: BSD-3-Clause

#include "TrimArcChecks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace trims
{

void check_arcs(
  const footpoint::TrimRegion& region, const std::vector<TrimLoop>& loops, const Surface& surface)
{
  const std::vector<footpoint::TrimArc>& arcs = region.arcs();
  ASSERT_FALSE(arcs.empty());
  std::array<Real, 2> rounding;
  for (int i = 0; i < 2; ++i)
  {
    const footpoint::Direction& direction = surface.direction(i);
    // Ends are moved onto borders by at most 1e-12 of the domain.
    rounding[i] = 2e-12L * direction.length + 1e-14L * std::abs(direction.origin);
  }
  const auto apart = [&](const RealPoint& a, const RealPoint& b, int i)
  {
    const footpoint::Direction& direction = surface.direction(i);
    const Real difference = a[i] - b[i];
    return std::abs(direction.closed
        ? difference - std::round(difference / direction.length) * direction.length
        : difference);
  };
  std::size_t first = 0; // arc of the loop
  for (std::size_t k = 0; k < arcs.size(); ++k)
  {
    const footpoint::TrimArc& arc = arcs[k];
    SCOPED_TRACE("arc " + std::to_string(k) + " of " + std::to_string(arcs.size()));
    const bool last_of_loop = k + 1 == arcs.size() || arcs[k + 1].loop != arc.loop;
    const footpoint::TrimArc& next = last_of_loop ? arcs[first] : arcs[k + 1];
    first = last_of_loop ? k + 1 : first;
    const RealPoint start = on_arc(arc, 0);
    const RealPoint end = on_arc(arc, 1);
    EXPECT_LE(arc.range[0], arc.range[1]);
    for (int i = 0; i < 2; ++i)
    {
      const footpoint::Direction& direction = surface.direction(i);
      EXPECT_LE(apart(end, on_arc(next, 0), i), rounding[i]);
      const Real sign = end[i] >= start[i] ? 1 : -1;
      Real before = start[i];
      for (int s = 1; s <= 16; ++s)
      {
        const Real at = on_arc(arc, s / Real(16))[i];
        EXPECT_GE(sign * (at - before), -rounding[i]);
        before = at;
      }
      for (const double line : direction.spans)
      {
        EXPECT_FALSE(std::min(start[i], end[i]) < line - rounding[i] &&
          std::max(start[i], end[i]) > line + rounding[i]);
      }
      const bool inside =
        std::min(start[i], end[i]) >= 0 && std::max(start[i], end[i]) <= direction.length;
      if (arc.inside_domain || direction.closed)
      {
        EXPECT_TRUE(std::min(start[i], end[i]) >= -rounding[i] &&
          std::max(start[i], end[i]) <= direction.length + rounding[i]);
      }
      else if (!inside)
      {
        EXPECT_FALSE(arc.inside_domain);
      }
    }
    const Curve& curve = *loops[arc.loop].curves[arc.curve];
    for (int s = 0; s <= 4 && !arc.closes_gap; ++s)
    {
      const double t = arc.range[0] + (arc.range[1] - arc.range[0]) * s / 4.0;
      const footpoint::Side side = s == 4 ? footpoint::Side::Left : footpoint::Side::Right;
      const int span = curve.knots().find_span(t, side);
      const RealPoint own = de_boor(curve, span, t);
      const RealPoint local{ { own[0] - surface.direction(0).origin,
        own[1] - surface.direction(1).origin } };
      // The range is cut to a rounding of the parameter, which a fast curve turns into more.
      EXPECT_LE(apart(on_arc(arc, s / Real(4)), local, 0), 20 * rounding[0]);
      EXPECT_LE(apart(on_arc(arc, s / Real(4)), local, 1), 20 * rounding[1]);
    }
  }
}

} // namespace trims
