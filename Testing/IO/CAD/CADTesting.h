// SPDX-License-Identifier: BSD-3-Clause
// What the tests of vtkCADReader share: files to read, the reader's outputs as geometry of the
// core, and the same file as Open CASCADE sees it.

#ifndef CADTesting_h
#define CADTesting_h

#include "FilterTesting.h"

#include "FaceConversion.h"
#include "ShapeReading.h"

#include "footpoint/splines/curve.h"
#include "footpoint/splines/surface.h"

#include "vtkCADReader.h"
#include "vtkCompositeDataSet.h"
#include "vtkInformation.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkStringArray.h"
#include "vtkTestUtilities.h"

#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <memory>

namespace testing
{

/// CAD files of a folder and those below it, sorted.
inline std::vector<std::string> CadFilesBelow(const std::string& folder)
{
  std::vector<std::string> files;
  std::error_code none;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder, none))
  {
    std::string name = entry.path().filename().string();
    for (const char* ending : { ".step", ".stp", ".iges", ".igs", ".brep", ".step.gz", ".stp.gz" })
    {
      const std::string end = ending;
      if (name.size() > end.size() && name.substr(name.size() - end.size()) == end)
      {
        files.push_back(entry.path().string());
        break;
      }
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// The real files that are there: shared data, the packages occt-misc, gmsh-doc and netgen-doc, and
/// the folder that FOOTPOINT_CAD_FILES names.
inline std::vector<std::string> RealCadFiles()
{
  std::vector<std::string> files;
  for (const std::string& folder :
    { std::string(std::getenv("FOOTPOINT_SHARED_DATA") ? std::getenv("FOOTPOINT_SHARED_DATA") : ""),
      std::string(std::getenv("FOOTPOINT_CAD_FILES") ? std::getenv("FOOTPOINT_CAD_FILES") : ""),
      std::string("/usr/share/opencascade/data"), std::string("/usr/share/doc/gmsh-doc"),
      std::string("/usr/share/doc/netgen") })
  {
    if (!folder.empty())
    {
      const std::vector<std::string> below = CadFilesBelow(folder);
      files.insert(files.end(), below.begin(), below.end());
    }
  }
  // Triangulating this one takes half a minute, and it is one B-spline face.
  files.erase(std::remove_if(files.begin(), files.end(),
                [](const std::string& file) { return Contains(file, "terrain.brep"); }),
    files.end());
  return files;
}

/// A file as Open CASCADE reads it, with the reader's numbers of faces.
struct OcctModel
{
  footpoint::cad::ReadShape read;
  TopTools_IndexedMapOfShape faces;
  TopTools_IndexedMapOfShape edges;

  explicit OcctModel(const std::string& file)
    : read(footpoint::cad::read_shape(file, Message_ProgressRange()))
  {
    TopExp::MapShapes(this->read.shape, TopAbs_FACE, this->faces);
    TopExp::MapShapes(this->read.shape, TopAbs_EDGE, this->edges);
  }

  TopoDS_Face face(int id) const { return TopoDS::Face(this->faces(id + 1)); }
};

/// What the reader gave for a file.
struct CadResult
{
  vtkSmartPointer<vtkPolyData> mesh;
  vtkSmartPointer<vtkMultiBlockDataSet> model;
  vtkSmartPointer<vtkMultiBlockDataSet> edges;
  vtkIdType faces;
  vtkIdType skipped;
  std::string errors;
  std::string warnings;
};

inline CadResult Read(vtkCADReader* reader, const std::string& file)
{
  vtkNew<MessageRecorder> recorder;
  recorder->Watch(reader);
  reader->SetFileName(file.c_str());
  reader->Update();
  return { reader->GetOutput(), reader->GetModelOutput(), reader->GetEdgesOutput(),
    reader->GetNumberOfFaces(), reader->GetNumberOfSkippedFaces(), recorder->Errors,
    recorder->Warnings };
}

inline CadResult Read(const std::string& file)
{
  vtkNew<vtkCADReader> reader;
  return Read(reader, file);
}

inline std::vector<double> Numbers(vtkDataArray* array)
{
  std::vector<double> numbers;
  for (vtkIdType i = 0; array && i < array->GetNumberOfTuples(); ++i)
  {
    numbers.push_back(array->GetComponent(i, 0));
  }
  return numbers;
}

inline std::string FieldText(vtkDataObject* data, const char* name)
{
  auto* array = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray(name));
  return array && array->GetNumberOfValues() > 0 ? array->GetValue(0) : "";
}

inline footpoint::KnotVector Knots(vtkStructuredGrid* net, int direction)
{
  const char* name = direction == 0 ? "KnotsU" : "KnotsV";
  return footpoint::KnotVector(static_cast<int>(FieldValue(net, "Degree", direction)),
    Numbers(net->GetFieldData()->GetArray(name)), name);
}

inline footpoint::Points ControlPoints(vtkStructuredGrid* net)
{
  footpoint::Points points(3, net->GetNumberOfPoints());
  for (vtkIdType i = 0; i < net->GetNumberOfPoints(); ++i)
  {
    net->GetPoint(i, points.col(i).data());
  }
  return points;
}

inline Eigen::VectorXd Weights(vtkStructuredGrid* net)
{
  const std::vector<double> weights = Numbers(net->GetPointData()->GetRationalWeights());
  return Eigen::Map<const Eigen::VectorXd>(
    weights.data(), static_cast<Eigen::Index>(weights.size()));
}

inline footpoint::Surface MakeSurface(vtkStructuredGrid* net)
{
  return footpoint::Surface(Knots(net, 0), Knots(net, 1), ControlPoints(net), Weights(net));
}

inline footpoint::Curve MakeCurve(vtkStructuredGrid* net)
{
  return footpoint::Curve(Knots(net, 0), ControlPoints(net), Weights(net));
}

/// Point at parameters of the curve's or surface's own domain.
inline footpoint::Vector3 At(const footpoint::Surface& surface, double u, double v)
{
  return surface.centre() + surface.point(surface.to_local(footpoint::Parameter<2>(u, v)));
}

inline footpoint::Vector3 At(const footpoint::Curve& curve, double t)
{
  return curve.centre() + curve.point(curve.to_local(footpoint::Parameter<1>(t)));
}

inline double First(const footpoint::Curve& curve)
{
  return curve.knots().domain_start();
}

inline double Last(const footpoint::Curve& curve)
{
  return curve.knots().domain_end();
}

/// A block of the model as geometry of the core.
struct ReadFace
{
  vtkStructuredGrid* net;
  std::shared_ptr<footpoint::Surface> surface;
  std::vector<std::vector<footpoint::Curve>> loops;
};

inline ReadFace FaceOf(vtkDataObject* block)
{
  CHECK(block != nullptr);
  ReadFace face;
  auto* trimmed = vtkMultiBlockDataSet::SafeDownCast(block);
  face.net = vtkStructuredGrid::SafeDownCast(trimmed ? trimmed->GetBlock(0) : block);
  CHECK(face.net != nullptr);
  face.surface = std::make_shared<footpoint::Surface>(MakeSurface(face.net));
  for (unsigned int i = 1; trimmed && i < trimmed->GetNumberOfBlocks(); ++i)
  {
    CHECK(
      trimmed->GetMetaData(i)->Get(vtkCompositeDataSet::NAME()) == "Loop " + std::to_string(i - 1));
    auto* loop = vtkMultiBlockDataSet::SafeDownCast(trimmed->GetBlock(i));
    CHECK(loop != nullptr && loop->GetNumberOfBlocks() > 0);
    std::vector<footpoint::Curve>& curves = face.loops.emplace_back();
    for (unsigned int j = 0; j < loop->GetNumberOfBlocks(); ++j)
    {
      curves.push_back(MakeCurve(vtkStructuredGrid::SafeDownCast(loop->GetBlock(j))));
    }
  }
  return face;
}

} // namespace testing

#endif
