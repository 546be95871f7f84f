// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/common/execution.h"
#include "footpoint/model/point_inversion.h"
#include "footpoint/model/shared_borders.h"
#include "footpoint/search/certified_search.h"
#include "footpoint/search/piece_start.h"

#include <optional>

namespace footpoint
{

/// The certified search over all splines of a model, and its answers as feet.
class CertifiedFeet
{
public:
  /// One patch of the model, with the index of its face; or an edge.
  struct Member
  {
    const Patch* patch;
    int face;
    bool reversed; ///< the face is
    SharedBorders shared;
    const TrimRegion* region; ///< null: not trimmed
    const EdgeCurve* edge;    ///< the patch's curve, where it is an edge of a trimmed face
    const EdgePieces* pieces; ///< of the edge; needed while this is built
  };

  /// \param members the patches that are splines take part; the others are passed over
  /// \param centre  of the model; queries are measured from there
  /// \param size    of the model
  /// \param execution whose threads share the work of building \throw Cancelled by its `proceed`
  CertifiedFeet(std::vector<Member> members, const Vector3& centre, double size,
    const Execution& execution = {});

  /// Whether every patch takes part.
  bool complete() const { return this->Complete; }
  bool takes_part(std::size_t member) const { return this->TakesPart[member]; }

  /// \param tolerance certificate tolerance, a fraction of the size; below the error of extracting
  ///                  the pieces nothing is certified
  void find(const Vector3& point, double limit, double tolerance, SearchWorkspace& workspace,
    CertifiedAnswer& answer) const;
  /// The same for up to CertifiedSearch::kTogether points. \param answers one for each
  void find(const Eigen::Ref<const Points>& points, double limit, double tolerance,
    SearchWorkspace& workspace, CertifiedAnswer* answers) const;

  /// Told a start on a member, and the local parameters of the part that it stands for; returns
  /// whether what it leads to settles that part (see VisitStart).
  using VisitPart = std::function<bool(std::size_t member, const PatchStart& start,
    const Parameter<2>& lower, const Parameter<2>& upper)>;

  /// Visits starts for all that is sought (point, line and kind of feet) on the splines. Nothing
  /// farther than limit() is sought, visits may lower it.
  void visit_starts(const PatchQuery& query, const std::function<double()>& limit,
    const VisitPart& visit) const;

  /// Visits starts all over the pieces whose boxes are no farther than limit(), near ones first;
  /// what is about as far as the starts are apart farther than limit() is left out.
  void visit_pieces(const Vector3& point, const std::function<double()>& limit,
    const std::function<void(std::size_t member, const PatchStart& start)>& visit) const;

  std::size_t member(const PieceFoot& foot) const
  {
    return static_cast<std::size_t>(this->Search.piece(foot.piece).patch);
  }

  /// Whether two feet lie on the same collapsed side of a patch and so are one point.
  bool at_one_pole(const PieceFoot& a, const PieceFoot& b) const;

  /// Where a foot lies, for a descent on the whole patch to start from; its type is left open.
  PatchFoot patch_foot(const PieceFoot& foot) const;

  /// Fills in everything for a foot inside a smooth part of the geometry or on an open boundary,
  /// the only one near it; false where it is none of those and has to be looked at more closely.
  bool plain_foot(const PieceFoot& found, Foot& foot) const;
  /// The same for the feet that the pieces on either side of a kink have on it, where either leads
  /// away from the query.
  bool plain_kink_foot(const PieceFoot& one, const PieceFoot& two, Foot& foot) const;

  /// Whether what was found is one place where the parametrization stands still, a pole or the line
  /// of a cusp, from which the distance rises to all sides: a minimum of the whole patch.
  bool is_held(const CertifiedAnswer& answer) const;

private:
  /// Whether a foot lies on the collapsed side of a patch at an end of direction i.
  bool at_pole(const PieceFoot& foot, int i, int end) const;
  bool is_held_at_pole(const CertifiedAnswer& answer) const;
  bool rises_beside(const PieceFoot& foot, int across, int end) const;
  bool is_held_at_cusp(const PieceFoot& one, const PieceFoot& two) const;
  /// The direction across the line between two pieces on which two feet are one place.
  std::optional<int> line_between(const PieceFoot& one, const PieceFoot& two) const;
  bool plain_edge_foot(const PieceFoot& found, Foot& foot) const;
  /// Of a patch, or of a curve twice the same.
  static const Direction& direction_of(const Patch& patch, int i)
  {
    return patch.curve ? patch.curve->direction(0) : patch.surface->direction(i);
  }
  static Vector3 vector(const std::array<double, 3>& a) { return { a[0], a[1], a[2] }; }
  bool visit_start(const PieceStart& start, const VisitPart& visit) const;
  Parameter<2> domain_parameter(const PieceFoot& foot, const Piece& piece) const;

  std::vector<Member> Members;
  std::vector<bool> TakesPart;
  bool Complete = true;
  int Parts = 1; ///< of a piece along a side, with a start in each
  Vector3 Centre;
  double Size;
  double ExtractionError; ///< of both ends of a distance, a fraction of the size
  CertifiedSearch Search;
};

} // namespace footpoint
