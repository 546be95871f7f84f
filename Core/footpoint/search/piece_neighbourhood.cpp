// SPDX-License-Identifier: BSD-3-Clause
#include "footpoint/search/piece_neighbourhood.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <unordered_map>

namespace footpoint
{
namespace
{

using Vector4 = Eigen::Array4d;
using Map4 = Eigen::Map<const Vector4>;

/// What a piece of a block has to reach of the mean speed, along the way to any of its points: far below
/// it the limit is too small to be of use.
constexpr double kLeastSpeed = 0.25;
constexpr double kInfinite = std::numeric_limits<double>::infinity();
/// Single precision, and the rounding of what is computed here, a few times over.
constexpr double kUp = 1.0 + 0x1p-20;
constexpr double kDown = 1.0 - 0x1p-20;
/// Where the mean derivatives are more parallel than this sine there is no block.
constexpr double kLeastSine = 1e-3;

/// Bounds of the derivatives of S over a piece, from the differences of its control points.
struct DerivativeBounds
{
  Vector3 middle[2]; ///< of the box of first derivatives …
  Vector3 half[2];   ///< … and half its widths
  double second[3];  ///< lengths of the second ones: uu, uv, vv
};

/// The box of differences of control points and what they span.
struct Differences
{
  Vector4 lower = Vector4::Constant(kInfinite);
  Vector4 upper = -lower;

  void add(const Vector4& difference)
  {
    this->lower = this->lower.min(difference);
    this->upper = this->upper.max(difference);
  }
  double longest() const { return this->greatest().head<3>().matrix().norm(); }
  double weight() const { return this->greatest()(3); }

private:
  Vector4 greatest() const { return this->lower.abs().max(this->upper.abs()); }
};

DerivativeBounds bounds_of(const Piece& piece)
{
  const int p = piece.shape->degree[0];
  const int q = piece.shape->degree[1];
  const auto at = [&](int i, int j) { return Map4(piece.net + 4 * (i * (q + 1) + j)); };
  Differences u;
  Differences v;
  Differences uu;
  Differences uv;
  Differences vv;
  for (int i = 0; i <= p; ++i)
  {
    for (int j = 0; j <= q; ++j)
    {
      const Vector4 here = at(i, j);
      if (i < p)
      {
        const Vector4 step = at(i + 1, j) - here;
        u.add(step);
        if (j < q)
        {
          uv.add(at(i + 1, j + 1) - at(i, j + 1) - step);
        }
        if (i + 1 < p)
        {
          uu.add(at(i + 2, j) - at(i + 1, j) - step);
        }
      }
      if (j < q)
      {
        const Vector4 step = at(i, j + 1) - here;
        v.add(step);
        if (j + 1 < q)
        {
          vv.add(at(i, j + 2) - at(i, j + 1) - step);
        }
      }
    }
  }
  const Differences* first[2] = { p > 0 ? &u : nullptr, q > 0 ? &v : nullptr };
  const int degree[2] = { p, q };
  const double least = std::sqrt(piece.least_weight);
  const double greatest = std::sqrt(piece.greatest_weight);
  DerivativeBounds bounds;
  double length[2] = { 0.0, 0.0 }; // of S_i and of w_i
  double weight[2] = { 0.0, 0.0 };
  for (int i = 0; i < 2; ++i)
  {
    bounds.middle[i] = bounds.half[i] = Vector3::Zero();
    if (!first[i])
    {
      continue;
    }
    // w S_i = N_i − w_i (S − origin)
    weight[i] = degree[i] * first[i]->weight();
    for (int k = 0; k < 3; ++k)
    {
      const double lower = degree[i] * first[i]->lower(k) - weight[i] * piece.reach;
      const double upper = degree[i] * first[i]->upper(k) + weight[i] * piece.reach;
      const double from = lower / (lower > 0.0 ? greatest : least);
      const double to = upper / (upper > 0.0 ? least : greatest);
      bounds.middle[i](k) = 0.5 * (from + to);
      bounds.half[i](k) = 0.5 * (to - from);
    }
    length[i] = (bounds.middle[i].cwiseAbs() + bounds.half[i]).norm();
  }
  // w S_ij = N_ij − w_i S_j − w_j S_i − w_ij (S − origin)
  const auto second = [&](double factor, const Differences& difference, int i, int j)
  {
    return factor > 0.0 ? (factor * (difference.longest() + difference.weight() * piece.reach) +
                            weight[i] * length[j] + weight[j] * length[i]) /
        least
                        : 0.0;
  };
  bounds.second[0] = second(p * (p - 1.0), uu, 0, 0);
  bounds.second[1] = second(static_cast<double>(p * q), uv, 0, 1);
  bounds.second[2] = second(q * (q - 1.0), vv, 1, 1);
  if (piece.shape->rational && p == 1)
  {
    bounds.second[0] = 2.0 * weight[0] * length[0] / least;
  }
  if (piece.shape->rational && q == 1)
  {
    bounds.second[2] = 2.0 * weight[1] * length[1] / least;
  }
  return bounds;
}

/// Finds pieces by patch and lower corner.
class Corners
{
public:
  explicit Corners(const std::vector<Piece>& pieces)
    : Pieces(pieces)
  {
  }

