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
/// The ray of a point runs towards decreasing b. Arcs are half-open in a, so that where two meet
/// one of them counts, and arcs of constant a never count. A point inside the box of an arc is
/// compared with the arc itself, any other with the box alone, so that rounding can change the
/// answer only for points within rounding of an arc.
///
/// Arcs are listed in buckets over a, at the dyadic level where an arc is about as wide as a
/// bucket: at most three entries an arc, and one bucket a level to look at.
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

  const std::array<double, 2>& length() const { return this->Length; }
  const std::array<double, 2>& margin() const { return this->Margin; }

  /// Winding number of a point, the base included. On the borders of the domain it is the limit
  /// from inside. \pre 0 ≤ a ≤ length[0], 0 ≤ b ≤ length[1]
  int winding(double a, double b) const;

  /// Whether an arc passes through a box of (a, b), or too near to tell, or so many are near that
  /// it is not worth the time. Arcs along the border of the domain pass through nothing.
  bool crossed(const std::array<double, 2>& lower, const std::array<double, 2>& upper) const;

  /// Number of arcs; those that no ray can meet are left out.
  std::size_t size() const { return this->Arcs.size(); }
  /// The point (a, b) of an arc at a fraction of it, from small to large a.
  Eigen::Vector2d point(std::size_t arc, double t) const;
  /// Whether it runs along a border of the domain.
  bool on_border(std::size_t arc) const { return this->Arcs[arc].on_border; }

private:
  /// Where an arc matters to rays.
  struct RayBox
  {
    double low_a;
    double high_a; ///< first a that belongs to the next arc; infinite at the end of the domain
    double low_b;  ///< minus infinity along the start of the domain: points there lie above it
    double high_b;
    std::int32_t sign; ///< what a ray that meets it adds
    std::uint32_t arc; ///< number
  };

  /// An arc from small to large a.
  struct Arc
  {
    double low_a;
    double low_b;
    double high_b;
    double width;        ///< of the arc in a
    double height;       ///< of the arc in b, negative where b falls while a grows
    std::uint32_t first; ///< of its coefficients
    std::int16_t degree;
    bool on_border;
  };

  /// 2^k buckets of equal width.
  struct Level
  {
    double buckets_per_length;
    std::uint32_t last;  ///< bucket
    std::uint32_t first; ///< of its numbers in BucketStart
  };

  RayBox add_arc(const IndexedArc& source);
  void fill_buckets(const std::vector<RayBox>& boxes);
  int level_of(const Arc& arc, int levels) const;
  bool is_above(const Arc& arc, double a, double b) const;
  bool passes(
    const Arc& arc, const std::array<double, 2>& lower, const std::array<double, 2>& upper) const;

  std::array<double, 2> Length{ { 1.0, 1.0 } };
  std::array<double, 2> Margin{ { 0.0, 0.0 } };
  int Base = 0;
  std::vector<Arc> Arcs;
  /// Of all curved arcs, C(degree, i)·(w·x, w·y, w) of one control point after the other, x and y
  /// measured from the arc's end of small a.
  std::vector<double> Coefficients;
  std::vector<Level> Levels; ///< those that hold arcs
  std::vector<std::uint32_t> BucketStart;
  std::vector<RayBox> Entries; ///< bucket by bucket, side by side in memory
};

} // namespace footpoint
