// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// CAD files as models of the core, with the faces of Open CASCADE that they come from.

#include "FaceConversion.h"
#include "ShapeReading.h"

#include "footpoint/model/model.h"

#include <BRep_Tool.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

namespace cadtest
{

using footpoint::Curve;
using footpoint::KnotVector;
using footpoint::Points;
using footpoint::Surface;

struct CADFace
{
  TopoDS_Face shape;
  footpoint::cad::ConvertedFace converted;
  footpoint::Face face;
};

inline Points points_of(const std::vector<double>& numbers)
{
  return Eigen::Map<const Points>(numbers.data(), 3, static_cast<Eigen::Index>(numbers.size() / 3));
}

inline Eigen::VectorXd weights_of(const std::vector<double>& numbers)
{
  return Eigen::Map<const Eigen::VectorXd>(
    numbers.data(), static_cast<Eigen::Index>(numbers.size()));
}

inline footpoint::Face face_of(const footpoint::cad::FaceData& data)
{
  footpoint::Face face;
  const footpoint::cad::SurfaceData& surface = data.surface;
  face.patches.push_back({ nullptr,
    std::make_shared<Surface>(KnotVector(surface.degree[0], surface.knots[0]),
      KnotVector(surface.degree[1], surface.knots[1]), points_of(surface.points),
      weights_of(surface.weights)) });
  face.reversed = data.orientation < 0;
  face.tolerance = data.tolerance;
  for (const auto& curves : data.loops)
  {
    face.loops.emplace_back();
    for (const footpoint::cad::CurveData& curve : curves)
    {
      face.loops.back().curves.push_back(std::make_shared<Curve>(
        KnotVector(curve.degree, curve.knots), points_of(curve.points), weights_of(curve.weights)));
    }
  }
  if (!face.loops.empty())
  {
    footpoint::trim(face);
  }
  return face;
}

/// The faces of a shape that convert, as they are oriented in it.
/// \param left_out counts the others
inline std::vector<CADFace> faces_of(const TopoDS_Shape& shape, int& left_out)
{
  std::vector<CADFace> faces;
  for (TopExp_Explorer at(shape, TopAbs_FACE); at.More(); at.Next())
  {
    try
    {
      CADFace face{ TopoDS::Face(at.Current()), {}, {} };
      face.converted = footpoint::cad::convert_face(face.shape, {});
      face.face = face_of(face.converted.data);
      faces.push_back(std::move(face));
    }
    catch (const std::runtime_error&)
    {
      ++left_out;
    }
    catch (const Standard_Failure&)
    {
      ++left_out;
    }
  }
  return faces;
}

inline footpoint::Model model_of(const std::vector<CADFace>& faces)
{
  footpoint::Model model;
  for (const CADFace& face : faces)
  {
    model.push_back(face.face);
  }
  return model;
}

/// The real files that are there: shared data, the packages occt-misc, gmsh-doc and netgen-doc, and
/// the folder that FOOTPOINT_CAD_FILES names.
inline std::vector<std::string> files()
{
  std::vector<std::string> found;
  const auto variable = [](const char* name)
  {
    const char* text = std::getenv(name);
    return std::string(text ? text : "");
  };
  for (const std::string& folder : { variable("FOOTPOINT_SHARED_DATA"),
         variable("FOOTPOINT_CAD_FILES"), std::string("/usr/share/opencascade/data"),
         std::string("/usr/share/doc/gmsh-doc"), std::string("/usr/share/doc/netgen-doc") })
  {
    std::error_code none;
    std::vector<std::string> below;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder, none))
    {
      const std::string name = entry.path().string();
      for (const std::string end : { ".step", ".stp", ".iges", ".igs", ".brep", ".step.gz",
             ".stp.gz", ".iges.gz", ".igs.gz", ".brep.gz", ".rle" })
      {
        if (name.size() > end.size() && name.substr(name.size() - end.size()) == end)
        {
          below.push_back(name);
        }
      }
    }
    std::sort(below.begin(), below.end());
    found.insert(found.end(), below.begin(), below.end());
  }
  return found;
}

inline std::string short_name(const std::string& file)
{
  return std::filesystem::path(file).filename().string();
}

} // namespace cadtest
