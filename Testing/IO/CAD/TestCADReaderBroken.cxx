// SPDX-License-Identifier: BSD-3-Clause
// Files that are missing, cut off or damaged: always an answer in time, never a crash of ours, and
// never an empty result without an error. FOOTPOINT_CAD_FUZZ in the environment sets the number of
// damaged files of each format (kDamaged by default).
#include "CADTesting.h"

#include "vtkCallbackCommand.h"

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepTools.hxx>
#include <IGESControl_Writer.hxx>
#include <STEPControl_Writer.hxx>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iterator>

using namespace testing;

namespace
{

#ifdef FOOTPOINT_CAD_FUZZ_FEW
constexpr int kDamaged = 6;
#else
constexpr int kDamaged = 30;
#endif

std::string folder;

std::string WriteBytes(const std::string& name, const std::string& bytes)
{
  const std::string path = folder + "/" + name;
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

std::string ReadBytes(const std::string& path)
{
  std::ifstream stream(path, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(stream), {});
}

/// One solid in all formats: (ending, content).
std::vector<std::pair<std::string, std::string>> Originals()
{
  const TopoDS_Shape shape = BRepAlgoAPI_Cut(BRepPrimAPI_MakeBox(4.0, 4.0, 2.0).Shape(),
    BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(2, 2, -1), gp_Dir(0.2, 0, 1)), 1.0, 6.0).Shape())
                               .Shape();
  const std::string brep = folder + "/original.brep";
  const std::string step = folder + "/original.step";
  const std::string iges = folder + "/original.iges";
  CHECK(BRepTools::Write(shape, brep.c_str()));
  STEPControl_Writer step_writer;
  step_writer.Transfer(shape, STEPControl_AsIs);
  CHECK(step_writer.Write(step.c_str()) == IFSelect_RetDone);
  IGESControl_Writer iges_writer;
  iges_writer.AddShape(shape);
  iges_writer.ComputeModel();
  CHECK(iges_writer.Write(iges.c_str()));
  return { { ".brep", ReadBytes(brep) }, { ".step", ReadBytes(step) },
    { ".iges", ReadBytes(iges) } };
}

/// Seconds without progress after which a damaged file is given up: at least so many, and ten times
/// what a whole one takes. Many of them never end.
constexpr double kLeastTime = 3.0;

/// Reads a damaged file and judges the answer. \return 'e' an error, 'm' a model
char Judge(const std::string& path, double time_limit)
{
  vtkNew<vtkCADReader> reader;
  reader->SetTimeLimit(time_limit);
  const auto start = std::chrono::steady_clock::now();
  const CadResult result = Read(reader, path);
  const double seconds =
    std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  CHECK(seconds < 60.0);
  const bool something = result.model->GetNumberOfBlocks() + result.edges->GetNumberOfBlocks() > 0;
  CHECK(something != !result.errors.empty());
  vtkIdType nulls = 0;
  for (unsigned int i = 0; i < result.model->GetNumberOfBlocks(); ++i)
  {
    nulls += result.model->GetBlock(i) ? 0 : 1;
  }
  CHECK(nulls == result.skipped);
  CHECK(result.skipped == 0 || Contains(result.warnings, "face "));
  return something ? 'm' : 'e';
}

void TestNoFile()
{
  CHECK(Contains(Read("").errors, "No file name is set"));
  CHECK(Contains(Read(folder + "/there_is_none.step").errors, "No such file"));
  CHECK(Contains(Read(folder).errors, "it is no file"));
  CHECK(Contains(Read(WriteBytes("empty.step", "")).errors, "it is empty"));
  CHECK(Contains(Read(WriteBytes("text.step", "some text\n")).errors, "it is neither STEP"));
  CHECK(Contains(
    Read(WriteBytes("packed.step.gz", "\x1f\x8b\x08 no gzip")).errors, "it cannot be unpacked"));
}

/// \return seconds for the whole files, the slowest one
double TestWhole(const std::vector<std::pair<std::string, std::string>>& originals)
{
  double slowest = 0.0;
  for (const auto& [ending, bytes] : originals)
  {
    const auto start = std::chrono::steady_clock::now();
    CHECK(Judge(WriteBytes("whole" + ending, bytes), 30.0) == 'm');
    slowest = std::max(slowest,
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return slowest;
}

void TestCutOff(const std::vector<std::pair<std::string, std::string>>& originals, int places,
  double time_limit)
{
  for (const auto& [ending, bytes] : originals)
  {
    int errors = 0;
    for (int i = 0; i < places; ++i)
    {
      const std::size_t length = bytes.size() * static_cast<std::size_t>(i) / places;
      const std::string path = WriteBytes("cut_off" + ending, bytes.substr(0, length));
      errors += Judge(path, time_limit) == 'e' ? 1 : 0;
    }
    std::cout << ending << " cut off at " << places << " places: " << errors << " errors\n";
    CHECK(errors >= places / 2);
  }
}

void TestDamaged(const std::vector<std::pair<std::string, std::string>>& originals, int times,
  double time_limit)
{
  std::mt19937 generator(7);
  for (const auto& [ending, bytes] : originals)
  {
    int errors = 0;
    for (int i = 0; i < times; ++i)
    {
      std::string damaged = bytes;
      const int count = 1 << (generator() % 6);
      for (int k = 0; k < count; ++k)
      {
        const std::string likely = "0123456789-+.EeD(),#;$* ";
        damaged[generator() % damaged.size()] = generator() % 2
          ? static_cast<char>(generator() % 256)
          : likely[generator() % likely.size()];
      }
      const std::string path = WriteBytes("damaged" + ending, damaged);
      errors += Judge(path, time_limit) == 'e' ? 1 : 0;
    }
    std::cout << ending << " damaged " << times << " times: " << errors << " errors\n";
  }
}

/// A reader that is told to stop has no output, and the next update reads.
void TestAbort(const std::string& path)
{
  vtkNew<vtkCADReader> reader;
  reader->SetFileName(path.c_str());
  vtkNew<vtkCallbackCommand> stop;
  stop->SetCallback([](vtkObject* caller, unsigned long, void*, void*)
    { vtkAlgorithm::SafeDownCast(caller)->SetAbortExecute(1); });
  const unsigned long tag = reader->AddObserver(vtkCommand::ProgressEvent, stop);
  reader->Update();
  CHECK(reader->GetModelOutput()->GetNumberOfBlocks() == 0);
  reader->RemoveObserver(tag);
  reader->SetAbortExecute(0);
  reader->Modified();
  reader->Update();
  CHECK(reader->GetModelOutput()->GetNumberOfBlocks() == 7);
}

} // namespace

int TestCADReaderBroken(int argc, char* argv[])
{
  char* temporary = vtkTestUtilities::GetArgOrEnvOrDefault("-T", argc, argv, "T", ".");
  folder = temporary;
  delete[] temporary;
  const char* wanted = std::getenv("FOOTPOINT_CAD_FUZZ");
  const int times = wanted ? std::atoi(wanted) : kDamaged;
  footpoint::cad::redirect_messages();
  return Run(
    [&]
    {
      const auto originals = Originals();
      TestNoFile();
      const double time_limit = std::max(kLeastTime, 10.0 * TestWhole(originals));
      TestCutOff(originals, std::max(1, times / 3), time_limit);
      TestDamaged(originals, times, time_limit);
      TestAbort(folder + "/original.step");
    });
}
