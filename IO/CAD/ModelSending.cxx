// SPDX-License-Identifier: BSD-3-Clause
#include "ModelSending.h"

#include "CADStream.h"
#include "DisplayMesh.h"
#include "EdgeConversion.h"
#include "FaceConversion.h"
#include "FaceSelection.h"
#include "LengthUnits.h"
#include "ShapeAttributes.h"
#include "ShapeReading.h"

#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Message_ProgressIndicator.hxx>
#include <Message_ProgressScope.hxx>
#include <ShapeFix_Shape.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>

#include <algorithm>
#include <exception>
#include <new>

namespace footpoint::cad
{

namespace
{

/// Shares of the whole work in its progress.
constexpr double kReading = 0.5;
constexpr double kFaces = 0.3;
/// Least step of progress that is sent.
constexpr double kProgressStep = 0.005;

/// What an exception says, whoever threw it.
std::string reason_of(const std::exception_ptr& exception)
{
  try
  {
    std::rethrow_exception(exception);
  }
  catch (const Standard_Failure& failure)
  {
    const std::string text = failure.GetMessageString() ? failure.GetMessageString() : "";
    return std::string("Open CASCADE says ") + failure.DynamicType()->Name() +
      (text.empty() ? "" : ": " + text);
  }
  catch (const std::bad_alloc&)
  {
    return "there is not enough memory";
  }
  catch (const std::exception& failure)
  {
    return failure.what();
  }
  catch (...)
  {
    return "Open CASCADE threw something unknown";
  }
}

class ProgressSender : public Message_ProgressIndicator
{
public:
  ProgressSender(int records, double first, double share)
    : Records(records)
    , First(first)
    , Share(share)
  {
  }

  void Show(const Message_ProgressScope&, const Standard_Boolean) override
  {
    const double position = this->GetPosition();
    if (position >= this->Last + kProgressStep)
    {
      this->Last = position;
      write_record(
        this->Records, RecordKind::Progress, Packer() << this->First + this->Share * position);
    }
  }

private:
  int Records;
  double First;
  double Share;
  double Last = 0.0;
};

class Sender
{
public:
  Sender(const ReadingOptions& options, int records)
    : Options(options)
    , Records(records)
    , Wanted(options.faces)
    , LeftOut(options.left_out)
  {
  }

  void send()
  {
    this->read();
    this->send_faces();
    this->send_edges();
    if (this->Options.mesh)
    {
      this->send_mesh();
    }
    this->send(RecordKind::Done, Packer());
  }

private:
  void send(RecordKind kind, const Packer& content) { write_record(this->Records, kind, content); }

  void send_stage(const std::string& stage) { this->send(RecordKind::Stage, Packer() << stage); }

  void read()
  {
    this->send_stage("reading the file");
    redirect_messages();
    const Handle(ProgressSender) progress = new ProgressSender(this->Records, 0.0, kReading);
    ReadShape read = read_shape(this->Options.file, progress->Start());
    this->Shape = read.shape;
    if (this->Options.healing)
    {
      this->heal();
    }
    TopExp::MapShapes(this->Shape, TopAbs_FACE, this->Faces);
    TopExp::MapShapes(this->Shape, TopAbs_EDGE, this->Edges);
    if (this->Faces.IsEmpty() && this->Edges.IsEmpty())
    {
      const std::string messages = failure_messages();
      throw ReadingError("the file has no face and no edge" +
        (read.warnings.empty() ? "" : ": " + read.warnings.front()) +
        (messages.empty() ? "" : ": " + messages));
    }
    if (this->Wanted.largest() >= this->Faces.Extent())
    {
      throw ReadingError("there is no face " + std::to_string(this->Wanted.largest()) +
        " of those that are asked for; the file has " + std::to_string(this->Faces.Extent()));
    }
    const std::string unit =
      this->Options.unit.empty() ? read.unit : short_unit_name(this->Options.unit);
    this->Scale = 1.0 / millimetres_in(unit);
    this->Attributes = face_attributes(read.document, this->Shape, this->Faces);
    this->send(RecordKind::Summary,
      packed(ModelSummary{ this->Faces.Extent(), this->Edges.Extent(), unit }));
    for (const std::string& warning : read.warnings)
    {
      this->send(RecordKind::Warning, Packer() << warning);
    }
  }

  void heal()
  {
    this->send_stage("healing the shape");
    ShapeFix_Shape fix(this->Shape);
    fix.Perform();
    this->Shape = fix.Shape();
  }

  bool wanted(int index) const
  {
    const std::int64_t id = index - 1;
    return (this->Wanted.empty() || this->Wanted.contains(id)) && !this->LeftOut.contains(id);
  }

  std::string name_of(int index) const
  {
    return this->Attributes[static_cast<std::size_t>(index) - 1].name;
  }

