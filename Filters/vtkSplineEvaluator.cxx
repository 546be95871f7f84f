// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSplineEvaluator.h"

#include "SourceGeometry.h"

#include "footpoint/model/evaluation.h"

#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkParametricFunction.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkTable.h"

#include <algorithm>
#include <cmath>

using namespace footpoint::conversion;

vtkStandardNewMacro(vtkSplineEvaluator);

namespace
{

/// A row of the input that can be evaluated.
struct Request
{
  vtkIdType row;
  const footpoint::Face* face;
  footpoint::Parameter<2> parameter;
};

bool is_curve(const footpoint::Face& face)
{
  return face.patches.front().curve != nullptr;
}

/// The only face that has patches; null if there are several.
const footpoint::Face* only_face(const footpoint::Model& model)
{
  const auto has_patches = [](const footpoint::Face& face) { return !face.patches.empty(); };
  const auto first = std::find_if(model.begin(), model.end(), has_patches);
  const bool several = std::find_if(first + 1, model.end(), has_patches) != model.end();
  return several ? nullptr : &*first;
}

/// The face with that number; null if there is none.
const footpoint::Face* find_face(const footpoint::Model& model, double id)
{
  if (!(id >= 0.0 && id < static_cast<double>(model.size())) || id != std::floor(id))
  {
    return nullptr;
  }
  const footpoint::Face& face = model[static_cast<std::size_t>(id)];
  return face.patches.empty() ? nullptr : &face;
}

/// Rows with finite parameters on a face that exists.
/// \param faces null: all rows lie on `only`
std::vector<Request> collect_requests(const footpoint::Model& model, vtkDataArray* parameters,
  vtkDataArray* faces, const footpoint::Face* only, vtkIdType rows)
{
  std::vector<Request> requests;
  for (vtkIdType row = 0; row < rows; ++row)
  {
    const footpoint::Face* face = faces ? find_face(model, faces->GetComponent(row, 0)) : only;
    if (!face)
    {
      continue;
    }
    footpoint::Parameter<2> parameter(parameters->GetComponent(row, 0), 0.0);
    if (!is_curve(*face))
    {
      parameter[1] = parameters->GetComponent(row, 1);
    }
    if (parameter.allFinite())
    {
      requests.push_back({ row, face, parameter });
    }
  }
  return requests;
}

/// Fills an array with a direction where the evaluated point is on a curve, or is on a surface.
void add_directions(const char* name, const std::vector<footpoint::Evaluation>& evaluations,
  bool of_curves, vtkPointData* attributes)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(evaluations.size()));
  vtkIdType row = 0;
  for (const footpoint::Evaluation& evaluation : evaluations)
  {
    const footpoint::Vector3 direction = evaluation.on_curve == of_curves
      ? evaluation.direction
      : footpoint::Vector3(footpoint::Vector3::Constant(std::nan("")));
    array->SetTuple(row++, direction.data());
  }
  attributes->AddArray(array);
}

void fill_output(const std::vector<Request>& requests,
  const std::vector<footpoint::Evaluation>& evaluations, const footpoint::Model& model,
  vtkDataSetAttributes* input, vtkPolyData* output)
{
  const auto count = static_cast<vtkIdType>(requests.size());
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(count);
  vtkNew<vtkCellArray> vertices;
  vertices->AllocateExact(count, count);
  vtkNew<vtkIntArray> clamped;
  clamped->SetName("Clamped");
  clamped->SetNumberOfValues(count);
  vtkNew<vtkIdTypeArray> point_ids;
  point_ids->SetName("PointId");
  point_ids->SetNumberOfValues(count);

  vtkPointData* attributes = output->GetPointData();
  attributes->CopyAllOn();
  attributes->CopyAllocate(input, count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    const auto at = static_cast<std::size_t>(i);
    points->SetPoint(i, evaluations[at].point.data());
    vertices->InsertNextCell(1, &i);
    clamped->SetValue(i, evaluations[at].clamped ? 1 : 0);
    point_ids->SetValue(i, requests[at].row);
    attributes->CopyData(input, requests[at].row, i);
  }
  output->SetPoints(points);
  output->SetVerts(vertices);

  // An array that is only overwritten would stay what it was active as.
  for (const char* name : { "Normal", "Tangent", "Clamped", "PointId" })
  {
    attributes->RemoveArray(name);
  }
  attributes->AddArray(clamped);
  attributes->AddArray(point_ids);
  const auto has = [&](bool curves)
  {
    return std::any_of(model.begin(), model.end(),
      [&](const footpoint::Face& face)
      { return !face.patches.empty() && is_curve(face) == curves; });
  };
  if (has(false))
  {
    add_directions("Normal", evaluations, false, attributes);
    attributes->SetActiveNormals("Normal");
  }
  if (has(true))
  {
    add_directions("Tangent", evaluations, true, attributes);
  }
}

} // namespace

vtkSplineEvaluator::vtkSplineEvaluator()
{
  this->SetNumberOfInputPorts(2);
}

