#include "assign2d/ranking_state.hpp"

#include <algorithm>
#include <utility>

// Thousands of assignments that differ by a short path from one another are kept as a tree of
// differences, and one state walks along its edges.  An edge holds the values of the end at which
// the state is not (Baker's "shallow binding", Communications of the ACM 21 (1978) 565-569): half
// the memory of old and new values, and walking back is walking.

namespace nda::lap {

void RankingState::start(const Assign2dProblem& problem, const Assign2dResult& best) {
  row_outside_ = problem.row_outside;
  column_outside_ = problem.column_outside;
  row_cost_.assign(row_outside_.begin(), row_outside_.end());
  column_of_row_.assign(row_outside_.size(), kNone);
  row_of_column_.assign(column_outside_.size(), nobody());
  u_.assign(row_outside_.begin(), row_outside_.end());
  v_ = best.v;
  for (std::uint32_t i = 0; i < num_rows(); ++i) {
    if (best.column_of_row[i] == kUnassigned) continue;
    const std::uint32_t j = static_cast<std::uint32_t>(best.column_of_row[i]);
    const auto row_begin = problem.column.begin() + problem.row_start[i];
    const auto row_end = problem.column.begin() + problem.row_start[i + 1];
    const auto k = std::lower_bound(row_begin, row_end, j) - problem.column.begin();
    column_of_row_[i] = j;
    row_of_column_[j] = i;
    row_cost_[i] = problem.cost[k];
    refresh_row(i);
  }
  forget_log();
}

void RankingState::forget_log() {
  row_changes_.clear();
  price_changes_.clear();
}

void RankingState::choose(std::uint32_t i, std::uint32_t j, double cost) {
  row_changes_.push_back({i, column_of_row_[i], row_cost_[i]});
  column_of_row_[i] = j;
  row_cost_[i] = cost;
  if (j != kNone) row_of_column_[j] = i;
}

void RankingState::set_price(std::uint32_t j, double price) {
  price_changes_.push_back({j, v_[j]});
  v_[j] = price;
}

void RankingState::refresh_rows(const ChangeRange& range) {
  for (std::uint32_t n = range.row_begin; n < range.row_end; ++n) refresh_row(row_changes_[n].row);
}

void RankingState::refresh(const ChangeRange& range) {
  refresh_rows(range);
  for (std::uint32_t n = range.price_begin; n < range.price_end; ++n) {
    const std::uint32_t i = row_of_column_[price_changes_[n].column];
    if (i != nobody()) refresh_row(i);
  }
}

ChangeRange RankingState::open_range() const {
  const std::uint32_t rows = static_cast<std::uint32_t>(row_changes_.size());
  const std::uint32_t prices = static_cast<std::uint32_t>(price_changes_.size());
  return {rows, rows, prices, prices};
}

void RankingState::close_range(ChangeRange& range) const {
  range.row_end = static_cast<std::uint32_t>(row_changes_.size());
  range.price_end = static_cast<std::uint32_t>(price_changes_.size());
}

void RankingState::release_rows(const ChangeRange& range) {
  for (std::uint32_t n = range.row_begin; n < range.row_end; ++n) {
    const std::uint32_t j = column_of_row_[row_changes_[n].row];
    if (j != kNone) release(j);
  }
}

void RankingState::hold_rows(const ChangeRange& range) {
  for (std::uint32_t n = range.row_begin; n < range.row_end; ++n) {
    const std::uint32_t i = row_changes_[n].row;
    if (column_of_row_[i] != kNone) hold(column_of_row_[i], i);
  }
}

void RankingState::swap_row(RowChange& change) {
  std::swap(change.column, column_of_row_[change.row]);
  std::swap(change.cost, row_cost_[change.row]);
}

// And the dual of who has the column.
void RankingState::swap_price(PriceChange& change) {
  std::swap(change.price, v_[change.column]);
  const std::uint32_t i = row_of_column_[change.column];
  if (i != nobody()) u_[i] = row_cost_[i] - v_[change.column];
}

void RankingState::undo(const ChangeRange& range) {
  release_rows(range);
  for (std::uint32_t n = range.row_end; n > range.row_begin; --n) swap_row(row_changes_[n - 1]);
  hold_rows(range);
  for (std::uint32_t n = range.price_end; n > range.price_begin; --n) {
    swap_price(price_changes_[n - 1]);
  }
  refresh_rows(range);
}

void RankingState::redo(const ChangeRange& range) {
  release_rows(range);
  for (std::uint32_t n = range.row_begin; n < range.row_end; ++n) swap_row(row_changes_[n]);
  hold_rows(range);
  for (std::uint32_t n = range.price_begin; n < range.price_end; ++n) swap_price(price_changes_[n]);
  refresh_rows(range);
}

void RankingState::drop(const ChangeRange& range) {
  undo(range);
  row_changes_.resize(range.row_begin);
  price_changes_.resize(range.price_begin);
}

void RankingState::write(Assign2dResult& result) const {
  result.feasible = true;
  result.cost = 0;
  result.hall_rows.clear();
  result.hall_columns.clear();
  result.u = u_;
  result.v = v_;
  result.column_of_row.resize(num_rows());
  result.row_of_column.resize(num_columns());
  for (std::uint32_t i = 0; i < num_rows(); ++i) {
    result.column_of_row[i] = static_cast<std::int32_t>(column_of_row_[i]);
    result.cost += row_cost_[i];
  }
  for (std::uint32_t j = 0; j < num_columns(); ++j) {
    const bool assigned = row_of_column_[j] != nobody();
    result.row_of_column[j] = assigned ? static_cast<std::int32_t>(row_of_column_[j]) : kUnassigned;
    if (!assigned) result.cost += column_outside_[j];
  }
}

}  // namespace nda::lap
