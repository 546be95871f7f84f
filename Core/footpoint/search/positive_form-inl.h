// SPDX-License-Identifier: BSD-3-Clause

// PositiveForm: proves that a polynomial in Bernstein form is positive. Compiled once for each set of vector
// instructions (the guard of Highway's "-inl.h" headers).
#if defined(FOOTPOINT_POSITIVE_FORM_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FOOTPOINT_POSITIVE_FORM_INL_H
#undef FOOTPOINT_POSITIVE_FORM_INL_H
#else
#define FOOTPOINT_POSITIVE_FORM_INL_H
#endif

#include "footpoint/search/piece_evaluation-inl.h"

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

/// A polynomial of degree (n, m) that is nearly zero at its minimum, proved to be positive by cutting it
/// there: in a cell with the minimum at a corner all coefficients of what is left after a square form that is
/// positive and has the same mixed coefficient at that corner have to be positive; in other cells all
/// coefficients. Cells that fail are halved; a corner that is not positive ends the attempt.
///
/// Rounding: cutting adds 4 (max(n, m) + 1) u × the greatest coefficient each time.
///
/// \tparam N, M degrees; −1: any \tparam Width rows are padded to whole multiples of this
template <int N, int M, int Width>
class PositiveForm
{
public:
  static constexpr int kMostCuts = 10; ///< one after the other
  static constexpr int kMostColumns =
    ((M < 0 ? 2 * kMaximumDegree : M) + Width) / Width * Width;

  /// \param foot where it is nearly zero, or may be
  PositiveForm(int n, int m, const Pair& foot, double* memory)
    : Rows(n + 1)
    , Columns(m + 1)
    , T(foot)
    , Memory(memory)
  {
  }

  /// Numbers of memory that it needs.
  static int size_of_memory(int n, int m)
  {
    const int stride = (m + Width) / Width * Width;
    return (kMostCuts + 1) * (n + 1) * stride + 4 * (m + 1) * stride;
  }

  HWY_INLINE int n() const { return N >= 0 ? N : this->Rows - 1; }
  HWY_INLINE int m() const { return M >= 0 ? M : this->Columns - 1; }
  /// Numbers from one row to the next; the last one is repeated.
  HWY_INLINE int stride() const { return (this->m() + Width) / Width * Width; }
  /// Numbers of a cell.
  HWY_INLINE int size() const { return (this->n() + 1) * this->stride(); }

  /// Whether the polynomial is positive for certain whose coefficients the memory begins with, and loses.
  /// \param greatest of the coefficients, by magnitude \param most_cells to look at; after that another way is
  ///        better
  bool is_positive(double greatest, int most_cells)
  {
    this->ErrorOfCut = 4.0 * (std::max(this->n(), this->m()) + 1) * kRounding * greatest;
    Cell cells[kMostCuts + 1];
    cells[0].cuts = 0;
    for (int i = 0; i < 2; ++i)
    {
      const bool is_line = i == 0 && this->n() == 0; // of a curve, whose first parameter is none
      cells[0].foot[i] = is_line || this->T[i] <= 0.0 ? FootAt::Start
        : this->T[i] >= 1.0                           ? FootAt::End
                                                      : FootAt::Middle;
    }
    int left = 1;
    for (int cells_seen = 0; left > 0; ++cells_seen)
    {
      const Cell cell = cells[left - 1];
      double* f = this->Memory + (left - 1) * this->size();
      const double error = cell.cuts * this->ErrorOfCut;
      if (cells_seen == most_cells || !this->corners_are_above(f, error))
      {
        return false;
      }
      if (this->is_above(f, error) || this->is_above_square(cell, f, error))
      {
        --left;
        continue;
      }
      if (cell.cuts == kMostCuts)
      {
        return false;
      }
      const bool has_foot = cell.foot[0] != FootAt::Elsewhere && cell.foot[1] != FootAt::Elsewhere;
      Cell low = cell;
      ++low.cuts;
      Cell high = low;
      double* upper = f + this->size();
      int i = 0;
      double at = 0.5;
      if (has_foot && (cell.foot[0] == FootAt::Middle || cell.foot[1] == FootAt::Middle))
      {
        i = cell.foot[0] == FootAt::Middle ? 0 : 1;
        at = this->T[i];
        low.foot[i] = FootAt::End;
        high.foot[i] = FootAt::Start;
      }
      else
      {
        i = this->longer_direction(f);
        low.foot[i] = cell.foot[i] == FootAt::Start ? FootAt::Start : FootAt::Elsewhere;
        high.foot[i] = cell.foot[i] == FootAt::End ? FootAt::End : FootAt::Elsewhere;
      }
      i == 0 ? this->cut_rows(f, at, upper) : this->cut_columns(f, this->weights(at), upper);
      cells[left - 1] = low;
      cells[left++] = high;
    }
    return true;
  }

private:
  /// Where the foot is along a direction of a cell.
  enum class FootAt
  {
    Start,
    Middle,
    End,
    Elsewhere
  };
  struct Cell
  {
    FootAt foot[2];
    int cuts;
  };

