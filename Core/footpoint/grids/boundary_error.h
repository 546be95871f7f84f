// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

namespace footpoint
{

/// What is wrong with a boundary that was refused.
enum class BoundaryDefect
{
  Count,      ///< not three or four sides, no closed loop, a side without two points
  NotFinite,  ///< NaN or infinity in a coordinate
  Gap,        ///< corners farther apart than the tolerance
  Branch,     ///< segments that fork, so that no chain is unique
  Loops,      ///< several loops where one is expected
  Corners,    ///< no four corners were found, or the given ones do not fit
  Duplicate,  ///< one side given twice
  Degenerate, ///< two adjacent or two opposite sides without length
  Resolution  ///< fewer than two points along a direction
};

/// Thrown where no grid can be made; the message names the sides and says how far.
class BoundaryError : public std::invalid_argument
{
public:
  BoundaryError(BoundaryDefect defect, const std::string& message)
    : std::invalid_argument(message)
    , Defect(defect)
  {
  }

  BoundaryDefect defect() const { return this->Defect; }

private:
  BoundaryDefect Defect;
};

} // namespace footpoint
