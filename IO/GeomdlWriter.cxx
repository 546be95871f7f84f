// SPDX-License-Identifier: BSD-3-Clause
#include "GeomdlFormat.h"

#include "SplineBlocks.h"
#include "TrimDirection.h"

#include "footpoint/splines/validation.h"

#include "vtk_jsoncpp.h"

namespace footpoint::files
{

namespace
{

/// A number with a point or an exponent: a whole number would lose the sign of -0.
std::string number(double value)
{
  const std::string text = to_text(value);
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

std::string numbers(const std::vector<double>& values)
{
  std::string text = "[";
  for (const double value : values)
  {
    text += (text.size() > 1 ? ", " : "") + number(value);
  }
  return text + "]";
}

/// Points one a line. \param space numbers of each
std::string points(const Spline& spline, int space, const std::string& indent)
{
  std::string text = "[";
  for (std::size_t i = 0; i < spline.number_of_points(); ++i)
  {
    const auto first = spline.points.begin() + static_cast<std::ptrdiff_t>(3 * i);
    text += (i > 0 ? ",\n" : "\n") + indent + " " + numbers({ first, first + space });
  }
  return text + "\n" + indent + "]";
}

std::string member(const std::string& indent, const char* name, const std::string& value)
{
  return indent + "\"" + name + "\": " + value;
}

/// Members of a spline after the basis.
std::string control_points(const Spline& spline, int space, const std::string& indent)
{
  std::string text = member(indent, "control_points", "{\n") +
    member(indent + " ", "points", points(spline, space, indent + " "));
  if (!spline.weights.empty())
  {
    text += ",\n" + member(indent + " ", "weights", numbers(spline.weights));
  }
  return text + "\n" + indent + "}";
}

std::string curve(const Spline& spline, int space, const std::string& indent)
{
  return member(indent, "type", "\"spline\"") + ",\n" +
    member(indent, "rational", spline.weights.empty() ? "false" : "true") + ",\n" +
    member(indent, "dimension", std::to_string(space)) + ",\n" +
    member(indent, "degree", std::to_string(spline.degree[0])) + ",\n" +
    member(indent, "knotvector", numbers(spline.knots[0])) + ",\n" +
    control_points(spline, space, indent);
}

/// A curve of a loop, in the plane.
std::string trim_curve(const Spline& spline, const std::string& indent)
{
  return spline.knots[0].empty() ? member(indent, "type", "\"freeform\"") + ",\n" +
      member(indent, "dimension", "2") + ",\n" + member(indent, "points", points(spline, 2, indent))
                                 : curve(spline, 2, indent);
}

std::string loop(const std::vector<Spline>& curves, bool keeps_inside, const std::string& indent)
{
  std::string text = indent + "{\n";
  const std::string inner = indent + " ";
  if (curves.size() == 1)
  {
    text += trim_curve(curves.front(), inner);
  }
  else
  {
    text += member(inner, "type", "\"container\"") + ",\n" +
      member(inner, "count", std::to_string(curves.size())) + ",\n" + member(inner, "data", "[");
    for (std::size_t i = 0; i < curves.size(); ++i)
    {
      text += (i > 0 ? ",\n" : "\n") + inner + " {\n" + trim_curve(curves[i], inner + "  ") + "\n" +
        inner + " }";
    }
    text += "\n" + inner + "]";
  }
  return text + ",\n" + member(inner, "reversed", keeps_inside ? "true" : "false") + "\n" + indent +
    "}";
}

std::string loops(const Spline& surface, std::size_t index, const std::string& indent)
{
  std::string text;
  bool any_keeps = false;
  for (const std::vector<Spline>& curves : surface.loops)
  {
    const bool keeps = is_counter_clockwise(curves);
    any_keeps = any_keeps || keeps;
    text += (text.empty() ? "" : ",\n") + loop(curves, keeps, indent + "  ");
  }
  if (!any_keeps)
  {
    throw FileError("spline " + std::to_string(index) +
      ": all its trim loops run clockwise, which keeps nothing; in a geomdl file it would keep "
      "what "
      "is outside of them");
  }
  return member(indent, "trims", "{\n") +
    member(indent + " ", "count", std::to_string(surface.loops.size())) + ",\n" +
    member(indent + " ", "data", "[\n") + text + "\n" + indent + " ]\n" + indent + "}";
}

std::string surface(const Spline& spline, std::size_t index, const std::string& indent)
{
  Spline by_v = spline;
  reorder(by_v, spline.size(0), spline.size(1));
  std::string text = member(indent, "type", "\"spline\"") + ",\n" +
    member(indent, "rational", spline.weights.empty() ? "false" : "true") + ",\n" +
    member(indent, "dimension", "3") + ",\n";
  for (int direction = 0; direction < 2; ++direction)
  {
    const std::string end = direction == 0 ? "_u" : "_v";
    text += member(indent, ("degree" + end).c_str(), std::to_string(spline.degree[direction])) +
      ",\n" + member(indent, ("knotvector" + end).c_str(), numbers(spline.knots[direction])) +
      ",\n" + member(indent, ("size" + end).c_str(), std::to_string(spline.size(direction))) +
      ",\n";
  }
  text += control_points(by_v, 3, indent);
  text += spline.reversed ? ",\n" + member(indent, "reversed", "true") : "";
  text += spline.loops.empty() ? "" : ",\n" + loops(spline, index, indent);
  return text;
}

} // namespace

std::string write_geomdl(const std::vector<Spline>& splines)
{
  const int dimension = splines.empty() ? 1 : splines.front().dimension;
  std::string text = std::string("{\n \"shape\": {\n  \"type\": ") +
    (dimension == 1 ? "\"curve\"" : "\"surface\"") +
    ",\n  \"count\": " + std::to_string(splines.size()) + ",\n  \"data\": [";
  for (std::size_t i = 0; i < splines.size(); ++i)
  {
    if (splines[i].dimension != dimension)
    {
      throw FileError("spline " + std::to_string(i) +
        ": curves and surfaces do not go into one geomdl file, and spline 0 is a " +
        (dimension == 1 ? "curve" : "surface"));
    }
    const std::string indent = "    ";
    text += (i > 0 ? ",\n   {\n" : "\n   {\n") +
      (dimension == 1 ? curve(splines[i], 3, indent) : surface(splines[i], i, indent));
    if (!splines[i].name.empty())
    {
      text += ",\n" +
        member(indent, "name", Json::valueToQuotedString(checked_name(splines[i], i).c_str()));
    }
    text += "\n   }";
  }
  return text + "\n  ]\n }\n}\n";
}

} // namespace footpoint::files
