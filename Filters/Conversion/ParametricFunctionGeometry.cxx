// SPDX-License-Identifier: BSD-3-Clause
#include "ParametricFunctionGeometry.h"

#include "GeometryHash.h"

#include "footpoint/common/errors.h"

#include "vtkParametricFunction.h"
#include "vtkVariant.h"

#include <algorithm>
#include <cmath>

namespace footpoint::conversion
{

namespace
{

/// Samples per direction from which size, centre, closure and collapsed sides are found.
constexpr int kSizeSamples = 33;

/// Spacing of the five points of a difference formula as a fraction of the domain: the truncation
/// of the first derivative (h^4) and its rounding (1e-16 / h) are both below 1e-12.
constexpr double kSpacing = 1e-3;

/// The same for the three points a direction of the mixed derivative: truncation h^2 against
/// rounding 1e-16 / h^2.
constexpr double kMixedSpacing = 1e-4;

/// Weights by which values at `Count` equally spaced places give the value and the derivatives at
/// t.
template <int Count>
struct Stencil
{
  double start;
  double spacing;
  /// Row k: weights of the k-th derivative.
  Eigen::Matrix<double, 4, Count> weights;

  double place(int i) const { return this->start + i * this->spacing; }
};

/// B. Fornberg (1988), Generation of finite difference formulas on arbitrarily spaced grids.
/// The places are centred on t, but shifted into [0, length].
template <int Count>
Stencil<Count> make_stencil(double t, double length, double relative_spacing)
{
  Stencil<Count> stencil;
  stencil.spacing = relative_spacing * length;
  const double reach = (Count - 1) * stencil.spacing;
  stencil.start = std::clamp(t - 0.5 * reach, 0.0, length - reach);

  Eigen::Matrix<double, 4, Count>& weights = stencil.weights;
  weights.setZero();
  weights(0, 0) = 1.0;
  double product = 1.0;
  for (int i = 1; i < Count; ++i)
  {
    double next_product = 1.0;
    const double to_last = stencil.place(i - 1) - t;
    for (int j = 0; j < i; ++j)
    {
      const double gap = (i - j) * stencil.spacing;
      next_product *= gap;
      if (j == i - 1)
      {
        for (int k = std::min(i, 3); k >= 1; --k)
        {
          weights(k, i) =
            product * (k * weights(k - 1, i - 1) - to_last * weights(k, i - 1)) / next_product;
        }
        weights(0, i) = -product * to_last * weights(0, i - 1) / next_product;
      }
      const double here = stencil.place(i) - t;
      for (int k = std::min(i, 3); k >= 1; --k)
      {
        weights(k, j) = (here * weights(k, j) - k * weights(k - 1, j)) / gap;
      }
      weights(0, j) = here * weights(0, j) / gap;
    }
    product = next_product;
  }
  return stencil;
}

std::array<double, 4> domain_of(vtkParametricFunction* function)
{
  return { { function->GetMinimumU(), function->GetMaximumU(), function->GetMinimumV(),
    function->GetMaximumV() } };
}

} // namespace

template <int N>
ParametricFunctionGeometry<N>::ParametricFunctionGeometry(vtkParametricFunction* function)
  : Function(function)
{
  const std::array<double, 4> domain = domain_of(function);
  for (int i = 0; i < N; ++i)
  {
    Direction& direction = this->Directions[i];
    direction.origin = domain[2 * i];
    direction.length = domain[2 * i + 1] - domain[2 * i];
    if (!(direction.length > 0.0) || !std::isfinite(direction.length))
    {
      throw GeometryError(GeometryDefect::EmptyDomain,
        std::string("The parametric function has the domain from ") +
          vtkVariant(domain[2 * i]).ToString() + " to " + vtkVariant(domain[2 * i + 1]).ToString() +
          " in " + (i == 0 ? "u" : "v"));
    }
    direction.breaks = { Break{ 0.0, false }, Break{ direction.length, false } };
    direction.spans = { 0.0, direction.length };
  }

  const int rows = N == 2 ? kSizeSamples : 1;
  Points samples(3, kSizeSamples * rows);
  for (int i = 0; i < samples.cols(); ++i)
  {
    Parameter<N> local;
    const std::array<int, 2> at{ { i % kSizeSamples, i / kSizeSamples } };
    for (int k = 0; k < N; ++k)
    {
      local[k] = this->Directions[k].length * at[k] / (kSizeSamples - 1);
    }
    samples.col(i) = this->evaluate(local);
    if (!samples.col(i).allFinite())
    {
      throw GeometryError(GeometryDefect::NotFinite,
        "The parametric function is not finite at u = " +
          vtkVariant(this->to_domain(local)[0]).ToString() +
          (N == 2 ? ", v = " + std::string(vtkVariant(this->to_domain(local)[N - 1]).ToString())
                  : std::string()));
    }
  }
  this->recentre(samples);
  std::array<int, N> across;
  across.fill(kSizeSamples);
  this->analyse(across);
}

template <int N>
Vector3 ParametricFunctionGeometry<N>::evaluate(const Parameter<N>& local) const
{
  const Parameter<N> own = this->to_domain(local);
  double parameters[3] = { own[0], N == 2 ? own[N - 1] : 0.0, 0.0 };
  double derivatives[9] = {};
  Vector3 point = Vector3::Zero();
  this->Function->Evaluate(parameters, point.data(), derivatives);
  return point - this->Centre;
}

template <>
Jet<1> ParametricFunctionGeometry<1>::jet(const Parameter<1>& t, const Sides<1>&, int order) const
{
  Jet<1> jet;
  jet.point = this->evaluate(t);
  if (order > 0)
  {
    const auto stencil = make_stencil<5>(t[0], this->Directions[0].length, kSpacing);
    Eigen::Matrix<double, 3, 5> values;
    for (int i = 0; i < 5; ++i)
    {
      values.col(i) = this->evaluate(Parameter<1>(stencil.place(i)));
    }
    const Eigen::Matrix<double, 3, 4> derivatives = values * stencil.weights.transpose();
    jet.first = derivatives.col(1);
    jet.second = derivatives.col(2);
    jet.third = derivatives.col(3);
  }
  return jet;
}

template <>
Jet<2> ParametricFunctionGeometry<2>::jet(const Parameter<2>& t, const Sides<2>&, int order) const
{
  Jet<2> jet;
  jet.point = this->evaluate(t);
  if (order == 0)
  {
    return jet;
  }
  for (int direction = 0; direction < 2; ++direction)
  {
    const auto stencil =
      make_stencil<5>(t[direction], this->Directions[direction].length, kSpacing);
    Eigen::Matrix<double, 3, 5> values;
    for (int i = 0; i < 5; ++i)
    {
      Parameter<2> place = t;
      place[direction] = stencil.place(i);
      values.col(i) = this->evaluate(place);
    }
    const Eigen::Matrix<double, 3, 4> derivatives = values * stencil.weights.transpose();
    jet.first.col(direction) = derivatives.col(1);
    jet.second.col(2 * direction) = derivatives.col(2);
  }
  if (order > 1)
  {
    const auto along_u = make_stencil<3>(t[0], this->Directions[0].length, kMixedSpacing);
    const auto along_v = make_stencil<3>(t[1], this->Directions[1].length, kMixedSpacing);
    Vector3 mixed = Vector3::Zero();
    for (int j = 0; j < 3; ++j)
    {
      for (int i = 0; i < 3; ++i)
      {
        mixed += along_u.weights(1, i) * along_v.weights(1, j) *
          this->evaluate(Parameter<2>(along_u.place(i), along_v.place(j)));
      }
    }
    jet.second.col(1) = mixed;
  }
  return jet;
}

Model convert_parametric_function(vtkParametricFunction* function, bool flip)
{
  Face face;
  face.name = function->GetClassName();
  face.reversed = flip;
  Patch patch;
  switch (function->GetDimension())
  {
    case 1:
      patch.curve = std::make_shared<ParametricFunctionGeometry<1>>(function);
      break;
    case 2:
      patch.surface = std::make_shared<ParametricFunctionGeometry<2>>(function);
      break;
    default:
      throw GeometryError(GeometryDefect::Format,
        "The parametric function has dimension " + std::to_string(function->GetDimension()) +
          "; 1 (a curve) and 2 (a surface) are geometry");
  }
  face.patches.push_back(std::move(patch));
  return { std::move(face) };
}

void add_function_values(ContentHash& hash, vtkParametricFunction* function)
{
  constexpr int kSamples = 5; // in each direction
  hash.add(std::string(function->GetClassName()));
  const double low[] = { function->GetMinimumU(), function->GetMinimumV() };
  const double high[] = { function->GetMaximumU(), function->GetMaximumV() };
  for (int j = 0; j < (function->GetDimension() > 1 ? kSamples : 1); ++j)
  {
    for (int i = 0; i < kSamples; ++i)
    {
      const double places[] = { i / (kSamples - 1.0), j / (kSamples - 1.0) };
      double parameters[] = { 0.0, 0.0, 0.0 };
      for (int d = 0; d < 2; ++d)
      {
        parameters[d] = low[d] + places[d] * (high[d] - low[d]);
        hash.add(parameters[d]);
      }
      double point[3] = { 0.0, 0.0, 0.0 };
      double derivatives[9] = { 0.0 };
      function->Evaluate(parameters, point, derivatives);
      for (const double coordinate : point)
      {
        hash.add(coordinate);
      }
    }
  }
}

} // namespace footpoint::conversion
