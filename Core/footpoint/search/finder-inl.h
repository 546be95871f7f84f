// SPDX-License-Identifier: BSD-3-Clause

// Finder: all that one query needs. Its members are defined in piece_level-inl.h,
// piece_collection-inl.h, piece_search-inl.h and piece_proof-inl.h. Compiled once for each set of
// vector instructions (the guard of Highway's "-inl.h" headers).
#if defined(FOOTPOINT_FINDER_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FOOTPOINT_FINDER_INL_H
#undef FOOTPOINT_FINDER_INL_H
#else
#define FOOTPOINT_FINDER_INL_H
#endif

#include "footpoint/search/better_foot.h"
#include "footpoint/search/cell_form-inl.h"
#include "footpoint/search/certified_search.h"
#include "footpoint/search/distance_form-inl.h"
#include "footpoint/search/height_form-inl.h"
#include "footpoint/search/outline_form-inl.h"
#include "footpoint/search/piece_descent-inl.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace footpoint
{
namespace HWY_NAMESPACE
{
namespace
{

/// Cells of one piece that are halved by their coefficients: an ordinary piece needs fewer than
/// ten.
constexpr int kMostCells = 200;
/// Cells of one query that have their coefficients formed anew afterwards, some microseconds each;
/// and how many of these every piece may have even if others have used them up.
constexpr int kMostHardCells = 2000;
constexpr std::size_t kFewestHardCells = 64;
/// A cell of a trimmed piece is not cut narrower than this.
constexpr double kNarrow = 4.0;
/// How often a cell or a line may be halved by its coefficients.
constexpr int kMostHalvings = 100;

/// Newton's method is begun at once on the first piece if its box is nearer than this part of the
/// piece's size. Farther away another piece may well be nearer, and a bound is what is wanted.
constexpr double kNearPiece = 0.25;

/// 2^32 boxes are eight levels, and a last one that is not full.
constexpr int kMostLevels = 10;
/// Ways down the tree beside the first one, each to what is nearer by more than this factor of the
/// squared distance.
constexpr int kMostWaysDown = 3;
constexpr double kMuchNearer = 0.5;

/// Cells of a distance form that is cut at a foot.
constexpr int kMostCutCells = 48;
/// A distance form of more coefficients costs more than the descent that it may save.
constexpr int kMostOfForm = 40;

/// Memory for so many candidates or survivors is kept from query to query.
constexpr std::size_t kMostKept = 4096;
/// More candidates are sorted at once.
constexpr std::size_t kMostUnsorted = 32;
/// More than the margin of any piece, in squares of the coordinates: roundings of the highest
/// degree.
constexpr double kMostMargin = 1e-10;

/// So many pieces a walk passes at the most.
constexpr int kMostVisited = 4;

/// Which of the numbers of a node's children are at most a limit, one bit each.
HWY_INLINE unsigned at_most(const double* values, double limit)
{
  const hn::CappedTag<double, 8> tag; // whose bits are one byte
  const auto wanted = hn::Set(tag, limit);
  unsigned result = 0;
  for (int k = 0; k < BoxTree::kWidth; k += static_cast<int>(hn::Lanes(tag)))
  {
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(tag, hn::Le(hn::LoadU(tag, values + k), wanted), bits);
    result |= static_cast<unsigned>(bits[0]) << k;
  }
  return result;
}

/// The squared distance of a box is rounded a few times, in relative terms.
constexpr double kOutward = 1.0 + 32.0 * kRounding;

/// Edges of trimmed faces are proved for this part of the tolerance, so that what is left of it is
/// there for the faces (Documentation/CertifiedSearch.md).
constexpr double kPartOfEdges = 0.5;
/// And blocks for this part: when they are it is not known yet what the best foot may be off.
constexpr double kPartOfBlock = 0.5;

/// All that one query needs, over all pieces.
class Finder
{
public:
  /// \param number of the query among those under way
  Finder(const SearchStructure& structure, const CertifiedQuery& query, int number,
    SearchWorkspace& workspace, CertifiedAnswer& answer)
    : Structure(structure)
    , Query(query)
    , Workspace(workspace)
    , Finds(workspace.finds[static_cast<std::size_t>(number)])
    , Answer(answer)
  {
    for (int k = 0; k < 3; ++k)
    {
      this->P[k] = query.point(k);
    }
    // Centred coordinates are within the size.
    this->Rounding = 4.0 * kRounding * (3.0 * query.size + bound_of_length(this->P));
    this->Bound = query.limit;
    this->SquaredBound = query.limit * query.limit;
  }

  // A search asks for one descent after the other and is done when it asks for no more; several
  // searches can have their descents made together.

  /// Whether it waits for a descent.
  bool start();
  Descent& pending() { return this->Pending; }
  /// Goes on with the result of the descent; whether it waits for another one.
  bool go_on();
  /// The proof, when there is no more to wait for.
  void finish()
  {
    this->Answer.certified = this->prove_all();
    // Many queries are under way at once: what a few of them needed is given back.
    if (this->Finds.candidates.capacity() > kMostKept)
    {
      this->Finds.candidates = {};
    }
    if (this->Finds.survivors.capacity() > kMostKept)
    {
      this->Finds.survivors = {};
    }
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

  PieceQuery at(std::int32_t index) const { return query_at(this->Structure, this->P, index); }

  /// Whether a point of a piece counts: no trim loop leaves it out.
  static bool is_kept(const Piece& piece, const Pair& t)
  {
    return !piece.region ||
      piece.region->contains(
        piece.lower[0] + t[0] * piece.width[0], piece.lower[1] + t[1] * piece.width[1]);
  }

  /// Whether no point of a cell of a piece counts.
  static bool is_left_out(const Piece& piece, const Pair& lower, const Pair& upper)
  {
    auto local = [&piece](const Pair& t)
    {
      return Pair{ { piece.lower[0] + t[0] * piece.width[0],
        piece.lower[1] + t[1] * piece.width[1] } };
    };
    return piece.region &&
      piece.region->cover(local(lower), local(upper)) == TrimRegion::Cover::Outside;
  }

  // === The level of a distance form ===

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

  // === The search ===

  void box_distances(const BoxTree::Node& node, double* squared) const;
  struct Visit;
  /// A child of a visited node that is a piece.
  struct Leaf
  {
    int visit;
    int child;
    double squared; ///< distance of the box
  };
  int visit(std::int32_t index);
  Leaf go_down(std::int32_t child);
  /// Goes to the piece whose box seems nearest, for a first bound; whether a descent begins there.
  bool begin();
  bool begin_with(std::int32_t index, double squared);
  /// A descent goes on in the piece beside its own, if it leads there: what most begin with.
  bool walk_on();
  void end_walk();
  /// Takes the block of the best foot for searched if that is the nearest point of it.
  void settle();
  /// Whether nothing within reach is left to be found in a piece.
  bool is_settled(std::int32_t index) const
  {
    return index == this->Begun || this->in_block(index);
  }
  bool in_block(std::int32_t index) const
  {
    bool found = false;
    for (int k = 0; k < 9; ++k)
    {
      found |= this->Block.pieces[k] == index;
    }
    return found;
  }
  /// Finds the pieces that may hold something within reach.
  void collect();
  /// \param squared distance of the piece's box
  void collect(std::int32_t index, double squared);
  /// A point of a piece, if it is kept, bounds the distance from above.
  void bound_by_point(const PieceQuery& query, const Pair& t);
  /// \param squared distance of that point
  void bound_by(const PieceQuery& query, const Pair& t, double squared);
  /// Where the tangent plane of the piece's middle is nearest.
  Pair guess(const PieceQuery& query) const;
  /// Whether the outline of a piece says that it holds nothing within reach. \param start receives
  /// where to begin otherwise
  bool excludes_by_outline(const PieceQuery& query, const Level& level, Pair& start) const;
  /// The same by the height form about a point of it, or by the distance form cut there.
  bool excludes_from(const PieceQuery& query, const Level& level, const Pair& t);
  /// The next candidate, nearest first; whether there is one to descend on.
  bool next_candidate();
  void descend_from_nearest();
  void wait_for(const PieceQuery& query, const Pair& start);
  /// A minimum of a piece: a survivor, and a foot if it is of interest.
  void take(const PieceFoot& foot);
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
  /// Whether the distance form that the coefficients begin with is seen to be positive from a place
  /// on where it is nearly zero. The coefficients stay.
  bool is_positive_from(const PieceShape& shape, const Pair& t);
  /// Whether the height form of a piece about a minimum on it says that nothing is nearer.
  bool proves_by_height(const PieceQuery& query, const PieceFoot& survivor, double tolerance);
  /// By how much a height form's query may be another one than ours, from which its point is
  /// exactly as far away as computed: a few roundings of positions and of the query.
  double moved(const PieceQuery& query) const
  {
    return 32.0 * kRounding * (this->Query.size + bound_of_length(query.p));
  }
  /// Whether no point of a piece is nearer than a point of it by more than `allowed`, in squares.
  /// \param point, offset from the piece's origin and from the query
  bool is_above(const PieceQuery& query, const double* point, const double* offset, const Pair& t,
    double allowed);
  /// The cells that are left, with their forms relative to the best foot.
  Verdict prove_hard_cells(const PieceQuery& query);
  double view_of(const PieceQuery& query, CellView& view) const;
  /// Whether F is negative for certain at a place that is trimmed away, where the distance is
  /// nearer than edges are proved to be.
  bool is_trimmed_away(const PieceQuery& query, const PieceFoot& place) const;
  double excess_of(const PieceFoot& place) const;
  /// For edges half of the tolerance, less what they may be off.
  double tolerance_of(const Piece& piece) const;
  bool improves_at_corner(
    const PieceQuery& query, const SearchWorkspace::Cell& cell, const double* f);
  Verdict prove_side(const PieceQuery& query, const Range& cell, const double* f, double error,
    int i, int end);
  /// The tangent plane of F at the minimum of the range.
  Verdict support(const PieceQuery& query, const Range& range, const Pair& start);
  bool supports(const PieceQuery& query, const Range& range, const PieceFoot& place) const;

  double* coefficients(std::size_t k, int size)
  {
    // Vector loads may read a little beyond either end.
    const std::size_t needed = (k + 1) * size + 2 * kBesideCoefficients;
    if (this->Workspace.coefficients.size() < needed)
    {
      this->Workspace.coefficients.resize(2 * needed);
    }
    return this->Workspace.coefficients.data() + kBesideCoefficients + k * size;
  }

  static constexpr int kBesideCoefficients = 16;

  const SearchStructure& Structure;
  const CertifiedQuery& Query;
  SearchWorkspace& Workspace;
  SearchWorkspace::Finds& Finds;
  CertifiedAnswer& Answer;
  double P[3];
  double Rounding; ///< of the differences of positions and the query
  double Bound = kInfinity;  ///< a point as near as this is known, or nothing farther is sought
  double SquaredBound = kInfinity;
  /// A node on the ways that begin() went down the tree, and the children that it went on with.
  struct Visit
  {
    HWY_ALIGN double squared[BoxTree::kWidth];
    std::int32_t node;
    unsigned followed;
  };
  Visit Path[kMostLevels * (1 + kMostWaysDown)];
  int Depth = 0;
  Descent Pending;
  int Visited = 0;         ///< pieces, by the walk that begins; 0: it has ended
  int WalkedSteps = 0;     ///< evaluations on those before
  std::int32_t First = -1; ///< the piece where it began …
  double FirstSquared = 0.0; ///< … and the squared distance of its box
  std::size_t Next = 0;    ///< candidate
  std::int32_t Begun = -1; ///< the piece on which begin() has found the minimum
  /// Pieces in which nothing is nearer than the best foot, or was when it was found; −1: none.
  struct
  {
    HWY_ALIGN std::array<std::int32_t, 9> pieces{ { -1, -1, -1, -1, -1, -1, -1, -1, -1 } };
    std::int32_t middle = -1;
  } Block;
  std::int32_t Nearest = -1; ///< the piece with the point that gave Bound, and that point
  Pair NearestAt{ { 0.0, 0.0 } };
  double Tolerance = 0.0; ///< what is asked for, less what the best foot may be off
  int Cells = 0;
  int HardCells = 0;
  // Of the piece that is being proved:
  double Slack = 0.0;   ///< d² − (d − tolerance)²
  double Margin = 0.0;  ///< bound of the error of a coefficient of the piece
  double Shift = 0.0;   ///< bound of what Slack adds to a coefficient beyond a constant
  const PieceFoot* Known = nullptr;
};

} // namespace
} // namespace HWY_NAMESPACE
} // namespace footpoint
HWY_AFTER_NAMESPACE();

#endif
