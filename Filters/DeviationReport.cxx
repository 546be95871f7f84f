// SPDX-License-Identifier: BSD-3-Clause
#include "DeviationReport.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <algorithm>
#include <cmath>

namespace footpoint::conversion
{

namespace
{

void replace(vtkFieldData* data, vtkAbstractArray* array)
{
  data->RemoveArray(array->GetName());
  data->AddArray(array);
}

void write_number(vtkFieldData* data, const std::string& name, double value)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name.c_str());
  array->InsertNextValue(value);
  replace(data, array);
}

/// A column of numbers, one for each face.
template <class Rows>
void add_column(vtkTable* table, const char* name, const Rows& rows,
  double (*value)(const typename Rows::value_type&))
{
  vtkNew<vtkDoubleArray> column;
  column->SetName(name);
  for (const auto& row : rows)
  {
    column->InsertNextValue(value(row));
  }
  table->AddColumn(column);
}

void write_statistics(
  const DeviationStatistics& statistics, const std::string& prefix, vtkFieldData* data)
{
  vtkNew<vtkIdTypeArray> count;
  count->SetName((prefix + "DistanceCount").c_str());
  count->InsertNextValue(static_cast<vtkIdType>(statistics.count));
  replace(data, count);
  write_number(data, prefix + "DistanceMinimum", statistics.minimum);
  write_number(data, prefix + "DistanceMaximum", statistics.maximum);
  write_number(data, prefix + "DistanceMean", statistics.mean);
  write_number(data, prefix + "DistanceRMS", statistics.rms);
  write_number(data, prefix + "DistanceStandardDeviation", statistics.standard_deviation);
  write_number(data, prefix + "DistancePercentile95", statistics.percentile95);
  vtkNew<vtkIdTypeArray> counts;
  counts->SetName((prefix + "StatusCounts").c_str());
  for (const std::int64_t number : statistics.status_counts)
  {
    counts->InsertNextValue(static_cast<vtkIdType>(number));
  }
  replace(data, counts);
  write_number(data, prefix + "OutOfToleranceFraction", statistics.out_of_tolerance_fraction);
}

void write_face_table(
  const std::vector<DeviationStatistics>& statistics, const Model& model, vtkTable* table)
{
  vtkNew<vtkIdTypeArray> ids;
  ids->SetName("FaceId");
  vtkNew<vtkStringArray> names;
  names->SetName("Name");
  vtkNew<vtkIdTypeArray> counts;
  counts->SetName("Count");
  for (std::size_t i = 0; i < model.size(); ++i)
  {
    ids->InsertNextValue(static_cast<vtkIdType>(i));
    names->InsertNextValue(model[i].name);
    counts->InsertNextValue(static_cast<vtkIdType>(statistics[i].count));
  }
  table->AddColumn(ids);
  table->AddColumn(names);
  table->AddColumn(counts);
  using Row = const DeviationStatistics&;
  add_column(table, "Minimum", statistics, [](Row row) { return row.minimum; });
  add_column(table, "Maximum", statistics, [](Row row) { return row.maximum; });
  add_column(table, "MaximumAbsolute", statistics,
    [](Row row) { return std::max(std::abs(row.minimum), std::abs(row.maximum)); });
  add_column(table, "Mean", statistics, [](Row row) { return row.mean; });
  add_column(table, "RMS", statistics, [](Row row) { return row.rms; });
  add_column(
    table, "StandardDeviation", statistics, [](Row row) { return row.standard_deviation; });
  add_column(table, "Percentile95", statistics, [](Row row) { return row.percentile95; });
  add_column(table, "OutOfToleranceFraction", statistics,
    [](Row row) { return row.out_of_tolerance_fraction; });
  using Part = const Face&;
  add_column(table, "Tolerance", model, [](Part face) { return face.tolerance; });
  add_column(table, "LargestGap", model,
    [](Part face) { return face.region ? face.region->largest_gap() : 0.0; });
}

} // namespace

DeviationReport::DeviationReport(const Model& model, vtkIdType count)
  : Geometry(model)
  , Distances(model.size(), static_cast<std::size_t>(count))
{
}

void DeviationReport::reduce(
  double tolerance, const Reduction& reduction, const Execution& execution)
{
  this->OfAll = this->Distances.of_all(tolerance, reduction, execution);
  // The feet of all points with a distance are on the only face.
  this->OfFaces = this->Geometry.size() == 1
    ? std::vector<DeviationStatistics>{ this->OfAll }
    : this->Distances.of_faces(tolerance, reduction, execution);
}

void DeviationReport::write_fields(
  const std::string& prefix, std::int64_t open_edges, vtkFieldData* data) const
{
  write_statistics(this->OfAll, prefix, data);
  vtkNew<vtkIdTypeArray> edges;
  edges->SetName((prefix + "OpenEdges").c_str());
  edges->InsertNextValue(static_cast<vtkIdType>(open_edges));
  replace(data, edges);
}

void DeviationReport::write_table(bool rows, vtkTable* table) const
{
  write_face_table(this->OfFaces, this->Geometry, table);
  if (!rows)
  {
    table->SetNumberOfRows(0);
  }
}

} // namespace footpoint::conversion
