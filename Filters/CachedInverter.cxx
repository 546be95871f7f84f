// SPDX-License-Identifier: BSD-3-Clause
#include "CachedInverter.h"

#include "footpoint/common/errors.h"

namespace footpoint::conversion
{

namespace
{

/// The part of the time for an assembly of trimmed faces that reading and trimming them takes.
constexpr double kConverting = 0.2;

} // namespace

bool CachedInverter::update(
  const SourceGeometry& geometry, const InversionOptions& options, const Execution& execution)
{
  const ContentHash content = geometry.hash();
  if (this->Inverter && content == this->Content)
  {
    const bool prepared = this->Inverter->is_prepared_for(options);
    *this->Inverter = this->Inverter->with_options(options, execution);
    this->NumberOfBuilds += prepared ? 0 : 1;
    return !prepared;
  }
  this->Inverter.reset();
  ConvertedModel converted = geometry.convert(part_of(execution, 0.0, kConverting));
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
  this->Inverter = std::make_unique<PointInverter>(std::move(converted.model), options,
    part_of(execution, kConverting, 1.0 - kConverting));
  this->Content = content;
  ++this->NumberOfBuilds;
  return true;
}

} // namespace footpoint::conversion
