// SPDX-License-Identifier: BSD-3-Clause
#include "AlgorithmExecution.h"

#include "vtkAlgorithm.h"
#include "vtkMultiProcessController.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <string>
#include <thread>

#ifdef __unix__
#include <unistd.h>
#endif

namespace footpoint::conversion
{

namespace
{

/// Whether the user wants to stop. Newer VTK has CheckAbort, which also looks upstream and tells
/// the executive; VTK 9.1 only the flag.
template <typename Algorithm>
auto should_abort(Algorithm* algorithm, int) -> decltype(algorithm->CheckAbort())
{
  return algorithm->CheckAbort();
}
template <typename Algorithm>
bool should_abort(Algorithm* algorithm, long)
{
  return algorithm->GetAbortExecute() != 0;
}

/// A positive number in the environment; else 0.
int number_in_environment(const char* name)
{
  const char* const text = std::getenv(name);
  return text ? std::max(std::atoi(text), 0) : 0;
}

int cores_of_machine(int own_cores)
{
#ifdef __unix__
  return std::max(static_cast<int>(sysconf(_SC_NPROCESSORS_ONLN)), own_cores);
#else
  return own_cores;
#endif
}

using Loop = std::function<void(std::int64_t, std::int64_t)>;

/// Ranges that each thread gets on average where nothing else is asked for. The back end STDThread
/// would make four, and threads that are done with theirs wait for the others, which may have the
/// harder points.
constexpr std::int64_t kRangesOfThread = 16;

std::int64_t usual_grain(std::int64_t count)
{
  if (vtkSMPTools::GetBackend() != std::string("STDThread"))
  {
    return 0; // TBB shares out ranges as threads become free
  }
  return std::max<std::int64_t>(
    count / (kRangesOfThread * vtkSMPTools::GetEstimatedNumberOfThreads()), 1);
}

/// Keeps the first exception of any thread for the one that waits: out of a thread of its own, it
/// would end the program.
void run_with_vtk_threads(std::int64_t count, std::int64_t grain, const Loop& body)
{
  std::mutex guard;
  std::exception_ptr failure;
  grain = grain > 0 ? grain : usual_grain(count);
  vtkSMPTools::For(0, static_cast<vtkIdType>(count), static_cast<vtkIdType>(grain),
    [&](vtkIdType begin, vtkIdType end)
    {
      try
      {
        body(begin, end);
      }
      catch (...)
      {
        const std::lock_guard<std::mutex> lock(guard);
        failure = failure ? failure : std::current_exception();
      }
    });
  if (failure)
  {
    std::rethrow_exception(failure);
  }
}

/// Sets the back end STDThread and puts the one before back. Not vtkSMPTools::LocalScope: in 9.1
/// that sets the number of threads of the back end that is left, which TBB does not forget.
class OwnThreads
{
public:
  explicit OwnThreads(int threads)
    : Backend(vtkSMPTools::GetBackend())
    , Desired(desired_threads())
  {
    vtkSMPTools::SetBackend("STDThread");
    vtkSMPTools::Initialize(threads);
  }
  ~OwnThreads()
  {
    vtkSMPTools::Initialize(this->Desired);
    vtkSMPTools::SetBackend(this->Backend.c_str());
  }
  OwnThreads(const OwnThreads&) = delete;
  OwnThreads& operator=(const OwnThreads&) = delete;

  static int desired_threads()
  {
    return vtk::detail::smp::vtkSMPToolsAPI::GetInstance().GetInternalDesiredNumberOfThread();
  }

private:
  std::string Backend;
  int Desired;
};

/// The back end is one for the whole process: filters that programs run in several threads at once
/// must not set it under each other.
std::mutex& backend_guard()
{
  static std::mutex guard;
  return guard;
}

} // namespace

ThreadPlan plan_threads(const ThreadSettings& settings)
{
  const ThreadPlan as_set;
  if (settings.chosen_backend)
  {
    return as_set;
  }
  if (settings.chosen_threads > 0)
  {
    return settings.sequential ? ThreadPlan{ false, settings.chosen_threads } : as_set;
  }
  if (settings.ranks_on_machine > 1)
  {
    const int share = std::max(settings.cores / settings.ranks_on_machine, 1);
    return { false, std::min(share, std::max(settings.own_cores, 1)) };
  }
  return settings.sequential ? ThreadPlan{ false, 0 } : as_set;
}

ThreadSettings current_thread_settings()
{
  using vtk::detail::smp::BackendType;
  const BackendType backend = vtk::detail::smp::vtkSMPToolsAPI::GetInstance().GetBackendType();
  ThreadSettings settings;
  settings.sequential = backend == BackendType::Sequential;
  settings.chosen_backend =
    std::getenv("VTK_SMP_BACKEND_IN_USE") != nullptr || backend != vtk::detail::smp::DefaultBackend;
  const int desired = OwnThreads::desired_threads();
  settings.chosen_threads = desired > 0 ? desired : number_in_environment("VTK_SMP_MAX_THREADS");
  settings.own_cores = std::max(static_cast<int>(std::thread::hardware_concurrency()), 1);
  settings.cores = cores_of_machine(settings.own_cores);
  vtkMultiProcessController* const controller = vtkMultiProcessController::GetGlobalController();
  settings.ranks_on_machine = controller ? controller->GetNumberOfProcesses() : 1;
  for (const char* name : { "OMPI_COMM_WORLD_LOCAL_SIZE", "MPI_LOCALNRANKS" })
  {
    const int ranks = number_in_environment(name);
    settings.ranks_on_machine = ranks > 0 ? ranks : settings.ranks_on_machine;
  }
  return settings;
}

void run_parallel(std::int64_t count, std::int64_t grain, const Loop& body)
{
  const ThreadPlan plan = plan_threads(current_thread_settings());
  if (plan.as_set)
  {
    run_with_vtk_threads(count, grain, body);
    return;
  }
  const std::unique_lock<std::mutex> lock(backend_guard(), std::try_to_lock);
  if (plan.threads == 1 || !lock || vtkSMPTools::IsParallelScope())
  {
    body(0, count);
    return;
  }
  const OwnThreads threads(plan.threads);
  run_with_vtk_threads(count, grain, body);
}

Execution make_execution(vtkAlgorithm* algorithm)
{
  Execution execution;
  execution.parallel_for = [](std::int64_t count, const Loop& body)
  { run_parallel(count, 0, body); };
  execution.proceed = [algorithm](double fraction)
  {
    algorithm->UpdateProgress(fraction);
    return !should_abort(algorithm, 0);
  };
  return execution;
}

} // namespace footpoint::conversion
