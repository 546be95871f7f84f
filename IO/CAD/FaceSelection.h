// SPDX-License-Identifier: BSD-3-Clause
// Private: lists of numbers such as "0-3,7".

#ifndef FaceSelection_h
#define FaceSelection_h

#include <cstdint>
#include <set>
#include <string>

namespace footpoint::cad
{

/// Numbers and ranges of numbers, separated by commas or spaces.
/// \throw std::invalid_argument naming the part that is neither
class FaceSelection
{
public:
  explicit FaceSelection(const std::string& text);

  bool empty() const { return this->Ranges.empty(); }
  bool contains(std::int64_t number) const;
  std::int64_t largest() const; ///< −1 where it is empty

private:
  std::set<std::pair<std::int64_t, std::int64_t>> Ranges;
};

} // namespace footpoint::cad

#endif
