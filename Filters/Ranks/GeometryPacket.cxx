// SPDX-License-Identifier: BSD-3-Clause
#include "GeometryPacket.h"

#include "DataTree.h"
#include "GeometryArrays.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataObjectTree.h"
#include "vtkDataObjectTypes.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"
#include "vtkStructuredGrid.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <cstdint>
#include <cstring>

namespace footpoint::conversion
{

namespace
{

class Writer
{
public:
  std::vector<unsigned char> Bytes;

  void number(std::int64_t value) { this->raw(&value, sizeof(value)); }

  void raw(const void* data, std::size_t size)
  {
    const auto* first = static_cast<const unsigned char*>(data);
    this->Bytes.insert(this->Bytes.end(), first, first + size);
  }

  void text(const std::string& value)
  {
    this->number(static_cast<std::int64_t>(value.size()));
    this->raw(value.data(), value.size());
  }

  void array(vtkAbstractArray* array)
  {
    auto* const strings = vtkStringArray::SafeDownCast(array);
    auto* numbers = vtkDataArray::SafeDownCast(array);
    if (!strings && !numbers)
    {
      this->number(0);
      return;
    }
    this->number(array->GetDataType());
    this->number(array->GetNumberOfComponents());
    this->number(array->GetNumberOfTuples());
    if (strings)
    {
      for (vtkIdType i = 0; i < strings->GetNumberOfValues(); ++i)
      {
        this->text(strings->GetValue(i));
      }
      return;
    }
    vtkSmartPointer<vtkDataArray> plain = numbers;
    if (!numbers->HasStandardMemoryLayout())
    {
      plain.TakeReference(vtkDataArray::CreateDataArray(numbers->GetDataType()));
      plain->DeepCopy(numbers);
    }
    this->raw(plain->GetVoidPointer(0),
      static_cast<std::size_t>(plain->GetNumberOfValues()) * plain->GetDataTypeSize());
  }

  void cells(vtkCellArray* cells)
  {
    this->array(cells ? cells->GetOffsetsArray() : nullptr);
    this->array(cells ? cells->GetConnectivityArray() : nullptr);
  }

  void leaf(vtkDataObject* data)
  {
    for (const std::string& name : geometry_field_arrays())
    {
      this->array(
        data->GetFieldData() ? data->GetFieldData()->GetAbstractArray(name.c_str()) : nullptr);
    }
    auto* const points = vtkPointSet::SafeDownCast(data);
    if (!points)
    {
      return;
    }
    this->array(points->GetPoints() ? points->GetPoints()->GetData() : nullptr);
    for (const std::string& name : geometry_point_arrays())
    {
      this->array(find_geometry_array(points->GetPointData(), name));
    }
    if (auto* net = vtkStructuredGrid::SafeDownCast(data))
    {
      this->raw(net->GetExtent(), 6 * sizeof(int));
    }
    else if (auto* lines = vtkPolyData::SafeDownCast(data))
    {
      // Cells of other kinds are no geometry, but their presence is an error.
      for (vtkCellArray* some :
        { lines->GetVerts(), lines->GetLines(), lines->GetPolys(), lines->GetStrips() })
      {
        this->cells(some);
      }
    }
    else if (auto* cells = vtkUnstructuredGrid::SafeDownCast(data))
    {
      this->array(cells->GetCellTypesArray());
      this->cells(cells->GetCells());
      for (const std::string& name : geometry_cell_arrays())
      {
        this->array(find_geometry_array(cells->GetCellData(), name));
      }
    }
  }

  void object(vtkDataObject* data)
  {
    this->number(data ? data->GetDataObjectType() : -1);
    if (!data)
    {
      return;
    }
    auto* const tree = vtkDataObjectTree::SafeDownCast(data);
    if (!tree)
    {
      this->leaf(data);
      return;
    }
    this->number(number_of_children(tree));
    for (unsigned int i = 0; i < number_of_children(tree); ++i)
    {
      this->text(child_name(tree, i));
      this->object(child(tree, i));
    }
  }
};

class Reader
{
public:
  explicit Reader(const std::vector<unsigned char>& bytes)
    : Next(bytes.data())
  {
  }

  std::int64_t number()
  {
    std::int64_t value = 0;
    this->raw(&value, sizeof(value));
    return value;
  }

