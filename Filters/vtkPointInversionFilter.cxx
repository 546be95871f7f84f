// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPointInversionFilter.h"

#include "AlgorithmExecution.h"
#include "CachedInverter.h"
#include "FootRecord.h"

#include "footpoint/common/errors.h"
#include "footpoint/model/point_inversion.h"

#include "vtkDataSet.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkParametricFunction.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

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

/// VTK_DOUBLE_MAX stands for infinity in options, as a number that survives text.
double limit(double value)
{
  return value >= VTK_DOUBLE_MAX ? std::numeric_limits<double>::infinity() : value;
}

} // namespace

struct vtkPointInversionFilter::Internals
{
  CachedInverter Inverter;

  /// Names the first option that is no usable number or does not go with another; else empty.
  static std::string InvalidOption(vtkPointInversionFilter* self);
  static footpoint::InversionOptions Options(vtkPointInversionFilter* self);
  static FootArrayLayout Layout(vtkPointInversionFilter* self, const footpoint::Model& model);
  /// False where the user has stopped it.
  bool Invert(vtkPointInversionFilter* self, const PointBlocks& points, FootRecord& record) const;
};

vtkPointInversionFilter::vtkPointInversionFilter()
  : Internal(new Internals)
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(3);

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
}

vtkCxxSetObjectMacro(vtkPointInversionFilter, ParametricFunction, vtkParametricFunction);

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

int vtkPointInversionFilter::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  request_whole_source(inputs);
  return 1;
}

footpoint::InversionOptions vtkPointInversionFilter::Internals::Options(
  vtkPointInversionFilter* self)
{
  footpoint::InversionOptions options;
  options.search = static_cast<footpoint::Search>(self->Search);
  options.solver.method = static_cast<footpoint::Method>(self->Method);
  options.solver.point_tolerance = self->PointTolerance;
  options.solver.cosine_tolerance = self->CosineTolerance;
  options.solver.step_tolerance = self->StepTolerance;
  options.solver.maximum_iterations = self->MaximumIterations;
  options.solver.trust_radius = self->TrustRadius;
  options.solver.column_scaling = self->ColumnScaling;
  options.solver.isocurve_fallback = self->IsocurveFallback;
  options.seeding.resolution = self->SeedResolution;
  options.seeding.number_of_seeds = self->NumberOfSeeds;
  options.certificate_tolerance = self->CertificateTolerance;
  options.maximum_distance = limit(self->MaximumDistance);
  options.orthogonal_only = self->OrthogonalOnly;
  options.all_feet = self->AllFeet;
  options.fixed_direction = footpoint::Vector3(self->FixedDirection);
  return options;
}

std::string vtkPointInversionFilter::Internals::InvalidOption(vtkPointInversionFilter* self)
{
  const std::pair<const char*, double> numbers[] = { { "PointTolerance", self->PointTolerance },
    { "CosineTolerance", self->CosineTolerance }, { "StepTolerance", self->StepTolerance },
    { "CertificateTolerance", self->CertificateTolerance }, { "TrustRadius", self->TrustRadius },
    { "MaximumDistance", self->MaximumDistance },
    { "DeviationTolerance", self->DeviationTolerance },
    { "FixedDirection[0]", self->FixedDirection[0] },
    { "FixedDirection[1]", self->FixedDirection[1] },
    { "FixedDirection[2]", self->FixedDirection[2] } };
  for (const auto& [name, value] : numbers)
  {
    if (!std::isfinite(value))
    {
      return std::string(name) + " is not finite.";
    }
  }
  const bool directed = !footpoint::Vector3(self->FixedDirection).isZero(0.0);
  if (self->WarmStart && (self->AllFeet || directed))
  {
    return "WarmStart does not go together with AllFeet or FixedDirection.";
  }
  if (directed && (self->AllFeet || self->OrthogonalOnly))
  {
    return "FixedDirection, which seeks where a line meets the geometry, does not go together with "
           "AllFeet or OrthogonalOnly.";
  }
  return "";
}

