// SPDX-License-Identifier: BSD-3-Clause
// Trimmed faces as VTK data: which loops and curves become of them, what is refused with which
// words, and what their content changes.
#include "FilterTesting.h"

#include "GeometryHash.h"
#include "SplineConversion.h"

#include "vtkCellArray.h"
#include "vtkCompositeDataSet.h"
#include "vtkInformation.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkMultiPieceDataSet.h"
#include "vtkPointInversionFilter.h"
#include "vtkSplineEvaluator.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

using namespace testing;
using footpoint::conversion::convert_to_model;
using footpoint::conversion::ConvertedModel;

namespace
{

void Append(vtkMultiBlockDataSet* blocks, vtkDataObject* data, const char* name)
{
  const unsigned int number = blocks->GetNumberOfBlocks();
  blocks->SetBlock(number, data);
  blocks->GetMetaData(number)->Set(vtkCompositeDataSet::NAME(), name);
}

vtkSmartPointer<vtkMultiBlockDataSet> MakeBlocks(const std::vector<vtkDataObject*>& data)
{
  auto blocks = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  for (vtkDataObject* object : data)
  {
    blocks->SetBlock(blocks->GetNumberOfBlocks(), object);
  }
  return blocks;
}

/// Points as a grid without knots.
vtkSmartPointer<vtkStructuredGrid> MakePolyline(const std::vector<Point>& corners)
{
  auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
  grid->SetDimensions(static_cast<int>(corners.size()), 1, 1);
  grid->SetPoints(MakePoints(corners)->GetPoints());
  return grid;
}

vtkSmartPointer<vtkPolyData> MakeLines(
  const std::vector<Point>& corners, const std::vector<std::vector<vtkIdType>>& lines)
{
  auto data = MakePoints(corners);
  vtkNew<vtkCellArray> cells;
  for (const std::vector<vtkIdType>& line : lines)
  {
    cells->InsertNextCell(static_cast<vtkIdType>(line.size()), line.data());
  }
  data->SetLines(cells);
  return data;
}

const std::vector<Point> kCorners{ { { 0, 0, 0 } }, { { 1, 0, 0 } }, { { 1, 1, 0 } },
  { { 0, 1, 0 } }, { { 0, 0, 0 } } };

/// The unit square with one loop.
vtkSmartPointer<vtkMultiBlockDataSet> MakeFace(vtkDataObject* loop)
{
  auto face = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  Append(face, MakeSquare(), "Surface");
  Append(face, loop, "Loop 0");
  return face;
}

/// The loops of the only face of good data.
std::vector<footpoint::TrimLoop> LoopsOf(vtkDataObject* data)
{
  const ConvertedModel converted = convert_to_model(data, false);
  for (const std::string& message : converted.messages())
  {
    throw std::runtime_error(message);
  }
  CHECK(converted.model.size() == 1);
  CHECK(converted.model[0].patches.size() == 1 && converted.model[0].patches[0].surface);
  return converted.model[0].loops;
}

footpoint::Points Corners(const footpoint::Curve& curve)
{
  return curve.local_control_points().colwise() + curve.centre();
}

void CheckCorners(const footpoint::Curve& curve, const std::vector<Point>& expected)
{
  CHECK(curve.knots().degree() == 1 && !curve.rational());
  const footpoint::Points corners = Corners(curve);
  CHECK(corners.cols() == static_cast<Eigen::Index>(expected.size()));
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      CHECK_NEAR(corners(k, static_cast<Eigen::Index>(i)), expected[i][k], 1e-15);
    }
    CHECK(curve.knots().knots()[i + 1] == static_cast<double>(i));
  }
}

void TestLoops()
{
  // Loops by their numbers, whatever the order of the blocks.
  vtkNew<vtkMultiBlockDataSet> face;
  const auto hole = MakeCircle();
  Append(face, MakeBlocks({ hole }), "Loop 1");
  Append(face, MakeSquare(), "Surface");
  const auto open =
    MakePolyline({ kCorners[0], kCorners[1], kCorners[1], kCorners[2], kCorners[3] });
  const auto last = MakePolyline({ kCorners[3], kCorners[0] });
  Append(face, MakeBlocks({ open, last }), "Loop 0");
  const std::vector<footpoint::TrimLoop> loops = LoopsOf(face);
  CHECK(loops.size() == 2);
  CHECK(loops[0].curves.size() == 2);
  // A point that is there twice makes no segment.
  CheckCorners(*loops[0].curves[0], { kCorners[0], kCorners[1], kCorners[2], kCorners[3] });
  CheckCorners(*loops[0].curves[1], { kCorners[3], kCorners[0] });
  CHECK(loops[1].curves.size() == 1);
  CHECK(loops[1].curves[0]->rational() && loops[1].curves[0]->knots().degree() == 2);

  // Lines are curves one by one, in the order of the cells.
  const auto lines = MakeLines(kCorners, { { 0, 1, 2 }, { 2, 3, 4 } });
  for (const auto& loop : { LoopsOf(MakeFace(MakeBlocks({ lines }))), LoopsOf(MakeFace(lines)) })
  {
    CHECK(loop.size() == 1 && loop[0].curves.size() == 2);
    CheckCorners(*loop[0].curves[1], { kCorners[2], kCorners[3], kCorners[4] });
  }
  // One piece of a partitioned data set is the data.
  vtkNew<vtkMultiPieceDataSet> pieces;
  pieces->SetPiece(1, MakePolyline(kCorners));
  CHECK(LoopsOf(MakeFace(MakeBlocks({ pieces })))[0].curves.size() == 1);
}

