// SPDX-License-Identifier: BSD-3-Clause
#include "ParameterCurves.h"

#include "CurveConversion.h"

#include <BndLib_Add2dCurve.hxx>
#include <Bnd_Box2d.hxx>
#include <Geom2dConvert.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom2d_BezierCurve.hxx>
#include <Geom2d_Circle.hxx>
#include <Geom2d_Ellipse.hxx>
#include <Geom2d_Line.hxx>
#include <Geom2d_TrimmedCurve.hxx>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <functional>

namespace footpoint::cad
{

namespace
{

/// Degree of approximations: high, as they are to reach rounding, and low enough that Bernstein
/// control points from samples lose no more than three digits.
constexpr int kDegree = 9;
constexpr int kDeepestBisection = 12;
/// Samples of a span of a curve in which crossings of a kink of the map are looked for.
constexpr int kSamples = 16;
/// Factor on the exactness for edges that are projected: they hold to the file's tolerance only.
constexpr double kProjected = 1e3;
/// Largest error of a coordinate that is rounding, relative to its size.
constexpr double kRounding = 4e-16;

using Values = Eigen::Matrix<double, kDegree + 1, 2>;

Handle(Geom2d_Curve) bare_curve(const Handle(Geom2d_Curve) & curve)
{
  const auto trimmed = Handle(Geom2d_TrimmedCurve)::DownCast(curve);
  return trimmed.IsNull() ? curve : bare_curve(trimmed->BasisCurve());
}

/// Nodes cos(pi i / n) of Chebyshev and Lobatto, ascending on [0, 1].
double node(int i)
{
  return 0.5 * (1.0 - std::cos(M_PI * i / kDegree));
}

/// Bernstein polynomials at the nodes, inverted.
const Eigen::Matrix<double, kDegree + 1, kDegree + 1>& bernstein_from_values()
{
  static const Eigen::Matrix<double, kDegree + 1, kDegree + 1> inverse = []
  {
    Eigen::Matrix<double, kDegree + 1, kDegree + 1> values;
    for (int i = 0; i <= kDegree; ++i)
    {
      double binomial = 1.0;
      for (int j = 0; j <= kDegree; ++j)
      {
        values(i, j) = binomial * std::pow(node(i), j) * std::pow(1.0 - node(i), kDegree - j);
        binomial *= static_cast<double>(kDegree - j) / (j + 1);
      }
    }
    return values.inverse().eval();
  }();
  return inverse;
}

gp_Pnt2d bezier_point(const Values& poles, double s)
{
  Values work = poles;
  for (int level = kDegree; level > 0; --level)
  {
    for (int i = 0; i < level; ++i)
    {
      work.row(i) = (1.0 - s) * work.row(i) + s * work.row(i + 1);
    }
  }
  return gp_Pnt2d(work(0, 0), work(0, 1));
}

/// A curve built of Bézier pieces, each found by bisection.
class PieceFitter
{
public:
  PieceFitter(std::function<gp_Pnt2d(double)> function, const ParameterScale& scale)
    : Function(std::move(function))
    , Scale(scale)
  {
  }

  void fit(double first, double last, int depth = 0)
  {
    Values values;
    for (int i = 0; i <= kDegree; ++i)
    {
      const gp_Pnt2d point = this->Function(i == kDegree ? last : first + (last - first) * node(i));
      values.row(i) << point.X(), point.Y();
    }
    const Eigen::RowVector2d middle = 0.5 * (values.row(0) + values.row(kDegree));
    Values poles = bernstein_from_values() * (values.rowwise() - middle);
    poles.rowwise() += middle;
    poles.row(0) = values.row(0);
    poles.row(kDegree) = values.row(kDegree);

    double error = 0.0;
    double rounding = 0.0;
    for (int i = 0; i < kDegree; ++i)
    {
      const double s = 0.5 * (node(i) + node(i + 1));
      const gp_Pnt2d exact = this->Function(first + (last - first) * s);
      const gp_Pnt2d ours = bezier_point(poles, s);
      error = std::max(error,
        std::hypot(this->Scale.speed[0] * (ours.X() - exact.X()),
          this->Scale.speed[1] * (ours.Y() - exact.Y())));
      rounding = std::max(rounding,
        kRounding * std::hypot(this->Scale.speed[0] * exact.X(), this->Scale.speed[1] * exact.Y()));
    }
    if (!(error <= std::max(this->Scale.exactness, rounding)) && depth < kDeepestBisection)
    {
      const double half = 0.5 * (first + last);
      this->fit(first, half, depth + 1);
      this->fit(half, last, depth + 1);
      return;
    }
    this->Deviation = std::max(this->Deviation, error);
    this->append(poles, last - first);
  }

