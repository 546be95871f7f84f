// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace footpoint
{

/// A monotone arc as the index takes it.
struct IndexedArc
{
  Eigen::Matrix<double, 3, Eigen::Dynamic> control; ///< (w·a, w·b, w)
  std::array<Eigen::Vector2d, 2> end;               ///< (a, b) of start and end
  int sign; ///< what a ray from above adds to the winding number where a increases along the arc
};

/// Counts the crossings of rays with closed chains of monotone arcs.
///
/// The ray of a point runs towards decreasing b. Arcs are half-open in a, so that where two meet one
/// of them counts, and arcs of constant a never count.
class WindingIndex
{
public:
  WindingIndex() = default;

  /// \param arcs   in the plane of (a, b)
  /// \param length a of points runs over [0, length[0]], b over [0, length[1]]
  /// \param margin per direction, how near to an arc a box counts as crossed
  /// \param base   winding number where no arc lies below
  WindingIndex(const std::vector<IndexedArc>& arcs, const std::array<double, 2>& length,
    const std::array<double, 2>& margin, int base);

  /// Winding number of a point, the base included. On the borders of the domain it is the limit from
  /// inside.
  int winding(double a, double b) const;

  /// Whether an arc passes through a box of (a, b), or too near to tell.
  bool crossed(const std::array<double, 2>& lower, const std::array<double, 2>& upper) const;

private:
  /// An arc from small to large a.
  struct Arc
  {
    double low_a;
    double high_a; ///< first a that belongs to the next arc; infinite at the end of the domain
    double low_b;  ///< minus infinity along the start of the domain: points there lie above it
    double high_b;
    double width;   ///< of the arc in a; 0: of constant a
    double height;  ///< of the arc in b, negative where b falls while a grows
    std::int32_t sign;
    std::int32_t degree;
    std::uint32_t first; ///< of its coefficients
  };

  bool is_above(const Arc& arc, double a, double b) const;

  std::array<double, 2> Length{ { 1.0, 1.0 } };
  std::array<double, 2> Margin{ { 0.0, 0.0 } };
  int Base = 0;
  std::vector<Arc> Arcs;
  /// Of all curved arcs, C(degree, i)·(w·x, w·y, w) of one control point after the other, x and y
  /// measured from the arc's end of small a.
  std::vector<double> Coefficients;
};

} // namespace footpoint
