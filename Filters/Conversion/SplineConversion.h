// SPDX-License-Identifier: BSD-3-Clause
// Private: VTK data as geometry of the core. The formats are those in the documentation of
// vtkPointInversionFilter.

#ifndef SplineConversion_h
#define SplineConversion_h

#include "footpoint/common/execution.h"
#include "footpoint/model/model.h"

#include <array>
#include <string>
#include <vector>

class vtkDataObject;
class vtkDataSet;
class vtkFieldData;
class vtkInformation;
class vtkMultiBlockDataSet;
class vtkStructuredGrid;
class vtkUnstructuredGrid;

namespace footpoint::conversion
{

/// How messages name a face, such as "Face 3 ('wing')".
std::string face_label(const Model& model, std::size_t face);

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

/// Converts a net, Bézier cells, a trimmed face or a composite data set of those; never throws for
/// bad geometry.
/// \param source     not null
/// \param flip       reverse the normals of all faces
/// \param execution  whose threads share the trimming of many faces
/// \throw Cancelled where its `proceed` says so
ConvertedModel convert_to_model(vtkDataObject* source, bool flip, const Execution& execution = {});

/// What is said of a face in field data.
struct FaceAttributes
{
  std::string name;      ///< `FaceName`; may be empty
  bool reversed = false; ///< `Orientation` is −1
  double tolerance = 0;  ///< `Tolerance` of its trim curves, model units
};

/// \param face where an array has several values, as those of Bézier cells, which one is the face's
/// \throw GeometryError where `Orientation` is neither 1 nor −1, `Tolerance` is negative or not
/// finite, or an array of several values has none for the face
FaceAttributes read_face_attributes(vtkFieldData* data, std::size_t face = 0);

/// A net of control points with its knots in the field data.
/// \throw GeometryError
Patch convert_net(vtkStructuredGrid* net);

/// Whether the blocks are those of a trimmed face: `Surface` and at least one that is called
/// `Loop …`.
bool is_trimmed_face(vtkMultiBlockDataSet* blocks);

/// A trimmed face: block `Surface`, a control net, and `Loop 0`, `Loop 1`, … in any order. A loop
/// is a multi-block of curves in the plane (u, v), z = 0, head to tail, or one of them alone: nets
/// of dimensions (n, 1, 1); where these have no `KnotsU`, and as vtkPolyData lines, polylines.
/// \param name becomes that of the surface's field data where there is one
/// \throw GeometryError naming the loop, the curve and the value
Face convert_trimmed_face(vtkMultiBlockDataSet* blocks, std::string& name);
/// The same without its region.
Face read_trimmed_face(vtkMultiBlockDataSet* blocks, std::string& name);

/// Bézier cells, grouped by the cell array `FaceId`; without it every cell is a face. The faces are
/// numbered from 0 by the values of `FaceId`, numbers that do not occur are faces without patches.
/// A face with a bad cell goes to `problems`. The field data `FaceName`, `Orientation` and
/// `Tolerance` have one value for all faces or one for each.
/// \throw GeometryError where nothing can be grouped (a bad `FaceId`)
ConvertedModel convert_bezier_cells(vtkUnstructuredGrid* cells);

/// Where control point (i, j) of a patch, i fastest, stands among the points of its
/// VTK_BEZIER_QUADRILATERAL: corners, then edges, then the inside.
std::vector<int> bezier_node_order(const std::array<int, 2>& degree);
/// The same for a VTK_BEZIER_CURVE: both ends, then the inside.
std::vector<int> bezier_node_order(int degree);

/// Weights from the active RationalWeights attribute, else the point array of that name; empty
/// where there is none. \throw GeometryError where they are no scalars.
Eigen::VectorXd read_weights(vtkDataSet* data);

/// All values of a field data array, whether stored as tuples or as components; empty if missing.
std::vector<double> read_field_array(vtkFieldData* data, const char* name);

/// The name of a block; empty where there is none.
std::string block_name(vtkInformation* meta_data);
std::string block_name(vtkMultiBlockDataSet* blocks, unsigned int number);

/// The data themselves, or what is in them where they are a partitioned data set of one piece; null
/// where there is none. \throw GeometryError where there are several pieces
vtkDataObject* single_piece(vtkDataObject* data);

} // namespace footpoint::conversion

#endif
