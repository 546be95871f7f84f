// SPDX-License-Identifier: BSD-3-Clause
#include "EdgeProjection.h"

#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_Plane.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <Precision.hxx>

#include <algorithm>
#include <cmath>

namespace footpoint::cad
{

namespace
{

/// The start is near, where Newton's method doubles the digits with every step.
constexpr int kSteps = 8;
constexpr double kRounding = 4e-16; ///< relative; smaller steps change nothing
/// A bilinear surface is a parallelogram where it is twisted by no more than rounding, relatively.
constexpr double kTwist = 1e-14;

bool is_flat(const Handle(Geom_Surface) & surface)
{
  if (!Handle(Geom_Plane)::DownCast(surface).IsNull())
  {
    return true;
  }
  const auto spline = Handle(Geom_BSplineSurface)::DownCast(surface);
  if (spline.IsNull() || spline->NbUPoles() != 2 || spline->NbVPoles() != 2 ||
    spline->IsURational() || spline->IsVRational())
  {
    return false;
  }
  const gp_XYZ diagonal = spline->Pole(2, 2).XYZ() - spline->Pole(1, 1).XYZ();
  const gp_XYZ twist = spline->Pole(1, 1).XYZ() + spline->Pole(2, 2).XYZ() -
    spline->Pole(1, 2).XYZ() - spline->Pole(2, 1).XYZ();
  return twist.Modulus() <= kTwist * diagonal.Modulus();
}

} // namespace

gp_Pnt EdgeOnSurface::at(double fraction) const
{
  return this->curve->Value(
    fraction == 1.0 ? this->last : this->first + (this->last - this->first) * fraction);
}

gp_Pnt2d EdgeOnSurface::foot(double fraction, const gp_Pnt2d& start) const
{
  const gp_Pnt target = this->at(fraction);
  double bounds[4];
  this->surface->Bounds(bounds[0], bounds[1], bounds[2], bounds[3]);
  double u = start.X();
  double v = start.Y();
  for (int step = 0; step < kSteps; ++step)
  {
    gp_Pnt point;
    gp_Vec su;
    gp_Vec sv;
    gp_Vec suu;
    gp_Vec svv;
    gp_Vec suv;
    this->surface->D2(u, v, point, su, sv, suu, svv, suv);
    const gp_Vec apart(target, point);
    // Gradient and Hessian of half the squared distance.
    const double gu = apart.Dot(su);
    const double gv = apart.Dot(sv);
    const double huu = su.Dot(su) + apart.Dot(suu);
    const double huv = su.Dot(sv) + apart.Dot(suv);
    const double hvv = sv.Dot(sv) + apart.Dot(svv);
    const double determinant = huu * hvv - huv * huv;
    if (!(determinant > 1e-12 * huu * hvv))
    {
      break; // a pole: the parameters mean nothing there
    }
    const double du = (hvv * gu - huv * gv) / determinant;
    const double dv = (huu * gv - huv * gu) / determinant;
    u -= du;
    v -= dv;
    if (!this->surface->IsUPeriodic())
    {
      u = std::min(bounds[1], std::max(bounds[0], u));
    }
    if (!this->surface->IsVPeriodic())
    {
      v = std::min(bounds[3], std::max(bounds[2], v));
    }
    if (std::abs(du) <= kRounding * std::abs(u) && std::abs(dv) <= kRounding * std::abs(v))
    {
      break;
    }
  }
  // Distances cannot tell the last half of the digits; they only tell whether it has diverged.
  const bool nearer = this->surface->Value(u, v).Distance(target) <=
    this->surface->Value(start.X(), start.Y()).Distance(target) * (1.0 + 1e-6);
  return nearer ? gp_Pnt2d(u, v) : start;
}

std::optional<gp_Pnt2d> EdgeOnSurface::flat_foot(const gp_Pnt& point) const
{
  if (!is_flat(this->surface))
  {
    return std::nullopt;
  }
  gp_Pnt origin;
  gp_Vec su;
  gp_Vec sv;
  double bounds[4];
  this->surface->Bounds(bounds[0], bounds[1], bounds[2], bounds[3]);
  const bool endless = Precision::IsInfinite(bounds[0]);
  const gp_Pnt2d start(endless ? 0.0 : bounds[0], endless ? 0.0 : bounds[2]);
  this->surface->D1(start.X(), start.Y(), origin, su, sv);
  const gp_Vec apart(origin, point);
  const double determinant = su.Dot(su) * sv.Dot(sv) - su.Dot(sv) * su.Dot(sv);
  const double u = (apart.Dot(su) * sv.Dot(sv) - apart.Dot(sv) * su.Dot(sv)) / determinant;
  const double v = (apart.Dot(sv) * su.Dot(su) - apart.Dot(su) * su.Dot(sv)) / determinant;
  return gp_Pnt2d(start.X() + u, start.Y() + v);
}

std::vector<double> EdgeOnSurface::kinks() const
{
  Handle(Geom_Curve) bare = this->curve;
  while (const auto trimmed = Handle(Geom_TrimmedCurve)::DownCast(bare))
  {
    bare = trimmed->BasisCurve();
  }
  std::vector<double> result;
  if (const auto spline = Handle(Geom_BSplineCurve)::DownCast(bare))
  {
    for (int i = 1; i <= spline->NbKnots(); ++i)
    {
      const double fraction = (spline->Knot(i) - this->first) / (this->last - this->first);
      if (fraction > 0.0 && fraction < 1.0)
      {
        result.push_back(fraction);
      }
    }
  }
  return result;
}

} // namespace footpoint::cad