  /// Values of the form, below which no cut helps.
  bool corners_are_above(const double* f, double error) const
  {
    const double* last = f + this->n() * this->stride();
    return f[0] >= error && f[this->m()] >= error && last[0] >= error && last[this->m()] >= error;
  }

  bool is_above(const double* f, double error) const
  {
    const hn::CappedTag<double, Width> tag;
    auto least = hn::LoadU(tag, f);
    for (int k = 0; k < this->size(); k += static_cast<int>(hn::Lanes(tag)))
    {
      least = hn::Min(least, hn::LoadU(tag, f + k));
    }
    return hn::GetLane(hn::MinOfLanes(tag, least)) >= error;
  }

  /// The same after a square form about the foot, whose coefficients are a i (i − 1) − b i j + c j (j − 1)
  /// from the foot's corner on: not negative for a c ≥ b² n m / (4 (n − 1) (m − 1)).
  bool is_above_square(const Cell& cell, const double* f, double error) const
  {
    const bool ends[2] = { cell.foot[0] == FootAt::End, cell.foot[1] == FootAt::End };
    const int n = this->n();
    const int m = this->m();
    const int stride = this->stride();
    if (n == 0 || !(ends[0] || cell.foot[0] == FootAt::Start) ||
      !(ends[1] || cell.foot[1] == FootAt::Start))
    {
      return false;
    }
    const auto at = [&](int i, int j)
    { return f[(ends[0] ? n - i : i) * stride + (ends[1] ? m - j : j)]; };
    const double most_a = 0.5 * at(2, 0);
    const double most_c = 0.5 * at(0, 2);
    // With the mixed coefficient all of its error is taken away, and the rounding of what is.
    const double mixed = at(1, 1);
    const double allowance = error +
      8.0 * kRounding *
        (std::abs(most_a) * n * n + std::abs(most_c) * m * m + std::abs(mixed) * n * m);
    const double b = (allowance - mixed) * (1.0 + 8.0 * kRounding);
    // Beyond the range of double precision on the safe side, so that the part is not too small.
    const double least = std::max(
      b * b * (0.25 * n * m / ((n - 1.0) * (m - 1.0))), std::numeric_limits<double>::min());
    const double most = std::min(most_a * most_c, std::numeric_limits<double>::max());
    if (!(b > 0.0 && most_a > 0.0 && most_c > 0.0 && least < most))
    {
      return false;
    }
    const double part = std::sqrt(least / most) * (1.0 + 8.0 * kRounding);
    const double a = part * most_a;
    const double c = part * most_c;
    double along_v[kMostColumns];
    double step_v[kMostColumns];
    for (int j = 0; j < stride; ++j)
    {
      const int k = ends[1] ? std::max(m - j, 0) : std::min(j, m);
      along_v[j] = c * (k * (k - 1.0)) + allowance;
      step_v[j] = b * k;
    }
    const hn::CappedTag<double, Width> tag;
    constexpr int kLanes = static_cast<int>(hn::MaxLanes(hn::CappedTag<double, Width>()));
    for (int i = 0; i <= n; ++i)
    {
      const double k = ends[0] ? n - i : i;
      const auto along_u = hn::Set(tag, a * (k * (k - 1.0)));
      const auto step_u = hn::Set(tag, k);
      for (int j = 0; j < stride; j += kLanes)
      {
        const auto taken = hn::NegMulAdd(
          step_u, hn::LoadU(tag, step_v + j), hn::Add(along_u, hn::LoadU(tag, along_v + j)));
        if (!hn::AllTrue(tag, hn::Ge(hn::LoadU(tag, f + i * stride + j), taken)))
        {
          return false;
        }
      }
    }
    return true;
  }

  /// Matrices of a cut, which is one at the foot or in the middle.
  const double* weights(double s)
  {
    const int number = s == 0.5 ? 1 : 0;
    double* weights = this->Memory + (kMostCuts + 1) * this->size() +
      number * 2 * (this->m() + 1) * this->stride();
    if (!this->IsPrepared[number])
    {
      this->prepare(s, weights);
      this->IsPrepared[number] = true;
    }
    return weights;
  }

