// SPDX-License-Identifier: BSD-3-Clause
#include "ShapeAttributes.h"

#include <NCollection_DataMap.hxx>
#include <TDF_LabelSequence.hxx>
#include <TDataStd_Name.hxx>
#include <TopTools_ShapeMapHasher.hxx>
#include <TopoDS_Iterator.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <XCAFPrs.hxx>
#include <XCAFPrs_IndexedDataMapOfShapeStyle.hxx>

#include <algorithm>

namespace footpoint::cad
{

namespace
{

using Names = NCollection_DataMap<TopoDS_Shape, std::string, TopTools_ShapeMapHasher>;

std::string name_of(const TDF_Label& label)
{
  Handle(TDataStd_Name) attribute;
  if (!label.FindAttribute(TDataStd_Name::GetID(), attribute))
  {
    return {};
  }
  const TCollection_ExtendedString& wide = attribute->Get();
  std::string text(static_cast<std::size_t>(wide.LengthOfCString()) + 1, '\0');
  Standard_PCharacter start = &text[0];
  text.resize(static_cast<std::size_t>(wide.ToUTF8CString(start)));
  // Translators write these where there is none.
  return text == "NONE" || text == "NULL" ? std::string() : text;
}

/// Names of a label's shape and of those below it, each with its location in the whole.
void collect_names(const TDF_Label& label, const TopLoc_Location& location, Names& names)
{
  TDF_Label referred;
  if (XCAFDoc_ShapeTool::GetReferredShape(label, referred))
  {
    const TopLoc_Location inner = location * XCAFDoc_ShapeTool::GetLocation(label);
    collect_names(referred, inner, names);
    return;
  }
  const auto note = [&](const TDF_Label& of)
  {
    const std::string name = name_of(of);
    const TopoDS_Shape shape = XCAFDoc_ShapeTool::GetShape(of);
    if (!name.empty() && !shape.IsNull())
    {
      names.Bind(shape.Located(location * shape.Location()), name);
    }
  };
  note(label);
  TDF_LabelSequence parts;
  XCAFDoc_ShapeTool::GetComponents(label, parts);
  for (TDF_LabelSequence::Iterator part(parts); part.More(); part.Next())
  {
    collect_names(part.Value(), location, names);
  }
  TDF_LabelSequence details;
  XCAFDoc_ShapeTool::GetSubShapes(label, details);
  for (TDF_LabelSequence::Iterator detail(details); detail.More(); detail.Next())
  {
    note(detail.Value());
  }
}

class Walk
{
public:
  Walk(const Names& names, const XCAFPrs_IndexedDataMapOfShapeStyle& styles,
    const TopTools_IndexedMapOfShape& faces, std::vector<ShapeAttributes>& result)
    : NamesOfShapes(names)
    , Styles(styles)
    , Faces(faces)
    , Result(result)
    , Done(result.size(), false)
  {
  }

  void visit(const TopoDS_Shape& shape, ShapeAttributes attributes)
  {
    if (const std::string* name = this->NamesOfShapes.Seek(shape))
    {
      attributes.name = *name;
    }
    const XCAFPrs_Style* style = this->Styles.Seek(shape);
    if (style && style->IsSetColorSurf())
    {
      double red = 0.0;
      double green = 0.0;
      double blue = 0.0;
      style->GetColorSurf().Values(red, green, blue, Quantity_TOC_sRGB);
      attributes.colour = { as_byte(red), as_byte(green), as_byte(blue) };
    }
    if (shape.ShapeType() == TopAbs_FACE)
    {
      const int index = this->Faces.FindIndex(shape);
      if (index > 0 && !this->Done[static_cast<std::size_t>(index) - 1])
      {
        this->Done[static_cast<std::size_t>(index) - 1] = true;
        this->Result[static_cast<std::size_t>(index) - 1] = attributes;
      }
      return;
    }
    for (TopoDS_Iterator part(shape); part.More(); part.Next())
    {
      this->visit(part.Value(), attributes);
    }
  }

private:
  static unsigned char as_byte(double part)
  {
    return static_cast<unsigned char>(255.0 * std::min(1.0, std::max(0.0, part)) + 0.5);
  }

  const Names& NamesOfShapes;
  const XCAFPrs_IndexedDataMapOfShapeStyle& Styles;
  const TopTools_IndexedMapOfShape& Faces;
  std::vector<ShapeAttributes>& Result;
  std::vector<bool> Done;
};

} // namespace

std::vector<ShapeAttributes> face_attributes(const Handle(TDocStd_Document) & document,
  const TopoDS_Shape& shape, const TopTools_IndexedMapOfShape& faces)
{
  std::vector<ShapeAttributes> result(static_cast<std::size_t>(faces.Extent()));
  if (document.IsNull())
  {
    return result;
  }
  Names names;
  XCAFPrs_IndexedDataMapOfShapeStyle styles;
  TDF_LabelSequence labels;
  XCAFDoc_DocumentTool::ShapeTool(document->Main())->GetFreeShapes(labels);
  for (TDF_LabelSequence::Iterator label(labels); label.More(); label.Next())
  {
    collect_names(label.Value(), TopLoc_Location(), names);
    XCAFPrs::CollectStyleSettings(label.Value(), TopLoc_Location(), styles);
  }
  Walk(names, styles, faces, result).visit(shape, {});
  return result;
}

} // namespace footpoint::cad
