// SPDX-License-Identifier: BSD-3-Clause
// Private: statistics of distances as field data and as a table.

#ifndef DeviationReport_h
#define DeviationReport_h

#include "footpoint/model/deviation_statistics.h"

#include <string>
#include <vector>

class vtkFieldData;
class vtkTable;

namespace footpoint::conversion
{

/// Writes `DistanceCount` … `OutOfToleranceFraction` with the prefix before their names.
void write_statistics(
  const DeviationStatistics& statistics, const std::string& prefix, vtkFieldData* data);

/// One row for each face of the model.
/// \param feet all points that count
void write_face_table(
  const std::vector<Foot>& feet, const Model& model, double tolerance, vtkTable* table);

} // namespace footpoint::conversion

#endif
