// SPDX-License-Identifier: BSD-3-Clause
// vtkCADReader on files that the test writes itself, so that every answer is known: surfaces of all
// kinds with slanted cuts, units, names, colours, assemblies, selections, meshes, pieces.
#include "CADTesting.h"

#include "vtkCellData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepGProp.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BRepTools.hxx>
#include <GProp_GProps.hxx>
#include <Geom_BezierCurve.hxx>
#include <Geom_OffsetSurface.hxx>
#include <Geom_SurfaceOfLinearExtrusion.hxx>
#include <Interface_Static.hxx>
#include <Quantity_Color.hxx>
#include <STEPCAFControl_Controller.hxx>
#include <STEPCAFControl_Writer.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>

#include <fstream>

using namespace testing;

namespace
{

std::string folder;

std::string WriteBrep(const TopoDS_Shape& shape, const std::string& name)
{
  const std::string path = folder + "/" + name;
  CHECK(BRepTools::Write(shape, path.c_str()));
  return path;
}

/// A sheared block that cuts slantwise through what is at the origin.
TopoDS_Shape SlantedCut(const TopoDS_Shape& shape)
{
  const gp_Ax2 frame(gp_Pnt(0.3, -0.2, 0.1), gp_Dir(1.0, 0.7, 0.4));
  return BRepAlgoAPI_Cut(shape, BRepPrimAPI_MakeBox(frame, 50.0, 50.0, 50.0).Shape()).Shape();
}

/// Volume that the display mesh encloses, by its triangles.
double Volume(vtkPolyData* mesh)
{
  double six = 0.0;
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
  {
    vtkNew<vtkIdList> corners;
    mesh->GetCellPoints(i, corners);
    double a[3];
    double b[3];
    double c[3];
    mesh->GetPoint(corners->GetId(0), a);
    mesh->GetPoint(corners->GetId(1), b);
    mesh->GetPoint(corners->GetId(2), c);
    double cross[3];
    vtkMath::Cross(b, c, cross);
    six += vtkMath::Dot(a, cross);
  }
  return six / 6.0;
}

/// Solids of every kind of surface, whole and cut: all faces are read, outward.
void TestSolids()
{
  const std::vector<std::pair<std::string, TopoDS_Shape>> solids = {
    { "box", BRepPrimAPI_MakeBox(1.0, 2.0, 3.0).Shape() },
    { "cylinder", BRepPrimAPI_MakeCylinder(2.0, 5.0).Shape() },
    { "cone", BRepPrimAPI_MakeCone(3.0, 0.0, 4.0).Shape() },
    { "sphere", BRepPrimAPI_MakeSphere(2.5).Shape() },
    { "torus", BRepPrimAPI_MakeTorus(3.0, 1.0).Shape() },
  };
  for (const auto& [name, whole] : solids)
  {
    for (const bool cut : { false, true })
    {
      const TopoDS_Shape shape = cut ? SlantedCut(whole) : whole;
      const std::string path = WriteBrep(shape, name + (cut ? "_cut.brep" : ".brep"));
      vtkNew<vtkCADReader> reader;
      reader->SetDeflection(1e-3);
      const CadResult result = Read(reader, path);
      CHECK(result.errors.empty() && result.warnings.empty());
      TopTools_IndexedMapOfShape faces;
      TopExp::MapShapes(shape, TopAbs_FACE, faces);
      CHECK(result.faces == faces.Extent() && result.skipped == 0);
      GProp_GProps properties;
      BRepGProp::VolumeProperties(shape, properties);
      CHECK(properties.Mass() > 0.0);
      CHECK_NEAR(Volume(result.mesh), properties.Mass(), 0.01 * properties.Mass());
    }
  }
}

/// On the unit circle's rational parameters, and yet every point and normal is the sphere's.
void TestSphere()
{
  const std::string path = WriteBrep(BRepPrimAPI_MakeSphere(2.5).Shape(), "whole_sphere.brep");
  const CadResult result = Read(path);
  auto* net = vtkStructuredGrid::SafeDownCast(result.model->GetBlock(0));
  CHECK(net != nullptr); // its loop is the border of the domain: no trimmed face
  const footpoint::Surface sphere = MakeSurface(net);
  for (int i = 0; i <= 20; ++i)
  {
    for (int j = 0; j <= 20; ++j)
    {
      const footpoint::Parameter<2> at(
        sphere.direction(0).length * i / 20, sphere.direction(1).length * j / 20);
      CHECK_NEAR((sphere.centre() + sphere.point(at)).norm(), 2.5, 1e-14);
    }
  }
  for (vtkIdType i = 0; i < result.mesh->GetNumberOfPoints(); ++i)
  {
    double p[3];
    result.mesh->GetPoint(i, p);
    const double* n = result.mesh->GetPointData()->GetNormals()->GetTuple3(i);
    CHECK_NEAR(vtkMath::Dot(p, n), 2.5, 1e-9);
  }
}

/// An offset of a bent surface is no NURBS surface: approximated, and said so.
void TestOffsetSurface()
{
  TColgp_Array1OfPnt poles(1, 4);
  poles(1) = gp_Pnt(0, 0, 0);
  poles(2) = gp_Pnt(1, 2, 0);
  poles(3) = gp_Pnt(3, -1, 0);
  poles(4) = gp_Pnt(4, 1, 0);
  const Handle(Geom_Surface) bent =
    new Geom_SurfaceOfLinearExtrusion(new Geom_BezierCurve(poles), gp_Dir(0, 0, 1));
  const Handle(Geom_Surface) offset = new Geom_OffsetSurface(bent, 0.1);
  const std::string path =
    WriteBrep(BRepBuilderAPI_MakeFace(offset, 0.0, 1.0, 0.0, 2.0, 1e-7).Face(), "offset.brep");
  const CadResult result = Read(path);
  CHECK(result.errors.empty());
  CHECK(Contains(result.warnings, "face 0 has a surface that is no NURBS surface"));
  const ReadFace face = FaceOf(result.model->GetBlock(0));
  for (int i = 0; i <= 10; ++i)
  {
    const footpoint::Vector3 ours = At(*face.surface, 0.1 * i, 0.7);
    const gp_Pnt theirs = offset->Value(0.1 * i, 0.7);
    CHECK(gp_Pnt(ours[0], ours[1], ours[2]).Distance(theirs) <= FieldValue(face.net, "Tolerance"));
  }
}

/// Two boxes, a red one named and one with a green face, in an assembly; lengths in inches.
std::string WriteAssembly()
{
  STEPCAFControl_Controller::Init();
  Handle(TDocStd_Document) document;
  XCAFApp_Application::GetApplication()->NewDocument("BinXCAF", document);
  const Handle(XCAFDoc_ShapeTool) shapes = XCAFDoc_DocumentTool::ShapeTool(document->Main());
  const Handle(XCAFDoc_ColorTool) colours = XCAFDoc_DocumentTool::ColorTool(document->Main());
  const TDF_Label assembly = shapes->NewShape();
  TDataStd_Name::Set(assembly, "assembly");
  const TDF_Label red = shapes->AddShape(BRepPrimAPI_MakeBox(25.4, 25.4, 25.4).Shape(), false);
  TDataStd_Name::Set(red, "red box");
  colours->SetColor(red, Quantity_Color(1.0, 0.0, 0.0, Quantity_TOC_sRGB), XCAFDoc_ColorSurf);
  const TopoDS_Shape plain = BRepPrimAPI_MakeBox(10.0, 10.0, 10.0).Shape();
  const TDF_Label other = shapes->AddShape(plain, false);
  TDataStd_Name::Set(other, "other box");
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(plain, TopAbs_FACE, faces);
  const TDF_Label lid = shapes->AddSubShape(other, faces(3));
  colours->SetColor(lid, Quantity_Color(0.0, 1.0, 0.0, Quantity_TOC_sRGB), XCAFDoc_ColorSurf);
  gp_Trsf move;
  move.SetTranslation(gp_Vec(254.0, 0.0, 0.0));
  shapes->AddComponent(assembly, red, TopLoc_Location());
  shapes->AddComponent(assembly, red, TopLoc_Location(move));
  shapes->AddComponent(assembly, other, TopLoc_Location());
  shapes->UpdateAssemblies();
  Interface_Static::SetCVal("write.step.unit", "INCH");
  STEPCAFControl_Writer writer;
  CHECK(writer.Transfer(document, STEPControl_AsIs));
  const std::string path = folder + "/assembly.step";
  CHECK(writer.Write(path.c_str()) == IFSelect_RetDone);
  return path;
}

void TestAssembly()
{
  const std::string path = WriteAssembly();
  const CadResult result = Read(path);
  CHECK(result.errors.empty() && result.faces == 18);
  int named = 0;
  for (unsigned int i = 0; i < 18; ++i)
  {
    const ReadFace face = FaceOf(result.model->GetBlock(i));
    CHECK(FieldText(face.net, "LengthUnit") == "inch");
    named += FieldText(face.net, "FaceName") == "red box" ? 1 : 0;
  }
  CHECK(named == 12);
  double bounds[6];
  result.mesh->GetBounds(bounds);
  CHECK_NEAR(bounds[1], 11.0, 1e-12); // the second red box stands 10 inches off
  auto* colours = result.mesh->GetCellData()->GetArray("Colors");
  CHECK(colours != nullptr && colours->GetNumberOfComponents() == 3);
  vtkIdType red = 0;
  vtkIdType green = 0;
  vtkIdType plain = 0;
  for (vtkIdType i = 0; i < colours->GetNumberOfTuples(); ++i)
  {
    const double* c = colours->GetTuple3(i);
    red += c[0] == 255 && c[1] == 0 && c[2] == 0 ? 1 : 0;
    green += c[0] == 0 && c[1] == 255 && c[2] == 0 ? 1 : 0;
    plain += c[0] == 204 && c[1] == 204 && c[2] == 204 ? 1 : 0;
  }
  CHECK(red == 24 && green == 2 && plain == 10);

  for (const auto& [unit, expected] :
    { std::pair<const char*, double>{ "mm", 279.4 }, { "m", 0.2794 }, { "inch", 11.0 } })
  {
    vtkNew<vtkCADReader> reader;
    reader->SetLengthUnit(unit);
    const CadResult in_unit = Read(reader, path);
    in_unit.mesh->GetBounds(bounds);
    CHECK_NEAR(bounds[1], expected, 1e-12 * expected);
    CHECK(FieldText(FaceOf(in_unit.model->GetBlock(0)).net, "LengthUnit") == unit);
  }
}

void TestSelection()
{
  const std::string path = WriteBrep(BRepPrimAPI_MakeBox(1.0, 2.0, 3.0).Shape(), "selection.brep");
  vtkNew<vtkCADReader> reader;
  reader->SetFaces("1, 3-4");
  const CadResult result = Read(reader, path);
  CHECK(result.errors.empty() && result.faces == 6 && result.skipped == 0);
  for (unsigned int i = 0; i < 6; ++i)
  {
    CHECK((result.model->GetBlock(i) != nullptr) == (i == 1 || i == 3 || i == 4));
  }
  auto* ids = result.mesh->GetCellData()->GetArray("FaceId");
  CHECK(ids->GetRange()[0] == 1 && ids->GetRange()[1] == 4);
  for (const auto& [faces, part] : { std::pair<const char*, const char*>{ "2-1", "backwards" },
         { "x", "'x' is neither" }, { "6", "there is no face 6" } })
  {
    vtkNew<vtkCADReader> other;
    other->SetFaces(faces);
    const CadResult refused = Read(other, path);
    CHECK(Contains(refused.errors, part));
    CHECK(refused.model->GetNumberOfBlocks() == 0 && refused.mesh->GetNumberOfCells() == 0);
  }
  vtkNew<vtkCADReader> other;
  other->SetLengthUnit("furlong");
  CHECK(Contains(Read(other, path).errors, "LengthUnit 'furlong' is none of"));
}

void TestMeshAndEdges()
{
  const std::string path = WriteBrep(BRepPrimAPI_MakeCylinder(2.0, 5.0).Shape(), "mesh.brep");
  vtkIdType before = 0;
  for (const double deflection : { 0.1, 0.001 })
  {
    vtkNew<vtkCADReader> reader;
    reader->SetDeflection(deflection);
    reader->SetAngularDeflection(90.0);
    const CadResult result = Read(reader, path);
    CHECK(result.mesh->GetNumberOfCells() > 2 * before);
    before = result.mesh->GetNumberOfCells();
  }
  vtkNew<vtkCADReader> reader;
  reader->GenerateMeshOff();
  reader->HealingOn();
  const CadResult result = Read(reader, path);
  CHECK(result.mesh->GetNumberOfCells() == 0 && result.faces == 3);
  CHECK(result.edges->GetNumberOfBlocks() == 3); // two circles and the seam
  int seams = 0;
  for (unsigned int i = 0; i < 3; ++i)
  {
    vtkDataArray* owners = result.edges->GetBlock(i)->GetFieldData()->GetArray("FaceIds");
    seams += owners->GetNumberOfTuples() == 1 ? 1 : 0;
    CHECK(owners->GetNumberOfTuples() <= 2);
  }
  CHECK(seams == 1);
}

void TestPieces()
{
  const std::string path = WriteBrep(BRepPrimAPI_MakeBox(1.0, 2.0, 3.0).Shape(), "pieces.brep");
  vtkNew<vtkCADReader> reader;
  reader->SetFileName(path.c_str());
  reader->UpdatePiece(1, 2, 0);
  CHECK(reader->GetOutput()->GetNumberOfCells() == 0);
  reader->UpdatePiece(0, 2, 0);
  CHECK(reader->GetOutput()->GetNumberOfCells() == 12);
}

} // namespace

int TestCADReaderOptions(int argc, char* argv[])
{
  char* temporary = vtkTestUtilities::GetArgOrEnvOrDefault("-T", argc, argv, "T", ".");
  folder = temporary;
  delete[] temporary;
  footpoint::cad::redirect_messages();
  return Run(
    []
    {
      TestSolids();
      TestSphere();
      TestOffsetSurface();
      TestAssembly();
      TestSelection();
      TestMeshAndEdges();
      TestPieces();
    });
}
