// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/search/piece_neighbourhood.h"

#include "footpoint/search/block_frame.h"
#include "footpoint/search/rational_derivatives.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <numeric>
#include <vector>

namespace footpoint
{
namespace
{

/// What a piece of a block has to reach of the mean speed, along the way to any of its points: far
/// below it the limit is too small to be of use.
constexpr double kLeastSpeed = 0.25;
/// So much of the distance that the derivation allows is used; what is left bounds what a gradient
/// left over does, which is next to nothing.
constexpr double kPartOfLimit = 0.9;
/// Below this speed a rational piece is looked at more sharply, at about the price of its bounds:
/// the limit goes with the square, and can gain by more than four.
constexpr double kUnsharp = 0.5;
/// Single precision, and the rounding of what is computed here, a few times over.
constexpr double kUp = 1.0 + 0x1p-20;
constexpr double kDown = 1.0 - 0x1p-20;
/// There are no blocks where a derivative beside the model, or the model itself, leaves this range.
/// Squares of a rounding of the model are still far from the ends of double precision.
constexpr double kSlowest = 0x1p-60;
constexpr int kGreatestExponent = 430;
/// What a foot's gradient is off where its last step was Taylor's expansion, for a step of 1e-7 and
/// degrees p + q = 1, as a part of the piece's reach: ½ step² |S'''| |r| with |S'''| ≤ 2 (p + q)
/// |S''| and |S''| |r| ≤ m², in units that are as long as 8 (p + q) times the reach.
constexpr double kExpansion = 0x1p-42;

constexpr int kMiddle = 4;
constexpr int kPlaces = 9;
/// Each place after those that lie between it and the middle.
constexpr int kOutwards[kPlaces] = { kMiddle, 1, 3, 5, 7, 0, 2, 6, 8 };

/// Over these places the way leads to one, first along u or first along v; to a side itself or from
/// the middle.
constexpr int beside_u(int at)
{
  return 3 * (at / 3) + 1;
}
constexpr int beside_v(int at)
{
  return 3 + at % 3;
}

/// Finds pieces of one patch by their lower corners.
class PatchCorners
{
public:
  /// \param end of the patch in the list of pieces
  PatchCorners(const AlignedVector<Piece>& pieces, std::int32_t begin, std::int32_t end)
    : Pieces(pieces)
    , Begin(begin)
    , End(end)
  {
    // Rows of pieces that were not cut are equally long.
    const double first = pieces[begin].lower[1];
    std::int32_t row = begin;
    while (row < end && pieces[row].lower[1] == first)
    {
      ++row;
    }
    this->Step[1] = row - begin;
  }

  /// The piece that begins where another one ends along direction i and is as wide across; −1:
  /// none.
  std::int32_t after(std::int32_t index, int i)
  {
    const Piece& piece = this->Pieces[index];
    if (piece.edge || piece.sides[i][1] != PieceSide::Smooth || !(piece.upper[i] > piece.lower[i]))
    {
      return -1;
    }
    // Mostly as far on in the list as it was for the piece before.
    const std::int32_t guess = index + this->Step[i];
    if (guess < this->End && this->follows(piece, guess, i))
    {
      return guess;
    }
    std::array<double, 2> corner = piece.lower;
    corner[i] = piece.upper[i];
    const std::int32_t found = this->find(corner);
    if (found < 0 || !this->follows(piece, found, i))
    {
      return -1;
    }
    this->Step[i] = std::max(found - index, 0);
    return found;
  }

private:
  bool follows(const Piece& piece, std::int32_t index, int i) const
  {
    const Piece& other = this->Pieces[index];
    return other.shape == piece.shape && !other.edge && other.lower[i] == piece.upper[i] &&
      other.lower[1 - i] == piece.lower[1 - i] && other.upper[1 - i] == piece.upper[1 - i] &&
      other.upper[i] > other.lower[i];
  }

  static bool is_before(const std::array<double, 2>& a, const std::array<double, 2>& b)
  {
    return a[1] != b[1] ? a[1] < b[1] : a[0] < b[0];
  }

