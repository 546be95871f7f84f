// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/common/types.h"

#include <array>
#include <vector>

namespace footpoint
{

/// Point and derivatives of a map from N parameters to space.
template <int N>
struct Jet
{
  static constexpr int kSecond = N * (N + 1) / 2;

  Vector3 point;                                  ///< S
  Eigen::Matrix<double, 3, N> first;              ///< columns S_u (, S_v)
  Eigen::Matrix<double, 3, kSecond> second;       ///< columns S_uu (, S_uv, S_vv)
  Eigen::Matrix<double, 3, N == 1 ? 1 : 0> third; ///< curves only: C'''
};

/// A line of constant parameter over which the map is not C1, so that one-sided limits differ.
struct Break
{
  double at; ///< local parameter
  bool gap;  ///< true where not even the point is continuous (multiplicity degree + 1)
};

/// What the solvers have to know about one parametric direction.
struct Direction
{
  double origin = 0.0; ///< parameter in the geometry's own domain = origin + local parameter
  double length = 1.0; ///< local parameters run over [0, length]
  bool closed = false; ///< the ends were found to coincide by evaluating (to kClosureTolerance)
  /// Ascending; the first is 0 and the last `length`, between them the lines that are C0 or gaps.
  std::vector<Break> breaks;
  /// Local parameters of all knot lines, 0 and length included: the map is smooth between two.
  std::vector<double> spans;
  /// The same knot lines in the geometry's own domain; may stay empty, origin + local stands in
  /// then.
  std::vector<double> knots;
  /// The side at the start, at the end of this direction is one point in space (surfaces: a pole).
  std::array<bool, 2> collapsed{ { false, false } };
  double speed = 1.0; ///< root mean square of |S_i| over the domain; tells a stalled from a slow
                      ///< one. 0 where the geometry is a single point
};

/// Two ends count as closed, a side as collapsed, when they agree to this fraction of the size:
/// above the noise of files written with ten digits, below every manufacturing tolerance. The
/// points of a closed geometry are exact all the same, only steps may cross the seam.
constexpr double kClosureTolerance = 1e-9;

/// A curve (N = 1) or surface (N = 2) as the solvers see it, in *local coordinates*: positions are
/// measured from centre(), parameters from the start of the domain. Far from the origin nothing is
/// lost to the subtraction of large numbers.
///
/// Implementations are immutable; all functions are const and thread-safe.
template <int N>
class ParametricGeometry
{
public:
  virtual ~ParametricGeometry() = default;

  /// Point and derivatives.
  /// \param t     local parameters in [0, length]
  /// \param sides which limit is taken on a knot line
  /// \param order highest derivative needed, 0 … 2 (curves 3); higher columns stay undefined
  virtual Jet<N> jet(const Parameter<N>& t, const Sides<N>& sides, int order) const = 0;

  const Direction& direction(int i) const { return this->Directions[i]; }
  /// Diagonal of the bounding box of the control points (of samples where there are none).
  double size() const { return this->Size; }
  /// Origin of the local coordinates: near the centre of the bounding box.
  const Vector3& centre() const { return this->Centre; }

  Vector3 point(const Parameter<N>& t) const
  {
    return this->jet(t, Sides<N>::Constant(Side::Right), 0).point;
  }
  Parameter<N> to_local(const Parameter<N>& parameter) const;
  /// The inverse; knot lines come back as the very numbers the geometry was given.
  Parameter<N> to_domain(const Parameter<N>& local) const;

protected:
  /// Sets centre and size from points in space; returns the points relative to the centre.
  Points recentre(const Points& points);
  /// Finds closure, collapsed sides and speeds by evaluating; spans, breaks and lengths must stand.
  /// \param samples per direction, how many points of a span are compared (2 or more)
  void analyse(const std::array<int, N>& samples = several_samples());

  std::array<Direction, N> Directions;
  Vector3 Centre = Vector3::Zero();
  double Size = 0.0;

private:
  /// For maps of which no degree is known.
  static std::array<int, N> several_samples()
  {
    std::array<int, N> samples;
    samples.fill(9);
    return samples;
  }
};

using ParametricCurve = ParametricGeometry<1>;
using ParametricSurface = ParametricGeometry<2>;

} // namespace footpoint
