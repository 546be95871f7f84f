// SPDX-License-Identifier: BSD-3-Clause
#include "ShapeReading.h"

#include "FileContent.h"
#include "LengthUnits.h"

#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BinTools.hxx>
#include <IGESCAFControl_Reader.hxx>
#include <IGESData_GlobalSection.hxx>
#include <IGESData_IGESModel.hxx>
#include <Interface_Check.hxx>
#include <Interface_CheckIterator.hxx>
#include <Interface_InterfaceModel.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_Printer.hxx>
#include <STEPCAFControl_Controller.hxx>
#include <STEPCAFControl_Reader.hxx>
#include <TColStd_SequenceOfAsciiString.hxx>
#include <TDF_LabelSequence.hxx>
#include <TopoDS_Compound.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>

#include <sstream>

namespace footpoint::cad
{

namespace
{

/// Messages that are kept; the first ones say what is wrong, the rest follows from them.
constexpr std::size_t kMessages = 3;

std::vector<std::string>& kept_messages()
{
  static std::vector<std::string> messages;
  return messages;
}

class Collector : public Message_Printer
{
protected:
  void send(const TCollection_AsciiString& text, const Message_Gravity gravity) const override
  {
    if (gravity >= Message_Alarm && kept_messages().size() < kMessages)
    {
      kept_messages().emplace_back(text.ToCString());
    }
  }
};

std::string with_messages(const std::string& reason)
{
  const std::string messages = failure_messages();
  return messages.empty() ? reason : reason + ": " + messages;
}

void check_status(IFSelect_ReturnStatus status, const std::string& what)
{
  switch (status)
  {
    case IFSelect_RetDone:
      return;
    case IFSelect_RetVoid:
      throw ReadingError(with_messages("there is nothing in this " + what + " file"));
    case IFSelect_RetError:
      throw ReadingError(with_messages("Open CASCADE could not open this " + what + " file"));
    default:
      throw ReadingError(with_messages("Open CASCADE cannot make sense of this " + what + " file"));
  }
}

/// One sentence for all entities of a list that have failed, with the first reason.
void add_failures(const Interface_CheckIterator& list,
  const Handle(Interface_InterfaceModel) & model, const std::string& what,
  std::vector<std::string>& warnings)
{
  Interface_CheckIterator checks = list;
  int count = 0;
  std::string first;
  for (checks.Start(); checks.More(); checks.Next())
  {
    const Handle(Interface_Check)& check = checks.Value();
    if (!check->HasFailed())
    {
      continue;
    }
    if (count++ == 0)
    {
      std::ostringstream text;
      const Handle(Standard_Transient) entity = check->Entity();
      if (!entity.IsNull() && !model.IsNull())
      {
        const Handle(TCollection_HAsciiString) label = model->StringLabel(entity);
        text << (label.IsNull() ? "" : label->ToCString()) << " (" << entity->DynamicType()->Name()
             << "): ";
      }
      text << check->CFail(1);
      first = text.str();
    }
  }
  if (count > 0)
  {
    warnings.push_back("Open CASCADE could not " + what + " " + std::to_string(count) +
      (count == 1 ? " entity of the file: " : " entities of the file; the first: ") + first);
  }
}

Handle(TDocStd_Document) new_document()
{
  Handle(TDocStd_Document) document;
  XCAFApp_Application::GetApplication()->NewDocument("BinXCAF", document);
  return document;
}

/// All free shapes of a document in one.
TopoDS_Shape whole_shape(const Handle(TDocStd_Document) & document)
{
  TDF_LabelSequence labels;
  XCAFDoc_DocumentTool::ShapeTool(document->Main())->GetFreeShapes(labels);
  BRep_Builder builder;
  TopoDS_Compound compound;
  builder.MakeCompound(compound);
  for (TDF_LabelSequence::Iterator label(labels); label.More(); label.Next())
  {
    const TopoDS_Shape shape = XCAFDoc_ShapeTool::GetShape(label.Value());
    if (!shape.IsNull())
    {
      builder.Add(compound, shape);
    }
  }
  return compound;
}

template <typename Reader>
void note_failures(Reader& reader, std::vector<std::string>& warnings)
{
  const Handle(XSControl_WorkSession) session = reader.WS();
  add_failures(session->ModelCheckList(), session->Model(), "interpret", warnings);
  add_failures(session->TransferReader()->LastCheckList(), session->Model(), "translate", warnings);
}

std::string step_unit(STEPControl_Reader& reader, std::vector<std::string>& warnings)
{
  TColStd_SequenceOfAsciiString lengths;
  TColStd_SequenceOfAsciiString angles;
  TColStd_SequenceOfAsciiString solid_angles;
  reader.FileUnits(lengths, angles, solid_angles);
  std::string unit;
  for (const TCollection_AsciiString& length : lengths)
  {
    const std::string name = short_unit_name(length.ToCString());
    if (name.empty())
    {
      warnings.push_back(std::string("the file's unit of length '") + length.ToCString() +
        "' has no short name; lengths are given in mm");
      return "mm";
    }
    if (!unit.empty() && unit != name)
    {
      warnings.push_back(
        "the file has lengths in " + unit + " and in " + name + "; all are given in mm");
      return "mm";
    }
    unit = name;
  }
  return unit.empty() ? "mm" : unit;
}

ReadShape read_step(const FileContent& content, const Message_ProgressRange& progress)
{
  STEPCAFControl_Controller::Init();
  Interface_Static::SetIVal("read.stepcaf.subshapes.name", 1);
  Interface_Static::SetCVal("xstep.cascade.unit", "MM");
  STEPCAFControl_Reader reader;
  reader.SetColorMode(true);
  reader.SetNameMode(true);
  reader.SetLayerMode(false);
  check_status(reader.ReadFile(content.path().c_str()), "STEP");
  ReadShape result;
  result.unit = step_unit(reader.ChangeReader(), result.warnings);
  result.document = new_document();
  if (!reader.Transfer(result.document, progress))
  {
    throw ReadingError(with_messages("Open CASCADE found no shape in this STEP file"));
  }
  note_failures(reader.ChangeReader(), result.warnings);
  result.shape = whole_shape(result.document);
  return result;
}

std::string iges_unit(
  const Handle(Interface_InterfaceModel) & model, std::vector<std::string>& warnings)
{
  const auto iges = Handle(IGESData_IGESModel)::DownCast(model);
  static const char* const names[] = { "", "inch", "mm", "", "ft", "mi", "m", "km", "mil", "um",
    "cm", "uin" };
  const int flag = iges.IsNull() ? 0 : iges->GlobalSection().UnitFlag();
  if (flag >= 1 && flag <= 11 && flag != 3)
  {
    return names[flag];
  }
  const Handle(TCollection_HAsciiString) name =
    iges.IsNull() ? Handle(TCollection_HAsciiString)() : iges->GlobalSection().UnitName();
  const std::string unit = name.IsNull() ? "" : short_unit_name(name->ToCString());
  if (unit.empty())
  {
    warnings.push_back("the file names no unit of length that is known (flag " +
      std::to_string(flag) + "); lengths are given in mm");
  }
  return unit.empty() ? "mm" : unit;
}

ReadShape read_iges(const FileContent& content, const Message_ProgressRange& progress)
{
  IGESCAFControl_Reader reader;
  Interface_Static::SetCVal("xstep.cascade.unit", "MM");
  reader.SetColorMode(true);
  reader.SetNameMode(true);
  reader.SetLayerMode(false);
  check_status(reader.ReadFile(content.path().c_str()), "IGES");
  ReadShape result;
  result.unit = iges_unit(reader.Model(), result.warnings);
  result.document = new_document();
  if (!reader.Transfer(result.document, progress))
  {
    throw ReadingError(with_messages("Open CASCADE found no shape in this IGES file"));
  }
  note_failures(reader, result.warnings);
  result.shape = whole_shape(result.document);
  return result;
}

ReadShape read_brep(const FileContent& content, const Message_ProgressRange& progress)
{
  ReadShape result;
  result.unit = "mm"; // the format has no unit; Open CASCADE counts in millimetres
  const bool done = content.kind() == FileKind::BinaryBrep
    ? BinTools::Read(result.shape, content.path().c_str(), progress)
    : BRepTools::Read(result.shape, content.path().c_str(), BRep_Builder(), progress);
  if (!done || result.shape.IsNull())
  {
    throw ReadingError(with_messages("Open CASCADE found no shape in this BREP file"));
  }
  return result;
}

} // namespace

ReadShape read_shape(const std::string& file, const Message_ProgressRange& progress)
{
  const FileContent content(file);
  switch (content.kind())
  {
    case FileKind::Step:
      return read_step(content, progress);
    case FileKind::Iges:
      return read_iges(content, progress);
    default:
      return read_brep(content, progress);
  }
}

void redirect_messages()
{
  const Handle(Message_Messenger)& messenger = Message::DefaultMessenger();
  messenger->ChangePrinters().Clear();
  messenger->AddPrinter(new Collector);
}

std::string failure_messages()
{
  std::string text;
  for (const std::string& message : kept_messages())
  {
    text += (text.empty() ? "" : "; ") + message;
  }
  for (char& letter : text)
  {
    letter = letter == '\n' || letter == '\r' || letter == '\t' ? ' ' : letter;
  }
  return text;
}

} // namespace footpoint::cad
