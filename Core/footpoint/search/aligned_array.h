// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <new>

namespace footpoint
{

/// Numbers that start on a cache line, for vector loads. Their values are not set.
///
/// Large arrays ask for huge pages where the system has them (Linux): first touching 90 MB in pages
/// of 4 KB takes 40 ms, and a search that goes from piece to piece misses the address cache.
class AlignedArray
{
public:
  AlignedArray() = default;
  explicit AlignedArray(std::size_t count);

  double* data() { return this->Data.get(); }
  const double* data() const { return this->Data.get(); }
  std::size_t size() const { return this->Count; }

private:
  struct Delete
  {
    std::align_val_t alignment; ///< with which it was allocated
    void operator()(double* data) const { ::operator delete(data, this->alignment); }
  };

  std::unique_ptr<double, Delete> Data;
  std::size_t Count = 0;
};

} // namespace footpoint
