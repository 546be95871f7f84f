// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/trims/trim_plane.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace footpoint
{

TrimPlane::TrimPlane(const ParametricSurface& surface)
{
  for (int i = 0; i < 2; ++i)
  {
    const Direction& direction = surface.direction(i);
    Axis& axis = this->Axes[i];
    axis.origin = direction.origin;
    axis.length = direction.length;
    axis.closed = direction.closed;
    axis.rounding = kParameterRoundings * std::numeric_limits<double>::epsilon() *
      (std::abs(direction.origin) + direction.length);
    axis.lines = direction.spans;
  }
}

double TrimPlane::snapped(int i, double at) const
{
  const Axis& axis = this->Axes[i];
  if (!axis.closed)
  {
    const double border = this->border_rounding(i);
    if (at < 0.0 && at >= -border)
    {
      return 0.0;
    }
    if (at > axis.length && at <= axis.length + border)
    {
      return axis.length;
    }
  }
  const double period = axis.closed ? std::floor(at / axis.length) * axis.length : 0.0;
  const double inside = at - period;
  const auto above = std::lower_bound(axis.lines.begin(), axis.lines.end(), inside);
  double nearest = std::numeric_limits<double>::infinity();
  if (above != axis.lines.end())
  {
    nearest = *above;
  }
  if (above != axis.lines.begin() && inside - *(above - 1) < nearest - inside)
  {
    nearest = *(above - 1);
  }
  // The end of a period is the start of the next one: the same number for both.
  return std::abs(nearest - inside) > axis.rounding ? at
    : axis.closed && nearest == axis.length ? (std::floor(at / axis.length) + 1.0) * axis.length
                                            : period + nearest;
}

double TrimPlane::border_rounding(int i) const
{
  return std::max(this->Axes[i].rounding, kBorderRounding * this->Axes[i].length);
}

double TrimPlane::border_near(int i, double at) const
{
  const Axis& axis = this->Axes[i];
  const double nearest = std::round(at / axis.length);
  const double border =
    (axis.closed ? nearest : std::clamp(nearest, 0.0, 1.0)) * axis.length;
  return std::abs(at - border) <= this->border_rounding(i)
    ? border
    : std::numeric_limits<double>::quiet_NaN();
}

std::vector<double> TrimPlane::lines_between(int i, double low, double high) const
{
  const Axis& axis = this->Axes[i];
  std::vector<double> found;
  const double first = axis.closed ? std::floor(low / axis.length) : 0.0;
  const double last = axis.closed ? std::floor(high / axis.length) : 0.0;
  for (double k = first; k <= last; k += 1.0)
  {
    const double period = k * axis.length;
    auto line = std::lower_bound(axis.lines.begin(), axis.lines.end(), low - period);
    for (; line != axis.lines.end() && period + *line < high; ++line)
    {
      const bool repeated = axis.closed && line + 1 == axis.lines.end() && k < last;
      if (period + *line > low && !repeated)
      {
        found.push_back(period + *line);
      }
    }
  }
  return found;
}

} // namespace footpoint
