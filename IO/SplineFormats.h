// SPDX-License-Identifier: BSD-3-Clause
// Private: the formats of spline files by number and by extension.

#ifndef SplineFormats_h
#define SplineFormats_h

#include "SplineFile.h"

#include <string>

namespace footpoint::files
{

/// The numbers are those of vtkSplineReader::FormatEnum.
enum class Format
{
  Auto = 0, ///< by the extension of the file
  GPlusSmo = 1,
  GoTools = 2,
  Geomdl = 3
};

/// Name of a format without spaces.
const char* format_name(Format format);

/// \throw FileError without the path in its message, also where there is no spline
SplineFile read_spline_file(const std::string& path, Format format);

/// Writes a file, or nothing where the format cannot hold what makes the geometry.
/// \return what is left out, a sentence each \throw FileError without the path in its message
std::vector<std::string> write_spline_file(
  const std::string& path, Format format, const std::vector<Spline>& splines);

} // namespace footpoint::files

#endif
