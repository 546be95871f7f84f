// SPDX-License-Identifier: BSD-3-Clause
// Private: statistics of distances as field data and as a table.

#ifndef DeviationReport_h
#define DeviationReport_h

#include "footpoint/model/deviation_statistics.h"

#include "vtkType.h"

#include <string>
#include <vector>

class vtkFieldData;
class vtkTable;

namespace footpoint::conversion
{

/// Statistics of the points that count, whose feet are given one by one.
class DeviationReport
{
public:
  /// \param model outlives the report
  /// \param count points, at most
  DeviationReport(const Model& model, vtkIdType count);

  void add(const Foot& foot)
  {
    this->All.add(foot);
    if (this->Faces.size() > 1 && foot.face >= 0)
    {
      this->Faces[static_cast<std::size_t>(foot.face)].add(foot);
    }
  }

  /// Writes `DistanceCount` … `OutOfToleranceFraction` and `OpenEdges` with the prefix before their
  /// names, and a row of the table for each face of the model.
  void write(double tolerance, const std::string& prefix, std::int64_t open_edges,
    vtkFieldData* data, vtkTable* table) const;

private:
  const Model& Geometry;
  Deviations All;
  std::vector<Deviations> Faces; ///< stay empty where one face has all feet
};

} // namespace footpoint::conversion

#endif
