// SPDX-License-Identifier: BSD-3-Clause

// The distance form of a small cell, formed anew from the control net relative to the best foot,
// and lower bounds of such polynomials (Documentation/CertifiedSearch.md, "Hard cells"). Compiled
// once for each set of vector instructions (the guard of Highway's "-inl.h" headers).
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

/// Degrees end at 30 (kMaximumDegree): so many control points along one direction, and so
/// many coefficients of a product, padded for vectors of eight.
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

/// The polygon of [0, 1] becomes that of [lower, upper] (de Casteljau 1959); one point where these
/// are the same. Three roundings a step and end, 6 · degree in all.
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

/// Control points of a cell, w (S − origin) and w, one plane a coordinate. A direction in which the
/// cell has no width gets degree 0.
struct CellNet
{
  int p;
  int q;
  double planes[4][kMostPoints][kMostPoints];

  CellNet(const Piece& piece, const Range& range, const double* origin)
    : p(range.lower[0] < range.upper[0] ? piece.shape->degree[0] : 0)
    , q(range.lower[1] < range.upper[1] ? piece.shape->degree[1] : 0)
  {
    const int rows = piece.shape->degree[0];
    const int columns = piece.shape->degree[1];
    double line[kMostPoints];
    for (int c = 0; c < 4; ++c)
    {
      for (int i = 0; i <= rows; ++i)
      {
        double* row = this->planes[c][i];
        for (int j = 0; j <= columns; ++j)
        {
          const double* control = piece.net + 4 * (i * (columns + 1) + j);
          row[j] = c < 3 ? control[c] - control[3] * origin[c] : control[3];
        }
        restrict_polygon(row, columns, range.lower[1], range.upper[1]);
      }
      for (int j = 0; rows > 0 && j <= this->q; ++j)
      {
        for (int i = 0; i <= rows; ++i)
        {
          line[i] = this->planes[c][i][j];
        }
        restrict_polygon(line, rows, range.lower[0], range.upper[0]);
        for (int i = 0; i <= this->p; ++i)
        {
          this->planes[c][i][j] = line[i];
        }
      }
    }
  }
};

/// Binomial coefficients of one degree, padded with ones.
struct PaddedBinomials
{
  double row[kMostTerms];

  explicit PaddedBinomials(int n)
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
    const hn::CappedTag<double, kMostLanes> tag;
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

  /// From a sum of products to its Bernstein coefficients.
  void finish(CellPolynomial& sum) const
  {
    sum.greatest = 0.0;
    for (int k = 0; k <= sum.n; ++k)
    {
      for (int l = 0; l <= sum.m; ++l)
      {
        sum.rows[k][l] /= this->UU.row[k] * this->VV.row[l];
        sum.greatest = std::max(sum.greatest, std::abs(sum.rows[k][l]));
      }
    }
  }

private:
  int P;
  int Q;
  PaddedBinomials U;
  PaddedBinomials V;
  PaddedBinomials UU;
  PaddedBinomials VV;
};

/// Three vectors that are orthonormal up to 8 roundings have a sum of squares that is larger than
/// that of an orthonormal basis by no more than 24 roundings.
constexpr double kBelowOne = 1.0 - 32.0 * kRounding;

/// Normalizes the first vector and adds two.
HWY_INLINE void complete_basis(double (*e)[3])
{
  const auto normalize = [](double* a)
  {
    const double length = std::sqrt(dot(a, a));
    for (int k = 0; k < 3; ++k)
    {
      a[k] /= length;
    }
  };
  const auto cross = [](const double* a, const double* b, double* c)
  {
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
  };
  normalize(e[0]);
  int least = 0;
  for (int k = 1; k < 3; ++k)
  {
    least = std::abs(e[0][k]) < std::abs(e[0][least]) ? k : least;
  }
  double axis[3] = {};
  axis[least] = 1.0;
  cross(e[0], axis, e[1]);
  normalize(e[1]);
  cross(e[0], e[1], e[2]);
}

/// The unit eigenvector of the larger eigenvalue of a symmetric matrix (uu, uv, vv), and both.
struct Eigen2
{
  Pair vector;
  double larger;
  double smaller;
};

HWY_INLINE Eigen2 eigen_of(const Triple& h)
{
  const double half = 0.5 * (h[0] - h[2]);
  const double root = std::sqrt(half * half + h[1] * h[1]);
  const double x = half >= 0.0 ? half + root : h[1];
  const double y = half >= 0.0 ? h[1] : root - half;
  const double length = std::sqrt(x * x + y * y);
  const double mean = 0.5 * (h[0] + h[2]);
  return { length > 0.0 ? Pair{ { x / length, y / length } } : Pair{ { 1.0, 0.0 } }, mean + root,
    mean - root };
}

/// A direction of space along[0] S_u + along[1] S_v, S_u and S_v by the cell's own parameters, and
/// the part of the square of that coordinate which is to be subtracted from F.
struct Stiffest
{
  Pair along;
  double part; ///< at most 1; 0: none
};

