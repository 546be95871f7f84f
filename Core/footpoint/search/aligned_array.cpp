// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/search/aligned_array.h"

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace footpoint
{
namespace
{

constexpr std::size_t kCacheLine = 64;
/// A huge page of x86-64, and of ARM with pages of 4 KB; elsewhere just an alignment.
constexpr std::size_t kHugePage = std::size_t{ 1 } << 21;
/// From so many bytes on the part of a page that is lost at either end is small.
constexpr std::size_t kLarge = 4 * kHugePage;

} // namespace

AlignedMemory::AlignedMemory(std::size_t bytes)
{
  const std::align_val_t alignment{ bytes < kLarge ? kCacheLine : kHugePage };
  this->Data = std::unique_ptr<void, Delete>(
    ::operator new(bytes, alignment), Delete{ alignment });
#ifdef MADV_HUGEPAGE
  if (bytes >= kLarge)
  {
    // A wish only, and whole pages only: what lies behind the array is not ours.
    madvise(this->Data.get(), bytes / kHugePage * kHugePage, MADV_HUGEPAGE);
  }
#endif
}

} // namespace footpoint
