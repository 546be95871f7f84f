// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/search/aligned_array.h"

#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace footpoint
{
namespace
{

constexpr std::size_t kCacheLine = 64;
/// A huge page of x86-64, and of ARM with pages of 4 KB.
constexpr std::size_t kHugePage = std::size_t{ 1 } << 21;

#ifdef MADV_HUGEPAGE
constexpr bool kHasHugePages = true;
#else
constexpr bool kHasHugePages = false;
#endif

std::align_val_t alignment_of(std::size_t bytes)
{
  return std::align_val_t{ kHasHugePages && bytes >= kHugePage ? kHugePage : kCacheLine };
}

} // namespace

void* allocate_aligned(std::size_t bytes)
{
  void* memory = ::operator new(bytes, alignment_of(bytes));
#ifdef MADV_HUGEPAGE
  if (bytes >= kHugePage)
  {
    // A wish only, and whole pages only: what lies behind is not ours.
    madvise(memory, bytes / kHugePage * kHugePage, MADV_HUGEPAGE);
  }
#endif
  return memory;
}

void free_aligned(void* memory, std::size_t bytes)
{
  ::operator delete(memory, alignment_of(bytes));
}

} // namespace footpoint
