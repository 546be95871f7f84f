// SPDX-License-Identifier: BSD-3-Clause
#include "DataTree.h"

#include "SplineConversion.h"

#include "vtkCompositeDataSet.h"
#include "vtkDataSet.h"
#include "vtkInformation.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkMultiPieceDataSet.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPartitionedDataSetCollection.h"

namespace footpoint::conversion
{

namespace
{

/// Calls the body with the tree as what it is; trees of other kinds have no children here.
template <class Result, class Body>
Result with_type(vtkDataObjectTree* tree, Result otherwise, const Body& body)
{
  if (auto* blocks = vtkMultiBlockDataSet::SafeDownCast(tree))
  {
    return body(blocks);
  }
  if (auto* collection = vtkPartitionedDataSetCollection::SafeDownCast(tree))
  {
    return body(collection);
  }
  // A multi-piece data set, too.
  if (auto* pieces = vtkPartitionedDataSet::SafeDownCast(tree))
  {
    return body(pieces);
  }
  return otherwise;
}

unsigned int count_of(vtkMultiBlockDataSet* tree)
{
  return tree->GetNumberOfBlocks();
}
unsigned int count_of(vtkPartitionedDataSetCollection* tree)
{
  return tree->GetNumberOfPartitionedDataSets();
}
unsigned int count_of(vtkPartitionedDataSet* tree)
{
  return tree->GetNumberOfPartitions();
}

vtkDataObject* child_of(vtkMultiBlockDataSet* tree, unsigned int number)
{
  return tree->GetBlock(number);
}
vtkDataObject* child_of(vtkPartitionedDataSetCollection* tree, unsigned int number)
{
  return tree->GetPartitionedDataSet(number);
}
vtkDataObject* child_of(vtkPartitionedDataSet* tree, unsigned int number)
{
  return tree->GetPartitionAsDataObject(number);
}

void put(vtkMultiBlockDataSet* tree, unsigned int number, vtkDataObject* data)
{
  tree->SetBlock(number, data);
}
void put(vtkPartitionedDataSetCollection* tree, unsigned int number, vtkDataObject* data)
{
  if (data) // null is refused; what comes later leaves the gap
  {
    tree->SetPartitionedDataSet(number, vtkPartitionedDataSet::SafeDownCast(data));
  }
}
void put(vtkPartitionedDataSet* tree, unsigned int number, vtkDataObject* data)
{
  tree->SetPartition(number, data);
}

} // namespace

unsigned int number_of_children(vtkDataObjectTree* tree)
{
  return with_type(tree, 0u, [](auto* typed) { return count_of(typed); });
}

vtkDataObject* child(vtkDataObjectTree* tree, unsigned int number)
{
  vtkDataObject* const none = nullptr;
  return with_type(tree, none,
    [&](auto* typed) { return number < count_of(typed) ? child_of(typed, number) : nullptr; });
}

std::string child_name(vtkDataObjectTree* tree, unsigned int number)
{
  return with_type(tree, std::string(),
    [&](auto* typed)
    {
      const bool named = number < count_of(typed) && typed->HasMetaData(number);
      return block_name(named ? typed->GetMetaData(number) : nullptr);
    });
}

void set_child(
  vtkDataObjectTree* tree, unsigned int number, vtkDataObject* data, const std::string& name)
{
  with_type(tree, false,
    [&](auto* typed)
    {
      put(typed, number, data);
      if (!name.empty() && number < count_of(typed))
      {
        typed->GetMetaData(number)->Set(vtkCompositeDataSet::NAME(), name.c_str());
      }
      return true;
    });
}

bool has_points(vtkDataObject* data)
{
  if (auto* tree = vtkDataObjectTree::SafeDownCast(data))
  {
    for (unsigned int i = 0; i < number_of_children(tree); ++i)
    {
      if (has_points(child(tree, i)))
      {
        return true;
      }
    }
    return false;
  }
  auto* set = vtkDataSet::SafeDownCast(data);
  return set ? set->GetNumberOfPoints() > 0 : data != nullptr;
}

} // namespace footpoint::conversion
