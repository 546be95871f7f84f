// SPDX-License-Identifier: BSD-3-Clause
#include "GPlusSmoFormat.h"

#include "SplineBlocks.h"
#include "TextScanner.h"
#include "XmlTree.h"

#include "footpoint/common/errors.h"
#include "footpoint/splines/knot_vector.h"
#include "footpoint/splines/validation.h"

#include <climits>
#include <set>

namespace footpoint::files
{

namespace
{

/// Something that G+Smo has and we do not read.
class Unsupported : public FileError
{
public:
  using FileError::FileError;
};

std::string line_of(const XmlElement& element)
{
  return "line " + std::to_string(element.line) + ": ";
}

std::string described(const XmlElement& element)
{
  const std::string* type = element.attribute("type");
  const std::string* id = element.attribute("id");
  return element.name + (type ? " of type " + in_quotes(*type) : std::string()) +
    (id ? " with id " + in_quotes(*id) : std::string());
}

/// Children of that name; all others than the allowed ones are unsupported.
const XmlElement& only_child(const XmlElement& parent, const std::string& name)
{
  const XmlElement* found = nullptr;
  for (const XmlElement& child : parent.children)
  {
    if (child.name == name && found)
    {
      throw FileError(line_of(child) + parent.name + " has a second element " + name);
    }
    found = child.name == name ? &child : found;
  }
  if (!found)
  {
    throw FileError(line_of(parent) + "expected an element " + name + " in " + described(parent));
  }
  return *found;
}

void allow_children(const XmlElement& parent, const std::set<std::string>& allowed)
{
  for (const XmlElement& child : parent.children)
  {
    if (allowed.count(child.name) == 0)
    {
      throw Unsupported(line_of(child) + "the element " + in_quotes(child.name) + " in it");
    }
  }
}

void allow_attributes(const XmlElement& element, const std::set<std::string>& allowed)
{
  for (const auto& [name, value] : element.attributes)
  {
    const bool plain_text = name == "format" && (value == "ascii" || value == "ASCII");
    if (allowed.count(name) == 0 && !plain_text)
    {
      throw Unsupported(line_of(element) + "the attribute " + in_quotes(name) + " = " +
        in_quotes(value) + " of its " + element.name);
    }
  }
}

/// A whole number in an attribute that has to be there.
int integer_attribute(const XmlElement& element, const std::string& name, int lowest, int highest)
{
  const std::string* value = element.attribute(name);
  if (!value)
  {
    throw FileError(line_of(element) + "expected an attribute " + name + " of " + element.name);
  }
  TextScanner scanner(*value, element.line);
  const int number = scanner.integer("the attribute " + name, lowest, highest);
  if (!scanner.at_end())
  {
    throw FileError(line_of(element) + "expected a whole number as attribute " + name + ", found " +
      in_quotes(*value));
  }
  return number;
}

/// All numbers of an element's text.
std::vector<double> read_numbers(const XmlElement& element, const std::string& what)
{
  std::vector<double> numbers;
  TextScanner scanner(element.text, element.text_line);
  while (!scanner.at_end())
  {
    numbers.push_back(scanner.number(what + " " + std::to_string(numbers.size())));
  }
  return numbers;
}

void check_type(const XmlElement& basis, const std::string& type)
{
  const std::string* found = basis.attribute("type");
  if (!found || *found != type)
  {
    throw FileError(line_of(basis) + "expected a Basis of type '" + type + "', found " +
      (found ? in_quotes(*found) : std::string("none")));
  }
}

/// A BSplineBasis: degree and knots of one direction.
void read_direction(const XmlElement& basis, Spline& spline, int direction)
{
  check_type(basis, "BSplineBasis");
  allow_attributes(basis, { "type", "index", "id" });
  allow_children(basis, { "KnotVector" });
  if (basis.attribute("index") && integer_attribute(basis, "index", 0, INT_MAX) != direction)
  {
    throw FileError(line_of(basis) + "expected the Basis with index " + std::to_string(direction) +
      ", found " + in_quotes(*basis.attribute("index")));
  }
  const XmlElement& knots = only_child(basis, "KnotVector");
  allow_attributes(knots, { "degree" });
  spline.degree[direction] = integer_attribute(knots, "degree", 0, INT_MAX);
  spline.knots[direction] = read_numbers(knots, "knot");
  if (spline.degree[direction] < 1 || spline.degree[direction] > kMaximumDegree)
  {
    throw Unsupported(line_of(knots) + "its degree " + std::to_string(spline.degree[direction]));
  }
  if (spline.knots[direction].size() < 2 * static_cast<std::size_t>(spline.degree[direction]) + 2)
  {
    throw FileError(line_of(knots) + "expected " +
      std::to_string(2 * spline.degree[direction] + 2) + " knots at least, found " +
      std::to_string(spline.knots[direction].size()));
  }
}

/// The part of a basis that is no weight.
void read_polynomial_basis(const XmlElement& basis, Spline& spline)
{
  if (spline.dimension == 1)
  {
    read_direction(basis, spline, 0);
    return;
  }
  check_type(basis, "TensorBSplineBasis2");
  allow_children(basis, { "Basis" });
  if (basis.children.size() != 2)
  {
    throw FileError(line_of(basis) + "expected two elements Basis, found " +
      std::to_string(basis.children.size()));
  }
  read_direction(basis.children[0], spline, 0);
  read_direction(basis.children[1], spline, 1);
}

void read_control_points(const XmlElement& coefs, Spline& spline)
{
  allow_attributes(coefs, { "geoDim" });
  const int space = integer_attribute(coefs, "geoDim", 1, INT_MAX);
  if (space != 2 && space != 3)
  {
    throw Unsupported(line_of(coefs) + "its geoDim " + std::to_string(space));
  }
  const std::vector<double> numbers = read_numbers(coefs, "number");
  const std::size_t count = spline.size(0) * (spline.dimension == 2 ? spline.size(1) : 1);
  if (numbers.size() != count * static_cast<std::size_t>(space))
  {
    throw FileError(line_of(coefs) + "expected " + std::to_string(count) + " control points of " +
      std::to_string(space) + " numbers, found " + std::to_string(numbers.size()) + " numbers");
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      spline.points.push_back(k < space ? numbers[i * static_cast<std::size_t>(space) + k] : 0.0);
    }
  }
}

Spline read_geometry(const XmlElement& geometry)
{
  const std::string* type = geometry.attribute("type");
  if (!type)
  {
    throw FileError(line_of(geometry) + "expected an attribute type of Geometry");
  }
  const bool rational = *type == "Nurbs" || *type == "TensorNurbs2";
  Spline spline;
  spline.dimension = *type == "BSpline" || *type == "Nurbs" ? 1 : 2;
  if (!rational && *type != "BSpline" && *type != "TensorBSpline2")
  {
    throw Unsupported("this type");
  }
  allow_children(geometry, { "Basis", "coefs" });
  const XmlElement& basis = only_child(geometry, "Basis");
  const XmlElement* weights = nullptr;
  if (rational)
  {
    check_type(basis, spline.dimension == 1 ? "NurbsBasis" : "TensorNurbsBasis2");
    allow_children(basis, { "Basis", "weights" });
    weights = &only_child(basis, "weights");
    allow_attributes(*weights, {});
  }
  read_polynomial_basis(rational ? only_child(basis, "Basis") : basis, spline);
  read_control_points(only_child(geometry, "coefs"), spline);
  if (weights)
  {
    spline.weights = read_numbers(*weights, "weight");
    if (spline.weights.size() != spline.number_of_points())
    {
      throw FileError(line_of(*weights) + "expected " + std::to_string(spline.number_of_points()) +
        " weights, found " + std::to_string(spline.weights.size()));
    }
  }
  if (const std::string* label = geometry.attribute("label"))
  {
    spline.name = *label;
  }
  try
  {
    check(spline);
  }
  catch (const GeometryError& error)
  {
    throw FileError(line_of(geometry) + described(geometry) + ": " + error.what());
  }
  return spline;
}

/// Makes sure that the patches of a multi-patch are there.
void check_patches(const XmlElement& multi_patch, const XmlElement& root)
{
  std::set<int> ids;
  for (const XmlElement& element : root.children)
  {
    if (element.name == "Geometry" && element.attribute("id"))
    {
      ids.insert(integer_attribute(element, "id", INT_MIN, INT_MAX));
    }
  }
  const XmlElement& patches = only_child(multi_patch, "patches");
  const std::string* type = patches.attribute("type");
  std::vector<int> wanted;
  TextScanner scanner(patches.text, patches.text_line);
  while (!scanner.at_end())
  {
    wanted.push_back(scanner.integer("the id of a patch", INT_MIN, INT_MAX));
  }
  if (type && *type == "id_range")
  {
    if (wanted.size() != 2)
    {
      throw FileError(line_of(patches) + "expected the first and the last id of a range, found " +
        std::to_string(wanted.size()) + " numbers");
    }
    // As long as all were there so far, there are no more than elements of the file.
    for (long long id = wanted[0]; id <= wanted[1]; ++id)
    {
      if (ids.count(static_cast<int>(id)) == 0)
      {
        throw FileError(line_of(patches) + "there is no Geometry with id " + std::to_string(id));
      }
    }
    return;
  }
  for (const int id : wanted)
  {
    if (ids.count(id) == 0)
    {
      throw FileError(line_of(patches) + "there is no Geometry with id " + std::to_string(id));
    }
  }
}

void write_numbers(std::string& text, const std::vector<double>& numbers, std::size_t in_a_line)
{
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    text += to_text(numbers[i]) + ((i + 1) % in_a_line == 0 ? "\n" : " ");
  }
}

