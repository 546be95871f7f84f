// SPDX-License-Identifier: BSD-3-Clause
#include "FaceConversion.h"

#include "TrimLoops.h"

#include <BRep_Tool.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_ConicalSurface.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_Plane.hxx>
#include <Geom_SphericalSurface.hxx>
#include <Precision.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>

#include <algorithm>
#include <cmath>

namespace footpoint::cad
{

namespace
{

/// Exactness of what is approximated, relative to the face's size.
constexpr double kCurveExactness = 1e-13;
constexpr double kSurfaceExactness = 1e-9;
/// A converted surface that is farther than this from the original is refused, relative to its
/// size.
constexpr double kLargestDeviation = 1e-9;
/// Space left around loops where the surface goes on beyond them, as a fraction of their extent: an
/// arc that touches the border of the domain from inside would cross it by rounding.
constexpr double kMargin = 1.0 / 32.0;
/// A range of a periodic direction that is nearer than this to a period, relatively, is one.
constexpr double kWholePeriod = 1e-7;
/// Trim loops of which the largest keeps a rectangle, relatively to its area.
constexpr double kRectangle = 1e-6;
/// Samples a direction for speeds and for the check.
constexpr int kSamples = 7;
/// A gap in (u, v) that is larger than this, as a fraction of the window, gets a line.
constexpr double kGap = 1e-6;

class FaceConverter
{
public:
  FaceConverter(const TopoDS_Face& face, const FaceConversionOptions& options)
    : Face(face)
    , Options(options)
  {
    TopLoc_Location location;
    const Handle(Geom_Surface) surface = BRep_Tool::Surface(face, location);
    if (surface.IsNull())
    {
      throw ConversionError("it has no surface");
    }
    this->Move = location.Transformation();
    this->Surface = bare_surface(surface);
    this->find_loops();
    this->find_tolerance();
    this->find_window();
    this->find_speeds();
  }

  ConvertedFace convert()
  {
    const bool rectangle = this->is_rectangle();
    if (!rectangle)
    {
      this->widen_window();
    }
    const ConvertedSurface converted =
      convert_surface(this->Surface, this->Range, rectangle, kSurfaceExactness * this->Size);
    this->check(converted);

    ConvertedFace result;
    result.map = converted.map;
    const double scale = this->Options.scale;
    // Lengths along the face: its location may scale, too.
    const double factor = scale * std::abs(this->Move.ScaleFactor());
    result.surface_error = converted.error * factor;
    result.data.surface = surface_data(converted.surface, this->Move, scale);
    // A mirrored surface has its normal on the other side.
    const bool reversed = (this->Face.Orientation() == TopAbs_REVERSED) != this->Move.IsNegative();
    result.data.orientation = reversed ? -1 : 1;
    if (!rectangle)
    {
      this->convert_loops(converted, result);
    }
    result.loop_error *= factor;
    result.data.tolerance = this->Tolerance * scale + result.surface_error;
    return result;
  }

private:
  // === What is given

  void find_loops()
  {
    this->Loops = trim_loops(this->Face, this->Surface);
    double area = 0.0;
    for (const TrimChain& loop : this->Loops)
    {
      area += signed_area(loop);
    }
    // Loops that keep the outside of everything are the wrong way round.
    if (area < 0.0)
    {
      for (TrimChain& loop : this->Loops)
      {
        std::reverse(loop.begin(), loop.end());
        for (TrimCurve& curve : loop)
        {
          curve.reversed = !curve.reversed;
        }
      }
    }
  }

  void find_tolerance()
  {
    this->Tolerance = BRep_Tool::Tolerance(this->Face);
    for (TopExp_Explorer edges(this->Face, TopAbs_EDGE); edges.More(); edges.Next())
    {
      this->Tolerance =
        std::max(this->Tolerance, BRep_Tool::Tolerance(TopoDS::Edge(edges.Current())));
    }
    // A tolerance that its own edges break is no tolerance.
    for (const TrimChain& loop : this->Loops)
    {
      for (const TrimCurve& curve : loop)
      {
        this->Tolerance = std::max(this->Tolerance, curve.deviation);
      }
    }
  }

  std::array<double, 2> period() const
  {
    return { { this->Surface->IsUPeriodic() ? this->Surface->UPeriod() : 0.0,
      this->Surface->IsVPeriodic() ? this->Surface->VPeriod() : 0.0 } };
  }

  /// Where the surface is defined; infinite for planes and the like, and along periods.
  Window natural_range() const
  {
    Window range;
    this->Surface->Bounds(range.lower[0], range.upper[0], range.lower[1], range.upper[1]);
    for (std::size_t direction = 0; direction < 2; ++direction)
    {
      if (this->period()[direction] > 0.0)
      {
        range.lower[direction] = -Precision::Infinite();
        range.upper[direction] = Precision::Infinite();
      }
    }
    return range;
  }

