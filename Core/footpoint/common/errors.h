// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

namespace footpoint
{

/// What is wrong with a geometry that was refused.
enum class GeometryDefect
{
  Degree,       ///< outside [1, kMaximumDegree]
  Count,        ///< numbers of knots, control points or weights do not fit together
  NotFinite,    ///< NaN or infinity in an array
  Decreasing,   ///< a knot smaller than the one before it
  Multiplicity, ///< a knot repeated more than degree + 1 times
  EmptyDomain,  ///< no knot span of positive length inside the domain
  Weight,       ///< a weight that is zero or negative
  Format        ///< data that is no spline geometry at all
};

/// Thrown by every constructor of geometry; the message names the array, the index and the value.
class GeometryError : public std::invalid_argument
{
public:
  GeometryError(GeometryDefect defect, const std::string& message)
    : std::invalid_argument(message)
    , Defect(defect)
  {
  }

  GeometryDefect defect() const { return this->Defect; }

private:
  GeometryDefect Defect;
};

} // namespace footpoint
