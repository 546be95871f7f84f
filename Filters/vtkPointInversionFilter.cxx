// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPointInversionFilter.h"

#include "AlgorithmExecution.h"
#include "PointInversionInternals.h"
#include "StructuredOutput.h"

#include "vtkDataSet.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkParametricFunction.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

#include <algorithm>
#include <optional>

using namespace footpoint::conversion;

vtkStandardNewMacro(vtkPointInversionFilter);

namespace
{

/// In the order of SearchEnum and MethodEnum, which is that of the core's enumerations.
const char* const kSearchNames[] = { "Global", "Seeded", "Local" };
const char* const kMethodNames[] = { "Newton", "GaussNewton", "LevenbergMarquardt", "SecondOrder",
  "FirstOrder", "CurvatureCircle", "SecondOrder1", "SecondOrder2", "SecondOrder3" };

static_assert(static_cast<int>(footpoint::Search::Local) == vtkPointInversionFilter::LOCAL &&
    static_cast<int>(footpoint::Method::SecondOrder3) == vtkPointInversionFilter::SECOND_ORDER_3 &&
    static_cast<int>(footpoint::Status::NoOrthogonalFoot) ==
      vtkPointInversionFilter::NO_ORTHOGONAL_FOOT &&
    static_cast<int>(footpoint::FootType::Degenerate) == vtkPointInversionFilter::DEGENERATE,
  "enumerations of the filter and of the core must have the same numbers");

} // namespace

vtkPointInversionFilter::vtkPointInversionFilter()
  : Internal(new Internals)
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(3);
  this->SetController(vtkMultiProcessController::GetGlobalController());

  const footpoint::InversionOptions options;
  this->Search = static_cast<int>(options.search);
  this->Method = static_cast<int>(options.solver.method);
  this->PointTolerance = options.solver.point_tolerance;
  this->CosineTolerance = options.solver.cosine_tolerance;
  this->StepTolerance = options.solver.step_tolerance;
  this->MaximumIterations = options.solver.maximum_iterations;
  this->TrustRadius = options.solver.trust_radius;
  this->ColumnScaling = options.solver.column_scaling;
  this->IsocurveFallback = options.solver.isocurve_fallback;
  this->SeedResolution = options.seeding.resolution;
  this->NumberOfSeeds = options.seeding.number_of_seeds;
  this->CertificateTolerance = options.certificate_tolerance;
  this->MaximumDistance = std::min(options.maximum_distance, VTK_DOUBLE_MAX);
  this->OrthogonalOnly = options.orthogonal_only;
  this->AllFeet = options.all_feet;
  std::copy_n(options.fixed_direction.data(), 3, this->FixedDirection);
}

vtkPointInversionFilter::~vtkPointInversionFilter()
{
  this->SetParametricFunction(nullptr);
  this->SetController(nullptr);
}

vtkCxxSetObjectMacro(vtkPointInversionFilter, ParametricFunction, vtkParametricFunction);
vtkCxxSetObjectMacro(vtkPointInversionFilter, Controller, vtkMultiProcessController);

void vtkPointInversionFilter::SetSourceConnection(vtkAlgorithmOutput* algorithmOutput)
{
  this->SetInputConnection(1, algorithmOutput);
}

void vtkPointInversionFilter::SetSourceData(vtkDataObject* source)
{
  this->SetInputDataInternal(1, source);
}

vtkDataObject* vtkPointInversionFilter::GetSource()
{
  return this->GetNumberOfInputConnections(1) > 0 ? this->GetExecutive()->GetInputData(1, 0)
                                                  : nullptr;
}

const char* vtkPointInversionFilter::GetSearchAsString() const
{
  return kSearchNames[this->Search];
}

const char* vtkPointInversionFilter::GetMethodAsString() const
{
  return kMethodNames[this->Method];
}

vtkPolyData* vtkPointInversionFilter::GetFootPointsOutput()
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(1));
}

vtkTable* vtkPointInversionFilter::GetFaceStatisticsOutput()
{
  return vtkTable::SafeDownCast(this->GetOutputDataObject(2));
}

int vtkPointInversionFilter::GetNumberOfModelBuilds() const
{
  return this->Internal->Inverter.number_of_builds();
}

vtkMTimeType vtkPointInversionFilter::GetMTime()
{
  const vtkMTimeType own = this->Superclass::GetMTime();
  return this->ParametricFunction ? std::max(own, this->ParametricFunction->GetMTime()) : own;
}

int vtkPointInversionFilter::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port == 1)
  {
    fill_source_port_information(info);
    return 1;
  }
  // Composite data sets are named, so that the executive hands them over whole.
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPointSet");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  return 1;
}

int vtkPointInversionFilter::FillOutputPortInformation(int port, vtkInformation* info)
{
  static const char* const kTypes[] = { "vtkDataObject", "vtkPolyData", "vtkTable" };
  info->Set(vtkDataObject::DATA_TYPE_NAME(), kTypes[port]);
  return 1;
}

int vtkPointInversionFilter::RequestDataObject(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkDataObject* input = vtkDataObject::GetData(inputs[0]);
  if (!input)
  {
    return 0;
  }
  return SetOutputDataObject(input->GetDataObjectType(), outputs->GetInformationObject(0), true) &&
    SetOutputDataObject(VTK_POLY_DATA, outputs->GetInformationObject(1), true) &&
    SetOutputDataObject(VTK_TABLE, outputs->GetInformationObject(2), true);
}

int vtkPointInversionFilter::RequestInformation(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  merge_time_steps(inputs, outputs);
  return 1;
}

int vtkPointInversionFilter::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  request_whole_inputs(inputs[1]);
  return 1;
}

int vtkPointInversionFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  // Every rank comes to each collective call, whatever it has and whatever fails.
  const Ranks ranks(this->Controller);
  vtkDataObject* input = vtkDataObject::GetData(inputs[0]);
  vtkDataObject* output = vtkDataObject::GetData(outputs, 0);

  // === Validate
  std::string error = ranks.first_error(Internals::InvalidInput(this, input, output));

  // === Convert
  CancelSignal early(this->Controller);
  if (error.empty())
  {
    const SourceGeometry geometry{ vtkDataObject::GetData(inputs[1]), this->ParametricFunction,
      this->FlipNormals };
    error = ranks.first_error(this->Internal->Prepare(this, geometry, ranks, early));
  }
  const auto initialize = [outputs]
  {
    for (int port = 0; port < 3; ++port)
    {
      if (vtkDataObject* const data = vtkDataObject::GetData(outputs, port))
      {
        data->Initialize();
      }
    }
  };
  const bool prepared = !early.settle(ranks);
  if (!prepared || !error.empty())
  {
    initialize();
  }
  if (!error.empty())
  {
    vtkErrorMacro(<< error);
    return 0;
  }
  if (!prepared)
  {
    return 1;
  }
  for (const std::string& problem : this->Internal->Inverter.problems())
  {
    vtkWarningMacro(<< problem << " (left out)");
  }
  const footpoint::PointInverter& inverter = this->Internal->Inverter.inverter();
  const FootArrayLayout layout = Internals::Layout(this, inverter.model());

  // === Compute
  CancelSignal cancel(this->Controller);
  std::optional<PointBlocks> points;
  std::optional<FootRecord> record;
  const auto compute = [&]
  {
    points.emplace(collect_points(input, output));
    const bool several = this->AllFeet || !inverter.options().fixed_direction.isZero();
    record.emplace(*points, layout, inverter.model(), several, this->FootSegments);
    this->Internal->Invert(this, *points, cancel, *record);
  };
  error = Internals::ErrorOf(compute);
  cancel.requested(!error.empty()); // so that the others stop soon
  const bool cancelled = cancel.settle(ranks);
  error = ranks.first_error(error);
  if (cancelled || !error.empty())
  {
    initialize();
    if (!error.empty())
    {
      vtkErrorMacro(<< error);
      return 0;
    }
    return 1;
  }
  if (points->skipped > 0)
  {
    vtkWarningMacro(<< points->skipped << " blocks of the input have no points and are passed on.");
  }

  // === Attach
  DeviationReport& report = record->report();
  report.reduce(Internals::Limit(this->DeviationTolerance), ranks.reduction(),
    part_of(make_execution(this), 1.0, 0.0));
  record->attach();
  record->fill_foot_points(vtkPolyData::GetData(outputs, 1));
  report.write_fields(layout.prefix, inverter.number_of_open_edges(), output->GetFieldData());
  report.write_table(ranks.rank() == 0, vtkTable::GetData(outputs, 2));
  return 1;
}

void vtkPointInversionFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto flag = [&](const char* name, bool value)
  { os << indent << name << ": " << (value ? "On" : "Off") << "\n"; };
  os << indent << "Controller: " << this->Controller << "\n";
  os << indent << "ParametricFunction: " << this->ParametricFunction << "\n";
  os << indent << "Search: " << this->GetSearchAsString() << "\n";
  os << indent << "Method: " << this->GetMethodAsString() << "\n";
  os << indent << "PointTolerance: " << this->PointTolerance << "\n";
  os << indent << "CosineTolerance: " << this->CosineTolerance << "\n";
  os << indent << "StepTolerance: " << this->StepTolerance << "\n";
  os << indent << "MaximumIterations: " << this->MaximumIterations << "\n";
  os << indent << "TrustRadius: " << this->TrustRadius << "\n";
  flag("ColumnScaling", this->ColumnScaling);
  flag("IsocurveFallback", this->IsocurveFallback);
  os << indent << "SeedResolution: " << this->SeedResolution << "\n";
  os << indent << "NumberOfSeeds: " << this->NumberOfSeeds << "\n";
  os << indent << "CertificateTolerance: " << this->CertificateTolerance << "\n";
  os << indent << "MaximumDistance: " << this->MaximumDistance << "\n";
  flag("OrthogonalOnly", this->OrthogonalOnly);
  flag("AllFeet", this->AllFeet);
  os << indent << "FixedDirection: (" << this->FixedDirection[0] << ", " << this->FixedDirection[1]
     << ", " << this->FixedDirection[2] << ")\n";
  flag("WarmStart", this->WarmStart);
  flag("FlipNormals", this->FlipNormals);
  os << indent << "DeviationTolerance: " << this->DeviationTolerance << "\n";
  flag("FootSegments", this->FootSegments);
  os << indent << "ArrayNamePrefix: " << this->ArrayNamePrefix << "\n";
  flag("GenerateParameters", this->GenerateParameters);
  flag("GenerateDistance", this->GenerateDistance);
  flag("GenerateSignedDistance", this->GenerateSignedDistance);
  flag("GenerateClosestPoint", this->GenerateClosestPoint);
  flag("GenerateNormal", this->GenerateNormal);
  flag("GenerateTangent", this->GenerateTangent);
  flag("GenerateFaceId", this->GenerateFaceId);
  flag("GenerateStatus", this->GenerateStatus);
  flag("GenerateFootType", this->GenerateFootType);
  flag("GenerateIsolated", this->GenerateIsolated);
  flag("GenerateIterations", this->GenerateIterations);
  os << indent << "NumberOfModelBuilds: " << this->Internal->Inverter.number_of_builds() << "\n";
}