void TestAttributes()
{
  const auto face = MakeFace(MakeBlocks({ MakePolyline(kCorners) }));
  vtkFieldData* data = face->GetBlock(0)->GetFieldData();
  AddNumbers(data, "Tolerance", { 1e-3 });
  AddNumbers(data, "Orientation", { -1 });
  vtkNew<vtkMultiBlockDataSet> model;
  model->SetBlock(0, MakeSquare());
  Append(model, face, "wing");
  ConvertedModel converted = convert_to_model(model, false);
  CHECK(converted.problems.empty() && converted.model.size() == 2);
  CHECK(converted.model[0].loops.empty() && converted.model[0].tolerance == 0);
  CHECK(converted.model[1].name == "wing" && converted.model[1].reversed);
  CHECK(converted.model[1].tolerance == 1e-3);
  CHECK(!convert_to_model(model, true).model[1].reversed);

  vtkNew<vtkStringArray> name;
  name->SetName("FaceName");
  name->InsertNextValue("slat");
  data->AddArray(name);
  CHECK(convert_to_model(model, false).model[1].name == "slat");
  AddNumbers(data, "Tolerance", { -1 });
  converted = convert_to_model(model, false);
  CHECK(converted.messages().size() == 1 && converted.model[1].patches.empty());
  CHECK(Contains(converted.messages()[0], "Face 1 ('wing'): Tolerance[0] = -1"));
  CHECK(converted.model[0].patches.size() == 1);
}

void CheckRefused(vtkDataObject* data, const std::string& text)
{
  const ConvertedModel converted = convert_to_model(data, false);
  CHECK(converted.model.size() == 1 && converted.empty());
  CHECK(converted.model[0].loops.empty());
  CHECK(converted.messages().size() == 1);
  if (!Contains(converted.messages()[0], "Face 0: " + text))
  {
    throw std::runtime_error("'" + text + "' is not in: " + converted.messages()[0]);
  }
}

void TestRefusedLoops()
{
  vtkNew<vtkMultiBlockDataSet> empty;
  CheckRefused(MakeFace(nullptr), "Loop 0 has no curves");
  CheckRefused(MakeFace(empty), "Loop 0 has no curves");
  const auto square = MakePolyline(kCorners);
  CheckRefused(MakeFace(MakeBlocks({ square, nullptr })), "Loop 0, curve 1: it is empty");
  CheckRefused(MakeFace(MakeBlocks({ empty })), "Loop 0, curve 0: it is a vtkMultiBlockDataSet");
  CheckRefused(MakeFace(MakeBlocks({ MakeSquare() })), "Loop 0, curve 0: it is a surface");
  CheckRefused(MakeFace(MakeBlocks({ MakePolyline({ kCorners[1], kCorners[1] }) })),
    "Loop 0, curve 0: the polyline has 1 distinct points");
  CheckRefused(MakeFace(MakeBlocks({ square, MakePolyline({ kCorners[0], { { 1, 0, 0.5 } } }) })),
    "Loop 0, curve 1: control point 1 has z = 0.5");
  CheckRefused(
    MakeFace(MakePolyline({ kCorners[0], { { std::nan(""), 1, 0 } } })), "Loop 0, curve 0: ");
  CheckRefused(MakeFace(MakePoints(kCorners)), "Loop 0, curve 0: it is a vtkPolyData with 0 lines");

  const auto curve = MakeParabola();
  curve->GetFieldData()->RemoveArray("KnotsU");
  CheckRefused(MakeFace(curve), "Loop 0, curve 0: it has no KnotsU");
  const auto knots = MakeCircle();
  knots->GetFieldData()->GetArray("KnotsU")->SetComponent(4, 0, -7.0);
  CheckRefused(MakeFace(knots), "Loop 0, curve 0: KnotsU[4] = -7");
  const auto grid = MakeSquare();
  grid->GetFieldData()->Initialize();
  CheckRefused(MakeFace(grid), "Loop 0, curve 0: it has dimensions (2, 2, 1)");
  const auto lifted = MakeCircle();
  lifted->GetPoints()->SetPoint(3, 0, 0, -2);
  CheckRefused(MakeFace(lifted), "Loop 0, curve 0: control point 3 has z = -2");
}

