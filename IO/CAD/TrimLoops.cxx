// SPDX-License-Identifier: BSD-3-Clause
#include "TrimLoops.h"

#include "CurveConversion.h"

#include <BRep_Tool.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom2d_BezierCurve.hxx>
#include <Geom2d_TrimmedCurve.hxx>
#include <ShapeFix_Edge.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Iterator.hxx>
#include <TopoDS_Wire.hxx>

#include <algorithm>
#include <cmath>

namespace footpoint::cad
{

namespace
{

/// Points a curve at which areas are summed up; 64 tell the sense of any real loop.
constexpr int kAreaSamples = 64;
/// Ends that are this near, as a fraction of the loop's extent, meet: then a loop is closed.
constexpr double kMeeting = 1e-6;

/// Ranges that leave their spline by rounding are moved back into it.
void clamp_range(TrimCurve& trim)
{
  const Handle(Geom2d_Curve)& curve = trim.curve;
  if (!curve->IsPeriodic())
  {
    trim.first = std::max(trim.first, curve->FirstParameter());
    trim.last = std::min(trim.last, curve->LastParameter());
  }
}

TrimCurve trim_curve(const TopoDS_Edge& edge, const TopoDS_Face& face)
{
  TrimCurve trim;
  trim.curve = BRep_Tool::CurveOnSurface(edge, face, trim.first, trim.last);
  if (trim.curve.IsNull())
  {
    // Files need not have it; Open CASCADE projects the edge.
    ShapeFix_Edge().FixAddPCurve(edge, face, BRep_Tool::IsClosed(edge, face));
    trim.curve = BRep_Tool::CurveOnSurface(edge, face, trim.first, trim.last);
  }
  if (trim.curve.IsNull())
  {
    throw ConversionError("one of its edges has no curve on the surface, and none could be made");
  }
  clamp_range(trim);
  if (!(std::isfinite(trim.first) && std::isfinite(trim.last)) || trim.first >= trim.last ||
    trim.last - trim.first > 1e100)
  {
    throw ConversionError("the range [" + std::to_string(trim.first) + ", " +
      std::to_string(trim.last) + "] of one of its edges is no interval");
  }
  trim.reversed = edge.Orientation() == TopAbs_REVERSED;
  for (const gp_Pnt2d& end : { trim.start(), trim.end() })
  {
    if (!(std::isfinite(end.X()) && std::isfinite(end.Y())))
    {
      throw ConversionError("one of its edges has an end that is no point");
    }
  }
  return trim;
}

/// Samples of an edge at which its trim curve is compared with it.
constexpr int kEdgeSamples = 23;

/// Gives a trim curve the edge that it is farther from than the edge's tolerance, if the edge lies
/// on the surface any better than the curve.
void find_missed_edge(TrimCurve& trim, const TopoDS_Edge& edge,
  const TopLoc_Location& face_location, const Handle(Geom_Surface) & surface)
{
  TopLoc_Location location;
  EdgeOnSurface on;
  const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, location, on.first, on.last);
  if (curve.IsNull() || !(on.first < on.last) || on.last - on.first > 1e100)
  {
    return;
  }
  const TopLoc_Location relative = face_location.Inverted() * location;
  on.curve = relative.IsIdentity()
    ? curve
    : Handle(Geom_Curve)::DownCast(curve->Transformed(relative.Transformation()));
  on.surface = surface;
  double curve_miss = 0.0;
  double foot_miss = 0.0;
  for (int i = 0; i <= kEdgeSamples; ++i)
  {
    const double fraction = static_cast<double>(i) / kEdgeSamples;
    const gp_Pnt2d point = trim.curve->Value(trim.first + (trim.last - trim.first) * fraction);
    const gp_Pnt target = on.at(fraction);
    const double miss = surface->Value(point.X(), point.Y()).Distance(target);
    curve_miss = std::max(curve_miss, miss);
    if (miss > BRep_Tool::Tolerance(edge))
    {
      const gp_Pnt2d foot = on.foot(fraction, point);
      foot_miss = std::max(foot_miss, surface->Value(foot.X(), foot.Y()).Distance(target));
    }
  }
  if (curve_miss <= BRep_Tool::Tolerance(edge))
  {
    return;
  }
  trim.deviation = curve_miss;
  if (foot_miss < 0.5 * curve_miss)
  {
    trim.deviation = foot_miss;
    trim.missed = std::make_shared<EdgeOnSurface>(on);
  }
}

double extent_of(const TrimChain& curves)
{
  gp_Pnt2d lower(1e300, 1e300);
  gp_Pnt2d upper(-1e300, -1e300);
  for (const TrimCurve& curve : curves)
  {
    for (const gp_Pnt2d& end :
      { curve.start(), curve.at(0.5 * (curve.first + curve.last)), curve.end() })
    {
      lower.SetCoord(std::min(lower.X(), end.X()), std::min(lower.Y(), end.Y()));
      upper.SetCoord(std::max(upper.X(), end.X()), std::max(upper.Y(), end.Y()));
    }
  }
  return lower.Distance(upper);
}

/// Sorts curves head to tail: of those that are left, always the one that starts nearest to where
/// the chain ends. A chain that is closed is a loop.
std::vector<TrimChain> chain(TrimChain curves)
{
  std::vector<TrimChain> loops;
  const double near = kMeeting * extent_of(curves);
  while (!curves.empty())
  {
    TrimChain loop{ curves.front() };
    curves.erase(curves.begin());
    while (!curves.empty())
    {
      const gp_Pnt2d end = loop.back().end();
      const auto next = std::min_element(curves.begin(), curves.end(),
        [&](const TrimCurve& a, const TrimCurve& b)
        { return a.start().SquareDistance(end) < b.start().SquareDistance(end); });
      const double to_next = next->start().Distance(end);
      const double to_start = loop.front().start().Distance(end);
      if (to_start <= near && to_next > near)
      {
        break;
      }
      loop.push_back(*next);
      curves.erase(next);
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

/// The middle of a loop's extent along one direction.
double middle(const TrimChain& loop, std::size_t direction)
{
  double low = 1e300;
  double high = -1e300;
  for (const TrimCurve& curve : loop)
  {
    const auto box = extent(curve);
    low = std::min(low, box[0][direction]);
    high = std::max(high, box[1][direction]);
  }
  return 0.5 * (low + high);
}

void shift_into_one_period(std::vector<TrimChain>& loops, std::size_t direction, double period)
{
  const auto largest = std::max_element(loops.begin(), loops.end(),
    [](const TrimChain& a, const TrimChain& b)
    { return std::abs(signed_area(a)) < std::abs(signed_area(b)); });
  const double centre = middle(*largest, direction);
  for (TrimChain& loop : loops)
  {
    const double turns = std::round((centre - middle(loop, direction)) / period);
    for (TrimCurve& curve : loop)
    {
      curve.shift.SetCoord(static_cast<int>(direction) + 1,
        curve.shift.Coord(static_cast<int>(direction) + 1) + turns * period);
    }
  }
}

} // namespace

std::vector<TrimChain> trim_loops(const TopoDS_Face& face, const Handle(Geom_Surface) & surface)
{
  const TopoDS_Face forward = TopoDS::Face(face.Oriented(TopAbs_FORWARD));
  TopLoc_Location location;
  BRep_Tool::Surface(face, location);
  std::vector<TrimChain> loops;
  for (TopoDS_Iterator wires(forward); wires.More(); wires.Next())
  {
    if (wires.Value().ShapeType() != TopAbs_WIRE)
    {
      continue; // a vertex inside the face
    }
    TrimChain curves;
    for (TopoDS_Iterator edges(wires.Value()); edges.More(); edges.Next())
    {
      const TopoDS_Edge edge = TopoDS::Edge(edges.Value());
      if (edge.Orientation() == TopAbs_FORWARD || edge.Orientation() == TopAbs_REVERSED)
      {
        curves.push_back(trim_curve(edge, forward));
        find_missed_edge(curves.back(), edge, location, surface);
      }
    }
    for (TrimChain& loop : chain(std::move(curves)))
    {
      loops.push_back(std::move(loop));
    }
  }
  if (!loops.empty() && surface->IsUPeriodic())
  {
    shift_into_one_period(loops, 0, surface->UPeriod());
  }
  if (!loops.empty() && surface->IsVPeriodic())
  {
    shift_into_one_period(loops, 1, surface->VPeriod());
  }
  return loops;
}

double signed_area(const TrimChain& loop)
{
  double twice = 0.0;
  const gp_Pnt2d origin = loop.front().start();
  gp_Pnt2d before = origin;
  const auto step = [&](const gp_Pnt2d& to)
  {
    twice += (before.X() - origin.X()) * (to.Y() - origin.Y()) -
      (to.X() - origin.X()) * (before.Y() - origin.Y());
    before = to;
  };
  for (const TrimCurve& curve : loop)
  {
    for (int i = 0; i <= kAreaSamples; ++i)
    {
      const double fraction = static_cast<double>(i) / kAreaSamples;
      step(curve.at(curve.reversed ? curve.last - (curve.last - curve.first) * fraction
                                   : curve.first + (curve.last - curve.first) * fraction));
    }
  }
  return 0.5 * twice;
}

} // namespace footpoint::cad
