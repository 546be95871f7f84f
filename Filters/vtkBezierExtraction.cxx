// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBezierExtraction.h"

#include "AlgorithmExecution.h"
#include "BezierCells.h"
#include "FieldArrays.h"
#include "SourceGeometry.h"
#include "StructuredOutput.h"

#include "vtkCell.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>

using namespace footpoint::conversion;

vtkStandardNewMacro(vtkBezierExtraction);

namespace
{

/// Faces in messages: all of a few, the first of many.
std::string list_faces(const footpoint::Model& model, const std::vector<std::size_t>& faces)
{
  constexpr std::size_t kMost = 20;
  std::string text;
  for (std::size_t i = 0; i < std::min(faces.size(), kMost); ++i)
  {
    text += (i > 0 ? ", " : "") + face_label(model, faces[i]);
  }
  return faces.size() > kMost ? text + " and " + std::to_string(faces.size() - kMost) + " more"
                              : text;
}

std::vector<std::size_t> trimmed_faces(const footpoint::Model& model)
{
  std::vector<std::size_t> trimmed;
  for (std::size_t i = 0; i < model.size(); ++i)
  {
    if (!model[i].patches.empty() && !model[i].loops.empty())
    {
      trimmed.push_back(i);
    }
  }
  return trimmed;
}

/// The faces whose cells have more points than filters of VTK reserve room for (`weights[512]`).
std::vector<std::size_t> large_faces(const footpoint::Model& model)
{
  std::vector<std::size_t> large;
  for (std::size_t i = 0; i < model.size(); ++i)
  {
    const auto is_large = [](const footpoint::Patch& patch)
    {
      const auto* surface = dynamic_cast<const footpoint::Surface*>(patch.surface.get());
      return surface &&
        (surface->knots(0).degree() + 1) * (surface->knots(1).degree() + 1) > VTK_CELL_SIZE;
    };
    const std::vector<footpoint::Patch>& patches = model[i].patches;
    if (std::any_of(patches.begin(), patches.end(), is_large))
    {
      large.push_back(i);
    }
  }
  return large;
}

/// Adds the `LengthUnit` of a leaf to those seen before.
void add_length_unit(vtkDataObject* leaf, std::vector<std::string>& units)
{
  auto* unit = vtkStringArray::SafeDownCast(leaf->GetFieldData()->GetAbstractArray("LengthUnit"));
  if (unit && unit->GetNumberOfValues() > 0 &&
    std::find(units.begin(), units.end(), unit->GetValue(0)) == units.end())
  {
    units.push_back(unit->GetValue(0));
  }
}

std::vector<std::string> length_units(vtkDataObject* data)
{
  std::vector<std::string> units;
  auto* composite = vtkCompositeDataSet::SafeDownCast(data);
  if (!composite)
  {
    add_length_unit(data, units);
    return units;
  }
  vtkSmartPointer<vtkCompositeDataIterator> iterator;
  iterator.TakeReference(composite->NewIterator());
  for (iterator->InitTraversal(); !iterator->IsDoneWithTraversal(); iterator->GoToNextItem())
  {
    add_length_unit(iterator->GetCurrentDataObject(), units);
  }
  return units;
}

} // namespace

int vtkBezierExtraction::FillInputPortInformation(int, vtkInformation* info)
{
  fill_source_port_information(info);
  info->Remove(vtkAlgorithm::INPUT_IS_OPTIONAL());
  return 1;
}

int vtkBezierExtraction::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  request_whole_inputs(inputs[0]);
  return 1;
}

int vtkBezierExtraction::RequestData(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  if (wants_nothing(request, outputs))
  {
    return 1;
  }
  vtkDataObject* input = vtkDataObject::GetData(inputs[0]);
  vtkUnstructuredGrid* output = vtkUnstructuredGrid::GetData(outputs);
  ConvertedModel converted;
  const InputState state = convert_input(this, input, false, converted);
  if (state != InputState::Ready)
  {
    output->Initialize();
    return state == InputState::Aborted ? 1 : 0;
  }
  footpoint::Model& model = converted.model;

  // === What cells cannot express
  const std::vector<std::size_t> trimmed = trimmed_faces(model);
  if (!trimmed.empty())
  {
    const std::string names = list_faces(model, trimmed);
    if (this->SkipTrimmedFaces)
    {
      for (const std::size_t face : trimmed)
      {
        model[face].patches.clear();
      }
      if (converted.empty())
      {
        vtkErrorMacro("No face is left, as all are trimmed and left out: " << names << ".");
        return 0;
      }
      vtkWarningMacro("Trimmed faces are left out: " << names << ".");
    }
    else
    {
      vtkWarningMacro(
        "Bézier cells cannot be trimmed; the whole surfaces were extracted of: " << names << ".");
    }
  }
  const std::vector<std::size_t> large = large_faces(model);
  if (!large.empty())
  {
    vtkWarningMacro("Some filters of VTK have room for cells of "
      << VTK_CELL_SIZE << " points only; cells of " << list_faces(model, large) << " have more.");
  }

  // === Extract
  const footpoint::Execution writing = part_of(make_execution(this), kReading, 1.0 - kReading);
  if (!write_bezier_cells(model, writing.proceed, output))
  {
    output->Initialize();
    return 1;
  }
  const std::vector<std::string> units = length_units(input);
  if (units.size() == 1)
  {
    set_values<vtkStringArray>(output->GetFieldData(), "LengthUnit", units);
  }
  return 1;
}

void vtkBezierExtraction::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SkipTrimmedFaces: " << (this->SkipTrimmedFaces ? "On" : "Off") << "\n";
}
