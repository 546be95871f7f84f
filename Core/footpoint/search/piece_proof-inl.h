// SPDX-License-Identifier: BSD-3-Clause

// The proof that a piece holds nothing nearer than the best foot: the members of Finder that belong to
// it (Documentation/CertifiedSearch.md). Included by certified_search.cpp after the class, once for
// each set of vector instructions.
#if defined(FOOTPOINT_PIECE_PROOF_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef FOOTPOINT_PIECE_PROOF_INL_H
#undef FOOTPOINT_PIECE_PROOF_INL_H
#else
#define FOOTPOINT_PIECE_PROOF_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace footpoint
{
namespace HWY_NAMESPACE
{
namespace
{

Differences Finder::differences(const PieceShape& shape, const double* f)
{
  const hn::CappedTag<double, 8> tag;
  const int lanes = static_cast<int>(hn::Lanes(tag));
  const auto infinite = hn::Set(tag, kInfinity);
  const auto minus = hn::Set(tag, -kInfinity);
  auto least_u = infinite;
  auto greatest_u = minus;
  auto least_v = infinite;
  auto greatest_v = minus;
  auto least_uu = infinite;
  auto least_vv = infinite;
  auto greatest_uv = hn::Zero(tag);
  auto greatest = hn::Zero(tag);
  const int stride = shape.stride;
  for (int j = 0; j < shape.columns; j += lanes)
  {
    const auto has_next =
      hn::FirstN(tag, static_cast<std::size_t>(std::clamp(shape.columns - 1 - j, 0, lanes)));
    const auto has_second =
      hn::FirstN(tag, static_cast<std::size_t>(std::clamp(shape.columns - 2 - j, 0, lanes)));
    auto before_u = hn::Zero(tag);
    auto before_v = hn::Zero(tag);
    auto before = hn::Zero(tag);
    for (int i = 0; i < shape.rows; ++i)
    {
      const double* row = f + i * stride + j;
      const auto here = hn::LoadU(tag, row);
      const auto next = hn::LoadU(tag, row + 1);
      const auto second = hn::LoadU(tag, row + 2);
      greatest = hn::Max(greatest, hn::Abs(here));
      const auto v = hn::Sub(next, here);
      const auto vv = hn::Sub(hn::Sub(second, next), v);
      least_v = hn::Min(least_v, hn::IfThenElse(has_next, v, infinite));
      greatest_v = hn::Max(greatest_v, hn::IfThenElse(has_next, v, minus));
      least_vv = hn::Min(least_vv, hn::IfThenElse(has_second, vv, infinite));
      if (i > 0)
      {
        const auto u = hn::Sub(here, before);
        least_u = hn::Min(least_u, u);
        greatest_u = hn::Max(greatest_u, u);
        const auto uv = hn::Abs(hn::Sub(v, before_v));
        greatest_uv = hn::Max(greatest_uv, hn::IfThenElseZero(has_next, uv));
        if (i > 1)
        {
          least_uu = hn::Min(least_uu, hn::Sub(u, before_u));
        }
        before_u = u;
      }
      before = here;
      before_v = v;
    }
  }
  return { hn::GetLane(hn::MinOfLanes(tag, least_u)), hn::GetLane(hn::MaxOfLanes(tag, greatest_u)),
    hn::GetLane(hn::MinOfLanes(tag, least_v)), hn::GetLane(hn::MaxOfLanes(tag, greatest_v)),
    hn::GetLane(hn::MinOfLanes(tag, least_uu)), hn::GetLane(hn::MinOfLanes(tag, least_vv)),
    hn::GetLane(hn::MaxOfLanes(tag, greatest_uv)), hn::GetLane(hn::MaxOfLanes(tag, greatest)) };
}

/// The coefficients over one half of a cell; returns the smallest one.
double Finder::halve(const PieceShape& shape, const double* f, int direction, int end, double* to)
{
  const hn::CappedTag<double, 8> tag;
  const int lanes = static_cast<int>(hn::Lanes(tag));
  const std::vector<double>& weights = shape.halving[direction][end];
  auto least = hn::Set(tag, kInfinity);
  for (int i = 0; i < shape.rows; ++i)
  {
    for (int j = 0; j < shape.stride; j += lanes)
    {
      auto sum = hn::Zero(tag);
      if (direction == 0)
      {
        const int first = end == 0 ? 0 : i;
        const int last = end == 0 ? i : shape.rows - 1;
        for (int k = first; k <= last; ++k)
        {
          sum = hn::MulAdd(hn::Set(tag, weights[k * shape.rows + i]),
            hn::LoadU(tag, f + k * shape.stride + j), sum);
        }
      }
      else
      {
        for (int k = 0; k < shape.columns; ++k)
        {
          sum = hn::MulAdd(hn::Set(tag, f[i * shape.stride + k]),
            hn::LoadU(tag, weights.data() + k * shape.stride + j), sum);
        }
      }
      hn::StoreU(sum, tag, to + i * shape.stride + j);
      least = hn::Min(least, sum);
    }
  }
  return hn::GetLane(hn::MinOfLanes(tag, least));
}

// === The proof ===

bool Finder::prove_all()
{
  if (this->found() && this->best().distance <= this->Query.tolerance)
  {
    return true; // no distance is negative
  }
  bool proved = true;
  for (std::size_t k = 0; k < this->Workspace.survivors.size(); ++k)
  {
    const PieceFoot survivor = this->Workspace.survivors[k];
    Verdict verdict = Verdict::Improved;
    while (verdict == Verdict::Improved)
    {
      verdict = this->prove(survivor);
    }
    proved = proved && verdict == Verdict::Proved;
  }
  return proved;
}

Finder::Verdict Finder::prove(const PieceFoot& survivor)
{
  const PieceQuery query = this->at(survivor.piece);
  const Piece& piece = *query.piece;
  const PieceShape& shape = *piece.shape;
  const Level level =
    this->found() ? this->level_of(query) : this->level_of(query, this->Query.limit);
  const double distance = this->found() ? this->best().distance : this->Query.limit;
  const double tolerance = std::min(this->Query.tolerance, distance);
  this->Slack = this->found() ? tolerance * (2.0 * distance - tolerance) : 0.0;
  this->Margin = level.margin * piece.greatest_weight;
  this->Shift = shape.rational ? this->Slack * piece.greatest_weight : 0.0;
  this->Known = &survivor;
  const int size = shape.form_size;
  const bool has_u = shape.rows > 1;
  const bool has_v = shape.columns > 1;
  const double n = shape.rows - 1;
  const double m = shape.columns - 1;
  std::vector<SearchWorkspace::Cell>& cells = this->Workspace.cells;
  cells.clear();
  const double least = this->form(
    query, level.constant + this->Slack - level.margin, this->coefficients(0, size));
  cells.push_back({ { { 0.0, 0.0 } }, { { 1.0, 1.0 } }, least, 0.0, 0 });
  bool open = false;
  while (!cells.empty())
  {
    const SearchWorkspace::Cell cell = cells.back();
    const std::size_t at = cells.size() - 1;
    if (cell.least >= cell.error)
    {
      cells.pop_back();
      continue;
    }
    if (++this->Cells > kMostCells)
    {
      return Verdict::Open;
    }
    double* f = this->coefficients(at, size);
    if (this->improves_at_corner(query, cell, f))
    {
      return Verdict::Improved;
    }
    const Differences d = differences(shape, f);
    const double first = this->least_first_difference(cell.error);
    const double second = this->least_second_difference(cell.error);
    const Range range{ cell.lower, cell.upper };
    Verdict verdict = Verdict::Open;
    const double uv = d.greatest_uv + second;
    const bool convex = (!has_u || d.least_uu > second) && (!has_v || d.least_vv > second) &&
      (!has_u || !has_v ||
        // (n(n−1) uu)(m(m−1) vv) > (n m uv)²
        (d.least_uu - second) * (d.least_vv - second) * (n - 1.0) * (m - 1.0) > n * m * uv * uv);
    if (convex)
    {
      verdict = this->support(query, range, this->Known->t);
    }
    for (int i = 0; i < 2 && verdict == Verdict::Open; ++i)
    {
      // Monotone: only one side matters.
      const double lowest = i == 0 ? d.least_u : d.least_v;
      const double highest = i == 0 ? d.greatest_u : d.greatest_v;
      if (shape.degree[i] > 0 && (lowest > first || highest < -first))
      {
        verdict = this->prove_side(query, range, f, cell.error, i, lowest > first ? 0 : 1);
        break;
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
    if (cell.depth >= kMostHalvings)
    {
      // Not proved; but nothing that a descent from here can find is passed over.
      if (this->support(query, range, cell.lower) == Verdict::Improved)
      {
        return Verdict::Improved;
      }
      open = true;
      cells.pop_back();
      continue;
    }
    // Halved where the slope changes more.
    const double change_u = has_u ? (d.greatest_u - d.least_u) * n : -1.0;
    const double change_v = has_v ? (d.greatest_v - d.least_v) * m : -1.0;
    const int cut = change_u > change_v ? 0 : 1;
    const int terms = cut == 0 ? shape.rows : shape.columns;
    const double middle = 0.5 * (cell.lower[cut] + cell.upper[cut]);
    SearchWorkspace::Cell low = cell;
    SearchWorkspace::Cell high = cell;
    low.error = high.error = cell.error + terms * kRounding * d.greatest;
    low.depth = high.depth = cell.depth + 1;
    low.upper[cut] = middle;
    high.lower[cut] = middle;
    // The upper half goes on top of the lower one, which takes the place of the whole.
    double* scratch = this->coefficients(at + 2, size); // the last one first: it may move the others
    double* upper = this->coefficients(at + 1, size);
    f = this->coefficients(at, size);
    high.least = halve(shape, f, cut, 1, upper);
    low.least = halve(shape, f, cut, 0, scratch);
    std::copy(scratch, scratch + size, f);
    cells.back() = low;
    cells.push_back(high);
  }
  return open ? Verdict::Open : Verdict::Proved;
}

/// The coefficients at the corners are values of F: where one is negative the corner itself is nearer
/// than the best foot, and a descent from there finds what is nearer still.
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
    if (value < least)
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
  place.t = { { (found / 2 == 0 ? cell.lower : cell.upper)[0],
    (found % 2 == 0 ? cell.lower : cell.upper)[1] } };
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
  if (inside && this->supports(query, range, known))
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
  return this->supports(query, range, foot) ? Verdict::Proved : Verdict::Open;
}

/// Whether the tangent plane of F = w² (|S − P|² − d²) at a place stays above what is allowed.
bool Finder::supports(const PieceQuery& query, const Range& range, const PieceFoot& place) const
{
  const Piece& piece = *query.piece;
  double excess;
  if (this->found())
  {
    // Without the cancellation of large numbers: (S − f)·(S + f − 2P).
    const PieceFoot& foot = this->best();
    excess = 0.0;
    for (int k = 0; k < 3; ++k)
    {
      excess += (place.position[k] - foot.position[k]) * (place.offset[k] + foot.offset[k]);
    }
  }
  else
  {
    excess = place.distance * place.distance - this->Query.limit * this->Query.limit;
  }
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
