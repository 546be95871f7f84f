// SPDX-License-Identifier: BSD-3-Clause
// Private: a search structure that is kept as long as the content it was built from.

#ifndef CachedInverter_h
#define CachedInverter_h

#include "SourceGeometry.h"

#include "footpoint/model/point_inversion.h"

#include <memory>
#include <string>
#include <vector>

namespace footpoint::conversion
{

class CachedInverter
{
public:
  /// Makes the inverter for the options. Its search structure is built only where the content is
  /// another than last time, or the options ask for one that is not there yet.
  /// \param execution whose threads share the work of building
  /// \return whether something was built
  /// \throw Cancelled where the execution's `proceed` says so: what is missing the next update
  ///        builds
  /// \throw GeometryError where no face is left; the message has a line for each problem
  /// \throw std::invalid_argument where the method is for curves and the geometry has surfaces
  bool update(
    const SourceGeometry& geometry, const InversionOptions& options, const Execution& execution);

  /// \pre the last update was not cancelled
  const PointInverter& inverter() const { return *this->Inverter; }
  /// What was wrong with the faces that are not in the model.
  const std::vector<std::string>& problems() const { return this->Problems; }
  int number_of_builds() const { return this->NumberOfBuilds; }

private:
  std::unique_ptr<PointInverter> Inverter;
  ContentHash Content;
  std::vector<std::string> Problems;
  int NumberOfBuilds = 0;
};

} // namespace footpoint::conversion

#endif
