// SPDX-License-Identifier: BSD-3-Clause
#include "GeometryMerge.h"

#include "DataTree.h"
#include "GeometryArrays.h"
#include "GeometryHash.h"
#include "NetAssembly.h"
#include "SplineConversion.h"

#include "footpoint/common/errors.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkStructuredGrid.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>

namespace footpoint::conversion
{

namespace
{

/// What some rank has at a place.
struct Part
{
  vtkSmartPointer<vtkDataObject> data;
  std::string name; ///< of the block
};

using Parts = std::vector<Part>;

ContentHash hash_of(vtkDataObject* data)
{
  ContentHash hash;
  hash.add(data);
  return hash;
}

/// The parts with points, equal ones once; one without points where there are no others.
Parts distinct(const Parts& parts)
{
  Parts result;
  std::vector<ContentHash> hashes;
  for (const Part& part : parts)
  {
    if (!has_points(part.data))
    {
      continue;
    }
    const ContentHash hash = hash_of(part.data);
    if (std::find(hashes.begin(), hashes.end(), hash) == hashes.end())
    {
      hashes.push_back(hash);
      result.push_back(part);
    }
  }
  if (result.empty() && !parts.empty())
  {
    const auto any = std::find_if(
      parts.begin(), parts.end(), [](const Part& part) { return part.data != nullptr; });
    result.push_back(any != parts.end() ? *any : parts.front());
  }
  return result;
}

template <class Type>
bool all_are(const Parts& parts)
{
  return std::all_of(parts.begin(), parts.end(),
    [](const Part& part) { return Type::SafeDownCast(part.data) != nullptr; });
}

std::vector<vtkStructuredGrid*> nets_of(const Parts& parts)
{
  std::vector<vtkStructuredGrid*> nets;
  for (const Part& part : parts)
  {
    nets.push_back(vtkStructuredGrid::SafeDownCast(part.data));
  }
  return nets;
}

Part merge(const Parts& parts);

/// What the ranks have at one number of their trees.
Parts children_at(const Parts& trees, unsigned int number)
{
  Parts children;
  for (const Part& part : trees)
  {
    auto* const tree = vtkDataObjectTree::SafeDownCast(part.data);
    if (number < number_of_children(tree))
    {
      children.push_back({ child(tree, number), child_name(tree, number) });
    }
  }
  return children;
}

unsigned int most_children(const Parts& trees)
{
  unsigned int count = 0;
  for (const Part& part : trees)
  {
    count = std::max(count, number_of_children(vtkDataObjectTree::SafeDownCast(part.data)));
  }
  return count;
}

/// Whether each block is on one rank only, or the same on all that have it.
bool complement_each_other(const Parts& trees)
{
  for (unsigned int i = 0; i < most_children(trees); ++i)
  {
    const Parts children = distinct(children_at(trees, i));
    if (children.size() > 1 &&
      !(all_are<vtkStructuredGrid>(children) && are_parts_of_one_net(nets_of(children))))
    {
      return false;
    }
  }
  return true;
}

bool is_any_trimmed_face(const Parts& parts)
{
  return std::any_of(parts.begin(), parts.end(),
    [](const Part& part)
    {
      auto* const blocks = vtkMultiBlockDataSet::SafeDownCast(part.data);
      return blocks && is_trimmed_face(blocks);
    });
}

template <class Tree>
vtkSmartPointer<vtkDataObject> merge_children(const Parts& trees)
{
  auto result = vtkSmartPointer<Tree>::New();
  for (unsigned int i = 0; i < most_children(trees); ++i)
  {
    const Part merged = merge(children_at(trees, i));
    set_child(result, i, merged.data, merged.name);
  }
  return result;
}

/// Partitions have no numbers that ranks agree on: those of all follow each other.
vtkSmartPointer<vtkDataObject> merge_partitions(const Parts& trees)
{
  Parts all;
  for (unsigned int i = 0; i < most_children(trees); ++i)
  {
    const Parts children = children_at(trees, i);
    all.insert(all.end(), children.begin(), children.end());
  }
  all = distinct(all);
  if (all.size() > 1 && all_are<vtkStructuredGrid>(all) && are_parts_of_one_net(nets_of(all)))
  {
    all = { { assemble_net(nets_of(all)), all.front().name } };
  }
  auto result = vtkSmartPointer<vtkPartitionedDataSet>::New();
  for (const Part& part : all)
  {
    set_child(result, result->GetNumberOfPartitions(), part.data, part.name);
  }
  return result;
}

/// The array of all parts, one after the other; null where no part has it.
vtkSmartPointer<vtkAbstractArray> append_arrays(
  const Parts& parts, const std::string& name, bool of_points)
{
  vtkSmartPointer<vtkAbstractArray> result;
  for (const Part& part : parts)
  {
    auto* const cells = vtkUnstructuredGrid::SafeDownCast(part.data);
    vtkDataSetAttributes* const attributes =
      of_points ? static_cast<vtkDataSetAttributes*>(cells->GetPointData()) : cells->GetCellData();
    vtkAbstractArray* const array = find_geometry_array(attributes, name);
    const bool first = &part == &parts.front();
    if (!first &&
      (!array != !result ||
        (array && array->GetNumberOfComponents() != result->GetNumberOfComponents())))
    {
      throw GeometryError(GeometryDefect::Format,
        "the Bézier cells of the ranks do not go together: " + name +
          " is not on all, or has other components");
    }
    if (array && first)
    {
      result.TakeReference(vtkAbstractArray::CreateArray(array->GetDataType()));
      result->SetNumberOfComponents(array->GetNumberOfComponents());
    }
    if (array)
    {
      result->InsertTuples(result->GetNumberOfTuples(), array->GetNumberOfTuples(), 0, array);
    }
  }
  return result;
}

vtkSmartPointer<vtkDataObject> append_cells(const Parts& parts)
{
  auto result = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  result->Allocate();
  for (const Part& part : parts)
  {
    auto* const cells = vtkUnstructuredGrid::SafeDownCast(part.data);
    const vtkIdType first = points->GetNumberOfPoints();
    for (vtkIdType i = 0; i < cells->GetNumberOfPoints(); ++i)
    {
      points->InsertNextPoint(cells->GetPoint(i));
    }
    vtkNew<vtkIdList> ids;
    for (vtkIdType i = 0; i < cells->GetNumberOfCells(); ++i)
    {
      cells->GetCellPoints(i, ids);
      for (vtkIdType k = 0; k < ids->GetNumberOfIds(); ++k)
      {
        ids->SetId(k, ids->GetId(k) + first);
      }
      result->InsertNextCell(cells->GetCellType(i), ids);
    }
  }
  result->SetPoints(points);
  for (const std::string& name : geometry_point_arrays())
  {
    add_geometry_array(result->GetPointData(), append_arrays(parts, name, true), name);
  }
  for (const std::string& name : geometry_cell_arrays())
  {
    add_geometry_array(result->GetCellData(), append_arrays(parts, name, false), name);
  }
  result->GetFieldData()->ShallowCopy(parts.front().data->GetFieldData());
  return result;
}

/// Cells of one name, orientation and tolerance.
bool have_equal_fields(const Parts& parts)
{
  const auto hash = [](const Part& part)
  {
    ContentHash result;
    for (const std::string& name : geometry_field_arrays())
    {
      result.add(part.data->GetFieldData()->GetAbstractArray(name.c_str()));
    }
    return result;
  };
  return std::all_of(parts.begin(), parts.end(),
    [&](const Part& part) { return hash(part) == hash(parts.front()); });
}

vtkSmartPointer<vtkDataObject> side_by_side(const Parts& parts)
{
  auto result = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  for (const Part& part : parts)
  {
    set_child(result, result->GetNumberOfBlocks(), part.data, part.name);
  }
  return result;
}

/// \return a null block without a name where there is nothing
Part merge(const Parts& all)
{
  const Parts parts = distinct(all);
  if (parts.empty())
  {
    return {};
  }
  const std::string& name = parts.front().name;
  if (parts.size() == 1)
  {
    return parts.front();
  }
  if (all_are<vtkMultiBlockDataSet>(parts) &&
    (!is_any_trimmed_face(parts) || complement_each_other(parts)))
  {
    return { merge_children<vtkMultiBlockDataSet>(parts), name };
  }
  if (all_are<vtkPartitionedDataSetCollection>(parts))
  {
    return { merge_children<vtkPartitionedDataSetCollection>(parts), name };
  }
  if (all_are<vtkPartitionedDataSet>(parts))
  {
    return { merge_partitions(parts), name };
  }
  if (all_are<vtkStructuredGrid>(parts) && are_parts_of_one_net(nets_of(parts)))
  {
    return { assemble_net(nets_of(parts)), name };
  }
  if (all_are<vtkUnstructuredGrid>(parts) && have_equal_fields(parts))
  {
    return { append_cells(parts), name };
  }
  return { side_by_side(parts), name };
}

} // namespace

vtkSmartPointer<vtkDataObject> merge_geometry(
  const std::vector<vtkSmartPointer<vtkDataObject>>& parts)
{
  Parts named;
  for (const auto& part : parts)
  {
    named.push_back({ part, "" });
  }
  return merge(named).data;
}

} // namespace footpoint::conversion
