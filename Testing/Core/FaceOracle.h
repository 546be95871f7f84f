// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// The nearest point of a trimmed face by brute force, sharing no code with the search: dense
/// samples of what the loops keep and of the loops themselves, then descents in long double from
/// the best of them. What it finds is a point of the face, so no foot may be farther.

#include "LoopOracle.h"
#include "SampleTree.h"

#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

namespace oracle
{

class FaceOracle
{
public:
  /// \param loops in the domain of the surface; none: all of it is kept
  FaceOracle(const footpoint::Surface& surface, const std::vector<footpoint::TrimLoop>& loops);

  struct Sample
  {
    Place at;
    Eigen::Vector3d point;
    std::size_t curve = 0; ///< on rims: number in loops().curves()
    Real t = 0;
  };
  struct Found
  {
    Real distance = INFINITY;
    Place at{ { NAN, NAN } };
  };

  const LoopOracle& loops() const { return *this->Loops; }
  const std::vector<Sample>& inside() const { return this->Inside; }
  const std::vector<Sample>& rims() const { return this->Rims; }
  const Place& lower() const { return this->Lower; }
  const Place& width() const { return this->Width; }

  Vector point(const Place& at) const;

  /// By differences of points; no unit vector at poles.
  Eigen::Vector3d normal(const Place& at) const;

  /// Diagonal of the box around all samples.
  double size() const;

  /// A lower bound by samples is none: the distance of the nearest sample, for ordering faces.
  double rough(const Eigen::Vector3d& query) const;

  /// Whether anything is kept at a point, or beside loops within 2e-3 of the domain of it.
  bool keeps_about(const Place& at) const;

  /// The nearest point that is found.
  Found nearest(const Eigen::Vector3d& query) const;

private:
  static constexpr std::size_t kDescents = 5;
  static constexpr int kOfDomain = 60; ///< samples along a direction, at least
  static constexpr int kMostOfDomain = 240;
  static constexpr int kOfSpan = 32; ///< samples of a span of a loop curve
  static constexpr std::size_t kMostOnRims = 40000;
  static constexpr Real kDifference = 1e-6L;
  static constexpr Real kFinest = 1e-10L; ///< of pattern searches, in parts of their first step
  static constexpr int kMoves = 200;      ///< of pattern searches
  /// So far outside the domain, in parts of it, a loop counts as on its border.
  static constexpr Real kBeyond = 1e-16L;
  /// So far beside a loop is looked whether it bounds what is kept.
  static constexpr Real kBeside = 1e-13L;
  static constexpr int kLooks = 32; ///< directions in which is looked
  static constexpr Real kAbout = 2e-3L;

  footpoint::TrimLoop domain() const;
  static std::vector<Eigen::Vector3d> points_of(const std::vector<Sample>& samples);

  /// Places along a direction: all breaks that the loops surround, and equally spaced between.
  std::vector<Real> steps(int i) const;

  void add_inside();
  void add_rims();
  bool in_domain(const Place& at) const;
  bool better(const Found& here, const Found& best) const;

  /// Whether anything is kept about a point, on a loop or between two: not where loops overlap or
  /// leave each other, or run back on themselves up to a rounding.
  bool is_kept_beside(const Place& at) const;

  Place moved(const Place& at, Real du, Real dv) const;

  /// Newton's iteration with differences, then, where it ended without a minimum, a pattern search.
  Found descend(Found best, const Vector& p) const;

  Found search_pattern(Found best, const Vector& p) const;

  /// Pattern search along a loop.
  Found slide(const Sample& from, const Vector& p) const;

  static constexpr int kWays[8][2] = { { 1, 0 }, { -1, 0 }, { 0, 1 }, { 0, -1 }, { 1, 1 },
    { -1, -1 }, { 1, -1 }, { -1, 1 } };

  FastSpline<2> Spline;
  Place Lower;
  Place Upper;
  Place Width;
  Place Cell;
  std::shared_ptr<const LoopOracle> Loops;
  std::vector<Sample> Inside;
  std::vector<Sample> Rims;
  SampleTree InsideTree;
  SampleTree RimTree;
};

/// The same for several faces.
class ModelOracle
{
public:
  explicit ModelOracle(std::vector<FaceOracle> faces);

  const std::vector<FaceOracle>& faces() const { return this->Faces; }

  struct Found
  {
    Real distance = INFINITY;
    std::size_t face = 0;
    Place at{ { NAN, NAN } };
  };

  Found nearest(const Eigen::Vector3d& query) const;

private:
  static constexpr std::size_t kFaces = 4; ///< that are looked into
  std::vector<FaceOracle> Faces;
};

} // namespace oracle
