// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>

namespace footpoint
{

/// Memory that starts on a cache line, for vector loads. Its values are not set.
///
/// Large arrays ask for huge pages where the system has them (Linux): first touching 90 MB in pages
/// of 4 KB takes 40 ms, and a search that goes from piece to piece misses the address cache.
class AlignedMemory
{
public:
  AlignedMemory() = default;
  explicit AlignedMemory(std::size_t bytes);

  void* data() const { return this->Data.get(); }

private:
  struct Delete
  {
    std::align_val_t alignment; ///< with which it was allocated
    void operator()(void* data) const { ::operator delete(data, this->alignment); }
  };

  std::unique_ptr<void, Delete> Data;
};

/// Numbers in such memory.
template <class T>
class AlignedArray
{
  static_assert(std::is_arithmetic<T>::value, "nothing is constructed");

public:
  AlignedArray() = default;
  explicit AlignedArray(std::size_t count)
    : Memory(count * sizeof(T))
    , Count(count)
  {
  }

  T* data() { return static_cast<T*>(this->Memory.data()); }
  const T* data() const { return static_cast<const T*>(this->Memory.data()); }
  std::size_t size() const { return this->Count; }

private:
  AlignedMemory Memory;
  std::size_t Count = 0;
};

} // namespace footpoint
