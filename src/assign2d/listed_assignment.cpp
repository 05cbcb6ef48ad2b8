#include "assign2d/listed_assignment.hpp"

#include <algorithm>
#include <utility>

// Thousands of assignments, each of which differs in a few rows from another one, are kept as a
// tree of these differences, and one assignment walks along its edges.  An edge holds the choices
// at the end where the assignment is not (Baker's "shallow binding", Communications of the ACM 21
// (1978) 565-569), so that walking back is walking.

namespace nda::lap {

static_assert(static_cast<std::int32_t>(kNone) == kUnassigned);

void ListedAssignment::start(const Assign2dProblem& problem, const Assign2dResult& best) {
  column_outside_ = problem.column_outside;
  best_ = &best;
  column_of_row_ = best.column_of_row;
  row_cost_.assign(problem.row_outside.begin(), problem.row_outside.end());
  for (std::uint32_t i = 0; i < row_cost_.size(); ++i) {
    if (column_of_row_[i] == kUnassigned) continue;
    const std::uint32_t j = static_cast<std::uint32_t>(column_of_row_[i]);
    const auto row_begin = problem.column.begin() + problem.row_start[i];
    const auto row_end = problem.column.begin() + problem.row_start[i + 1];
    row_cost_[i] = problem.cost[std::lower_bound(row_begin, row_end, j) - problem.column.begin()];
  }
}

void ListedAssignment::exchange(std::span<RowChange> changes) {
  for (RowChange& change : changes) {
    const std::int32_t former = column_of_row_[change.row];
    column_of_row_[change.row] = static_cast<std::int32_t>(change.column);
    change.column = static_cast<std::uint32_t>(former);
    std::swap(row_cost_[change.row], change.cost);
  }
}

void ListedAssignment::write(Assign2dResult& result) const {
  result.feasible = true;
  result.cost = 0;
  result.hall_rows.clear();
  result.hall_columns.clear();
  result.u = best_->u;
  result.v = best_->v;
  result.column_of_row = column_of_row_;
  result.row_of_column.assign(column_outside_.size(), kUnassigned);
  for (std::uint32_t i = 0; i < row_cost_.size(); ++i) {
    result.cost += row_cost_[i];
    if (column_of_row_[i] == kUnassigned) continue;
    result.row_of_column[column_of_row_[i]] = static_cast<std::int32_t>(i);
  }
  for (std::uint32_t j = 0; j < column_outside_.size(); ++j) {
    if (result.row_of_column[j] == kUnassigned) result.cost += column_outside_[j];
  }
}

bool ListedAssignment::is_in(const Assign2dResult& result) const {
  return result.column_of_row == column_of_row_;
}

}  // namespace nda::lap
