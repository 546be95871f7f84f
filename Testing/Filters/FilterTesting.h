// SPDX-License-Identifier: BSD-3-Clause
// What the tests of the filters share: a check that fails, small geometries and point sets of which
// the answers are known, and a recorder of errors.

#ifndef FilterTesting_h
#define FilterTesting_h

#include "vtkAlgorithm.h"
#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkIntArray.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStructuredGrid.h"
#include "vtkTestUtilities.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

/// Ends the test with the place and the text of a condition that does not hold.
#define CHECK(condition)                                                                           \
  do                                                                                               \
  {                                                                                                \
    if (!(condition))                                                                              \
    {                                                                                              \
      throw std::runtime_error(                                                                    \
        std::string(__FILE__) + ":" + std::to_string(__LINE__) + ": " #condition);                 \
    }                                                                                              \
  } while (false)

/// The same for |actual − expected| ≤ tolerance, with the numbers; NaN never passes.
#define CHECK_NEAR(actual, expected, tolerance)                                                    \
  do                                                                                               \
  {                                                                                                \
    const double check_actual = (actual);                                                          \
    const double check_expected = (expected);                                                      \
    if (!(std::abs(check_actual - check_expected) <= (tolerance)))                                 \
    {                                                                                              \
      std::ostringstream check_text;                                                               \
      check_text.precision(17);                                                                    \
      check_text << __FILE__ << ":" << __LINE__ << ": " #actual " = " << check_actual              \
                 << ", expected " << check_expected;                                               \
      throw std::runtime_error(check_text.str());                                                  \
    }                                                                                              \
  } while (false)

namespace testing
{

/// Runs a test's body; a failed check is printed and makes the test fail.
template <typename Body>
int Run(const Body& body)
{
  try
  {
    body();
  }
  catch (const std::exception& failure)
  {
    std::cerr << "FAILED " << failure.what() << std::endl;
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}

/// Where tests may write: the folder of -T.
inline std::string OutputFolder(int argc, char* argv[])
{
  const std::unique_ptr<char[]> folder(
    vtkTestUtilities::GetArgOrEnvOrDefault("-T", argc, argv, "FOOTPOINT_TEST_OUTPUT", "."));
  return folder.get();
}

using Point = std::array<double, 3>;

inline double Norm(const Point& p)
{
  return std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
}

inline vtkSmartPointer<vtkPolyData> MakePoints(
  const std::vector<Point>& positions, int type = VTK_DOUBLE)
{
  vtkNew<vtkPoints> points;
  points->SetDataType(type);
  for (const Point& position : positions)
  {
    points->InsertNextPoint(position.data());
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  return data;
}

/// Points in the cube [−reach, reach]³, always the same ones.
inline std::vector<Point> RandomPoints(int count, double reach, unsigned seed = 1)
{
  std::mt19937 generator(seed);
  const auto coordinate = [&] { return reach * (2.0 * (generator() / 4294967296.0) - 1.0); };
  std::vector<Point> points;
  for (int i = 0; i < count; ++i)
  {
    const double x = coordinate();
    const double y = coordinate();
    points.push_back({ { x, y, coordinate() } });
  }
  return points;
}

inline void AddNumbers(vtkFieldData* data, const char* name, const std::vector<double>& numbers)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  for (const double number : numbers)
  {
    array->InsertNextValue(number);
  }
  data->AddArray(array);
}

inline void AddDegree(vtkFieldData* data, const std::vector<int>& degrees)
{
  vtkNew<vtkIntArray> array;
  array->SetName("Degree");
  for (const int degree : degrees)
  {
    array->InsertNextValue(degree);
  }
  data->AddArray(array);
}

/// A net; weights empty: none. \param nv 1 for a curve, whose knots_v and second degree are not
/// used
inline vtkSmartPointer<vtkStructuredGrid> MakeNet(int nu, int nv,
  const std::vector<Point>& control_points, const std::vector<double>& weights,
  const std::vector<double>& knots_u, const std::vector<double>& knots_v = {})
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Point& point : control_points)
  {
    points->InsertNextPoint(point.data());
  }
  auto net = vtkSmartPointer<vtkStructuredGrid>::New();
  net->SetDimensions(nu, nv, 1);
  net->SetPoints(points);
  AddNumbers(net->GetFieldData(), "KnotsU", knots_u);
  std::vector<int> degrees{ static_cast<int>(knots_u.size()) - nu - 1 };
  if (nv > 1)
  {
    AddNumbers(net->GetFieldData(), "KnotsV", knots_v);
    degrees.push_back(static_cast<int>(knots_v.size()) - nv - 1);
  }
  AddDegree(net->GetFieldData(), degrees);
  if (!weights.empty())
  {
    AddNumbers(net->GetPointData(), "RationalWeights", weights);
    net->GetPointData()->SetActiveRationalWeights("RationalWeights");
  }
  return net;
}

/// Control points (x, y, weight) of a rational quadratic arc of whole quarters of a circle.
inline std::vector<Point> Arc(double x, double radius, double start_angle, int quarters)
{
  std::vector<Point> arc;
  for (int i = 0; i <= 2 * quarters; ++i)
  {
    const double angle = start_angle + i * 0.25 * vtkMath::Pi();
    const double stretch = i % 2 == 0 ? 1.0 : std::sqrt(2.0);
    arc.push_back({ { x + radius * stretch * std::cos(angle), radius * stretch * std::sin(angle),
      1.0 / stretch } });
  }
  return arc;
}

inline std::vector<double> ArcKnots(int quarters)
{
  std::vector<double> knots{ 0.0 };
  for (int i = 0; i <= quarters; ++i)
  {
    knots.push_back(i);
    knots.push_back(i);
  }
  knots.push_back(quarters);
  return knots;
}

/// The surface that a profile (radius, height, weight) sweeps around the z axis; u runs around over
/// [0, 4], v along the profile.
inline vtkSmartPointer<vtkStructuredGrid> Revolve(
  const std::vector<Point>& profile, const std::vector<double>& knots_v)
{
  const std::vector<Point> circle = Arc(0.0, 1.0, 0.0, 4);
  std::vector<Point> points;
  std::vector<double> weights;
  for (const Point& p : profile)
  {
    for (const Point& c : circle)
    {
      points.push_back({ { p[0] * c[0], p[0] * c[1], p[1] } });
      weights.push_back(p[2] * c[2]);
    }
  }
  return MakeNet(9, static_cast<int>(profile.size()), points, weights, ArcKnots(4), knots_v);
}

/// The unit sphere, v from the south pole (0) to the north pole (2); the normal points outwards.
inline vtkSmartPointer<vtkStructuredGrid> MakeSphere()
{
  return Revolve(Arc(0.0, 1.0, -0.5 * vtkMath::Pi(), 2), ArcKnots(2));
}

/// The torus with radii 3 and 1; the normal points outwards.
inline vtkSmartPointer<vtkStructuredGrid> MakeTorus()
{
  return Revolve(Arc(3.0, 1.0, 0.0, 4), ArcKnots(4));
}

/// Its signed distance.
inline double TorusDistance(const Point& p)
{
  return std::hypot(std::hypot(p[0], p[1]) - 3.0, p[2]) - 1.0;
}

/// The unit circle in the plane z = 0.
inline vtkSmartPointer<vtkStructuredGrid> MakeCircle()
{
  std::vector<Point> points = Arc(0.0, 1.0, 0.0, 4);
  std::vector<double> weights;
  for (Point& point : points)
  {
    weights.push_back(point[2]);
    point[2] = 0.0;
  }
  return MakeNet(9, 1, points, weights, ArcKnots(4));
}

/// The square [0, 1]² at a height, degree 1; (u, v) = (x, y), the normal is +z.
inline vtkSmartPointer<vtkStructuredGrid> MakeSquare(double height = 0.0, double shift = 0.0)
{
  return MakeNet(2, 2,
    { { { shift, 0, height } }, { { shift + 1, 0, height } }, { { shift, 1, height } },
      { { shift + 1, 1, height } } },
    {}, { 0, 0, 1, 1 }, { 0, 0, 1, 1 });
}

/// The parabola (t, t²), t in [−2, 2], as a quadratic spline.
inline vtkSmartPointer<vtkStructuredGrid> MakeParabola()
{
  return MakeNet(
    3, 1, { { { -2, 4, 0 } }, { { 0, -4, 0 } }, { { 2, 4, 0 } } }, {}, { -2, -2, -2, 2, 2, 2 });
}

inline vtkDataArray* PointArray(vtkDataObject* data, const std::string& name)
{
  auto* points = vtkDataSet::SafeDownCast(data);
  CHECK(points != nullptr);
  vtkDataArray* array = points->GetPointData()->GetArray(name.c_str());
  if (!array)
  {
    throw std::runtime_error("no point array " + name);
  }
  return array;
}

inline double Value(vtkDataObject* data, const std::string& name, vtkIdType i, int component = 0)
{
  return PointArray(data, name)->GetComponent(i, component);
}

inline double FieldValue(vtkDataObject* data, const std::string& name, vtkIdType i = 0)
{
  vtkDataArray* array = data->GetFieldData()->GetArray(name.c_str());
  if (!array || array->GetNumberOfTuples() <= i)
  {
    throw std::runtime_error("no field data " + name);
  }
  return array->GetComponent(i, 0);
}

/// True if two arrays have the same type, shape and bits.
inline bool SameBits(vtkDataArray* a, vtkDataArray* b)
{
  return a->GetDataType() == b->GetDataType() &&
    a->GetNumberOfComponents() == b->GetNumberOfComponents() &&
    a->GetNumberOfTuples() == b->GetNumberOfTuples() &&
    std::equal(static_cast<const char*>(a->GetVoidPointer(0)),
      static_cast<const char*>(a->GetVoidPointer(0)) +
        a->GetNumberOfValues() * a->GetDataTypeSize(),
      static_cast<const char*>(b->GetVoidPointer(0)));
}

/// Keeps the errors and warnings of a filter and of its executive from being printed.
class MessageRecorder : public vtkCommand
{
public:
  vtkTypeMacro(MessageRecorder, vtkCommand);
  static MessageRecorder* New() { return new MessageRecorder; }

  void Watch(vtkAlgorithm* algorithm)
  {
    for (vtkObject* object :
      { static_cast<vtkObject*>(algorithm), static_cast<vtkObject*>(algorithm->GetExecutive()) })
    {
      object->AddObserver(vtkCommand::ErrorEvent, this);
      object->AddObserver(vtkCommand::WarningEvent, this);
    }
  }

  void Execute(vtkObject* caller, unsigned long event, void* data) override
  {
    const auto* text = static_cast<const char*>(data);
    if (event == vtkCommand::WarningEvent)
    {
      this->Warnings += text;
    }
    else if (vtkAlgorithm::SafeDownCast(caller))
    {
      this->Errors += text;
    }
  }

  void Clear()
  {
    this->Errors.clear();
    this->Warnings.clear();
  }

  std::string Errors; ///< of the filter itself
  std::string Warnings;
};

inline bool Contains(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

} // namespace testing

#endif
