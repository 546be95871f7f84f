// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "benchmark_shapes.h"

namespace inversion_benchmark
{

enum class QueryClass
{
  On,      ///< points of the geometry
  Near,    ///< 1e-3 × size off, along the normal (curves: across the tangent)
  Off,     ///< 0.1 × size off
  Far,     ///< anywhere in three times the box of the control points
  Centre,  ///< within 1e-9 … 1e-2 × size of a point that has a continuum of feet
  Core,    ///< within 1e-9 × size of such a point
  Distant, ///< 1e6 × size away
  Ties     ///< within 1e-16 … 1e-6 × size of points with two feet far from each other
};

/// The four that means are taken over.
constexpr std::array<QueryClass, 4> kMainClasses{ { QueryClass::On, QueryClass::Near,
  QueryClass::Off, QueryClass::Far } };

const char* name_of(QueryClass query_class);
/// \throw std::invalid_argument where there is no such class
QueryClass class_of(const std::string& name);
/// Whether the shape may have such points: Centre and Core need a centre.
bool has_class(const Shape& shape, QueryClass query_class);

struct Queries
{
  Points points;
  /// An upper bound of each distance that is known from how the point was made, in long double;
  /// infinite where there is none.
  std::vector<long double> bounds;
};

/// Random points of a class, in random order; none where a shape has no ties.
Queries make_queries(const Shape& shape, QueryClass query_class, int count);

/// Points at a fixed distance from a surface, either side, ordered along a Morton curve of the
/// parameters: what scanned data in blocks is like.
Points ordered_queries(const Shape& shape, double distance, int count);

} // namespace inversion_benchmark
