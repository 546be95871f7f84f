// SPDX-License-Identifier: BSD-3-Clause
#include "XmlTree.h"

#include "SplineFile.h"

#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkXMLParser.h"
#include "vtk_expat.h"

#include <limits>

namespace footpoint::files
{

namespace
{

/// Deeper documents are refused: they would exhaust the stack, and no spline needs them.
constexpr int kDeepest = 50;

/// Builds the tree. Nothing is thrown, as the caller is expat, in C.
class TreeParser : public vtkXMLParser
{
public:
  static TreeParser* New();
  vtkTypeMacro(TreeParser, vtkXMLParser);

  XmlElement Root; ///< its first child is the root of the document
  std::string Problem;

protected:
  TreeParser() { this->Open.push_back(&this->Root); }

  void StartElement(const char* name, const char** attributes) override
  {
    ++this->Depth;
    if (this->Depth > kDeepest)
    {
      this->Note("elements are nested more than " + std::to_string(kDeepest) + " deep");
      return;
    }
    // Children grow only at the end of the innermost open element: no pointer here goes stale.
    this->Open.back()->children.emplace_back();
    XmlElement* element = &this->Open.back()->children.back();
    this->Open.push_back(element);
    element->name = name;
    element->line = this->Line();
    for (; attributes && attributes[0]; attributes += 2)
    {
      element->attributes.emplace_back(attributes[0], attributes[1]);
    }
  }

  void EndElement(const char*) override
  {
    if (this->Depth <= kDeepest)
    {
      this->Open.pop_back();
    }
    --this->Depth;
  }

  void CharacterDataHandler(const char* data, int length) override
  {
    XmlElement* element = this->Open.back();
    if (element->text.empty())
    {
      element->text_line = this->Line();
    }
    element->text.append(data, static_cast<std::size_t>(length));
  }

  void ReportXmlParseError() override
  {
    this->Note(XML_ErrorString(XML_GetErrorCode(static_cast<XML_Parser>(this->Parser))));
  }

private:
  int Line()
  {
    return static_cast<int>(XML_GetCurrentLineNumber(static_cast<XML_Parser>(this->Parser)));
  }

  void Note(const std::string& problem)
  {
    if (this->Problem.empty())
    {
      this->Problem = "line " + std::to_string(this->Line()) + ": " + problem;
    }
  }

  std::vector<XmlElement*> Open;
  int Depth = 0;
};

vtkStandardNewMacro(TreeParser);

} // namespace

const std::string* XmlElement::attribute(std::string_view key) const
{
  for (const auto& [own, value] : this->attributes)
  {
    if (own == key)
    {
      return &value;
    }
  }
  return nullptr;
}

XmlElement parse_xml(std::string_view text)
{
  if (text.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
  {
    throw FileError("it is larger than 2 GiB");
  }
  vtkNew<TreeParser> parser;
  const int good = parser->Parse(text.data(), static_cast<unsigned int>(text.size()));
  if (!parser->Problem.empty())
  {
    throw FileError(parser->Problem);
  }
  if (!good || parser->Root.children.empty())
  {
    throw FileError("line 1: expected an XML document");
  }
  return std::move(parser->Root.children.front());
}

std::string escape_xml(const std::string& text)
{
  std::string result;
  for (const char c : text)
  {
    switch (c)
    {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\n':
      case '\t':
      case '\r':
        // Kept as they are they would be read as blanks.
        result += "&#" + std::to_string(static_cast<int>(c)) + ";";
        break;
      default:
        result += c;
    }
  }
  return result;
}

} // namespace footpoint::files
