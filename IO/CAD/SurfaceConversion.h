// SPDX-License-Identifier: BSD-3-Clause
// Private: Open CASCADE's surfaces as B-splines.

#ifndef SurfaceConversion_h
#define SurfaceConversion_h

#include "CADModel.h"
#include "ParameterMap.h"

#include <Geom_BSplineSurface.hxx>
#include <Geom_Surface.hxx>
#include <gp_Trsf.hxx>

#include <array>

namespace footpoint::cad
{

/// A range of (u, v) of Open CASCADE's surface.
struct Window
{
  std::array<double, 2> lower;
  std::array<double, 2> upper;
};

struct ConvertedSurface
{
  Handle(Geom_BSplineSurface) surface;
  std::array<ParameterMap, 2> map = { { ParameterMap::identity(), ParameterMap::identity() } };
  double error = 0.0; ///< model units; 0 where the conversion is exact
};

/// The surface over a window. Planes, cylinders, cones, spheres, tori, B-splines, Bézier surfaces
/// and extrusions and revolutions of such curves are exact; offsets and unknown kinds are
/// approximated to `tolerance` (model units), with `error` saying how well.
/// \param window of a B-spline: only what is periodic, or where `cut` says so, is cut to it; the
/// rest
///               stays as it is in the file
/// \throw ConversionError, Standard_Failure
ConvertedSurface convert_surface(
  const Handle(Geom_Surface) & surface, const Window& window, bool cut, double tolerance);

/// Numbers of a B-spline surface that is not periodic, moved and then scaled.
SurfaceData surface_data(
  const Handle(Geom_BSplineSurface) & surface, const gp_Trsf& move, double scale);

/// Without RectangularTrimmedSurfaces around it; offsets of simple surfaces as simple surfaces.
Handle(Geom_Surface) bare_surface(const Handle(Geom_Surface) & surface);

} // namespace footpoint::cad

#endif
