// SPDX-License-Identifier: BSD-3-Clause
// What the tests of files share: texts written and read, data compared to the bit.

#ifndef FileTesting_h
#define FileTesting_h

#include "FilterTesting.h"

#include "vtkCompositeDataSet.h"
#include "vtkInformation.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkSplineReader.h"
#include "vtkSplineWriter.h"
#include "vtkStringArray.h"

#include <cstring>
#include <fstream>

namespace testing
{

inline void WriteText(const std::string& path, const std::string& text)
{
  std::ofstream stream(path, std::ios::binary);
  stream << text;
  stream.close();
  CHECK(stream.good());
}

inline std::string ReadText(const std::string& path)
{
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

struct ReadResult
{
  vtkSmartPointer<vtkMultiBlockDataSet> data;
  std::string errors, warnings;
};

inline ReadResult ReadSplines(const std::string& path, int format = vtkSplineReader::AUTO)
{
  vtkNew<vtkSplineReader> reader;
  vtkNew<MessageRecorder> recorder;
  recorder->Watch(reader);
  reader->SetFileName(path.c_str());
  reader->SetFormat(format);
  reader->Update();
  return { reader->GetOutput(), recorder->Errors, recorder->Warnings };
}

struct WriteResult
{
  int result;
  std::string errors, warnings;
};

inline WriteResult WriteSplines(vtkDataObject* data, const std::string& path)
{
  vtkNew<vtkSplineWriter> writer;
  vtkNew<MessageRecorder> recorder;
  recorder->Watch(writer);
  writer->SetFileName(path.c_str());
  writer->SetInputDataObject(data);
  const int result = writer->Write();
  return { result, recorder->Errors, recorder->Warnings };
}

/// All texts with the message that each has to give; the output is empty then.
inline void CheckRefused(
  const std::string& path, const std::vector<std::pair<std::string, std::string>>& cases)
{
  for (const auto& [text, message] : cases)
  {
    WriteText(path, text);
    const ReadResult result = ReadSplines(path);
    if (!Contains(result.errors, path + ": ") || !Contains(result.errors, message))
    {
      throw std::runtime_error(
        "'" + text + "'\n gives: " + result.errors + "\n expected: " + message);
    }
    CHECK(result.data->GetNumberOfBlocks() == 0);
  }
}

/// A copy of a text with one part replaced, which has to be there.
inline std::string Replaced(std::string text, const std::string& from, const std::string& to)
{
  const std::size_t at = text.find(from);
  if (at == std::string::npos)
  {
    throw std::runtime_error("'" + from + "' is not in the text");
  }
  return text.replace(at, from.size(), to);
}

inline vtkStructuredGrid* Net(vtkMultiBlockDataSet* blocks, unsigned int number)
{
  auto* net = vtkStructuredGrid::SafeDownCast(blocks->GetBlock(number));
  CHECK(net != nullptr);
  return net;
}

inline std::array<int, 3> Dimensions(vtkStructuredGrid* net)
{
  std::array<int, 3> dimensions;
  net->GetDimensions(dimensions.data());
  return dimensions;
}

inline std::vector<double> FieldValues(vtkDataObject* data, const char* name)
{
  vtkDataArray* array = data->GetFieldData()->GetArray(name);
  std::vector<double> values;
  for (vtkIdType i = 0; array && i < array->GetNumberOfTuples(); ++i)
  {
    values.push_back(array->GetComponent(i, 0));
  }
  return values;
}

inline std::string NameOf(vtkMultiBlockDataSet* blocks, unsigned int number)
{
  vtkInformation* meta = blocks->HasMetaData(number) ? blocks->GetMetaData(number) : nullptr;
  const char* name = meta ? meta->Get(vtkCompositeDataSet::NAME()) : nullptr;
  return name ? name : "";
}

inline void Append(vtkMultiBlockDataSet* blocks, vtkDataObject* data, const std::string& name = "")
{
  const unsigned int number = blocks->GetNumberOfBlocks();
  blocks->SetBlock(number, data);
  if (!name.empty())
  {
    blocks->GetMetaData(number)->Set(vtkCompositeDataSet::NAME(), name.c_str());
  }
}

inline void SetName(vtkDataObject* data, const std::string& name)
{
  vtkNew<vtkStringArray> array;
  array->SetName("FaceName");
  array->InsertNextValue(name);
  data->GetFieldData()->AddArray(array);
}

/// True if all arrays of numbers and texts have the same names, types and bits.
inline bool SameArrays(vtkFieldData* a, vtkFieldData* b)
{
  if (a->GetNumberOfArrays() != b->GetNumberOfArrays())
  {
    return false;
  }
  for (int i = 0; i < a->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* one = a->GetAbstractArray(i);
    vtkAbstractArray* other = b->GetAbstractArray(one->GetName());
    auto* text = vtkStringArray::SafeDownCast(one);
    auto* other_text = vtkStringArray::SafeDownCast(other);
    const bool same = text || other_text
      ? text && other_text && text->GetValue(0) == other_text->GetValue(0)
      : other && SameBits(vtkDataArray::SafeDownCast(one), vtkDataArray::SafeDownCast(other));
    if (!same)
    {
      return false;
    }
  }
  return true;
}

/// True if two nets or composites have the same structure, names and bits.
inline bool SameSplines(vtkDataObject* a, vtkDataObject* b)
{
  if (!a || !b)
  {
    return !a && !b;
  }
  auto* blocks = vtkMultiBlockDataSet::SafeDownCast(a);
  auto* others = vtkMultiBlockDataSet::SafeDownCast(b);
  if (blocks && others)
  {
    bool same = blocks->GetNumberOfBlocks() == others->GetNumberOfBlocks();
    for (unsigned int i = 0; same && i < blocks->GetNumberOfBlocks(); ++i)
    {
      same = NameOf(blocks, i) == NameOf(others, i) &&
        SameSplines(blocks->GetBlock(i), others->GetBlock(i));
    }
    return same;
  }
  auto* net = vtkStructuredGrid::SafeDownCast(a);
  auto* other = vtkStructuredGrid::SafeDownCast(b);
  return net && other && std::equal(net->GetExtent(), net->GetExtent() + 6, other->GetExtent()) &&
    SameBits(net->GetPoints()->GetData(), other->GetPoints()->GetData()) &&
    SameArrays(net->GetFieldData(), other->GetFieldData()) &&
    SameArrays(net->GetPointData(), other->GetPointData()) &&
    (net->GetPointData()->GetRationalWeights() != nullptr) ==
    (other->GetPointData()->GetRationalWeights() != nullptr);
}

/// Small files of each format, for tests that spoil them.
namespace files
{

const char* const kGoTools = "100 1 0 0\n"
                             "2 1\n"
                             "3 3\n"
                             "0 0 0 1 1 1\n"
                             "1 0 1\n"
                             "0.5 +0.5 0.5\n"
                             "0 1 1\n\n"
                             "200 1 0 4 255 0 -5 255\n"
                             "3 0\n"
                             "2 2\n0 0 2 2\n"
                             "3 2\n0 0 1.5 3 3\n"
                             "0 0 0\n1 0 0\n0 1 0.1\n1 1 1e-3\n0 2 0\n1 2 0\n";

const char* const kGPlusSmo = R"(<?xml version="1.0" encoding="UTF-8"?>
<!-- a comment -->
<xml>
 <Geometry type="Nurbs" id="4" label="arc &amp; &quot;more&quot;">
  <Basis type="NurbsBasis">
   <Basis type="BSplineBasis">
    <KnotVector degree="2">0 0 0 1 1 1</KnotVector>
   </Basis>
   <weights>1 0.5 1</weights>
  </Basis>
  <coefs geoDim="2">1 0  1 1
   0 1</coefs>
 </Geometry>
 <Geometry type="TensorBSpline2" id="7">
  <Basis type="TensorBSplineBasis2">
   <Basis type="BSplineBasis" index="0"><KnotVector degree="1">0 0 2 2</KnotVector></Basis>
   <Basis type="BSplineBasis" index="1"><KnotVector degree="1">0 0 1.5 3 3</KnotVector></Basis>
  </Basis>
  <coefs geoDim="3">0 0 0 1 0 0 0 1 0.1 1 1 1e-3 0 2 0 1 2 0</coefs>
 </Geometry>
</xml>
)";

const char* const kGeomdl = R"({
 "shape": {
  "type": "surface",
  "count": 2,
  "data": [
   {
    "type": "spline", "rational": false, "dimension": 3,
    "degree_u": 1, "degree_v": 1,
    "knotvector_u": [0, 0, 2, 2],
    "knotvector_v": [0, 0, 1.5, 3, 3],
    "size_u": 2, "size_v": 3,
    "control_points": {
     "points": [[0, 0, 0], [0, 1, 0.1], [0, 2, 0], [1, 0, 0], [1, 1, 1e-3], [1, 2, 0]]
    },
    "delta": [0.1, 0.1], "name": "sheet", "reversed": 1
   },
   {
    "degree_u": 1, "degree_v": 1,
    "knotvector_u": [0, 0, 1, 1], "knotvector_v": [0, 0, 1, 1],
    "size_u": 2, "size_v": 2,
    "control_points": {
     "points": [[0, 0, 0], [0, 1, 0], [1, 0, 0], [1, 1, 0]],
     "weights": [1, 2, 3, 4]
    },
    "trims": {
     "count": 1,
     "data": [
      {
       "type": "spline", "rational": true, "degree": 2,
       "knotvector": [0, 0, 0, 0.5, 0.5, 1, 1, 1],
       "control_points": {
        "points": [[0.25, 0.5], [0.25, 0.75], [0.5, 0.75], [0.75, 0.75], [0.25, 0.5]],
        "weights": [1, 0.5, 1, 0.5, 1]
       },
       "reversed": 0
      }
     ]
    }
   }
  ]
 }
}
)";

} // namespace files

} // namespace testing

#endif
