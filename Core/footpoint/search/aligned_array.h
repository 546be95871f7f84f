// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <new>

namespace footpoint
{

/// Numbers that start on a cache line, for vector loads. Their values are not set.
class AlignedArray
{
public:
  AlignedArray() = default;
  explicit AlignedArray(std::size_t count)
    : Data(static_cast<double*>(::operator new(count * sizeof(double), kAlignment)))
    , Count(count)
  {
  }

  double* data() { return this->Data.get(); }
  const double* data() const { return this->Data.get(); }
  std::size_t size() const { return this->Count; }

private:
  static constexpr std::align_val_t kAlignment{ 64 };

  struct Delete
  {
    void operator()(double* data) const { ::operator delete(data, kAlignment); }
  };

  std::unique_ptr<double, Delete> Data;
  std::size_t Count = 0;
};

} // namespace footpoint