void write_basis(std::string& text, const Spline& spline)
{
  const std::string in = spline.dimension == 2 ? "    " : "   ";
  for (int direction = 0; direction < spline.dimension; ++direction)
  {
    text += in + "<Basis type=\"BSplineBasis\"" +
      (spline.dimension == 2 ? " index=\"" + std::to_string(direction) + "\"" : std::string()) +
      ">\n" + in + " <KnotVector degree=\"" + std::to_string(spline.degree[direction]) + "\">";
    write_numbers(text, spline.knots[direction], spline.knots[direction].size() + 1);
    text += "</KnotVector>\n" + in + "</Basis>\n";
  }
}

void write_geometry(std::string& text, const Spline& spline, std::size_t id)
{
  const bool surface = spline.dimension == 2;
  const bool rational = !spline.weights.empty();
  const std::string kind = std::string(surface ? "Tensor" : "") + (rational ? "Nurbs" : "BSpline");
  const std::string end = surface ? "2" : "";
  text += " <Geometry type=\"" + kind + end + "\" id=\"" + std::to_string(id) + "\"" +
    (spline.name.empty() ? "" : " label=\"" + escape_xml(checked_name(spline, id)) + "\"") + ">\n";
  if (rational)
  {
    text += "  <Basis type=\"" + kind + "Basis" + end + "\">\n";
  }
  if (surface)
  {
    text += "   <Basis type=\"TensorBSplineBasis2\">\n";
  }
  write_basis(text, spline);
  text += surface ? "   </Basis>\n" : "";
  if (rational)
  {
    text += "   <weights>\n";
    write_numbers(text, spline.weights, 1);
    text += "   </weights>\n  </Basis>\n";
  }
  text += "  <coefs geoDim=\"3\">\n";
  write_numbers(text, spline.points, 3);
  text += "  </coefs>\n </Geometry>\n";
}

} // namespace

