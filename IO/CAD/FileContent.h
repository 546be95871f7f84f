// SPDX-License-Identifier: BSD-3-Clause
// Private: what kind of CAD file a file is, and its text where it is compressed.

#ifndef FileContent_h
#define FileContent_h

#include <string>

namespace footpoint::cad
{

enum class FileKind
{
  Step,
  Iges,
  Brep,
  BinaryBrep
};

/// A file by its content, not by its name. Files that gzip has compressed are unpacked into memory.
class FileContent
{
public:
  /// \throw ReadingError where it cannot be opened, is empty or is of no known kind
  explicit FileContent(const std::string& file);
  ~FileContent();
  FileContent(const FileContent&) = delete;
  FileContent& operator=(const FileContent&) = delete;

  FileKind kind() const { return this->Kind; }
  /// A path under which Open CASCADE can read the unpacked content, while this object lives.
  const std::string& path() const { return this->Path; }

private:
  void unpack(const std::string& file);

  FileKind Kind = FileKind::Step;
  std::string Path;
  int Memory = -1; ///< descriptor of the unpacked content
};

} // namespace footpoint::cad

#endif
