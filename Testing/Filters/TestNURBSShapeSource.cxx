// SPDX-License-Identifier: BSD-3-Clause
// Shapes as a source: what kind of output, files, options, refusals. That the shapes are right is
// tested in the core.
#include "BezierTesting.h"

#include "vtkNURBSShapeSource.h"
#include "vtkXMLMultiBlockDataReader.h"
#include "vtkXMLMultiBlockDataWriter.h"
#include "vtkXMLStructuredGridReader.h"
#include "vtkXMLStructuredGridWriter.h"

#include <functional>

using namespace testing;
using Source = vtkNURBSShapeSource;

namespace
{

const std::vector<vtkSmartPointer<Source>> AllShapes()
{
  std::vector<vtkSmartPointer<Source>> sources;
  for (int shape = Source::SPHERE; shape <= Source::HELIX; ++shape)
  {
    for (const bool capping : { false, true })
    {
      auto source = vtkSmartPointer<Source>::New();
      source->SetShape(shape);
      source->SetCapping(capping);
      source->SetBluntTrailingEdge(capping);
      sources.push_back(source);
    }
  }
  return sources;
}

template <class Writer, class Reader>
vtkSmartPointer<vtkDataObject> ThroughFile(vtkDataObject* data, const std::string& path)
{
  vtkNew<Writer> writer;
  writer->SetInputDataObject(data);
  writer->SetFileName(path.c_str());
  CHECK(writer->Write() == 1);
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutputDataObject(0);
}

void TestOutputs(const std::string& folder)
{
  const std::vector<unsigned int> blocks{ 0, 0, 0, 3, 0, 2, 0, 0, 0, 4, 2, 3, 4, 4, 0, 0, 0, 0, 0,
    0 };
  std::size_t number = 0;
  for (const vtkSmartPointer<Source>& source : AllShapes())
  {
    source->Update();
    vtkDataObject* output = source->GetOutputDataObject(0);
    auto* model = vtkMultiBlockDataSet::SafeDownCast(output);
    CHECK((model ? model->GetNumberOfBlocks() : 0) == blocks[number]);
    ++number;
    const auto read = model ? ThroughFile<vtkXMLMultiBlockDataWriter, vtkXMLMultiBlockDataReader>(
                                output, folder + "/shape.vtm")
                            : ThroughFile<vtkXMLStructuredGridWriter, vtkXMLStructuredGridReader>(
                                output, folder + "/shape.vts");
    const std::vector<Point> points = RandomPoints(50, 3.0);
    const auto before = Feet(output, points);
    const auto after = Feet(read, points);
    for (const char* name : { "Distance", "ClosestPoint", "Parameters" })
    {
      CHECK(SameBits(PointArray(before, name), PointArray(after, name)));
    }
    // === As Bézier cells, through the pipeline
    vtkNew<vtkBezierExtraction> extraction;
    extraction->SetInputConnection(source->GetOutputPort());
    extraction->Update();
    const auto of_cells = Feet(extraction->GetOutput(), points);
    for (vtkIdType i = 0; i < 50; ++i)
    {
      CHECK_NEAR(Value(of_cells, "Distance", i), Value(before, "Distance", i), 1e-12);
    }
  }
}

/// The kind of output follows the options, also after it was updated as another kind.
void TestChanges()
{
  vtkNew<Source> source;
  source->Update();
  CHECK(vtkStructuredGrid::SafeDownCast(source->GetOutputDataObject(0)) != nullptr);
  source->SetShapeToTeapot();
  source->Update();
  auto* model = vtkMultiBlockDataSet::SafeDownCast(source->GetOutputDataObject(0));
  CHECK(model && model->GetNumberOfBlocks() == 4);
  CHECK(std::string(model->GetMetaData(3u)->Get(vtkCompositeDataSet::NAME())) == "Spout");
  CHECK(source->GetShapeAsString() == std::string("Teapot"));
  source->SetShapeToBumpy();
  source->SetResolution(3);
  source->Update();
  auto* net = vtkStructuredGrid::SafeDownCast(source->GetOutputDataObject(0));
  CHECK(net && net->GetNumberOfPoints() == 36);
  source->SetResolution(5);
  source->Update();
  CHECK(vtkStructuredGrid::SafeDownCast(source->GetOutputDataObject(0))->GetNumberOfPoints() == 64);
  source->SetShapeToCylinder();
  source->CappingOn();
  source->Update();
  CHECK(vtkMultiBlockDataSet::SafeDownCast(source->GetOutputDataObject(0)) != nullptr);
  source->CappingOff();
  source->Update();
  CHECK(vtkStructuredGrid::SafeDownCast(source->GetOutputDataObject(0))->GetNumberOfPoints() == 18);

  // === Pieces beyond the first are empty
  for (const int shape : { Source::SPHERE, Source::TEAPOT })
  {
    source->SetShape(shape);
    source->UpdatePiece(1, 2, 0);
    CHECK(source->GetOutputDataObject(0)->GetNumberOfElements(vtkDataObject::POINT) == 0);
    source->UpdatePiece(0, 2, 0);
    CHECK(source->GetOutputDataObject(0)->GetNumberOfElements(vtkDataObject::POINT) > 0);
  }
}

/// Each option changes the shapes that it is documented for, and no other one.
void TestOptions()
{
  using Change = std::function<void(Source*)>;
  const std::vector<std::pair<Change, std::vector<int>>> options{
    { [](Source* s) { s->SetRadius(1.5); },
      { Source::SPHERE, Source::CYLINDER, Source::CONE, Source::TORUS, Source::CIRCLE,
        Source::HELIX } },
    { [](Source* s) { s->SetCrossSectionRadius(0.2); }, { Source::TORUS } },
    { [](Source* s) { s->SetHeight(3); }, { Source::CYLINDER, Source::CONE, Source::HELIX } },
    { [](Source* s) { s->CappingOn(); },
      { Source::CYLINDER, Source::CONE, Source::WING, Source::SHIP_HULL } },
    { [](Source* s) { s->SetAirfoilDigits("0015"); }, { Source::WING } },
    { [](Source* s) { s->SetChord(2); }, { Source::WING } },
    { [](Source* s) { s->SetSpan(7); }, { Source::WING } },
    { [](Source* s) { s->SetTaperRatio(1); }, { Source::WING } },
    { [](Source* s) { s->SetSweepAngle(-5); }, { Source::WING } },
    { [](Source* s) { s->BluntTrailingEdgeOn(); }, { Source::WING } },
    { [](Source* s) { s->SetLength(11); }, { Source::SHIP_HULL } },
    { [](Source* s) { s->SetBeam(2); }, { Source::SHIP_HULL } },
    { [](Source* s) { s->SetDraft(1); }, { Source::SHIP_HULL } },
    { [](Source* s) { s->SetSize(1); }, { Source::BUMPY } },
    { [](Source* s) { s->SetAmplitude(1); }, { Source::BUMPY } },
    { [](Source* s) { s->SetResolution(4); }, { Source::BUMPY } },
    { [](Source* s) { s->SetSeed(2); }, { Source::BUMPY } },
    { [](Source* s) { s->SetTurns(2); }, { Source::HELIX } },
    { [](Source* s) { s->SetHelixTolerance(1e-3); }, { Source::HELIX } },
    { [](Source* s) { s->SetCenter(0, 0, 1); },
      { Source::SPHERE, Source::CYLINDER, Source::CONE, Source::TORUS, Source::WING,
        Source::SHIP_HULL, Source::TEAPOT, Source::BUMPY, Source::CIRCLE, Source::HELIX } }
  };
  const std::vector<Point> points = RandomPoints(20, 2.0);
  for (int shape = Source::SPHERE; shape <= Source::HELIX; ++shape)
  {
    vtkNew<Source> usual;
    usual->SetShape(shape);
    usual->Update();
    const auto before = Feet(usual->GetOutputDataObject(0), points);
    for (const auto& [change, of] : options)
    {
      vtkNew<Source> changed;
      changed->SetShape(shape);
      change(changed);
      changed->Update();
      const auto after = Feet(changed->GetOutputDataObject(0), points);
      const bool same = SameBits(PointArray(before, "Distance"), PointArray(after, "Distance")) &&
        changed->GetOutputDataObject(0)->IsA(usual->GetOutputDataObject(0)->GetClassName());
      CHECK(same == (std::find(of.begin(), of.end(), shape) == of.end()));
    }
  }
}

void TestRefusals()
{
  vtkNew<Source> source;
  vtkNew<MessageRecorder> recorder;
  recorder->Watch(source);
  const auto error = [&]
  {
    recorder->Clear();
    source->Update();
    CHECK(source->GetOutputDataObject(0)->GetNumberOfElements(vtkDataObject::POINT) == 0);
    return recorder->Errors;
  };
  source->SetRadius(-1.0);
  CHECK(Contains(error(), "Radius = -1; a positive, finite length is needed"));
  source->SetRadius(1.0);
  source->SetShapeToTorus();
  source->SetCrossSectionRadius(1.0);
  CHECK(Contains(error(), "CrossSectionRadius = 1; it must be less than Radius = 1"));
  source->SetShapeToWing();
  source->SetAirfoilDigits("24x2");
  CHECK(Contains(error(), "AirfoilDigits = '24x2'; four digits are needed"));
  source->CappingOn();
  CHECK(Contains(error(), "AirfoilDigits = '24x2'; four digits are needed"));
  source->SetShapeToSphere();
  source->SetCenter(0.0, std::nan(""), 0.0);
  CHECK(Contains(error(), "Center[1] = nan"));
  source->SetCenter(0.0, 0.0, 0.0);
  recorder->Clear();
  source->Update();
  CHECK(recorder->Errors.empty());
  CHECK(source->GetOutputDataObject(0)->GetNumberOfElements(vtkDataObject::POINT) == 45);
}

} // namespace

int TestNURBSShapeSource(int argc, char* argv[])
{
  return Run(
    [&]
    {
      TestOutputs(OutputFolder(argc, argv));
      TestChanges();
      TestOptions();
      TestRefusals();
    });
}
