// SPDX-License-Identifier: BSD-3-Clause
// Private: reads a CAD file, come what may of Open CASCADE.

#ifndef CADReading_h
#define CADReading_h

#include "CADOutputs.h"

#include <functional>
#include <string>
#include <vector>

namespace footpoint::cad
{

struct CompleteReading
{
  ReceivedModel model;
  std::vector<std::string> warnings;
  std::string error; ///< why there is no model; empty where there is one
  bool aborted = false;
};

/// Runs the reading process. Where it crashes at a face it is run again without that face, which is
/// skipped then, unless more than the time limit has gone; where it dies after the faces, what has
/// come until then is kept, with a warning.
/// \param time_limit seconds of silence
CompleteReading read_completely(const ReadingOptions& options, double time_limit,
  const std::function<void(double)>& progress, const std::function<bool()>& aborted);

} // namespace footpoint::cad

#endif
