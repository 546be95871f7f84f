// SPDX-License-Identifier: BSD-3-Clause
// Private: members of a JSON text by what they have to be, with the lines they stand in.

#ifndef JsonText_h
#define JsonText_h

#include "vtk_jsoncpp.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace footpoint::files
{

class JsonText
{
public:
  /// \param text has to live as long
  explicit JsonText(std::string_view text)
    : Text(text)
  {
  }

  /// The document, by the letter of the standard, no name twice in an object. \throw FileError
  Json::Value parse() const;

  /// "line 3: " of a value of that document.
  std::string line(const Json::Value& at) const;
  [[noreturn]] void refuse(const Json::Value& at, const std::string& problem) const;

  /// A member that has to be there. \throw FileError, as all below
  const Json::Value& member(const Json::Value& object, const char* name) const;
  int integer(const Json::Value& object, const char* name, int lowest, int highest) const;
  /// A truth value, as such or as 0 or 1; nothing where there is none.
  std::optional<bool> flag(const Json::Value& object, const char* name) const;
  /// Finite numbers. \param what they are called in messages
  std::vector<double> numbers(const Json::Value& array, const std::string& what) const;
  /// x, y, z of points, all in the plane or all in space.
  std::vector<double> points(const Json::Value& array) const;

private:
  std::string_view Text;
};

} // namespace footpoint::files

#endif
