// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/trims/edge_curve.h"

#include "footpoint/splines/validation.h"
#include "footpoint/trims/trim_plane.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace footpoint
{
namespace
{

/// Points of each arc whose box gives the size of the edge, where it is no point by them.
constexpr int kSizeSamples = 4;

/// As many points of an arc as it could return to the first of them and not be one point. A
/// rational piece could at a few more.
int closest_samples(const Surface& surface, const TrimArc& arc)
{
  return 2 * (surface.knots(0).degree() + surface.knots(1).degree()) *
    static_cast<int>(arc.control.cols());
}

/// One-sided derivatives at a joint of arcs that differ by this part of their length are a kink.
/// What is left below turns a tangent by no more than closure may move a point.
constexpr double kKink = kClosureTolerance;

/// An edge inside the domain whose points are no farther apart than this part of the surface's size
/// is one point: evaluation knows no better. What is larger bounds the face, however small it is:
/// the foot on the untrimmed surface may lie within a hole of any size.
constexpr double kPointInside = 8.0 * 0x1p-52;

/// An arc this short, as a part of the domain in each direction, has no length but rounding.
constexpr double kNoLength = 4.0 * 0x1p-52;

double length_of(const TrimArc& arc)
{
  const double length = arc.range[1] - arc.range[0];
  return length > 0.0 ? length : 1.0;
}

/// d³/dh³ of S(t + h·along) at h = 0 on the piece of a cell, which Jet<2> does not hold.
Vector3 third_along(const Surface& surface, const std::array<int, 2>& span, const Parameter<2>& t,
  const Parameter<2>& along)
{
  constexpr int kOrder = 3;
  double basis[2][(kOrder + 1) * (kMaximumDegree + 1)];
  std::array<int, 2> count;
  for (int i = 0; i < 2; ++i)
  {
    surface.knots(i).basis(span[i], t[i], kOrder, basis[i]);
    count[i] = surface.knots(i).degree() + 1;
  }
  // Derivatives of (w·S, w) along the line: Σ binomial(k, a) u'^a v'^(k−a) ∂^k / ∂u^a ∂v^(k−a).
  constexpr double kBinomial[4][4] = { { 1, 0, 0, 0 }, { 1, 1, 0, 0 }, { 1, 2, 1, 0 },
    { 1, 3, 3, 1 } };
  const Eigen::Index nu = surface.knots(0).number_of_control_points();
  Eigen::Vector4d sums[kOrder + 1];
  std::fill_n(sums, kOrder + 1, Eigen::Vector4d(Eigen::Vector4d::Zero()));
  for (int j = 0; j < count[1]; ++j)
  {
    for (int i = 0; i < count[0]; ++i)
    {
      const Eigen::Index at = (span[1] - count[1] + 1 + j) * nu + span[0] - count[0] + 1 + i;
      const double weight = surface.rational() ? surface.weights()[at] : 1.0;
      Eigen::Vector4d point;
      point << weight * surface.local_control_points().col(at), weight;
      for (int k = 0; k <= kOrder; ++k)
      {
        for (int a = 0; a <= k; ++a)
        {
          sums[k] += kBinomial[k][a] * std::pow(along[0], a) * std::pow(along[1], k - a) *
            basis[0][a * count[0] + i] * basis[1][(k - a) * count[1] + j] * point;
        }
      }
    }
  }
  Vector3 derivatives[kOrder + 1];
  for (int k = 0; k <= kOrder; ++k)
  {
    derivatives[k] = sums[k].head<3>();
    for (int i = 1; i <= k; ++i)
    {
      derivatives[k] -= kBinomial[k][i] * sums[i][3] * derivatives[k - i];
    }
    derivatives[k] /= sums[0][3];
  }
  return derivatives[kOrder];
}

/// The second derivative of a surface for two directions.
Vector3 second_along(const Jet<2>& jet, const Parameter<2>& a, const Parameter<2>& b)
{
  return a[0] * b[0] * jet.second.col(0) + (a[0] * b[1] + a[1] * b[0]) * jet.second.col(1) +
    a[1] * b[1] * jet.second.col(2);
}

bool has_length(const Surface& surface, const TrimArc& arc)
{
  for (int i = 0; i < 2; ++i)
  {
    const auto coordinates = arc.control.row(i).array() / arc.control.row(2).array();
    const double extent = coordinates.maxCoeff() - coordinates.minCoeff();
    if (extent > kNoLength * surface.direction(i).length)
    {
      return true;
    }
  }
  return false;
}

/// Whether all of the run is one point in space. \param tolerance model units
bool is_point(const Surface& surface, const std::vector<TrimArc>& arcs, double tolerance)
{
  Vector3 first;
  for (std::size_t k = 0; k < arcs.size(); ++k)
  {
    const ArcCell cell = arc_cell(surface, arcs[k]);
    const int samples = closest_samples(surface, arcs[k]);
    for (int i = 0; i <= samples; ++i)
    {
      const Parameter<2> t = arc_jet(arcs[k], static_cast<double>(i) / samples, 0).col(0);
      const CellPlace place = place_in(cell, t);
      const Vector3 point = surface.jet(place.t, place.sides, 0).point;
      first = k == 0 && i == 0 ? point : first;
      if ((point - first).norm() > tolerance)
      {
        return false;
      }
    }
  }
  return true;
}

/// At how many places of an arc along a seam the other side is looked at, and how far from it.
constexpr int kSeamPlaces = 8;
constexpr double kBesideSeam = 1e-9;

/// Of w·u against w times the border, relatively.
constexpr double kProductRounding = 0x1p-51;

/// The direction and the end of it along whose border of the domain an arc runs; −1: along none.
struct DomainBorder
{
  int direction;
  int end;
};

DomainBorder border_of(const Surface& surface, const TrimArc& arc)
{
  for (int i = 0; i < 2; ++i)
  {
    const double length = surface.direction(i).length;
    for (int end = 0; end < 2; ++end)
    {
      const double border = end == 0 ? 0.0 : length;
      const auto off = arc.control.row(i).array() - border * arc.control.row(2).array();
      // Arcs near a border were moved onto it; products with weights may round.
      if ((off.abs() <= kProductRounding * length * arc.control.row(2).array()).all())
      {
        return { i, end };
      }
    }
  }
  return { -1, 0 };
}

/// Whether the region goes on beyond an arc along one end of a closed direction, at the other end.
bool goes_on(const Surface& surface, const TrimRegion& region, const TrimArc& arc, DomainBorder at)
{
  const double length = surface.direction(at.direction).length;
  for (int k = 0; k < kSeamPlaces; ++k)
  {
    Parameter<2> place = arc_jet(arc, (k + 0.5) / kSeamPlaces, 0).col(0);
    place(at.direction) = at.end == 0 ? (1.0 - kBesideSeam) * length : kBesideSeam * length;
    if (!region.contains(place(0), place(1)))
    {
      return false;
    }
  }
  return true;
}

bool is_wanted(
  const Surface& surface, const TrimRegion& region, const TrimArc& arc, EdgeArcs which)
{
  const DomainBorder border = border_of(surface, arc);
  if (border.direction < 0)
  {
    return true;
  }
  return surface.direction(border.direction).closed ? !goes_on(surface, region, arc, border)
                                                    : which == EdgeArcs::NoSeams;
}

} // namespace

EdgeCurve::EdgeCurve(std::shared_ptr<const Surface> surface, std::vector<TrimArc> arcs)
  : Base(std::move(surface))
  , Arcs(std::move(arcs))
{
  if (this->Arcs.empty())
  {
    throw GeometryError(GeometryDefect::Format, "an edge of a trimmed face has no arcs");
  }
  Direction& direction = this->Directions[0];
  direction.spans = { 0.0 };
  for (TrimArc& arc : this->Arcs)
  {
    this->Cells.push_back(arc_cell(*this->Base, arc));
    keep_inside(this->Cells.back(), arc);
    // Also an arc that is shorter than the rounding of t has a span of its own.
    const double start = direction.spans.back();
    const double next = std::nextafter(start, std::numeric_limits<double>::infinity());
    direction.spans.push_back(std::max(start + length_of(arc), next));
  }
  direction.length = direction.spans.back();
  direction.breaks = { { 0.0, false }, { direction.length, false } };
  this->measure();
  this->analyse();
}

Points EdgeCurve::sampled(int of_arc) const
{
  const std::vector<double>& spans = this->Directions[0].spans;
  Points samples(3, static_cast<Eigen::Index>(this->Arcs.size()) * of_arc + 1);
  for (Eigen::Index i = 0; i < samples.cols(); ++i)
  {
    const std::size_t arc = std::min<std::size_t>(i / of_arc, this->Arcs.size() - 1);
    const double fraction = (static_cast<double>(i) - static_cast<double>(arc * of_arc)) / of_arc;
    const double t = spans[arc] + fraction * (spans[arc + 1] - spans[arc]);
    samples.col(i) = this->jet(Parameter<1>(t), Sides<1>(Side::Right), 0).point;
  }
  return samples;
}

void EdgeCurve::measure()
{
  Direction& direction = this->Directions[0];
  const std::vector<double>& spans = direction.spans;
  this->recentre(this->sampled(kSizeSamples));
  if (this->Size <= kClosureTolerance * this->Base->size())
  {
    int samples = kSizeSamples;
    for (const TrimArc& arc : this->Arcs)
    {
      samples = std::max(samples, closest_samples(*this->Base, arc));
    }
    this->recentre(this->sampled(samples));
  }
  this->Centre = this->Base->centre(); // so that positions are the surface's, without a rounding
  if (!(this->Size > 0.0))
  {
    throw GeometryError(GeometryDefect::Format,
      "an edge of a trimmed face, of loop " + std::to_string(this->Arcs.front().loop) +
        ", is a single point");
  }

  for (std::size_t k = 1; k + 1 < spans.size(); ++k)
  {
    const Jet<1> before = this->jet(Parameter<1>(spans[k]), Sides<1>(Side::Left), 1);
    const Jet<1> after = this->jet(Parameter<1>(spans[k]), Sides<1>(Side::Right), 1);
    const bool gap = (after.point - before.point).norm() > kClosureTolerance * this->Size;
    const double speed = std::max(before.first.norm(), after.first.norm());
    if (gap || (after.first - before.first).norm() > kKink * speed)
    {
      direction.breaks.insert(direction.breaks.end() - 1, { spans[k], gap });
    }
  }
}

std::size_t EdgeCurve::arc_at(double t, Side side) const
{
  const std::vector<double>& spans = this->Directions[0].spans;
  const auto above = side == Side::Right ? std::upper_bound(spans.begin(), spans.end(), t)
                                         : std::lower_bound(spans.begin(), spans.end(), t);
  const auto arc = std::max<std::ptrdiff_t>(above - spans.begin() - 1, 0);
  return std::min(static_cast<std::size_t>(arc), this->Arcs.size() - 1);
}

double EdgeCurve::fraction(double t, std::size_t arc) const
{
  const double start = this->Directions[0].spans[arc];
  const double end = this->Directions[0].spans[arc + 1];
  return std::clamp((t - start) / (end - start), 0.0, 1.0);
}

Jet<1> EdgeCurve::jet(const Parameter<1>& t, const Sides<1>& sides, int order) const
{
  order = std::clamp(order, 0, 3);
  const std::size_t arc = this->arc_at(t[0], sides[0]);
  const ArcCell& cell = this->Cells[arc];
  const double length = this->Directions[0].spans[arc + 1] - this->Directions[0].spans[arc];
  Eigen::Matrix<double, 2, 4> c = arc_jet(this->Arcs[arc], this->fraction(t[0], arc), order);
  for (int k = 1; k <= order; ++k)
  {
    c.rightCols(4 - k) /= length;
  }

  // The arc is on one side of all knot lines, its rounding must not be on the other.
  const CellPlace place = place_in(cell, c.col(0));
  const Jet<2> surface = this->Base->jet(place.t, place.sides, std::min(order, 2));

  // === Chain rule
  Jet<1> jet;
  jet.point = surface.point;
  if (order >= 1)
  {
    jet.first = surface.first * c.col(1);
  }
  if (order >= 2)
  {
    jet.second = surface.first * c.col(2) + second_along(surface, c.col(1), c.col(1));
  }
  if (order >= 3)
  {
    jet.third = surface.first * c.col(3) + 3.0 * second_along(surface, c.col(1), c.col(2)) +
      third_along(*this->Base, cell.span, place.t, c.col(1));
  }
  return jet;
}

Parameter<2> EdgeCurve::surface_parameter(double t, Side side) const
{
  const std::size_t arc = this->arc_at(t, side);
  const Parameter<2> place = arc_jet(this->Arcs[arc], this->fraction(t, arc), 0).col(0);
  return place_in(this->Cells[arc], place).t;
}

std::vector<std::shared_ptr<const EdgeCurve>> edge_curves(
  const std::shared_ptr<const Surface>& surface, const TrimRegion& region, EdgeArcs which)
{
  std::vector<std::shared_ptr<const EdgeCurve>> edges;
  std::vector<TrimArc> run;
  const double one_point =
    (which == EdgeArcs::InsideDomain ? kPointInside : kClosureTolerance) * surface->size();
  const auto finish = [&]()
  {
    if (!run.empty() && !is_point(*surface, run, one_point))
    {
      edges.push_back(std::make_shared<EdgeCurve>(surface, std::move(run)));
    }
    run.clear();
  };
  for (const TrimArc& arc : region.arcs())
  {
    const bool continues = !run.empty() && arc.loop == run.back().loop &&
      arc.curve == run.back().curve && arc.closes_gap == run.back().closes_gap &&
      arc.bounds == run.back().bounds;
    const bool wanted = arc.inside_domain && is_edge(arc.bounds) &&
      is_wanted(*surface, region, arc, which);
    if (!wanted || !continues)
    {
      finish();
    }
    if (wanted && has_length(*surface, arc))
    {
      run.push_back(arc);
    }
  }
  finish();
  return edges;
}

} // namespace footpoint
