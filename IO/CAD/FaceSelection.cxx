// SPDX-License-Identifier: BSD-3-Clause
#include "FaceSelection.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace footpoint::cad
{

namespace
{

std::int64_t parse_number(const std::string& digits, const std::string& part)
{
  // Eighteen digits fit into 64 bits.
  if (digits.empty() || digits.size() > 18 ||
    digits.find_first_not_of("0123456789") != std::string::npos)
  {
    throw std::invalid_argument(
      "'" + part + "' is neither a number nor a range of numbers such as 2-5");
  }
  return std::stoll(digits);
}

} // namespace

FaceSelection::FaceSelection(const std::string& text)
{
  std::string spaced = text;
  std::replace(spaced.begin(), spaced.end(), ',', ' ');
  std::istringstream parts(spaced);
  for (std::string part; parts >> part;)
  {
    const std::size_t dash = part.find('-');
    const std::int64_t first = parse_number(part.substr(0, dash), part);
    const std::int64_t last =
      dash == std::string::npos ? first : parse_number(part.substr(dash + 1), part);
    if (first > last)
    {
      throw std::invalid_argument("the range '" + part + "' runs backwards");
    }
    this->Ranges.insert({ first, last });
  }
}

bool FaceSelection::contains(std::int64_t number) const
{
  return std::any_of(this->Ranges.begin(), this->Ranges.end(),
    [&](const auto& range) { return range.first <= number && number <= range.second; });
}

std::int64_t FaceSelection::largest() const
{
  std::int64_t result = -1;
  for (const auto& range : this->Ranges)
  {
    result = std::max(result, range.second);
  }
  return result;
}

} // namespace footpoint::cad
