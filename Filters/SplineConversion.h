// SPDX-License-Identifier: BSD-3-Clause
// Private: VTK data as geometry of the core. The formats are those in the documentation of
// vtkPointInversionFilter.

#ifndef SplineConversion_h
#define SplineConversion_h

#include "footpoint/model/model.h"

#include <string>
#include <vector>

class vtkDataObject;
class vtkDataSet;
class vtkFieldData;
class vtkStructuredGrid;
class vtkUnstructuredGrid;

namespace footpoint::conversion
{

/// Why a face was refused.
struct Problem
{
  std::size_t face;
  std::string message;
};

/// A model, and what was wrong with the faces that are not in it.
struct ConvertedModel
{
  Model model; ///< a refused face has no patches, its number stays in use
  std::vector<Problem> problems;

  bool empty() const; ///< no face has a patch
  /// A sentence for each problem, such as "Face 3 ('wing'): KnotsU[4] = …".
  std::vector<std::string> messages() const;
};

/// Converts a net, Bézier cells or a composite data set of those; never throws for bad geometry.
/// \param source     not null
/// \param flip       reverse the normals of all faces
ConvertedModel convert_to_model(vtkDataObject* source, bool flip);

/// What is said of a face in field data.
struct FaceAttributes
{
  std::string name;      ///< `FaceName`; may be empty
  bool reversed = false; ///< `Orientation` is −1
};

/// \throw GeometryError where `Orientation` is neither 1 nor −1
FaceAttributes read_face_attributes(vtkFieldData* data);

/// A net of control points with its knots in the field data.
/// \throw GeometryError
Patch convert_net(vtkStructuredGrid* net);

/// Bézier cells, grouped by the cell array `FaceId`; without it every cell is a face. The faces are
/// numbered from 0 by the values of `FaceId`, numbers that do not occur are faces without patches.
/// A face with a bad cell goes to `problems`.
/// \throw GeometryError where nothing can be grouped (a bad `FaceId`)
ConvertedModel convert_bezier_cells(vtkUnstructuredGrid* cells);

/// Weights from the active RationalWeights attribute, else the point array of that name; empty
/// where there is none. \throw GeometryError where they are no scalars.
Eigen::VectorXd read_weights(vtkDataSet* data);

} // namespace footpoint::conversion

#endif
