// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/model/certified_feet.h"

#include "footpoint/search/better_foot.h"
#include "footpoint/search/box_traversal.h"
#include "footpoint/search/line_search.h"
#include "footpoint/search/stationary_cells.h"

#include <algorithm>
#include <cmath>

namespace footpoint
{
namespace
{

/// A start on a border over which the geometry is not smooth is moved inside by this part of the
/// piece, since there the sides differ (a gap even has two points).
constexpr double kInside = 1e-6;

/// Pieces that cutting may make of all patches together, and of one: about 1.7 KB each where
/// bicubic.
constexpr std::size_t kPiecesOfModel = 65536;
constexpr std::size_t kFewestPieces = 4;
constexpr std::size_t kMostPieces = 1024;

/// Starts on a patch where nothing is proved, about, and into how many parts a piece is divided for
/// them along a side at the most.
constexpr std::size_t kStarts = 1024;
constexpr int kMostParts = 16;

/// How far the extracted pieces may lie from the geometry by rounding, as a fraction of the size: a
/// few roundings for each step of the blossom, of the shift to the piece's origin and of the
/// evaluation (see Documentation/CertifiedSearch.md).
double extraction_error(int degrees)
{
  return (8.0 * degrees + 64.0) * 0x1p-53;
}

/// Progress when all pieces are there, before the rest of what is searched is built from them.
constexpr double kAtStructure = 0.4;

} // namespace

CertifiedFeet::CertifiedFeet(std::vector<Member> members, const Vector3& centre, double size,
  const Execution& execution)
  : Members(std::move(members))
  , TakesPart(this->Members.size(), false)
  , Centre(centre)
  , Size(size)
{
  const auto patches = static_cast<std::size_t>(std::count_if(this->Members.begin(),
    this->Members.end(), [](const Member& member) { return member.edge == nullptr; }));
  DistanceForms forms(std::clamp(
    kPiecesOfModel / std::max<std::size_t>(patches, 1), kFewestPieces, kMostPieces));
  const Execution forming = part_of(execution, 0.0, kAtStructure);
  const auto count = static_cast<double>(this->Members.size());
  std::size_t told = 0;
  int degrees = 0;
  for (std::size_t k = 0; k < this->Members.size(); ++k)
  {
    const Member& member = this->Members[k];
    const auto index = static_cast<std::int32_t>(k);
    if (member.edge)
    {
      forms.add(index, *member.edge, *member.pieces, member.edge->centre() - centre);
      this->TakesPart[k] = true;
    }
    else if (const auto* curve = dynamic_cast<const Curve*>(member.patch->curve.get()))
    {
      forms.add(index, *curve, curve->centre() - centre, member.shared.shared);
      degrees = std::max(degrees, curve->knots().degree());
      this->TakesPart[k] = true;
    }
    else if (const auto* surface = dynamic_cast<const Surface*>(member.patch->surface.get()))
    {
      forms.add(index, *surface, surface->centre() - centre, member.shared.shared,
        member.region, part_of(forming, k / count, 1.0 / count));
      degrees = std::max(degrees, surface->knots(0).degree() + surface->knots(1).degree());
      this->TakesPart[k] = true;
    }
    else
    {
      this->Complete = false;
    }
    if (forms.pieces().size() >= told + kPiecesForThreads)
    {
      told = forms.pieces().size();
      if (!forming.proceed((k + 1) / count))
      {
        throw Cancelled();
      }
    }
  }
  this->ExtractionError = 2.0 * extraction_error(degrees);
  const double wanted = static_cast<double>(kStarts * patches) /
    static_cast<double>(std::max<std::size_t>(forms.pieces().size(), 1));
  this->Parts = std::clamp(static_cast<int>(std::ceil(std::sqrt(wanted))), 1, kMostParts);
  this->Search = CertifiedSearch(
    std::move(forms), part_of(execution, kAtStructure, 1.0 - kAtStructure));
}

void CertifiedFeet::find(const Vector3& point, double limit, double tolerance,
  SearchWorkspace& workspace, CertifiedAnswer& answer) const
{
  const double left = std::max(0.0, tolerance - this->ExtractionError);
  this->Search.find(
    { point - this->Centre, limit, this->Size, left * this->Size }, workspace, answer);
  answer.certified = answer.certified && left > 0.0;
}

void CertifiedFeet::find(const Eigen::Ref<const Points>& points, double limit, double tolerance,
  SearchWorkspace& workspace, CertifiedAnswer* answers) const
{
  const double left = std::max(0.0, tolerance - this->ExtractionError);
  CertifiedQuery queries[CertifiedSearch::kTogether];
  const auto count = static_cast<int>(points.cols());
  for (int k = 0; k < count; ++k)
  {
    queries[k] = { points.col(k) - this->Centre, limit, this->Size, left * this->Size };
  }
  this->Search.find(queries, count, workspace, answers);
  for (int k = 0; k < count; ++k)
  {
    answers[k].certified = answers[k].certified && left > 0.0;
  }
}

void CertifiedFeet::visit_starts(const PatchQuery& query, const std::function<double()>& limit,
  const VisitPart& visit) const
{
  const Vector3 point = query.point - this->Centre;
  const DistanceForms& forms = this->Search.forms();
  auto visit_piece = [&](const PieceStart& start) { return this->visit_start(start, visit); };
  if (query.sought == Sought::Intersection)
  {
    visit_meeting_starts(forms, this->Search.tree(),
      { point, query.line, kMeets * this->Size, limit() }, visit_piece);
    return;
  }
  visit_stationary_starts(forms, this->Search.tree(),
    { point, query.sought == Sought::Orthogonal }, limit, visit_piece);
}

void CertifiedFeet::visit_pieces(const Vector3& point, const std::function<double()>& limit,
  const std::function<void(std::size_t, const PatchStart&)>& visit) const
{
  const auto visit_near = [&](std::size_t member, const PatchStart& start, const Parameter<2>&,
                            const Parameter<2>&)
  {
    const Patch& patch = *this->Members[member].patch;
    const Vector3 from = patch.curve
      ? Vector3(patch.curve->centre() + patch.curve->point(start.local.head<1>()))
      : Vector3(patch.surface->centre() + patch.surface->point(start.local));
    if ((from - point).norm() - start.reach <= limit())
    {
      visit(member, start);
    }
    return true;
  };
  visit_near_boxes(this->Search.tree(), point - this->Centre, limit,
    [&](std::int32_t index)
    {
      const Patch& patch = *this->Members[this->Search.piece(index).patch].patch;
      const int parts = this->Parts;
      for (int k = 0; k < (patch.curve ? parts : parts * parts); ++k)
      {
        const std::array<double, 2> lower{ { static_cast<double>(k / parts) / parts,
          static_cast<double>(k % parts) / parts } };
        const double half = 0.5 / parts;
        const PieceStart start{ index, { { lower[0] + half, lower[1] + half } }, lower,
          { { lower[0] + 2.0 * half, lower[1] + 2.0 * half } }, false };
        this->visit_start(start, visit_near);
      }
    });
}

bool CertifiedFeet::visit_start(const PieceStart& start, const VisitPart& visit) const
{
  const Piece& piece = this->Search.piece(start.piece);
  const bool curve = this->Members[piece.patch].patch->curve != nullptr;
  const std::array<Vector3, 2>& box = this->Search.forms().boxes()[start.piece];
  PatchStart result{ Parameter<2>::Zero(), 0.0, start.simple };
  double widest = start.simple ? 1.0 : 0.0;
  Parameter<2> lower = Parameter<2>::Zero();
  Parameter<2> upper = Parameter<2>::Zero();
  for (int i = 0; i < (curve ? 1 : 2); ++i)
  {
    const int from = curve ? 1 : i;
    auto local = [&](double t)
    { return t == 1.0 ? piece.upper[from] : piece.lower[from] + t * piece.width[from]; };
    double t = start.t[from];
    if ((t == 0.0 || t == 1.0) && piece.sides[from][t == 1.0] == PieceSide::Special)
    {
      t += t == 0.0 ? kInside : -kInside;
    }
    result.local(i) = local(t);
    const double width = start.upper[from] - start.lower[from];
    result.part *= width;
    widest = std::max(widest, width);
    lower(i) = local(start.lower[from]);
    upper(i) = local(start.upper[from]);
    const Direction& direction = direction_of(*this->Members[piece.patch].patch, i);
    result.pole = result.pole || (direction.collapsed[0] && lower(i) == 0.0) ||
      (direction.collapsed[1] && upper(i) == direction.length);
  }
  result.reach = widest * (box[1] - box[0]).norm();
  return visit(piece.patch, result, lower, upper);
}

bool CertifiedFeet::at_one_pole(const PieceFoot& a, const PieceFoot& b) const
{
  if (this->member(a) != this->member(b) || this->Members[this->member(a)].patch->curve)
  {
    return false;
  }
  for (int k = 0; k < 4; ++k)
  {
    if (this->at_pole(a, k / 2, k % 2) && this->at_pole(b, k / 2, k % 2))
    {
      return true;
    }
  }
  return false;
}

bool CertifiedFeet::at_pole(const PieceFoot& foot, int i, int end) const
{
  const Piece& piece = this->Search.piece(foot.piece);
  const Direction& direction = direction_of(*this->Members[piece.patch].patch, i);
  return direction.collapsed[end] && foot.t[i] == end &&
    (end == 0 ? piece.lower[i] == 0.0 : piece.upper[i] == direction.length);
}

PatchFoot CertifiedFeet::patch_foot(const PieceFoot& foot) const
{
  const Piece& piece = this->Search.piece(foot.piece);
  const bool curve = this->Members[piece.patch].patch->curve != nullptr;
  PatchFoot result;
  for (int i = 0; i < (curve ? 1 : 2); ++i)
  {
    const int from = curve ? 1 : i;
    const double t = foot.t[from];
    result.local(i) = t == 0.0
      ? piece.lower[from]
      : (t == 1.0 ? piece.upper[from] : piece.lower[from] + t * piece.width[from]);
    result.sides(i) = t == 1.0 ? Side::Left : Side::Right;
  }
  result.parameter = this->domain_parameter(foot, piece);
  result.offset = vector(foot.offset);
  result.point = this->Centre + vector(foot.position);
  result.distance = foot.distance;
  result.converged = true;
  result.iterations = foot.iterations;
  return result;
}

} // namespace footpoint
