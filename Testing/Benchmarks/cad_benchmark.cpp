// SPDX-License-Identifier: BSD-3-Clause

// Point inversion on CAD models, beside Open CASCADE and VTK's cell locator: see usage(). Every
// case runs in a process of its own, so that its peak of memory is its own.

#include "cad_models.h"
#include "timing.h"

#include "ShapeReading.h"

#include <vtkCADReader.h>
#include <vtkDataArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPointInversionFilter.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>
#include <vtkStaticCellLocator.h>

#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <Message_ProgressRange.hxx>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <string>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace
{

using inversion_benchmark::copies_of;
using inversion_benchmark::cpu_seconds;
using inversion_benchmark::scan_of;
using inversion_benchmark::seconds;

struct Options
{
  vtkIdType points = 1000000;
  int occt_points = 2000;
  double occt_seconds = 60.0; ///< after which Open CASCADE is asked no more
  std::string output = ".";
  std::vector<std::string> files;
};

struct Case
{
  std::string file;
  int copies = 1;
  bool compared = true; ///< with the other programs
};

[[noreturn]] void usage(int code)
{
  std::cout
    << "cad_benchmark [--points N] [--occt-points N] [--occt-seconds S] [--output FOLDER] FILE...\n"
       "Scans of each CAD file (points of its faces with noise of 1e-4 to 1e-3 of the size)\n"
       "through vtkPointInversionFilter on one thread and on all (wall time), beside\n"
       "BRepExtrema_DistShapeShape and vtkStaticCellLocator on the display mesh; of the first\n"
       "file also models of 31 and 62 copies. Prints a table, and writes it to cad.md and numbers\n"
       "to cad.csv.\n";
  std::exit(code);
}

/// Resident memory in MB.
double memory_now()
{
  std::ifstream stream("/proc/self/statm");
  long total = 0;
  long resident = 0;
  stream >> total >> resident;
  return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1048576.0;
}

double peak_memory()
{
  rusage usage_now{};
  getrusage(RUSAGE_SELF, &usage_now);
  return static_cast<double>(usage_now.ru_maxrss) / 1024.0;
}

// === One case

struct Row
{
  std::string model;
  std::string program;
  long faces = 0;
  long points = 0;
  double build = NAN;        ///< seconds
  double microseconds = NAN; ///< a point
  double certified = NAN;    ///< share
  double largest = NAN;      ///< |distance − ours|, in parts of the size
  double mean = NAN;
  double memory = NAN; ///< MB above what was there before
};

/// The filter on one point, for what is built, and then on all: sets both times. \param timed gives
/// the seconds of some work \param built is called in between \return its output
template <class Timed, class Built>
vtkSmartPointer<vtkDataSet> run_filter(
  vtkDataObject* model, vtkPolyData* scan, Row& row, const Timed& timed, const Built& built)
{
  vtkNew<vtkPolyData> first;
  vtkNew<vtkPoints> one_point;
  one_point->InsertNextPoint(scan->GetPoint(0));
  first->SetPoints(one_point);
  vtkNew<vtkPointInversionFilter> filter;
  filter->SetSourceData(model);
  filter->SetInputData(first);
  row.build = timed([&] { filter->Update(); });
  built();
  filter->SetInputData(scan);
  row.microseconds =
    1e6 * timed([&] { filter->Update(); }) / static_cast<double>(scan->GetNumberOfPoints());
  return vtkDataSet::SafeDownCast(filter->GetOutputDataObject(0));
}

std::vector<Row> run(const Case& one, const Options& options)
{
  std::vector<Row> rows;
  vtkNew<vtkCADReader> reader;
  reader->SetFileName(one.file.c_str());
  reader->Update();
  vtkPolyData* mesh = reader->GetOutput();
  double bounds[6];
  mesh->GetBounds(bounds);
  const double size = mesh->GetLength();
  vtkSmartPointer<vtkMultiBlockDataSet> model = one.copies == 1
    ? vtkSmartPointer<vtkMultiBlockDataSet>(reader->GetModelOutput())
    : copies_of(reader->GetModelOutput(), one.copies, bounds);
  const auto scan = scan_of(mesh, options.points, one.copies, bounds, size);

  // === Ours
  Row ours;
  ours.model = std::filesystem::path(one.file).filename().string();
  ours.model += one.copies > 1 ? " x " + std::to_string(one.copies) : "";
  ours.program = "Footpoint";
  ours.faces = static_cast<long>(reader->GetNumberOfFaces()) * one.copies;
  ours.points = static_cast<long>(options.points);
  const double before = memory_now();
  const auto on_one_thread = [](const auto& work) { return cpu_seconds(work); };
  const auto output =
    run_filter(model, scan, ours, on_one_thread, [&] { ours.memory = peak_memory() - before; });
  vtkDataArray* status = output->GetPointData()->GetArray("Status");
  vtkDataArray* distance = output->GetPointData()->GetArray("Distance");
  if (!status || !distance)
  {
    throw std::runtime_error("the filter gave no distances for " + one.file);
  }
  vtkIdType certified = 0;
  for (vtkIdType k = 0; k < options.points; ++k)
  {
    certified += status->GetTuple1(k) == 0.0;
  }
  ours.certified = static_cast<double>(certified) / static_cast<double>(options.points);
  rows.push_back(ours);
  if (const int threads = static_cast<int>(std::thread::hardware_concurrency()); threads > 1)
  {
    Row shared = ours;
    shared.program = "Footpoint on " + std::to_string(threads) + " threads";
    shared.certified = NAN; // as above
    shared.memory = NAN;    // what is freed before is used again
    const auto on_all_threads = [threads](const auto& work)
    {
      double time = 0.0;
      vtkSMPTools::LocalScope(
        vtkSMPTools::Config{ threads, "STDThread", false }, [&] { time = seconds(work); });
      return time;
    };
    run_filter(model, scan, shared, on_all_threads, [] {});
    rows.push_back(shared);
  }
  if (!one.compared)
  {
    return rows;
  }

  // === The cell locator on the display mesh
  Row locator = ours;
  locator.program = "VTK locator";
  locator.certified = NAN;
  locator.memory = NAN; // what is freed before is used again
  vtkNew<vtkStaticCellLocator> cells;
  cells->SetDataSet(mesh);
  locator.build = cpu_seconds([&] { cells->BuildLocator(); });
  locator.largest = 0.0;
  double sum = 0.0;
  std::vector<double> theirs(static_cast<std::size_t>(options.points));
  locator.microseconds = 1e6 / static_cast<double>(options.points) *
    cpu_seconds(
      [&]
      {
        for (vtkIdType k = 0; k < options.points; ++k)
        {
          double closest[3];
          vtkIdType cell = 0;
          int sub = 0;
          double squared = 0.0;
          cells->FindClosestPoint(scan->GetPoint(k), closest, cell, sub, squared);
          theirs[static_cast<std::size_t>(k)] = std::sqrt(squared);
        }
      });
  for (vtkIdType k = 0; k < options.points; ++k)
  {
    const double off =
      std::abs(theirs[static_cast<std::size_t>(k)] - distance->GetTuple1(k)) / size;
    locator.largest = std::max(locator.largest, off);
    sum += off;
  }
  locator.mean = sum / static_cast<double>(options.points);
  rows.push_back(locator);

  // === Open CASCADE
  Row occt = ours;
  occt.program = "Open CASCADE";
  occt.certified = NAN;
  occt.memory = NAN;
  footpoint::cad::redirect_messages();
  const TopoDS_Shape shape = footpoint::cad::read_shape(one.file, Message_ProgressRange()).shape;
  occt.largest = 0.0;
  sum = 0.0;
  double spent = 0.0;
  long asked = 0;
  for (; asked < options.occt_points && asked < options.points && spent < options.occt_seconds;
       ++asked)
  {
    const double* p = scan->GetPoint(asked);
    double found = NAN;
    spent += cpu_seconds(
      [&]
      {
        BRepExtrema_DistShapeShape extrema(
          BRepBuilderAPI_MakeVertex(gp_Pnt(p[0], p[1], p[2])).Vertex(), shape);
        found = extrema.IsDone() ? extrema.Value() : NAN;
      });
    const double off = std::abs(found - distance->GetTuple1(asked)) / size;
    occt.largest = std::isnan(off) ? INFINITY : std::max(occt.largest, off);
    sum += off;
  }
  occt.points = asked;
  occt.build = NAN;
  occt.microseconds = 1e6 * spent / static_cast<double>(std::max(asked, 1L));
  occt.mean = sum / static_cast<double>(std::max(asked, 1L));
  rows.push_back(occt);
  return rows;
}

// === Tables

std::string csv(const Row& row)
{
  std::ostringstream line;
  line << std::setprecision(9) << row.model << "," << row.program << "," << row.faces << ","
       << row.points << "," << row.build << "," << row.microseconds << "," << row.certified << ","
       << row.largest << "," << row.mean << "," << row.memory << "\n";
  return line.str();
}

std::string cell(const std::string& number, int digits, double factor = 1.0)
{
  const double value = std::strtod(number.c_str(), nullptr);
  if (std::isnan(value))
  {
    return "–";
  }
  std::ostringstream text;
  text << std::setprecision(digits) << value * factor;
  return text.str();
}

/// A line of cad.csv as one of the table.
std::string markdown(const std::string& line)
{
  std::vector<std::string> fields;
  std::istringstream stream(line);
  for (std::string field; std::getline(stream, field, ',');)
  {
    fields.push_back(field);
  }
  return "| " + fields[0] + " | " + fields[2] + " | " + fields[1] + " | " + fields[3] + " | " +
    cell(fields[4], 3) + " | " + cell(fields[5], 3) + " | " + cell(fields[6], 6, 100.0) + " | " +
    cell(fields[7], 2) + " | " + cell(fields[8], 2) + " | " + cell(fields[9], 3) + " |\n";
}

/// Runs a case in a child; its rows as CSV. \throw std::runtime_error where it fails
std::string run_apart(const Case& one, const Options& options)
{
  int ends[2];
  if (pipe(ends) != 0)
  {
    throw std::runtime_error("no pipe");
  }
  const pid_t child = fork();
  if (child == 0)
  {
    close(ends[0]);
    int code = 0;
    try
    {
      vtkSMPTools::SetBackend("Sequential");
      for (const Row& row : run(one, options))
      {
        const std::string line = csv(row);
        code =
          write(ends[1], line.data(), line.size()) == static_cast<ssize_t>(line.size()) ? code : 1;
      }
    }
    catch (const std::exception& error)
    {
      std::cerr << "cad_benchmark: " << error.what() << "\n";
      code = 1;
    }
    _exit(code);
  }
  close(ends[1]);
  std::string text;
  char buffer[4096];
  for (ssize_t count = 0; (count = read(ends[0], buffer, sizeof buffer)) > 0;)
  {
    text.append(buffer, static_cast<std::size_t>(count));
  }
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
  {
    throw std::runtime_error("the case of " + one.file + " failed");
  }
  return text;
}

Options parse(int argc, char* argv[])
{
  Options options;
  for (int k = 1; k < argc; ++k)
  {
    const std::string name = argv[k];
    if (name == "--help" || (name.rfind("--", 0) == 0 && k + 1 == argc))
    {
      usage(name == "--help" ? 0 : 2);
    }
    if (name == "--points")
    {
      options.points = std::atoll(argv[++k]);
    }
    else if (name == "--occt-points")
    {
      options.occt_points = std::atoi(argv[++k]);
    }
    else if (name == "--occt-seconds")
    {
      options.occt_seconds = std::atof(argv[++k]);
    }
    else if (name == "--output")
    {
      options.output = argv[++k];
    }
    else if (name.rfind("--", 0) == 0)
    {
      usage(2);
    }
    else
    {
      options.files.push_back(name);
    }
  }
  if (options.files.empty() || options.points < 1)
  {
    usage(2);
  }
  return options;
}

} // namespace

