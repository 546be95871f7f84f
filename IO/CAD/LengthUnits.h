// SPDX-License-Identifier: BSD-3-Clause
// Private: names of units of length.

#ifndef LengthUnits_h
#define LengthUnits_h

#include <string>

namespace footpoint::cad
{

/// The short name of a unit ("mm" for "millimetre", "MM", …); empty where it is unknown.
std::string short_unit_name(const std::string& name);

/// Millimetres in a unit; 0 where it is unknown.
double millimetres_in(const std::string& name);

/// All short names, for messages.
std::string unit_names();

} // namespace footpoint::cad

#endif
