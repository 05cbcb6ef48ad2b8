#include "assign2d/dense_solver.hpp"

#include <algorithm>

#include "assign2d/dense_kernels.hpp"
#include "assign2d/start.hpp"

// The steps of sparse_solver.cpp on a full matrix.  A problem that stores all pairs is used as it
// is; one that does not is spread out with +inf.  The transposed matrix is made when columns are in
// want, which after a start from column_outside they are not.

namespace nda::lap {

void DenseSolver::match_tight_pairs(const DenseProblem& problem, Assign2dResult& result) const {
  for (std::uint32_t i = 0; i < problem.num_rows(); ++i) {
    const double* c = problem.line(i);
    const LineOffers best = line_offers(c, result.v.data(), problem.num_columns());
    const double least = std::min(best.first, problem.row_outside[i]);
    const std::int32_t former = result.column_of_row[i];
    std::uint32_t j = best.first < problem.row_outside[i] ? best.at : kNone;
    if (former != kUnassigned && c[former] - result.v[former] == least) {
      j = static_cast<std::uint32_t>(former);
    }
    result.u[i] = least == kInfinity ? 0 : least;
    result.column_of_row[i] = kUnassigned;
    if (j == kNone || least == kInfinity || result.row_of_column[j] != kUnassigned) continue;
    result.row_of_column[j] = static_cast<std::int32_t>(i);
    result.column_of_row[i] = static_cast<std::int32_t>(j);
  }
}

bool DenseSolver::serve(const DenseProblem& problem, Assign2dResult& result) {
  const Side rows{problem.row_outside, result.u, result.column_of_row};
  const Side columns{problem.column_outside, result.v, result.row_of_column};
  const DensePhase by_rows{{problem.cost.data(), columns.size()}, rows, columns};
  if (!paths_.bid(by_rows) && !paths_.search(by_rows, result.hall_rows)) return false;
  if (!anyone_in_want(columns)) return true;
  columns_.resize(problem.cost.size());
  transpose_matrix(problem.cost, rows.size(), columns.size(), columns_);
  const DensePhase by_columns{{columns_.data(), rows.size()}, columns, rows};
  return paths_.bid(by_columns) || paths_.search(by_columns, result.hall_columns);
}

void DenseSolver::solve_matrix(const DenseProblem& problem, Assign2dResult& result, bool warm) {
  const DenseView view{problem.cost.data(), problem.column_outside.size()};
  paths_.resize(std::max(problem.num_rows(), problem.num_columns()));
  start(view,
        problem.cost,
        problem.row_outside,
        problem.column_outside,
        ColdStart::kColumnsSatisfied,
        result,
        warm);
  match_tight_pairs(problem, result);
  const bool feasible = serve(problem, result);
  finish(problem.row_outside, problem.column_outside, feasible, result, [&](std::uint32_t i) {
    return problem.line(i)[result.column_of_row[i]];
  });
}

}  // namespace nda::lap
