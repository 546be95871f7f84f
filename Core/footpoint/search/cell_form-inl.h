// SPDX-License-Identifier: BSD-3-Clause

// The distance form of a small cell, formed anew from the control net relative to the best foot, and
// lower bounds of such polynomials (Documentation/CertifiedSearch.md, "Hard cells"). Compiled once for
// each set of vector instructions (the guard of Highway's "-inl.h" headers).
#if defined(FOOTPOINT_CELL_FORM_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FOOTPOINT_CELL_FORM_INL_H
#undef FOOTPOINT_CELL_FORM_INL_H
#else
#define FOOTPOINT_CELL_FORM_INL_H
#endif

#include "footpoint/search/piece_descent-inl.h"

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace footpoint
{
namespace HWY_NAMESPACE
{
namespace
{

/// Degrees of splines end at 31 (KnotVector): so many control points along one direction, and so many
/// coefficients of a product, padded for vectors of eight.
constexpr int kMostPoints = 32;
constexpr int kMostTerms = 64;

/// A Bernstein polynomial of degrees n by m over a cell: rows along u.
struct CellPolynomial
{
  int n;
  int m;
  double error; ///< bound of the error of each coefficient
  double greatest; ///< of all coefficients, by magnitude
  double rows[kMostTerms][kMostTerms];
};

/// Control points of a cell, (S − origin) w and w, one plane a coordinate.
struct CellNet
{
  int p;
  int q;
  double planes[4][kMostPoints][kMostPoints];
};

/// The polygon of [0, 1] becomes that of [lower, upper] (de Casteljau 1959); one point where these are
/// the same. Three roundings a step and end, 6 · degree in all.
HWY_INLINE void restrict_polygon(double* values, int degree, double lower, double upper)
{
  if (upper < 1.0)
  {
    const double left = 1.0 - upper;
    for (int level = 1; level <= degree; ++level)
    {
      for (int k = degree; k >= level; --k)
      {
        values[k] = left * values[k - 1] + upper * values[k];
      }
    }
  }
  if (lower > 0.0)
  {
    const double right = std::min(lower / upper, 1.0);
    const double left = 1.0 - right;
    for (int level = 1; level <= degree; ++level)
    {
      for (int k = 0; k <= degree - level; ++k)
      {
        values[k] = left * values[k] + right * values[k + 1];
      }
    }
  }
}

/// The control net over a range, positions relative to `origin`; a direction of no width gets degree 0.
inline void cell_net(const Piece& piece, const Range& range, const double* origin, CellNet& net)
{
  const int p = piece.shape->degree[0];
  const int q = piece.shape->degree[1];
  net.p = range.lower[0] < range.upper[0] ? p : 0;
  net.q = range.lower[1] < range.upper[1] ? q : 0;
  double lines[kMostPoints];
  for (int c = 0; c < 4; ++c)
  {
    for (int i = 0; i <= p; ++i)
    {
      double* row = net.planes[c][i];
      for (int j = 0; j <= q; ++j)
      {
        const double* control = piece.net + 4 * (i * (q + 1) + j);
        row[j] = c < 3 ? control[c] - control[3] * origin[c] : control[3];
      }
      restrict_polygon(row, q, range.lower[1], range.upper[1]);
    }
    for (int j = 0; p > 0 && j <= net.q; ++j)
    {
      for (int i = 0; i <= p; ++i)
      {
        lines[i] = net.planes[c][i][j];
      }
      restrict_polygon(lines, p, range.lower[0], range.upper[0]);
      for (int i = 0; i <= net.p; ++i)
      {
        net.planes[c][i][j] = lines[i];
      }
    }
  }
}

/// Binomial coefficients of one degree, padded with ones.
struct Binomials
{
  double row[kMostTerms];

  explicit Binomials(int n)
  {
    std::fill(this->row, this->row + kMostTerms, 1.0);
    for (int k = 1; k < n; ++k)
    {
      this->row[k] = this->row[k - 1] * (n - k + 1) / k;
    }
  }
};

/// Sums of products of polynomials of degree (p, q), then their Bernstein coefficients.
class CellProduct
{
public:
  CellProduct(int p, int q)
    : P(p)
    , Q(q)
    , U(p)
    , V(q)
    , UU(2 * p)
    , VV(2 * q)
  {
  }

  /// Multiplies by the binomial coefficients; pads with zeros.
  void scale(double (*plane)[kMostPoints]) const
  {
    const int padded = (this->Q + 8) / 8 * 8;
    for (int i = 0; i <= this->P; ++i)
    {
      for (int j = 0; j <= this->Q; ++j)
      {
        plane[i][j] *= this->U.row[i] * this->V.row[j];
      }
      std::fill(plane[i] + this->Q + 1, plane[i] + padded, 0.0);
    }
  }

  double scale_of(int i, int j) const { return this->U.row[i] * this->V.row[j]; }

  static void clear(CellPolynomial& sum)
  {
    for (int k = 0; k <= sum.n; ++k)
    {
      std::fill(sum.rows[k], sum.rows[k] + std::min((sum.m + 16) / 8 * 8, kMostTerms), 0.0);
    }
  }

  /// sum += factor · a · b, both scaled.
  void add(double factor, const double (*a)[kMostPoints], const double (*b)[kMostPoints],
    CellPolynomial& sum) const
  {
    const hn::CappedTag<double, 8> tag;
    const int lanes = static_cast<int>(hn::Lanes(tag));
    for (int i = 0; i <= this->P; ++i)
    {
      for (int k = 0; k <= this->P; ++k)
      {
        double* to = sum.rows[i + k];
        for (int l = 0; l <= this->Q; l += lanes)
        {
          const auto right = hn::LoadU(tag, b[k] + l);
          for (int j = 0; j <= this->Q; ++j)
          {
            const auto left = hn::Set(tag, factor * a[i][j]);
            hn::StoreU(hn::MulAdd(left, right, hn::LoadU(tag, to + j + l)), tag, to + j + l);
          }
        }
      }
    }
  }

  /// Bernstein coefficients of a sum of products.
  void finish(const CellPolynomial& sum, CellPolynomial& result) const
  {
    result.greatest = 0.0;
    for (int k = 0; k <= sum.n; ++k)
    {
      for (int l = 0; l <= sum.m; ++l)
      {
        result.rows[k][l] = sum.rows[k][l] / (this->UU.row[k] * this->VV.row[l]);
        result.greatest = std::max(result.greatest, std::abs(result.rows[k][l]));
      }
    }
  }

private:
  int P;
  int Q;
  Binomials U;
  Binomials V;
  Binomials UU;
  Binomials VV;
};

/// Value and gradient of a polynomial at a place of its cell, in units of the cell.
struct Tangent
{
  double value;
  Pair slope;
};

inline Tangent tangent_of(const CellPolynomial& f, const Pair& at)
{
  // Along v to the last two points of each row, then along u.
  double values[kMostTerms];
  double slopes[kMostTerms];
  double line[kMostTerms];
  auto reduce = [](double* points, int degree, double t, double& slope)
  {
    const double s = 1.0 - t;
    for (int level = degree; level > 1; --level)
    {
      for (int k = 0; k < level; ++k)
      {
        points[k] = s * points[k] + t * points[k + 1];
      }
    }
    slope = degree > 0 ? degree * (points[1] - points[0]) : 0.0;
    return degree > 0 ? s * points[0] + t * points[1] : points[0];
  };
  for (int i = 0; i <= f.n; ++i)
  {
    std::copy(f.rows[i], f.rows[i] + f.m + 1, line);
    values[i] = reduce(line, f.m, at[1], slopes[i]);
  }
  Tangent tangent;
  double unused;
  tangent.value = reduce(values, f.n, at[0], tangent.slope[0]);
  tangent.slope[1] = reduce(slopes, f.n, at[0], unused);
  return tangent;
}

/// The smallest value of slope · x + ½ bend · x² for x between lower and upper.
HWY_INLINE double least_of_parabola(double slope, double bend, double lower, double upper)
{
  double least = std::min(
    lower * (slope + 0.5 * bend * lower), upper * (slope + 0.5 * bend * upper));
  if (bend > 0.0 && -slope > bend * lower && -slope < bend * upper)
  {
    least = -0.5 * slope * slope / bend;
  }
  return least;
}

/// What the coefficients of a polynomial over a cell say.
class CellBounds
{
public:
  explicit CellBounds(const CellPolynomial& f)
    : F(f)
  {
    // A difference of two coefficients has twice their error, and two roundings of the greatest.
    this->First = 2.0 * (f.error + kRounding * f.greatest);
    double uu = kInfinity;
    double vv = kInfinity;
    double uv = 0.0;
    for (int i = 0; i <= f.n; ++i)
    {
      const double* row = f.rows[i];
      for (int j = 0; j <= f.m; ++j)
      {
        this->Least = std::min(this->Least, row[j]);
        if (i > 0)
        {
          const double u = row[j] - f.rows[i - 1][j];
          this->LeastFirst[0] = std::min(this->LeastFirst[0], u);
          this->GreatestFirst[0] = std::max(this->GreatestFirst[0], u);
          if (i > 1)
          {
            const double second = u - (f.rows[i - 1][j] - f.rows[i - 2][j]);
            uu = std::min(uu, second);
            this->GreatestSecond[0] = std::max(this->GreatestSecond[0], std::abs(second));
          }
          if (j > 0)
          {
            uv = std::max(uv, std::abs(u - (row[j - 1] - f.rows[i - 1][j - 1])));
          }
        }
        if (j > 0)
        {
          const double v = row[j] - row[j - 1];
          this->LeastFirst[1] = std::min(this->LeastFirst[1], v);
          this->GreatestFirst[1] = std::max(this->GreatestFirst[1], v);
          if (j > 1)
          {
            const double second = v - (row[j - 1] - row[j - 2]);
            vv = std::min(vv, second);
            this->GreatestSecond[1] = std::max(this->GreatestSecond[1], std::abs(second));
          }
        }
      }
    }
    // Of the polynomial with just these coefficients: the error of its values comes off at the end.
    // What remains is the rounding of a second difference, six of the greatest, and of its factor.
    const double rounding = 8.0 * kRounding * f.greatest;
    this->Bend[0] = f.n * (f.n - 1.0) * (uu - rounding);
    this->Bend[1] = f.m * (f.m - 1.0) * (vv - rounding);
    this->Twist = f.n > 0 && f.m > 0 ? f.n * static_cast<double>(f.m) * (uv + rounding) : 0.0;
  }

  /// 0 or 1: it falls towards that end of a direction, or nowhere rises; −1: cannot be told.
  int monotone(int i) const
  {
    return (i == 0 ? this->F.n : this->F.m) == 0 ? -1
      : this->LeastFirst[i] > this->First       ? 0
      : this->GreatestFirst[i] < -this->First   ? 1
                                                : -1;
  }

  /// How far the coefficients of one direction bend, to choose a cut.
  double bend(int i) const
  {
    const int degree = i == 0 ? this->F.n : this->F.m;
    return degree * (degree - 1.0) * this->GreatestSecond[i];
  }

  /// The coefficients are not below a number.
  bool above(double number) const { return this->Least >= number + this->F.error; }

  /// Convex, and the parabola that touches it at a place is not below a number.
  bool supported(double number, const Pair& at) const
  {
    const CellPolynomial& f = this->F;
    const bool has_u = f.n > 0;
    const bool has_v = f.m > 0;
    double part = 1.0; // of the second derivatives that is left beside the mixed one
    if ((has_u && !(this->Bend[0] > 0.0)) || (has_v && !(this->Bend[1] > 0.0)))
    {
      return false;
    }
    if (has_u && has_v)
    {
      part = 1.0 - this->Twist / std::sqrt(this->Bend[0] * this->Bend[1]) * (1.0 + 8.0 * kRounding);
      if (!(part > 0.0))
      {
        return false;
      }
    }
    const Tangent tangent = tangent_of(f, at);
    // 3 roundings a step of de Casteljau's; slopes are n times differences.
    const double rounding = kRounding * f.greatest * (3.0 * (f.n + f.m) + 8.0) *
      (1.0 + 2.0 * f.n + 2.0 * f.m);
    double value = tangent.value;
    for (int i = 0; i < 2; ++i)
    {
      if (i == 0 ? has_u : has_v)
      {
        value += least_of_parabola(tangent.slope[i], part * this->Bend[i], -at[i], 1.0 - at[i]);
      }
    }
    return value >= number + f.error + rounding;
  }

  /// Along the lines of one direction, parabolas that touch at one end are not below a number:
  ///   F(u, v) ≥ Σ_i B_i(u) (F_i + F'_i v + ½ min F''_i v²).
  bool supported_from_side(double number, int direction, int end) const
  {
    const CellPolynomial& f = this->F;
    const int degree = direction == 0 ? f.n : f.m;
    const int lines = direction == 0 ? f.m : f.n;
    if (degree < 2)
    {
      return false;
    }
    auto at = [&](int line, int k)
    {
      const int along = end == 0 ? k : degree - k;
      return direction == 0 ? f.rows[along][line] : f.rows[line][along];
    };
    // A slope has n times the error of two coefficients, the parabola's end that of three: 4 n² bounds
    // both, with the roundings of this sum.
    const double rounding = kRounding * f.greatest * 8.0 * degree * degree;
    for (int line = 0; line <= lines; ++line)
    {
      double bend = kInfinity;
      for (int k = 2; k <= degree; ++k)
      {
        bend = std::min(bend, at(line, k) - 2.0 * at(line, k - 1) + at(line, k - 2));
      }
      const double slope = degree * (at(line, 1) - at(line, 0));
      const double value =
        at(line, 0) + least_of_parabola(slope, degree * (degree - 1.0) * bend, 0.0, 1.0);
      if (!(value >= number + f.error + rounding))
      {
        return false;
      }
    }
    return true;
  }

  /// Any of these.
  bool not_below(double number, const Pair& at) const
  {
    return this->above(number) || this->supported(number, at) ||
      this->supported_from_side(number, 0, 0) || this->supported_from_side(number, 0, 1) ||
      this->supported_from_side(number, 1, 0) || this->supported_from_side(number, 1, 1);
  }

private:
  const CellPolynomial& F;
  double Least = kInfinity;
  double First;
  double LeastFirst[2] = { kInfinity, kInfinity };
  double GreatestFirst[2] = { -kInfinity, -kInfinity };
  double GreatestSecond[2] = { 0.0, 0.0 };
  double Bend[2]; ///< lower bounds of the second derivatives
  double Twist;   ///< upper bound of the mixed one
};

} // namespace
} // namespace HWY_NAMESPACE
} // namespace footpoint
HWY_AFTER_NAMESPACE();

#endif
