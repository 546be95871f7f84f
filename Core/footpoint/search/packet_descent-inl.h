// SPDX-License-Identifier: BSD-3-Clause

// Plain Newton steps of several queries on one piece at once, one query in each lane of a vector:
// the same operations in the same order as for one query alone, so the results are the same bits.
// Compiled once for each set of vector instructions (the guard of Highway's "-inl.h" headers).
#if defined(FOOTPOINT_PACKET_DESCENT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FOOTPOINT_PACKET_DESCENT_INL_H
#undef FOOTPOINT_PACKET_DESCENT_INL_H
#else
#define FOOTPOINT_PACKET_DESCENT_INL_H
#endif

#include "footpoint/search/piece_descent-inl.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace footpoint
{
namespace HWY_NAMESPACE
{
namespace
{

/// One number of each query of a packet, as many as the processor's vectors hold.
struct Lanes
{
  using Tag = hn::CappedTag<double, 8>;
  static constexpr int kCount = static_cast<int>(hn::MaxLanes(Tag()));

  hn::Vec<Tag> value;

  /// Trivial: what the compiler writes itself is compiled without vector instructions.
  Lanes() = default;
  HWY_INLINE explicit Lanes(double number)
    : value(hn::Set(Tag(), number))
  {
  }
  HWY_INLINE explicit Lanes(hn::Vec<Tag> vector)
    : value(vector)
  {
  }

  friend HWY_INLINE Lanes operator+(const Lanes& a, const Lanes& b)
  {
    return Lanes(hn::Add(a.value, b.value));
  }
  friend HWY_INLINE Lanes operator-(const Lanes& a, const Lanes& b)
  {
    return Lanes(hn::Sub(a.value, b.value));
  }
  friend HWY_INLINE Lanes operator*(const Lanes& a, const Lanes& b)
  {
    return Lanes(hn::Mul(a.value, b.value));
  }
  friend HWY_INLINE Lanes operator/(const Lanes& a, const Lanes& b)
  {
    return Lanes(hn::Div(a.value, b.value));
  }
  /// One bit for each lane.
  friend HWY_INLINE unsigned operator<(const Lanes& a, const Lanes& b)
  {
    return bits(hn::Lt(a.value, b.value));
  }
  friend HWY_INLINE unsigned operator<=(const Lanes& a, const Lanes& b)
  {
    return bits(hn::Le(a.value, b.value));
  }

  static HWY_INLINE unsigned bits(hn::Mask<Tag> mask)
  {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(Tag(), mask, bytes);
    return bytes[0];
  }
};

HWY_INLINE Lanes multiply_add(const Lanes& a, const Lanes& b, const Lanes& c)
{
  return Lanes(hn::MulAdd(a.value, b.value, c.value));
}

/// evaluate() for every lane: sums over the rows of the net, then over its columns.
template <int P, int Q, bool Rational>
HWY_INLINE void evaluate_lanes(const Piece& piece, const Lanes* query, PlaceOf<Lanes>& place)
{
  constexpr int kMostRows = P >= 0 ? P + 1 : kMaximumDegree + 1;
  constexpr int kMostColumns = Q >= 0 ? Q + 1 : kMaximumDegree + 1;
  const int p = P >= 0 ? P : piece.shape->degree[0];
  const int q = Q >= 0 ? Q : piece.shape->degree[1];
  Lanes row[3][kMostRows];
  Lanes column[3][kMostColumns];
  bernstein(p, place.t[0], row[0], row[1], row[2]);
  bernstein(q, place.t[1], column[0], column[1], column[2]);
  for (int k = 0; k < (Rational ? 4 : 3); ++k)
  {
    Lanes sum[kJet];
    for (Lanes& entry : sum)
    {
      entry = Lanes(0.0);
    }
    for (int j = 0; j <= q; ++j)
    {
      Lanes c(0.0);
      if (P == 0)
      {
        c = Lanes(piece.net[4 * j + k]);
      }
      else
      {
        Lanes cu = c;
        Lanes cuu = c;
        for (int i = 0; i <= p; ++i)
        {
          const Lanes control(piece.net[4 * (i * (q + 1) + j) + k]);
          c = multiply_add(row[0][i], control, c);
          cu = multiply_add(row[1][i], control, cu);
          cuu = multiply_add(row[2][i], control, cuu);
        }
        sum[kSu] = multiply_add(column[0][j], cu, sum[kSu]);
        sum[kSuu] = multiply_add(column[0][j], cuu, sum[kSuu]);
        sum[kSuv] = multiply_add(column[1][j], cu, sum[kSuv]);
      }
      sum[kS] = multiply_add(column[0][j], c, sum[kS]);
      sum[kSv] = multiply_add(column[1][j], c, sum[kSv]);
      sum[kSvv] = multiply_add(column[2][j], c, sum[kSvv]);
    }
    for (int entry = 0; entry < kJet; ++entry)
    {
      place.jet[entry][k] = sum[entry];
    }
  }
  if (Rational)
  {
    divide_by_weight<P>(place);
  }
  complete<P>(query, place);
}

/// What a foot is made of, of the lanes whose bits are set.
template <bool Rational>
HWY_INLINE void unpack(const PlaceOf<Lanes>& place, unsigned lanes, Descent* const* packet)
{
  const Lanes::Tag tag;
  constexpr int kColumns = Rational ? 4 : 3;
  HWY_ALIGN double numbers[3 * 2 + 2 * 3 + 1 + 3 * kColumns][Lanes::kCount];
  int count = 0;
  const auto put = [&](const Lanes& lane) { hn::Store(lane.value, tag, numbers[count++]); };
  for (int i = 0; i < 2; ++i)
  {
    put(place.t[i]);
    put(place.gradient[i]);
    put(place.metric[i]);
  }
  for (int k = 0; k < 3; ++k)
  {
    put(place.r[k]);
    put(place.hessian[k]);
  }
  put(place.squared);
  for (int entry = kS; entry <= kSv; ++entry)
  {
    for (int k = 0; k < kColumns; ++k)
    {
      put(place.jet[entry][k]);
    }
  }
  for (; lanes != 0; lanes &= lanes - 1)
  {
    const auto lane = hwy::Num0BitsBelowLS1Bit_Nonzero32(lanes);
    Place& to = packet[lane]->place;
    int next = 0;
    const auto take = [&]() { return numbers[next++][lane]; };
    for (int i = 0; i < 2; ++i)
    {
      to.t[i] = take();
      to.gradient[i] = take();
      to.metric[i] = take();
    }
    for (int k = 0; k < 3; ++k)
    {
      to.r[k] = take();
      to.hessian[k] = take();
    }
    to.squared = take();
    for (int entry = kS; entry <= kSv; ++entry)
    {
      for (int k = 0; k < kColumns; ++k)
      {
        to.jet[entry][k] = take();
      }
    }
  }
}

/// iterate() on the whole piece for a packet of up to Lanes::kCount queries of the same piece.
template <int P, int Q, bool Rational>
HWY_NOINLINE void iterate_packet(Descent* const* packet, int size)
{
  const Lanes::Tag tag;
  const Piece& piece = *packet[0]->query.piece;
  HWY_ALIGN double numbers[5][Lanes::kCount];
  for (int lane = 0; lane < Lanes::kCount; ++lane)
  {
    const Descent& descent = *packet[lane < size ? lane : 0];
    numbers[0][lane] = descent.place.t[0];
    numbers[1][lane] = descent.place.t[1];
    for (int k = 0; k < 3; ++k)
    {
      numbers[2 + k][lane] = descent.query.p[k];
    }
  }
  const auto load = [&](int k) { return Lanes(hn::Load(tag, numbers[k])); };
  const Lanes p[3] = { load(2), load(3), load(4) };
  PlaceOf<Lanes> place;
  place.t = { { load(0), load(1) } };
  std::array<Lanes, 2> last = place.t;
  Lanes squared(kInfinity);
  Lanes before(1.0);
  const Lanes zero(0.0);
  const Lanes one(1.0);
  unsigned active = (1U << size) - 1U;
  /// Ends lanes that have not come to the minimum, at t.
  const auto stop = [&](unsigned lanes, Steps steps, const std::array<Lanes, 2>& t, int count)
  {
    for (active &= ~lanes; lanes != 0; lanes &= lanes - 1)
    {
      const auto lane = hwy::Num0BitsBelowLS1Bit_Nonzero32(lanes);
      Descent& descent = *packet[lane];
      descent.steps = steps;
      descent.count = count;
      descent.stale = true;
      for (int i = 0; i < 2; ++i)
      {
        hn::Store(t[i].value, tag, numbers[i]);
        (steps == Steps::Left ? descent.target : descent.place.t)[i] = numbers[i][lane];
      }
    }
  };
  for (int count = 1; active != 0; ++count)
  {
    evaluate_lanes<P, Q, Rational>(piece, p, place);
    const unsigned farther = active & ~(place.squared < squared);
    if (farther != 0)
    {
      stop(farther, Steps::Stuck, last, count + 1);
    }
    const PlainStep<Lanes> step = plain_step<P>(place);
    const unsigned definite = (zero < step.positive) & (step.least < step.determinant);
    const std::array<Lanes, 2> target{ { place.t[0] + step.way[0], place.t[1] + step.way[1] } };
    unsigned inside = (zero < target[1]) & (target[1] < one);
    if (P != 0)
    {
      inside &= (zero < target[0]) & (target[0] < one);
    }
    const unsigned leaving = active & definite & ~inside;
    if (leaving != 0)
    {
      HWY_ALIGN double at[2][Lanes::kCount];
      hn::Store(place.t[0].value, tag, at[0]);
      hn::Store(place.t[1].value, tag, at[1]);
      for (unsigned rest = leaving; rest != 0; rest &= rest - 1)
      {
        const auto lane = hwy::Num0BitsBelowLS1Bit_Nonzero32(rest);
        packet[lane]->place.t = { { at[0][lane], at[1][lane] } };
      }
      stop(leaving, Steps::Left, target, count);
    }
    const unsigned stuck = count >= kMostSteps ? active : active & ~definite;
    if (stuck != 0)
    {
      stop(stuck, Steps::Stuck, place.t, count);
    }
    const Lanes longest(hn::Max(hn::Abs(step.way[0].value), hn::Abs(step.way[1].value)));
    const unsigned done =
      active & (longest <= Lanes(kShortStep)) & (longest <= Lanes(kFastDecrease) * before);
    if (done != 0)
    {
      PlaceOf<Lanes> end = place;
      expand<P, Rational ? 4 : 3>(p, target, end);
      unpack<Rational>(end, done, packet);
      for (unsigned rest = done; rest != 0; rest &= rest - 1)
      {
        Descent& descent = *packet[hwy::Num0BitsBelowLS1Bit_Nonzero32(rest)];
        descent.steps = Steps::Done;
        descent.count = count;
        descent.stale = false;
      }
      active &= ~done;
    }
    before = longest;
    squared = place.squared;
    last = place.t;
    place.t = target;
  }
}

/// take_plain_steps() for queries of the same piece.
void take_plain_steps(Descent* const* packet, int size)
{
  if (size == 1)
  {
    take_plain_steps(*packet[0]);
    return;
  }
  with_shape(*packet[0]->query.piece->shape,
    [&](auto p, auto q, auto rational) { iterate_packet<p(), q(), rational()>(packet, size); });
}

} // namespace
} // namespace HWY_NAMESPACE
} // namespace footpoint
HWY_AFTER_NAMESPACE();

#endif