  /// The piece that begins where another one ends along direction i and is as wide across; −1: none.
  std::int32_t after(std::int32_t index, int i)
  {
    const Piece& piece = this->Pieces[index];
    if (piece.sides[i][1] != PieceSide::Smooth || !(piece.upper[i] > piece.lower[i]))
    {
      return -1;
    }
    // Mostly as far on in the list as it was for the piece before.
    const std::int64_t guess = index + this->Step[i];
    if (guess < static_cast<std::int64_t>(this->Pieces.size()) && this->follows(piece, guess, i))
    {
      return static_cast<std::int32_t>(guess);
    }
    if (this->Index.empty())
    {
      for (std::size_t k = 0; k < this->Pieces.size(); ++k)
      {
        const Piece& each = this->Pieces[k];
        this->Index.emplace(key(each.patch, each.lower), static_cast<std::int32_t>(k));
      }
    }
    std::array<double, 2> corner = piece.lower;
    corner[i] = piece.upper[i];
    const auto range = this->Index.equal_range(key(piece.patch, corner));
    for (auto found = range.first; found != range.second; ++found)
    {
      if (this->follows(piece, found->second, i))
      {
        this->Step[i] = std::max(found->second - index, 0);
        return found->second;
      }
    }
    return -1;
  }

private:
  bool follows(const Piece& piece, std::int64_t index, int i) const
  {
    const Piece& other = this->Pieces[index];
    return other.patch == piece.patch && other.shape == piece.shape && !other.edge &&
      other.lower[i] == piece.upper[i] && other.lower[1 - i] == piece.lower[1 - i] &&
      other.upper[1 - i] == piece.upper[1 - i] && other.upper[i] > other.lower[i];
  }

  static std::uint64_t key(std::int32_t patch, const std::array<double, 2>& corner)
  {
    std::uint64_t words[2];
    static_assert(sizeof(words) == sizeof(corner), "two words");
    std::memcpy(words, corner.data(), sizeof(words));
    constexpr std::uint64_t kMix = 0x9e3779b97f4a7c15;
    return ((static_cast<std::uint64_t>(patch) * kMix ^ words[0]) * kMix ^ words[1]) * kMix;
  }

  const std::vector<Piece>& Pieces;
  std::unordered_multimap<std::uint64_t, std::int32_t> Index;
  std::int64_t Step[2] = { 1, 1 };
};

/// One piece of a block, with its derivatives by the parameters of the block's middle piece.
struct Member
{
  int at;             ///< its place in PieceNeighbourhood::pieces
  double scale[2];    ///< width of the middle piece over its own
  double speed;       ///< bound of the first derivatives from below …
  double second;      ///< … and of the second ones from above
};

/// The units of a block: mean derivatives, and the parameters in which these are orthonormal.
struct Units
{
  Vector3 mean[2];
  Vector3 axes[2]; ///< an orthonormal basis of their plane; curves: the second one alone
  double rows[2][2]; ///< the inverse of (mean_u, mean_v) in that basis: Δt_i = rows[i] · Δ
  double inverse[2]; ///< lengths of these rows
  double cosine;     ///< of the angle between them, by magnitude
  bool valid = false;