/// Chosen so that what is left of the second derivatives H of ½|S − P|² has as little of a mixed
/// one as may be. Two choices of the direction e, with g = (e·S_u, e·S_v):
///   - where S moves most: g is the larger eigenvector of JᵀJ, J = (S_u, S_v), times the larger
///     singular value; it always has its full length;
///   - g along the larger eigenvector of H, which leaves a multiple of the identity; but where J is
///     nearly singular, g may be short and so is what can be subtracted.
HWY_INLINE Stiffest stiffest_of(const Place& place, const double* width)
{
  const double mixed = width[0] * width[1];
  const Triple metric{ { place.metric[0] * width[0] * width[0],
    dot(place.jet[kSu], place.jet[kSv]) * mixed,
    place.metric[1] * width[1] * width[1] } };
  const Triple h{ { place.hessian[0] * width[0] * width[0], place.hessian[1] * mixed,
    place.hessian[2] * width[1] * width[1] } };
  // How much of a mixed derivative is left after subtracting part · g gᵀ: uv² / (uu vv).
  auto left = [&](const Pair& g, double part)
  {
    const double uu = h[0] - part * g[0] * g[0];
    const double uv = h[1] - part * g[0] * g[1];
    const double vv = h[2] - part * g[1] * g[1];
    return uu > 0.0 && vv > 0.0 ? uv * uv / (uu * vv) : kInfinity;
  };
  const Eigen2 most = eigen_of(metric);
  const double x = most.vector[0];
  const double y = most.vector[1];
  const double high = x * x * h[0] + 2.0 * x * y * h[1] + y * y * h[2];
  const double low = y * y * h[0] - 2.0 * x * y * h[1] + x * x * h[2];
  Stiffest result{ most.vector,
    most.larger > 0.0 ? std::min(std::max((high - low) / most.larger, 0.0), 1.0) : 0.0 };
  const double speed = std::sqrt(most.larger);
  const double left_of_most = left({ { x * speed, y * speed } }, result.part);
  const Eigen2 stiff = eigen_of(h);
  const double determinant = metric[0] * metric[2] - metric[1] * metric[1];
  if (determinant > 0.0)
  {
    const Pair along{ { (metric[2] * stiff.vector[0] - metric[1] * stiff.vector[1]) / determinant,
      (metric[0] * stiff.vector[1] - metric[1] * stiff.vector[0]) / determinant } };
    const double inverse = along[0] * stiff.vector[0] + along[1] * stiff.vector[1]; // 1 / |g|²
    const double part = std::min((stiff.larger - stiff.smaller) * inverse, 1.0);
    const double length = inverse > 0.0 ? 1.0 / std::sqrt(inverse) : 0.0;
    if (part > 0.0 &&
      left({ { stiff.vector[0] * length, stiff.vector[1] * length } }, part) < left_of_most)
    {
      result = { along, part };
    }
  }
  return result;
}

/// Where a cell is seen from: the best foot f, relative to the piece's origin, and r = f − P.
struct CellView
{
  double f[3];
  double r[3];
  double offset_error; ///< of r, each coordinate
};

/// The distance form of one cell, F = w² (|S − P|² − |r|²) = X·X + 2 w X·r with X = w (S − f), and
/// what is left of it below the square of a coordinate.
class CellForm
{
public:
  CellForm(const Piece& piece, const Range& range, const CellView& view)
    : View(view)
    , Net(piece, range, view.f)
    , Product(this->Net.p, this->Net.q)
    , Roundings(4.0 * (this->Net.p + 1) * (this->Net.q + 1) + 4.0 * (this->Net.p + this->Net.q) +
        16.0)
  {
    auto& planes = this->Net.planes;
    for (int i = 0; i <= this->Net.p; ++i)
    {
      for (int j = 0; j <= this->Net.q; ++j)
      {
        for (int c = 0; c < 4; ++c)
        {
          this->Greatest[c] = std::max(this->Greatest[c], std::abs(planes[c][i][j]));
        }
        this->LeastWeight = std::min(this->LeastWeight, planes[3][i][j]);
        this->Along[i][j] = 2.0 *
          (planes[0][i][j] * view.r[0] + planes[1][i][j] * view.r[1] + planes[2][i][j] * view.r[2]);
      }
    }
    for (int c = 0; c < 4; ++c)
    {
      this->Product.scale(planes[c]);
    }
    this->Product.scale(this->Along);
  }

  double least_weight() const { return this->LeastWeight; }
  bool is_surface() const { return this->Net.p > 0 && this->Net.q > 0; }

  /// Coefficients of F.
  void distance(CellPolynomial& form)
  {
    const auto& planes = this->Net.planes;
    this->begin(form);
    for (int c = 0; c < 3; ++c)
    {
      this->Product.add(1.0, planes[c], planes[c], form);
    }
    this->Product.add(1.0, planes[3], this->Along, form);
    this->Product.finish(form);
    form.error = 0.0;
    for (int c = 0; c < 3; ++c)
    {
      const double size = this->Greatest[c];
      const double weight = 2.0 * this->Greatest[3];
      form.error += size *
        (this->Roundings * kRounding * (size + weight * std::abs(this->View.r[c])) +
          weight * this->View.offset_error);
    }
  }

