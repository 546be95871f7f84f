// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Reads trimmed faces of the shared real data (JSON lines), for tests alone.

#include "TrimShapes.h"

#include <memory>
#include <string>
#include <vector>

namespace trims
{

struct RealFace
{
  std::string name; ///< file and line
  std::shared_ptr<const Surface> surface;
  std::vector<TrimLoop> loops;
};

/// All faces with loops; empty where the folder FOOTPOINT_SHARED_DATA is absent.
std::vector<RealFace> real_faces();

} // namespace trims
