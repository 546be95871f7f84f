// SPDX-License-Identifier: BSD-3-Clause

// PositiveForm: proves that a polynomial in Bernstein form is positive. Compiled once for each set
// of vector instructions (the guard of Highway's "-inl.h" headers).
#if defined(FOOTPOINT_POSITIVE_FORM_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FOOTPOINT_POSITIVE_FORM_INL_H
#undef FOOTPOINT_POSITIVE_FORM_INL_H
#else
#define FOOTPOINT_POSITIVE_FORM_INL_H
#endif

#include "footpoint/search/piece_evaluation-inl.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

HWY_BEFORE_NAMESPACE();
namespace footpoint
{
namespace HWY_NAMESPACE
{
namespace
{

/// A polynomial of degree (n, m) that is nearly zero at its minimum, proved to be positive by
/// cutting it there: in a cell with the minimum at a corner all coefficients of what is left after
/// a square form that is positive and has the same mixed coefficient at that corner have to be
/// positive; in other cells all coefficients. Cells that fail are halved; a corner that is not
/// positive ends the attempt.
///
/// A cell is cut across its rows, whole rows at a time; to be cut across its columns it is
/// transposed first, and stays so. A line's only row is taken for a column from the beginning.
///
/// Rounding: cutting adds 4 (max(n, m) + 1) u × the greatest coefficient each time.
///
/// \tparam N, M degrees; −1: any; N is 0 for lines \tparam Width rows are padded to whole multiples
///        of this
template <int N, int M, int Width>
class PositiveForm
{
public:
  static constexpr int kMostCuts = 10; ///< one after the other

  /// \param foot where it is nearly zero, or may be
  PositiveForm(int n, int m, const Pair& foot, double* memory)
    : Degree{ { n, m } }
    , T(foot)
    , Memory(memory)
  {
  }

  /// Numbers of memory that it needs.
  static int size_of_memory(int n, int m) { return (kMostCuts + 1) * size_of_cell(n, m); }

  HWY_INLINE int n() const { return N >= 0 ? N : this->Degree[0]; }
  HWY_INLINE int m() const { return M >= 0 ? M : this->Degree[1]; }
  /// Numbers from one row to the next, as it begins; the last one is repeated.
  HWY_INLINE int stride() const { return (this->m() + Width) / Width * Width; }

