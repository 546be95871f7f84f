// SPDX-License-Identifier: BSD-3-Clause
// Private: a result that two pipeline requests need, computed once.

#ifndef CachedResult_h
#define CachedResult_h

#include "GeometryHash.h"

#include <optional>
#include <stdexcept>

namespace footpoint::conversion
{

/// The result for the last content asked for, or why there is none.
template <typename Result>
class CachedResult
{
public:
  /// Calls `make` where the content is another than last time.
  template <typename Make>
  void update(const ContentHash& content, const Make& make)
  {
    if (this->Content == content)
    {
      return;
    }
    this->Value.reset();
    this->Error.clear();
    try
    {
      this->Value.emplace(make());
    }
    catch (const std::invalid_argument& error) // BoundaryError, GeometryError
    {
      this->Error = error.what();
    }
    this->Content = content;
  }

  /// Null where it could not be made.
  const Result* value() const { return this->Value ? &*this->Value : nullptr; }
  const std::string& error() const { return this->Error; }

private:
  std::optional<ContentHash> Content;
  std::optional<Result> Value;
  std::string Error;
};

} // namespace footpoint::conversion

#endif
