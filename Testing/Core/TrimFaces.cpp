// SPDX-License-Identifier: BSD-3-Clause

#include "TrimFaces.h"

#include <cctype>
#include <cstdlib>
#include <fstream>
#include <map>
#include <stdexcept>
#include <utility>

namespace trims
{

namespace
{

/// A value of JSON, as far as those files go: numbers, arrays, objects, words.
struct Json
{
  double number = 0.0;
  std::string word; ///< of a string, or true, false, null
  std::vector<Json> items;
  std::map<std::string, Json> members;

  const Json& at(const std::string& name) const { return this->members.at(name); }
  bool has(const std::string& name) const { return this->members.count(name) > 0; }
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
  explicit JsonReader(const std::string& text)
    : At(text.c_str())
  {
  }

  Json read()
  {
    Json value;
    this->skip();
    if (*this->At == '[')
    {
      this->read_list(']', [&] { value.items.push_back(this->read()); });
    }
    else if (*this->At == '{')
    {
      this->read_list('}',
        [&]
        {
          const std::string name = this->read().word;
          this->skip();
          value.members[name] = this->read();
        });
    }
    else if (*this->At == '"')
    {
      for (++this->At; *this->At && *this->At != '"'; ++this->At)
      {
        value.word += *this->At;
      }
      this->advance();
    }
    else if (std::isalpha(static_cast<unsigned char>(*this->At)))
    {
      while (std::isalpha(static_cast<unsigned char>(*this->At)))
      {
        value.word += *this->At++;
      }
    }
    else
    {
      char* end = nullptr;
      value.number = std::strtod(this->At, &end);
      if (end == this->At)
      {
        throw std::runtime_error("not JSON: " + std::string(this->At).substr(0, 40));
      }
      this->At = end;
    }
    return value;
  }

private:
  void skip()
  {
    while (*this->At == ' ' || *this->At == ',' || *this->At == ':')
    {
      ++this->At;
    }
  }
  void advance()
  {
    if (!*this->At)
    {
      throw std::runtime_error("JSON ends too early");
    }
    ++this->At;
  }
  template <class Read>
  void read_list(char close, const Read& read_item)
  {
    for (++this->At, this->skip(); *this->At != close; this->skip())
    {
      if (!*this->At)
      {
        throw std::runtime_error("JSON ends too early");
      }
      read_item();
    }
    this->advance();
  }

  const char* At;
};

CurvePointer trim_curve(const Json& json)
{
  const std::vector<Json>& control = json.at("cp").items;
  Points points = Points::Zero(3, static_cast<Eigen::Index>(control.size()));
  Eigen::VectorXd weights(points.cols());
  for (Eigen::Index i = 0; i < points.cols(); ++i)
  {
    const std::vector<double> column = control[i].numbers();
    points.col(i).head<2>() << column[0], column[1];
    weights[i] = column[2];
  }
  const auto degree = static_cast<int>(json.at("degree").number);
  const auto curve =
    std::make_shared<Curve>(KnotVector(degree, json.at("knots").numbers()), points, weights);
  const bool backwards = json.has("reversed") && json.at("reversed").word == "true";
  return backwards ? reversed(*curve) : curve;
}

Surface face_surface(const Json& json)
{
  const auto nu = static_cast<Eigen::Index>(json.at("nu").number);
  const auto nv = static_cast<Eigen::Index>(json.at("nv").number);
  Points points(3, nu * nv);
  Eigen::VectorXd weights(nu * nv);
  for (Eigen::Index i = 0; i < nu; ++i)
  {
    for (Eigen::Index j = 0; j < nv; ++j)
    {
      const std::vector<double> p = json.at("cp").items[i].items[j].numbers();
      points.col(j * nu + i) << p[0], p[1], p[2];
      weights[j * nu + i] = p[3];
    }
  }
  return Surface(
    KnotVector(static_cast<int>(json.at("degreeU").number), json.at("knotsU").numbers()),
    KnotVector(static_cast<int>(json.at("degreeV").number), json.at("knotsV").numbers()), points,
    weights);
}

} // namespace

std::vector<RealFace> real_faces()
{
  const char* folder = std::getenv("FOOTPOINT_SHARED_DATA");
  std::vector<RealFace> faces;
  for (const char* file : { "analysissitus__nist_ctc_01.brep", "analysissitus__ubend2.stp",
         "anurbs__point_on_surface_projection.ibra", "bladex__root.iges", "bladex__tip.iges",
         "bladex__upper.iges", "dealii__goteborg.step", "dealii__wigley.iges", "dealii__wing.iges",
         "stepcode__dm1-id-214.stp", "tigl__D150WithGuides_wing.igs", "tigl__nacelle.stp" })
  {
    std::ifstream lines(std::string(folder ? folder : "") + "/json/" + file + ".jsonl");
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number)
    {
      const Json json = JsonReader(line).read();
      if (json.at("type").word != "face" || !json.has("loops") || json.at("loops").items.empty())
      {
        continue;
      }
      RealFace face;
      face.name = std::string(file) + ":" + std::to_string(number);
      face.surface = std::make_shared<Surface>(face_surface(json));
      for (const Json& loop : json.at("loops").items)
      {
        face.loops.emplace_back();
        for (const Json& curve : loop.at("curves").items)
        {
          face.loops.back().curves.push_back(trim_curve(curve));
        }
      }
      faces.push_back(std::move(face));
    }
  }
  return faces;
}

} // namespace trims
