// SPDX-License-Identifier: BSD-3-Clause
#include "PointBlocks.h"

#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>

namespace footpoint::conversion
{

namespace
{

/// True for points that are no ghosts and not hidden; empty where all are so.
std::vector<char> visible_points(vtkDataSet* block)
{
  std::vector<char> visible;
  auto* ghosts = vtkUnsignedCharArray::SafeDownCast(
    block->GetPointData()->GetArray(vtkDataSetAttributes::GhostArrayName()));
  if (ghosts)
  {
    const int skipped = vtkDataSetAttributes::DUPLICATEPOINT | vtkDataSetAttributes::HIDDENPOINT;
    for (vtkIdType i = 0; i < ghosts->GetNumberOfTuples(); ++i)
    {
      visible.push_back((ghosts->GetValue(i) & skipped) == 0);
    }
  }
  return visible;
}

/// Writes the points of a block, and their starts, to their places.
void gather_points(vtkDataSet* block, vtkIdType first, Points& points, std::vector<Start>& starts)
{
  const vtkIdType count = block->GetNumberOfPoints();
  for (vtkIdType i = 0; i < count; ++i)
  {
    block->GetPoint(i, points.col(first + i).data());
  }
  vtkDataArray* seeds = block->GetPointData()->GetArray("SeedParameters");
  if (!seeds)
  {
    return;
  }
  vtkDataArray* faces = block->GetPointData()->GetArray("SeedFaceId");
  starts.resize(static_cast<std::size_t>(points.cols()));
  const int components = std::min(seeds->GetNumberOfComponents(), 2);
  for (vtkIdType i = 0; i < count; ++i)
  {
    Start& start = starts[static_cast<std::size_t>(first + i)];
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
  result.queries.resize(3, total);
  for (const Block& block : result.blocks)
  {
    gather_points(block.output, block.first, result.queries, result.starts);
  }
  return result;
}

std::vector<TaggedFoot> PointBlocks::tagged_feet(const InversionResult& result) const
{
  std::vector<TaggedFoot> feet;
  std::size_t next = 0; // of all_feet, which are in the order of the points
  for (const Block& block : this->blocks)
  {
    const vtkIdType end = block.first + block.count;
    const auto add = [&](const Foot& foot, vtkIdType at)
    {
      if (has_foot(foot))
      {
        feet.push_back({ foot, this->queries.col(at), at - block.first, block.flat_index });
      }
    };
    for (vtkIdType i = block.first; i < end; ++i)
    {
      const std::size_t first = next;
      for (; next < result.all_feet.size() && result.all_feet_point[next] == i; ++next)
      {
        add(result.all_feet[next], i);
      }
      // Where all feet were not asked for, or none of a point converged: the nearest.
      if (next == first)
      {
        add(result.feet[i], i);
      }
    }
  }
  return feet;
}

std::vector<Foot> PointBlocks::counting_feet(const InversionResult& result) const
{
  std::vector<Foot> feet;
  feet.reserve(result.feet.size());
  for (const Block& block : this->blocks)
  {
    const std::vector<char> visible = visible_points(block.output);
    for (vtkIdType i = 0; i < block.count; ++i)
    {
      if (visible.empty() || visible[i])
      {
        feet.push_back(result.feet[block.first + i]);
      }
    }
  }
  return feet;
}

} // namespace footpoint::conversion
