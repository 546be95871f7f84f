// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Random geometry and random queries at which searches for nearest points go wrong. Uses the
/// oracle's evaluation alone, nothing of the core's.

#include "OracleNearest.h"
#include "Shapes.h"

#include <string>
#include <vector>

namespace fuzz
{

using footpoint::Vector3;
using oracle::Real;
using oracle::Vector;
using shapes::Random;

template <int N>
struct Geometry
{
  shapes::Arrays<N> arrays;
  std::string description;
};

/// One of several words, for descriptions and choices in one.
std::string pick(Random& random, const std::vector<std::string>& words);

bool one_in(Random& random, int n);

template <int N>
Geometry<N> random_geometry(Random& random);

// === Queries

/// The judge of one geometry, in coordinates relative to a point near it: far from the origin
/// nothing is lost.
template <int N>
struct Judge
{
  explicit Judge(const shapes::Arrays<N>& arrays);

  Vector to_local(const Vector3& point) const;
  Vector3 to_model(const Vector& local) const;

  Vector3 origin;
  oracle::Nearest<N> nearest;
  double size; ///< diagonal of the box of the control points
};

struct Query
{
  std::string kind;
  Vector3 point;
};

/// A query of a kind, or of any.
template <int N>
Query random_query(Random& random, const Judge<N>& judge, std::string kind = "");

} // namespace fuzz
