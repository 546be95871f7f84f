// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSplineTessellator.h"

#include "AlgorithmExecution.h"
#include "FieldArrays.h"
#include "SourceGeometry.h"
#include "StructuredOutput.h"

#include "footpoint/tessellation/tessellation.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <new>
#include <stdexcept>

using namespace footpoint::conversion;

vtkStandardNewMacro(vtkSplineTessellator);

namespace
{

const char* const kModes[] = { "Adaptive", "Fixed" };

/// The columns of a matrix as the tuples of an array.
template <typename Matrix>
vtkSmartPointer<vtkDoubleArray> columns(const Matrix& matrix, const char* name)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(static_cast<int>(matrix.rows()));
  array->SetNumberOfTuples(static_cast<vtkIdType>(matrix.cols()));
  std::copy(matrix.data(), matrix.data() + matrix.size(), array->GetPointer(0));
  return array;
}

void fill_output(const footpoint::Tessellation& result, vtkPolyData* output)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetData(columns(result.points, "Points"));
  output->SetPoints(points);

  const auto lines = static_cast<vtkIdType>(result.lines.size());
  const auto triangles = static_cast<vtkIdType>(result.triangles.size());
  vtkNew<vtkIdTypeArray> faces; // cell data of lines come first
  faces->SetName("FaceId");
  faces->SetNumberOfValues(lines + triangles);
  std::copy(result.line_faces.begin(), result.line_faces.end(), faces->GetPointer(0));
  std::copy(
    result.triangle_faces.begin(), result.triangle_faces.end(), faces->GetPointer(0) + lines);
  output->GetCellData()->AddArray(faces);

  vtkNew<vtkCellArray> polylines;
  for (const std::vector<std::int64_t>& line : result.lines)
  {
    polylines->InsertNextCell(static_cast<int>(line.size()));
    for (const std::int64_t point : line)
    {
      polylines->InsertCellPoint(static_cast<vtkIdType>(point));
    }
  }
  output->SetLines(polylines);
  vtkNew<vtkCellArray> polygons;
  polygons->AllocateExact(triangles, 3 * triangles);
  for (const std::array<std::int64_t, 3>& triangle : result.triangles)
  {
    polygons->InsertNextCell({ static_cast<vtkIdType>(triangle[0]),
      static_cast<vtkIdType>(triangle[1]), static_cast<vtkIdType>(triangle[2]) });
  }
  output->SetPolys(polygons);

  if (triangles > 0)
  {
    output->GetPointData()->SetNormals(columns(result.normals, "Normals"));
  }
  output->GetPointData()->SetTCoords(columns(result.parameters, "Parameters"));
  set_number(output->GetFieldData(), "ChordTolerance", result.tolerance);
}

} // namespace

vtkSplineTessellator::vtkSplineTessellator()
  : ChordTolerance(footpoint::TessellationOptions().chord_tolerance)
  , AbsoluteTolerance(footpoint::TessellationOptions().absolute)
  , Resolution(footpoint::TessellationOptions().resolution)
{
}

const char* vtkSplineTessellator::GetModeAsString() const
{
  return kModes[this->Mode];
}

int vtkSplineTessellator::FillInputPortInformation(int, vtkInformation* info)
{
  fill_source_port_information(info);
  info->Remove(vtkAlgorithm::INPUT_IS_OPTIONAL());
  return 1;
}

int vtkSplineTessellator::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  request_whole_inputs(inputs[0]);
  return 1;
}

int vtkSplineTessellator::RequestData(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkPolyData* output = vtkPolyData::GetData(outputs);
  if (wants_nothing(request, outputs))
  {
    output->Initialize();
    return 1;
  }
  ConvertedModel converted;
  const InputState state =
    convert_input(this, vtkDataObject::GetData(inputs[0]), this->FlipNormals, converted);
  if (state != InputState::Ready)
  {
    output->Initialize();
    return state == InputState::Aborted ? 1 : 0;
  }

  // === Compute
  footpoint::TessellationOptions options;
  options.mode = static_cast<footpoint::TessellationMode>(this->Mode);
  options.chord_tolerance = this->ChordTolerance;
  options.absolute = this->AbsoluteTolerance;
  options.angle_tolerance = vtkMath::RadiansFromDegrees(this->AngleTolerance);
  options.resolution = this->Resolution;
  footpoint::Tessellation result;
  try
  {
    result = footpoint::tessellate(
      converted.model, options, part_of(make_execution(this), kReading, 1.0 - kReading));
  }
  catch (const std::bad_alloc&)
  {
    vtkErrorMacro("There is not enough memory for that many triangles.");
    return 0;
  }
  catch (const std::invalid_argument& error)
  {
    vtkErrorMacro(<< error.what());
    return 0;
  }
  for (const footpoint::TessellationProblem& problem : result.problems)
  {
    const std::string& name = converted.model[problem.face].name;
    vtkWarningMacro(<< "Face " << problem.face << (name.empty() ? "" : " ('" + name + "')") << ": "
                    << problem.message);
  }
  if (result.cancelled)
  {
    output->Initialize();
    return 1;
  }

  // === Attach
  fill_output(result, output);
  return 1;
}

void vtkSplineTessellator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Mode: " << this->GetModeAsString() << "\n";
  os << indent << "ChordTolerance: " << this->ChordTolerance << "\n";
  os << indent << "AbsoluteTolerance: " << (this->AbsoluteTolerance ? "On" : "Off") << "\n";
  os << indent << "AngleTolerance: " << this->AngleTolerance << "\n";
  os << indent << "Resolution: " << this->Resolution << "\n";
  os << indent << "FlipNormals: " << (this->FlipNormals ? "On" : "Off") << "\n";
}
