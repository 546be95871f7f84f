// SPDX-License-Identifier: BSD-3-Clause
// Private: how the core's work is run inside a VTK algorithm.

#ifndef AlgorithmExecution_h
#define AlgorithmExecution_h

#include "footpoint/common/execution.h"

class vtkAlgorithm;

namespace footpoint::conversion
{

/// VTK's threads, and the progress and abort flag of an algorithm, which has to outlive the result.
/// \param first, share where this work begins in the whole of [0, 1], and which part of it it is
Execution make_execution(vtkAlgorithm* algorithm, double first = 0.0, double share = 1.0);

} // namespace footpoint::conversion

#endif
