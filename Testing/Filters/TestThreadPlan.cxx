// SPDX-License-Identifier: BSD-3-Clause
// Which threads a loop gets, for every kind of setting; the back end in use is left as it was; an
// exception in a thread comes out of the loop.
#include "FilterTesting.h"

#include "AlgorithmExecution.h"

#include "vtkSMPTools.h"

#include <atomic>
#include <chrono>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>

using namespace footpoint::conversion;

namespace
{

ThreadSettings Machine(bool sequential)
{
  ThreadSettings settings;
  settings.sequential = sequential;
  settings.cores = 8;
  settings.own_cores = 8;
  return settings;
}

void CheckPlan(const ThreadSettings& settings, bool as_set, int threads)
{
  const ThreadPlan plan = plan_threads(settings);
  CHECK(plan.as_set == as_set);
  CHECK(as_set || plan.threads == threads);
}

void TestPlans()
{
  // === One process
  CheckPlan(Machine(false), true, 0);
  CheckPlan(Machine(true), false, 0); // all cores
  ThreadSettings chosen = Machine(true);
  chosen.chosen_backend = true;
  CheckPlan(chosen, true, 0);
  chosen = Machine(true);
  chosen.chosen_threads = 3;
  CheckPlan(chosen, false, 3);
  chosen.sequential = false;
  CheckPlan(chosen, true, 0);

  // === Several on a machine
  for (const bool sequential : { false, true })
  {
    ThreadSettings ranks = Machine(sequential);
    ranks.ranks_on_machine = 3;
    CheckPlan(ranks, false, 2);
    ranks.ranks_on_machine = 16;
    CheckPlan(ranks, false, 1);
    ranks.ranks_on_machine = 2;
    ranks.own_cores = 1; // bound to a core
    CheckPlan(ranks, false, 1);
    ranks.chosen_backend = true;
    CheckPlan(ranks, true, 0);
  }
}

/// Numbers how often each of `count` is visited, and by how many threads.
int CountThreads(std::int64_t count)
{
  std::vector<std::atomic<int>> visits(static_cast<std::size_t>(count));
  std::mutex guard;
  std::set<std::thread::id> threads;
  run_parallel(count, 1,
    [&](std::int64_t begin, std::int64_t end)
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(1)); // so that one cannot do all
      const std::lock_guard<std::mutex> lock(guard);
      threads.insert(std::this_thread::get_id());
      for (std::int64_t i = begin; i < end; ++i)
      {
        ++visits[static_cast<std::size_t>(i)];
      }
    });
  for (const std::atomic<int>& visit : visits)
  {
    CHECK(visit == 1);
  }
  return static_cast<int>(threads.size());
}

void TestLoops()
{
  const std::string backend = vtkSMPTools::GetBackend();
  const int threads = vtkSMPTools::GetEstimatedNumberOfThreads();
  CHECK(CountThreads(100) >= 1);
  CHECK(CountThreads(0) == 0);
  CHECK(backend == vtkSMPTools::GetBackend());
  CHECK(threads == vtkSMPTools::GetEstimatedNumberOfThreads());

  std::string message;
  try
  {
    run_parallel(100, 1,
      [](std::int64_t begin, std::int64_t end)
      {
        if (begin <= 50 && 50 < end)
        {
          throw std::runtime_error("at 50");
        }
      });
  }
  catch (const std::runtime_error& error)
  {
    message = error.what();
  }
  CHECK(message == "at 50");
  CHECK(backend == vtkSMPTools::GetBackend());
}

/// With nothing chosen: as a program meets it that sets nothing.
void TestDefaults()
{
  CHECK(unsetenv("VTK_SMP_BACKEND_IN_USE") == 0);
  CHECK(unsetenv("VTK_SMP_MAX_THREADS") == 0);
  const ThreadSettings settings = current_thread_settings();
  CHECK(settings.cores >= settings.own_cores && settings.own_cores >= 1);
  if (vtk::detail::smp::DefaultBackend == vtk::detail::smp::BackendType::Sequential)
  {
    // As Debian's ParaView: all cores for the loop, and nothing changed for other filters.
    CHECK(vtkSMPTools::SetBackend("Sequential"));
    CHECK(CountThreads(100) > (settings.own_cores > 1 ? 1 : 0));
    CHECK(vtkSMPTools::GetBackend() == std::string("Sequential"));
  }
  TestLoops();

  // Ranks by the environment of mpiexec: as many as cores leave one thread each.
  CHECK(setenv("OMPI_COMM_WORLD_LOCAL_SIZE", std::to_string(settings.cores).c_str(), 1) == 0);
  CHECK(current_thread_settings().ranks_on_machine == settings.cores);
  if (settings.cores > 1 && !current_thread_settings().chosen_backend)
  {
    CHECK(CountThreads(100) == 1);
  }
  CHECK(unsetenv("OMPI_COMM_WORLD_LOCAL_SIZE") == 0);

  // The program chooses a number of threads.
  vtkSMPTools::Initialize(1);
  CHECK(current_thread_settings().chosen_threads == 1);
  CHECK(CountThreads(100) == 1);
  vtkSMPTools::Initialize(0);
}

/// Filters that a program runs in threads of its own.
void TestLoopsAtOnce()
{
  const std::string backend = vtkSMPTools::GetBackend();
  std::atomic<int> failures{ 0 };
  std::vector<std::thread> threads;
  for (int k = 0; k < 4; ++k)
  {
    threads.emplace_back(
      [&]
      {
        for (int turn = 0; turn < 20; ++turn)
        {
          std::atomic<int> visited{ 0 };
          run_parallel(1000, 10,
            [&](std::int64_t begin, std::int64_t end)
            { visited += static_cast<int>(end - begin); });
          failures += visited == 1000 ? 0 : 1;
        }
      });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  CHECK(failures == 0);
  CHECK(backend == vtkSMPTools::GetBackend());
}

} // namespace

int TestThreadPlan(int, char*[])
{
  return testing::Run(
    []
    {
      TestPlans();
      TestLoops();
      TestDefaults();
      TestLoopsAtOnce();
    });
}
