// SPDX-License-Identifier: BSD-3-Clause
// Private: names and colours that a CAD file gives to faces, or to the shapes that they are part
// of.

#ifndef ShapeAttributes_h
#define ShapeAttributes_h

#include <TDocStd_Document.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS_Shape.hxx>

#include <string>
#include <vector>

namespace footpoint::cad
{

struct ShapeAttributes
{
  std::string name;                  ///< UTF-8; empty: none
  std::vector<unsigned char> colour; ///< red, green, blue; empty: none
};

/// Attributes of each face: its own, else those of the smallest shape around it that has any
/// (shell, solid, part, assembly). \param faces of `shape`; one entry of the result a face
std::vector<ShapeAttributes> face_attributes(const Handle(TDocStd_Document) & document,
  const TopoDS_Shape& shape, const TopTools_IndexedMapOfShape& faces);

} // namespace footpoint::cad

#endif