  void raw(void* data, std::size_t size)
  {
    if (size > 0)
    {
      std::memcpy(data, this->Next, size);
      this->Next += size;
    }
  }

  std::string text()
  {
    std::string value(static_cast<std::size_t>(this->number()), ' ');
    this->raw(&value[0], value.size());
    return value;
  }

  /// Null where there was none.
  vtkSmartPointer<vtkAbstractArray> array()
  {
    vtkSmartPointer<vtkAbstractArray> result;
    const int type = static_cast<int>(this->number());
    if (type == 0)
    {
      return result;
    }
    result.TakeReference(vtkAbstractArray::CreateArray(type));
    result->SetNumberOfComponents(static_cast<int>(this->number()));
    result->SetNumberOfTuples(this->number());
    if (auto* strings = vtkStringArray::SafeDownCast(result))
    {
      for (vtkIdType i = 0; i < strings->GetNumberOfValues(); ++i)
      {
        strings->SetValue(i, this->text());
      }
      return result;
    }
    this->raw(result->GetVoidPointer(0),
      static_cast<std::size_t>(result->GetNumberOfValues()) * result->GetDataTypeSize());
    return result;
  }

  vtkSmartPointer<vtkCellArray> cells()
  {
    const auto offsets = this->array();
    const auto connectivity = this->array();
    if (!offsets || !connectivity)
    {
      return nullptr;
    }
    auto result = vtkSmartPointer<vtkCellArray>::New();
    result->SetData(vtkDataArray::SafeDownCast(offsets), vtkDataArray::SafeDownCast(connectivity));
    return result;
  }

  void leaf(vtkDataObject* data)
  {
    for (const std::string& name : geometry_field_arrays())
    {
      if (const auto array = this->array())
      {
        array->SetName(name.c_str());
        data->GetFieldData()->AddArray(array);
      }
    }
    auto* const set = vtkPointSet::SafeDownCast(data);
    if (!set)
    {
      return;
    }
    if (const auto coordinates = this->array())
    {
      vtkNew<vtkPoints> points;
      points->SetData(vtkDataArray::SafeDownCast(coordinates));
      set->SetPoints(points);
    }
    for (const std::string& name : geometry_point_arrays())
    {
      add_geometry_array(set->GetPointData(), this->array(), name);
    }
    if (auto* net = vtkStructuredGrid::SafeDownCast(data))
    {
      int extent[6];
      this->raw(extent, sizeof(extent));
      net->SetExtent(extent);
    }
    else if (auto* lines = vtkPolyData::SafeDownCast(data))
    {
      lines->SetVerts(this->cells());
      lines->SetLines(this->cells());
      lines->SetPolys(this->cells());
      lines->SetStrips(this->cells());
    }
    else if (auto* grid = vtkUnstructuredGrid::SafeDownCast(data))
    {
      const auto types = this->array();
      const auto cells = this->cells();
      if (types && cells)
      {
        grid->SetCells(vtkUnsignedCharArray::SafeDownCast(types), cells);
      }
      for (const std::string& name : geometry_cell_arrays())
      {
        add_geometry_array(grid->GetCellData(), this->array(), name);
      }
    }
  }

  vtkSmartPointer<vtkDataObject> object()
  {
    vtkSmartPointer<vtkDataObject> result;
    const int type = static_cast<int>(this->number());
    if (type < 0)
    {
      return result;
    }
    result.TakeReference(vtkDataObjectTypes::NewDataObject(type));
    auto* const tree = vtkDataObjectTree::SafeDownCast(result);
    if (!tree)
    {
      this->leaf(result);
      return result;
    }
    const auto count = static_cast<unsigned int>(this->number());
    for (unsigned int i = 0; i < count; ++i)
    {
      const std::string name = this->text();
      set_child(tree, i, this->object(), name);
    }
    return result;
  }

private:
  const unsigned char* Next;
};

} // namespace

std::vector<unsigned char> pack_geometry(vtkDataObject* geometry)
{
  Writer writer;
  writer.object(geometry);
  return std::move(writer.Bytes);
}

vtkSmartPointer<vtkDataObject> unpack_geometry(const std::vector<unsigned char>& bytes)
{
  return Reader(bytes).object();
}

} // namespace footpoint::conversion
