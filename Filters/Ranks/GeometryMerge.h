// SPDX-License-Identifier: BSD-3-Clause
// Private: one geometry from what different ranks have of it.

#ifndef GeometryMerge_h
#define GeometryMerge_h

#include "vtkSmartPointer.h"

#include <vector>

class vtkDataObject;

namespace footpoint::conversion
{

/// Puts together what the ranks have, place by place in the tree of a composite data set (its flat
/// indices):
/// - what is null or has no points gives way to what has, and equal content counts once;
/// - blocks are put together number by number; a rank may have fewer than another;
/// - parts of one control net (equal knots and other field data, another extent) are put together
///   again;
/// - Bézier cells follow each other in the order of the ranks (equal FaceId: one face);
/// - what else differs stands side by side in a multi-block at that place, in the order of the
/// ranks.
///   So do trimmed faces as wholes, unless each only has blocks that another lacks.
/// \param parts by rank; may be null
/// \return null where all are
/// \throw GeometryError where a control point of a net that was cut is missing or has two values
vtkSmartPointer<vtkDataObject> merge_geometry(
  const std::vector<vtkSmartPointer<vtkDataObject>>& parts);

} // namespace footpoint::conversion

#endif