  /// Coefficients of F − part · (X·e − w μ)², e the unit vector along a direction and μ its
  /// coordinate at a place: no number in them is as large as that square. Turns the net: call it
  /// last.
  void reduced(const double* direction, double part, const Place& place, CellPolynomial& form)
  {
    auto& planes = this->Net.planes;
    double e[3][3];
    std::copy(direction, direction + 3, e[0]);
    complete_basis(e);
    double r[3];
    double centre = 0.0;
    for (int k = 0; k < 3; ++k)
    {
      r[k] = dot(e[k], this->View.r);
      centre += e[0][k] * (place.jet[kS][k] - this->View.f[k]);
    }
    double greatest[3] = {};
    // All planes are multiplied by the binomial coefficients already.
    for (int i = 0; i <= this->Net.p; ++i)
    {
      for (int j = 0; j <= this->Net.q; ++j)
      {
        const double x[3] = { planes[0][i][j], planes[1][i][j], planes[2][i][j] };
        const double scale = 1.0 / this->Product.scale_of(i, j);
        for (int k = 0; k < 3; ++k)
        {
          planes[k][i][j] = dot(e[k], x);
          greatest[k] = std::max(greatest[k], std::abs(planes[k][i][j]) * scale);
        }
        this->Along[i][j] =
          2.0 * (r[0] * planes[0][i][j] + r[1] * planes[1][i][j] + r[2] * planes[2][i][j]) +
          part * centre * (2.0 * planes[0][i][j] - centre * planes[3][i][j]);
      }
    }
    const double left[3] = { kBelowOne * (1.0 - part), kBelowOne, kBelowOne };
    this->begin(form);
    for (int k = 0; k < 3; ++k)
    {
      this->Product.add(left[k], planes[k], planes[k], form);
    }
    this->Product.add(1.0, planes[3], this->Along, form);
    this->Product.finish(form);
    // A turned coordinate is off by three roundings of all of X. Of 2 w X·r all that a basis which
    // is orthonormal up to 24 roundings, the turned r and X leave out.
    const double all = this->Greatest[0] + this->Greatest[1] + this->Greatest[2];
    const double weight = this->Greatest[3];
    form.error = 2.0 * weight * all *
        (this->View.offset_error + 64.0 * kRounding * bound_of_length(this->View.r)) +
      this->Roundings * kRounding * weight * part * std::abs(centre) *
        (2.0 * greatest[0] + std::abs(centre) * weight);
    for (int k = 0; k < 3; ++k)
    {
      form.error += kRounding * greatest[k] *
        (left[k] * (this->Roundings * greatest[k] + 16.0 * all) +
          this->Roundings * 2.0 * weight * std::abs(r[k]));
    }
  }

private:
  void begin(CellPolynomial& form) const
  {
    form.n = 2 * this->Net.p;
    form.m = 2 * this->Net.q;
    CellProduct::clear(form);
  }

  const CellView& View;
  CellNet Net;
  CellProduct Product;
  /// Of one coefficient, over the sum of magnitudes: four products for each pair of control points,
  /// the binomial coefficients of high degrees, and the factors.
  double Roundings;
  double Greatest[4] = {};
  double LeastWeight = kInfinity;
  double Along[kMostPoints][kMostPoints]; ///< 2 X·r and the like
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
    // What remains is the rounding of a second difference, eight of the greatest, and of its
    // factor, three of four times that.
    const double rounding = 24.0 * kRounding * f.greatest;
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

  /// Second differences are more than rounding.
  bool bends() const
  {
    const double degree = std::max(this->F.n, this->F.m);
    return std::max(this->bend(0), this->bend(1)) > 8.0 * degree * degree * this->F.error;
  }

  /// The coefficients are not below a number.
  bool above(double number) const { return this->Least >= number + this->F.error; }

  /// Convex, also if second differences of coefficients are less by up to four times a number.
  bool convex(double shift) const
  {
    const double n = this->F.n;
    const double m = this->F.m;
    const double uu = n > 0.0 ? this->Bend[0] - 4.0 * n * (n - 1.0) * shift : 1.0;
    const double vv = m > 0.0 ? this->Bend[1] - 4.0 * m * (m - 1.0) * shift : 1.0;
    const double uv = n > 0.0 && m > 0.0 ? this->Twist + 4.0 * n * m * shift : 0.0;
    return uu > 0.0 && vv > 0.0 && uv * uv * (1.0 + 8.0 * kRounding) < uu * vv;
  }

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
    // Three roundings a step of de Casteljau's, for the value and for slopes, which are n times the
    // difference of two; then those of parabolas with terms up to 2 n and 2 n² times the greatest.
    const double degrees = f.n + f.m;
    const double rounding = kRounding * f.greatest *
      (3.0 * degrees * (1.0 + 2.0 * degrees) + 32.0 * (f.n * f.n + f.m * f.m) + 16.0);
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
    // In units of the greatest: 6 n² roundings of the bend, 4 n of the slope, and two of each term
    // of a sum of up to 1 + 2 n + 2 n²; n is at least 2.
    const double rounding = kRounding * f.greatest * 16.0 * degree * degree;
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