  // === The window of parameters

  void find_window()
  {
    if (this->Loops.empty())
    {
      this->Surface->Bounds(
        this->Range.lower[0], this->Range.upper[0], this->Range.lower[1], this->Range.upper[1]);
    }
    else
    {
      this->Range = { { { 1e300, 1e300 } }, { { -1e300, -1e300 } } };
      for (const TrimChain& loop : this->Loops)
      {
        for (const TrimCurve& curve : loop)
        {
          const auto box = extent(curve);
          for (std::size_t direction = 0; direction < 2; ++direction)
          {
            this->Range.lower[direction] =
              std::min(this->Range.lower[direction], box[0][direction]);
            this->Range.upper[direction] =
              std::max(this->Range.upper[direction], box[1][direction]);
          }
        }
      }
    }
    const Window natural = this->natural_range();
    for (std::size_t direction = 0; direction < 2; ++direction)
    {
      this->fit_range(direction, natural);
    }
  }

  void fit_range(std::size_t direction, const Window& natural)
  {
    double& lower = this->Range.lower[direction];
    double& upper = this->Range.upper[direction];
    const double near = kWholePeriod * (upper - lower);
    if (lower < natural.lower[direction] + near)
    {
      lower = natural.lower[direction];
    }
    if (upper > natural.upper[direction] - near)
    {
      upper = natural.upper[direction];
    }
    const double period = this->period()[direction];
    const bool spline = !Handle(Geom_BSplineSurface)::DownCast(this->Surface).IsNull();
    const bool whole = std::abs(upper - lower - period) <= kWholePeriod * period;
    if (period > 0.0 && (whole || (spline && upper - lower > period)))
    {
      upper = lower + period;
    }
    if (!(upper > lower) || Precision::IsInfinite(lower) || Precision::IsInfinite(upper))
    {
      throw ConversionError(std::string("its range of ") + (direction ? "v" : "u") + " is [" +
        std::to_string(lower) + ", " + std::to_string(upper) + "]");
    }
  }

  void widen_window()
  {
    const Window natural = this->natural_range();
    for (std::size_t direction = 0; direction < 2; ++direction)
    {
      double& lower = this->Range.lower[direction];
      double& upper = this->Range.upper[direction];
      const double period = this->period()[direction];
      double margin = kMargin * (upper - lower);
      if (period > 0.0)
      {
        margin = std::min(margin, 0.25 * (period - (upper - lower)));
        if (margin <= kWholePeriod * period)
        {
          continue; // closed, or more than once around
        }
      }
      if (direction == 1 && !this->goes_on_beyond(lower, upper, margin))
      {
        continue;
      }
      lower = std::max(lower - margin, natural.lower[direction]);
      upper = std::min(upper + margin, natural.upper[direction]);
    }
  }

  /// A cone must not be continued through its apex.
  bool goes_on_beyond(double lower, double upper, double margin) const
  {
    const auto cone = Handle(Geom_ConicalSurface)::DownCast(this->Surface);
    if (cone.IsNull())
    {
      return true;
    }
    const double apex = -cone->RefRadius() / std::sin(cone->SemiAngle());
    return apex < lower - margin || apex > upper + margin;
  }

  // === Sizes

  double at(std::size_t direction, int sample) const
  {
    return this->Range.lower[direction] +
      (this->Range.upper[direction] - this->Range.lower[direction]) * sample / (kSamples - 1);
  }

  void find_speeds()
  {
    gp_XYZ low(1e300, 1e300, 1e300);
    gp_XYZ high(-1e300, -1e300, -1e300);
    this->Speed = { { 0.0, 0.0 } };
    for (int i = 0; i < kSamples; ++i)
    {
      for (int j = 0; j < kSamples; ++j)
      {
        gp_Pnt point;
        gp_Vec along_u;
        gp_Vec along_v;
        this->Surface->D1(this->at(0, i), this->at(1, j), point, along_u, along_v);
        this->Speed[0] = std::max(this->Speed[0], along_u.Magnitude());
        this->Speed[1] = std::max(this->Speed[1], along_v.Magnitude());
        for (int axis = 1; axis <= 3; ++axis)
        {
          low.SetCoord(axis, std::min(low.Coord(axis), point.Coord(axis)));
          high.SetCoord(axis, std::max(high.Coord(axis), point.Coord(axis)));
        }
      }
    }
    this->Size = (high - low).Modulus();
    if (!(std::isfinite(this->Size) && this->Size > 0.0))
    {
      throw ConversionError("its surface has no extent or is not finite");
    }
  }