  std::int32_t find(const std::array<double, 2>& corner)
  {
    if (this->Order.empty())
    {
      this->Order.resize(this->End - this->Begin);
      std::iota(this->Order.begin(), this->Order.end(), this->Begin);
      std::sort(this->Order.begin(), this->Order.end(),
        [this](std::int32_t a, std::int32_t b)
        { return is_before(this->Pieces[a].lower, this->Pieces[b].lower); });
    }
    const auto found = std::lower_bound(this->Order.begin(), this->Order.end(), corner,
      [this](std::int32_t a, const std::array<double, 2>& b)
      { return is_before(this->Pieces[a].lower, b); });
    return found != this->Order.end() && this->Pieces[*found].lower == corner ? *found : -1;
  }

  const AlignedVector<Piece>& Pieces;
  std::int32_t Begin;
  std::int32_t End;
  std::vector<std::int32_t> Order; ///< by lower corners, once it is needed
  std::int32_t Step[2] = { 1, 1 };
};

/// Finds out of which pieces around each one a block is made, and how far it holds.
class BlockBuilder
{
  using Around = std::array<const PieceDerivatives*, kPlaces>;

public:
  /// \param bounds of the derivatives of all pieces
  BlockBuilder(const AlignedVector<Piece>& pieces, PieceDerivatives* bounds)
    : Pieces(pieces)
    , Bounds(bounds)
  {
  }

  /// Bounds the derivatives of pieces of one patch.
  void bound(const DerivativeUnits& units, std::int32_t begin, std::int32_t end)
  {
    for (std::int32_t k = begin; k < end; ++k)
    {
      prefetch_net_after(this->Pieces, k, end);
      const Piece& piece = this->Pieces[k];
      this->Bounds[k] = piece.shape->rational ? this->Rational.bounds(piece, units)
                                              : piece_derivatives(piece, units);
    }
  }

  /// Makes the block of a piece, which knows what is around it.
  /// \pre the derivatives of its patch are bounded
  void settle(const DerivativeUnits& units, PieceNeighbourhood& result)
  {
    Around around;
    PieceDerivatives::Box mean;
    std::fill_n(mean.begin(), 3, Eigen::Array4d::Zero());
    double count = 0.0;
    for (int at = 0; at < kPlaces; ++at)
    {
      around[at] = result.pieces[at] >= 0 ? &this->Bounds[result.pieces[at]] : nullptr;
      if (around[at])
      {
        for (int k = 0; k < 3; ++k)
        {
          mean[k] += around[at]->box[k];
        }
        count += 1.0;
      }
    }
    for (Eigen::Array4d& coordinate : mean)
    {
      coordinate *= 1.0 / count;
    }
    this->choose(units, mean, around, result);
    if (result.block == 0)
    {
      // Too far from the mean of all it is the mean itself.
      this->choose(units, around[kMiddle]->box, around, result);
    }
  }

private:
  /// Makes a block of the pieces along which the way is long enough, of those at corners where both
  /// sides beside them are in it. \param mean derivatives
  void choose(const DerivativeUnits& units, const PieceDerivatives::Box& mean, const Around& around,
    PieceNeighbourhood& result)
  {
    const Piece& piece = this->Pieces[result.pieces[kMiddle]];
    const BlockFrame frame(mean, piece.shape->degree[0] == 0);
    if (!frame.valid)
    {
      return;
    }
    double least = std::numeric_limits<double>::infinity();
    double greatest = 0.0;
    for (const int at : kOutwards)
    {
      const int between = at == kMiddle ? 0 : (1 << beside_u(at) | 1 << beside_v(at)) & ~(1 << at);
      if (around[at] && (between & ~result.block) == 0)
      {
        const WaySpeed way =
          this->way_of(this->Pieces[result.pieces[at]], units, frame, *around[at]);
        if (at == kMiddle)
        {
          this->set_metric(units, mean, way.speed, result);
        }
        if (way.speed >= kLeastSpeed && way.bend <= BlockFrame::kLongest)
        {
          least = std::min(least, way.speed);
          greatest = std::max(greatest, way.bend);
          result.block = static_cast<std::uint16_t>(result.block | 1 << at);
        }
      }
    }
    if (result.block != 0)
    {
      this->set_limit(units, frame, least * kDown, greatest, result);
    }
  }

