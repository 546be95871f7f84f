// SPDX-License-Identifier: BSD-3-Clause
// Private: the points of a data set, or of all leaves of a composite one, as one array.

#ifndef PointBlocks_h
#define PointBlocks_h

#include "footpoint/model/point_inversion.h"

#include "vtkType.h"

#include <vector>

class vtkDataObject;
class vtkDataSet;

namespace footpoint::conversion
{

/// A leaf of the input, or all of it, and its part of the array of all points.
struct Block
{
  vtkDataSet* output; ///< a shallow copy of the input, owned by the filter's output
  int flat_index;
  vtkIdType first;
  vtkIdType count;
};

struct PointBlocks
{
  std::vector<Block> blocks;
  Points gathered;
  /// Of all blocks: those gathered or, where it has them as they are needed, the input's own.
  Eigen::Map<const Points> queries{ nullptr, 3, 0 };
  std::vector<Start> starts; ///< empty, or one for each point
  bool composite = false;
  int skipped = 0; ///< leaves without points, which are passed as they are
};

/// Makes the output a shallow copy of the input and gathers its points, with their starts where a
/// block has the point array `SeedParameters`.
PointBlocks collect_points(vtkDataObject* input, vtkDataObject* output);

} // namespace footpoint::conversion

#endif
