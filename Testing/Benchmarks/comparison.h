// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "peer.h"
#include "queries.h"
#include "results.h"

#include <iosfwd>

namespace inversion_benchmark
{

struct Settings
{
  int points = 100000; ///< of a class of queries, at most
  double budget = 0.06; ///< seconds of one pass over a class; slow programs get fewer points
  int repeats = 5;     ///< passes, by turns between the programs; the median counts
  bool ours_only = false;
  std::vector<std::string> shapes; ///< names; empty: all
  std::vector<QueryClass> classes; ///< empty: all
};

/// All programs on all shapes and classes of queries; centres and distant points ours alone.
/// \param progress is told what is being measured
Records compare(const Settings& settings, std::ostream& progress);

/// Times a program on points, one query at a time: fills in points and microseconds.
void time_program(Peer& peer, const Points& points, const Settings& settings, Record& record);

} // namespace inversion_benchmark
