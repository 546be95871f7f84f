// SPDX-License-Identifier: BSD-3-Clause
#include "StructuredOutput.h"

#include "vtkAlgorithm.h"
#include "vtkAlgorithmOutput.h"
#include "vtkDataObject.h"
#include "vtkExecutive.h"
#include "vtkInformation.h"
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

} // namespace

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
  vtkAlgorithm* algorithm, int port, vtkInformationVector* input)
{
  request_whole_inputs(input);
  std::vector<vtkDataObject*> data;
  for (int i = 0; i < algorithm->GetNumberOfInputConnections(port); ++i)
  {
    vtkInformation* info = input->GetInformationObject(i);
    if (info->Has(Pipeline::TIME_STEPS()) && info->Length(Pipeline::TIME_STEPS()) > 0)
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
  structured->Set(Pipeline::WHOLE_EXTENT(), 0, dimensions[0] - 1, 0, dimensions[1] - 1, 0,
    dimensions[2] - 1);
  structured->Set(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT(), 0);
  for (int i = 0; i < outputs->GetNumberOfInformationObjects(); ++i)
  {
    outputs->GetInformationObject(i)->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 1);
  }
}

bool wants_nothing(vtkInformation* request, vtkInformationVector* outputs)
{
  const int port = request->Has(vtkExecutive::FROM_OUTPUT_PORT())
    ? std::max(request->Get(vtkExecutive::FROM_OUTPUT_PORT()), 0)
    : 0;
  vtkInformation* output = outputs->GetInformationObject(port);
  return output->Has(Pipeline::UPDATE_PIECE_NUMBER()) &&
    output->Get(Pipeline::UPDATE_PIECE_NUMBER()) > 0;
}

std::string check_dimensions(vtkInformationVector* outputs, const Dimensions& dimensions)
{
  int extent[6] = { 0, -1, 0, -1, 0, -1 };
  outputs->GetInformationObject(0)->Get(Pipeline::WHOLE_EXTENT(), extent);
  const Dimensions announced{ { extent[1] + 1, extent[3] + 1, extent[5] + 1 } };
  return announced == dimensions
    ? ""
    : "the grid has " + text(dimensions) + " points now, but " + text(announced) +
      " when the pipeline was set up; the numbers of points of the input must not change over time";
}

void clear_outputs(vtkInformationVector* outputs)
{
  for (int i = 0; i < outputs->GetNumberOfInformationObjects(); ++i)
  {
    vtkDataObject::GetData(outputs, i)->Initialize();
  }
}

} // namespace footpoint::conversion
