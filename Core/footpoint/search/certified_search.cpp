// SPDX-License-Identifier: BSD-3-Clause

// Compiled once for each set of vector instructions; the best that the processor has is taken at run
// time. SSSE3 and the extensions of AVX-512 would add nothing to SSE4 and AVX-512 here.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "footpoint/search/certified_search.cpp"
#include <hwy/foreach_target.h>

#include "footpoint/search/finder-inl.h"
#include "footpoint/search/packet_descent-inl.h"

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <utility>

HWY_BEFORE_NAMESPACE();
namespace footpoint
{
namespace HWY_NAMESPACE
{
namespace
{

namespace hn = hwy::HWY_NAMESPACE;

Finder::Level Finder::level_of(const PieceQuery& query) const
{
  const Piece& piece = *query.piece;
  const PieceFoot& foot = this->best();
  const double far = bound_of_length(query.p);
  double f[3];
  Level level{ 0.0, 0.0, foot.distance * foot.distance };
  for (int k = 0; k < 3; ++k)
  {
    f[k] = foot.position[k] - piece.origin[k];
    level.constant += f[k] * (2.0 * query.p[k] - f[k]);
  }
  const double reach = bound_of_length(f);
  level.margin = piece.shape->roundings * kRounding *
    (piece.reach * (piece.reach + 4.0 * far) + reach * (reach + 4.0 * far));
  return level;
}

Finder::Level Finder::level_of(const PieceQuery& query, double distance) const
{
  const Piece& piece = *query.piece;
  const double squared = dot(query.p, query.p);
  const double level = distance * distance;
  return { squared - level,
    piece.shape->roundings * kRounding *
      (piece.reach * (piece.reach + 4.0 * bound_of_length(query.p)) + squared + level),
    level };
}

Finder::Level Finder::reach_of(const PieceQuery& query) const
{
  const double error = query.piece->error;
  if (!this->found() || this->Bound < this->best().distance)
  {
    return this->level_of(query, this->Bound < kInfinity ? this->Bound + error : 0.0);
  }
  Level level = this->level_of(query);
  const double more = this->tie() + error;
  const double tie = more * (2.0 * this->best().distance + more);
  level.constant -= tie;
  level.level += tie;
  return level;
}

double Finder::form(const PieceQuery& query, double constant, double* target) const
{
  const PieceShape& shape = *query.piece->shape;
  const hn::CappedTag<double, 8> tag;
  const int lanes = static_cast<int>(hn::Lanes(tag));
  const auto x = hn::Set(tag, -2.0 * query.p[0]);
  const auto y = hn::Set(tag, -2.0 * query.p[1]);
  const auto z = hn::Set(tag, -2.0 * query.p[2]);
  const auto c = hn::Set(tag, constant);
  const int size = shape.form_size;
  const double* q = query.piece->forms;
  auto least = hn::Set(tag, kInfinity);
  if (shape.rational)
  {
    for (int k = 0; k < size; k += lanes)
    {
      auto f = hn::MulAdd(c, hn::LoadU(tag, q + 4 * size + k), hn::LoadU(tag, q + k));
      f = hn::MulAdd(x, hn::LoadU(tag, q + size + k), f);
      f = hn::MulAdd(y, hn::LoadU(tag, q + 2 * size + k), f);
      f = hn::MulAdd(z, hn::LoadU(tag, q + 3 * size + k), f);
      hn::StoreU(f, tag, target + k);
      least = hn::Min(least, f);
    }
  }
  else
  {
    for (int k = 0; k < size; k += lanes)
    {
      auto f = hn::Add(c, hn::LoadU(tag, q + k));
      f = hn::MulAdd(x, hn::LoadU(tag, q + size + k), f);
      f = hn::MulAdd(y, hn::LoadU(tag, q + 2 * size + k), f);
      f = hn::MulAdd(z, hn::LoadU(tag, q + 3 * size + k), f);
      hn::StoreU(f, tag, target + k);
      least = hn::Min(least, f);
    }
  }
  return hn::GetLane(hn::MinOfLanes(tag, least));
}

/// Near the minimum: the control points of a parabola c(t − t0)² are those of a parabola themselves,
/// with its vertex at t0 (n − 1) + ½ (from raising its degree to n).
HWY_INLINE double parabola_start(double before, double here, double after, int at, int n)
{
  const double bend = before - 2.0 * here + after;
  const double vertex = bend > 0.0 ? at + 0.5 * (before - after) / bend : at;
  return std::min(std::max((vertex - 0.5) / (n - 1), 0.0), 1.0);
}

/// Where to start from, near the smallest coefficient.
Pair Finder::start_of(const PieceShape& shape, const double* coefficients, double least)
{
  const hn::CappedTag<double, 8> tag;
  const int lanes = static_cast<int>(hn::Lanes(tag));
  int k = 0;
  for (int i = 0; i < shape.form_size; i += lanes)
  {
    const auto is_least = hn::Eq(hn::LoadU(tag, coefficients + i), hn::Set(tag, least));
    const auto at = hn::FindFirstTrue(tag, is_least);
    if (at >= 0)
    {
      k = i + static_cast<int>(at);
      break;
    }
  }
  const int row = k / shape.stride;
  const int column = std::min(k % shape.stride, shape.columns - 1);
  Pair start{ { 0.0, 0.0 } };
  if (shape.rows > 1)
  {
    const int at = std::clamp(row, 1, shape.rows - 2);
    const double* f = coefficients + column;
    start[0] = parabola_start(f[(at - 1) * shape.stride], f[at * shape.stride],
      f[(at + 1) * shape.stride], at, shape.rows - 1);
  }
  if (shape.columns > 1)
  {
    const int at = std::clamp(column, 1, shape.columns - 2);
    const double* f = coefficients + row * shape.stride;
    start[1] = parabola_start(f[at - 1], f[at], f[at + 1], at, shape.columns - 1);
  }
  return start;
}

// === The search ===

/// Squared distances of the boxes of a node from the query.
HWY_INLINE void Finder::box_distances(const BoxTree::Node& node, double* squared) const
{
  const hn::CappedTag<double, 8> tag;
  const hn::Rebind<float, decltype(tag)> single;
  const int lanes = static_cast<int>(hn::Lanes(tag));
  const auto zero = hn::Zero(tag);
  for (int k = 0; k < BoxTree::kWidth; k += lanes)
  {
    auto sum = zero;
    for (int i = 0; i < 3; ++i)
    {
      const auto p = hn::Set(tag, this->P[i]);
      const auto lower = hn::PromoteTo(tag, hn::LoadU(single, node.lower[i] + k));
      const auto upper = hn::PromoteTo(tag, hn::LoadU(single, node.upper[i] + k));
      const auto way = hn::Max(hn::Max(hn::Sub(lower, p), hn::Sub(p, upper)), zero);
      sum = hn::MulAdd(way, way, sum);
    }
    hn::StoreU(sum, tag, squared + k);
  }
}

/// Squared distances of the boxes of a node, and what a way down goes by: boxes that hold the point are
/// told apart by their middles.
HWY_INLINE void Finder::visit(std::int32_t index)
{
  const hn::CappedTag<double, 8> tag;
  const hn::Rebind<float, decltype(tag)> single;
  const auto zero = hn::Zero(tag);
  const auto slight = hn::Set(tag, 1e-3); // weight of the distance of the middle
  const BoxTree::Node& node = this->Structure.tree.nodes()[index];
  Visit& visit = this->Path[this->Depth++];
  visit.node = index;
  visit.followed = 0;
  for (int k = 0; k < BoxTree::kWidth; k += static_cast<int>(hn::Lanes(tag)))
  {
    auto squared = zero;
    auto middle = zero;
    for (int i = 0; i < 3; ++i)
    {
      const auto p = hn::Set(tag, this->P[i]);
      const auto below = hn::Sub(hn::PromoteTo(tag, hn::LoadU(single, node.lower[i] + k)), p);
      const auto above = hn::Sub(p, hn::PromoteTo(tag, hn::LoadU(single, node.upper[i] + k)));
      const auto way = hn::Max(hn::Max(below, above), zero);
      squared = hn::MulAdd(way, way, squared);
      const auto twice = hn::Sub(below, above);
      middle = hn::MulAdd(twice, twice, middle);
    }
    hn::StoreU(squared, tag, visit.squared + k);
    hn::StoreU(hn::MulAdd(slight, middle, squared), tag, visit.score + k);
  }
}

/// The child that a way down follows.
HWY_INLINE int Finder::nearest_child(const Visit& visit)
{
  const hn::CappedTag<double, 8> tag;
  auto least = hn::Set(tag, kInfinity);
  for (int k = 0; k < BoxTree::kWidth; k += static_cast<int>(hn::Lanes(tag)))
  {
    least = hn::Min(least, hn::LoadU(tag, visit.score + k));
  }
  // The first child, which there always is, where numbers beyond all bounds leave no bit set.
  const std::uint64_t bits =
    at_most(visit.score, BoxTree::kWidth, hn::GetLane(hn::MinOfLanes(tag, least)));
  return bits != 0 ? static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero64(bits)) : 0;
}

Finder::Leaf Finder::go_down(std::int32_t child)
{
  const std::vector<BoxTree::Node>& nodes = this->Structure.tree.nodes();
  for (;;)
  {
    this->visit(child);
    Visit& visit = this->Path[this->Depth - 1];
    const int nearest = nearest_child(visit);
    child = nodes[visit.node].child[nearest];
    if (child < 0)
    {
      return { this->Depth - 1, nearest, visit.squared[nearest] };
    }
    visit.followed |= 1U << nearest;
  }
}

bool Finder::begin()
{
  const std::vector<BoxTree::Node>& nodes = this->Structure.tree.nodes();
  Leaf leaf = this->go_down(0);
  // Where boxes overlap the way down may miss the one that holds the point.
  for (int more = 0; more < kMostWaysDown && leaf.squared > 0.0; ++more)
  {
    double least = kMuchNearer * leaf.squared;
    int from = -1;
    int next = 0;
    for (int k = 0; k < this->Depth; ++k)
    {
      const Visit& visit = this->Path[k];
      std::uint64_t nearer = at_most(visit.squared, BoxTree::kWidth, least) & ~std::uint64_t(visit.followed);
      for (; nearer != 0; nearer &= nearer - 1)
      {
        const auto child = static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero64(nearer));
        if (visit.squared[child] < least)
        {
          least = visit.squared[child];
          from = k;
          next = child;
        }
      }
    }
    if (from < 0)
    {
      break;
    }
    const std::int32_t child = nodes[this->Path[from].node].child[next];
    Leaf other{ from, next, least };
    if (child >= 0)
    {
      this->Path[from].followed |= 1U << next;
      other = this->go_down(child);
    }
    leaf = other.squared < leaf.squared ? other : leaf;
  }
  Visit& last = this->Path[leaf.visit];
  last.followed |= 1U << leaf.child;
  return this->begin_with(-1 - nodes[last.node].child[leaf.child], leaf.squared);
}

void Finder::collect()
{
  const std::vector<BoxTree::Node>& nodes = this->Structure.tree.nodes();
  // Each level leaves at most seven siblings behind; 2^32 boxes are eleven levels.
  std::int32_t stack[BoxTree::kWidth * 16];
  int top = 0;
  auto take = [&](const BoxTree::Node& node, const double* squared, std::uint64_t except)
  {
    const double reach = this->reach();
    const double limit = std::min(reach * reach * kOutward, std::numeric_limits<double>::max());
    std::uint64_t hits = at_most(squared, BoxTree::kWidth, limit) & ~except;
    for (; hits != 0; hits &= hits - 1)
    {
      const auto k = hwy::Num0BitsBelowLS1Bit_Nonzero64(hits);
      const std::int32_t child = node.child[k];
      if (child >= 0)
      {
        stack[top++] = child;
      }
      else
      {
        if (!this->is_settled(-1 - child))
        {
          this->collect(-1 - child, squared[k]);
        }
      }
    }
  };
  // What begin() passed on its way, the nearest first.
  for (int k = this->Depth - 1; k >= 0; --k)
  {
    const Visit& visit = this->Path[k];
    take(nodes[visit.node], visit.squared, visit.followed);
    while (top > 0)
    {
      const BoxTree::Node& node = nodes[stack[--top]];
      HWY_ALIGN double squared[BoxTree::kWidth];
      this->box_distances(node, squared);
      take(node, squared, 0);
    }
  }
}

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
  this->Begun = query.index == this->First ? query.index : -1; // elsewhere a better start may be known
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

void Finder::collect(std::int32_t index, double squared)
{
  const PieceQuery query = this->at(index);
  const Piece& piece = *query.piece;
  const PieceShape& shape = *piece.shape;
  const Level level = this->reach_of(query);
  double* f = this->coefficients(0, shape.form_size);
  const double least = this->form(query, level.constant - level.margin, f);
  if (this->excludes(least))
  {
    return;
  }
  // F = w²(|S − P|² − T) ≥ least. Of a large flat piece the box may say more.
  const double bound = std::max(squared / kOutward,
    level.level + least / (least < 0.0 ? piece.least_weight : piece.greatest_weight));
  this->Finds.candidates.push_back({ index, bound });
  // The corners are points of the piece.
  const double* weights = piece.forms + 4 * shape.form_size;
  for (int corner = 0; corner < 4; ++corner)
  {
    const int row = corner / 2 * (shape.rows - 1);
    const int column = corner % 2 * (shape.columns - 1);
    const int k = row * shape.stride + column;
    this->bound_by(query, { { corner / 2 * 1.0, corner % 2 * 1.0 } },
      (shape.rational ? f[k] / weights[k] : f[k]) + level.level + 2.0 * level.margin);
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
  // Beyond this nothing is of interest, whatever the margin of the piece.
  const double reach = this->reach();
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
    const PieceShape& shape = *query.piece->shape;
    double* f = this->coefficients(0, shape.form_size);
    const double least = this->form(query, level.constant - level.margin, f);
    if (!this->excludes(least))
    {
      this->wait_for(query, start_of(shape, f, least));
      return true;
    }
  }
  this->Next = candidates.size();
  this->descend_from_nearest();
  return false;
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
  const double tolerance = std::min(kPartOfBlock * this->Query.tolerance, foot.distance);
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

// The rest of Finder: its proof.
#include "footpoint/search/piece_proof-inl.h"

HWY_BEFORE_NAMESPACE();
namespace footpoint
{
namespace HWY_NAMESPACE
{

void find_nearest(const SearchStructure& structure, const CertifiedQuery& query,
  SearchWorkspace& workspace, CertifiedAnswer& answer)
{
  Finder finder(structure, query, 0, workspace, answer);
  for (bool waits = finder.start(); waits; waits = finder.go_on())
  {
    take_plain_steps(finder.pending());
  }
  finder.finish();
}

/// Searches that wait for descents: those on the same piece are made together, then each search goes on.
void find_all_nearest(const SearchStructure& structure, const CertifiedQuery* queries, int count,
  SearchWorkspace& workspace, CertifiedAnswer* answers)
{
  alignas(Finder) unsigned char memory[CertifiedSearch::kTogether * sizeof(Finder)];
  Finder* waiting[CertifiedSearch::kTogether];
  int number = 0;
  for (int k = 0; k < count; ++k)
  {
    Finder* finder =
      new (memory + k * sizeof(Finder)) Finder(structure, queries[k], k, workspace, answers[k]);
    if (finder->start())
    {
      waiting[number++] = finder;
    }
    else
    {
      finder->finish();
    }
  }
  while (number > 0)
  {
    const auto piece_of = [](Finder* finder) { return finder->pending().query.index; };
    std::sort(waiting, waiting + number,
      [&](Finder* a, Finder* b) { return std::make_pair(piece_of(a), a) < std::make_pair(piece_of(b), b); });
    for (int first = 0; first < number;)
    {
      Descent* packet[Lanes::kCount];
      int size = 0;
      do
      {
        packet[size] = &waiting[first + size]->pending();
        ++size;
      } while (size < Lanes::kCount && first + size < number &&
        piece_of(waiting[first + size]) == packet[0]->query.index);
      take_plain_steps(packet, size);
      first += size;
    }
    int left = 0;
    for (int k = 0; k < number; ++k)
    {
      Finder* finder = waiting[k];
      if (finder->go_on())
      {
        waiting[left++] = finder;
      }
      else
      {
        finder->finish();
      }
    }
    number = left;
  }
}

} // namespace HWY_NAMESPACE
} // namespace footpoint
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace footpoint
{
namespace
{
HWY_EXPORT(find_nearest);
HWY_EXPORT(find_all_nearest);
}

CertifiedSearch::CertifiedSearch(DistanceForms forms)
  : Structure(std::move(forms))
{
}

void CertifiedSearch::find(
  const CertifiedQuery& query, SearchWorkspace& workspace, CertifiedAnswer& answer) const
{
  workspace.finds.resize(std::max<std::size_t>(workspace.finds.size(), 1));
  HWY_DYNAMIC_DISPATCH(find_nearest)(this->Structure, query, workspace, answer);
}

void CertifiedSearch::find(const CertifiedQuery* queries, int count, SearchWorkspace& workspace,
  CertifiedAnswer* answers) const
{
  workspace.finds.resize(kTogether);
  HWY_DYNAMIC_DISPATCH(find_all_nearest)(this->Structure, queries, count, workspace, answers);
}

} // namespace footpoint

#endif
