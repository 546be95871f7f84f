// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSplineEvaluator.h"

#include "AlgorithmExecution.h"
#include "CancelSignal.h"
#include "FieldArrays.h"
#include "Ranks.h"
#include "ReplicatedGeometry.h"
#include "StructuredOutput.h"

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
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkParametricFunction.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

using namespace footpoint::conversion;

vtkStandardNewMacro(vtkSplineEvaluator);

namespace
{

/// Rows, each some tenths of a microsecond of work, from which on threads share them,
/// and after eight times as many of which progress is told.
constexpr std::int64_t kRowsForThreads = 4096;

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

/// The rows of the input: points of a data set, or rows of a table.
struct Rows
{
  vtkDataSetAttributes* attributes = nullptr;
  vtkIdType count = 0;
  vtkDataArray* parameters = nullptr;
  vtkDataArray* faces = nullptr; ///< null: all rows lie on the only face
};

/// \throw std::invalid_argument where there are rows without parameters
Rows find_rows(vtkDataObject* input, const std::string& parameters, const std::string& faces)
{
  auto* points = vtkDataSet::SafeDownCast(input);
  auto* table = vtkTable::SafeDownCast(input);
  if (!points && !table)
  {
    throw std::invalid_argument("No input parameters.");
  }
  Rows rows;
  rows.attributes =
    points ? static_cast<vtkDataSetAttributes*>(points->GetPointData()) : table->GetRowData();
  rows.count = points ? points->GetNumberOfPoints() : table->GetNumberOfRows();
  rows.parameters = rows.attributes->GetArray(parameters.c_str());
  rows.faces = rows.attributes->GetArray(faces.c_str());
  if (rows.count > 0 && !rows.parameters)
  {
    throw std::invalid_argument("The input has no array '" + parameters + "' of numbers.");
  }
  return rows;
}

/// \throw std::invalid_argument where there is no face, with a line for each problem
ConvertedModel convert(const SourceGeometry& geometry, const footpoint::Execution& execution)
{
  if (!geometry.exists())
  {
    throw std::invalid_argument(
      "No geometry: neither a source (port 1) nor a parametric function is set.");
  }
  ConvertedModel converted = geometry.convert(execution);
  if (converted.empty())
  {
    std::string message;
    for (const std::string& problem : converted.messages())
    {
      message += (message.empty() ? "" : "\n") + problem;
    }
    throw std::invalid_argument(message.empty() ? "The source has no faces." : message);
  }
  return converted;
}

/// \throw std::invalid_argument where the rows do not say enough for the geometry
void check_rows(const Rows& rows, const footpoint::Model& model, const std::string& parameters,
  const std::string& faces)
{
  if (rows.count > 0 && !rows.faces && !only_face(model))
  {
    throw std::invalid_argument("The geometry has several faces, and the input has no array '" +
      faces + "' to tell on which one a parameter is.");
  }
  const bool surfaces = std::any_of(model.begin(), model.end(),
    [](const footpoint::Face& face) { return !face.patches.empty() && !is_curve(face); });
  if (rows.count > 0 && surfaces && rows.parameters->GetNumberOfComponents() < 2)
  {
    throw std::invalid_argument("The array '" + parameters + "' has 1 component; surfaces need 2.");
  }
}

/// Rows with finite parameters on a face that exists.
std::vector<Request> collect_requests(const footpoint::Model& model, const Rows& rows)
{
  std::vector<Request> requests;
  const footpoint::Face* const only = only_face(model);
  for (vtkIdType row = 0; row < rows.count; ++row)
  {
    const footpoint::Face* face =
      rows.faces ? find_face(model, rows.faces->GetComponent(row, 0)) : only;
    if (!face)
    {
      continue;
    }
    footpoint::Parameter<2> parameter(rows.parameters->GetComponent(row, 0), 0.0);
    if (!is_curve(*face))
    {
      parameter[1] = rows.parameters->GetComponent(row, 1);
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

struct vtkSplineEvaluator::Internals
{
  ReplicatedGeometry Geometry;
};

vtkSplineEvaluator::vtkSplineEvaluator()
  : Internal(new Internals)
{
  this->SetNumberOfInputPorts(2);
  this->SetController(vtkMultiProcessController::GetGlobalController());
}

vtkSplineEvaluator::~vtkSplineEvaluator()
{
  this->SetParametricFunction(nullptr);
  this->SetController(nullptr);
}

vtkCxxSetObjectMacro(vtkSplineEvaluator, ParametricFunction, vtkParametricFunction);
vtkCxxSetObjectMacro(vtkSplineEvaluator, Controller, vtkMultiProcessController);

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

int vtkSplineEvaluator::RequestInformation(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  merge_time_steps(inputs, outputs);
  return 1;
}

int vtkSplineEvaluator::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  request_whole_inputs(inputs[1]);
  return 1;
}

int vtkSplineEvaluator::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  // Every rank comes to each collective call, whatever it has and whatever fails.
  const Ranks ranks(this->Controller);
  vtkDataObject* input = vtkDataObject::GetData(inputs[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputs);

  CancelSignal cancel(this->Controller);
  const footpoint::Execution execution = stopped_by(cancel, make_execution(this));
  std::string error;
  const auto attempt = [&error](const auto& work)
  {
    try
    {
      work();
    }
    catch (const footpoint::Cancelled&)
    {
      return; // the signal knows
    }
    catch (const std::exception& problem)
    {
      error = problem.what();
    }
  };

  // === Validate and convert
  Rows rows;
  ConvertedModel converted;
  attempt(
    [&]
    {
      const SourceGeometry geometry = this->Internal->Geometry.update(
        { vtkDataObject::GetData(inputs[1]), this->ParametricFunction, this->FlipNormals }, ranks);
      rows = find_rows(input, this->ParametersArrayName, this->FaceIdArrayName);
      converted = convert(geometry, part_of(execution, 0.0, kReading));
      check_rows(rows, converted.model, this->ParametersArrayName, this->FaceIdArrayName);
    });
  error = ranks.first_error(error);

  // === Compute
  std::vector<Request> requests;
  std::vector<footpoint::Evaluation> evaluations;
  if (error.empty() && !cancel.requested(false))
  {
    attempt(
      [&]
      {
        requests = collect_requests(converted.model, rows);
        evaluations.resize(requests.size());
        for_ranges(part_of(execution, kReading, 1.0 - kReading),
          static_cast<std::int64_t>(requests.size()), kRowsForThreads,
          [&](std::int64_t begin, std::int64_t end)
          {
            for (std::int64_t i = begin; i < end; ++i)
            {
              const auto at = static_cast<std::size_t>(i);
              evaluations[at] = footpoint::evaluate(*requests[at].face, requests[at].parameter);
            }
          });
      });
    cancel.requested(!error.empty()); // so that the others stop soon
  }
  const bool cancelled = cancel.settle(ranks);
  error = ranks.first_error(error);
  if (!error.empty())
  {
    vtkErrorMacro(<< error);
    return 0;
  }
  if (cancelled)
  {
    return 1;
  }
  for (const std::string& problem : converted.messages())
  {
    vtkWarningMacro(<< problem << " (left out)");
  }

  // === Attach
  fill_output(requests, evaluations, converted.model, rows.attributes, output);
  output->GetFieldData()->PassData(input->GetFieldData());
  std::vector<std::int64_t> skipped{ rows.count - static_cast<std::int64_t>(requests.size()) };
  ranks.reduction().sum(skipped);
  set_count(output->GetFieldData(), "NumberOfSkippedPoints", static_cast<vtkIdType>(skipped[0]));
  return 1;
}

void vtkSplineEvaluator::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Controller: " << this->Controller << "\n";
  os << indent << "ParametricFunction: " << this->ParametricFunction << "\n";
  os << indent << "ParametersArrayName: " << this->ParametersArrayName << "\n";
  os << indent << "FaceIdArrayName: " << this->FaceIdArrayName << "\n";
  os << indent << "FlipNormals: " << (this->FlipNormals ? "On" : "Off") << "\n";
}
