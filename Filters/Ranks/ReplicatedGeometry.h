// SPDX-License-Identifier: BSD-3-Clause
// Private: the geometry of a filter, whole on every rank.

#ifndef ReplicatedGeometry_h
#define ReplicatedGeometry_h

#include "GeometryHash.h"
#include "SourceGeometry.h"

#include "vtkSmartPointer.h"

class vtkDataObject;

namespace footpoint::conversion
{

class Ranks;

/// Readers give geometry that is asked for whole to every rank, distributed producers give each
/// rank its own part, and some producers are on one rank only. So ranks compare the content of what
/// they have: where all have the same, nothing is sent; else those that lack it, or all where the
/// parts differ, get the others', which merge_geometry() puts together. What was put together is
/// kept as long as no rank's part changes.
class ReplicatedGeometry
{
public:
  /// Collective.
  /// \param own what this rank has; a source without points counts as none
  /// \return the same geometry on all ranks (one that does not exist where no rank has any); its
  /// source is the own one or kept by this object until the next call
  /// \throw GeometryError on all ranks: where parts do not go together, where one of several single
  /// nets is bad, or where parametric functions are not the same on all ranks
  SourceGeometry update(const SourceGeometry& own, const Ranks& ranks);

private:
  vtkSmartPointer<vtkDataObject> exchange(const SourceGeometry& own, const Ranks& ranks,
    const std::vector<std::vector<std::uint64_t>>& states) const;

  vtkSmartPointer<vtkDataObject> Merged;
  ContentHash Parts; ///< of all ranks, which `Merged` was made from
};

} // namespace footpoint::conversion

#endif
