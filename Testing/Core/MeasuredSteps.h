// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// What the measurements of orders and basins share: methods, geometries, bare steps, known feet.

#include "PaperExamples.h"

#include <map>
#include <vector>

namespace measured
{

using namespace footpoint;

const std::map<Method, const char*> kMethodNames = { { Method::Newton, "Newton" },
  { Method::GaussNewton, "GaussNewton" }, { Method::LevenbergMarquardt, "LevenbergMarquardt" },
  { Method::SecondOrder, "SecondOrder" }, { Method::FirstOrder, "FirstOrder" },
  { Method::CurvatureCircle, "CurvatureCircle" }, { Method::SecondOrder1, "SecondOrder1" },
  { Method::SecondOrder2, "SecondOrder2" }, { Method::SecondOrder3, "SecondOrder3" } };

template <int N>
std::vector<Method> methods_for();

// === Geometries

/// Helix-like, of degree 5, with weights between 0.5 and 1.5.
Curve space_curve();

Surface octant();

// === One step

template <int N>
Parameter<N> lengths(const ParametricGeometry<N>& geometry);

/// The bare step of a method.
template <int N>
Parameter<N> bare_step(const ParametricGeometry<N>& geometry, const Vector3& query,
  const Parameter<N>& t, const Step<N>& step);

/// A query whose foot is known.
template <int N>
struct Case
{
  Vector3 query;     ///< local
  Parameter<N> foot; ///< local
};

/// Queries over random places inside knot spans. On the geometry, or so far away that the curvature
/// counts: the eigenvalues of the Hessian in units of the metric lie in [0.3, 3], and one of them
/// is 0.2 or more from 1.
template <int N>
std::vector<Case<N>> random_cases(const ParametricGeometry<N>& geometry, bool on, bool planar);

double median(std::vector<double> values);

} // namespace measured
