// SPDX-License-Identifier: BSD-3-Clause
#include "GeometryHash.h"

#include "GeometryArrays.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataObjectTree.h"
#include "vtkDataObjectTreeIterator.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"
#include "vtkStructuredGrid.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <cstring>

namespace footpoint::conversion
{

namespace
{

std::uint64_t mix(std::uint64_t word)
{
  word ^= word >> 33;
  word *= 0xff51afd7ed558ccdu;
  word ^= word >> 33;
  word *= 0xc4ceb9fe1a85ec53u;
  return word ^ (word >> 33);
}

void add_cells(ContentHash& hash, vtkCellArray* cells)
{
  hash.add(cells ? cells->GetOffsetsArray() : nullptr);
  hash.add(cells ? cells->GetConnectivityArray() : nullptr);
}

void add_leaf(ContentHash& hash, vtkDataObject* leaf)
{
  for (const std::string& name : geometry_field_arrays())
  {
    hash.add(leaf->GetFieldData() ? leaf->GetFieldData()->GetAbstractArray(name.c_str()) : nullptr);
  }
  auto* points = vtkPointSet::SafeDownCast(leaf);
  if (!points)
  {
    return;
  }
  hash.add(points->GetPoints() ? points->GetPoints()->GetData() : nullptr);
  for (const std::string& name : geometry_point_arrays())
  {
    hash.add(find_geometry_array(points->GetPointData(), name));
  }
  if (auto* net = vtkStructuredGrid::SafeDownCast(leaf))
  {
    hash.add_bytes(net->GetExtent(), 6 * sizeof(int));
  }
  else if (auto* lines = vtkPolyData::SafeDownCast(leaf))
  {
    add_cells(hash, lines->GetLines());
    hash.add(static_cast<std::uint64_t>(lines->GetNumberOfCells()));
  }
  else if (auto* cells = vtkUnstructuredGrid::SafeDownCast(leaf))
  {
    hash.add(cells->GetCellTypesArray());
    add_cells(hash, cells->GetCells());
    for (const std::string& name : geometry_cell_arrays())
    {
      hash.add(find_geometry_array(cells->GetCellData(), name));
    }
  }
}

} // namespace

void ContentHash::add(std::uint64_t word)
{
  this->A = mix(this->A ^ word) + 0x9e3779b97f4a7c15u;
  this->B = (mix(this->B + word) ^ (this->B << 7)) * 0x87c37b91114253d5u + 1;
}

void ContentHash::add(double value)
{
  std::uint64_t word;
  std::memcpy(&word, &value, sizeof(word));
  this->add(word);
}

void ContentHash::add(const std::string& text)
{
  this->add_bytes(text.data(), text.size());
}

void ContentHash::add_bytes(const void* bytes, std::size_t count)
{
  this->add(static_cast<std::uint64_t>(count));
  const auto* next = static_cast<const unsigned char*>(bytes);
  for (std::size_t left = count; left > 0;)
  {
    const std::size_t part = left < 8 ? left : 8;
    std::uint64_t word = 0;
    std::memcpy(&word, next, part);
    this->add(word);
    next += part;
    left -= part;
  }
}

void ContentHash::add(vtkAbstractArray* array)
{
  if (!array)
  {
    this->add(std::uint64_t{ 0 });
    return;
  }
  this->add(static_cast<std::uint64_t>(array->GetDataType()) + 1);
  this->add(static_cast<std::uint64_t>(array->GetNumberOfComponents()));
  if (auto* strings = vtkStringArray::SafeDownCast(array))
  {
    for (vtkIdType i = 0; i < strings->GetNumberOfValues(); ++i)
    {
      this->add(static_cast<const std::string&>(strings->GetValue(i)));
    }
  }
  else if (auto* numbers = vtkDataArray::SafeDownCast(array))
  {
    if (numbers->HasStandardMemoryLayout())
    {
      this->add_bytes(numbers->GetVoidPointer(0),
        static_cast<std::size_t>(numbers->GetNumberOfValues()) * numbers->GetDataTypeSize());
      return;
    }
    const int components = numbers->GetNumberOfComponents();
    for (vtkIdType i = 0; i < numbers->GetNumberOfValues(); ++i)
    {
      this->add(numbers->GetComponent(i / components, static_cast<int>(i % components)));
    }
  }
}

void ContentHash::add(vtkDataObject* geometry)
{
  if (!geometry)
  {
    this->add(std::uint64_t{ 0 });
    return;
  }
  this->add(static_cast<std::uint64_t>(geometry->GetDataObjectType()) + 1);
  auto* tree = vtkDataObjectTree::SafeDownCast(geometry);
  if (!tree)
  {
    add_leaf(*this, geometry);
    return;
  }
  // Null blocks and inner nodes count: they decide about the numbers and kinds of faces.
  vtkSmartPointer<vtkDataObjectTreeIterator> iterator;
  iterator.TakeReference(tree->NewTreeIterator());
  iterator->SkipEmptyNodesOff();
  iterator->VisitOnlyLeavesOff();
  iterator->TraverseSubTreeOff();
  for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
  {
    vtkInformation* meta =
      iterator->HasCurrentMetaData() ? iterator->GetCurrentMetaData() : nullptr;
    const char* name = meta ? meta->Get(vtkCompositeDataSet::NAME()) : nullptr;
    this->add(std::string(name ? name : ""));
    this->add(iterator->GetCurrentDataObject());
  }
  this->add(std::uint64_t{ 1 });
}

} // namespace footpoint::conversion
