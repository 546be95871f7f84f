// SPDX-License-Identifier: BSD-3-Clause
// Private: a CAD model in plain numbers, as it goes from the process that runs Open CASCADE to
// vtkCADReader. Lengths are in the unit that was asked for. No VTK, no Open CASCADE.

#ifndef CADModel_h
#define CADModel_h

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace footpoint::cad
{

/// A NURBS curve in space, or in a surface's (u, v) with z = 0.
struct CurveData
{
  int degree = 0;
  std::vector<double> knots;   ///< full knot vector
  std::vector<double> points;  ///< x, y, z of each control point, Cartesian
  std::vector<double> weights; ///< one a control point; empty: all 1
};

/// A NURBS surface; control points u fastest.
struct SurfaceData
{
  std::array<int, 2> degree = { { 0, 0 } };
  std::array<int, 2> size = { { 0, 0 } }; ///< numbers of control points
  std::array<std::vector<double>, 2> knots;
  std::vector<double> points;
  std::vector<double> weights; ///< empty: all 1
};

struct FaceData
{
  std::int64_t id = 0;
  std::string name;
  int orientation = 1;    ///< −1: the outward normal is −Su × Sv
  double tolerance = 0.0; ///< largest of the face and its edges
  SurfaceData surface;
  /// Head to tail in (u, v), counter-clockwise ones keep their inside; none: the whole surface.
  std::vector<std::vector<CurveData>> loops;
};

struct EdgeData
{
  std::int64_t id = 0;
  double tolerance = 0.0;
  std::vector<std::int64_t> faces; ///< that it belongs to, ascending
  CurveData curve;
};

/// Triangles of one face.
struct FaceMesh
{
  std::int64_t face = 0;
  std::vector<double> points;        ///< x, y, z
  std::vector<double> normals;       ///< unit, outward
  std::vector<std::int64_t> corners; ///< three point numbers a triangle
  std::vector<unsigned char> colour; ///< red, green, blue; empty: the file gives none
};

struct ModelSummary
{
  std::int64_t number_of_faces = 0;
  std::int64_t number_of_edges = 0;
  std::string unit; ///< of all lengths, e.g. "mm"
};

/// What a reading is to do.
struct ReadingOptions
{
  std::string file;
  std::string unit;               ///< e.g. "mm"; empty: as in the file
  double deflection = 0.0;        ///< in `unit`; 0: a thousandth of the model's diagonal
  double angular_deflection = 20; ///< degrees
  std::string faces;              ///< e.g. "0-3,7"; empty: all
  std::string left_out;           ///< faces that are not to be touched, written likewise
  bool healing = false;
  bool mesh = true;
};

} // namespace footpoint::cad

#endif
