// SPDX-License-Identifier: BSD-3-Clause
#include "vtkStructuredGridSmoother.h"

#include "AlgorithmExecution.h"
#include "FieldArrays.h"
#include "GridConversion.h"
#include "StructuredOutput.h"

#include "footpoint/grids/boundary_error.h"

#include "vtkCellData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStructuredGrid.h"

#include <cmath>

using namespace footpoint::conversion;

vtkStandardNewMacro(vtkStructuredGridSmoother);

namespace
{

/// In the order of the enumerations, which is that of the core's.
const char* const kMethods[] = { "None", "Auto", "Laplacian", "Winslow" };
const char* const kControlFunctions[] = { "NoControl", "ThomasMiddlecoff" };
const char* const kBoundaries[] = { "Fixed", "Sliding" };

using Smoother = vtkStructuredGridSmoother;
static_assert(static_cast<int>(footpoint::Smoothing::Winslow) == Smoother::WINSLOW &&
    static_cast<int>(footpoint::ControlFunctions::ThomasMiddlecoff) ==
      Smoother::THOMAS_MIDDLECOFF &&
    static_cast<int>(footpoint::SmoothingBoundary::Sliding) == Smoother::SLIDING,
  "enumerations of the filter and of the core must have the same numbers");

} // namespace

vtkStructuredGridSmoother::vtkStructuredGridSmoother()
{
  const footpoint::SmoothingOptions options;
  this->Method = static_cast<int>(options.method);
  this->MaximumIterations = options.maximum_iterations;
  this->Tolerance = options.tolerance;
  this->ControlFunctions = static_cast<int>(options.control);
  this->Boundary = static_cast<int>(options.boundary);
}

vtkStructuredGridSmoother::~vtkStructuredGridSmoother() = default;

const char* vtkStructuredGridSmoother::GetMethodAsString() const
{
  return kMethods[this->Method];
}

const char* vtkStructuredGridSmoother::GetControlFunctionsAsString() const
{
  return kControlFunctions[this->ControlFunctions];
}

const char* vtkStructuredGridSmoother::GetBoundaryAsString() const
{
  return kBoundaries[this->Boundary];
}

int vtkStructuredGridSmoother::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  // The whole extent is that of the input, which the executive has copied.
  vtkInformation* info = outputs->GetInformationObject(0);
  info->Set(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT(), 0);
  info->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 1);
  return 1;
}

int vtkStructuredGridSmoother::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  request_whole_inputs(inputs[0]);
  return 1;
}

int vtkStructuredGridSmoother::RequestData(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  if (wants_nothing(request, outputs))
  {
    clear_outputs(outputs);
    return 1;
  }
  vtkStructuredGrid* input = vtkStructuredGrid::GetData(inputs[0]);
  vtkStructuredGrid* output = vtkStructuredGrid::GetData(outputs);
  if (!input || !output)
  {
    vtkErrorMacro("No input grid.");
    return 0;
  }
  if (!std::isfinite(this->Tolerance))
  {
    vtkErrorMacro("Tolerance is not finite.");
    return 0;
  }
  footpoint::SmoothingOptions options;
  options.method = static_cast<footpoint::Smoothing>(this->Method);
  options.maximum_iterations = this->MaximumIterations;
  options.tolerance = this->Tolerance;
  options.control = static_cast<footpoint::ControlFunctions>(this->ControlFunctions);
  options.boundary = static_cast<footpoint::SmoothingBoundary>(this->Boundary);
  try
  {
    // === Compute
    const footpoint::SmoothingResult result =
      smooth(read_grid(input, "the grid"), options, make_execution(this));
    if (result.cancelled)
    {
      clear_outputs(outputs);
      return 1;
    }
    const int status = smoothing_status(result, options.method);
    if (status == REJECTED)
    {
      vtkWarningMacro(<< this->GetMethodAsString() << " smoothing was no gain: "
                      << result.folds_after << " folded cells are left.");
    }

    // === Attach
    output->ShallowCopy(input);
    if (result.changed)
    {
      output->SetPoints(make_points(result.grid.points));
      if (output->GetPointData()->GetNormals())
      {
        const std::string name = output->GetPointData()->GetNormals()->GetName();
        attach_normals(result.grid, output->GetPointData());
        output->GetPointData()->GetNormals()->SetName(name.c_str());
      }
    }
    attach_quality(result.grid, output->GetCellData());
    attach_folds(result, status, output->GetFieldData());
    set_integer(output->GetFieldData(), "SmoothingIterations", result.iterations);
    set_number(output->GetFieldData(), "SmoothingResidual", result.residual);
  }
  catch (const footpoint::BoundaryError& error)
  {
    vtkErrorMacro(<< error.what());
    return 0;
  }
  return 1;
}

void vtkStructuredGridSmoother::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Method: " << this->GetMethodAsString() << "\n";
  os << indent << "MaximumIterations: " << this->MaximumIterations << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "ControlFunctions: " << this->GetControlFunctionsAsString() << "\n";
  os << indent << "Boundary: " << this->GetBoundaryAsString() << "\n";
}