bool vtkPointInversionFilter::Internals::Invert(
  vtkPointInversionFilter* self, const PointBlocks& points, FootRecord& record) const
{
  const footpoint::PointInverter& inverter = this->Inverter.inverter();
  if (!self->WarmStart)
  {
    bool cancelled = false;
    footpoint::invert(inverter, points.queries, points.starts, make_execution(self),
      [&](std::int64_t first, const footpoint::InversionResult& part)
      {
        record.take(first, part);
        cancelled = part.cancelled;
      });
    return !cancelled;
  }
  const double total = std::max(static_cast<double>(points.queries.cols()), 1.0);
  double done = 0.0;
  for (const Block& block : points.blocks)
  {
    const double share = static_cast<double>(block.count) / total;
    const footpoint::InversionResult feet = footpoint::invert_sequence(inverter,
      points.queries.middleCols(block.first, block.count), make_execution(self, done, share));
    if (feet.cancelled)
    {
      return false;
    }
    record.take(block.first, feet);
    done += share;
  }
  return true;
}

FootArrayLayout vtkPointInversionFilter::Internals::Layout(
  vtkPointInversionFilter* self, const footpoint::Model& model)
{
  FootArrayLayout layout;
  describe_model(model, layout);
  layout.prefix = self->ArrayNamePrefix;
  layout.parameters = self->GenerateParameters;
  layout.distance = self->GenerateDistance;
  layout.signed_distance = self->GenerateSignedDistance;
  layout.closest_point = self->GenerateClosestPoint;
  layout.normal = self->GenerateNormal;
  layout.tangent = self->GenerateTangent;
  layout.face_id = self->GenerateFaceId;
  layout.status = self->GenerateStatus;
  layout.foot_type = self->GenerateFootType;
  layout.isolated = self->GenerateIsolated;
  layout.iterations = self->GenerateIterations;
  return layout;
}

int vtkPointInversionFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  // === Validate
  vtkDataObject* input = vtkDataObject::GetData(inputs[0]);
  vtkDataObject* output = vtkDataObject::GetData(outputs, 0);
  const SourceGeometry geometry{ vtkDataObject::GetData(inputs[1]), this->ParametricFunction,
    this->FlipNormals };
  if (!input || !output)
  {
    vtkErrorMacro("No input points.");
    return 0;
  }
  if (!geometry.exists())
  {
    vtkErrorMacro("No geometry: neither a source (port 1) nor a parametric function is set.");
    return 0;
  }
  const std::string invalid = Internals::InvalidOption(this);
  if (!invalid.empty())
  {
    vtkErrorMacro(<< invalid);
    return 0;
  }

  // === Convert
  try
  {
    this->Internal->Inverter.update(geometry, Internals::Options(this));
  }
  catch (const footpoint::GeometryError& error)
  {
    vtkErrorMacro(<< error.what());
    return 0;
  }
  catch (const std::invalid_argument&)
  {
    vtkErrorMacro("Method " << this->GetMethodAsString()
                            << " is for curves alone, but the geometry has surfaces.");
    return 0;
  }
  for (const std::string& problem : this->Internal->Inverter.problems())
  {
    vtkWarningMacro(<< problem << " (left out)");
  }
  const footpoint::Model& model = this->Internal->Inverter.inverter().model();
  const FootArrayLayout layout = Internals::Layout(this, model);
  const PointBlocks points = collect_points(input, output);
  if (points.skipped > 0)
  {
    vtkWarningMacro(<< points.skipped << " blocks of the input have no points and are passed on.");
  }

  // === Compute
  const bool several =
    this->AllFeet || !this->Internal->Inverter.inverter().options().fixed_direction.isZero();
  FootRecord record(points, layout, model, several, this->FootSegments);
  if (!this->Internal->Invert(this, points, record))
  {
    for (int port = 0; port < 3; ++port)
    {
      vtkDataObject::GetData(outputs, port)->Initialize();
    }
    return 1;
  }

  // === Attach
  record.attach();
  record.fill_foot_points(vtkPolyData::GetData(outputs, 1));
  record.report().write(limit(this->DeviationTolerance), layout.prefix,
    this->Internal->Inverter.inverter().number_of_open_edges(), output->GetFieldData(),
    vtkTable::GetData(outputs, 2));
  return 1;
}

void vtkPointInversionFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto flag = [&](const char* name, bool value)
  { os << indent << name << ": " << (value ? "On" : "Off") << "\n"; };
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
