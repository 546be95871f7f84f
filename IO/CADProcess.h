// SPDX-License-Identifier: BSD-3-Clause
// Private: runs the program that reads CAD files (CAD/read_cad.cxx) and hands over what it sends.
// Open CASCADE can crash, eat all stack or run for ever on broken files, so it never runs in the
// process of whoever reads the file. A program that is started anew, not a fork: the caller may
// have threads that hold locks.

#ifndef CADProcess_h
#define CADProcess_h

#include "CADModel.h"
#include "CADStream.h"

#include <functional>
#include <string>

namespace footpoint::cad
{

enum class ReadingEnd
{
  Complete, ///< the process has sent all it had, maybe an error
  Aborted,  ///< because the caller wanted so
  Failed    ///< the process could not be started, has crashed or was silent for too long
};

struct ReadingOutcome
{
  ReadingEnd end;
  std::string reason; ///< of Failed
};

/// Reads a file in a process of its own.
/// \param time_limit seconds of silence (no progress, no data) after which it is stopped
/// \param on_record  is called with every record
/// \param aborted    is asked every tenth of a second whether to stop
/// \throw what on_record throws; the process is stopped then
ReadingOutcome read_in_process(const ReadingOptions& options, double time_limit,
  const std::function<void(const Record&)>& on_record, const std::function<bool()>& aborted);

} // namespace footpoint::cad

#endif