  CurveData result() const { return this->Curve; }
  double deviation() const { return this->Deviation; }

private:
  void append(const Values& poles, double length)
  {
    const double start = this->Curve.knots.empty() ? 0.0 : this->Curve.knots.back();
    if (this->Curve.knots.empty())
    {
      this->Curve.degree = kDegree;
      this->Curve.knots.assign(kDegree + 1, 0.0);
      this->Curve.points = { poles(0, 0), poles(0, 1), 0.0 };
    }
    else
    {
      this->Curve.knots.pop_back(); // an inner knot has multiplicity kDegree
    }
    this->Curve.knots.insert(this->Curve.knots.end(), kDegree + 1, start + length);
    for (int i = 1; i <= kDegree; ++i)
    {
      this->Curve.points.insert(this->Curve.points.end(), { poles(i, 0), poles(i, 1), 0.0 });
    }
  }

  std::function<gp_Pnt2d(double)> Function;
  ParameterScale Scale;
  CurveData Curve;
  double Deviation = 0.0;
};

/// Where the curve itself is not smooth, ends included.
std::vector<double> spans(const Handle(Geom2d_Curve) & curve, double first, double last)
{
  std::vector<double> breaks{ first };
  if (const auto spline = Handle(Geom2d_BSplineCurve)::DownCast(curve))
  {
    const double period = spline->IsPeriodic() ? spline->Period() : 0.0;
    for (int turn = period > 0.0 ? -2 : 0; turn <= (period > 0.0 ? 2 : 0); ++turn)
    {
      for (int i = 1; i <= spline->NbKnots(); ++i)
      {
        breaks.push_back(spline->Knot(i) + turn * period);
      }
    }
  }
  breaks.push_back(last);
  std::sort(breaks.begin(), breaks.end());
  const double near = 1e-9 * (last - first);
  std::vector<double> result{ first };
  for (const double value : breaks)
  {
    if (value > result.back() + near && value < last - near)
    {
      result.push_back(value);
    }
  }
  result.push_back(last);
  return result;
}

/// Parameters between `from` and `to` where a coordinate takes a value, one for each sign change.
double crossing(const TrimCurve& trim, int axis, double value, double from, double to)
{
  double low = from;
  double high = to;
  const bool rises = trim.at(from).Coord(axis) < value;
  for (int i = 0; i < 80 && low < high; ++i)
  {
    const double middle = 0.5 * (low + high);
    (trim.at(middle).Coord(axis) < value) == rises ? low = middle : high = middle;
  }
  return 0.5 * (low + high);
}

void add_kinks(const TrimCurve& trim, const std::array<ParameterMap, 2>& map, double from,
  double to, std::vector<double>& breaks)
{
  for (int axis = 1; axis <= 2; ++axis)
  {
    for (const double value : map[static_cast<std::size_t>(axis) - 1].kinks())
    {
      for (int i = 0; i < kSamples; ++i)
      {
        const double t0 = from + (to - from) * i / kSamples;
        const double t1 = from + (to - from) * (i + 1) / kSamples;
        const double d0 = trim.at(t0).Coord(axis) - value;
        const double d1 = trim.at(t1).Coord(axis) - value;
        if ((d0 < 0.0) != (d1 < 0.0))
        {
          breaks.push_back(crossing(trim, axis, value, t0, t1));
        }
      }
    }
  }
}

void reverse(CurveData& curve)
{
  const double sum = curve.knots.front() + curve.knots.back();
  std::reverse(curve.knots.begin(), curve.knots.end());
  for (double& knot : curve.knots)
  {
    knot = sum - knot;
  }
  std::vector<double> points;
  for (std::size_t i = curve.points.size(); i > 0; i -= 3)
  {
    points.insert(points.end(), { curve.points[i - 3], curve.points[i - 2], curve.points[i - 1] });
  }
  curve.points = std::move(points);
  std::reverse(curve.weights.begin(), curve.weights.end());
}

/// A B-spline, or a conic as one, in Open CASCADE's own parameters.
CurveData exact_curve(const TrimCurve& trim)
{
  Handle(Geom2d_BSplineCurve) spline =
    Geom2dConvert::CurveToBSplineCurve(new Geom2d_TrimmedCurve(trim.curve, trim.first, trim.last));
  if (spline->IsPeriodic())
  {
    spline->SetNotPeriodic();
  }
  CurveData data;
  data.degree = spline->Degree();
  data.knots = flat_knots(spline->Knots(), spline->Multiplicities());
  for (int i = 1; i <= spline->NbPoles(); ++i)
  {
    const gp_Pnt2d pole = spline->Pole(i).Translated(trim.shift);
    data.points.insert(data.points.end(), { pole.X(), pole.Y(), 0.0 });
    if (spline->IsRational())
    {
      data.weights.push_back(spline->Weight(i));
    }
  }
  return data;
}

bool has_exact_spline(const Handle(Geom2d_Curve) & curve)
{
  return !Handle(Geom2d_BSplineCurve)::DownCast(curve).IsNull() ||
    !Handle(Geom2d_BezierCurve)::DownCast(curve).IsNull() ||
    !Handle(Geom2d_Circle)::DownCast(curve).IsNull() ||
    !Handle(Geom2d_Ellipse)::DownCast(curve).IsNull();
}

/// An edge on a surface with straight parameters, control point by control point.
CurveData flat_edge(const TrimCurve& trim, double tolerance)
{
  const EdgeOnSurface& edge = *trim.missed;
  const ConvertedCurve space = convert_curve(edge.curve, edge.first, edge.last, tolerance);
  CurveData data = curve_data(space.curve, gp_Trsf(), 1.0);
  for (std::size_t i = 0; i < data.points.size(); i += 3)
  {
    const gp_Pnt2d foot =
      *edge.flat_foot(gp_Pnt(data.points[i], data.points[i + 1], data.points[i + 2]));
    data.points[i] = foot.X() + trim.shift.X();
    data.points[i + 1] = foot.Y() + trim.shift.Y();
    data.points[i + 2] = 0.0;
  }
  return data;
}

/// Whether a curve runs along u or along v all the way and never turns back.
bool is_isoline(const TrimCurve& trim, const ParameterScale& scale)
{
  const std::vector<double> breaks = spans(trim.curve, trim.first, trim.last);
  for (int axis = 1; axis <= 2; ++axis)
  {
    const int other = 3 - axis;
    const double value = trim.at(trim.first).Coord(axis);
    const double near = std::max(
      0.1 * scale.exactness / std::max(scale.speed[axis - 1], 1e-300), kRounding * std::abs(value));
    const double sense = trim.at(trim.last).Coord(other) - trim.at(trim.first).Coord(other);
    double before = trim.at(trim.first).Coord(other);
    bool straight = true;
    for (std::size_t i = 1; straight && i < breaks.size(); ++i)
    {
      for (int k = 1; straight && k <= kSamples; ++k)
      {
        const gp_Pnt2d point = trim.at(breaks[i - 1] + (breaks[i] - breaks[i - 1]) * k / kSamples);
        straight = std::abs(point.Coord(axis) - value) <= near &&
          (point.Coord(other) - before) * sense >= 0.0;
        before = point.Coord(other);
      }
    }
    if (straight)
    {
      return true;
    }
  }
  return false;
}

} // namespace

gp_Pnt2d TrimCurve::at(double parameter) const
{
  return this->curve->Value(parameter).Translated(this->shift);
}

gp_Pnt2d TrimCurve::exact_at(double parameter) const
{
  if (!this->missed)
  {
    return this->at(parameter);
  }
  const double fraction =
    parameter == this->last ? 1.0 : (parameter - this->first) / (this->last - this->first);
  return this->missed->foot(fraction, this->curve->Value(parameter)).Translated(this->shift);
}

CurveData parameter_line(const gp_Pnt2d& from, const gp_Pnt2d& to)
{
  CurveData data;
  data.degree = 1;
  data.knots = { 0.0, 0.0, 1.0, 1.0 };
  data.points = { from.X(), from.Y(), 0.0, to.X(), to.Y(), 0.0 };
  return data;
}

CurveData convert_parameter_curve(const TrimCurve& trim, const std::array<ParameterMap, 2>& map,
  const ParameterScale& scale, double& deviation)
{
  const auto mapped = [&](const gp_Pnt2d& point)
  { return gp_Pnt2d(map[0](point.X()), map[1](point.Y())); };

  TrimCurve bare = trim;
  bare.curve = bare_curve(trim.curve);
  const bool identity = map[0].is_identity() && map[1].is_identity() && !trim.missed;
  const bool line = !Handle(Geom2d_Line)::DownCast(bare.curve).IsNull();
  if ((line && identity) || (!trim.missed && is_isoline(bare, scale)))
  {
    return parameter_line(mapped(bare.start()), mapped(bare.end()));
  }
  CurveData data;
  if (identity && has_exact_spline(bare.curve))
  {
    data = exact_curve(bare);
  }
  else if (trim.missed && trim.missed->flat_foot(gp_Pnt()))
  {
    data = flat_edge(trim, scale.exactness);
  }
  else
  {
    std::vector<double> breaks{ bare.first, bare.last };
    if (!trim.missed)
    {
      breaks = spans(bare.curve, bare.first, bare.last);
    }
    for (const double kink : trim.missed ? trim.missed->kinks() : std::vector<double>())
    {
      breaks.push_back(bare.first + (bare.last - bare.first) * kink);
    }
    std::sort(breaks.begin(), breaks.end());
    for (std::size_t i = 1, count = breaks.size(); i < count; ++i)
    {
      add_kinks(bare, map, breaks[i - 1], breaks[i], breaks);
    }
    std::sort(breaks.begin(), breaks.end());
    ParameterScale wanted = scale;
    wanted.exactness *= trim.missed ? kProjected : 1.0;
    PieceFitter fitter([&](double t) { return mapped(bare.exact_at(t)); }, wanted);
    const double near = 1e-12 * (bare.last - bare.first);
    double from = breaks.front();
    for (std::size_t i = 1; i < breaks.size(); ++i)
    {
      const bool final = i + 1 == breaks.size();
      if (final || (breaks[i] > from + near && breaks[i] < bare.last - near))
      {
        fitter.fit(from, breaks[i]);
        from = breaks[i];
      }
    }
    data = fitter.result();
    deviation = std::max(deviation, fitter.deviation());
  }
  if (bare.reversed)
  {
    reverse(data);
  }
  return data;
}

std::array<std::array<double, 2>, 2> extent(const TrimCurve& trim)
{
  Bnd_Box2d box;
  BndLib_Add2dCurve::Add(trim.curve, trim.first, trim.last, 0.0, box);
  box.SetGap(0.0);
  std::array<std::array<double, 2>, 2> result;
  box.Get(result[0][0], result[0][1], result[1][0], result[1][1]);
  for (int end = 0; end < 2; ++end)
  {
    result[static_cast<std::size_t>(end)][0] += trim.shift.X();
    result[static_cast<std::size_t>(end)][1] += trim.shift.Y();
  }
  return result;
}

} // namespace footpoint::cad
