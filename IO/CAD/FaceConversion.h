// SPDX-License-Identifier: BSD-3-Clause
// Private: faces of Open CASCADE as NURBS surfaces with trim loops.

#ifndef FaceConversion_h
#define FaceConversion_h

#include "CADModel.h"
#include "CurveConversion.h"
#include "SurfaceConversion.h"

#include <TopoDS_Face.hxx>

namespace footpoint::cad
{

struct FaceConversionOptions
{
  double scale = 1.0; ///< factor from Open CASCADE's lengths to the unit that is asked for
};

/// A face, without number and name, and what is known beyond FaceData.
struct ConvertedFace
{
  FaceData data;
  std::array<ParameterMap, 2> map = { { ParameterMap::identity(), ParameterMap::identity() } };
  double surface_error = 0.0; ///< of an approximated surface; 0 where exact (asked-for unit)
  double loop_error = 0.0;    ///< of approximated trim curves, likewise
};

/// Converts a face and checks the result against Open CASCADE's evaluation.
/// \throw ConversionError, Standard_Failure: the reason
ConvertedFace convert_face(const TopoDS_Face& face, const FaceConversionOptions& options);

} // namespace footpoint::cad

#endif
