// SPDX-License-Identifier: BSD-3-Clause
// Private: CAD files as shapes of Open CASCADE, with what the file says of them.

#ifndef ShapeReading_h
#define ShapeReading_h

#include <Message_ProgressRange.hxx>
#include <TDocStd_Document.hxx>
#include <TopoDS_Shape.hxx>

#include <stdexcept>
#include <string>
#include <vector>

namespace footpoint::cad
{

/// A file that cannot be read; the message says why.
class ReadingError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

struct ReadShape
{
  TopoDS_Shape shape; ///< all of the file, assemblies with their locations; lengths in millimetres
  Handle(TDocStd_Document) document; ///< names and colours; null where the format has none
  std::string unit;                  ///< of the file: "mm", "inch", …
  std::vector<std::string> warnings; ///< what Open CASCADE could not translate
};

/// Reads STEP, IGES or BREP (text or binary), told apart by their content, also compressed by gzip.
/// \throw ReadingError, Standard_Failure
ReadShape read_shape(const std::string& file, const Message_ProgressRange& progress);

/// Collects Open CASCADE's messages, and keeps it from printing them. Call once.
void redirect_messages();

/// The first failures that Open CASCADE has told of since redirect_messages(), on one line.
std::string failure_messages();

} // namespace footpoint::cad

#endif