  /// Along which the form changes more.
  int longer_direction(const double* f) const
  {
    const int m = this->m();
    const double* last = f + this->n() * this->stride();
    const double along_u = std::abs(last[0] - f[0]) + std::abs(last[m] - f[m]);
    const double along_v = std::abs(f[m] - f[0]) + std::abs(last[m] - last[0]);
    return this->n() > 0 && along_u > along_v ? 0 : 1;
  }

  /// De Casteljau 1959; the coefficients become those of the lower part.
  void cut_rows(double* f, double s, double* upper) const
  {
    const int n = this->n();
    const int stride = this->stride();
    const hn::CappedTag<double, Width> tag;
    constexpr int kLanes = static_cast<int>(hn::MaxLanes(hn::CappedTag<double, Width>()));
    const auto high = hn::Set(tag, s);
    const auto low = hn::Set(tag, 1.0 - s);
    for (int j = 0; j < stride; j += kLanes)
    {
      for (int i = 0; i <= n; ++i)
      {
        hn::StoreU(hn::LoadU(tag, f + i * stride + j), tag, upper + i * stride + j);
      }
      for (int level = 1; level <= n; ++level)
      {
        auto here = hn::LoadU(tag, upper + j);
        for (int i = 0; i <= n - level; ++i)
        {
          double* at = upper + i * stride + j;
          const auto next = hn::LoadU(tag, at + stride);
          const auto between = hn::MulAdd(high, next, hn::Mul(low, here));
          hn::StoreU(between, tag, at);
          if (i == 0)
          {
            hn::StoreU(between, tag, f + level * stride + j);
          }
          here = next;
        }
      }
    }
  }

  /// The same by the matrices of a cut: column j, row k is the weight of coefficient k in coefficient j of
  /// the lower part, after them those of the upper one.
  void cut_columns(double* f, const double* weights, double* upper) const
  {
    const int m = this->m();
    const int stride = this->stride();
    const hn::CappedTag<double, Width> tag;
    constexpr int kLanes = static_cast<int>(hn::MaxLanes(hn::CappedTag<double, Width>()));
    const double* upper_weights = weights + (m + 1) * stride;
    for (int i = 0; i <= this->n(); ++i, f += stride, upper += stride)
    {
      double row[kMostColumns];
      for (int k = 0; k <= m; ++k)
      {
        row[k] = f[k];
      }
      for (int j = 0; j < stride; j += kLanes)
      {
        auto low = hn::Zero(tag);
        auto high = low;
        for (int k = 0; k <= m; ++k)
        {
          const auto value = hn::Set(tag, row[k]);
          low = hn::MulAdd(value, hn::LoadU(tag, weights + k * stride + j), low);
          high = hn::MulAdd(value, hn::LoadU(tag, upper_weights + k * stride + j), high);
        }
        hn::StoreU(low, tag, f + j);
        hn::StoreU(high, tag, upper + j);
      }
    }
  }

  /// Column j: Bernstein polynomials of degree j at s, and of degree m − j.
  void prepare(double s, double* weights) const
  {
    const int m = this->m();
    const int stride = this->stride();
    const double t = 1.0 - s;
    double* upper = weights + (m + 1) * stride;
    double b[kMostColumns] = { 1.0 };
    for (int j = 0; j < stride; ++j)
    {
      if (j > 0 && j <= m)
      {
        b[j] = s * b[j - 1];
        for (int k = j - 1; k > 0; --k)
        {
          b[k] = t * b[k] + s * b[k - 1];
        }
        b[0] *= t;
      }
      const int degree = std::min(j, m);
      for (int k = 0; k <= m; ++k)
      {
        weights[k * stride + j] = k <= degree ? b[k] : 0.0;
        if (j <= m)
        {
          upper[k * stride + m - j] = k >= m - degree ? b[k - m + degree] : 0.0;
        }
        else
        {
          upper[k * stride + j] = upper[k * stride + m];
        }
      }
    }
  }

  int Rows;
  int Columns;
  Pair T; ///< the foot's parameters
  bool IsPrepared[2] = { false, false };
  double ErrorOfCut = 0.0;
  double* Memory; ///< of the cells, one after the other, then of matrices
};

} // namespace
} // namespace HWY_NAMESPACE
} // namespace footpoint
HWY_AFTER_NAMESPACE();

#endif