vtkSplineEvaluator::~vtkSplineEvaluator()
{
  this->SetParametricFunction(nullptr);
}

vtkCxxSetObjectMacro(vtkSplineEvaluator, ParametricFunction, vtkParametricFunction);

void vtkSplineEvaluator::SetSourceConnection(vtkAlgorithmOutput* algorithmOutput)
{
  this->SetInputConnection(1, algorithmOutput);
}

void vtkSplineEvaluator::SetSourceData(vtkDataObject* source)
{
  this->SetInputDataInternal(1, source);
}

vtkDataObject* vtkSplineEvaluator::GetSource()
{
  return this->GetNumberOfInputConnections(1) > 0 ? this->GetExecutive()->GetInputData(1, 0)
                                                  : nullptr;
}

vtkMTimeType vtkSplineEvaluator::GetMTime()
{
  const vtkMTimeType own = this->Superclass::GetMTime();
  return this->ParametricFunction ? std::max(own, this->ParametricFunction->GetMTime()) : own;
}

int vtkSplineEvaluator::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port == 1)
  {
    fill_source_port_information(info);
    return 1;
  }
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkTable");
  return 1;
}

int vtkSplineEvaluator::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  request_whole_source(inputs);
  return 1;
}

int vtkSplineEvaluator::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  // === Validate
  vtkDataObject* input = vtkDataObject::GetData(inputs[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputs);
  const SourceGeometry geometry{ vtkDataObject::GetData(inputs[1]), this->ParametricFunction,
    this->FlipNormals };
  auto* points = vtkDataSet::SafeDownCast(input);
  auto* table = vtkTable::SafeDownCast(input);
  if (!output || (!points && !table))
  {
    vtkErrorMacro("No input parameters.");
    return 0;
  }
  if (!geometry.exists())
  {
    vtkErrorMacro("No geometry: neither a source (port 1) nor a parametric function is set.");
    return 0;
  }
  vtkDataSetAttributes* attributes =
    points ? static_cast<vtkDataSetAttributes*>(points->GetPointData()) : table->GetRowData();
  const vtkIdType rows = points ? points->GetNumberOfPoints() : table->GetNumberOfRows();
  vtkDataArray* parameters = attributes->GetArray(this->ParametersArrayName.c_str());
  vtkDataArray* faces = attributes->GetArray(this->FaceIdArrayName.c_str());
  if (rows > 0 && !parameters)
  {
    vtkErrorMacro("The input has no array '" << this->ParametersArrayName << "' of numbers.");
    return 0;
  }

  // === Convert
  const ConvertedModel converted = geometry.convert();
  const footpoint::Model& model = converted.model;
  for (const std::string& problem : converted.messages())
  {
    if (converted.empty())
    {
      vtkErrorMacro(<< problem);
    }
    else
    {
      vtkWarningMacro(<< problem << " (left out)");
    }
  }
  if (converted.empty())
  {
    if (converted.problems.empty())
    {
      vtkErrorMacro("The source has no faces.");
    }
    return 0;
  }
  const footpoint::Face* only = only_face(model);
  if (rows > 0 && !faces && !only)
  {
    vtkErrorMacro("The geometry has several faces, and the input has no array '"
      << this->FaceIdArrayName << "' to tell on which one a parameter is.");
    return 0;
  }
  const bool surfaces = std::any_of(model.begin(), model.end(),
    [](const footpoint::Face& face) { return !face.patches.empty() && !is_curve(face); });
  if (rows > 0 && surfaces && parameters->GetNumberOfComponents() < 2)
  {
    vtkErrorMacro(
      "The array '" << this->ParametersArrayName << "' has 1 component; surfaces need 2.");
    return 0;
  }

  // === Compute
  const std::vector<Request> requests = collect_requests(model, parameters, faces, only, rows);
  std::vector<footpoint::Evaluation> evaluations(requests.size());
  vtkSMPTools::For(0, static_cast<vtkIdType>(requests.size()),
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        const auto at = static_cast<std::size_t>(i);
        evaluations[at] = footpoint::evaluate(*requests[at].face, requests[at].parameter);
      }
    });

  // === Attach
  fill_output(requests, evaluations, model, attributes, output);
  output->GetFieldData()->PassData(input->GetFieldData());
  vtkNew<vtkIdTypeArray> skipped;
  skipped->SetName("NumberOfSkippedPoints");
  skipped->InsertNextValue(rows - static_cast<vtkIdType>(requests.size()));
  output->GetFieldData()->AddArray(skipped);
  return 1;
}

void vtkSplineEvaluator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ParametricFunction: " << this->ParametricFunction << "\n";
  os << indent << "ParametersArrayName: " << this->ParametersArrayName << "\n";
  os << indent << "FaceIdArrayName: " << this->FaceIdArrayName << "\n";
  os << indent << "FlipNormals: " << (this->FlipNormals ? "On" : "Off") << "\n";
}
