// SPDX-License-Identifier: BSD-3-Clause
// Private: the ranks that run a filter together.

#ifndef Ranks_h
#define Ranks_h

#include "footpoint/common/reduction.h"

#include <cstdint>
#include <string>
#include <vector>

class vtkMultiProcessController;

namespace footpoint::conversion
{

/// What the ranks of a controller tell each other. All methods but rank() and count() are
/// collective: every rank calls them, in the same order, also where it has no data or failed.
class Ranks
{
public:
  /// \param controller null: there is one rank
  explicit Ranks(vtkMultiProcessController* controller);

  int rank() const;
  int count() const;

  /// \param own as many numbers on every rank
  /// \return those of all ranks, by rank
  std::vector<std::vector<std::uint64_t>> gather(const std::vector<std::uint64_t>& own) const;

  /// Gives all ranks the bytes of one.
  /// \param bytes on that rank the content, on the others replaced
  void broadcast(std::vector<unsigned char>& bytes, int from) const;

  /// What stops all ranks: "" where none has an error; else the own one or, where there is none,
  /// the first of the others with its rank named.
  std::string first_error(const std::string& own) const;

  /// Outlives neither this object nor the controller.
  Reduction reduction() const;

private:
  vtkMultiProcessController* Controller; ///< null where there is one rank
};

} // namespace footpoint::conversion

#endif
