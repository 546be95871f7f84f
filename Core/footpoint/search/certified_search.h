// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "footpoint/search/search_structure.h"

#include <array>
#include <cstdint>
#include <vector>

namespace footpoint
{

/// A local minimum of the distance over one piece, found by Newton's method.
struct PieceFoot
{
  std::int32_t piece;
  std::array<double, 2> t; ///< in the piece, [0, 1]²; curves: t[0] = 0
  std::array<double, 3> position; ///< S, in the model's centred coordinates
  std::array<double, 3> offset;   ///< S − P
  double distance;                ///< |S − P|
  /// Derivatives by the piece's own parameters.
  std::array<std::array<double, 3>, 2> first;
  std::array<double, 2> gradient; ///< of E = ½|S − P|²
  std::array<double, 3> hessian;  ///< E_uu, E_uv, E_vv
  std::array<double, 2> metric;   ///< |S_u|², |S_v|²
  std::array<double, 3> weight;   ///< w and its derivatives; polynomials: 1, 0, 0
  int iterations;
};

/// Memory that queries share, one for each thread.
struct SearchWorkspace
{
  /// A piece that may hold the nearest point.
  struct Candidate
  {
    std::int32_t piece;
    double bound; ///< of |S − P|²
  };
  /// What one query has found so far.
  struct Finds
  {
    std::vector<Candidate> candidates;
    std::vector<PieceFoot> survivors; ///< minima of the pieces that have to be proved
  };
  struct Cell
  {
    std::array<double, 2> lower;
    std::array<double, 2> upper;
    double least; ///< its smallest coefficient …
    double error; ///< … and the error of all of them from halving
    int depth;
  };
  /// A cell whose coefficients have to be formed anew.
  struct HardCell
  {
    std::array<double, 2> lower;
    std::array<double, 2> upper;
    double allowed; ///< how far F may fall below zero; negative: not known yet
  };

  /// Memory of vectors.
  struct alignas(64) Line
  {
    unsigned char bytes[64];
  };

  std::vector<Finds> finds;   ///< of each query that is under way …
  std::vector<Line> searches; ///< … and its state, if there are several
  std::vector<Cell> cells;
  std::vector<HardCell> hard_cells;
  std::vector<double> coefficients; ///< of the cells, one after the other
};

struct CertifiedQuery
{
  Vector3 point = Vector3::Zero(); ///< in the model's centred coordinates
  /// Nothing farther is sought.
  double limit = 0.0;
  /// Of the model; feet that tie with the nearest (tie_tolerance) are kept as well.
  double size = 0.0;
  double tolerance = 0.0; ///< what is proved is that no point is nearer than distance − tolerance
};

struct CertifiedAnswer
{
  static constexpr int kMost = 16;

  std::array<PieceFoot, kMost> feet; ///< the nearest first, then those that tie with it, any order
  int count = 0;                     ///< 0: nothing within the limit
  bool certified = false;
};

/// The nearest points of a model of splines, proved to be so.
///
/// Branch and bound over Bézier pieces. First the search: boxes nearest first; where the
/// coefficients of a piece's distance form do not exclude it, Newton's method finds the minimum of
/// the piece. A foot near the query settles the pieces around it at once (piece_neighbourhood.h).
/// Then the proof, for the other pieces that were not excluded, under the smallest distance found:
/// a cell holds nothing nearer where
///   - all coefficients of F are positive; or
///   - F is monotone along a direction and the side in question holds nothing nearer; or
///   - F is convex and its tangent plane at one point is positive over the cell;
/// otherwise it is halved. Cells that resist have their form taken anew relative to the foot, less
/// the square of the coordinate that is steepest. Documentation/CertifiedSearch.md derives all
/// margins.
class CertifiedSearch
{
public:
  CertifiedSearch() = default;
  /// \param execution whose threads share the work of building
  explicit CertifiedSearch(DistanceForms forms, const Execution& execution = {});

  bool empty() const { return this->number_of_pieces() == 0; }
  const Piece& piece(std::int32_t k) const { return this->forms().pieces()[k]; }
  const DistanceForms& forms() const { return this->Structure.forms; }
  const BoxTree& tree() const { return this->Structure.tree; }
  std::size_t number_of_pieces() const { return this->forms().pieces().size(); }

  /// So many queries are searched together at the most.
  static constexpr int kTogether = 32;

  void find(const CertifiedQuery& query, SearchWorkspace& workspace, CertifiedAnswer& answer) const;

  /// The same answers, bit for bit, for up to kTogether queries: sooner where these are near each
  /// other, since descents of different queries on the same piece are made together.
  /// \param answers one for each query
  void find(const CertifiedQuery* queries, int count, SearchWorkspace& workspace,
    CertifiedAnswer* answers) const;

private:
  SearchStructure Structure;
};

} // namespace footpoint
