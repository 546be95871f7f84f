// SPDX-License-Identifier: BSD-3-Clause
// Private: fingerprints of the content of data, by which search structures are kept.

#ifndef GeometryHash_h
#define GeometryHash_h

#include <cstddef>
#include <cstdint>
#include <string>

class vtkAbstractArray;
class vtkDataObject;

namespace footpoint::conversion
{

/// 128 bits that stand for the content that was added, in its order. Two multiplicative hashes with
/// xor-shifts between words (finalizer of MurmurHash3, A. Appleby 2011); not against attackers.
class ContentHash
{
public:
  void add(std::uint64_t word);
  void add(double value);
  void add(const std::string& text);
  void add_bytes(const void* bytes, std::size_t count);
  /// Name-free: type, shape and values; a null pointer counts too.
  void add(vtkAbstractArray* array);
  /// Everything of a data object that convert_to_model reads, never modification times.
  void add(vtkDataObject* geometry);

  /// \param number 0 or 1: each half of the bits
  std::uint64_t word(int number) const { return number == 0 ? this->A : this->B; }
  bool operator==(const ContentHash& other) const
  {
    return this->A == other.A && this->B == other.B;
  }
  bool operator!=(const ContentHash& other) const { return !(*this == other); }

private:
  std::uint64_t A = 0x9e3779b97f4a7c15u;
  std::uint64_t B = 0xc2b2ae3d27d4eb4fu;
};

} // namespace footpoint::conversion

#endif