int main(int argc, char* argv[])
{
  const Options options = parse(argc, argv);
  std::vector<Case> cases;
  for (const std::string& file : options.files)
  {
    cases.push_back({ file, 1, true });
  }
  cases.push_back({ options.files.front(), 31, false });
  cases.push_back({ options.files.front(), 62, false });

  std::ofstream numbers(options.output + "/cad.csv");
  std::ofstream table(options.output + "/cad.md");
  numbers << "model,program,faces,points,build_s,us_a_point,certified,largest_difference,"
             "mean_difference,memory_mb\n";
  const std::string head =
    "| model | faces | program | points | built in (s) | µs a point | certified (%) | largest "
    "difference | mean difference | memory (MB) |\n|---|---|---|---|---|---|---|---|---|---|\n";
  std::cout << head << std::flush;
  table << head;
  try
  {
    for (const Case& one : cases)
    {
      std::istringstream rows(run_apart(one, options));
      for (std::string line; std::getline(rows, line);)
      {
        numbers << line << "\n" << std::flush;
        table << markdown(line);
        std::cout << markdown(line) << std::flush;
      }
    }
  }
  catch (const std::exception& error)
  {
    std::cerr << "cad_benchmark: " << error.what() << "\n";
    return 1;
  }
  return 0;
}
