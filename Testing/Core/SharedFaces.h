// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Reads trimmed faces of real models from the folder json of FOOTPOINT_SHARED_DATA.

#include "TrimShapes.h"

#include "footpoint/splines/surface.h"
#include "footpoint/trims/trim_loop.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace shared
{

/// As much of JSON as these files use.
struct Json
{
  double number = 0.0; ///< true is 1
  std::string text;
  std::vector<Json> items;
  std::map<std::string, Json> members;

  /// 0 and no items where there is no such member.
  const Json& operator[](const std::string& name) const
  {
    static const Json none;
    const auto found = this->members.find(name);
    return found == this->members.end() ? none : found->second;
  }
  std::vector<double> numbers() const
  {
    std::vector<double> all;
    for (const Json& item : this->items)
    {
      all.push_back(item.number);
    }
    return all;
  }
};

class JsonReader
{
public:
  explicit JsonReader(const std::string& line)
    : At(line.c_str())
  {
  }

  Json value()
  {
    Json json;
    if (this->take('{'))
    {
      while (!this->take('}'))
      {
        const std::string name = this->quoted();
        this->need(':');
        json.members[name] = this->value();
        this->take(',');
      }
    }
    else if (this->take('['))
    {
      while (!this->take(']'))
      {
        json.items.push_back(this->value());
        this->take(',');
      }
    }
    else if (this->next() == '"')
    {
      json.text = this->quoted();
    }
    else if (this->word("true"))
    {
      json.number = 1.0;
    }
    else if (!this->word("false") && !this->word("null"))
    {
      char* end = nullptr;
      json.number = std::strtod(this->At, &end);
      if (end == this->At)
      {
        throw std::runtime_error("no JSON value at: " + std::string(this->At).substr(0, 40));
      }
      this->At = end;
    }
    return json;
  }

private:
  char next()
  {
    while (*this->At == ' ' || *this->At == '\n')
    {
      ++this->At;
    }
    return *this->At;
  }
  bool take(char wanted)
  {
    const bool there = this->next() == wanted;
    this->At += there ? 1 : 0;
    return there;
  }
  void need(char wanted)
  {
    if (!this->take(wanted))
    {
      throw std::runtime_error("JSON lacks a character " + std::string(1, wanted));
    }
  }
  bool word(const std::string& wanted)
  {
    const bool there =
      std::string(this->At, std::min(wanted.size(), std::strlen(this->At))) == wanted;
    this->At += there ? wanted.size() : 0;
    return there;
  }
  std::string quoted()
  {
    this->need('"');
    std::string text;
    for (; *this->At != '"'; ++this->At)
    {
      this->At += *this->At == '\\' ? 1 : 0;
      text += *this->At;
    }
    ++this->At;
    return text;
  }

  const char* At;
};

struct Face
{
  std::string name; ///< file and number
  std::shared_ptr<const footpoint::Surface> surface;
  std::vector<footpoint::TrimLoop> loops;
  bool trimmed;
  double tolerance;
};

inline footpoint::Surface surface_of(const Json& face)
{
  const auto nu = static_cast<Eigen::Index>(face["nu"].number);
  const auto nv = static_cast<Eigen::Index>(face["nv"].number);
  footpoint::Points points(3, nu * nv);
  Eigen::VectorXd weights(nu * nv);
  for (Eigen::Index i = 0; i < nu; ++i)
  {
    for (Eigen::Index j = 0; j < nv; ++j)
    {
      const std::vector<double> point = face["cp"].items[i].items[j].numbers();
      points.col(j * nu + i) << point[0], point[1], point[2];
      weights[j * nu + i] = point[3];
    }
  }
  return { footpoint::KnotVector(
             static_cast<int>(face["degreeU"].number), face["knotsU"].numbers()),
    footpoint::KnotVector(static_cast<int>(face["degreeV"].number), face["knotsV"].numbers()),
    points, weights };
}

/// In the direction in which the loop is walked.
inline std::shared_ptr<const footpoint::Curve> curve_of(const Json& json)
{
  const std::vector<Json>& columns = json["cp"].items;
  const auto count = static_cast<Eigen::Index>(columns.size());
  footpoint::Points points = footpoint::Points::Zero(3, count);
  Eigen::VectorXd weights(count);
  for (Eigen::Index i = 0; i < count; ++i)
  {
    const std::vector<double> point = columns[i].numbers();
    points.col(i).head<2>() << point[0], point[1];
    weights[i] = point[2];
  }
  const footpoint::Curve curve(
    footpoint::KnotVector(static_cast<int>(json["degree"].number), json["knots"].numbers()), points,
    weights);
  return json["reversed"].number != 0.0 ? trims::reversed(curve)
                                        : std::make_shared<const footpoint::Curve>(curve);
}

/// All faces of a file of the folder json; none where there is no such file.
inline std::vector<Face> faces_of(const std::string& file)
{
  const char* folder = std::getenv("FOOTPOINT_SHARED_DATA");
  std::ifstream stream(std::string(folder ? folder : "") + "/json/" + file);
  std::vector<Face> faces;
  for (std::string line; std::getline(stream, line);)
  {
    const Json json = JsonReader(line).value();
    if (json["type"].text != "face")
    {
      continue;
    }
    Face face{ file + " " + std::to_string(faces.size()),
      std::make_shared<const footpoint::Surface>(surface_of(json)), {},
      json["trimmed"].number != 0.0, json["tolerance"].number };
    for (const Json& loop : json["loops"].items)
    {
      face.loops.emplace_back();
      for (const Json& curve : loop["curves"].items)
      {
        face.loops.back().curves.push_back(curve_of(curve));
      }
    }
    faces.push_back(std::move(face));
  }
  return faces;
}

} // namespace shared