  // === Loops that are the border of the window

  /// Number of the side on which all of a curve lies: lower u, upper u, lower v, upper v; −1 none.
  int side_of(const TrimCurve& curve) const
  {
    const double near = std::min(this->Tolerance, 1e-6 * this->Size);
    for (int side = 0; side < 4; ++side)
    {
      const auto direction = static_cast<std::size_t>(side / 2);
      const double border = side % 2 ? this->Range.upper[direction] : this->Range.lower[direction];
      bool on = true;
      for (int i = 0; on && i < kSamples; ++i)
      {
        const double t = curve.first + (curve.last - curve.first) * i / (kSamples - 1);
        const double apart = curve.at(t).Coord(static_cast<int>(direction) + 1) - border;
        on = std::abs(apart) * this->Speed[direction] <= near;
      }
      if (on)
      {
        return side;
      }
    }
    return -1;
  }

  bool is_rectangle() const
  {
    if (this->Loops.empty())
    {
      return true;
    }
    if (this->Loops.size() > 1)
    {
      return false;
    }
    for (const TrimCurve& curve : this->Loops[0])
    {
      if (this->side_of(curve) < 0)
      {
        return false;
      }
    }
    const double area =
      (this->Range.upper[0] - this->Range.lower[0]) * (this->Range.upper[1] - this->Range.lower[1]);
    return std::abs(signed_area(this->Loops[0]) - area) <= kRectangle * area;
  }

  // === The result

  void check(const ConvertedSurface& converted) const
  {
    double u1 = 0.0;
    double u2 = 0.0;
    double v1 = 0.0;
    double v2 = 0.0;
    converted.surface->Bounds(u1, u2, v1, v2);
    for (int i = 0; i < kSamples; ++i)
    {
      for (int j = 0; j < kSamples; ++j)
      {
        const double u = this->at(0, i);
        const double v = this->at(1, j);
        const double our_u = std::clamp(converted.map[0](u), u1, u2);
        const double our_v = std::clamp(converted.map[1](v), v1, v2);
        const double apart =
          this->Surface->Value(u, v).Distance(converted.surface->Value(our_u, our_v));
        if (!(apart <= kLargestDeviation * this->Size + 2.0 * converted.error))
        {
          throw ConversionError("its surface came out wrong by " + std::to_string(apart) +
            " at (u, v) = (" + std::to_string(u) + ", " + std::to_string(v) + ")");
        }
      }
    }
  }

  void convert_loops(const ConvertedSurface& converted, ConvertedFace& result) const
  {
    const ParameterScale scale{ this->Speed, kCurveExactness * this->Size };
    const auto mapped = [&](const gp_Pnt2d& point)
    { return gp_Pnt2d(converted.map[0](point.X()), converted.map[1](point.Y())); };
    for (const TrimChain& loop : this->Loops)
    {
      std::vector<CurveData>& curves = result.data.loops.emplace_back();
      for (std::size_t i = 0; i < loop.size(); ++i)
      {
        curves.push_back(convert_parameter_curve(loop[i], converted.map, scale, result.loop_error));
        const gp_Pnt2d end = loop[i].end();
        const gp_Pnt2d next = loop[(i + 1) % loop.size()].start();
        if (this->is_jump(end, next))
        {
          curves.push_back(parameter_line(mapped(end), mapped(next)));
        }
      }
    }
  }

  /// Ends that are one point in space though not in (u, v): at a pole that the file does not
  /// mention.
  bool is_jump(const gp_Pnt2d& end, const gp_Pnt2d& next) const
  {
    const bool apart =
      std::abs(end.X() - next.X()) > kGap * (this->Range.upper[0] - this->Range.lower[0]) ||
      std::abs(end.Y() - next.Y()) > kGap * (this->Range.upper[1] - this->Range.lower[1]);
    return apart &&
      this->Surface->Value(0.5 * (end.X() + next.X()), 0.5 * (end.Y() + next.Y()))
        .Distance(this->Surface->Value(end.X(), end.Y())) <= this->Tolerance;
  }

  TopoDS_Face Face;
  FaceConversionOptions Options;
  gp_Trsf Move;
  Handle(Geom_Surface) Surface;
  std::vector<TrimChain> Loops;
  double Tolerance = 0.0;
  Window Range;
  std::array<double, 2> Speed;
  double Size = 0.0;
};

} // namespace

ConvertedFace convert_face(const TopoDS_Face& face, const FaceConversionOptions& options)
{
  return FaceConverter(face, options).convert();
}

} // namespace footpoint::cad
