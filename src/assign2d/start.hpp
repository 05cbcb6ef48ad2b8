#pragma once

#include "nda/assign2d.hpp"

namespace nda::lap {

/// Prepares `result` for a solve: sizes, no assignment, finite prices v <= column_outside.
///
/// Warm, if `result` is feasible, of the same shape, and holds prices that are finite and not so
/// far beyond the costs that their rounding would matter: prices are clipped to column_outside, and
/// column_of_row keeps the former mates as a hint (row_of_column is cleared).  Otherwise cold, with
/// cold_prices().
/// @return whether the start was warm.
bool start(const Assign2dProblem& problem, Assign2dResult& result, bool warm);

/// Start prices for a cold solve.
///
/// v = column_outside wherever that is of the size of the costs, so that columns are satisfied from
/// the start.  A column that must be assigned, or whose outside option is out of proportion, gets
/// min over i of c_ij - p_i instead (column reduction), where p_i is row_outside if in proportion
/// (then rows are satisfied from the start and columns look for them) and a row minimum otherwise.
void cold_prices(const Assign2dProblem& problem, Assign2dResult& result);

/// Completes `result` from assignment and v: u and cost from the costs of the chosen pairs, or the
/// look of an infeasible result.  `pair_cost(i)` is the cost of the pair of the assigned row i.
template <class PairCost>
void finish(const Assign2dProblem& problem,
            bool feasible,
            Assign2dResult& result,
            const PairCost& pair_cost) {
  result.feasible = feasible;
  result.cost = feasible ? 0 : kInfinity;
  if (!feasible) return;
  for (std::uint32_t i = 0; i < problem.num_rows(); ++i) {
    const std::int32_t j = result.column_of_row[i];
    const double cost = j == kUnassigned ? problem.row_outside[i] : pair_cost(i);
    result.u[i] = j == kUnassigned ? cost : cost - result.v[j];
    result.cost += cost;
  }
  for (std::uint32_t j = 0; j < problem.num_columns(); ++j) {
    if (result.row_of_column[j] == kUnassigned) result.cost += problem.column_outside[j];
  }
}

}  // namespace nda::lap
