// SPDX-License-Identifier: BSD-3-Clause
// Private: the records that the reading process writes and vtkCADReader receives. Both run on one
// machine and come from one build: numbers are sent as they lie in memory.

#ifndef CADStream_h
#define CADStream_h

#include "CADModel.h"

#include <functional>
#include <stdexcept>
#include <string>

namespace footpoint::cad
{

enum class RecordKind : char
{
  Stage = 'G',       ///< text: what begins now
  FaceBegins = 'B',  ///< id: work on this face begins; if the process dies now, this is why
  Progress = 'P',    ///< number in [0, 1]
  Summary = 'H',     ///< ModelSummary
  Face = 'F',        ///< FaceData
  SkippedFace = 'S', ///< id, name, reason
  Edge = 'E',        ///< EdgeData
  SkippedEdge = 'T', ///< id, reason
  Mesh = 'M',        ///< FaceMesh
  Warning = 'W',     ///< text
  Error = 'X',       ///< text; nothing follows
  Done = 'D'         ///< all was sent
};

/// The records do not make sense: a fault of ours, or of the process that wrote them.
class StreamError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// Packs values into bytes.
class Packer
{
public:
  Packer& operator<<(double value);
  Packer& operator<<(std::int64_t value);
  Packer& operator<<(const std::string& value);
  Packer& operator<<(const std::vector<double>& values);
  Packer& operator<<(const std::vector<std::int64_t>& values);
  Packer& operator<<(const std::vector<unsigned char>& values);
  const std::string& bytes() const { return this->Bytes; }

private:
  void append(const void* data, std::size_t size);
  std::string Bytes;
};

/// The inverse. \throw StreamError where there are fewer bytes than are asked for
class Unpacker
{
public:
  explicit Unpacker(const std::string& bytes)
    : Bytes(bytes)
  {
  }
  Unpacker& operator>>(double& value);
  Unpacker& operator>>(std::int64_t& value);
  Unpacker& operator>>(std::string& value);
  Unpacker& operator>>(std::vector<double>& values);
  Unpacker& operator>>(std::vector<std::int64_t>& values);
  Unpacker& operator>>(std::vector<unsigned char>& values);

private:
  const char* take(std::size_t count, std::size_t size);
  const std::string& Bytes;
  std::size_t At = 0;
};

Packer& operator<<(Packer& packer, const CurveData& curve);
Packer& operator<<(Packer& packer, const FaceData& face);
Packer& operator<<(Packer& packer, const EdgeData& edge);
Packer& operator<<(Packer& packer, const FaceMesh& mesh);
Packer& operator<<(Packer& packer, const ModelSummary& summary);
Unpacker& operator>>(Unpacker& unpacker, CurveData& curve);
Unpacker& operator>>(Unpacker& unpacker, FaceData& face);
Unpacker& operator>>(Unpacker& unpacker, EdgeData& edge);
Unpacker& operator>>(Unpacker& unpacker, FaceMesh& mesh);
Unpacker& operator>>(Unpacker& unpacker, ModelSummary& summary);

template <typename Part>
Packer packed(const Part& part)
{
  Packer packer;
  packer << part;
  return packer;
}

/// Writes a record to a file descriptor. \throw StreamError where nobody reads any more
void write_record(int descriptor, RecordKind kind, const Packer& content);

struct Record
{
  RecordKind kind;
  std::string content;
};

/// Puts records together again from bytes as they come.
class RecordAssembly
{
public:
  /// \param on_record is called for every record that these bytes complete
  void add(
    const char* bytes, std::size_t size, const std::function<void(const Record&)>& on_record);

private:
  std::string Pending;
};

} // namespace footpoint::cad

#endif