  /// Bounds over a piece of the block, as sharp as they are worth the work.
  WaySpeed way_of(const Piece& piece, const DerivativeUnits& units, const BlockFrame& frame,
    const PieceDerivatives& bounds)
  {
    WaySpeed way = frame.speed_of(bounds);
    if (piece.shape->rational && way.speed < kUnsharp)
    {
      way.speed = std::max(way.speed, this->Rational.speed(piece, units, frame));
    }
    return way;
  }

  /// Δ is as long as what the mean derivatives make of it. \param speed of the piece itself
  void set_metric(const DerivativeUnits& units, const PieceDerivatives::Box& mean, double speed,
    PieceNeighbourhood& result) const
  {
    const Piece& piece = this->Pieces[result.pieces[kMiddle]];
    if (!(speed > 0.0))
    {
      return;
    }
    double factor[2];
    for (int i = 0; i < 2; ++i)
    {
      factor[i] = piece.shape->degree[i] > 0
        ? kDown * speed * (piece.width[i] / units.width[i]) / units.length
        : 0.0;
    }
    for (int k = 0; k < 3; ++k)
    {
      const int i = k / 2;
      const int j = (k + 1) / 2;
      double product = 0.0;
      for (const Eigen::Array4d& coordinate : mean)
      {
        product += coordinate(i) * coordinate(j);
      }
      result.metric[k] = product * factor[i] * factor[j];
    }
  }

  /// \param speed, bend of the worst pieces of the block
  void set_limit(const DerivativeUnits& units, const BlockFrame& frame, double speed, double bend,
    PieceNeighbourhood& result) const
  {
    const Piece& piece = this->Pieces[result.pieces[kMiddle]];
    const PieceShape& shape = *piece.shape;
    double steepness = 0.0; // of S at the most, in units of the block
    for (int i = 0; i < 2; ++i)
    {
      const double inverse =
        shape.degree[i] > 0 ? frame.inverse[i] * (units.width[i] / piece.width[i]) : 0.0;
      if (!(inverse <= 1.0 / kSlowest))
      {
        result.block = 0;
        return;
      }
      result.inverse_speed[i] = inverse * units.length * kUp;
      steepness += shape.degree[i] * units.length * piece.reach * inverse;
    }
    result.limit =
      std::min(kPartOfLimit * speed * speed / bend * kDown, BlockFrame::kLongest) / units.length;
    result.square_factor =
      static_cast<float>(1.0 / ((1.0 - kPartOfLimit) * speed * speed) * kUp);
    const double degrees = shape.degree[0] + shape.degree[1];
    const double weights = piece.greatest_weight / piece.least_weight; // the square of their ratio
    result.rounding = static_cast<float>(weights *
      (8.0 * shape.roundings * 0x1p-53 * steepness + kExpansion * degrees * degrees) * kUp);
  }

