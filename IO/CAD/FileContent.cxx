// SPDX-License-Identifier: BSD-3-Clause
#include "FileContent.h"

#include "ShapeReading.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#include <vector>
#include <zlib.h>

namespace footpoint::cad
{

namespace
{

/// Bytes at the start by which a file's kind is told.
constexpr std::size_t kHead = 4096;
constexpr std::size_t kChunk = 1 << 16;
/// Unpacked bytes for which there is room; a few bytes of gzip can stand for any number.
constexpr std::size_t kLargestContent = std::size_t(4) << 30;

std::string read_head(const std::string& path)
{
  std::ifstream stream(path, std::ios::binary);
  std::string head(kHead, '\0');
  stream.read(&head[0], static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(stream.gcount()));
  return head;
}

bool contains(const std::string& text, const char* part)
{
  return text.find(part) != std::string::npos;
}

/// IGES: lines of 80 columns, of which the first have an S in column 73.
bool looks_like_iges(const std::string& head)
{
  const std::size_t end = head.find_first_of("\r\n");
  const std::string line = head.substr(0, end);
  return line.size() >= 73 && (line[72] == 'S' || line[72] == 'B' || line[72] == 'C');
}

FileKind kind_of(const std::string& head)
{
  if (contains(head, "ISO-10303-21"))
  {
    return FileKind::Step;
  }
  if (contains(head, "Open CASCADE Topology"))
  {
    return FileKind::BinaryBrep;
  }
  if (contains(head, "CASCADE Topology") || contains(head, "DBRep_DrawableShape"))
  {
    return FileKind::Brep;
  }
  if (looks_like_iges(head))
  {
    return FileKind::Iges;
  }
  throw ReadingError(
    "it is neither STEP (no ISO-10303-21 at its start) nor IGES (no S in column 73 "
    "of its first line) nor BREP (no 'CASCADE Topology' at its start)");
}

} // namespace

FileContent::FileContent(const std::string& file)
  : Path(file)
{
  struct stat status;
  if (::stat(file.c_str(), &status) != 0)
  {
    throw ReadingError(std::string("it cannot be opened: ") + std::strerror(errno));
  }
  if (!S_ISREG(status.st_mode))
  {
    throw ReadingError("it is no file");
  }
  if (::access(file.c_str(), R_OK) != 0)
  {
    throw ReadingError(std::string("it cannot be opened: ") + std::strerror(errno));
  }
  std::string head = read_head(file);
  if (head.size() >= 2 && head[0] == '\x1f' && head[1] == '\x8b')
  {
    this->unpack(file);
    head = read_head(this->Path);
  }
  if (head.empty())
  {
    throw ReadingError("it is empty");
  }
  this->Kind = kind_of(head);
}

FileContent::~FileContent()
{
  if (this->Memory >= 0)
  {
    ::close(this->Memory);
  }
}

void FileContent::unpack(const std::string& file)
{
  this->Memory = ::memfd_create("footpoint", MFD_CLOEXEC);
  if (this->Memory < 0)
  {
    throw ReadingError(std::string("there is no memory to unpack it: ") + std::strerror(errno));
  }
  const gzFile packed = ::gzopen(file.c_str(), "rb");
  std::vector<char> chunk(kChunk);
  std::size_t total = 0;
  std::string problem;
  while (packed && problem.empty())
  {
    const int count = ::gzread(packed, chunk.data(), static_cast<unsigned int>(chunk.size()));
    if (count <= 0)
    {
      int code = Z_OK;
      const char* text = ::gzerror(packed, &code);
      problem = code != Z_OK && code != Z_STREAM_END ? text : "";
      break;
    }
    total += static_cast<std::size_t>(count);
    if (total > kLargestContent)
    {
      problem = "it is larger than 4 GiB when unpacked";
    }
    else if (::write(this->Memory, chunk.data(), static_cast<std::size_t>(count)) != count)
    {
      problem = std::strerror(errno);
    }
  }
  if (packed)
  {
    ::gzclose_r(packed);
  }
  if (!packed || !problem.empty())
  {
    throw ReadingError("it cannot be unpacked: " + (packed ? problem : std::strerror(errno)));
  }
  this->Path = "/proc/self/fd/" + std::to_string(this->Memory);
}

} // namespace footpoint::cad
