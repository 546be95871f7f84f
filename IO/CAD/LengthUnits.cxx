// SPDX-License-Identifier: BSD-3-Clause
#include "LengthUnits.h"

#include <algorithm>
#include <cctype>
#include <vector>

namespace footpoint::cad
{

namespace
{

struct Unit
{
  double millimetres;
  std::vector<std::string> names; ///< lower case; the first is the short one
};

const std::vector<Unit>& units()
{
  static const std::vector<Unit> all = {
    { 1.0, { "mm", "millimetre", "millimeter" } },
    { 10.0, { "cm", "centimetre", "centimeter" } },
    { 1000.0, { "m", "metre", "meter" } },
    { 1e6, { "km", "kilometre", "kilometer" } },
    { 1e-3, { "um", "micrometre", "micrometer", "micron" } },
    { 1e-6, { "nm", "nanometre", "nanometer" } },
    { 25.4, { "inch", "in", "inches" } },
    { 304.8, { "ft", "foot", "feet" } },
    { 914.4, { "yd", "yard", "yards" } },
    { 1609344.0, { "mi", "mile", "miles", "statute_mile" } },
    { 0.0254, { "mil", "mils" } },
    { 2.54e-5, { "uin", "microinch" } },
  };
  return all;
}

const Unit* find(std::string name)
{
  std::transform(name.begin(), name.end(), name.begin(),
    [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  for (const Unit& unit : units())
  {
    if (std::find(unit.names.begin(), unit.names.end(), name) != unit.names.end())
    {
      return &unit;
    }
  }
  return nullptr;
}

} // namespace

std::string short_unit_name(const std::string& name)
{
  const Unit* unit = find(name);
  return unit ? unit->names.front() : std::string();
}

double millimetres_in(const std::string& name)
{
  const Unit* unit = find(name);
  return unit ? unit->millimetres : 0.0;
}

std::string unit_names()
{
  std::string names;
  for (const Unit& unit : units())
  {
    names += (names.empty() ? "" : ", ") + unit.names.front();
  }
  return names;
}

} // namespace footpoint::cad
