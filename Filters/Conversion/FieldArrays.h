// SPDX-License-Identifier: BSD-3-Clause
// Private: small arrays of numbers as VTK arrays.

#ifndef FieldArrays_h
#define FieldArrays_h

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"

#include <array>

namespace footpoint::conversion
{

/// Adds an array of one component, or replaces the one of that name.
template <typename Array, typename Range>
void set_values(vtkFieldData* data, const char* name, const Range& values)
{
  vtkNew<Array> array;
  array->SetName(name);
  array->SetNumberOfValues(static_cast<vtkIdType>(values.size()));
  vtkIdType i = 0;
  for (const auto& value : values)
  {
    array->SetValue(i++, value);
  }
  data->AddArray(array);
}

template <typename Range>
void set_numbers(vtkFieldData* data, const char* name, const Range& values)
{
  set_values<vtkDoubleArray>(data, name, values);
}

template <typename Range>
void set_integers(vtkFieldData* data, const char* name, const Range& values)
{
  set_values<vtkIntArray>(data, name, values);
}

inline void set_number(vtkFieldData* data, const char* name, double value)
{
  set_numbers(data, name, std::array<double, 1>{ { value } });
}

inline void set_integer(vtkFieldData* data, const char* name, int value)
{
  set_integers(data, name, std::array<int, 1>{ { value } });
}

inline void set_count(vtkFieldData* data, const char* name, vtkIdType value)
{
  set_values<vtkIdTypeArray>(data, name, std::array<vtkIdType, 1>{ { value } });
}

} // namespace footpoint::conversion

#endif
