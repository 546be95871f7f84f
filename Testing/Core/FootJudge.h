// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Queries around trimmed faces, and the verdict on the feet that are found for them.

#include "FaceOracle.h"
#include "Inversion.h"

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

namespace judge
{

using footpoint::Foot;
using footpoint::FootType;
using footpoint::PointInverter;
using footpoint::Status;
using footpoint::Vector3;
using oracle::FaceOracle;
using oracle::ModelOracle;
using oracle::Place;
using oracle::Real;

/// Where queries lie; lengths are parts of the size of a face.
enum class Where
{
  On,         ///< on the surface
  Near,       ///< within 1e-3
  Off,        ///< within 0.1
  Far,        ///< within 3
  OnEdge,     ///< on a trim curve
  OnVertex,   ///< where trim curves meet
  AboveEdge,  ///< along the normal over a trim curve, 1e-6 to 1
  JustOff,    ///< along the normal over the face, 1e-13 to 1e-6
  InHole,     ///< at and about the centre of a loop
  Midway,     ///< between two points of faces
  MidwayRims, ///< between two points of trim curves
  Count
};

const char* name_of(Where where);

const FaceOracle::Sample& any_of(
  const std::vector<FaceOracle::Sample>& samples, shapes::Random& random);

/// A point of the face that is no sample.
Place inside(const FaceOracle& face, shapes::Random& random);

Vector3 query(const ModelOracle& model, const std::vector<double>& sizes, std::size_t f,
  Where where, shapes::Random& random);

struct Tally
{
  std::uint64_t queries = 0;
  std::uint64_t too_far = 0;   ///< the oracle has a point that is nearer
  std::uint64_t too_near = 0;  ///< nothing is kept about the foot, and the oracle's is farther
  std::uint64_t misplaced = 0; ///< the point is not that of the parameters
  std::uint64_t outside = 0;   ///< the parameters are not kept
  std::uint64_t uncertified = 0;
  std::uint64_t unproved_too_far = 0;
  std::uint64_t oracle_farther = 0; ///< the oracle found only farther points
  double excess = 0.0;              ///< largest, in parts of the size
  double search_seconds = 0.0;
  double oracle_seconds = 0.0;
  double slowest = 0.0; ///< query, in seconds

  std::uint64_t wrong() const
  {
    return this->too_far + this->too_near + this->misplaced + this->outside;
  }
};

std::ostream& operator<<(std::ostream& stream, const Tally& tally);

/// Feet this much of the size farther than the nearest point are wrong.
constexpr double kWrong = 1e-12;
/// Rounding of distances and of the subtraction of the model's centre, times these.
constexpr double kRounding = 10.0 * 0x1p-53;
/// How far from the point of its parameters a foot may be, and its parameters from the loops, in
/// parts of the size and the domain.
constexpr double kPlace = 1e-13;
constexpr double kBesideLoop = 1e-12;

class Judge
{
public:
  /// \param faces of the model, all of them one surface
  Judge(std::string name, const footpoint::Model& faces,
    const footpoint::InversionOptions& options = {});

  const PointInverter& inverter() const { return this->Inverter; }
  const ModelOracle& model() const { return this->Oracle; }
  const std::vector<double>& sizes() const { return this->Sizes; }

  /// Asks `count` queries of all kinds around all faces in turn.
  void ask(int count, shapes::Random& random, Tally& tally) const;

  Foot check(const Vector3& point, const char* what, Tally& tally) const;

private:
  static std::vector<FaceOracle> oracles(const footpoint::Model& faces);

  /// Whether nothing is kept about a foot.
  bool is_nowhere(const Foot& foot) const;

  void check_place(const Vector3& point, const char* what, const Foot& foot,
    const ModelOracle::Found& nearest, Tally& tally) const;

  void report(const char* verdict, const char* what, const Vector3& point, const Foot& foot,
    const ModelOracle::Found& nearest, double by) const;

  static constexpr int kPrinted = 3; ///< failures of a model that are printed
  std::string Name;
  PointInverter Inverter;
  ModelOracle Oracle;
  std::vector<double> Sizes;
  mutable int Printed = 0;
};

} // namespace judge
