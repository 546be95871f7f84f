// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/model/prepared_model.h"

namespace footpoint
{

/// A foot that was found on a patch of the model.
struct Candidate
{
  std::size_t patch;
  PatchFoot foot;
};

struct PointInverter::Workspace::Memory
{
  SearchWorkspace search;
  std::vector<CertifiedAnswer> answers;
};

/// Queries with one set of options to a prepared model.
struct PointInverter::Implementation
{
  std::shared_ptr<const PreparedModel> Prepared;
  InversionOptions Options;           ///< the fixed direction normalised
  std::vector<PreparedPatch> Patches; ///< in the order of faces
  double Size;

  Implementation(std::shared_ptr<const PreparedModel> prepared, const InversionOptions& options);

  // === The order of feet, in candidate_order.cpp

  Parameter<2> parameter(const Candidate& candidate) const;
  bool lower(const Candidate& a, const Candidate& b) const;
  bool better(const Candidate& a, const Candidate& b) const;
  bool same(const Candidate& a, const Candidate& b) const;
  bool same_touch(const Candidate& a, const Candidate& b) const;
  void put_best_first(std::vector<Candidate>& feet) const;

  // === The nearest foot, in nearest_foot.cpp

  PatchQuery query(const Vector3& point, Sought sought) const;
  std::vector<std::size_t> by_bound(const PatchQuery& query, double limit) const;
  bool settles(const PatchQuery& query, const Candidate& candidate, const PatchStart& start,
    const Parameter<2>& lower, const Parameter<2>& upper) const;
  bool counts(const PatchQuery& query, const Candidate& candidate) const;
  void search(const PatchQuery& query, const Start& start, const std::function<double()>& limit,
    const std::function<void(const Candidate&)>& found) const;
  std::vector<Candidate> nearest(const Vector3& point, const Start& start, Sought sought) const;
  bool certifies() const;
  bool is_known(std::size_t patch) const;
  Foot nearest_certified(const Vector3& point, PointInverter::Workspace::Memory& memory) const;
  Foot certified_foot(const Vector3& point, const CertifiedAnswer& answer) const;
  void add_uncertified(
    const Vector3& point, bool on_splines, std::vector<Candidate>& feet) const;

  // === All feet, in all_feet.cpp

  bool wants_lines() const { return !this->Options.fixed_direction.isZero(0.0); }
  std::vector<Candidate> every(const Vector3& point, const Start& start) const;
  void thin_out_continua(const Vector3& point, std::vector<Candidate>& feet) const;
  void thin_out_lines(std::vector<Candidate>& feet) const;
  void put_nearest_in(std::vector<Foot>& feet, Foot nearest) const;

  // === From a candidate to a foot, in finished_foot.cpp

  Foot finish(
    const Vector3& point, const Candidate& candidate, const std::vector<Candidate>& others) const;
  void settle_sign(Foot& foot, const Vector3& point) const;
  Vector3 direction(const Candidate& candidate) const;
  void settle_shared_border(Foot& foot, const Vector3& point, const Candidate& candidate,
    const std::vector<Candidate>& others) const;
};

} // namespace footpoint
