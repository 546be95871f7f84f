// SPDX-License-Identifier: BSD-3-Clause
#include "CADStream.h"

#include <cerrno>
#include <cstring>
#include <unistd.h>

namespace footpoint::cad
{

namespace
{

/// kind and length of the content
constexpr std::size_t kHeader = 1 + sizeof(std::uint64_t);

void write_all(int descriptor, const char* bytes, std::size_t size)
{
  while (size > 0)
  {
    const ssize_t written = ::write(descriptor, bytes, size);
    if (written < 0 && errno == EINTR)
    {
      continue;
    }
    if (written <= 0)
    {
      throw StreamError(std::string("the receiver is gone: ") + std::strerror(errno));
    }
    bytes += written;
    size -= static_cast<std::size_t>(written);
  }
}

} // namespace

// === Packing

void Packer::append(const void* data, std::size_t size)
{
  this->Bytes.append(static_cast<const char*>(data), size);
}

Packer& Packer::operator<<(double value)
{
  this->append(&value, sizeof value);
  return *this;
}

Packer& Packer::operator<<(std::int64_t value)
{
  this->append(&value, sizeof value);
  return *this;
}

Packer& Packer::operator<<(const std::string& value)
{
  *this << static_cast<std::int64_t>(value.size());
  this->append(value.data(), value.size());
  return *this;
}

Packer& Packer::operator<<(const std::vector<double>& values)
{
  *this << static_cast<std::int64_t>(values.size());
  this->append(values.data(), values.size() * sizeof(double));
  return *this;
}

Packer& Packer::operator<<(const std::vector<std::int64_t>& values)
{
  *this << static_cast<std::int64_t>(values.size());
  this->append(values.data(), values.size() * sizeof(std::int64_t));
  return *this;
}

Packer& Packer::operator<<(const std::vector<unsigned char>& values)
{
  *this << static_cast<std::int64_t>(values.size());
  this->append(values.data(), values.size());
  return *this;
}

// === Unpacking

const char* Unpacker::take(std::size_t count, std::size_t size)
{
  const std::size_t left = this->Bytes.size() - this->At;
  if (count > left / size)
  {
    throw StreamError("a record ends early");
  }
  const char* start = this->Bytes.data() + this->At;
  this->At += count * size;
  return start;
}

Unpacker& Unpacker::operator>>(double& value)
{
  std::memcpy(&value, this->take(1, sizeof value), sizeof value);
  return *this;
}

Unpacker& Unpacker::operator>>(std::int64_t& value)
{
  std::memcpy(&value, this->take(1, sizeof value), sizeof value);
  return *this;
}

Unpacker& Unpacker::operator>>(std::string& value)
{
  std::int64_t size = 0;
  *this >> size;
  value.assign(this->take(static_cast<std::size_t>(size), 1), static_cast<std::size_t>(size));
  return *this;
}

namespace
{

template <typename T>
void copy_values(const char* start, std::int64_t count, std::vector<T>& values)
{
  values.resize(static_cast<std::size_t>(count));
  if (count > 0)
  {
    std::memcpy(values.data(), start, values.size() * sizeof(T));
  }
}

} // namespace

Unpacker& Unpacker::operator>>(std::vector<double>& values)
{
  std::int64_t size = 0;
  *this >> size;
  copy_values(this->take(static_cast<std::size_t>(size), sizeof(double)), size, values);
  return *this;
}

Unpacker& Unpacker::operator>>(std::vector<std::int64_t>& values)
{
  std::int64_t size = 0;
  *this >> size;
  copy_values(this->take(static_cast<std::size_t>(size), sizeof(std::int64_t)), size, values);
  return *this;
}

Unpacker& Unpacker::operator>>(std::vector<unsigned char>& values)
{
  std::int64_t size = 0;
  *this >> size;
  copy_values(this->take(static_cast<std::size_t>(size), 1), size, values);
  return *this;
}

// === Parts of a model

namespace
{

Unpacker& operator>>(Unpacker& unpacker, int& value)
{
  std::int64_t wide = 0;
  unpacker >> wide;
  value = static_cast<int>(wide);
  return unpacker;
}

Packer& operator<<(Packer& packer, int value)
{
  return packer << static_cast<std::int64_t>(value);
}

template <typename T>
void unpack_list(Unpacker& unpacker, std::vector<T>& list)
{
  std::int64_t size = 0;
  unpacker >> size;
  list.clear();
  for (std::int64_t i = 0; i < size; ++i)
  {
    unpacker >> list.emplace_back();
  }
}

} // namespace

Packer& operator<<(Packer& packer, const CurveData& curve)
{
  return packer << curve.degree << curve.knots << curve.points << curve.weights;
}

Unpacker& operator>>(Unpacker& unpacker, CurveData& curve)
{
  return unpacker >> curve.degree >> curve.knots >> curve.points >> curve.weights;
}

Packer& operator<<(Packer& packer, const FaceData& face)
{
  packer << face.id << face.name << face.orientation << face.tolerance;
  const SurfaceData& surface = face.surface;
  for (int direction = 0; direction < 2; ++direction)
  {
    packer << surface.degree[direction] << surface.size[direction] << surface.knots[direction];
  }
  packer << surface.points << surface.weights << static_cast<std::int64_t>(face.loops.size());
  for (const std::vector<CurveData>& loop : face.loops)
  {
    packer << static_cast<std::int64_t>(loop.size());
    for (const CurveData& curve : loop)
    {
      packer << curve;
    }
  }
  return packer;
}

Unpacker& operator>>(Unpacker& unpacker, FaceData& face)
{
  unpacker >> face.id >> face.name >> face.orientation >> face.tolerance;
  SurfaceData& surface = face.surface;
  for (int direction = 0; direction < 2; ++direction)
  {
    unpacker >> surface.degree[direction] >> surface.size[direction] >> surface.knots[direction];
  }
  unpacker >> surface.points >> surface.weights;
  std::int64_t loops = 0;
  unpacker >> loops;
  face.loops.clear();
  for (std::int64_t i = 0; i < loops; ++i)
  {
    unpack_list(unpacker, face.loops.emplace_back());
  }
  return unpacker;
}

Packer& operator<<(Packer& packer, const EdgeData& edge)
{
  return packer << edge.id << edge.tolerance << edge.faces << edge.curve;
}

Unpacker& operator>>(Unpacker& unpacker, EdgeData& edge)
{
  return unpacker >> edge.id >> edge.tolerance >> edge.faces >> edge.curve;
}

Packer& operator<<(Packer& packer, const FaceMesh& mesh)
{
  return packer << mesh.face << mesh.points << mesh.normals << mesh.corners << mesh.colour;
}

Unpacker& operator>>(Unpacker& unpacker, FaceMesh& mesh)
{
  return unpacker >> mesh.face >> mesh.points >> mesh.normals >> mesh.corners >> mesh.colour;
}

Packer& operator<<(Packer& packer, const ModelSummary& summary)
{
  return packer << summary.number_of_faces << summary.number_of_edges << summary.unit;
}

Unpacker& operator>>(Unpacker& unpacker, ModelSummary& summary)
{
  return unpacker >> summary.number_of_faces >> summary.number_of_edges >> summary.unit;
}

// === Records

void write_record(int descriptor, RecordKind kind, const Packer& content)
{
  std::string header(1, static_cast<char>(kind));
  const std::uint64_t size = content.bytes().size();
  header.append(reinterpret_cast<const char*>(&size), sizeof size);
  write_all(descriptor, header.data(), header.size());
  write_all(descriptor, content.bytes().data(), content.bytes().size());
}

void RecordAssembly::add(
  const char* bytes, std::size_t size, const std::function<void(const Record&)>& on_record)
{
  this->Pending.append(bytes, size);
  std::size_t at = 0;
  while (this->Pending.size() - at >= kHeader)
  {
    std::uint64_t length = 0;
    std::memcpy(&length, this->Pending.data() + at + 1, sizeof length);
    if (this->Pending.size() - at - kHeader < length)
    {
      break;
    }
    const Record record{ static_cast<RecordKind>(this->Pending[at]),
      this->Pending.substr(at + kHeader, length) };
    at += kHeader + length;
    on_record(record);
  }
  this->Pending.erase(0, at);
}

} // namespace footpoint::cad
