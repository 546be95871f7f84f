// SPDX-License-Identifier: BSD-3-Clause
// Private: how the core's work is run inside a VTK algorithm.

#ifndef AlgorithmExecution_h
#define AlgorithmExecution_h

#include "footpoint/common/execution.h"

class vtkAlgorithm;

namespace footpoint::conversion
{

/// How many threads of which kind a loop gets.
struct ThreadPlan
{
  /// Those of vtkSMPTools as they are set; else its back end STDThread, for this loop alone.
  bool as_set = true;
  /// With STDThread: 1 runs the loop on the calling thread, 0 on all cores.
  int threads = 0;
};

/// What the plan depends on.
struct ThreadSettings
{
  bool sequential = false; ///< the back end in use has no threads
  bool chosen_backend =
    false;                  ///< by VTK_SMP_BACKEND_IN_USE, or it is not the one VTK was built for
  int chosen_threads = 0;   ///< by vtkSMPTools::Initialize or VTK_SMP_MAX_THREADS; 0: none
  int ranks_on_machine = 1; ///< processes that share the job and the cores
  int cores = 1;            ///< of the machine
  int own_cores = 1;        ///< that this process may run on
};

/// Who chose a back end or a number of threads gets it. Else a single process uses all cores, even
/// where VTK was built to be sequential by default (as Debian's ParaView is), and processes that
/// share a machine share its cores out.
ThreadPlan plan_threads(const ThreadSettings& settings);

/// As they are now. Ranks are counted by the environment of mpiexec (Open MPI, MPICH and those made
/// from it), else by the global controller, as if all were on one machine.
ThreadSettings current_thread_settings();

/// Calls `body(begin, end)` for disjoint ranges that cover [0, count), on threads by the plan. An
/// exception comes out on the calling thread, when all are done.
/// \param grain numbers that a range has at least; 0: a share of them, small enough that no
///              thread waits long for another
void run_parallel(std::int64_t count, std::int64_t grain,
  const std::function<void(std::int64_t begin, std::int64_t end)>& body);

/// Threads by the plan, and the progress and abort flag of an algorithm, which has to outlive the
/// result. Progress and abort are seen to on the calling thread alone.
Execution make_execution(vtkAlgorithm* algorithm);

} // namespace footpoint::conversion

#endif
