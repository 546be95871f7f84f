// SPDX-License-Identifier: BSD-3-Clause
#include "CachedInverter.h"

#include "footpoint/common/errors.h"

namespace footpoint::conversion
{

namespace
{

/// Feet on the untrimmed surface would be wrong without a sign of it.
void refuse_trimmed_faces(ConvertedModel& converted)
{
  for (std::size_t i = 0; i < converted.model.size(); ++i)
  {
    Face& face = converted.model[i];
    if (!face.loops.empty())
    {
      face.patches.clear();
      face.loops.clear();
      converted.problems.push_back({ i,
        "it is a trimmed face (blocks Surface and Loop …), which this version does not search; "
        "give "
        "the block Surface alone for the untrimmed surface" });
    }
  }
}

} // namespace

void CachedInverter::update(const SourceGeometry& geometry, const InversionOptions& options)
{
  const ContentHash content = geometry.hash();
  if (this->Inverter && content == this->Content)
  {
    const bool prepared = this->Inverter->is_prepared_for(options);
    *this->Inverter = this->Inverter->with_options(options);
    this->NumberOfBuilds += prepared ? 0 : 1;
    return;
  }
  this->Inverter.reset();
  ConvertedModel converted = geometry.convert();
  refuse_trimmed_faces(converted);
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
  this->Content = content;
  ++this->NumberOfBuilds;
}

} // namespace footpoint::conversion
