// SPDX-License-Identifier: BSD-3-Clause

// The members of Finder that search: from the first descent to the pieces that have to be proved.
// Compiled once for each set of vector instructions (the guard of Highway's "-inl.h" headers).
#if defined(FOOTPOINT_PIECE_SEARCH_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FOOTPOINT_PIECE_SEARCH_INL_H
#undef FOOTPOINT_PIECE_SEARCH_INL_H
#else
#define FOOTPOINT_PIECE_SEARCH_INL_H
#endif

#include "footpoint/search/finder-inl.h"

#include <algorithm>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace footpoint
{
namespace HWY_NAMESPACE
{
namespace
{

Pair Finder::guess(const PieceQuery& query) const
{
  const TangentPlane& plane = this->Structure.planes[query.index];
  Pair t;
  for (int i = 0; i < 2; ++i)
  {
    double at = 0.5;
    for (int k = 0; k < 3; ++k)
    {
      at += plane.rows[i][k] * (query.p[k] - plane.point[k]);
    }
    t[i] = std::min(std::max(at, 0.0), 1.0);
  }
  return t;
}

bool Finder::begin_with(std::int32_t index, double squared)
{
  const PieceQuery query = this->at(index);
  const Pair start = this->guess(query);
  const double reach = query.piece->reach;
  if (squared <= kNearPiece * kNearPiece * reach * reach)
  {
    this->First = index;
    this->FirstSquared = squared;
    this->Visited = 1;
    this->wait_for(query, start);
    return true;
  }
  if (query.piece->region)
  {
    this->bound_by_point(query, query.piece->kept);
  }
  this->bound_by_point(query, start);
  this->collect(index, squared);
  return false;
}

bool Finder::walk_on()
{
  Descent& descent = this->Pending;
  if (descent.steps != Steps::Left || this->Visited >= kMostVisited)
  {
    return false;
  }
  Pair target = descent.target;
  const std::int32_t next = piece_beyond(this->Structure, descent.query, target);
  if (next < 0)
  {
    return false;
  }
  ++this->Visited;
  this->WalkedSteps += descent.count;
  this->wait_for(this->at(next), target);
  return true;
}

void Finder::end_walk()
{
  this->Visited = 0;
  const int count = this->WalkedSteps + finish_descent(this->Pending);
  const PieceQuery& query = this->Pending.query;
  // Elsewhere a better start may be known.
  this->Begun = query.index == this->First ? query.index : -1;
  this->take(this->foot_of(query, this->Pending.place, count));
  this->settle();
  if (!this->found())
  {
    const PieceQuery first = this->at(this->First);
    if (first.piece->region)
    {
      this->bound_by_point(first, first.piece->kept); // the foot is trimmed away
    }
  }
  if (!this->is_settled(this->First))
  {
    this->collect(this->First, this->FirstSquared);
  }
}

bool Finder::start()
{
  this->Answer.count = 0;
  this->Finds.candidates.clear();
  this->Finds.survivors.clear();
  if (this->Structure.tree.nodes().empty())
  {
    return false;
  }
  if (this->begin())
  {
    return true;
  }
  this->collect();
  return this->next_candidate();
}

bool Finder::go_on()
{
  if (this->Visited > 0)
  {
    if (this->walk_on())
    {
      return true;
    }
    this->end_walk();
    this->collect();
  }
  else
  {
    const int count = finish_descent(this->Pending);
    this->take(this->foot_of(this->Pending.query, this->Pending.place, count));
  }
  return this->next_candidate();
}

void Finder::wait_for(const PieceQuery& query, const Pair& start)
{
  this->Pending.query = query;
  this->Pending.place.t = start;
}

void Finder::bound_by_point(const PieceQuery& query, const Pair& t)
{
  Place place;
  place.t = t;
  evaluate_at(query, place);
  const Level level = this->level_of(query, std::sqrt(place.squared));
  this->bound_by(query, place.t, place.squared + 2.0 * level.margin);
}

void Finder::bound_by(const PieceQuery& query, const Pair& t, double squared)
{
  if (squared < this->SquaredBound && (t == query.piece->kept || is_kept(*query.piece, t)))
  {
    this->SquaredBound = squared;
    this->Bound = std::sqrt(std::max(squared, 0.0)) * (1.0 + 4.0 * kRounding);
    this->Nearest = query.index;
    this->NearestAt = t;
  }
}

bool Finder::next_candidate()
{
  std::vector<SearchWorkspace::Candidate>& candidates = this->Finds.candidates;
  const auto nearer = [](const SearchWorkspace::Candidate& a, const SearchWorkspace::Candidate& b)
  { return a.bound != b.bound ? a.bound < b.bound : a.piece < b.piece; };
  // Most are excluded by what the first descents find: few are worth to be sorted, if they are few.
  const bool sorted = candidates.size() > kMostUnsorted;
  if (this->Next == 0 && sorted)
  {
    std::sort(candidates.begin(), candidates.end(), nearer);
  }
  // Beyond this nothing is of interest, whatever the margin and the error of the piece.
  const double reach = this->reach() + this->Structure.forms.greatest_error();
  const double far = bound_of_length(this->P) + this->Query.size;
  const double end = reach * reach + kMostMargin * far * far;
  while (this->Next < candidates.size())
  {
    if (!sorted)
    {
      const auto next = candidates.begin() + static_cast<std::ptrdiff_t>(this->Next);
      std::iter_swap(next, std::min_element(next, candidates.end(), nearer));
    }
    const SearchWorkspace::Candidate& candidate = candidates[this->Next++];
    if (candidate.bound >= end)
    {
      break;
    }
    const PieceQuery query = this->at(candidate.piece);
    const Level level = this->reach_of(query);
    if (candidate.bound >= level.level + 2.0 * level.margin)
    {
      continue;
    }
    Pair start;
    if (this->excludes_by_outline(query, level, start))
    {
      continue;
    }
    if (!this->found() || !this->excludes_from(query, level, start))
    {
      this->wait_for(query, start);
      return true;
    }
  }
  this->Next = candidates.size();
  this->descend_from_nearest();
  return false;
}

bool Finder::excludes_by_outline(
  const PieceQuery& query, const Level& level, Pair& start) const
{
  const OutlineView view(this->Structure.outlines[query.index], this->P, this->Rounding);
  if (!view.is_usable())
  {
    start = this->guess(query);
    return false;
  }
  const PieceShape& shape = *query.piece->shape;
  RefinedOutline outline;
  view.refine(shape, level.constant - level.margin, outline);
  if (this->reach() < kInfinity && outline.is_positive())
  {
    return true;
  }
  start = start_of(shape, outline);
  return false;
}

bool Finder::excludes_from(const PieceQuery& query, const Level& level, const Pair& t)
{
  Place place;
  place.t = t;
  evaluate_at(query, place);
  const double reach = this->reach() + query.piece->error + 2.0 * this->moved(query);
  const double above = place.squared * (1.0 - 16.0 * kRounding) - reach * reach * kOutward;
  if (this->is_above(query, place.jet[kS], place.r, place.t, above))
  {
    return true;
  }
  const PieceShape& shape = *query.piece->shape;
  if (!(above > 2.0 * level.margin) || shape.form_size > kMostOfForm)
  {
    return false;
  }
  distance_form(query, level.constant - level.margin, this->coefficients(0, shape.form_size));
  return this->is_positive_from(shape, t);
}

void Finder::descend_from_nearest()
{
  const auto reached = [this] { return this->found() && this->best().distance <= this->Bound; };
  if (this->Nearest < 0 || reached())
  {
    return;
  }
  // No descent came as near as that point.
  const PieceQuery query = this->at(this->Nearest);
  Place place;
  place.t = this->NearestAt;
  const int iterations = descend(query, kWholePiece, place);
  this->take(this->foot_of(query, place, iterations));
  if (!reached() && query.piece->region)
  {
    place.t = this->NearestAt; // the way down led out of the face
    evaluate_at(query, place);
    this->keep(this->foot_of(query, place, 0));
  }
}

void Finder::take(const PieceFoot& foot)
{
  this->Finds.survivors.push_back(foot);
  this->keep(foot);
}

void Finder::settle()
{
  if (!this->found())
  {
    return;
  }
  const PieceFoot& foot = this->best();
  const PieceNeighbourhood& around = this->Structure.neighbourhoods[foot.piece];
  if (!(foot.distance <= around.limit))
  {
    return;
  }
  const PieceQuery query = this->at(foot.piece);
  double gradient = around.rounding * (bound_of_length(query.p) + query.piece->reach);
  for (int i = 0; i < 2; ++i)
  {
    // The end of the block holds what would go on there.
    const double slope = foot.gradient[i];
    const bool held = (foot.t[i] == 0.0 && slope >= 0.0 && !around.continues(i, 0)) ||
      (foot.t[i] == 1.0 && slope <= 0.0 && !around.continues(i, 1));
    gradient += held ? 0.0 : around.inverse_speed[i] * std::abs(slope);
  }
  // Positions, the query and the distance are off by a few roundings of their size.
  const double moved = 32.0 * kRounding * (this->Query.size + bound_of_length(query.p));
  const double tolerance =
    std::min(kPartOfBlock * this->Query.tolerance - moved, foot.distance);
  if (tolerance < 0.0)
  {
    return;
  }
  const double slack = tolerance * (2.0 * foot.distance - tolerance);
  if (foot.distance > tolerance && !(around.square_factor * gradient * gradient <= slack))
  {
    return;
  }
  for (int k = 0; k < 9; ++k)
  {
    this->Block.pieces[k] = (around.block >> k & 1) != 0 ? around.pieces[k] : -1;
  }
  this->Block.middle = foot.piece;
}

PieceFoot Finder::foot_of(const PieceQuery& query, const Place& place, int iterations) const
{
  PieceFoot foot;
  foot.piece = query.index;
  foot.t = place.t;
  for (int k = 0; k < 3; ++k)
  {
    foot.position[k] = query.piece->origin[k] + place.jet[kS][k];
    foot.offset[k] = place.r[k];
    foot.first[0][k] = place.jet[kSu][k];
    foot.first[1][k] = place.jet[kSv][k];
  }
  foot.distance = std::sqrt(place.squared);
  foot.gradient = place.gradient;
  foot.hessian = place.hessian;
  foot.metric = { { place.metric[0], place.metric[1] } };
  const bool rational = query.piece->shape->rational;
  foot.weight = { { rational ? place.jet[kS][3] : 1.0, rational ? place.jet[kSu][3] : 0.0,
    rational ? place.jet[kSv][3] : 0.0 } };
  foot.iterations = iterations;
  return foot;
}

bool Finder::keep(const PieceFoot& foot)
{
  if (!(foot.distance <= this->reach()) ||
    !is_kept(this->Structure.forms.pieces()[foot.piece], foot.t))
  {
    return false;
  }
  CertifiedAnswer& answer = this->Answer;
  // By how much it is nearer than another foot, without the rounding of large distances.
  auto gain = [&foot](const PieceFoot& other)
  {
    double difference = 0.0;
    for (int k = 0; k < 3; ++k)
    {
      difference +=
        (other.position[k] - foot.position[k]) * (other.offset[k] + foot.offset[k]);
    }
    const double sum = other.distance + foot.distance;
    return sum > 0.0 ? difference / sum : 0.0;
  };
  const double tie = tie_tolerance(0.0, this->Query.size);
  const double nearer = answer.count > 0 ? gain(answer.feet[0]) : kInfinity;
  if (nearer < -tie)
  {
    return false;
  }
  for (int k = 0; k < answer.count; ++k)
  {
    const PieceFoot& other = answer.feet[k];
    if (other.piece == foot.piece && nearer <= tie && std::abs(other.t[0] - foot.t[0]) < 1e-9 &&
      std::abs(other.t[1] - foot.t[1]) < 1e-9)
    {
      return false;
    }
  }
  if (nearer > 0.0)
  {
    // The nearest comes first; what no longer ties with it is dropped.
    int count = 0;
    for (int k = 0; k < answer.count; ++k)
    {
      if (gain(answer.feet[k]) <= tie)
      {
        answer.feet[count++] = answer.feet[k];
      }
    }
    count = std::min(count, CertifiedAnswer::kMost - 1);
    std::copy_backward(
      answer.feet.begin(), answer.feet.begin() + count, answer.feet.begin() + count + 1);
    answer.feet[0] = foot;
    answer.count = count + 1;
  }
  else if (answer.count < CertifiedAnswer::kMost)
  {
    answer.feet[answer.count++] = foot;
  }
  return nearer > tie;
}

} // namespace
} // namespace HWY_NAMESPACE
} // namespace footpoint
HWY_AFTER_NAMESPACE();

#endif
