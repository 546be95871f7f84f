// SPDX-License-Identifier: BSD-3-Clause
#include "CachedInverter.h"

#include "footpoint/common/errors.h"

namespace footpoint::conversion
{

namespace
{

void add_options(ContentHash& hash, const InversionOptions& options)
{
  const SolverOptions& solver = options.solver;
  for (const double number : { static_cast<double>(options.search),
         static_cast<double>(solver.method), solver.point_tolerance, solver.cosine_tolerance,
         solver.step_tolerance, static_cast<double>(solver.maximum_iterations), solver.trust_radius,
         static_cast<double>(solver.column_scaling), static_cast<double>(solver.isocurve_fallback),
         static_cast<double>(options.seeding.resolution),
         static_cast<double>(options.seeding.number_of_seeds), options.maximum_distance,
         static_cast<double>(options.orthogonal_only), static_cast<double>(options.all_feet),
         options.fixed_direction[0], options.fixed_direction[1], options.fixed_direction[2] })
  {
    hash.add(number);
  }
}

} // namespace

void CachedInverter::update(const SourceGeometry& geometry, const InversionOptions& options)
{
  ContentHash key = geometry.hash();
  add_options(key, options);
  if (this->Inverter && key == this->Key)
  {
    return;
  }
  this->Inverter.reset();
  ConvertedModel converted = geometry.convert();
  this->Problems = converted.messages();
  if (converted.empty())
  {
    std::string message;
    for (const std::string& problem : this->Problems)
    {
      message += (message.empty() ? "" : "\n") + problem;
    }
    throw GeometryError(
      GeometryDefect::Format, message.empty() ? "The source has no faces." : message);
  }
  this->Inverter = std::make_unique<PointInverter>(std::move(converted.model), options);
  this->Key = key;
  ++this->NumberOfBuilds;
}

} // namespace footpoint::conversion
