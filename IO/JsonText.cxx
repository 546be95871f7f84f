// SPDX-License-Identifier: BSD-3-Clause
#include "JsonText.h"

#include "SplineFile.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace footpoint::files
{

Json::Value JsonText::parse() const
{
  Json::CharReaderBuilder builder;
  Json::CharReaderBuilder::strictMode(&builder.settings_);
  const std::unique_ptr<Json::CharReader> reader(builder.newCharReader());
  Json::Value root;
  std::string errors;
  try
  {
    if (!reader->parse(this->Text.data(), this->Text.data() + this->Text.size(), &root, &errors))
    {
      // "* Line 3, Column 5\n  Missing ',' …\n"
      std::replace(errors.begin(), errors.end(), '\n', ' ');
      throw FileError("it is no JSON: " + errors);
    }
  }
  catch (const Json::Exception& error)
  {
    throw FileError(std::string("it is no JSON: ") + error.what());
  }
  return root;
}

std::string JsonText::line(const Json::Value& at) const
{
  const std::ptrdiff_t before = std::max<std::ptrdiff_t>(at.getOffsetStart(), 0);
  const auto start = this->Text.begin();
  return "line " + std::to_string(1 + std::count(start, start + before, '\n')) + ": ";
}

void JsonText::refuse(const Json::Value& at, const std::string& problem) const
{
  throw FileError(this->line(at) + problem);
}

const Json::Value& JsonText::member(const Json::Value& object, const char* name) const
{
  if (!object.isObject())
  {
    this->refuse(object, std::string("expected an object with the member ") + name);
  }
  if (!object.isMember(name))
  {
    this->refuse(object, std::string("expected a member ") + name);
  }
  return object[name];
}

int JsonText::integer(const Json::Value& object, const char* name, int lowest, int highest) const
{
  const Json::Value& value = this->member(object, name);
  if (!value.isInt() || value.asInt() < lowest || value.asInt() > highest)
  {
    this->refuse(value,
      std::string("expected a whole number from ") + std::to_string(lowest) + " to " +
        std::to_string(highest) + " as " + name);
  }
  return value.asInt();
}

std::optional<bool> JsonText::flag(const Json::Value& object, const char* name) const
{
  if (!object.isMember(name) || object[name].isNull())
  {
    return {};
  }
  const Json::Value& value = object[name];
  if (!value.isBool() && !(value.isInt() && (value.asInt() == 0 || value.asInt() == 1)))
  {
    this->refuse(value, std::string("expected true or false as ") + name);
  }
  return value.isBool() ? value.asBool() : value.asInt() == 1;
}

std::vector<double> JsonText::numbers(const Json::Value& array, const std::string& what) const
{
  if (!array.isArray())
  {
    this->refuse(array, "expected numbers in brackets as " + what);
  }
  std::vector<double> result;
  for (const Json::Value& value : array)
  {
    if (!value.isNumeric() || !std::isfinite(value.asDouble()))
    {
      this->refuse(
        value, "expected a number as " + what + "[" + std::to_string(result.size()) + "]");
    }
    result.push_back(value.asDouble());
  }
  return result;
}

std::vector<double> JsonText::points(const Json::Value& array) const
{
  if (!array.isArray())
  {
    this->refuse(array, "expected points in brackets as points");
  }
  std::vector<double> result;
  std::size_t space = 0;
  for (const Json::Value& value : array)
  {
    const std::string what = "points[" + std::to_string(result.size() / 3) + "]";
    std::vector<double> point = this->numbers(value, what);
    space = result.empty() ? point.size() : space;
    if (point.size() != space || (space != 2 && space != 3))
    {
      this->refuse(value,
        "expected " + (result.empty() ? std::string("2 or 3") : std::to_string(space)) +
          " coordinates as " + what + ", found " + std::to_string(point.size()));
    }
    point.resize(3, 0.0);
    result.insert(result.end(), point.begin(), point.end());
  }
  return result;
}

} // namespace footpoint::files
