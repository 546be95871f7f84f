// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace footpoint
{

/// Memory that starts on a cache line, for vector loads. Its values are not set.
///
/// Large parts ask for huge pages where the system has them (Linux): first touching 90 MB in pages
/// of 4 KB takes 40 ms, and a search that goes from piece to piece misses the address cache.
void* allocate_aligned(std::size_t bytes);
/// \param bytes with which it was allocated
void free_aligned(void* memory, std::size_t bytes);

/// Takes such memory for a container, and leaves numbers that it is not given unset: they are set
/// on several threads later.
template <class T>
struct AlignedAllocator
{
  using value_type = T;

  AlignedAllocator() = default;
  template <class Other>
  AlignedAllocator(const AlignedAllocator<Other>&)
  {
  }

  T* allocate(std::size_t count) { return static_cast<T*>(allocate_aligned(count * sizeof(T))); }
  void deallocate(T* memory, std::size_t count) { free_aligned(memory, count * sizeof(T)); }

  template <class U>
  void construct(U* at)
  {
    ::new (static_cast<void*>(at)) U;
  }
  template <class U, class... Arguments>
  void construct(U* at, Arguments&&... arguments)
  {
    ::new (static_cast<void*>(at)) U(std::forward<Arguments>(arguments)...);
  }

  friend bool operator==(const AlignedAllocator&, const AlignedAllocator&) { return true; }
  friend bool operator!=(const AlignedAllocator&, const AlignedAllocator&) { return false; }
};

template <class T>
using AlignedVector = std::vector<T, AlignedAllocator<T>>;

/// Numbers in such memory, not set either.
template <class T>
class AlignedArray
{
  static_assert(std::is_arithmetic<T>::value, "nothing is constructed");

public:
  AlignedArray() = default;
  explicit AlignedArray(std::size_t count)
    : Numbers(AlignedAllocator<T>().allocate(count), Free{ count })
  {
  }

  T* data() { return this->Numbers.get(); }
  const T* data() const { return this->Numbers.get(); }
  std::size_t size() const { return this->Numbers.get_deleter().count; }

private:
  struct Free
  {
    std::size_t count = 0;
    void operator()(T* numbers) const { AlignedAllocator<T>().deallocate(numbers, this->count); }
  };

  std::unique_ptr<T[], Free> Numbers;
};

} // namespace footpoint
