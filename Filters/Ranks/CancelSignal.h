// SPDX-License-Identifier: BSD-3-Clause
// Private: the wish of one rank to stop, told to the others while they work.

#ifndef CancelSignal_h
#define CancelSignal_h

#include "footpoint/common/execution.h"

#include <memory>

class vtkMultiProcessController;

namespace footpoint::conversion
{

class Ranks;

/// Made and settled by every rank around the work that can be cancelled. In between, ranks call
/// requested() whenever they like, as often as they like, or never. Messages pass while ranks work
/// where the controller is an MPI one; with any other they are noticed on settling.
class CancelSignal
{
public:
  explicit CancelSignal(vtkMultiProcessController* controller);
  ~CancelSignal();

  /// Whether this rank or another has to stop.
  /// \param here this one is asked to, which the others are told once
  bool requested(bool here);

  /// Collective, once: whether any rank was asked to stop. Nothing of the signal is under way
  /// afterwards.
  bool settle(const Ranks& ranks);

private:
  struct Messages;
  std::unique_ptr<Messages> Sent; ///< null where nobody can be told
  bool Here = false;
  bool Elsewhere = false;
};

/// Threads and progress of an execution, which ends where any rank was asked to stop as well. The
/// signal has to outlive the result.
Execution stopped_by(CancelSignal& cancel, const Execution& execution);

} // namespace footpoint::conversion

#endif
