// SPDX-License-Identifier: BSD-3-Clause
#include "GoToolsFormat.h"

#include "SplineBlocks.h"
#include "TextScanner.h"

#include "footpoint/common/errors.h"
#include "footpoint/splines/knot_vector.h"
#include "footpoint/splines/validation.h"

#include <array>
#include <charconv>
#include <climits>
#include <limits>
#include <map>

namespace footpoint::files
{

namespace
{

constexpr int kCurve = 100;
constexpr int kSurface = 200;
/// Most further integers in the line of a header; GoTools itself writes 4, a colour.
constexpr int kMostExtra = 100;

/// The classes of GoTools, by the names there.
const std::map<int, const char*>& classes()
{
  static const std::map<int, const char*> names{ { kCurve, "SplineCurve" },
    { 110, "CurveOnSurface" }, { 111, "CurveOnVolume" }, { 120, "Line" }, { 130, "Circle" },
    { 140, "Ellipse" }, { 150, "BoundedCurve" }, { 160, "Hyperbola" }, { 170, "Parabola" },
    { kSurface, "SplineSurface" }, { 210, "BoundedSurface" }, { 211, "SurfaceOnVolume" },
    { 220, "GoBaryPolSurface" }, { 230, "GoHBSplineParamSurface" }, { 240, "CompositeSurface" },
    { 250, "Plane" }, { 260, "Cylinder" }, { 261, "SurfaceOfLinearExtrusion" }, { 270, "Sphere" },
    { 280, "Cone" }, { 290, "Torus" }, { 291, "SurfaceOfRevolution" }, { 292, "Disc" },
    { 293, "LRSplineSurface" }, { 294, "TSplineSurface" }, { 300, "Go3dsObject" },
    { 310, "GoHeTriang" }, { 320, "GoSdTriang" }, { 330, "GoQuadMesh" }, { 340, "GoHybridMesh" },
    { 350, "ParamTriang" }, { 360, "GoVrmlGeometry" }, { 400, "PointCloud" }, { 410, "LineCloud" },
    { 500, "GoTriangleSets" }, { 510, "RectGrid" }, { 700, "SplineVolume" },
    { 710, "BoundedVolume" }, { 720, "Parallelepiped" }, { 721, "SphereVolume" },
    { 722, "CylinderVolume" }, { 723, "ConeVolume" }, { 724, "TorusVolume" } };
  return names;
}

/// The class of an object. \throw FileError where the line is no header
int read_header(TextScanner& scanner)
{
  const int line = scanner.line();
  const int type = scanner.integer("the class of an object", 0, INT_MAX);
  if (classes().count(type) == 0)
  {
    throw FileError("line " + std::to_string(line) +
      ": expected the header of an object (100 1 0 0 or 200 1 0 0), found class " +
      std::to_string(type) + ", which GoTools does not have");
  }
  scanner.integer("the major version", 0, INT_MAX);
  scanner.integer("the minor version", 0, INT_MAX);
  const int extra = scanner.integer("the number of further values", 0, kMostExtra);
  for (int i = 0; i < extra; ++i)
  {
    scanner.integer("further value " + std::to_string(i), INT_MIN, INT_MAX);
  }
  return type;
}

/// Whether a line is the header of an object and nothing else.
bool is_header(std::string_view text)
{
  TextScanner line(text);
  try
  {
    read_header(line);
  }
  catch (const FileError&)
  {
    return false;
  }
  return line.at_end();
}

/// Passes what belongs to an object of unknown length: everything up to the next header.
void skip_object(TextScanner& scanner)
{
  while (!scanner.at_end())
  {
    TextScanner ahead = scanner;
    if (is_header(ahead.rest_of_line()))
    {
      return;
    }
    scanner = ahead;
  }
}

/// Number of control points, order and knots of one direction.
void read_basis(TextScanner& scanner, Spline& spline, int direction)
{
  const std::string along = spline.dimension == 1 ? "" : (direction == 0 ? " in u" : " in v");
  const int count = scanner.integer("the number of control points" + along, 2, INT_MAX);
  const int order = scanner.integer("the order" + along, 2, kMaximumDegree + 1);
  if (count < order)
  {
    throw FileError("line " + std::to_string(scanner.line()) + ": " + std::to_string(count) +
      " control points" + along + " are too few for the order " + std::to_string(order));
  }
  spline.degree[direction] = order - 1;
  std::vector<double>& knots = spline.knots[direction];
  // Not reserved: the file need not be as long as it says.
  for (long long i = 0; i < static_cast<long long>(count) + order; ++i)
  {
    knots.push_back(scanner.number("knot " + std::to_string(i) + along));
  }
}

void read_control_points(TextScanner& scanner, Spline& spline, int space, bool rational)
{
  const std::size_t count = spline.size(0) * (spline.dimension == 2 ? spline.size(1) : 1);
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::string what = "of control point " + std::to_string(i);
    std::array<long double, 3> point{ { 0, 0, 0 } };
    for (int k = 0; k < space; ++k)
    {
      point[k] = scanner.long_number("coordinate " + std::to_string(k) + " " + what);
    }
    long double weight = 1;
    if (rational)
    {
      weight = scanner.number("the weight " + what);
      if (!(weight > 0))
      {
        throw FileError(
          "line " + std::to_string(scanner.line()) + ": the weight " + what + " is not positive");
      }
      spline.weights.push_back(static_cast<double>(weight));
    }
    for (const long double coordinate : point)
    {
      spline.points.push_back(static_cast<double>(coordinate / weight));
    }
  }
}

Spline read_spline(TextScanner& scanner, int dimension)
{
  Spline spline;
  spline.dimension = dimension;
  const int space = scanner.integer("the dimension of space", 1, INT_MAX);
  if (space > 3)
  {
    throw FileError("line " + std::to_string(scanner.line()) + ": the dimension of space is " +
      std::to_string(space) + "; 2 or 3 is needed");
  }
  const bool rational = scanner.integer("whether it is rational", 0, 1) == 1;
  for (int direction = 0; direction < dimension; ++direction)
  {
    read_basis(scanner, spline, direction);
  }
  read_control_points(scanner, spline, space, rational);
  if (space == 1)
  {
    throw FileError("a function, not a geometry: the dimension of space is 1");
  }
  return spline;
}

/// A product of two doubles, to the digits that give it back when divided by one of them.
std::string to_long_text(long double number)
{
  std::array<char, 64> digits;
  const auto [end, problem] = std::to_chars(digits.data(), digits.data() + digits.size(), number,
    std::chars_format::general, std::numeric_limits<long double>::max_digits10);
  return problem == std::errc() ? std::string(digits.data(), end) : std::string();
}

void write_spline(std::string& text, const Spline& spline)
{
  const bool rational = !spline.weights.empty();
  text += (spline.dimension == 1 ? "100" : "200") + std::string(" 1 0 0\n3 ") +
    (rational ? "1\n" : "0\n");
  for (int direction = 0; direction < spline.dimension; ++direction)
  {
    text += std::to_string(spline.size(direction)) + " " +
      std::to_string(spline.degree[direction] + 1) + "\n";
    for (const double knot : spline.knots[direction])
    {
      text += to_text(knot) + " ";
    }
    text.back() = '\n';
  }
  for (std::size_t i = 0; i < spline.number_of_points(); ++i)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      const double coordinate = spline.points[3 * i + k];
      text += (k > 0 ? " " : "") +
        (rational ? to_long_text(static_cast<long double>(coordinate) * spline.weights[i])
                  : to_text(coordinate));
    }
    text += rational ? " " + to_text(spline.weights[i]) + "\n" : "\n";
  }
  text += '\n';
}

} // namespace

