// SPDX-License-Identifier: BSD-3-Clause
#include "PointBlocks.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <new>

namespace footpoint::conversion
{

namespace
{

/// The coordinates of a block's points, in order; null where there is no such array.
template <typename Value>
const Value* coordinates(vtkDataSet* block)
{
  auto* const set = vtkPointSet::SafeDownCast(block);
  auto* const array = set && set->GetPoints()
    ? vtkAOSDataArrayTemplate<Value>::FastDownCast(set->GetPoints()->GetData())
    : nullptr;
  return array ? array->GetPointer(0) : nullptr;
}

/// Writes the points of a block to their places.
void gather_points(const Block& block, Points& points)
{
  auto places = points.middleCols(block.first, block.count);
  if (const auto* const doubles = coordinates<double>(block.output))
  {
    places = Eigen::Map<const Points>(doubles, 3, block.count);
  }
  else if (const auto* const floats = coordinates<float>(block.output))
  {
    places = Eigen::Map<const Eigen::Matrix3Xf>(floats, 3, block.count).cast<double>();
  }
  else
  {
    for (vtkIdType i = 0; i < block.count; ++i)
    {
      block.output->GetPoint(i, places.col(i).data());
    }
  }
}

/// Writes the starts of a block's points, if it has any, to their places among so many.
void gather_starts(const Block& block, vtkIdType total, std::vector<Start>& starts)
{
  vtkDataArray* seeds = block.output->GetPointData()->GetArray("SeedParameters");
  if (!seeds)
  {
    return;
  }
  vtkDataArray* faces = block.output->GetPointData()->GetArray("SeedFaceId");
  starts.resize(static_cast<std::size_t>(total));
  const int components = std::min(seeds->GetNumberOfComponents(), 2);
  for (vtkIdType i = 0; i < block.count; ++i)
  {
    Start& start = starts[static_cast<std::size_t>(block.first + i)];
    for (int k = 0; k < components; ++k)
    {
      start.parameter[k] = seeds->GetComponent(i, k);
    }
    const double face = faces ? faces->GetComponent(i, 0) : -1.0;
    start.face = face >= 0.0 && face <= VTK_INT_MAX ? static_cast<int>(face) : -1;
  }
}

} // namespace

PointBlocks collect_points(vtkDataObject* input, vtkDataObject* output)
{
  PointBlocks result;
  vtkIdType total = 0;
  const auto add = [&](vtkDataSet* block, int flat_index)
  {
    result.blocks.push_back({ block, flat_index, total, block->GetNumberOfPoints() });
    total += block->GetNumberOfPoints();
  };
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(input))
  {
    result.composite = true;
    auto* copies = vtkCompositeDataSet::SafeDownCast(output);
    copies->CopyStructure(composite);
    copies->GetFieldData()->ShallowCopy(composite->GetFieldData());
    vtkSmartPointer<vtkCompositeDataIterator> leaf;
    leaf.TakeReference(composite->NewIterator());
    for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
    {
      vtkDataObject* data = leaf->GetCurrentDataObject();
      vtkSmartPointer<vtkDataObject> copy;
      copy.TakeReference(data->NewInstance());
      copy->ShallowCopy(data);
      copies->SetDataSet(leaf, copy);
      if (auto* block = vtkDataSet::SafeDownCast(copy))
      {
        add(block, static_cast<int>(leaf->GetCurrentFlatIndex()));
      }
      else
      {
        ++result.skipped;
      }
    }
  }
  else
  {
    output->ShallowCopy(input);
    add(vtkDataSet::SafeDownCast(output), 0);
  }
  const double* points =
    result.blocks.size() == 1 ? coordinates<double>(result.blocks[0].output) : nullptr;
  if (!points)
  {
    result.gathered.resize(3, total);
    points = result.gathered.data();
  }
  for (const Block& block : result.blocks)
  {
    if (result.gathered.cols() > 0)
    {
      gather_points(block, result.gathered);
    }
    gather_starts(block, total, result.starts);
  }
  // A map is set anew by placement (as Eigen's documentation has it).
  new (&result.queries) Eigen::Map<const Points>(points, 3, total);
  return result;
}

} // namespace footpoint::conversion
