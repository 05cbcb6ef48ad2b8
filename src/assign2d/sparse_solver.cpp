#include "assign2d/sparse_solver.hpp"

#include <algorithm>

#include "assign2d/start.hpp"

// Prices v decide everything: u = min(outside, min c - v) follows, a pair with c - u - v = 0 is
// tight, and rows take tight pairs as they come (a warm start prefers the former mate).  Then rows
// in want are served, which leaves no row in want, then columns, which keeps it so: see
// sparse_paths.cpp.
//
// Drift cannot build up over thousands of warm solves, because every one computes u afresh.

namespace nda::lap {

void SparseSolver::match_tight_pairs(const Assign2dProblem& problem, Assign2dResult& result) {
  for (std::uint32_t i = 0; i < problem.num_rows(); ++i) {
    const std::int32_t former = result.column_of_row[i];
    double least = problem.row_outside[i];
    std::uint32_t best = kNone;
    for (std::uint32_t k = problem.row_start[i]; k < problem.row_start[i + 1]; ++k) {
      const std::uint32_t j = problem.column[k];
      const double offer = problem.cost[k] - result.v[j];
      if (offer > least || (offer == least && static_cast<std::int32_t>(j) != former)) continue;
      least = offer;
      best = k;
    }
    result.u[i] = least == kInfinity ? 0 : least;
    result.column_of_row[i] = kUnassigned;
    if (best == kNone || least == kInfinity) continue;
    const std::uint32_t j = problem.column[best];
    if (result.row_of_column[j] != kUnassigned) continue;
    result.row_of_column[j] = static_cast<std::int32_t>(i);
    result.column_of_row[i] = static_cast<std::int32_t>(j);
    pair_of_row_[i] = best;
  }
}

void SparseSolver::do_solve(const Assign2dProblem& problem, Assign2dResult& result, bool warm) {
  const std::size_t size = std::max(problem.num_rows(), problem.num_columns());
  paths_.resize(size);
  pair_of_row_.resize(problem.num_rows());
  start(problem, result, warm);
  match_tight_pairs(problem, result);

  const Side rows = row_side(problem, result);
  const Side columns = column_side(problem, result);
  const RowView by_rows{problem.row_start, problem.column, problem.cost};
  bool feasible =
      paths_.serve(Phase<RowView>{by_rows, rows, columns, pair_of_row_}, result.hall_rows);
  if (feasible && anyone_in_want(columns)) {
    feasible =
        paths_.serve(Phase<ColumnView>{transpose_.view(problem), columns, rows, pair_of_row_},
                     result.hall_columns);
  }
  finish(problem, feasible, result, [&](std::uint32_t i) { return problem.cost[pair_of_row_[i]]; });
}

}  // namespace nda::lap
