// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>
#include <vector>

namespace footpoint
{

/// One or two polynomials of one or two variables on the unit square, in Bernstein form.
///
/// Coefficients are stored with rows along the first direction, columns along the second, all forms
/// of one degree. A variable that does not occur has degree 0.
struct BernsteinSystem
{
  std::array<int, 2> degree{ { 0, 0 } };
  int equations = 1;
  /// The equations are the derivatives of one function by the first and by the second direction:
  /// where one of them vanishes identically, so does the other's derivative that way.
  bool gradient = false;
  /// The same for one equation or two, and only minima of that function are sought.
  bool minima = false;
  std::array<std::vector<double>, 2> forms;
  /// Values up to this count as zero: the error of the coefficients, and what the caller allows.
  std::array<double, 2> margin{ { 0.0, 0.0 } };

  int size() const { return (this->degree[0] + 1) * (this->degree[1] + 1); }
};

/// A place to look for a common zero.
struct BernsteinZero
{
  std::array<double, 2> at;
  std::array<double, 2> lower; ///< the cell that it stands for
  std::array<double, 2> upper;
  bool simple; ///< a zero, and the only one of its cell; else its cell could not be decided
  /// [equation][direction], for a simple one
  std::array<std::array<double, 2>, 2> jacobian;
};

/// All common zeros of a system, by subdivision (T. W. Sederberg and T. Nishita 1990; B. Mourrain
/// and J.-P. Pavone 2009).
///
/// A cell without zeros is known by the convex hull of the coefficients: of the forms themselves,
/// and of the combinations of them that have the unit matrix for their Jacobian in the middle. A
/// cell holds one zero at most where the Jacobian of the combinations is nearer to the unit matrix
/// than 1 in all of the cell, by the hull of their differences (then x − f(x) is a contraction);
/// Newton's method finds it. Any other cell is halved.
///
/// One object serves all systems of a query, whose work together it bounds.
class BernsteinZeros
{
public:
  /// \return whether the cell that the place stands for need not be looked at any closer, since it
  ///         holds a continuum of zeros or one that others could not be told from; asked for places
  ///         that are not simple
  using Visit = std::function<bool(const BernsteinZero&)>;

  /// Calls visit for each zero; on borders between cells more than once. Where the work runs out,
  /// for the middle of each cell that is left.
  void find(const BernsteinSystem& system, const Visit& visit);

private:
  struct Cell
  {
    std::array<double, 2> lower;
    std::array<double, 2> upper;
    std::array<double, 2> error; ///< of the coefficients of each form, from halving
    int depth;
  };
  struct Look;

  void descend(const BernsteinSystem& system, const Visit& visit);
  /// A cell in which one equation vanishes: the other one on the cell's lower side.
  void find_on_side(const BernsteinSystem& system, const Cell& cell, const double* forms,
    int direction, const Visit& visit);

  std::vector<Cell> Cells; ///< of one level of halving
  std::vector<Cell> Next;
  std::vector<double> Forms; ///< their coefficients, one cell after the other
  std::vector<double> NextForms;
  std::vector<double> Combined;
  int Looked = 0; ///< cells, in all systems
};

} // namespace footpoint