  const AlignedVector<Piece>& Pieces;
  PieceDerivatives* Bounds;
  RationalDerivatives Rational;
};

/// Finds the pieces around each one of a patch.
void find_pieces(const AlignedVector<Piece>& pieces, std::int32_t begin, std::int32_t end,
  AlignedVector<PieceNeighbourhood>& result)
{
  PatchCorners corners(pieces, begin, end);
  for (std::int32_t k = begin; k < end; ++k)
  {
    result[k].pieces[kMiddle] = k;
    for (int i = 0; i < 2; ++i)
    {
      const std::int32_t next = corners.after(k, i);
      if (next >= 0)
      {
        result[k].pieces[i == 0 ? 7 : 5] = next;
        result[next].pieces[i == 0 ? 1 : 3] = k;
      }
    }
  }
  for (std::int32_t k = begin; k < end; ++k)
  {
    PieceNeighbourhood& each = result[k];
    for (const int at : { 0, 2, 6, 8 })
    {
      // Over one side and over the other.
      const std::int32_t u = each.pieces[beside_u(at)];
      const std::int32_t v = each.pieces[beside_v(at)];
      if (u >= 0 && v >= 0)
      {
        const std::int32_t one = result[u].pieces[beside_v(at)];
        const std::int32_t two = result[v].pieces[beside_u(at)];
        each.pieces[at] = one == two ? one : -1;
      }
    }
  }
}

/// Where the pieces of each patch begin, and where the last ones end.
std::vector<std::int32_t> begins_of_patches(const AlignedVector<Piece>& pieces)
{
  std::vector<std::int32_t> begins;
  for (std::size_t k = 0; k < pieces.size(); ++k)
  {
    if (k == 0 || pieces[k].patch != pieces[k - 1].patch)
    {
      begins.push_back(static_cast<std::int32_t>(k));
    }
  }
  begins.push_back(static_cast<std::int32_t>(pieces.size()));
  return begins;
}

} // namespace

AlignedVector<PieceNeighbourhood> find_neighbourhoods(
  const AlignedVector<Piece>& pieces, const Execution& execution)
{
  AlignedVector<PieceNeighbourhood> result(pieces.size());
  const auto count = static_cast<std::int64_t>(pieces.size());
  const std::vector<std::int32_t> begins = begins_of_patches(pieces);
  // Millions of numbers, all of them set later.
  const std::unique_ptr<PieceDerivatives[]> bounds(new PieceDerivatives[pieces.size()]);
  double length = 1.0;
  // What each range has of each patch.
  using Visit =
    void(BlockBuilder&, const DerivativeUnits& units, std::int32_t begin, std::int32_t end);
  const auto in_patches = [&](const Execution& part, const std::function<Visit>& visit)
  {
    for_ranges(part, count, kPiecesForThreads,
      [&](std::int64_t begin, std::int64_t end)
      {
        BlockBuilder builder(pieces, bounds.get());
        auto patch = std::upper_bound(begins.begin(), begins.end(), begin) - 1;
        for (auto from = static_cast<std::int32_t>(begin); from < end; from = *++patch)
        {
          visit(builder, { length, pieces[*patch].width }, from,
            std::min(patch[1], static_cast<std::int32_t>(end)));
        }
      });
  };
  const auto patches = static_cast<std::int64_t>(begins.size()) - 1;
  for_ranges(execution, patches, patches > 1 && count >= kPiecesForThreads ? 0 : patches + 1,
    [&](std::int64_t begin, std::int64_t end)
    {
      PieceNeighbourhood alone{};
      alone.pieces.fill(-1);
      alone.limit = -1.0;
      for (std::int64_t k = begin; k < end; ++k)
      {
        std::fill(result.begin() + begins[k], result.begin() + begins[k + 1], alone);
        find_pieces(pieces, begins[k], begins[k + 1], result);
      }
    });
  double reach = 0.0;
  for (const Piece& piece : pieces)
  {
    reach = std::max(reach, piece.reach);
  }
  const int exponent = std::ilogb(reach);
  if (std::abs(static_cast<double>(exponent)) > kGreatestExponent)
  {
    return result;
  }
  length = std::ldexp(1.0, -exponent); // makes the model's about 1
  in_patches(part_of(execution, 0.0, 0.5),
    [](BlockBuilder& builder, const DerivativeUnits& units, std::int32_t begin, std::int32_t end)
    { builder.bound(units, begin, end); });
  in_patches(part_of(execution, 0.5, 0.5),
    [&](BlockBuilder& builder, const DerivativeUnits& units, std::int32_t begin, std::int32_t end)
    {
      for (std::int32_t k = begin; k < end; ++k)
      {
        if (!pieces[k].edge)
        {
          builder.settle(units, result[k]);
        }
      }
    });
  return result;
}

} // namespace footpoint
