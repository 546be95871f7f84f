// SPDX-License-Identifier: BSD-3-Clause
// How much memory vtkCoonsPatchSource takes besides its output: each case in a process of its own,
// by the peak that the operating system has seen.
#include "GridTesting.h"

#include "vtkCoonsPatchSource.h"

#include <fstream>
#include <iomanip>
#include <set>

#if defined(__linux__)
#include <sys/wait.h>
#include <unistd.h>
#endif

using namespace testing;

namespace
{

constexpr int kPoints = 1025;

/// What ctest takes as a test that was left out.
constexpr int kSkipped = 125;

/// A number a point is 8.4 MB: half of one is too much.
constexpr double kAllowance = 4.0e6;

using Options = std::function<void(vtkCoonsPatchSource*)>;

struct Case
{
  const char* name;
  Sides sides;
  Options options;
};

Point Dome(double u, double v)
{
  return { { u, v, 0.3 * std::sin(3 * u) + 0.2 * std::cos(2 * v) } };
}

/// A plane that no axis is normal to.
Point Slope(double u, double v)
{
  return { { u, v + 0.2 * std::sin(3 * u), u + v + 0.2 * std::sin(3 * u) } };
}

const Case kCases[] = {
  { "plane",
    BordersOf(
      [](double u, double v) {
        return Point{ { u * (1 + v), v, 0 } };
      }),
    [](vtkCoonsPatchSource*) {} },
  { "slope", BordersOf(Slope), [](vtkCoonsPatchSource*) {} },
  { "in space", BordersOf(Dome), [](vtkCoonsPatchSource*) {} },
  { "points and quality", BordersOf(Dome),
    [](vtkCoonsPatchSource* source)
    {
      source->GenerateNormalsOff();
      source->GenerateTextureCoordinatesOff();
    } },
  { "triangles", BordersOf(Dome),
    [](vtkCoonsPatchSource* source) { source->SetCellTypeToTriangles(); } },
  { "arc lengths, bicubic", BordersOf(Dome),
    [](vtkCoonsPatchSource* source)
    {
      source->SetParametrizationToArcLengthBlended();
      source->SetBlendToBicubic();
    } },
};

/// Peak of the memory that this process has had in use, in bytes; 0: not known.
double PeakMemory()
{
  std::ifstream status("/proc/self/status");
  std::string word;
  while (status >> word)
  {
    if (word == "VmHWM:")
    {
      double kilobytes = 0.0;
      status >> kilobytes;
      return 1024.0 * kilobytes;
    }
  }
  return 0.0;
}

/// Bytes of all arrays of both outputs, those that they share counted once.
double OutputBytes(vtkCoonsPatchSource* source)
{
  std::set<vtkAbstractArray*> arrays;
  for (vtkPointSet* output : { static_cast<vtkPointSet*>(source->GetOutput()),
         static_cast<vtkPointSet*>(source->GetMeshOutput()) })
  {
    arrays.insert(output->GetPoints()->GetData());
    for (vtkFieldData* data : { static_cast<vtkFieldData*>(output->GetPointData()),
           static_cast<vtkFieldData*>(output->GetCellData()) })
    {
      for (int i = 0; i < data->GetNumberOfArrays(); ++i)
      {
        arrays.insert(data->GetAbstractArray(i));
      }
    }
  }
  arrays.insert(source->GetMeshOutput()->GetPolys()->GetConnectivityArray());
  arrays.insert(source->GetMeshOutput()->GetPolys()->GetOffsetsArray());
  double bytes = 0.0;
  for (vtkAbstractArray* array : arrays)
  {
    bytes += static_cast<double>(array->GetNumberOfValues()) * array->GetDataTypeSize();
  }
  return bytes;
}

void CheckMemory(const Case& one)
{
  vtkNew<vtkCoonsPatchSource> source;
  one.options(source);
  AddSides(source, one.sides, 33);
  source->SetResolution(33, 33); // threads and code are there afterwards
  source->Update();
  const double before = PeakMemory();
  source->SetResolution(kPoints, kPoints);
  source->Update();
  const double rest = PeakMemory() - before - OutputBytes(source);
  std::cout << std::fixed << std::setprecision(1) << one.name << ": output "
            << 1e-6 * OutputBytes(source) << " MB, besides " << 1e-6 * rest << " MB" << std::endl;
  CHECK(source->GetOutput()->GetNumberOfPoints() == kPoints * kPoints);
  CHECK(rest < kAllowance);
}

} // namespace

int TestCoonsPatchMemory(int, char*[])
{
#if defined(__linux__)
  if (PeakMemory() == 0.0)
  {
    std::cout << "the peak of memory is not known here" << std::endl;
    return kSkipped;
  }
  int result = EXIT_SUCCESS;
  for (const Case& one : kCases)
  {
    const pid_t child = fork();
    if (child == 0)
    {
      const int verdict = Run([&] { CheckMemory(one); });
      std::_Exit(verdict);
    }
    int status = 0;
    if (child < 0 || waitpid(child, &status, 0) != child || status != 0)
    {
      std::cerr << "FAILED " << one.name << std::endl;
      result = EXIT_FAILURE;
    }
  }
  return result;
#else
  return kSkipped;
#endif
}