  /// Whether the polynomial is positive for certain whose coefficients the memory begins with, and
  /// loses.
  /// \param greatest of the coefficients, by magnitude \param most_cells to look at; after that
  ///        another way is better
  bool is_positive(double greatest, int most_cells)
  {
    const double error_of_cut =
      4.0 * (std::max(this->n(), this->m()) + 1) * kRounding * greatest;
    const int size = size_of_cell(this->n(), this->m());
    Cell cells[kMostCuts + 1];
    cells[0].cuts = 0;
    cells[0].row_direction = kIsLine ? 1 : 0;
    for (int i = 0; i < 2; ++i)
    {
      const int direction = kIsLine ? 1 - i : i;
      const bool is_none = direction == 0 && this->n() == 0; // the first parameter of a line
      cells[0].foot[i] = is_none || this->T[direction] <= 0.0 ? FootAt::Start
        : this->T[direction] >= 1.0                           ? FootAt::End
                                                              : FootAt::Middle;
    }
    int left = 1;
    for (int cells_seen = 0; left > 0; ++cells_seen)
    {
      if (cells_seen == most_cells)
      {
        return false;
      }
      Cell& low = cells[left - 1];
      double* f = this->Memory + (left - 1) * size;
      const double error = low.cuts * error_of_cut;
      const bool has_foot = low.foot[0] != FootAt::Elsewhere && low.foot[1] != FootAt::Elsewhere;
      const bool is_to_be_cut_there =
        has_foot && (low.foot[0] == FootAt::Middle || low.foot[1] == FootAt::Middle);
      // One that is cut at the foot already and will be once more has the foot on a side.
      if (!is_to_be_cut_there || low.cuts == 0)
      {
        if (this->is_above(low, f, error) ||
          (has_foot && !is_to_be_cut_there && this->is_above_square(low, f, error)))
        {
          --left;
          continue;
        }
        if (low.cuts == kMostCuts || !this->corners_are_above(low, f, error))
        {
          return false;
        }
      }
      double* upper = f + size;
      const int across = is_to_be_cut_there ? (low.foot[0] == FootAt::Middle ? 0 : 1)
                                            : this->longer_direction(low, f);
      this->copy_with_rows_across(across, low, f, upper);
      const double at = is_to_be_cut_there ? this->T[low.row_direction] : 0.5;
      this->cut(low, at, f, upper);
      ++low.cuts;
      Cell& high = cells[left++];
      high = low;
      const FootAt foot = low.foot[0];
      low.foot[0] = foot == FootAt::Start ? FootAt::Start
        : is_to_be_cut_there              ? FootAt::End
                                          : FootAt::Elsewhere;
      high.foot[0] = foot == FootAt::End ? FootAt::End
        : is_to_be_cut_there             ? FootAt::Start
                                         : FootAt::Elsewhere;
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
    FootAt foot[2];    ///< along its columns, from row to row, and along its rows
    int row_direction; ///< of the polynomial, along which its rows follow each other
    int cuts;
  };
  static constexpr bool kIsLine = N == 0;
  static constexpr bool kIsSquare = N > 0 && N == M;
  static constexpr int kWidth = kIsLine ? 1 : Width;
  static constexpr int kMostRows = N >= 0 && M >= 0 ? std::max(N, M) + 1 : 2 * kMaximumDegree + 1;
  using Tag = hn::CappedTag<double, std::min(kWidth, kMostLanes)>;
  static constexpr int kLanes = static_cast<int>(hn::MaxLanes(Tag())); // of one size here

  static HWY_INLINE int stride_of(int degree) { return (degree + kWidth) / kWidth * kWidth; }
  /// Numbers of a cell, and of the transposed one.
  static HWY_INLINE int size_of_cell(int n, int m)
  {
    return std::max((n + 1) * stride_of(m), (m + 1) * stride_of(n));
  }
  /// Degrees of a cell from row to row, and along its rows.
  HWY_INLINE int n(const Cell& cell) const
  {
    return kIsSquare ? N : kIsLine ? this->m() : this->Degree[cell.row_direction];
  }
  HWY_INLINE int m(const Cell& cell) const
  {
    return kIsSquare ? M : kIsLine ? 0 : this->Degree[1 - cell.row_direction];
  }

  /// Values of the form, below which no cut helps.
  bool corners_are_above(const Cell& cell, const double* f, double error) const
  {
    const int m = this->m(cell);
    const double* last = f + this->n(cell) * stride_of(m);
    return f[0] >= error && f[m] >= error && last[0] >= error && last[m] >= error;
  }

  HWY_INLINE bool is_above(const Cell& cell, const double* f, double error) const
  {
    const int n = this->n(cell);
    if constexpr (kIsLine)
    {
      return std::all_of(f, f + n + 1, [&](double each) { return each >= error; });
    }
    const Tag tag;
    const int m = this->m(cell);
    const auto least = hn::Set(tag, error);
    auto above = hn::Ge(least, least);
    for (int i = 0; i <= n; ++i, f += stride_of(m))
    {
      for (int j = 0; j <= m; j += kLanes)
      {
        above = hn::And(above, hn::Ge(hn::LoadU(tag, f + j), least));
      }
    }
    return hn::AllTrue(tag, above);
  }

  /// The same after a square form about the foot, whose coefficients are
  /// a i (i − 1) − b i j + c j (j − 1) from the foot's corner on: not negative for a c ≥ b² n m /
  /// (4 (n − 1) (m − 1)).
  /// \pre the foot is at a corner
  HWY_INLINE bool is_above_square(const Cell& cell, const double* f, double error) const
  {
    const int n = this->n(cell);
    const int m = this->m(cell);
    if (n == 0 || m == 0)
    {
      return false;
    }
    const int stride = stride_of(m);
    const bool is_last_row = cell.foot[0] == FootAt::End;
    const bool is_last_column = cell.foot[1] == FootAt::End;
    const auto at = [&](int i, int j)
    { return f[(is_last_row ? n - i : i) * stride + (is_last_column ? m - j : j)]; };
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
    const Tag tag;
    auto above = hn::Ge(hn::Zero(tag), hn::Zero(tag));
    for (int j = 0; j <= m; j += kLanes)
    {
      // From the foot's corner on; what pads a row is its last number.
      const auto column =
        hn::Min(hn::Iota(tag, static_cast<double>(j)), hn::Set(tag, static_cast<double>(m)));
      const auto k =
        is_last_column ? hn::Sub(hn::Set(tag, static_cast<double>(m)), column) : column;
      const auto along = hn::MulAdd(hn::Mul(hn::Set(tag, c), k), hn::Sub(k, hn::Set(tag, 1.0)),
        hn::Set(tag, allowance));
      const auto step = hn::Mul(hn::Set(tag, b), k);
      for (int i = 0; i <= n; ++i)
      {
        const double row = is_last_row ? n - i : i;
        const auto taken = hn::NegMulAdd(
          hn::Set(tag, row), step, hn::Add(hn::Set(tag, a * (row * (row - 1.0))), along));
        above = hn::And(above, hn::Ge(hn::LoadU(tag, f + i * stride + j), taken));
      }
    }
    return hn::AllTrue(tag, above);
  }

  /// Along which the form changes more: 0 from row to row.
  int longer_direction(const Cell& cell, const double* f) const
  {
    const int n = this->n(cell);
    const int m = this->m(cell);
    const double* last = f + n * stride_of(m);
    const double along_column = std::abs(last[0] - f[0]) + std::abs(last[m] - f[m]);
    const double along_row = std::abs(f[m] - f[0]) + std::abs(last[m] - last[0]);
    return m == 0 || (n > 0 && along_column > along_row) ? 0 : 1;
  }

  /// \param across direction of the cell that its rows are to follow each other along
  HWY_INLINE void copy_with_rows_across(
    int across, Cell& cell, const double* f, double* result) const
  {
    const int n = this->n(cell);
    const int m = this->m(cell);
    const int stride = stride_of(m);
    if (across == 0)
    {
      std::copy(f, f + (n + 1) * stride, result);
      return;
    }
    std::swap(cell.foot[0], cell.foot[1]);
    cell.row_direction = 1 - cell.row_direction;
    // Blocks of four rows.
    const hn::CappedTag<double, 4> tag;
    constexpr int kColumns = static_cast<int>(hn::MaxLanes(hn::CappedTag<double, 4>()));
    const int result_stride = stride_of(n);
    for (int i = 0; i < result_stride; i += 4)
    {
      // The last one pads.
      const double* rows[4];
      for (int k = 0; k < 4; ++k)
      {
        rows[k] = f + std::min(i + k, n) * stride;
      }
      for (int j = 0; j <= m; j += kColumns)
      {
        HWY_ALIGN double columns[4 * kColumns];
        hn::StoreInterleaved4(hn::LoadU(tag, rows[0] + j), hn::LoadU(tag, rows[1] + j),
          hn::LoadU(tag, rows[2] + j), hn::LoadU(tag, rows[3] + j), tag, columns);
        for (int k = 0; k < std::min(kColumns, m - j + 1); ++k)
        {
          for (int l = 0; l < 4; l += kColumns)
          {
            hn::StoreU(
              hn::Load(tag, columns + 4 * k + l), tag, result + (j + k) * result_stride + i + l);
          }
        }
      }
    }
  }

  /// De Casteljau 1959.
  /// \param upper with the coefficients, whose place those of the upper part take \param lower
  ///        receives the others
  HWY_INLINE void cut(const Cell& cell, double s, double* lower, double* upper) const
  {
    const int n = this->n(cell);
    if constexpr (kIsLine)
    {
      lower[0] = upper[0];
      for (int level = 1; level <= n; ++level)
      {
        for (int i = 0; i <= n - level; ++i)
        {
          upper[i] = s * upper[i + 1] + (1.0 - s) * upper[i];
        }
        lower[level] = upper[0];
      }
      return;
    }
    const Tag tag;
    const int m = this->m(cell);
    const int stride = stride_of(m);
    const auto high = hn::Set(tag, s);
    const auto low = hn::Set(tag, 1.0 - s);
    for (int j = 0; j <= m; j += kLanes)
    {
      hn::Vec<Tag> row[kMostRows];
      for (int i = 0; i <= n; ++i)
      {
        row[i] = hn::LoadU(tag, upper + i * stride + j);
      }
      hn::StoreU(row[0], tag, lower + j);
      for (int level = 1; level <= n; ++level)
      {
        for (int i = 0; i <= n - level; ++i)
        {
          row[i] = hn::MulAdd(high, row[i + 1], hn::Mul(low, row[i]));
        }
        hn::StoreU(row[0], tag, lower + level * stride + j);
      }
      for (int i = 0; i <= n; ++i)
      {
        hn::StoreU(row[i], tag, upper + i * stride + j);
      }
    }
  }

  std::array<int, 2> Degree;
  Pair T; ///< the foot's parameters
  double* Memory; ///< of the cells, one after the other
};

} // namespace
} // namespace HWY_NAMESPACE
} // namespace footpoint
HWY_AFTER_NAMESPACE();

#endif