SplineFile read_g_plus_smo(std::string_view text)
{
  const XmlElement root = parse_xml(text);
  if (root.name != "xml")
  {
    throw FileError(
      line_of(root) + "expected the element xml of G+Smo, found " + in_quotes(root.name));
  }
  SplineFile file;
  for (const XmlElement& element : root.children)
  {
    const std::string left_out = line_of(element) + "the " + described(element) + " is left out";
    if (element.name == "Geometry")
    {
      try
      {
        file.splines.push_back(read_geometry(element));
      }
      catch (const Unsupported& problem)
      {
        file.warnings.push_back(left_out + ", not read is: " + problem.what());
      }
    }
    else if (element.name == "MultiPatch")
    {
      check_patches(element, root);
      if (element.children.size() > 1)
      {
        file.warnings.push_back(line_of(element) + "of the " + described(element) +
          " the patches are read; how they are joined is left out");
      }
    }
    else
    {
      file.warnings.push_back(left_out);
    }
  }
  return file;
}

std::string write_g_plus_smo(const std::vector<Spline>& splines)
{
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<xml>\n";
  for (std::size_t i = 0; i < splines.size(); ++i)
  {
    refuse_face_data(splines[i], i, "G+Smo");
    write_geometry(text, splines[i], i);
  }
  return text + "</xml>\n";
}

} // namespace footpoint::files