  Units(const Vector3& u, const Vector3& v, bool curve)
    : mean{ u, v }
    , axes{ Vector3::Zero(), Vector3::Zero() }
    , rows{ { 0.0, 0.0 }, { 0.0, 0.0 } }
    , inverse{ 0.0, 0.0 }
    , cosine(0.0)
  {
    const double along_v = v.norm();
    if (!(along_v > 0.0))
    {
      return;
    }
    this->axes[1] = v / along_v;
    this->rows[1][1] = this->inverse[1] = 1.0 / along_v;
    this->valid = true;
    if (curve)
    {
      return;
    }
    const double along_u = u.norm();
    const double shear = u.dot(this->axes[1]);
    const Vector3 across = u - shear * this->axes[1];
    const double height = across.norm();
    this->valid = height > kLeastSine * along_u;
    if (this->valid)
    {
      this->axes[0] = across / height;
      // (u, v) = axes · (height, 0; shear, along_v)
      this->rows[0][0] = this->inverse[0] = 1.0 / height;
      this->rows[1][0] = -shear / (height * along_v);
      this->inverse[1] = along_u / (height * along_v);
      this->cosine = std::abs(shear) / along_u;
    }
  }

  bool curve() const { return this->inverse[0] == 0.0; }

  /// Of second derivatives of these lengths.
  double norm(const double* second) const
  {
    const double a = second[0] * this->inverse[0] * this->inverse[0];
    const double b = second[1] * this->inverse[0] * this->inverse[1];
    const double c = second[2] * this->inverse[1] * this->inverse[1];
    return (1.0 + this->cosine) * (0.5 * (a + c) + std::hypot(0.5 * (a - c), b));
  }
};

class Builder
{
public:
  explicit Builder(const std::vector<Piece>& pieces)
    : Pieces(pieces)
  {
    this->Bounds.reserve(pieces.size());
    for (const Piece& piece : pieces)
    {
      this->Bounds.push_back(bounds_of(piece));
    }
  }

  void settle(PieceNeighbourhood& result) const
  {
    const Piece& piece = this->piece(result, 4);
    std::array<Member, 9> members{};
    int count = 0;
    Vector3 mean[2] = { Vector3::Zero(), Vector3::Zero() };
    for (int at = 0; at < 9; ++at)
    {
      if (result.pieces[at] >= 0)
      {
        Member& member = members[count++];
        member = this->member_of(piece, this->piece(result, at), at);
        const DerivativeBounds& bounds = this->Bounds[result.pieces[at]];
        for (int i = 0; i < 2; ++i)
        {
          mean[i] += member.scale[i] * bounds.middle[i];
        }
      }
    }
    const Units units(mean[0] / count, mean[1] / count, piece.shape->degree[0] == 0);
    if (!units.valid)
    {
      return;
    }
    const Member* found[9] = {};
    for (int k = 0; k < count; ++k)
    {
      Member& member = members[k];
      this->measure(units, this->Bounds[result.pieces[member.at]], member);
      found[member.at] = member.speed >= kLeastSpeed ? &member : nullptr;
    }
    this->choose(units, piece, found, result);
  }

private:
  const Piece& piece(const PieceNeighbourhood& of, int at) const
  {
    return this->Pieces[of.pieces[at]];
  }

  static Member member_of(const Piece& middle, const Piece& piece, int at)
  {
    Member member{ at, { 1.0, 1.0 }, 0.0, 0.0 };
    for (int i = 0; i < 2; ++i)
    {
      member.scale[i] = piece.width[i] > 0.0 ? middle.width[i] / piece.width[i] : 1.0;
    }
    return member;
  }

