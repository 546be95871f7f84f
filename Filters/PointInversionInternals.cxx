// SPDX-License-Identifier: BSD-3-Clause
#include "PointInversionInternals.h"

#include "AlgorithmExecution.h"

#include "footpoint/model/point_inversion.h"

#include <cmath>
#include <limits>
#include <stdexcept>

using namespace footpoint::conversion;

double vtkPointInversionFilter::Internals::Limit(double value)
{
  return value >= VTK_DOUBLE_MAX ? std::numeric_limits<double>::infinity() : value;
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
  options.maximum_distance = Limit(self->MaximumDistance);
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

std::string vtkPointInversionFilter::Internals::InvalidInput(
  vtkPointInversionFilter* self, vtkDataObject* input, vtkDataObject* output)
{
  return input && output ? InvalidOption(self) : "No input points.";
}

std::string vtkPointInversionFilter::Internals::Prepare(vtkPointInversionFilter* self,
  const SourceGeometry& own, const Ranks& ranks, CancelSignal& cancel)
{
  // Of the progress, where something is built; how it compares with the points nobody knows.
  constexpr double kPreparing = 0.3;
  try
  {
    const SourceGeometry geometry = this->Geometry.update(own, ranks);
    if (!geometry.exists())
    {
      return "No geometry: neither a source (port 1) nor a parametric function is set.";
    }
    const bool built = this->Inverter.update(geometry, Options(self),
      part_of(stopped_by(cancel, make_execution(self)), 0.0, kPreparing));
    this->Prepared = built ? kPreparing : 0.0;
    return "";
  }
  catch (const footpoint::Cancelled&)
  {
    return "";
  }
  catch (const footpoint::GeometryError& error)
  {
    return error.what();
  }
  catch (const std::invalid_argument&)
  {
    return std::string("Method ") + self->GetMethodAsString() +
      " is for curves alone, but the geometry has surfaces.";
  }
  catch (const std::exception& error)
  {
    return std::string("The geometry cannot be prepared: ") + error.what();
  }
}

void vtkPointInversionFilter::Internals::Invert(vtkPointInversionFilter* self,
  const PointBlocks& points, CancelSignal& cancel, FootRecord& record) const
{
  const footpoint::Execution execution = part_of(
    stopped_by(cancel, make_execution(self)), this->Prepared, 1.0 - this->Prepared);
  const footpoint::PointInverter& inverter = this->Inverter.inverter();
  if (!self->WarmStart)
  {
    footpoint::invert(inverter, points.queries, points.starts, execution,
      [&](std::int64_t first, const footpoint::InversionResult& part)
      { record.take(first, part); });
    return;
  }
  const double total = std::max(static_cast<double>(points.queries.cols()), 1.0);
  double done = 0.0;
  for (const Block& block : points.blocks)
  {
    const double share = static_cast<double>(block.count) / total;
    const footpoint::InversionResult feet = footpoint::invert_sequence(
      inverter, points.queries.middleCols(block.first, block.count),
      part_of(execution, done, share));
    record.take(block.first, feet);
    if (feet.cancelled)
    {
      return;
    }
    done += share;
  }
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
