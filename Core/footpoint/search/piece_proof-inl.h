// SPDX-License-Identifier: BSD-3-Clause

// The proof that a piece holds nothing nearer than the best foot: the members of Finder that belong
// to it (Documentation/CertifiedSearch.md). Compiled once for each set of vector instructions.
#if defined(FOOTPOINT_PIECE_PROOF_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FOOTPOINT_PIECE_PROOF_INL_H
#undef FOOTPOINT_PIECE_PROOF_INL_H
#else
#define FOOTPOINT_PIECE_PROOF_INL_H
#endif

#include "footpoint/search/finder-inl.h"

HWY_BEFORE_NAMESPACE();
namespace footpoint
{
namespace HWY_NAMESPACE
{
namespace
{

bool Finder::prove_all()
{
  // The best foot may be on an edge, whose pieces are approximations.
  double error = 0.0;
  for (const PieceFoot& survivor : this->Finds.survivors)
  {
    error = std::max(error, this->Structure.forms.pieces()[survivor.piece].error);
  }
  this->Tolerance = this->Query.tolerance - error;
  const auto is_at_query = [this]
  { return this->found() && this->best().distance <= this->Tolerance; };
  if (is_at_query())
  {
    return true; // no distance is negative
  }
  if (this->found() && this->best().piece != this->Block.middle)
  {
    this->settle();
  }
  const bool has_block = this->Tolerance >= kPartOfBlock * this->Query.tolerance;
  bool proved = true;
  // What is trimmed comes last: its proof wants that of the edges, and what they improve.
  for (const bool trimmed : { false, true })
  {
    for (std::size_t k = 0; k < this->Finds.survivors.size(); ++k)
    {
      const std::int32_t index = this->Finds.survivors[k].piece;
      const Piece& piece = this->Structure.forms.pieces()[index];
      const auto is_same = [index](const PieceFoot& other) { return other.piece == index; };
      const auto before = this->Finds.survivors.begin() + static_cast<std::ptrdiff_t>(k);
      if ((piece.region != nullptr) != trimmed || (has_block && this->in_block(index)) ||
        std::any_of(this->Finds.survivors.begin(), before, is_same))
      {
        continue;
      }
      const PieceFoot& survivor = this->Finds.survivors[k];
      Verdict verdict = Verdict::Improved;
      while (verdict == Verdict::Improved)
      {
        verdict = this->prove(survivor);
      }
      proved = proved && verdict == Verdict::Proved;
    }
  }
  // Feet may have come nearer meanwhile.
  if (is_at_query())
  {
    return true;
  }
  // Pieces are left out under a bound that some point gives. Where no foot is as near (rounding
  // made that point nearer than it is, or the ways down from it failed or led out of the face),
  // they are not proved.
  const double distance = this->found() ? this->best().distance : this->Query.limit;
  return proved && distance <= this->Bound + this->Tolerance;
}

Finder::Verdict Finder::prove(const PieceFoot& survivor)
{
  const PieceQuery query = this->at(survivor.piece);
  const Piece& piece = *query.piece;
  const PieceShape& shape = *piece.shape;
  const Level level =
    this->found() ? this->level_of(query) : this->level_of(query, this->Query.limit);
  const double distance = this->found() ? this->best().distance : this->Query.limit;
  const double tolerance = std::min(this->tolerance_of(piece), distance);
  if (tolerance < 0.0)
  {
    return Verdict::Open;
  }
  if (this->proves_by_height(query, survivor, tolerance))
  {
    return Verdict::Proved;
  }
  this->Slack = this->found() ? tolerance * (2.0 * distance - tolerance) : 0.0;
  this->Margin = level.margin * piece.greatest_weight;
  this->Shift = shape.rational ? this->Slack * piece.greatest_weight : 0.0;
  this->Known = &survivor;
  const int size = shape.form_size;
  std::vector<SearchWorkspace::Cell>& cells = this->Workspace.cells;
  cells.clear();
  const double least = distance_form(
    query, level.constant + this->Slack - level.margin, this->coefficients(0, size));
  // At the survivor F is no more than this, and the margin has come off it.
  const double highest = this->excess_of(survivor) + this->Slack - 2.0 * level.margin;
  if (least >= 0.0 || (highest > 0.0 && this->is_positive_from(shape, survivor.t)))
  {
    return Verdict::Proved;
  }
  cells.push_back({ { { 0.0, 0.0 } }, { { 1.0, 1.0 } }, least, 0.0, 0 });
  std::vector<SearchWorkspace::HardCell>& hard = this->Workspace.hard_cells;
  hard.clear();
  this->Cells = 0;
  while (!cells.empty())
  {
    const SearchWorkspace::Cell cell = cells.back();
    const std::size_t at = cells.size() - 1;
    if (cell.least >= cell.error)
    {
      cells.pop_back();
      continue;
    }
    if (cell.depth > 0 && is_left_out(piece, cell.lower, cell.upper))
    {
      cells.pop_back();
      continue;
    }
    if (++this->Cells > kMostCells)
    {
      for (const SearchWorkspace::Cell& left : cells)
      {
        hard.push_back({ left.lower, left.upper, -1.0 });
      }
      break;
    }
    double* f = this->coefficients(at, size);
    if (this->improves_at_corner(query, cell, f))
    {
      return Verdict::Improved;
    }
    const Range range{ cell.lower, cell.upper };
    Verdict verdict = Verdict::Open;
    if (is_convex(shape, f, this->least_second_difference(cell.error)))
    {
      verdict = this->support(query, range, this->Known->t);
    }
    Slopes slopes{};
    if (verdict == Verdict::Open)
    {
      slopes = slopes_of(shape, f, this->least_first_difference(cell.error));
      if (slopes.monotone >= 0)
      {
        // Only one side matters.
        verdict =
          this->prove_side(query, range, f, cell.error, slopes.monotone, slopes.end);
      }
    }
    if (verdict == Verdict::Improved)
    {
      return verdict;
    }
    if (verdict == Verdict::Proved)
    {
      cells.pop_back();
      continue;
    }
    if (cell.depth >= kMostHalvings || slopes.monotone >= 0)
    {
      hard.push_back({ cell.lower, cell.upper, -1.0 });
      cells.pop_back();
      continue;
    }
    // Halved where the slope changes more.
    const int cut = slopes.cut;
    const int terms = cut == 0 ? shape.rows : shape.columns;
    const double middle = 0.5 * (cell.lower[cut] + cell.upper[cut]);
    SearchWorkspace::Cell low = cell;
    SearchWorkspace::Cell high = cell;
    low.error = high.error = cell.error + terms * kRounding * slopes.greatest;
    low.depth = high.depth = cell.depth + 1;
    low.upper[cut] = middle;
    high.lower[cut] = middle;
    // The upper half goes on top of the lower one, which takes the place of the whole.
    double* upper = this->coefficients(at + 1, size); // the last one first: it may move the others
    f = this->coefficients(at, size);
    const Pair least_of_halves = halve(shape, f, cut, upper);
    low.least = least_of_halves[0];
    high.least = least_of_halves[1];
    cells.back() = low;
    cells.push_back(high);
  }
  return hard.empty() ? Verdict::Proved : this->prove_hard_cells(query);
}

bool Finder::is_positive_from(const PieceShape& shape, const Pair& t)
{
  return with_shape(shape,
    [&](auto p, auto q, auto)
    {
      constexpr int kWidth = 8; // as rows of forms are padded
      using Form =
        PositiveForm<(p() < 0 ? -1 : 2 * p()), (q() < 0 ? -1 : 2 * q()), kWidth>;
      const int n = 2 * shape.degree[0];
      const int m = 2 * shape.degree[1];
      const int size = shape.form_size;
      double* f = this->coefficients(0, size + Form::size_of_memory(n, m));
      double* memory = f + size;
      const hn::CappedTag<double, kMostLanes> tag;
      auto greatest = hn::Zero(tag);
      for (int k = 0; k < size; k += static_cast<int>(hn::Lanes(tag)))
      {
        const auto values = hn::LoadU(tag, f + k);
        greatest = hn::Max(greatest, hn::Abs(values));
        hn::StoreU(values, tag, memory + k);
      }
      return Form(n, m, t, memory)
        .is_positive(hn::GetLane(hn::MaxOfLanes(tag, greatest)), kMostCutCells);
    });
}

bool Finder::is_above(const PieceQuery& query, const double* point, const double* offset,
  const Pair& t, double allowed)
{
  if (!(allowed > 0.0))
  {
    return false;
  }
  HeightView view;
  std::copy(point, point + 3, view.f);
  std::copy(offset, offset + 3, view.r);
  view.t = t;
  view.allowed = allowed;
  view.metric = this->Structure.neighbourhoods[query.index].metric;
  const PieceShape& shape = *query.piece->shape;
  return with_shape(shape,
    [&](auto p, auto q, auto)
    {
      using Form = HeightForm<p(), q()>;
      return Form::proves(*query.piece, view, this->coefficients(0, Form::size_of_memory(shape)));
    });
}

bool Finder::proves_by_height(
  const PieceQuery& query, const PieceFoot& survivor, double tolerance)
{
  double point[3];
  for (int k = 0; k < 3; ++k)
  {
    point[k] = survivor.position[k] - query.piece->origin[k];
  }
  const double distance = this->found() ? this->best().distance : this->Query.limit;
  // Both queries' distances, and their squares, may differ by as much. Where nothing was found
  // there is nothing within the limit for certain, without a tolerance.
  const double moved = this->moved(query);
  const double left = (this->found() ? tolerance : 0.0) - 4.0 * moved;
  const double excess = this->excess_of(survivor) - 2.0 * moved * survivor.distance;
  return this->is_above(query, point, survivor.offset.data(), survivor.t,
    excess + left * (2.0 * distance - left));
}

double Finder::tolerance_of(const Piece& piece) const
{
  return piece.edge ? kPartOfEdges * this->Tolerance - piece.error : this->Tolerance;
}

/// |S − P|² at a place less the best, without the cancellation of large numbers:
/// (S − f)·(S + f − 2P); less the limit where nothing was found.
double Finder::excess_of(const PieceFoot& place) const
{
  if (!this->found())
  {
    return place.distance * place.distance - this->Query.limit * this->Query.limit;
  }
  const PieceFoot& foot = this->best();
  double excess = 0.0;
  for (int k = 0; k < 3; ++k)
  {
    excess += (place.position[k] - foot.position[k]) * (place.offset[k] + foot.offset[k]);
  }
  return excess;
}

bool Finder::is_trimmed_away(const PieceQuery& query, const PieceFoot& place) const
{
  if (is_kept(*query.piece, place.t))
  {
    return false;
  }
  // Edges that were left out are no nearer than the bound, the others were proved.
  const double distance = this->found() ? this->best().distance : this->Query.limit;
  const double part = this->found() ? kPartOfEdges * this->Tolerance : 0.0;
  const double proved = std::min(std::max(part, distance - this->Bound), distance);
  // Positions and offsets are off by a few roundings of their size.
  const double rounding =
    64.0 * kRounding * (this->Query.size + distance) * (place.distance + distance);
  return this->excess_of(place) < -proved * (2.0 * distance - proved) - rounding;
}

/// Where the best foot is, and how far F may fall below zero, over w².
double Finder::view_of(const PieceQuery& query, CellView& view) const
{
  const Piece& piece = *query.piece;
  const PieceFoot& foot = this->found() ? this->best() : *this->Known;
  for (int k = 0; k < 3; ++k)
  {
    view.f[k] = foot.position[k] - piece.origin[k];
    view.r[k] = foot.offset[k];
  }
  // r is off by the rounding of f, of P − origin for either piece and of their difference: another
  // query, whose distances differ by as much. Of one far away that is too much, but there
  // |S − P|² − |f − P|² is off by its product with |S − f| only.
  const double size = this->Query.size;
  view.offset_error = 4.0 * kRounding *
    (bound_of_length(query.p) + bound_of_length(view.f) + bound_of_length(piece.origin.data()) +
      size);
  // Cutting out a cell moves S by six roundings a degree and end for each of w S and w, shifting it
  // to f by four.
  const int degrees = piece.shape->degree[0] + piece.shape->degree[1];
  double moved = (12.0 * degrees + 8.0) * kRounding * size;
  constexpr double kSmallPart = 0.1; // of the tolerance
  if (view.offset_error < kSmallPart * this->tolerance_of(piece))
  {
    moved += 2.0 * view.offset_error;
    view.offset_error = 0.0;
  }
  if (!this->found())
  {
    const double limit = this->Query.limit + moved;
    return (foot.distance - limit) * (foot.distance + limit) * (1.0 - 8.0 * kRounding);
  }
  const double tolerance = std::min(this->tolerance_of(piece) - moved, foot.distance);
  return tolerance * (2.0 * foot.distance - tolerance) * (1.0 - 8.0 * kRounding);
}

Finder::Verdict Finder::prove_hard_cells(const PieceQuery& query)
{
  std::vector<SearchWorkspace::HardCell>& cells = this->Workspace.hard_cells;
  CellView view;
  const double slack = this->view_of(query, view);
  if (!(slack > 0.0))
  {
    return Verdict::Open;
  }
  CellPolynomial polynomial;
  for (std::size_t next = 0; next < cells.size(); ++next)
  {
    SearchWorkspace::HardCell cell = cells[next];
    // A few of every piece, for the sake of what descents from there may find.
    if (++this->HardCells > kMostHardCells && next >= kFewestHardCells)
    {
      return Verdict::Open;
    }
    if (is_left_out(*query.piece, cell.lower, cell.upper))
    {
      continue;
    }
    const Range range{ cell.lower, cell.upper };
    const double width[2] = { range.upper[0] - range.lower[0], range.upper[1] - range.lower[1] };
    CellForm form(*query.piece, range, view);
    if (cell.allowed < 0.0)
    {
      cell.allowed = slack * form.least_weight() * form.least_weight();
    }
    form.distance(polynomial);
    const CellBounds bounds(polynomial);
    auto in_cell = [&](const Pair& t)
    {
      Pair at{ { 0.0, 0.0 } };
      for (int i = 0; i < 2; ++i)
      {
        at[i] = width[i] > 0.0
          ? std::min(std::max((t[i] - range.lower[i]) / width[i], 0.0), 1.0)
          : 0.0;
      }
      return at;
    };
    if (bounds.not_below(-cell.allowed, in_cell(this->Known->t)))
    {
      continue;
    }
    if (bounds.monotone(0) >= 0 || bounds.monotone(1) >= 0)
    {
      const int i = bounds.monotone(0) >= 0 ? 0 : 1;
      const bool at_start = bounds.monotone(i) == 0;
      (at_start ? cell.upper : cell.lower)[i] = (at_start ? cell.lower : cell.upper)[i];
      cells.push_back(cell);
      continue;
    }
    // The nearest point of the cell, as far as a descent finds it.
    Place place;
    for (int i = 0; i < 2; ++i)
    {
      place.t[i] = std::min(std::max(this->Known->t[i], range.lower[i]), range.upper[i]);
    }
    const int iterations = descend(query, range, place);
    if (std::sqrt(place.squared) <= this->reach())
    {
      Place whole;
      whole.t = place.t;
      const int more = descend(query, kWholePiece, whole);
      if (this->keep(this->foot_of(query, whole, iterations + more)))
      {
        return Verdict::Improved;
      }
    }
    const Pair at = in_cell(place.t);
    if (bounds.supported(-cell.allowed, at))
    {
      continue;
    }
    if (query.piece->region &&
      bounds.convex(query.piece->shape->rational ? slack * query.piece->greatest_weight : 0.0) &&
      this->is_trimmed_away(query, this->foot_of(query, place, iterations)))
    {
      continue;
    }
    int cut = bounds.bend(0) > bounds.bend(1) ? 0 : 1;
    const Stiffest stiffest = stiffest_of(place, width);
    if (form.is_surface() && stiffest.part > 0.0)
    {
      double direction[3];
      for (int k = 0; k < 3; ++k)
      {
        direction[k] = stiffest.along[0] * place.jet[kSu][k] * width[0] +
          stiffest.along[1] * place.jet[kSv][k] * width[1];
      }
      form.reduced(direction, stiffest.part, place, polynomial);
      const CellBounds reduced(polynomial);
      if (reduced.not_below(-cell.allowed, at))
      {
        continue;
      }
      // Where second differences are nothing but rounding, the longer direction.
      const bool along_u = reduced.bends()
        ? reduced.bend(0) > reduced.bend(1)
        : place.metric[0] * width[0] * width[0] > place.metric[1] * width[1] * width[1];
      cut = along_u ? 0 : 1;
    }
    if (query.piece->region && !is_kept(*query.piece, place.t))
    {
      // What lies below may go on far beyond the loop: where it does, only cells that the loop does
      // not pass are settled, and narrow ones are passed the longest.
      const double across = place.metric[1 - cut] * width[1 - cut] * width[1 - cut];
      const double along = place.metric[cut] * width[cut] * width[cut];
      cut = across > kNarrow * kNarrow * along ? 1 - cut : cut;
    }
    cut = width[cut] > 0.0 ? cut : 1 - cut;
    const double middle = 0.5 * (range.lower[cut] + range.upper[cut]);
    if (!(middle > range.lower[cut] && middle < range.upper[cut]))
    {
      return Verdict::Open;
    }
    if (width[0] > 0.0 && width[1] > 0.0)
    {
      cell.allowed = -1.0; // a side has to keep what its cell allows
    }
    SearchWorkspace::HardCell high = cell;
    cell.upper[cut] = middle;
    high.lower[cut] = middle;
    cells.push_back(cell);
    cells.push_back(high);
  }
  return Verdict::Proved;
}

HWY_INLINE Pair corner_of(const SearchWorkspace::Cell& cell, int corner)
{
  return { { (corner / 2 == 0 ? cell.lower : cell.upper)[0],
    (corner % 2 == 0 ? cell.lower : cell.upper)[1] } };
}

/// The coefficients at the corners are values of F: where one is negative the corner itself is
/// nearer than the best foot, and a descent from there finds what is nearer still.
bool Finder::improves_at_corner(
  const PieceQuery& query, const SearchWorkspace::Cell& cell, const double* f)
{
  const PieceShape& shape = *query.piece->shape;
  double least = -2.0 * (this->Margin + cell.error);
  int found = -1;
  for (int corner = 0; corner < 4; ++corner)
  {
    const double value =
      f[corner / 2 * (shape.rows - 1) * shape.stride + corner % 2 * (shape.columns - 1)];
    if (value < least && is_kept(*query.piece, corner_of(cell, corner)))
    {
      least = value;
      found = corner;
    }
  }
  if (found < 0)
  {
    return false;
  }
  Place place;
  place.t = corner_of(cell, found);
  const int iterations = descend(query, kWholePiece, place);
  return this->keep(this->foot_of(query, place, iterations));
}

/// The same along one side of a cell, at one end of direction i.
Finder::Verdict Finder::prove_side(const PieceQuery& query, const Range& cell, const double* f,
  double error, int i, int end)
{
  const PieceShape& shape = *query.piece->shape;
  const int direction = 1 - i;
  const int n = direction == 0 ? shape.rows - 1 : shape.columns - 1;
  Range range = cell;
  (end == 0 ? range.upper : range.lower)[i] = (end == 0 ? range.lower : range.upper)[i];
  struct Line
  {
    double f[64];
    double lower, upper, error;
  };
  Line stack[kMostHalvings + 2];
  int top = 0;
  for (int k = 0; k <= n; ++k)
  {
    const int row = direction == 0 ? k : end * (shape.rows - 1);
    const int column = direction == 1 ? k : end * (shape.columns - 1);
    stack[0].f[k] = f[row * shape.stride + column];
  }
  stack[0].lower = range.lower[direction];
  stack[0].upper = range.upper[direction];
  stack[0].error = error;
  ++top;
  bool open = false;
  while (top > 0)
  {
    Line& line = stack[top - 1];
    double least = line.f[0];
    double least_first = kInfinity;
    double greatest_first = -kInfinity;
    double least_second = kInfinity;
    double greatest = std::abs(line.f[0]);
    for (int k = 1; k <= n; ++k)
    {
      const double step = line.f[k] - line.f[k - 1];
      least = std::min(least, line.f[k]);
      greatest = std::max(greatest, std::abs(line.f[k]));
      least_first = std::min(least_first, step);
      greatest_first = std::max(greatest_first, step);
      if (k > 1)
      {
        least_second = std::min(least_second, step - (line.f[k - 1] - line.f[k - 2]));
      }
    }
    if (least >= line.error)
    {
      --top;
      continue;
    }
    if (++this->Cells > kMostCells)
    {
      return Verdict::Open;
    }
    Range here = range;
    here.lower[direction] = line.lower;
    here.upper[direction] = line.upper;
    const double first = this->least_first_difference(line.error);
    const double second = this->least_second_difference(line.error);
    Verdict verdict = Verdict::Open;
    if (n == 0 || least_first > first || greatest_first < -first)
    {
      here.lower[direction] = here.upper[direction] =
        least_first > first ? line.lower : line.upper;
      verdict = this->support(query, here, here.lower);
    }
    else if (n == 1 || least_second > second)
    {
      verdict = this->support(query, here, this->Known->t);
    }
    if (verdict == Verdict::Improved)
    {
      return verdict;
    }
    if (verdict == Verdict::Proved)
    {
      --top;
      continue;
    }
    if (top > kMostHalvings)
    {
      open = true;
      --top;
      continue;
    }
    Line& upper = stack[top];
    const double middle = 0.5 * (line.lower + line.upper);
    upper.lower = middle;
    upper.upper = line.upper;
    line.upper = middle;
    upper.error = line.error = line.error + n * kRounding * greatest;
    std::copy(line.f, line.f + n + 1, upper.f);
    for (int level = 1; level <= n; ++level)
    {
      // upper.f becomes the upper half, its first entries are those of the lower one.
      for (int k = 0; k <= n - level; ++k)
      {
        upper.f[k] = 0.5 * (upper.f[k] + upper.f[k + 1]);
      }
      line.f[level] = upper.f[0];
    }
    ++top;
  }
  return open ? Verdict::Open : Verdict::Proved;
}

/// \pre F is convex over the range, or the range is a point.
Finder::Verdict Finder::support(const PieceQuery& query, const Range& range, const Pair& start)
{
  const PieceFoot& known = *this->Known;
  bool inside = true;
  Place place;
  for (int i = 0; i < 2; ++i)
  {
    place.t[i] = std::min(std::max(start[i], range.lower[i]), range.upper[i]);
    inside = inside && place.t[i] == known.t[i];
  }
  if (inside &&
    (this->supports(query, range, known) || this->is_trimmed_away(query, known)))
  {
    return Verdict::Proved;
  }
  const int iterations = descend(query, range, place);
  const PieceFoot foot = this->foot_of(query, place, iterations);
  if (!inside && foot.distance <= this->reach())
  {
    Place whole;
    whole.t = place.t;
    const int more = descend(query, kWholePiece, whole);
    if (this->keep(this->foot_of(query, whole, iterations + more)))
    {
      return Verdict::Improved;
    }
  }
  const bool proved = this->supports(query, range, foot) || this->is_trimmed_away(query, foot);
  return proved ? Verdict::Proved : Verdict::Open;
}

/// Whether the tangent plane of F = w² (|S − P|² − d²) at a place stays above what is allowed.
bool Finder::supports(const PieceQuery& query, const Range& range, const PieceFoot& place) const
{
  const Piece& piece = *query.piece;
  const double excess = this->excess_of(place);
  const double w = place.weight[0];
  double value = w * w * excess;
  for (int i = 0; i < 2; ++i)
  {
    const double slope =
      2.0 * (w * w * place.gradient[i] + w * place.weight[1 + i] * excess);
    const double way = slope > 0.0 ? range.lower[i] - place.t[i] : range.upper[i] - place.t[i];
    value += way == 0.0 ? 0.0 : slope * way;
  }
  return value >= -this->Slack * piece.least_weight;
}

} // namespace
} // namespace HWY_NAMESPACE
} // namespace footpoint
HWY_AFTER_NAMESPACE();

#endif