  void send_faces()
  {
    FaceConversionOptions options;
    options.scale = this->Scale;
    for (int index = 1; index <= this->Faces.Extent(); ++index)
    {
      if (!this->wanted(index))
      {
        continue;
      }
      const std::int64_t id = index - 1;
      this->send(RecordKind::FaceBegins, Packer() << id);
      try
      {
        ConvertedFace face = convert_face(TopoDS::Face(this->Faces(index)), options);
        face.data.id = id;
        face.data.name = this->name_of(index);
        if (face.surface_error > 0.0)
        {
          this->send(RecordKind::Warning,
            Packer() << "face " + std::to_string(id) +
                " has a surface that is no NURBS surface; it was approximated to " +
                std::to_string(face.surface_error));
        }
        this->send(RecordKind::Face, packed(face.data));
      }
      catch (const StreamError&)
      {
        throw;
      }
      catch (...)
      {
        this->send(RecordKind::SkippedFace,
          Packer() << id << this->name_of(index) << reason_of(std::current_exception()));
      }
      this->send(
        RecordKind::Progress, Packer() << kReading + kFaces * index / this->Faces.Extent());
    }
  }

  void send_edges()
  {
    this->send_stage("converting the edges");
    TopTools_IndexedDataMapOfShapeListOfShape owners;
    TopExp::MapShapesAndAncestors(this->Shape, TopAbs_EDGE, TopAbs_FACE, owners);
    for (int index = 1; index <= this->Edges.Extent(); ++index)
    {
      std::vector<std::int64_t> faces;
      bool wanted = false;
      if (const TopTools_ListOfShape* list = owners.Seek(this->Edges(index)))
      {
        for (const TopoDS_Shape& face : *list)
        {
          const int face_index = this->Faces.FindIndex(face);
          faces.push_back(face_index - 1);
          wanted = wanted || this->wanted(face_index);
        }
      }
      std::sort(faces.begin(), faces.end());
      faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
      // An edge of no face belongs to the whole model.
      if (!wanted && !(faces.empty() && this->Wanted.empty()))
      {
        continue;
      }
      this->send_edge(index, faces);
    }
  }

  void send_edge(int index, const std::vector<std::int64_t>& faces)
  {
    const TopoDS_Edge edge = TopoDS::Edge(this->Edges(index));
    const std::int64_t id = index - 1;
    if (BRep_Tool::Degenerated(edge))
    {
      return; // a pole, which is no curve
    }
    try
    {
      EdgeData data = convert_edge(edge, this->Scale);
      data.id = id;
      data.faces = faces;
      this->send(RecordKind::Edge, packed(data));
    }
    catch (const StreamError&)
    {
      throw;
    }
    catch (...)
    {
      this->send(RecordKind::SkippedEdge, Packer() << id << reason_of(std::current_exception()));
    }
  }

  /// The faces that are wanted, as one shape.
  TopoDS_Shape wanted_shape() const
  {
    BRep_Builder builder;
    TopoDS_Compound compound;
    builder.MakeCompound(compound);
    for (int index = 1; index <= this->Faces.Extent(); ++index)
    {
      if (this->wanted(index))
      {
        builder.Add(compound, this->Faces(index));
      }
    }
    return compound;
  }

  void send_mesh()
  {
    this->send_stage("making the display mesh");
    const double first = kReading + kFaces;
    const Handle(ProgressSender) progress = new ProgressSender(this->Records, first, 1.0 - first);
    triangulate(this->wanted_shape(), this->Options.deflection / this->Scale,
      this->Options.angular_deflection, progress->Start());
    std::int64_t without = 0;
    for (int index = 1; index <= this->Faces.Extent(); ++index)
    {
      if (!this->wanted(index))
      {
        continue;
      }
      FaceMesh mesh = face_mesh(TopoDS::Face(this->Faces(index)), this->Scale);
      mesh.face = index - 1;
      mesh.colour = this->Attributes[static_cast<std::size_t>(index) - 1].colour;
      without += mesh.corners.empty() ? 1 : 0;
      this->send(RecordKind::Mesh, packed(mesh));
    }
    if (without > 0)
    {
      this->send(RecordKind::Warning,
        Packer() << "Open CASCADE made no triangles for " + std::to_string(without) +
            (without == 1 ? " face" : " faces"));
    }
  }

  ReadingOptions Options;
  int Records;
  FaceSelection Wanted;
  FaceSelection LeftOut;
  TopoDS_Shape Shape;
  TopTools_IndexedMapOfShape Faces;
  TopTools_IndexedMapOfShape Edges;
  std::vector<ShapeAttributes> Attributes;
  double Scale = 1.0;
};

} // namespace

void send_model(const ReadingOptions& options, int records)
{
  try
  {
    Sender(options, records).send();
  }
  catch (const StreamError&)
  {
    throw;
  }
  catch (...)
  {
    write_record(records, RecordKind::Error, Packer() << reason_of(std::current_exception()));
  }
}

} // namespace footpoint::cad
