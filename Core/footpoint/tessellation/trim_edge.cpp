// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/tessellation/trim_edge.h"

#include "footpoint/model/evaluation.h"

#include <algorithm>
#include <cmath>

namespace footpoint
{
namespace
{

/// Points of an arc from which the nearest one to another point is looked for.
constexpr int kSamples = 8;

/// Steps to the nearest point; fewer do where it lies on the edge.
constexpr int kSteps = 30;

/// Places of a chord whose normals are compared.
constexpr int kNormals = 5;

/// Of the tolerance, what chords may use.
constexpr double kShareOfChords = 0.25;

/// A joint of arcs this near to a knot line, as a part of the domain, lies on it.
constexpr double kJointRounding = 1e-14;

/// A place this near to a joint, in arcs, is the joint.
constexpr double kAtJoint = 1e-9;

/// Halving ends here: at the rounding of parameters.
constexpr int kDeepest = 50;
constexpr int kFewParts = 4;

/// The part of an arc between two fractions (two cuts by P. de Casteljau 1959).
Eigen::Matrix<double, 3, Eigen::Dynamic> part_of(const TrimArc& arc, double from, double to)
{
  Eigen::Matrix<double, 3, Eigen::Dynamic> control = arc.control;
  const Eigen::Index degree = control.cols() - 1;
  if (to < 1.0)
  {
    for (Eigen::Index level = 1; level <= degree; ++level)
    {
      for (Eigen::Index j = degree; j >= level; --j)
      {
        control.col(j) = (1.0 - to) * control.col(j - 1) + to * control.col(j);
      }
    }
  }
  if (from > 0.0)
  {
    const double f = std::min(from / to, 1.0);
    for (Eigen::Index level = 1; level <= degree; ++level)
    {
      for (Eigen::Index j = 0; j + level <= degree; ++j)
      {
        control.col(j) = (1.0 - f) * control.col(j) + f * control.col(j + 1);
      }
    }
  }
  return control;
}

} // namespace

TrimEdge::TrimEdge(const Surface& surface, std::vector<TrimArc> arcs)
  : Base(&surface)
  , Arcs(std::move(arcs))
{
  for (TrimArc& arc : this->Arcs)
  {
    this->Cells.push_back(arc_cell(surface, arc));
    keep_inside(this->Cells.back(), arc);
  }
  const int count = kSamples * static_cast<int>(this->Arcs.size());
  for (int i = 0; i <= count; ++i)
  {
    this->Samples.push_back(this->point(static_cast<double>(i) / kSamples));
    this->Box[0] = i == 0 ? this->Samples[0] : Vector3(this->Box[0].cwiseMin(this->Samples.back()));
    this->Box[1] = i == 0 ? this->Samples[0] : Vector3(this->Box[1].cwiseMax(this->Samples.back()));
  }
}

std::size_t TrimEdge::arc_at(double t) const
{
  return std::min(static_cast<std::size_t>(std::max(t, 0.0)), this->Arcs.size() - 1);
}

Parameter<2> TrimEdge::place(double t) const
{
  const std::size_t k = this->arc_at(t);
  const double fraction = t - static_cast<double>(k);
  if (fraction == 0.0 || fraction == 1.0)
  {
    // Ends were put on knot lines exactly; (w·u) / w need not be.
    const ArcCell& cell = this->Cells[k];
    const auto end =
      this->Arcs[k].control.col(fraction == 0.0 ? 0 : this->Arcs[k].control.cols() - 1);
    Parameter<2> at = end.head<2>() / end[2];
    for (int i = 0; i < 2; ++i)
    {
      const double rounding = kJointRounding * this->Base->direction(i).length;
      at[i] = at[i] <= cell.lower[i] + rounding ? cell.lower[i]
        : at[i] >= cell.upper[i] - rounding     ? cell.upper[i]
                                                : at[i];
    }
    return at;
  }
  return place_in(this->Cells[k], arc_jet(this->Arcs[k], fraction, 0).col(0)).t;
}

Vector3 TrimEdge::point(double t) const
{
  const CellPlace at = place_in(this->Cells[this->arc_at(t)], this->place(t));
  return this->Base->centre() + this->Base->jet(at.t, at.sides, 0).point;
}

Vector3 TrimEdge::normal(double t, Side side) const
{
  std::size_t k = this->arc_at(t);
  k -= side == Side::Left && k > 0 && static_cast<double>(k) == t ? 1 : 0;
  const CellPlace at = place_in(this->Cells[k], this->place(t));
  return unit_normal(*this->Base, at.t, at.sides);
}

double TrimEdge::nearest(const Vector3& point, double from, double to) const
{
  // === The nearest sample
  double best = from;
  double distance = (this->point(from) - point).squaredNorm();
  const auto consider = [&](double t, double squared)
  {
    if (squared < distance)
    {
      best = t;
      distance = squared;
    }
  };
  for (auto i = static_cast<std::size_t>(std::ceil(from * kSamples));
       i < this->Samples.size() && static_cast<double>(i) <= to * kSamples; ++i)
  {
    consider(static_cast<double>(i) / kSamples, (this->Samples[i] - point).squaredNorm());
  }
  consider(to, (this->point(to) - point).squaredNorm());

  // === Down from there, not beyond the samples beside it
  const double low = std::max(from, best - 1.0 / kSamples);
  const double high = std::min(to, best + 1.0 / kSamples);
  for (int step = 0; step < kSteps; ++step)
  {
    const std::size_t k = this->arc_at(best);
    const auto c = arc_jet(this->Arcs[k], best - static_cast<double>(k), 1);
    const CellPlace at = place_in(this->Cells[k], c.col(0));
    const Jet<2> jet = this->Base->jet(at.t, at.sides, 1);
    const Vector3 tangent = jet.first * c.col(1);
    const Vector3 error = this->Base->centre() + jet.point - point;
    const double squared = tangent.squaredNorm();
    double move = squared > 0.0 ? -error.dot(tangent) / squared : 0.0;
    double next = std::clamp(best + move, low, high);
    double there = (this->point(next) - point).squaredNorm();
    while (there > distance && std::abs(move) > 1e-16)
    {
      move *= 0.5;
      next = std::clamp(best + move, low, high);
      there = (this->point(next) - point).squaredNorm();
    }
    if (next == best || there > distance)
    {
      break;
    }
    best = next;
    distance = there;
  }
  const double joint = std::nearbyint(best);
  return std::abs(best - joint) <= kAtJoint && joint >= from && joint <= to ? joint : best;
}

bool TrimEdge::collapsed(double tolerance) const
{
  return (this->Box[1] - this->Box[0]).norm() <= tolerance;
}

std::vector<double> TrimEdge::kinks() const
{
  std::vector<double> result;
  for (std::size_t k = 1; k < this->Arcs.size(); ++k)
  {
    const Parameter<2> at = this->place(static_cast<double>(k));
    bool on_line = false;
    for (int i = 0; i < 2; ++i)
    {
      const std::vector<Break>& breaks = this->Base->direction(i).breaks;
      for (std::size_t j = 1; j + 1 < breaks.size(); ++j)
      {
        const bool along = this->Cells[k - 1].lower[i] == this->Cells[k].lower[i];
        on_line = on_line || (at[i] == breaks[j].at && !along);
      }
    }
    if (on_line)
    {
      result.push_back(static_cast<double>(k));
    }
  }
  return result;
}

std::vector<Parameter<2>> TrimEdge::hull(double from, double to) const
{
  std::vector<Parameter<2>> points;
  for (std::size_t k = this->arc_at(from); k < this->Arcs.size() && static_cast<double>(k) < to;
       ++k)
  {
    const double base = static_cast<double>(k);
    const auto control =
      part_of(this->Arcs[k], std::max(from - base, 0.0), std::min(to - base, 1.0));
    for (Eigen::Index j = 0; j < control.cols(); ++j)
    {
      points.push_back(control.col(j).head<2>() / control(2, j));
    }
  }
  return points;
}

double TrimEdge::chord(const SurfaceBounds& bounds, double from, double to) const
{
  const std::vector<Parameter<2>> points = this->hull(from, to);
  const Parameter<2> start = this->place(from);
  const Parameter<2> end = this->place(to);
  ParameterBox box{ start.cwiseMin(end), start.cwiseMax(end) };
  for (const Parameter<2>& point : points)
  {
    box.lower = box.lower.cwiseMin(point);
    box.upper = box.upper.cwiseMax(point);
  }
  const DerivativeBounds derivatives = bounds.over(box);
  // The control points' distances from the chord: those of the curve are no larger.
  const Parameter<2> speed(derivatives.u, derivatives.v);
  const Parameter<2> way = (end - start).cwiseProduct(speed);
  double off = 0.0;
  for (const Parameter<2>& point : points)
  {
    const Parameter<2> at = (point - start).cwiseProduct(speed);
    const double along =
      way.squaredNorm() > 0.0 ? std::clamp(at.dot(way) / way.squaredNorm(), 0.0, 1.0) : 0.0;
    off = std::max(off, (at - along * way).lpNorm<1>());
  }
  return off + derivatives.second.chord((end - start).cwiseAbs());
}

bool TrimEdge::is_fine(
  const SurfaceBounds& bounds, const SamplingRule& rule, double from, double to) const
{
  if (!rule.adaptive)
  {
    return true;
  }
  if (!(this->chord(bounds, from, to) <= kShareOfChords * rule.tolerance))
  {
    return false;
  }
  if (!(rule.angle > 0.0) || (this->point(from) - this->point(to)).norm() <= rule.tolerance)
  {
    return true;
  }
  // Also between: triangles beside the chord have corners near its middle.
  std::array<Vector3, kNormals> normals;
  for (int i = 0; i < kNormals; ++i)
  {
    const double t = from + (to - from) * i / (kNormals - 1);
    normals[i] = this->normal(t, i == 0 ? Side::Right : Side::Left);
    for (int j = 0; j < i; ++j)
    {
      if (angle_between(normals[i], normals[j]) > rule.angle)
      {
        return false;
      }
    }
  }
  return true;
}

std::vector<double> TrimEdge::samples(
  const SurfaceBounds& bounds, const SamplingRule& rule, double from, double to) const
{
  std::vector<double> result{ from };
  if (rule.adaptive)
  {
    this->sample(bounds, rule, from, to, 0, result);
  }
  else
  {
    for (double k = std::floor(from); k < to; k += 1.0)
    {
      for (int i = 0; i < rule.resolution; ++i)
      {
        const double t = k + static_cast<double>(i) / rule.resolution;
        if (t > from && t < to)
        {
          result.push_back(t);
        }
      }
    }
    result.push_back(to);
  }
  return result;
}

void TrimEdge::sample(const SurfaceBounds& bounds, const SamplingRule& rule, double from, double to,
  int depth, std::vector<double>& result) const
{
  if (depth >= kDeepest || this->is_fine(bounds, rule, from, to))
  {
    result.push_back(to);
    return;
  }
  const double first_joint = std::floor(from + kAtJoint) + 1.0;
  const double last_joint = std::ceil(to - kAtJoint) - 1.0;
  int parts = 2;
  double joint = 0.0; // where several arcs are divided
  if (first_joint <= last_joint)
  {
    joint = std::clamp(std::nearbyint(0.5 * (from + to)), first_joint, last_joint);
  }
  else
  {
    const double ratio = this->chord(bounds, from, to) / (kShareOfChords * rule.tolerance);
    const double wanted = std::ceil(std::sqrt(ratio));
    parts = wanted <= kFewParts ? std::max(2, static_cast<int>(wanted)) : 2;
  }
  double at = from;
  for (int i = 1; i <= parts; ++i)
  {
    const double next = i == parts ? to
      : joint > 0.0                ? joint
                                   : from + (to - from) * (static_cast<double>(i) / parts);
    if (next > at)
    {
      this->sample(bounds, rule, at, next, depth + 1, result);
    }
    at = next;
  }
}

} // namespace footpoint
