#include "assign2d/ranking_search.hpp"

#include <algorithm>

// Taking a pair from an optimal assignment leaves a row and a column in want, duals feasible.  The
// cheapest repair is a shortest path from the row to the column in the residual graph, where
// "outside" is a node like a column with room for everyone.  Such a path is looked for from both of
// its ends, as sparse_paths.cpp does for whole problems: from the row to the nearest end (that
// column, another one that nobody has, or an outside option), and then, if the column is still in
// want, from the column.  So a repair that goes by way of outside, as most do in tracking, touches
// the surroundings of both ends only, and so do its duals.
//
// Rows that are not open and their columns are not in the graph.

namespace nda::lap {
namespace {

// A half of the search: members of `own` look for partners among `other`.
struct RowHalf {
  const RankingState& state;
  const RankingSubproblem& subproblem;
  const PairLines& pairs;

  double dual(std::uint32_t i) const { return state.u(i); }
  double other_dual(std::uint32_t j) const { return state.v(j); }
  double fallback(std::uint32_t i) const {
    return subproblem.allows(i, kNone) ? state.row_outside(i) : kInfinity;
  }
  bool is_open(std::uint32_t j) const { return subproblem.is_open(state.row_of_column(j)); }
  bool allows(std::uint32_t i, std::uint32_t j) const { return subproblem.allows(i, j); }
  bool is_free(std::uint32_t j) const { return mate(j) == state.nobody(); }
  std::uint32_t mate(std::uint32_t j) const { return state.row_of_column(j); }
};

struct ColumnHalf {
  const RankingState& state;
  const RankingSubproblem& subproblem;
  const PairLines& pairs;

  double dual(std::uint32_t j) const { return state.v(j); }
  double other_dual(std::uint32_t i) const { return state.u(i); }
  double fallback(std::uint32_t j) const { return state.column_outside(j); }
  bool is_open(std::uint32_t i) const { return subproblem.is_open(i); }
  bool allows(std::uint32_t j, std::uint32_t i) const { return subproblem.allows(i, j); }
  bool is_free(std::uint32_t i) const { return mate(i) == kNone; }
  std::uint32_t mate(std::uint32_t i) const { return state.column_of_row(i); }
};

}  // namespace

void RankingSearch::resize(std::uint32_t num_rows, std::uint32_t num_columns) {
  const std::uint32_t n = std::max(num_rows, num_columns);
  distance_.assign(n, kInfinity);
  from_.resize(n);
  from_pair_.resize(n);
  reached_.clear();
  heap_.resize(n);
}

void RankingSearch::forget_search() {
  for (const std::uint32_t j : reached_) distance_[j] = kInfinity;
  reached_.clear();
  settled_.clear();
  heap_.clear();
}

template <class Half>
void RankingSearch::scan(const Half& half, std::uint32_t member, double distance, End& end) {
  const double dual = half.dual(member);
  const double fallback = distance + std::max(0.0, half.fallback(member) - dual);
  if (fallback < end.distance) end = {fallback, true, member};
  const PairLines& pairs = half.pairs;
  for (std::uint32_t k = pairs.start[member]; k < pairs.start[member + 1]; ++k) {
    const std::uint32_t j = pairs.partner[k];
    const double reach = distance + std::max(0.0, pairs.cost[k] - dual - half.other_dual(j));
    if (!(reach < end.distance) || !(reach < distance_[j])) continue;
    if (!half.is_open(j) || !half.allows(member, j)) continue;
    if (reach > limit_) {
      least_beyond_ = std::min(least_beyond_, reach);
      continue;
    }
    if (distance_[j] == kInfinity) reached_.push_back(j);
    distance_[j] = reach;
    from_[j] = member;
    from_pair_[j] = k;
    if (half.is_free(j)) {
      end = {reach, false, j};
    } else {
      heap_.push_or_decrease(j, reach);
    }
  }
}

template <class Half>
RankingSearch::End RankingSearch::find_path(const Half& half, std::uint32_t source, double limit) {
  forget_search();
  limit_ = limit;
  least_beyond_ = kInfinity;
  End end{kInfinity, true, source};
  scan(half, source, 0, end);
  while (!heap_.empty() && heap_.top_key() < end.distance) {
    const std::uint32_t j = heap_.pop();
    settled_.push_back(j);
    scan(half, half.mate(j), distance_[j], end);
  }
  return end;
}

// The row takes its place along the path; prices of the columns in its tree fall.
void RankingSearch::serve_row(RankingState& state,
                              const PairLines& pairs,
                              std::uint32_t source,
                              const End& end) const {
  for (const std::uint32_t j : settled_) {
    if (distance_[j] < end.distance) state.set_price(j, state.v(j) - (end.distance - distance_[j]));
  }
  std::uint32_t j = end.member;
  if (end.outside) {
    j = state.column_of_row(end.member);
    state.choose(end.member, kNone, state.row_outside(end.member));
    if (end.member == source) return;
  }
  for (std::uint32_t i = kNone; i != source;) {
    i = from_[j];
    const std::uint32_t next = state.column_of_row(i);
    state.choose(i, j, pairs.cost[from_pair_[j]]);
    j = next;
  }
}

// The column takes its place along the path; prices of the columns in its tree rise.
void RankingSearch::serve_column(RankingState& state,
                                 const PairLines& pairs,
                                 std::uint32_t source,
                                 const End& end) const {
  state.set_price(source, state.v(source) + end.distance);
  for (const std::uint32_t i : settled_) {
    const std::uint32_t j = state.column_of_row(i);
    if (distance_[i] < end.distance) state.set_price(j, state.v(j) + (end.distance - distance_[i]));
  }
  std::uint32_t i = end.member;
  if (end.outside) {
    state.set_price(end.member, state.column_outside(end.member));
    if (end.member == source) return;
    i = state.row_of_column(end.member);
    state.release(end.member);
  }
  for (std::uint32_t j = kNone; j != source;) {
    j = from_[i];
    const std::uint32_t next = state.row_of_column(j);
    state.choose(i, j, pairs.cost[from_pair_[i]]);
    i = next;
  }
}

RankingSearch::Outcome RankingSearch::choose_again(RankingState& state,
                                                   const RankingCore& core,
                                                   const RankingSubproblem& subproblem,
                                                   std::uint32_t row,
                                                   double limit) {
  Outcome outcome{false, 0, state.open_range()};
  const std::uint32_t left = state.column_of_row(row);
  if (left != kNone) state.release(left);
  const End row_end = find_path(RowHalf{state, subproblem, core.by_row()}, row, limit);
  outcome.loss = std::min(row_end.distance, least_beyond_);
  if (!(row_end.distance <= limit)) {
    if (left != kNone) state.hold(left, row);
    return outcome;
  }
  serve_row(state, core.by_row(), row, row_end);
  state.close_range(outcome.changes);
  state.refresh(outcome.changes);
  const bool in_want = left != kNone && state.row_of_column(left) == state.nobody() &&
                       state.v(left) < state.column_outside(left);
  outcome.found = true;
  if (!in_want) return outcome;

  const double rest = limit - row_end.distance;
  const End column_end = find_path(ColumnHalf{state, subproblem, core.by_column()}, left, rest);
  outcome.loss += std::min(column_end.distance, least_beyond_);
  outcome.found = column_end.distance <= rest;
  if (!outcome.found) {
    state.drop(outcome.changes);
    return outcome;
  }
  serve_column(state, core.by_column(), left, column_end);
  state.close_range(outcome.changes);
  state.refresh(outcome.changes);
  return outcome;
}

}  // namespace nda::lap
