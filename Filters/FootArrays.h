// SPDX-License-Identifier: BSD-3-Clause
// Private: feet of the core as arrays of VTK.

#ifndef FootArrays_h
#define FootArrays_h

#include "footpoint/model/point_inversion.h"

#include "vtkType.h"

#include <string>
#include <vector>

class vtkDataSetAttributes;
class vtkPolyData;

namespace footpoint::conversion
{

/// Which arrays there are and how they are called: the same for every block and output.
struct FootArrayLayout
{
  std::string prefix;
  bool has_curves = false;
  bool has_surfaces = false;
  bool parameters = true;
  bool distance = true;
  bool signed_distance = true;
  bool closest_point = true;
  bool normal = true;
  bool tangent = true;
  bool face_id = true;
  bool status = true;
  bool foot_type = true;
  bool isolated = true;
  bool iterations = true;
};

/// Sets has_curves and has_surfaces.
void describe_model(const Model& model, FootArrayLayout& layout);

/// False at Status 3 and 4.
bool has_foot(const Foot& foot);

/// Adds the arrays, replacing those of their names, and makes the signed distance (or the distance)
/// the active scalars.
/// \param repeat every foot is written that many times in a row
void attach_feet(const Foot* feet, vtkIdType count, int repeat, const FootArrayLayout& layout,
  vtkDataSetAttributes* attributes);

/// A foot and the point it belongs to.
struct TaggedFoot
{
  Foot foot;
  Vector3 query;
  vtkIdType point; ///< in its block
  int block;       ///< flat composite index
};

/// Vertices at the feet, or segments from each query point to its foot.
/// \param with_blocks also make the array `BlockId`
void fill_foot_points(const std::vector<TaggedFoot>& feet, bool segments, bool with_blocks,
  const FootArrayLayout& layout, vtkPolyData* output);

} // namespace footpoint::conversion

#endif