std::string write_go_tools(const std::vector<Spline>& splines, std::vector<std::string>& warnings)
{
  std::string text;
  bool named = false;
  for (std::size_t i = 0; i < splines.size(); ++i)
  {
    refuse_face_data(splines[i], i, "GoTools");
    named = named || !splines[i].name.empty();
    write_spline(text, splines[i]);
  }
  if (named)
  {
    warnings.push_back("names are left out, which the format GoTools does not have");
  }
  return text;
}

SplineFile read_go_tools(std::string_view text)
{
  SplineFile file;
  TextScanner scanner(text);
  while (!scanner.at_end())
  {
    const int line = scanner.line();
    const int type = read_header(scanner);
    const std::string object = "line " + std::to_string(line) + ": the " + classes().at(type);
    if (type != kCurve && type != kSurface)
    {
      skip_object(scanner);
      file.warnings.push_back(
        object + " (class " + std::to_string(type) + ") is left out; only splines are read");
      continue;
    }
    Spline spline = read_spline(scanner, type == kCurve ? 1 : 2);
    try
    {
      check(spline);
    }
    catch (const GeometryError& error)
    {
      throw FileError(object + ": " + error.what());
    }
    file.splines.push_back(std::move(spline));
  }
  return file;
}

} // namespace footpoint::files
