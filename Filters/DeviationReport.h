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

/// Statistics of the points that count, whose feet are given one by one; of all ranks together.
class DeviationReport
{
public:
  /// \param model outlives the report
  /// \param count points, at most
  DeviationReport(const Model& model, vtkIdType count);

  void add(const Foot& foot) { this->Distances.add(foot); }

  /// Collective: puts the statistics of all ranks together, the same on each.
  void reduce(double tolerance, const Reduction& reduction, const Execution& execution);

  /// Writes `DistanceCount` … `OutOfToleranceFraction` and `OpenEdges` with the prefix before their
  /// names.
  void write_fields(const std::string& prefix, std::int64_t open_edges, vtkFieldData* data) const;

  /// Writes a row for each face of the model or, so that ranks together have each row once, the
  /// empty columns alone.
  void write_table(bool rows, vtkTable* table) const;

private:
  const Model& Geometry;
  Deviations Distances;
  DeviationStatistics OfAll;
  std::vector<DeviationStatistics> OfFaces;
};

} // namespace footpoint::conversion

#endif
