// SPDX-License-Identifier: BSD-3-Clause
// Private: what is in a spline file, whatever its format, number for number.

#ifndef SplineFile_h
#define SplineFile_h

#include <array>
#include <stdexcept>
#include <string>
#include <vector>

namespace footpoint::files
{

/// A curve or a surface as a file gives it.
struct Spline
{
  std::string name;                         ///< may be empty
  int dimension = 0;                        ///< of the parameters: 1 a curve, 2 a surface
  std::array<int, 2> degree{ { 0, 0 } };    ///< of a curve the first alone
  std::array<std::vector<double>, 2> knots; ///< full knot vectors; of a curve the first alone
  std::vector<double> points;  ///< x, y, z of every control point, u fastest, Cartesian
  std::vector<double> weights; ///< one a control point; empty: a polynomial spline
  bool reversed = false;       ///< the normal is −S_u × S_v
  /// What trims the surface: of each loop the curves, head to tail in the (u, v) plane. A curve
  /// without knots is a polyline.
  std::vector<std::vector<Spline>> loops;

  std::size_t number_of_points() const { return this->points.size() / 3; }
  /// Number of control points in a direction, by the knots and the degree.
  std::size_t size(int direction) const
  {
    return this->knots[direction].size() - static_cast<std::size_t>(this->degree[direction]) - 1;
  }
};

/// The content of a file.
struct SplineFile
{
  std::vector<Spline> splines;
  std::vector<std::string> warnings; ///< what was left out, a sentence each
};

/// A file that cannot be read or a spline that cannot be written; the message says where and what
/// was expected.
class FileError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

} // namespace footpoint::files

#endif
