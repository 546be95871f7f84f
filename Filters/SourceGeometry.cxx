// SPDX-License-Identifier: BSD-3-Clause
#include "SourceGeometry.h"

#include "AlgorithmExecution.h"
#include "ParametricFunctionGeometry.h"

#include "footpoint/common/errors.h"

#include "vtkAlgorithm.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkParametricFunction.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <set>
#include <vector>

namespace footpoint::conversion
{

ContentHash SourceGeometry::hash() const
{
  ContentHash hash;
  hash.add(static_cast<std::uint64_t>(this->flip));
  if (this->source)
  {
    hash.add(this->source);
  }
  else if (this->function)
  {
    hash.add(std::string(this->function->GetClassName()));
    hash.add(static_cast<std::uint64_t>(reinterpret_cast<std::uintptr_t>(this->function)));
    hash.add(static_cast<std::uint64_t>(this->function->GetMTime()));
  }
  return hash;
}

ConvertedModel SourceGeometry::convert(const Execution& execution) const
{
  if (this->source)
  {
    return convert_to_model(this->source, this->flip, execution);
  }
  ConvertedModel result;
  try
  {
    result.model = convert_parametric_function(this->function, this->flip);
  }
  catch (const GeometryError& error)
  {
    result.model.resize(1);
    result.problems.push_back({ 0, error.what() });
  }
  return result;
}

void fill_source_port_information(vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  // Composite data sets are named, so that the executive hands them over whole.
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkStructuredGrid");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkUnstructuredGrid");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
}

void merge_time_steps(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  std::set<double> steps;
  std::vector<double> ends;
  for (int port = 0; port < 2; ++port)
  {
    vtkInformation* const info = inputs[port]->GetInformationObject(0);
    if (info && info->Has(Pipeline::TIME_STEPS()))
    {
      const double* const first = info->Get(Pipeline::TIME_STEPS());
      steps.insert(first, first + info->Length(Pipeline::TIME_STEPS()));
    }
    if (info && info->Has(Pipeline::TIME_RANGE()))
    {
      const double* const range = info->Get(Pipeline::TIME_RANGE());
      ends.insert(ends.end(), range, range + 2);
    }
  }
  const std::vector<double> all(steps.begin(), steps.end());
  ends.insert(ends.end(), all.begin(), all.end());
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    vtkInformation* const info = outputs->GetInformationObject(port);
    if (!all.empty())
    {
      info->Set(Pipeline::TIME_STEPS(), all.data(), static_cast<int>(all.size()));
    }
    if (!ends.empty())
    {
      const auto range = std::minmax_element(ends.begin(), ends.end());
      const double both[] = { *range.first, *range.second };
      info->Set(Pipeline::TIME_RANGE(), both, 2);
    }
  }
}

InputState convert_input(
  vtkAlgorithm* filter, vtkDataObject* input, bool flip, ConvertedModel& converted)
{
  if (!input)
  {
    vtkErrorWithObjectMacro(filter, "No input geometry.");
    return InputState::Refused;
  }
  try
  {
    converted = convert_to_model(input, flip, part_of(make_execution(filter), 0.0, kReading));
  }
  catch (const Cancelled&)
  {
    return InputState::Aborted;
  }
  for (const std::string& problem : converted.messages())
  {
    if (converted.empty())
    {
      vtkErrorWithObjectMacro(filter, << problem);
    }
    else
    {
      vtkWarningWithObjectMacro(filter, << problem << " (left out)");
    }
  }
  if (converted.empty() && converted.problems.empty())
  {
    vtkErrorWithObjectMacro(filter, "The input has no faces.");
  }
  return converted.empty() ? InputState::Refused : InputState::Ready;
}

} // namespace footpoint::conversion
