// SPDX-License-Identifier: BSD-3-Clause

// Compiled once for each set of vector instructions; the best that the processor has is taken at run
// time. SSSE3 and the extensions of AVX-512 would add nothing to SSE4 and AVX-512 here.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "footpoint/search/certified_search.cpp"
#include <hwy/foreach_target.h>

#include "footpoint/search/better_foot.h"
#include "footpoint/search/certified_search.h"
#include "footpoint/search/piece_descent-inl.h"

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace footpoint
{
namespace HWY_NAMESPACE
{
namespace
{

namespace hn = hwy::HWY_NAMESPACE;

/// Cells that one query may look at, and how often one of them may be halved.
constexpr int kMostCells = 20000;
constexpr int kMostHalvings = 100;

/// Which of up to 64 numbers are at most a limit, one bit each.
HWY_INLINE std::uint64_t at_most(const double* values, int count, double limit)
{
  const hn::CappedTag<double, 8> tag;
  const int lanes = static_cast<int>(hn::Lanes(tag));
  const auto wanted = hn::Set(tag, limit);
  std::uint64_t result = 0;
  for (int k = 0; k < count; k += lanes)
  {
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(tag, hn::Le(hn::LoadU(tag, values + k), wanted), bits);
    result |= static_cast<std::uint64_t>(bits[0]) << k;
  }
  return result;
}

/// Ranges of the first and second differences of the coefficients of F.
struct Differences
{
  double least_u, greatest_u, least_v, greatest_v;
  double least_uu, least_vv, greatest_uv;
  double greatest; ///< of all coefficients, by magnitude
};

/// All that one query needs, over all pieces.
class Finder
{
public:
  Finder(const DistanceForms& forms, const BoxTree& tree, const CertifiedQuery& query,
    SearchWorkspace& workspace, CertifiedAnswer& answer)
    : Forms(forms)
    , Tree(tree)
    , Query(query)
    , Workspace(workspace)
    , Answer(answer)
  {
    for (int k = 0; k < 3; ++k)
    {
      this->P[k] = query.point(k);
    }
    this->Bound = query.limit;
    this->SquaredBound = query.limit * query.limit;
  }

  void run()
  {
    this->Answer.count = 0;
    this->Workspace.candidates.clear();
    this->Workspace.survivors.clear();
    if (!this->Tree.nodes().empty())
    {
      this->seed();
      this->collect();
      this->descend_on_candidates();
    }
    this->Answer.certified = this->prove_all();
  }

private:
  bool found() const { return this->Answer.count > 0; }
  const PieceFoot& best() const { return this->Answer.feet[0]; }

  double tie() const { return tie_tolerance(this->best().distance, this->Query.size); }

  /// Distance up to which feet are of interest.
  double reach() const
  {
    const double best = this->found() ? this->best().distance + this->tie() : kInfinity;
    return std::min(best, this->Bound);
  }

  PieceQuery at(std::int32_t index) const
  {
    PieceQuery query;
    query.piece = &this->Forms.pieces()[index];
    query.index = index;
    for (int k = 0; k < 3; ++k)
    {
      query.p[k] = this->P[k] - query.piece->origin[k];
    }
    return query;
  }

  // === The distance form ===

  /// |P|² − T for T the square of the best distance, without the cancellation of large numbers, and
  /// the bound of the error of any coefficient of F, over W2.
  struct Level
  {
    double constant;
    double margin;
    double level; ///< T
  };
  /// With the best foot's distance for √T, or any other.
  Level level_of(const PieceQuery& query) const;
  Level level_of(const PieceQuery& query, double distance) const;
  /// Level for dropping what is farther than reach().
  Level reach_of(const PieceQuery& query) const;

  /// Computes the coefficients of F into `target`; returns the smallest one.
  double form(const PieceQuery& query, double constant, double* target) const;
  static Pair start_of(const PieceShape& shape, const double* coefficients, double least);
  static Differences differences(const PieceShape& shape, const double* f);
  static double halve(const PieceShape& shape, const double* f, int direction, int end, double* to);

  // === The search ===

  void box_distances(const BoxTree::Node& node, double* squared) const;
  /// Goes to the piece whose box seems nearest, for a first bound.
  void seed();
  /// Finds the pieces that may hold something within reach.
  void collect();
  void descend_on_candidates();
  void collect(std::int32_t index);
  /// The nearest corner of a piece bounds the distance from above.
  void bound_by_corners(const PieceQuery& query, const double* f, double level, double margin);
  /// Whether the smallest coefficient of a piece says that it holds nothing within reach.
  bool excludes(double least) const { return this->Bound < kInfinity && least >= 0.0; }
  void descend_from(const PieceQuery& query, const Pair& start);
  PieceFoot foot_of(const PieceQuery& query, const Place& place, int iterations) const;
  /// Keeps a foot if it is of interest; true where it is nearer than all before by more than a tie.
  bool keep(const PieceFoot& foot);

  // === The proof ===

  bool prove_all();
  /// Differences of coefficients beyond these have their sign in exact numbers, and for T = d² as
  /// well as for T = d² − Slack. \param error of the coefficients, from halving
  double least_first_difference(double error) const
  {
    return 2.0 * (this->Margin + error) + this->Shift;
  }
  double least_second_difference(double error) const
  {
    return 4.0 * (this->Margin + error + this->Shift);
  }

  enum class Verdict
  {
    Proved,
    Open,
    Improved
  };
  Verdict prove(const PieceFoot& survivor);
  bool improves_at_corner(
    const PieceQuery& query, const SearchWorkspace::Cell& cell, const double* f);
  Verdict prove_side(const PieceQuery& query, const Range& cell, const double* f, double error,
    int i, int end);
  /// The tangent plane of F at the minimum of the range.
  Verdict support(const PieceQuery& query, const Range& range, const Pair& start);
  bool supports(const PieceQuery& query, const Range& range, const PieceFoot& place) const;

  double* coefficients(std::size_t k, int size)
  {
    const std::size_t needed = (k + 1) * size + 16;
    if (this->Workspace.coefficients.size() < needed)
    {
      this->Workspace.coefficients.resize(2 * needed);
    }
    return this->Workspace.coefficients.data() + k * size;
  }

  const DistanceForms& Forms;
  const BoxTree& Tree;
  const CertifiedQuery& Query;
  SearchWorkspace& Workspace;
  CertifiedAnswer& Answer;
  double P[3];
  double Bound = kInfinity;  ///< a point as near as this is known, or nothing farther is sought
  double SquaredBound = kInfinity;
  /// The way that seed() went down the tree.
  struct Visit
  {
    HWY_ALIGN double squared[BoxTree::kWidth];
    std::int32_t node;
    int followed;
  };
  Visit Path[16];
  int Depth = 0;
  std::int32_t Nearest = -1; ///< the piece whose corner gave Bound, and the corner
  Pair Corner{ { 0.0, 0.0 } };
  int Cells = 0;
  // Of the piece that is being proved:
  double Slack = 0.0;   ///< d² − (d − tolerance)²
  double Margin = 0.0;  ///< bound of the error of a coefficient of the piece
  double Shift = 0.0;   ///< bound of what Slack adds to a coefficient beyond a constant
  const PieceFoot* Known = nullptr;
};

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
  if (!this->found() || this->Bound < this->best().distance)
  {
    return this->level_of(query, this->Bound < kInfinity ? this->Bound : 0.0);
  }
  Level level = this->level_of(query);
  const double tie = this->tie() * (2.0 * this->best().distance + this->tie());
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
  int k = 0;
  std::uint64_t bits = 0;
  for (; bits == 0 && k < shape.form_size; k += 64)
  {
    bits = at_most(coefficients + k, std::min(64, shape.form_size - k), least);
  }
  k = bits == 0 ? 0 : k - 64 + static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero64(bits));
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

Differences Finder::differences(const PieceShape& shape, const double* f)
{
  const hn::CappedTag<double, 8> tag;
  const int lanes = static_cast<int>(hn::Lanes(tag));
  const auto infinite = hn::Set(tag, kInfinity);
  const auto minus = hn::Set(tag, -kInfinity);
  auto least_u = infinite;
  auto greatest_u = minus;
  auto least_v = infinite;
  auto greatest_v = minus;
  auto least_uu = infinite;
  auto least_vv = infinite;
  auto greatest_uv = hn::Zero(tag);
  auto greatest = hn::Zero(tag);
  const int stride = shape.stride;
  for (int j = 0; j < shape.columns; j += lanes)
  {
    const auto has_next =
      hn::FirstN(tag, static_cast<std::size_t>(std::clamp(shape.columns - 1 - j, 0, lanes)));
    const auto has_second =
      hn::FirstN(tag, static_cast<std::size_t>(std::clamp(shape.columns - 2 - j, 0, lanes)));
    auto before_u = hn::Zero(tag);
    auto before_v = hn::Zero(tag);
    auto before = hn::Zero(tag);
    for (int i = 0; i < shape.rows; ++i)
    {
      const double* row = f + i * stride + j;
      const auto here = hn::LoadU(tag, row);
      const auto next = hn::LoadU(tag, row + 1);
      const auto second = hn::LoadU(tag, row + 2);
      greatest = hn::Max(greatest, hn::Abs(here));
      const auto v = hn::Sub(next, here);
      const auto vv = hn::Sub(hn::Sub(second, next), v);
      least_v = hn::Min(least_v, hn::IfThenElse(has_next, v, infinite));
      greatest_v = hn::Max(greatest_v, hn::IfThenElse(has_next, v, minus));
      least_vv = hn::Min(least_vv, hn::IfThenElse(has_second, vv, infinite));
      if (i > 0)
      {
        const auto u = hn::Sub(here, before);
        least_u = hn::Min(least_u, u);
        greatest_u = hn::Max(greatest_u, u);
        const auto uv = hn::Abs(hn::Sub(v, before_v));
        greatest_uv = hn::Max(greatest_uv, hn::IfThenElseZero(has_next, uv));
        if (i > 1)
        {
          least_uu = hn::Min(least_uu, hn::Sub(u, before_u));
        }
        before_u = u;
      }
      before = here;
      before_v = v;
    }
  }
  return { hn::GetLane(hn::MinOfLanes(tag, least_u)), hn::GetLane(hn::MaxOfLanes(tag, greatest_u)),
    hn::GetLane(hn::MinOfLanes(tag, least_v)), hn::GetLane(hn::MaxOfLanes(tag, greatest_v)),
    hn::GetLane(hn::MinOfLanes(tag, least_uu)), hn::GetLane(hn::MinOfLanes(tag, least_vv)),
    hn::GetLane(hn::MaxOfLanes(tag, greatest_uv)), hn::GetLane(hn::MaxOfLanes(tag, greatest)) };
}

/// The coefficients over one half of a cell; returns the smallest one.
double Finder::halve(const PieceShape& shape, const double* f, int direction, int end, double* to)
{
  const hn::CappedTag<double, 8> tag;
  const int lanes = static_cast<int>(hn::Lanes(tag));
  const std::vector<double>& weights = shape.halving[direction][end];
  auto least = hn::Set(tag, kInfinity);
  for (int i = 0; i < shape.rows; ++i)
  {
    for (int j = 0; j < shape.stride; j += lanes)
    {
      auto sum = hn::Zero(tag);
      if (direction == 0)
      {
        const int first = end == 0 ? 0 : i;
        const int last = end == 0 ? i : shape.rows - 1;
        for (int k = first; k <= last; ++k)
        {
          sum = hn::MulAdd(hn::Set(tag, weights[k * shape.rows + i]),
            hn::LoadU(tag, f + k * shape.stride + j), sum);
        }
      }
      else
      {
        for (int k = 0; k < shape.columns; ++k)
        {
          sum = hn::MulAdd(hn::Set(tag, f[i * shape.stride + k]),
            hn::LoadU(tag, weights.data() + k * shape.stride + j), sum);
        }
      }
      hn::StoreU(sum, tag, to + i * shape.stride + j);
      least = hn::Min(least, sum);
    }
  }
  return hn::GetLane(hn::MinOfLanes(tag, least));
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

void Finder::seed()
{
  const std::vector<BoxTree::Node>& nodes = this->Tree.nodes();
  const hn::CappedTag<double, 8> tag;
  const hn::Rebind<float, decltype(tag)> single;
  const int lanes = static_cast<int>(hn::Lanes(tag));
  /// Weight of the distance of the box's middle: it decides between boxes that hold the point.
  const auto slight = hn::Set(tag, 1e-3);
  const auto half = hn::Set(tag, 0.5);
  std::int32_t child = 0;
  do
  {
    const BoxTree::Node& node = nodes[child];
    Visit& visit = this->Path[this->Depth++];
    visit.node = child;
    this->box_distances(node, visit.squared);
    HWY_ALIGN double score[BoxTree::kWidth];
    auto least = hn::Set(tag, kInfinity);
    for (int k = 0; k < BoxTree::kWidth; k += lanes)
    {
      auto middle = hn::Zero(tag);
      for (int i = 0; i < 3; ++i)
      {
        const auto lower = hn::PromoteTo(tag, hn::LoadU(single, node.lower[i] + k));
        const auto upper = hn::PromoteTo(tag, hn::LoadU(single, node.upper[i] + k));
        const auto way = hn::NegMulAdd(half, hn::Add(lower, upper), hn::Set(tag, this->P[i]));
        middle = hn::MulAdd(way, way, middle);
      }
      const auto value = hn::MulAdd(slight, middle, hn::LoadU(tag, visit.squared + k));
      hn::StoreU(value, tag, score + k);
      least = hn::Min(least, value);
    }
    const double value = hn::GetLane(hn::MinOfLanes(tag, least));
    // The first child where rounding to nothing comparable leaves no bit set.
    const std::uint64_t bits = at_most(score, BoxTree::kWidth, value) | 0x80;
    visit.followed = static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero64(bits));
    child = node.child[visit.followed];
  } while (child >= 0);

  const std::int32_t index = -1 - child;
  const PieceQuery query = this->at(index);
  const PieceShape& shape = *query.piece->shape;
  const Level level = this->reach_of(query);
  double* f = this->coefficients(0, shape.form_size);
  const double least = this->form(query, level.constant - level.margin, f);
  if (this->excludes(least))
  {
    return;
  }
  this->bound_by_corners(query, f, level.level, level.margin);
  if (least + level.level < 0.25 * this->Bound * this->Bound)
  {
    this->descend_from(query, start_of(shape, f, least));
  }
  else
  {
    this->Workspace.candidates.push_back({ index, least + level.level });
  }
}

void Finder::bound_by_corners(
  const PieceQuery& query, const double* f, double level, double margin)
{
  const PieceShape& shape = *query.piece->shape;
  const double* weights = query.piece->forms + 4 * shape.form_size;
  for (int corner = 0; corner < 4; ++corner)
  {
    const int row = corner / 2 * (shape.rows - 1);
    const int column = corner % 2 * (shape.columns - 1);
    const int k = row * shape.stride + column;
    const double squared = (shape.rational ? f[k] / weights[k] : f[k]) + level + 2.0 * margin;
    if (squared < this->SquaredBound)
    {
      this->SquaredBound = squared;
      this->Bound = std::sqrt(std::max(squared, 0.0)) * (1.0 + 4.0 * kRounding);
      this->Nearest = query.index;
      this->Corner = { { corner / 2 * 1.0, corner % 2 * 1.0 } };
    }
  }
}

void Finder::collect()
{
  const std::vector<BoxTree::Node>& nodes = this->Tree.nodes();
  // Each level leaves at most seven siblings behind; 2^32 boxes are eleven levels.
  std::int32_t stack[BoxTree::kWidth * 16];
  int top = 0;
  auto take = [&](const BoxTree::Node& node, const double* squared, std::uint64_t except)
  {
    // The distance of a box is rounded a few times, in relative terms.
    constexpr double kOutward = 1.0 + 32.0 * kRounding;
    const double reach = this->reach();
    const double limit = std::min(reach * reach * kOutward, std::numeric_limits<double>::max());
    std::uint64_t hits = at_most(squared, BoxTree::kWidth, limit) & ~except;
    for (; hits != 0; hits &= hits - 1)
    {
      const std::int32_t child = node.child[hwy::Num0BitsBelowLS1Bit_Nonzero64(hits)];
      if (child >= 0)
      {
        stack[top++] = child;
      }
      else
      {
        this->collect(-1 - child);
      }
    }
  };
  // What seed() passed on its way, the nearest first.
  for (int k = this->Depth - 1; k >= 0; --k)
  {
    const Visit& visit = this->Path[k];
    take(nodes[visit.node], visit.squared, std::uint64_t(1) << visit.followed);
    while (top > 0)
    {
      const BoxTree::Node& node = nodes[stack[--top]];
      HWY_ALIGN double squared[BoxTree::kWidth];
      this->box_distances(node, squared);
      take(node, squared, 0);
    }
  }
}

void Finder::collect(std::int32_t index)
{
  const PieceQuery query = this->at(index);
  const PieceShape& shape = *query.piece->shape;
  const Level level = this->reach_of(query);
  double* f = this->coefficients(0, shape.form_size);
  const double least = this->form(query, level.constant - level.margin, f);
  if (this->excludes(least))
  {
    return;
  }
  this->Workspace.candidates.push_back({ index, least + level.level });
  this->bound_by_corners(query, f, level.level, level.margin);
}

void Finder::descend_on_candidates()
{
  std::vector<SearchWorkspace::Candidate>& candidates = this->Workspace.candidates;
  if (candidates.size() > 1)
  {
    std::sort(candidates.begin(), candidates.end(),
      [](const SearchWorkspace::Candidate& a, const SearchWorkspace::Candidate& b)
      { return a.bound != b.bound ? a.bound < b.bound : a.piece < b.piece; });
  }
  for (const SearchWorkspace::Candidate& candidate : candidates)
  {
    const PieceQuery query = this->at(candidate.piece);
    const PieceShape& shape = *query.piece->shape;
    const Level level = this->reach_of(query);
    if (!shape.rational && candidate.bound >= level.level + 2.0 * level.margin)
    {
      continue;
    }
    double* f = this->coefficients(0, shape.form_size);
    const double least = this->form(query, level.constant - level.margin, f);
    if (this->excludes(least))
    {
      continue;
    }
    this->descend_from(query, start_of(shape, f, least));
  }
  if (!this->found() && this->Nearest >= 0)
  {
    // No descent came as near as that corner.
    this->descend_from(this->at(this->Nearest), this->Corner);
  }
}

void Finder::descend_from(const PieceQuery& query, const Pair& start)
{
  Place place;
  place.t = start;
  const int iterations = descend(query, kWholePiece, place);
  this->Workspace.survivors.push_back(this->foot_of(query, place, iterations));
  this->keep(this->Workspace.survivors.back());
}

PieceFoot Finder::foot_of(const PieceQuery& query, const Place& place, int iterations) const
{
  PieceFoot foot;
  foot.piece = query.index;
  foot.t = place.t;
  for (int k = 0; k < 3; ++k)
  {
    foot.position[k] = query.piece->origin[k] + place.jet[k][0];
    foot.offset[k] = place.r[k];
    foot.first[0][k] = place.jet[k][1];
    foot.first[1][k] = place.jet[k][2];
  }
  foot.distance = std::sqrt(place.squared);
  foot.gradient = place.gradient;
  foot.hessian = place.hessian;
  foot.metric = { { place.metric[0], place.metric[1] } };
  const bool rational = query.piece->shape->rational;
  foot.weight = { { rational ? place.jet[3][0] : 1.0, rational ? place.jet[3][1] : 0.0,
    rational ? place.jet[3][2] : 0.0 } };
  foot.iterations = iterations;
  return foot;
}

bool Finder::keep(const PieceFoot& foot)
{
  if (!(foot.distance <= this->reach()))
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

// === The proof ===

bool Finder::prove_all()
{
  if (this->found() && this->best().distance <= this->Query.tolerance)
  {
    return true; // no distance is negative
  }
  bool proved = true;
  for (std::size_t k = 0; k < this->Workspace.survivors.size(); ++k)
  {
    const PieceFoot survivor = this->Workspace.survivors[k];
    Verdict verdict = Verdict::Improved;
    while (verdict == Verdict::Improved)
    {
      verdict = this->prove(survivor);
    }
    proved = proved && verdict == Verdict::Proved;
  }
  return proved;
}

Finder::Verdict Finder::prove(const PieceFoot& survivor)
{
  const PieceQuery query = this->at(survivor.piece);
  const Piece& piece = *query.piece;
  const PieceShape& shape = *piece.shape;
  const Level level =
    this->found() ? this->level_of(query) : this->level_of(query, this->Query.limit);
  const double distance = this->found() ? this->best().distance : this->Query.limit;
  const double tolerance = std::min(this->Query.tolerance, distance);
  this->Slack = this->found() ? tolerance * (2.0 * distance - tolerance) : 0.0;
  this->Margin = level.margin * piece.greatest_weight;
  this->Shift = shape.rational ? this->Slack * piece.greatest_weight : 0.0;
  this->Known = &survivor;
  const int size = shape.form_size;
  const bool has_u = shape.rows > 1;
  const bool has_v = shape.columns > 1;
  const double n = shape.rows - 1;
  const double m = shape.columns - 1;
  std::vector<SearchWorkspace::Cell>& cells = this->Workspace.cells;
  cells.clear();
  const double least = this->form(
    query, level.constant + this->Slack - level.margin, this->coefficients(0, size));
  cells.push_back({ { { 0.0, 0.0 } }, { { 1.0, 1.0 } }, least, 0.0, 0 });
  bool open = false;
  while (!cells.empty())
  {
    const SearchWorkspace::Cell cell = cells.back();
    const std::size_t at = cells.size() - 1;
    if (cell.least >= cell.error)
    {
      cells.pop_back();
      continue;
    }
    if (++this->Cells > kMostCells)
    {
      return Verdict::Open;
    }
    double* f = this->coefficients(at, size);
    if (this->improves_at_corner(query, cell, f))
    {
      return Verdict::Improved;
    }
    const Differences d = differences(shape, f);
    const double first = this->least_first_difference(cell.error);
    const double second = this->least_second_difference(cell.error);
    const Range range{ cell.lower, cell.upper };
    Verdict verdict = Verdict::Open;
    const double uv = d.greatest_uv + second;
    const bool convex = (!has_u || d.least_uu > second) && (!has_v || d.least_vv > second) &&
      (!has_u || !has_v ||
        // (n(n−1) uu)(m(m−1) vv) > (n m uv)²
        (d.least_uu - second) * (d.least_vv - second) * (n - 1.0) * (m - 1.0) > n * m * uv * uv);
    if (convex)
    {
      verdict = this->support(query, range, this->Known->t);
    }
    for (int i = 0; i < 2 && verdict == Verdict::Open; ++i)
    {
      // Monotone: only one side matters.
      const double lowest = i == 0 ? d.least_u : d.least_v;
      const double highest = i == 0 ? d.greatest_u : d.greatest_v;
      if (shape.degree[i] > 0 && (lowest > first || highest < -first))
      {
        verdict = this->prove_side(query, range, f, cell.error, i, lowest > first ? 0 : 1);
        break;
      }
    }
    if (verdict == Verdict::Improved)
    {
      return verdict;
    }
    if (verdict == Verdict::Proved)
    {
      cells.pop_back();
      continue;
    }
    if (cell.depth >= kMostHalvings)
    {
      // Not proved; but nothing that a descent from here can find is passed over.
      if (this->support(query, range, cell.lower) == Verdict::Improved)
      {
        return Verdict::Improved;
      }
      open = true;
      cells.pop_back();
      continue;
    }
    // Halved where the slope changes more.
    const double change_u = has_u ? (d.greatest_u - d.least_u) * n : -1.0;
    const double change_v = has_v ? (d.greatest_v - d.least_v) * m : -1.0;
    const int cut = change_u > change_v ? 0 : 1;
    const int terms = cut == 0 ? shape.rows : shape.columns;
    const double middle = 0.5 * (cell.lower[cut] + cell.upper[cut]);
    SearchWorkspace::Cell low = cell;
    SearchWorkspace::Cell high = cell;
    low.error = high.error = cell.error + terms * kRounding * d.greatest;
    low.depth = high.depth = cell.depth + 1;
    low.upper[cut] = middle;
    high.lower[cut] = middle;
    // The upper half goes on top of the lower one, which takes the place of the whole.
    double* scratch = this->coefficients(at + 2, size); // the last one first: it may move the others
    double* upper = this->coefficients(at + 1, size);
    f = this->coefficients(at, size);
    high.least = halve(shape, f, cut, 1, upper);
    low.least = halve(shape, f, cut, 0, scratch);
    std::copy(scratch, scratch + size, f);
    cells.back() = low;
    cells.push_back(high);
  }
  return open ? Verdict::Open : Verdict::Proved;
}

/// The coefficients at the corners are values of F: where one is negative the corner itself is nearer
/// than the best foot, and a descent from there finds what is nearer still.
bool Finder::improves_at_corner(
  const PieceQuery& query, const SearchWorkspace::Cell& cell, const double* f)
{
  const PieceShape& shape = *query.piece->shape;
  double least = -2.0 * (this->Margin + cell.error);
  int found = -1;
  for (int corner = 0; corner < 4; ++corner)
  {
    const double value =
      f[corner / 2 * (shape.rows - 1) * shape.stride + corner % 2 * (shape.columns - 1)];
    if (value < least)
    {
      least = value;
      found = corner;
    }
  }
  if (found < 0)
  {
    return false;
  }
  Place place;
  place.t = { { (found / 2 == 0 ? cell.lower : cell.upper)[0],
    (found % 2 == 0 ? cell.lower : cell.upper)[1] } };
  const int iterations = descend(query, kWholePiece, place);
  return this->keep(this->foot_of(query, place, iterations));
}

/// The same along one side of a cell, at one end of direction i.
Finder::Verdict Finder::prove_side(const PieceQuery& query, const Range& cell, const double* f,
  double error, int i, int end)
{
  const PieceShape& shape = *query.piece->shape;
  const int direction = 1 - i;
  const int n = direction == 0 ? shape.rows - 1 : shape.columns - 1;
  Range range = cell;
  (end == 0 ? range.upper : range.lower)[i] = (end == 0 ? range.lower : range.upper)[i];
  struct Line
  {
    double f[64];
    double lower, upper, error;
  };
  Line stack[kMostHalvings + 2];
  int top = 0;
  for (int k = 0; k <= n; ++k)
  {
    const int row = direction == 0 ? k : end * (shape.rows - 1);
    const int column = direction == 1 ? k : end * (shape.columns - 1);
    stack[0].f[k] = f[row * shape.stride + column];
  }
  stack[0].lower = range.lower[direction];
  stack[0].upper = range.upper[direction];
  stack[0].error = error;
  ++top;
  bool open = false;
  while (top > 0)
  {
    Line& line = stack[top - 1];
    double least = line.f[0];
    double least_first = kInfinity;
    double greatest_first = -kInfinity;
    double least_second = kInfinity;
    double greatest = std::abs(line.f[0]);
    for (int k = 1; k <= n; ++k)
    {
      const double step = line.f[k] - line.f[k - 1];
      least = std::min(least, line.f[k]);
      greatest = std::max(greatest, std::abs(line.f[k]));
      least_first = std::min(least_first, step);
      greatest_first = std::max(greatest_first, step);
      if (k > 1)
      {
        least_second = std::min(least_second, step - (line.f[k - 1] - line.f[k - 2]));
      }
    }
    if (least >= line.error)
    {
      --top;
      continue;
    }
    if (++this->Cells > kMostCells)
    {
      return Verdict::Open;
    }
    Range here = range;
    here.lower[direction] = line.lower;
    here.upper[direction] = line.upper;
    const double first = this->least_first_difference(line.error);
    const double second = this->least_second_difference(line.error);
    Verdict verdict = Verdict::Open;
    if (n == 0 || least_first > first || greatest_first < -first)
    {
      here.lower[direction] = here.upper[direction] =
        least_first > first ? line.lower : line.upper;
      verdict = this->support(query, here, here.lower);
    }
    else if (n == 1 || least_second > second)
    {
      verdict = this->support(query, here, this->Known->t);
    }
    if (verdict == Verdict::Improved)
    {
      return verdict;
    }
    if (verdict == Verdict::Proved)
    {
      --top;
      continue;
    }
    if (top > kMostHalvings)
    {
      open = true;
      --top;
      continue;
    }
    Line& upper = stack[top];
    const double middle = 0.5 * (line.lower + line.upper);
    upper.lower = middle;
    upper.upper = line.upper;
    line.upper = middle;
    upper.error = line.error = line.error + n * kRounding * greatest;
    std::copy(line.f, line.f + n + 1, upper.f);
    for (int level = 1; level <= n; ++level)
    {
      // upper.f becomes the upper half, its first entries are those of the lower one.
      for (int k = 0; k <= n - level; ++k)
      {
        upper.f[k] = 0.5 * (upper.f[k] + upper.f[k + 1]);
      }
      line.f[level] = upper.f[0];
    }
    ++top;
  }
  return open ? Verdict::Open : Verdict::Proved;
}

/// \pre F is convex over the range, or the range is a point.
Finder::Verdict Finder::support(const PieceQuery& query, const Range& range, const Pair& start)
{
  const PieceFoot& known = *this->Known;
  bool inside = true;
  Place place;
  for (int i = 0; i < 2; ++i)
  {
    place.t[i] = std::min(std::max(start[i], range.lower[i]), range.upper[i]);
    inside = inside && place.t[i] == known.t[i];
  }
  if (inside && this->supports(query, range, known))
  {
    return Verdict::Proved;
  }
  const int iterations = descend(query, range, place);
  const PieceFoot foot = this->foot_of(query, place, iterations);
  if (!inside && foot.distance <= this->reach())
  {
    Place whole;
    whole.t = place.t;
    const int more = descend(query, kWholePiece, whole);
    if (this->keep(this->foot_of(query, whole, iterations + more)))
    {
      return Verdict::Improved;
    }
  }
  return this->supports(query, range, foot) ? Verdict::Proved : Verdict::Open;
}

/// Whether the tangent plane of F = w² (|S − P|² − d²) at a place stays above what is allowed.
bool Finder::supports(const PieceQuery& query, const Range& range, const PieceFoot& place) const
{
  const Piece& piece = *query.piece;
  double excess;
  if (this->found())
  {
    // Without the cancellation of large numbers: (S − f)·(S + f − 2P).
    const PieceFoot& foot = this->best();
    excess = 0.0;
    for (int k = 0; k < 3; ++k)
    {
      excess += (place.position[k] - foot.position[k]) * (place.offset[k] + foot.offset[k]);
    }
  }
  else
  {
    excess = place.distance * place.distance - this->Query.limit * this->Query.limit;
  }
  const double w = place.weight[0];
  double value = w * w * excess;
  for (int i = 0; i < 2; ++i)
  {
    const double slope =
      2.0 * (w * w * place.gradient[i] + w * place.weight[1 + i] * excess);
    const double way = slope > 0.0 ? range.lower[i] - place.t[i] : range.upper[i] - place.t[i];
    value += way == 0.0 ? 0.0 : slope * way;
  }
  return value >= -this->Slack * piece.least_weight;
}

} // namespace

void find_nearest(const DistanceForms& forms, const BoxTree& tree, const CertifiedQuery& query,
  SearchWorkspace& workspace, CertifiedAnswer& answer)
{
  Finder(forms, tree, query, workspace, answer).run();
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
}

CertifiedSearch::CertifiedSearch(DistanceForms forms)
  : Forms(std::move(forms))
  , Tree(this->Forms.boxes())
{
}

void CertifiedSearch::find(
  const CertifiedQuery& query, SearchWorkspace& workspace, CertifiedAnswer& answer) const
{
  HWY_DYNAMIC_DISPATCH(find_nearest)(this->Forms, this->Tree, query, workspace, answer);
}

} // namespace footpoint

#endif