  void measure(const Units& units, const DerivativeBounds& bounds, Member& member) const
  {
    // Of the derivatives in the plane of the mean ones, by the units' parameters, the symmetric part:
    // what it leaves of Δ along Δ is a lower bound of |S − foot| / |Δ|.
    double middle[2][2] = {};
    double half[2][2] = {};
    for (int i = 0; i < 2; ++i)
    {
      for (int k = 0; k < 2; ++k)
      {
        const double at = member.scale[i] * units.axes[k].dot(bounds.middle[i]);
        const double width = member.scale[i] * units.axes[k].cwiseAbs().dot(bounds.half[i]);
        for (int l = 0; l < 2; ++l)
        {
          middle[k][l] += at * units.rows[i][l];
          half[k][l] += width * std::abs(units.rows[i][l]);
        }
      }
    }
    const double uu = middle[0][0] - half[0][0];
    const double vv = middle[1][1] - half[1][1];
    const double uv =
      0.5 * (std::abs(middle[0][1] + middle[1][0]) + half[0][1] + half[1][0]);
    member.speed =
      units.curve() ? vv : 0.5 * (uu + vv) - std::hypot(0.5 * (uu - vv), uv);
    const double second[3] = { member.scale[0] * member.scale[0] * bounds.second[0],
      member.scale[0] * member.scale[1] * bounds.second[1],
      member.scale[1] * member.scale[1] * bounds.second[2] };
    member.second = units.norm(second);
  }

  /// The block is made of the pieces along which the way is long enough, corners where both sides
  /// beside them are in it, and its limit is that of the worst.
  void choose(const Units& units, const Piece& middle, const Member* const* found,
    PieceNeighbourhood& result) const
  {
    if (!found[4])
    {
      return;
    }
    double speed = kInfinite;
    double second = 0.0;
    for (int at = 0; at < 9; ++at)
    {
      const int beside_u = 3 * (at / 3) + 1;
      const int beside_v = 3 + at % 3;
      if (found[at] && found[beside_u] && found[beside_v])
      {
        const Member& member = *found[at];
        speed = std::min(speed, member.speed);
        second = std::max(second, member.second);
        result.block = static_cast<std::uint16_t>(result.block | 1 << at);
      }
    }
    const double m = speed * kDown;
    result.limit = static_cast<float>(std::min(m * m / (2.0 * second) * kDown, 1e30));
    result.square_factor = static_cast<float>(2.0 / (m * m) * kUp);
    const DerivativeBounds& bounds = this->Bounds[result.pieces[4]];
    double steepest = 0.0; // of S, in units of the block
    for (int i = 0; i < 2; ++i)
    {
      result.inverse_speed[i] = static_cast<float>(units.inverse[i] * kUp);
      steepest += (bounds.middle[i].cwiseAbs() + bounds.half[i]).norm() * units.inverse[i];
    }
    const double weights = std::sqrt(middle.greatest_weight / middle.least_weight);
    result.rounding = static_cast<float>(
      4.0 * middle.shape->roundings * 0x1p-53 * steepest * weights * kUp);
  }

  const std::vector<Piece>& Pieces;
  std::vector<DerivativeBounds> Bounds;
};

} // namespace

std::vector<PieceNeighbourhood> find_neighbourhoods(const std::vector<Piece>& pieces)
{
  PieceNeighbourhood alone{};
  alone.pieces.fill(-1);
  alone.limit = -1.0F;
  std::vector<PieceNeighbourhood> result(pieces.size(), alone);
  Corners corners(pieces);
  for (std::size_t k = 0; k < pieces.size(); ++k)
  {
    const auto index = static_cast<std::int32_t>(k);
    result[k].pieces[4] = index;
    for (int i = 0; i < 2 && !pieces[k].edge; ++i)
    {
      const std::int32_t next = corners.after(index, i);
      if (next >= 0)
      {
        result[k].pieces[i == 0 ? 7 : 5] = next;
        result[next].pieces[i == 0 ? 1 : 3] = index;
      }
    }
  }
  for (PieceNeighbourhood& each : result)
  {
    // Diagonal ones are reached over both sides.
    for (int at = 0; at < 9; at += at == 2 ? 4 : 2)
    {
      const int beside_u = 3 * (at / 3) + 1;
      const int beside_v = 3 + at % 3;
      if (at != 4 && each.pieces[beside_u] >= 0 && each.pieces[beside_v] >= 0)
      {
        const std::int32_t one = result[each.pieces[beside_u]].pieces[beside_v];
        const std::int32_t two = result[each.pieces[beside_v]].pieces[beside_u];
        each.pieces[at] = one == two ? one : -1;
      }
    }
  }
  const Builder builder(pieces);
  for (std::size_t k = 0; k < pieces.size(); ++k)
  {
    if (!pieces[k].edge)
    {
      builder.settle(result[k]);
    }
  }
  return result;
}

} // namespace footpoint
