// SPDX-License-Identifier: BSD-3-Clause
#include "StructuredOutput.h"

#include "vtkAlgorithm.h"
#include "vtkAlgorithmOutput.h"
#include "vtkDataObject.h"
#include "vtkExecutive.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerVectorKey.h"
#include "vtkInformationVector.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>

namespace footpoint::conversion
{

namespace
{

using Pipeline = vtkStreamingDemandDrivenPipeline;

std::string text(const Dimensions& dimensions)
{
  return std::to_string(dimensions[0]) + " x " + std::to_string(dimensions[1]) + " x " +
    std::to_string(dimensions[2]);
}

Dimensions dimensions_of(vtkInformation* info, vtkInformationIntegerVectorKey* key)
{
  int extent[6] = { 0, -1, 0, -1, 0, -1 };
  if (info->Has(key))
  {
    info->Get(key, extent);
  }
  return { { extent[1] - extent[0] + 1, extent[3] - extent[2] + 1, extent[5] - extent[4] + 1 } };
}

/// The port of the request or, without, port 0.
vtkInformation* requested_output(vtkInformation* request, vtkInformationVector* outputs)
{
  const int port = request->Has(vtkExecutive::FROM_OUTPUT_PORT())
    ? std::max(request->Get(vtkExecutive::FROM_OUTPUT_PORT()), 0)
    : 0;
  return outputs->GetInformationObject(port);
}

} // namespace

std::optional<double> requested_time(vtkInformation* request, vtkInformationVector* outputs)
{
  vtkInformation* output = requested_output(request, outputs);
  return output->Has(Pipeline::UPDATE_TIME_STEP())
    ? std::optional<double>(output->Get(Pipeline::UPDATE_TIME_STEP()))
    : std::nullopt;
}

bool has_time(vtkInformationVector* input)
{
  for (int i = 0; i < input->GetNumberOfInformationObjects(); ++i)
  {
    if (input->GetInformationObject(i)->Has(Pipeline::TIME_RANGE()))
    {
      return true;
    }
  }
  return false;
}

void request_whole_inputs(vtkInformationVector* input)
{
  for (int i = 0; i < input->GetNumberOfInformationObjects(); ++i)
  {
    vtkInformation* info = input->GetInformationObject(i);
    info->Set(Pipeline::UPDATE_PIECE_NUMBER(), 0);
    info->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), 1);
    info->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
    if (info->Has(Pipeline::WHOLE_EXTENT()))
    {
      info->Set(Pipeline::UPDATE_EXTENT(), info->Get(Pipeline::WHOLE_EXTENT()), 6);
    }
  }
}

std::vector<vtkDataObject*> update_inputs(
  vtkAlgorithm* algorithm, int port, vtkInformationVector* input, std::optional<double> time)
{
  request_whole_inputs(input);
  std::vector<vtkDataObject*> data;
  for (int i = 0; i < algorithm->GetNumberOfInputConnections(port); ++i)
  {
    vtkInformation* info = input->GetInformationObject(i);
    if (time && info->Has(Pipeline::TIME_RANGE()))
    {
      info->Set(Pipeline::UPDATE_TIME_STEP(), *time);
    }
    else if (info->Has(Pipeline::TIME_STEPS()) && info->Length(Pipeline::TIME_STEPS()) > 0)
    {
      info->Set(Pipeline::UPDATE_TIME_STEP(), info->Get(Pipeline::TIME_STEPS())[0]);
    }
    vtkAlgorithmOutput* connection = algorithm->GetInputConnection(port, i);
    vtkExecutive* producer = connection->GetProducer()->GetExecutive();
    vtkDataObject* object = producer->Update(connection->GetIndex())
      ? producer->GetOutputData(connection->GetIndex())
      : nullptr;
    if (object)
    {
      data.push_back(object);
    }
  }
  return data;
}

std::vector<vtkDataObject*> input_data(vtkInformationVector* input)
{
  std::vector<vtkDataObject*> data;
  for (int i = 0; i < input->GetNumberOfInformationObjects(); ++i)
  {
    if (vtkDataObject* object = vtkDataObject::GetData(input, i))
    {
      data.push_back(object);
    }
  }
  return data;
}

void announce_dimensions(vtkInformationVector* outputs, const Dimensions& dimensions)
{
  vtkInformation* structured = outputs->GetInformationObject(0);
  structured->Set(
    Pipeline::WHOLE_EXTENT(), 0, dimensions[0] - 1, 0, dimensions[1] - 1, 0, dimensions[2] - 1);
  structured->Set(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT(), 0);
  for (int i = 0; i < outputs->GetNumberOfInformationObjects(); ++i)
  {
    outputs->GetInformationObject(i)->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 1);
  }
}

bool renew_dimensions(vtkInformationVector* outputs, const Dimensions& dimensions)
{
  vtkInformation* structured = outputs->GetInformationObject(0);
  const Dimensions former = dimensions_of(structured, Pipeline::WHOLE_EXTENT());
  if (former == dimensions)
  {
    return false;
  }
  const bool all = dimensions_of(structured, Pipeline::UPDATE_EXTENT()) == former;
  announce_dimensions(outputs, dimensions);
  if (all)
  {
    structured->Set(Pipeline::UPDATE_EXTENT(), structured->Get(Pipeline::WHOLE_EXTENT()), 6);
  }
  // refuse_other_request is to refuse extents of other times, rather than the executive.
  structured->Set(Pipeline::UNRESTRICTED_UPDATE_EXTENT(), 1);
  return true;
}

void announce_changing_dimensions(vtkInformationVector* outputs)
{
  for (int i = 0; i < outputs->GetNumberOfInformationObjects(); ++i)
  {
    outputs->GetInformationObject(i)->Set(Pipeline::TIME_DEPENDENT_INFORMATION(), 1);
  }
}

bool wants_nothing(vtkInformation* request, vtkInformationVector* outputs)
{
  vtkInformation* output = requested_output(request, outputs);
  return output->Has(Pipeline::UPDATE_PIECE_NUMBER()) &&
    output->Get(Pipeline::UPDATE_PIECE_NUMBER()) > 0;
}

std::string check_dimensions(vtkInformationVector* outputs, const Dimensions& dimensions)
{
  const Dimensions announced =
    dimensions_of(outputs->GetInformationObject(0), Pipeline::WHOLE_EXTENT());
  return announced == dimensions
    ? ""
    : "the grid has " + text(dimensions) + " points now, but " + text(announced) +
      " when the pipeline was set up; the numbers of points of the input must not change over time";
}

std::string refuse_other_request(vtkInformationVector* outputs)
{
  vtkInformation* structured = outputs->GetInformationObject(0);
  const Dimensions whole = dimensions_of(structured, Pipeline::WHOLE_EXTENT());
  const Dimensions wanted = dimensions_of(structured, Pipeline::UPDATE_EXTENT());
  if (wanted == whole)
  {
    return "";
  }
  structured->Set(Pipeline::UPDATE_EXTENT(), structured->Get(Pipeline::WHOLE_EXTENT()), 6);
  structured->Remove(Pipeline::COMBINED_UPDATE_EXTENT());
  return "the grid has " + text(whole) + " points now, but a filter downstream asks for " +
    text(wanted) + ": it does not follow numbers of points that change over time";
}

void clear_outputs(vtkInformationVector* outputs)
{
  for (int i = 0; i < outputs->GetNumberOfInformationObjects(); ++i)
  {
    vtkDataObject::GetData(outputs, i)->Initialize();
  }
}

} // namespace footpoint::conversion