void TestRefusedFaces()
{
  const auto loop = MakePolyline(kCorners);
  auto face = MakeFace(loop);
  Append(face, loop, "Loop 0");
  CheckRefused(face, "the trimmed face has 2 loops, but their numbers are not 0 to 1");
  face = MakeFace(loop);
  Append(face, loop, "Loop 2");
  CheckRefused(face, "the trimmed face has 2 loops, but their numbers are not 0 to 1: Loop 1 is");
  face = MakeFace(loop);
  Append(face, loop, "Loop a");
  CheckRefused(face, "the block 'Loop a' has no number");
  face = MakeFace(loop);
  Append(face, loop, "Curve");
  CheckRefused(face, "block 2 of the trimmed face is called 'Curve'");
  face = MakeFace(loop);
  Append(face, MakeSquare(), "Surface");
  CheckRefused(face, "block 2 of the trimmed face is called 'Surface'");
  face = MakeFace(loop);
  face->SetBlock(0, nullptr);
  face->GetMetaData(0u)->Set(vtkCompositeDataSet::NAME(), "Surface");
  CheckRefused(face, "the block Surface is empty");
  face = MakeFace(loop);
  face->SetBlock(0, MakePoints(kCorners));
  CheckRefused(face, "the block Surface is a vtkPolyData");
  face = MakeFace(loop);
  face->SetBlock(0, MakeCircle());
  CheckRefused(face, "the block Surface is a curve");
}

/// Faces are trimmed by themselves, in any order: what is told of them keeps theirs.
void TestManyFaces()
{
  constexpr int kFaces = 40;
  const auto open = MakePolyline({ kCorners[0], kCorners[1], kCorners[2] });
  vtkNew<vtkMultiBlockDataSet> model;
  for (int k = 0; k < kFaces; ++k)
  {
    const auto face = MakeFace(k == 5 || k == 30 ? open : MakePolyline(kCorners));
    AddNumbers(face->GetBlock(0)->GetFieldData(), "Tolerance", { k == 12 ? -1.0 : 1e-6 });
    Append(model, face, ("panel " + std::to_string(k)).c_str());
  }
  footpoint::Execution backwards;
  backwards.parallel_for =
    [](std::int64_t count, const std::function<void(std::int64_t, std::int64_t)>& body)
  {
    for (std::int64_t k = count; k > 0; --k)
    {
      body(k - 1, k);
    }
  };
  const ConvertedModel alone = convert_to_model(model, true);
  const ConvertedModel shared = convert_to_model(model, true, backwards);
  CHECK(alone.messages() == shared.messages());
  const std::vector<std::string> messages = alone.messages();
  CHECK(messages.size() == 3);
  CHECK(Contains(messages[0], "Face 5 ('panel 5'): "));
  CHECK(Contains(messages[1], "Face 12 ('panel 12'): Tolerance[0] = -1"));
  CHECK(Contains(messages[2], "Face 30 ('panel 30'): "));
  for (std::size_t k = 0; k < kFaces; ++k)
  {
    const bool refused = k == 5 || k == 12 || k == 30;
    for (const ConvertedModel* converted : { &alone, &shared })
    {
      const footpoint::Face& face = converted->model[k];
      CHECK(face.name == "panel " + std::to_string(k));
      CHECK(face.patches.empty() == refused && face.loops.empty() == refused);
      CHECK((face.region == nullptr) == refused && face.reversed == !refused);
    }
  }
}

void TestHash()
{
  const auto hash = [](vtkDataObject* data)
  {
    footpoint::conversion::ContentHash content;
    content.add(data);
    return content;
  };
  const auto lines = MakeLines(kCorners, { { 0, 1, 2 }, { 2, 3, 4 } });
  const auto face = MakeFace(MakeBlocks({ lines }));
  const auto before = hash(face);
  CHECK(before == hash(MakeFace(MakeBlocks({ lines }))));
  CHECK(
    before != hash(MakeFace(MakeBlocks({ MakeLines(kCorners, { { 0, 1 }, { 1, 2, 3, 4 } }) }))));
  AddNumbers(face->GetBlock(0)->GetFieldData(), "Tolerance", { 1e-3 });
  const auto with_tolerance = hash(face);
  CHECK(with_tolerance != before);
  lines->GetPoints()->SetPoint(1, 0.9, 0, 0);
  CHECK(hash(face) != with_tolerance);
}

/// The evaluator takes the surface of a trimmed face.
void TestEvaluator()
{
  vtkNew<vtkTable> table;
  vtkNew<vtkDoubleArray> parameters;
  parameters->SetName("Parameters");
  parameters->SetNumberOfComponents(2);
  parameters->InsertNextTuple2(0.75, 0.25);
  table->AddColumn(parameters);
  vtkNew<vtkSplineEvaluator> evaluator;
  evaluator->SetInputData(table);
  evaluator->SetSourceData(MakeFace(MakePolyline(kCorners)));
  evaluator->Update();
  CHECK(evaluator->GetOutput()->GetNumberOfPoints() == 1);
  CHECK(evaluator->GetOutput()->GetPoint(0)[0] == 0.75);
  CHECK(evaluator->GetOutput()->GetPoint(0)[1] == 0.25);
}

} // namespace

int TestTrimmedFaces(int, char*[])
{
  return Run(
    []
    {
      TestLoops();
      TestAttributes();
      TestRefusedLoops();
      TestRefusedFaces();
      TestManyFaces();
      TestHash();
      TestEvaluator();
    });
}
