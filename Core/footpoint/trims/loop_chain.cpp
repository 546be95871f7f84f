// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/trims/loop_chain.h"

#include "footpoint/common/errors.h"
#include "footpoint/splines/bezier.h"
#include "footpoint/splines/validation.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace footpoint
{

namespace
{

using Point2 = Eigen::Vector2d;

/// A curve is planar where |z| is at most this fraction of the domain's longer side: its z is not
/// used, and files keep zeros.
constexpr double kPlanar = 1e-9;

/// Points of a straight arc across a gap at which its length in space is looked at, as a gap may
/// end where it began in space without running along one point.
constexpr int kGapSamples = 4;

std::string curve_name(int loop, int curve)
{
  return "curve " + std::to_string(curve) + " of trim loop " + std::to_string(loop);
}

std::string to_text(const TrimPlane& plane, const Point2& local)
{
  return "(" + footpoint::to_text(plane.origin(0) + local[0]) + ", " +
    footpoint::to_text(plane.origin(1) + local[1]) + ")";
}

void check_planar(const Curve& curve, const TrimPlane& plane, const std::string& name)
{
  const double limit = kPlanar * std::max(plane.length(0), plane.length(1));
  const Points& points = curve.local_control_points();
  for (Eigen::Index i = 0; i < points.cols(); ++i)
  {
    const double z = points(2, i) + curve.centre()[2];
    if (std::abs(z) > limit)
    {
      throw GeometryError(GeometryDefect::Format,
        "control point " + std::to_string(i) + " of " + name + " has z = " + footpoint::to_text(z) +
          "; trim curves lie in the plane of (u, v), where z is 0");
    }
  }
}

/// Whether all of an arc lies on a border of the domain (NaN: on none) up to the rounding of files.
/// The strip between the two would be neither kept nor told from the border.
bool is_along(const ChainArc& arc, int i, double border, const TrimPlane& plane)
{
  const auto x = arc.arc.control.row(i).array() / arc.arc.control.row(2).array();
  return !std::isnan(border) && ((x - border).abs() <= plane.border_rounding(i)).all();
}

/// The Bézier arcs of a curve in the local parameters of the surface.
void append_arcs(
  const Curve& curve, int loop, int number, const TrimPlane& plane, std::vector<ChainArc>& arcs)
{
  const std::vector<BezierPiece<1>> pieces = extract_bezier(curve);
  for (std::size_t k = 0; k < pieces.size(); ++k)
  {
    const auto& control = pieces[k].control;
    ChainArc arc;
    arc.arc.control.resize(3, control.cols());
    // Sums of the basis functions are 1 up to rounding, and a polynomial has weights 1.
    const Eigen::RowVectorXd weights =
      curve.rational() ? control.row(3).eval() : Eigen::RowVectorXd::Ones(control.cols()).eval();
    arc.arc.control.row(2) = weights;
    for (int i = 0; i < 2; ++i)
    {
      arc.arc.control.row(i) = control.row(i) + (curve.centre()[i] - plane.origin(i)) * weights;
    }
    arc.arc.loop = loop;
    arc.arc.curve = number;
    arc.arc.closes_gap = false;
    arc.arc.range = { { pieces[k].lower[0], pieces[k].upper[0] } };
    arc.arc.vertex = { { k == 0, k + 1 == pieces.size() } };
    arc.arc.inside_domain = true;
    const Eigen::Index last = control.cols() - 1;
    arc.end = { { arc.arc.control.col(0).head<2>() / weights[0],
      arc.arc.control.col(last).head<2>() / weights[last] } };
    for (int i = 0; i < 2; ++i)
    {
      const double border = plane.border_near(i, arc.end[0][i]);
      if (is_constant(arc, i, plane.rounding(i)))
      {
        make_constant(arc, i, plane.snapped(i, arc.end[0][i]));
      }
      else if (is_along(arc, i, border, plane))
      {
        make_constant(arc, i, border);
      }
    }
    arcs.push_back(std::move(arc));
  }
}

/// The point in space of local parameters that may lie outside the domain.
Vector3 point_in_space(const Surface& surface, const TrimPlane& plane, Point2 at)
{
  for (int i = 0; i < 2; ++i)
  {
    if (plane.closed(i) && !plane.inside(i, at[i]))
    {
      at[i] -= std::floor(at[i] / plane.length(i)) * plane.length(i);
    }
    at[i] = std::clamp(at[i], 0.0, plane.length(i));
  }
  return surface.point(at);
}

/// How far the straight line between two points leads away from its start in space.
double gap_in_space(
  const Surface& surface, const TrimPlane& plane, const Point2& from, const Point2& to)
{
  const Vector3 start = point_in_space(surface, plane, from);
  double largest = 0.0;
  for (int k = 1; k <= kGapSamples; ++k)
  {
    const Point2 at = from + (to - from) * (static_cast<double>(k) / kGapSamples);
    largest = std::max(largest, (point_in_space(surface, plane, at) - start).norm());
  }
  return largest;
}

/// The periods between two coordinates, rounded.
int periods(const TrimPlane& plane, int i, double distance)
{
  return plane.closed(i) ? static_cast<int>(std::lround(distance / plane.length(i))) : 0;
}

bool meet(const TrimPlane& plane, const Point2& a, const Point2& b)
{
  return std::abs(a[0] - b[0]) <= plane.rounding(0) && std::abs(a[1] - b[1]) <= plane.rounding(1);
}

/// Puts one curve after the other: shifts them by whole periods and closes gaps.
class ChainBuilder
{
public:
  ChainBuilder(const Surface& surface, const TrimPlane& plane, double tolerance)
    : Surface_(surface)
    , Plane(plane)
    , Tolerance(tolerance)
  {
  }

  void add(ChainArc arc)
  {
    if (!this->Chain.arcs.empty())
    {
      for (int i = 0; i < 2; ++i)
      {
        const double from = this->Chain.arcs.back().end[1][i];
        shift(arc, i, this->Plane.length(i) * periods(this->Plane, i, from - arc.end[0][i]));
      }
      this->close_gap(arc.end[0]);
    }
    this->Chain.arcs.push_back(std::move(arc));
  }

  LoopChain finish()
  {
    Point2 start = this->Chain.arcs.front().end[0];
    for (int i = 0; i < 2; ++i)
    {
      this->Chain.turns[i] = periods(this->Plane, i, this->Chain.arcs.back().end[1][i] - start[i]);
      start[i] += this->Chain.turns[i] * this->Plane.length(i);
    }
    this->close_gap(start);
    return std::move(this->Chain);
  }

private:
  void close_gap(const Point2& to)
  {
    const ChainArc& last = this->Chain.arcs.back();
    const Point2 from = last.end[1];
    if (meet(this->Plane, from, to))
    {
      return;
    }
    const double gap = gap_in_space(this->Surface_, this->Plane, from, to);
    if (!(gap <= this->Tolerance))
    {
      throw GeometryError(GeometryDefect::Format,
        "after " + curve_name(last.arc.loop, last.arc.curve) + " the loop has a gap of " +
          footpoint::to_text(gap) + " model units, from " + to_text(this->Plane, from) + " to " +
          to_text(this->Plane, to) + "; at most " + footpoint::to_text(this->Tolerance) +
          " are closed");
    }
    this->Chain.largest_gap = std::max(this->Chain.largest_gap, gap);
    ChainArc bridge = straight_arc(from, to);
    bridge.arc.loop = last.arc.loop;
    bridge.arc.curve = last.arc.curve;
    bridge.arc.closes_gap = true;
    bridge.arc.range = { { last.arc.range[1], last.arc.range[1] } };
    for (int i = 0; i < 2; ++i)
    {
      if (is_constant(bridge, i, this->Plane.rounding(i)))
      {
        make_constant(bridge, i, from[i]);
      }
    }
    this->Chain.arcs.push_back(std::move(bridge));
  }

  const Surface& Surface_;
  const TrimPlane& Plane;
  double Tolerance;
  LoopChain Chain{ {}, { { 0, 0 } }, 0.0 };
};

/// Gives the ends that meet the same coordinate i, on the border or knot line where they lie on
/// one. Arcs along which the coordinate is constant keep it so: what is moved at one end moves at
/// the other.
void weld(LoopChain& chain, int i, const TrimPlane& plane)
{
  std::vector<ChainArc>& arcs = chain.arcs;
  const std::size_t count = arcs.size();
  const double turn = chain.turns[i] * plane.length(i);
  std::vector<char> constant(count);
  for (std::size_t k = 0; k < count; ++k)
  {
    constant[k] = is_constant(arcs[k], i, plane.rounding(i));
  }
  std::vector<double> start(count);
  for (std::size_t k = 0; k < count; ++k)
  {
    const std::size_t previous = (k + count - 1) % count;
    const double border = plane.border_near(i, arcs[k].end[0][i]);
    start[k] = constant[k] && !std::isnan(border)
      ? border
      : plane.snapped(i, arcs[previous].end[1][i]) - (k == 0 ? turn : 0.0);
  }
  std::size_t first = 0; // the first arc after one along which the coordinate changes
  while (first + 1 < count && constant[(first + count - 1) % count])
  {
    ++first;
  }
  for (std::size_t step = 0; step + 1 < count; ++step)
  {
    const std::size_t k = (first + step) % count;
    const std::size_t next = (k + 1) % count;
    if (constant[k])
    {
      start[next] = start[k] - (next == 0 ? turn : 0.0);
    }
  }
  for (std::size_t k = 0; k < count; ++k)
  {
    const double end = k + 1 < count ? start[k + 1] : start[0] + turn;
    if (constant[k])
    {
      make_constant(arcs[k], i, start[k]);
    }
    else
    {
      place_end(arcs[k], 0, i, start[k]);
      place_end(arcs[k], 1, i, end);
    }
  }
}

/// Monotone parts of all arcs between knot lines; those without length are left out.
std::vector<ChainArc> cut_arcs(const std::vector<ChainArc>& arcs, const TrimPlane& plane)
{
  std::vector<ChainArc> parts;
  bool starts_curve = false;
  for (const ChainArc& whole : arcs)
  {
    for (const ChainArc& monotone : cut_to_monotone(whole, plane))
    {
      for (ChainArc& part : cut_at_lines(monotone, plane))
      {
        if (part.end[0] == part.end[1])
        {
          // What stands at its ends stands at those of its neighbours of the same curve.
          if (part.arc.vertex[1] && !parts.empty() && parts.back().arc.curve == part.arc.curve)
          {
            parts.back().arc.vertex[1] = true;
          }
          starts_curve = starts_curve || part.arc.vertex[0];
          continue;
        }
        for (int i = 0; i < 2; ++i)
        {
          if (part.end[0][i] == part.end[1][i])
          {
            make_constant(part, i, part.end[0][i]);
          }
        }
        part.arc.vertex[0] = part.arc.vertex[0] || starts_curve;
        starts_curve = false;
        parts.push_back(std::move(part));
      }
    }
  }
  return parts;
}

} // namespace

LoopChain make_chain(const TrimLoop& loop, int number, const Surface& surface,
  const TrimPlane& plane, double tolerance)
{
  if (loop.curves.empty())
  {
    throw GeometryError(
      GeometryDefect::Format, "trim loop " + std::to_string(number) + " has no curves");
  }
  ChainBuilder builder(surface, plane, tolerance);
  std::vector<ChainArc> arcs;
  for (std::size_t k = 0; k < loop.curves.size(); ++k)
  {
    const int curve = static_cast<int>(k);
    if (!loop.curves[k])
    {
      throw GeometryError(GeometryDefect::Format, curve_name(number, curve) + " is missing");
    }
    check_planar(*loop.curves[k], plane, curve_name(number, curve));
    arcs.clear();
    append_arcs(*loop.curves[k], number, curve, plane, arcs);
    for (ChainArc& arc : arcs)
    {
      builder.add(std::move(arc));
    }
  }
  LoopChain chain = builder.finish();
  for (int i = 0; i < 2; ++i)
  {
    weld(chain, i, plane);
  }
  chain.arcs = cut_arcs(chain.arcs, plane);
  return chain;
}

} // namespace footpoint
