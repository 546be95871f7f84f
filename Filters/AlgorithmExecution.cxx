// SPDX-License-Identifier: BSD-3-Clause
#include "AlgorithmExecution.h"

#include "vtkAlgorithm.h"
#include "vtkSMPTools.h"

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

} // namespace

Execution make_execution(vtkAlgorithm* algorithm, double first, double share)
{
  Execution execution;
  execution.parallel_for = [](std::int64_t count, const auto& body)
  {
    vtkSMPTools::For(0, static_cast<vtkIdType>(count),
      [&body](vtkIdType begin, vtkIdType end) { body(begin, end); });
  };
  execution.proceed = [algorithm, first, share](double fraction)
  {
    algorithm->UpdateProgress(first + share * fraction);
    return !should_abort(algorithm, 0);
  };
  return execution;
}

} // namespace footpoint::conversion
