// SPDX-License-Identifier: BSD-3-Clause
// Private: a small XML document as a tree.

#ifndef XmlTree_h
#define XmlTree_h

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace footpoint::files
{

struct XmlElement
{
  std::string name;
  std::vector<std::pair<std::string, std::string>> attributes;
  std::vector<XmlElement> children;
  std::string text;  ///< all of its own text
  int line = 0;      ///< where it begins
  int text_line = 0; ///< where its text begins

  /// Null where there is none of that name.
  const std::string* attribute(std::string_view key) const;
};

/// The root of a document. \throw FileError naming the line where it is not well formed
XmlElement parse_xml(std::string_view text);

/// Text as it may stand in an attribute in double quotes.
std::string escape_xml(const std::string& text);

} // namespace footpoint::files

#endif
