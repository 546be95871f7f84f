// SPDX-License-Identifier: BSD-3-Clause
#include "ReplicatedGeometry.h"

#include "DataTree.h"
#include "GeometryMerge.h"
#include "GeometryPacket.h"
#include "ParametricFunctionGeometry.h"
#include "Ranks.h"

#include "footpoint/common/errors.h"

#include "vtkDataObjectTree.h"

#include <algorithm>
#include <exception>

namespace footpoint::conversion
{

namespace
{

enum Kind : std::uint64_t
{
  kNone,
  kSource,
  kFunction
};

/// What a rank tells the others of its geometry.
using State = std::vector<std::uint64_t>;
enum Place : std::size_t
{
  kKind,
  kContent,              ///< 2 words of the hash of what it has
  kParts = kContent + 2, ///< 2 words of the hash of what all had when it kept the result
  kSize = kParts + 2
};

bool same_content(const State& a, const State& b)
{
  return std::equal(a.begin(), a.begin() + kParts, b.begin());
}

State describe(const SourceGeometry& own, const ContentHash& parts)
{
  ContentHash content;
  Kind kind = kNone;
  if (has_points(own.source))
  {
    kind = kSource;
    content.add(own.source);
  }
  else if (own.function)
  {
    kind = kFunction;
    add_function_values(content, own.function);
  }
  return { kind, content.word(0), content.word(1), parts.word(0), parts.word(1) };
}

ContentHash hash_of_parts(const std::vector<State>& states)
{
  ContentHash hash;
  for (const State& state : states)
  {
    std::for_each(
      state.begin(), state.begin() + kParts, [&](std::uint64_t word) { hash.add(word); });
  }
  return hash;
}

/// Single nets that turned out to be different ones: each has to be good, as a single one on one
/// rank has to.
void check_single_nets(
  const std::vector<vtkSmartPointer<vtkDataObject>>& parts, vtkDataObject* merged)
{
  const auto is_tree = [](vtkDataObject* data)
  { return vtkDataObjectTree::SafeDownCast(data) != nullptr; };
  if (!is_tree(merged) || std::any_of(parts.begin(), parts.end(), is_tree))
  {
    return;
  }
  for (std::size_t rank = 0; rank < parts.size(); ++rank)
  {
    if (!parts[rank])
    {
      continue;
    }
    const ConvertedModel converted = convert_to_model(parts[rank], false);
    if (!converted.problems.empty())
    {
      throw GeometryError(GeometryDefect::Format,
        "The source of rank " + std::to_string(rank) +
          ", which differs from others: " + converted.messages().front());
    }
  }
}

} // namespace

SourceGeometry ReplicatedGeometry::update(const SourceGeometry& own, const Ranks& ranks)
{
  if (ranks.count() == 1)
  {
    return own;
  }
  const std::vector<State> states = ranks.gather(describe(own, this->Parts));
  const State& first = states.front();
  const bool equal = std::all_of(
    states.begin(), states.end(), [&](const State& state) { return same_content(state, first); });
  const bool any_source = std::any_of(
    states.begin(), states.end(), [](const State& state) { return state[kKind] == kSource; });
  if (!any_source)
  {
    if (!equal)
    {
      throw GeometryError(GeometryDefect::Format,
        "No rank has a source, and the parametric function is not the same on all ranks.");
    }
    return own;
  }
  if (equal)
  {
    this->Merged = nullptr;
    this->Parts = {};
    return own;
  }
  const ContentHash parts = hash_of_parts(states);
  const bool kept = std::all_of(states.begin(), states.end(),
    [&](const State& state)
    { return state[kParts] == parts.word(0) && state[kParts + 1] == parts.word(1); });
  if (!kept)
  {
    this->Merged = nullptr;
    this->Parts = {};
    this->Merged = this->exchange(own, ranks, states);
    this->Parts = parts;
  }
  return { this->Merged, nullptr, own.flip };
}

vtkSmartPointer<vtkDataObject> ReplicatedGeometry::exchange(
  const SourceGeometry& own, const Ranks& ranks, const std::vector<State>& states) const
{
  // Of ranks with the same content, the first sends it.
  const auto sends = [&](std::size_t rank)
  {
    const auto same = [&](const State& state) { return same_content(state, states[rank]); };
    return states[rank][kKind] == kSource &&
      std::none_of(states.begin(), states.begin() + static_cast<std::ptrdiff_t>(rank), same);
  };
  std::vector<unsigned char> packed;
  std::string error;
  try
  {
    if (sends(static_cast<std::size_t>(ranks.rank())))
    {
      packed = pack_geometry(own.source);
    }
  }
  catch (const std::exception& problem) // no memory
  {
    error = std::string("cannot send the geometry: ") + problem.what();
  }
  error = ranks.first_error(error);
  if (!error.empty())
  {
    throw GeometryError(GeometryDefect::Format, error);
  }
  // All messages first: what fails between them on one rank would leave the others waiting.
  std::vector<std::vector<unsigned char>> bytes(states.size());
  bytes[static_cast<std::size_t>(ranks.rank())].swap(packed);
  for (std::size_t rank = 0; rank < states.size(); ++rank)
  {
    if (sends(rank))
    {
      ranks.broadcast(bytes[rank], static_cast<int>(rank));
    }
  }
  std::vector<vtkSmartPointer<vtkDataObject>> parts(states.size());
  for (std::size_t rank = 0; rank < states.size(); ++rank)
  {
    if (sends(rank))
    {
      parts[rank] = unpack_geometry(bytes[rank]);
      std::vector<unsigned char>().swap(bytes[rank]);
    }
  }
  vtkSmartPointer<vtkDataObject> merged = merge_geometry(parts);
  check_single_nets(parts, merged);
  return merged;
}

} // namespace footpoint::conversion
