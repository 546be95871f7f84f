// SPDX-License-Identifier: BSD-3-Clause
#include "FootRecord.h"

#include "vtkCellArray.h"
#include "vtkDataSet.h"
#include "vtkIdList.h"
#include "vtkIntArray.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <numeric>

namespace footpoint::conversion
{

namespace
{

constexpr int kGhost = vtkDataSetAttributes::DUPLICATEPOINT | vtkDataSetAttributes::HIDDENPOINT;

} // namespace

FootRecord::FootRecord(const PointBlocks& points, const FootArrayLayout& layout, const Model& model,
  bool several, bool segments)
  : Points(points)
  , Layout(layout)
  , Several(several)
  , Segments(segments)
  , Report(model, points.queries.cols())
  , RowsOfBlock(points.blocks.size(), 0)
{
  for (const Block& block : points.blocks)
  {
    this->Arrays.emplace_back(layout, block.count);
  }
  this->PointIds->SetName((layout.prefix + "PointId").c_str());
  this->PointIds->Allocate(points.queries.cols() * (segments ? 2 : 1));
}

void FootRecord::add_row(const Foot& foot, vtkIdType point)
{
  for (int k = 0; k < (this->Segments ? 2 : 1) && has_foot(foot); ++k)
  {
    this->PointIds->InsertNextValue(point);
    if (this->Several)
    {
      this->Feet.push_back(foot);
    }
  }
}

void FootRecord::take(vtkIdType first, const InversionResult& part)
{
  std::size_t next = 0; // of all_feet, which are in the order of the points
  for (std::size_t b = 0; b < this->Arrays.size(); ++b)
  {
    const Block& block = this->Points.blocks[b];
    const vtkIdType begin = std::max(first, block.first);
    const vtkIdType end =
      std::min(first + static_cast<vtkIdType>(part.feet.size()), block.first + block.count);
    if (begin >= end)
    {
      continue;
    }
    const Foot* foot = part.feet.data() + (begin - first);
    this->Arrays[b].write(begin - block.first, foot, end - begin);

    auto* const ghosts = vtkUnsignedCharArray::SafeDownCast(
      block.output->GetPointData()->GetArray(vtkDataSetAttributes::GhostArrayName()));
    const vtkIdType rows = this->PointIds->GetNumberOfValues();
    for (vtkIdType i = begin; i < end; ++i, ++foot)
    {
      const vtkIdType point = i - block.first;
      if (!ghosts || (ghosts->GetValue(point) & kGhost) == 0)
      {
        this->Report.add(*foot);
      }
      const std::size_t before = next;
      for (; next < part.all_feet.size() && part.all_feet_point[next] == i; ++next)
      {
        this->add_row(part.all_feet[next], point);
      }
      // Where all feet were not asked for, or none of a point converged: the nearest.
      if (next == before)
      {
        this->add_row(*foot, point);
      }
    }
    this->RowsOfBlock[b] += this->PointIds->GetNumberOfValues() - rows;
  }
}

void FootRecord::attach() const
{
  for (std::size_t b = 0; b < this->Arrays.size(); ++b)
  {
    this->Arrays[b].attach_to(this->Points.blocks[b].output->GetPointData());
  }
}

FootArrays FootRecord::rows() const
{
  const vtkIdType count = this->PointIds->GetNumberOfValues();
  if (!this->Several && !this->Segments && this->Arrays.size() == 1 &&
    this->Arrays[0].count() == count)
  {
    return this->Arrays[0];
  }
  FootArrays result(this->Layout, count);
  if (this->Several)
  {
    result.write(0, this->Feet.data(), count);
    return result;
  }
  vtkIdType row = 0;
  for (std::size_t b = 0; b < this->Arrays.size(); ++b)
  {
    vtkNew<vtkIdList> to;
    vtkNew<vtkIdList> from;
    to->SetNumberOfIds(this->RowsOfBlock[b]);
    from->SetNumberOfIds(this->RowsOfBlock[b]);
    for (vtkIdType k = 0; k < this->RowsOfBlock[b]; ++k, ++row)
    {
      to->SetId(k, row);
      from->SetId(k, this->PointIds->GetValue(row));
    }
    result.copy(to, this->Arrays[b], from);
  }
  return result;
}

void FootRecord::fill_foot_points(vtkPolyData* output) const
{
  const FootArrays rows = this->rows();
  const vtkIdType count = rows.count();

  vtkNew<vtkDoubleArray> positions;
  this->Segments ? positions->DeepCopy(rows.points()) : positions->ShallowCopy(rows.points());
  positions->SetName("Points"); // as is usual
  vtkNew<vtkIntArray> block_ids;
  block_ids->SetName((this->Layout.prefix + "BlockId").c_str());
  if (this->Points.composite || this->Segments)
  {
    block_ids->SetNumberOfValues(count);
    vtkIdType row = 0;
    for (std::size_t b = 0; b < this->Arrays.size(); ++b)
    {
      const Block& block = this->Points.blocks[b];
      for (vtkIdType k = 0; k < this->RowsOfBlock[b]; ++k, ++row)
      {
        block_ids->SetValue(row, block.flat_index);
        if (this->Segments && row % 2 == 0)
        {
          positions->SetTypedTuple(
            row, this->Points.queries.col(block.first + this->PointIds->GetValue(row)).data());
        }
      }
    }
  }
  vtkNew<vtkPoints> points;
  points->SetData(positions);
  output->SetPoints(points);

  vtkNew<vtkIdTypeArray> corners;
  corners->SetNumberOfValues(count);
  std::iota(corners->GetPointer(0), corners->GetPointer(0) + count, 0);
  vtkNew<vtkCellArray> cells;
  cells->SetData(this->Segments ? 2 : 1, corners);
  this->Segments ? output->SetLines(cells) : output->SetVerts(cells);

  vtkPointData* attributes = output->GetPointData();
  rows.attach_to(attributes);
  this->PointIds->Squeeze();
  attributes->AddArray(this->PointIds);
  if (this->Points.composite)
  {
    attributes->AddArray(block_ids);
  }
  if (this->Layout.normal && this->Layout.has_surfaces)
  {
    attributes->SetActiveNormals((this->Layout.prefix + "Normal").c_str());
  }
}

} // namespace footpoint::conversion
