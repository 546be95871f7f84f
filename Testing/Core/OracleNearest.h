// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Nearest points by brute force, sharing no line with the core: dense samples of every span, made
/// once per geometry, and a damped Newton iteration in the span's box from all samples that can
/// still win. It proves nothing; its distance is one that the geometry has, and very often the
/// least.

#include "Oracle.h"

#include <array>
#include <limits>
#include <memory>

namespace oracle
{

/// A nearest point: distance, parameters in the spline's own domain, place.
template <int N>
struct Foot
{
  Real distance = std::numeric_limits<Real>::infinity();
  std::array<Real, N> parameter{};
  Vector point = Vector::Zero();
};

/// Nearest points on a spline. Spans are closed boxes of their own, so that boundaries, seams,
/// kinks and gaps need no special care. Distances are good to about 1e-15 of the size.
template <int N>
class Nearest
{
public:
  /// \param samples least number per span and direction; 0: what suits the degree
  explicit Nearest(const Spline<N>& geometry, int samples = 0);

  const Spline<N>& spline() const;

  Foot<N> operator()(const Vector& query) const;

private:
  class Samples;
  std::shared_ptr<const Samples> Made; ///< by all copies in common
};

} // namespace oracle
