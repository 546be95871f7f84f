// SPDX-License-Identifier: BSD-3-Clause
#include "GeomdlFormat.h"

#include "JsonText.h"
#include "SplineBlocks.h"
#include "TextScanner.h"
#include "TrimDirection.h"

#include "footpoint/common/errors.h"
#include "footpoint/splines/knot_vector.h"

#include <limits>
#include <set>

namespace footpoint::files
{

namespace
{

class GeomdlReader : private JsonText
{
public:
  using JsonText::JsonText;

  SplineFile read();

private:
  using Value = Json::Value;

  void warn_of_others(const Value& object, const std::set<std::string>& known);

  Spline read_curve(const Value& data);
  Spline read_surface(const Value& data);
  void read_basis(
    const Value& data, Spline& spline, int direction, const std::string& suffix) const;
  void read_control_points(const Value& data, Spline& spline);
  void read_name(const Value& data, Spline& spline) const;
  std::vector<Spline> read_trim(const Value& trim);
  void read_trims(const Value& trims, Spline& surface);
  void check_spline(const Value& data, const Spline& spline) const;

  SplineFile File;
  std::set<std::string> Unknown; ///< members that were warned of, once each
};

void GeomdlReader::warn_of_others(const Value& object, const std::set<std::string>& known)
{
  for (const std::string& name : object.getMemberNames())
  {
    if (known.count(name) == 0 && this->Unknown.insert(name).second)
    {
      this->File.warnings.push_back(
        this->line(object[name]) + "the member " + in_quotes(name) + " is left out");
    }
  }
}

void GeomdlReader::read_basis(
  const Value& data, Spline& spline, int direction, const std::string& suffix) const
{
  spline.degree[direction] = this->integer(data, ("degree" + suffix).c_str(), 1, kMaximumDegree);
  const std::string name = "knotvector" + suffix;
  const Value& knots = this->member(data, name.c_str());
  spline.knots[direction] = this->numbers(knots, name);
  const auto least = static_cast<std::size_t>(2 * spline.degree[direction] + 2);
  if (spline.knots[direction].size() < least)
  {
    this->refuse(knots,
      "expected " + std::to_string(least) + " numbers at least in " + name + ", found " +
        std::to_string(spline.knots[direction].size()));
  }
}

/// Control points and weights, in the order of the file.
void GeomdlReader::read_control_points(const Value& data, Spline& spline)
{
  const Value& control_points = this->member(data, "control_points");
  const Value& points = this->member(control_points, "points");
  this->warn_of_others(control_points, { "points", "weights" });
  spline.points = this->points(points);
  const std::size_t count = spline.size(0) * (spline.dimension == 2 ? spline.size(1) : 1);
  if (spline.number_of_points() != count)
  {
    this->refuse(points,
      "expected " + std::to_string(count) +
        " control points by the knots and "
        "degrees, found " +
        std::to_string(spline.number_of_points()));
  }
  if (control_points.isMember("weights"))
  {
    spline.weights = this->numbers(control_points["weights"], "weights");
    if (spline.weights.size() != count)
    {
      this->refuse(control_points["weights"],
        "expected " + std::to_string(count) + " weights, found " +
          std::to_string(spline.weights.size()));
    }
  }
}

void GeomdlReader::read_name(const Value& data, Spline& spline) const
{
  if (data.isMember("name"))
  {
    if (!data["name"].isString())
    {
      this->refuse(data["name"], "expected a text as name");
    }
    spline.name = data["name"].asString();
  }
}

void GeomdlReader::check_spline(const Value& data, const Spline& spline) const
{
  try
  {
    check(spline);
  }
  catch (const GeometryError& error)
  {
    this->refuse(data, error.what());
  }
}

// What of a spline is no geometry: its kind, which the other members tell, and the step of samples.
const std::set<std::string> kCommon{ "type", "rational", "dimension", "control_points", "delta",
  "sample_size", "name", "id", "reversed" };

Spline GeomdlReader::read_curve(const Value& data)
{
  Spline curve;
  curve.dimension = 1;
  this->read_basis(data, curve, 0, "");
  std::set<std::string> known = kCommon;
  known.insert({ "degree", "knotvector" });
  this->warn_of_others(data, known);
  this->read_control_points(data, curve);
  this->read_name(data, curve);
  this->check_spline(data, curve);
  return curve;
}

Spline GeomdlReader::read_surface(const Value& data)
{
  Spline surface;
  surface.dimension = 2;
  this->read_basis(data, surface, 0, "_u");
  this->read_basis(data, surface, 1, "_v");
  std::set<std::string> known = kCommon;
  known.insert(
    { "degree_u", "degree_v", "knotvector_u", "knotvector_v", "size_u", "size_v", "trims" });
  this->warn_of_others(data, known);
  for (int direction = 0; direction < 2; ++direction)
  {
    const char* const name = direction == 0 ? "size_u" : "size_v";
    const int size = this->integer(data, name, 2, std::numeric_limits<int>::max());
    if (static_cast<std::size_t>(size) != surface.size(direction))
    {
      this->refuse(data[name],
        std::string(name) + " = " + std::to_string(size) +
          " does not fit the knots and the degree, which mean " +
          std::to_string(surface.size(direction)));
    }
  }
  this->read_control_points(data, surface);
  reorder(surface, surface.size(1), surface.size(0));
  this->read_name(data, surface);
  surface.reversed = this->flag(data, "reversed").value_or(false);
  this->check_spline(data, surface);
  if (data.isMember("trims"))
  {
    this->read_trims(data["trims"], surface);
  }
  return surface;
}

/// The curves of one trim.
std::vector<Spline> GeomdlReader::read_trim(const Value& trim)
{
  const Value& type = this->member(trim, "type");
  const std::string kind = type.isString() ? type.asString() : "";
  if (kind == "spline")
  {
    return { this->read_curve(trim) };
  }
  if (kind == "freeform")
  {
    Spline polyline;
    polyline.dimension = 1;
    polyline.points = this->points(this->member(trim, "points"));
    if (polyline.number_of_points() < 2)
    {
      this->refuse(trim, "expected 2 points at least in a trim");
    }
    return { polyline };
  }
  if (kind != "container")
  {
    this->refuse(type, "expected spline, freeform or container as the type of a trim");
  }
  std::vector<Spline> curves;
  const Value& data = this->member(trim, "data");
  for (const Value& curve : data.isArray() ? data : Value(Json::arrayValue))
  {
    const Value& curve_type = this->member(curve, "type");
    if (curve_type.isString() && curve_type.asString() == "container")
    {
      this->refuse(curve_type, "expected spline or freeform in a container of trims");
    }
    const std::vector<Spline> one = this->read_trim(curve);
    curves.insert(curves.end(), one.begin(), one.end());
  }
  if (curves.empty())
  {
    this->refuse(data, "expected curves in a container of trims");
  }
  return curves;
}

void GeomdlReader::read_trims(const Value& trims, Spline& surface)
{
  const Value& data = this->member(trims, "data");
  if (!data.isArray())
  {
    this->refuse(data, "expected trims in brackets as data");
  }
  bool all_holes = true;
  for (const Value& trim : data)
  {
    std::vector<Spline> loop = this->read_trim(trim);
    for (const Spline& curve : loop)
    {
      for (std::size_t i = 2; i < curve.points.size(); i += 3)
      {
        if (curve.points[i] != 0.0)
        {
          this->refuse(trim,
            "point " + std::to_string(i / 3) + " of a trim has a third coordinate that is not 0");
        }
      }
    }
    const bool counter_clockwise = is_counter_clockwise(loop);
    // Without a word the direction counts.
    const bool keeps_inside = this->flag(trim, "reversed").value_or(counter_clockwise);
    if (keeps_inside != counter_clockwise)
    {
      loop = reversed(loop);
    }
    all_holes = all_holes && !keeps_inside;
    surface.loops.push_back(std::move(loop));
  }
  if (all_holes && !surface.loops.empty())
  {
    surface.loops.insert(surface.loops.begin(), domain_border(surface));
  }
}

SplineFile GeomdlReader::read()
{
  const Value root = this->parse();
  const Value& shape = this->member(root, "shape");
  const Value& type = this->member(shape, "type");
  const std::string kind = type.isString() ? type.asString() : "";
  if (kind != "curve" && kind != "surface" && kind != "volume")
  {
    this->refuse(type, "expected curve, surface or volume as the type of the shape");
  }
  if (kind == "volume")
  {
    this->File.warnings.push_back(this->line(shape) + "the volumes are left out");
    return std::move(this->File);
  }
  this->warn_of_others(root, { "shape" });
  this->warn_of_others(shape, { "type", "count", "data" });
  const auto add = [&](const Value& data)
  {
    this->File.splines.push_back(
      kind == "curve" ? this->read_curve(data) : this->read_surface(data));
  };
  const Value& data = this->member(shape, "data");
  if (!data.isArray()) // versions before 5 write a single shape so
  {
    add(data);
    return std::move(this->File);
  }
  if (shape.isMember("count") &&
    (!shape["count"].isUInt() || shape["count"].asUInt() != data.size()))
  {
    this->refuse(shape["count"],
      "expected the number of the shapes, " + std::to_string(data.size()) + ", as count");
  }
  for (const Value& one : data)
  {
    add(one);
  }
  return std::move(this->File);
}

} // namespace

SplineFile read_geomdl(std::string_view text)
{
  return GeomdlReader(text).read();
}

} // namespace footpoint::files
