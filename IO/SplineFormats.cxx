// SPDX-License-Identifier: BSD-3-Clause
#include "SplineFormats.h"

#include "GPlusSmoFormat.h"
#include "GeomdlFormat.h"
#include "GoToolsFormat.h"

#include "vtksys/FStream.hxx"
#include "vtksys/SystemTools.hxx"

#include <sstream>

namespace footpoint::files
{

namespace
{

/// The whole content of a file.
std::string read_bytes(const std::string& path)
{
  if (vtksys::SystemTools::FileIsDirectory(path))
  {
    throw FileError("it is a folder");
  }
  vtksys::ifstream stream(path.c_str(), std::ios::binary);
  std::ostringstream bytes;
  // Copying nothing counts as a failure, so an empty file is told apart.
  if (!stream || !(stream.peek() == std::char_traits<char>::eof() || bytes << stream.rdbuf()))
  {
    throw FileError("it cannot be opened and read");
  }
  return bytes.str();
}

Format known_format(const std::string& path, Format format)
{
  if (format != Format::Auto)
  {
    return format;
  }
  const std::string extension =
    vtksys::SystemTools::LowerCase(vtksys::SystemTools::GetFilenameLastExtension(path));
  if (extension == ".xml")
  {
    return Format::GPlusSmo;
  }
  if (extension == ".g2")
  {
    return Format::GoTools;
  }
  if (extension == ".json")
  {
    return Format::Geomdl;
  }
  throw FileError("the extension '" + extension +
    "' is that of no format; known are .xml (G+Smo), .g2 (GoTools) and .json (geomdl)");
}

} // namespace

const char* format_name(Format format)
{
  static const char* const kNames[] = { "Auto", "GPlusSmo", "GoTools", "Geomdl" };
  return kNames[static_cast<int>(format)];
}

SplineFile read_spline_file(const std::string& path, Format format)
{
  const std::string bytes = read_bytes(path);
  SplineFile file;
  switch (known_format(path, format))
  {
    case Format::GPlusSmo:
      file = read_g_plus_smo(bytes);
      break;
    case Format::GoTools:
      file = read_go_tools(bytes);
      break;
    default:
      file = read_geomdl(bytes);
      break;
  }
  if (file.splines.empty())
  {
    throw FileError(
      file.warnings.empty() ? "it has no spline" : "it has no spline; " + file.warnings.front());
  }
  return file;
}

std::vector<std::string> write_spline_file(
  const std::string& path, Format format, const std::vector<Spline>& splines)
{
  std::vector<std::string> warnings;
  std::string bytes;
  switch (known_format(path, format))
  {
    case Format::GPlusSmo:
      bytes = write_g_plus_smo(splines);
      break;
    case Format::GoTools:
      bytes = write_go_tools(splines, warnings);
      break;
    default:
      bytes = write_geomdl(splines);
      break;
  }
  vtksys::ofstream stream(path.c_str(), std::ios::binary);
  stream << bytes;
  stream.close();
  if (!stream)
  {
    throw FileError("it cannot be written");
  }
  return warnings;
}

} // namespace footpoint::files
