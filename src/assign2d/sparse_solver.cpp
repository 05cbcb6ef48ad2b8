#include "assign2d/sparse_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "assign2d/start.hpp"

// Prices v decide everything: u = min(outside, min c - v) follows, a pair with c - u - v = 0 is
// tight, and rows take tight pairs as they come (a warm start prefers the former mate).  Then rows
// in want are served, which leaves no row in want, then columns, which keeps it so: see
// sparse_paths.cpp.
//
// Where both sides are in want (a perfect assignment, say), they bid in turn a few times before any
// search: a reverse bid lifts prices that many forward bids have depressed, and each unserved
// member saved is a search over much of the graph saved.
//
// Drift cannot build up over thousands of warm solves, because every one computes u afresh.

namespace nda::lap {
namespace {

constexpr int kBidRounds = 10;  // more find little to do
// What rounding may have added to the offer of a former mate, as part of the numbers in it: prices
// are right to some bits, and to leave a mate for the sake of one of them is to begin anew.
constexpr double kRounding = 4 * std::numeric_limits<double>::epsilon();

}  // namespace

void SparseSolver::match_tight_pairs(const Assign2dProblem& problem, Assign2dResult& result) {
  const RowView by_rows{problem.row_start, problem.column, problem.cost};
  const auto offer = [&](std::uint32_t k) { return problem.cost[k] - result.v[problem.column[k]]; };
  const auto rounding = [&](double least, std::uint32_t k) {
    return kRounding * (std::abs(least) + std::abs(result.v[problem.column[k]]));
  };
  for (std::uint32_t i = 0; i < problem.num_rows(); ++i) {
    const double best = by_rows.least_offer(i, result.v);
    const double least = std::min(best, problem.row_outside[i]);
    const std::int32_t mate = result.column_of_row[i];
    std::uint32_t k = mate == kUnassigned ? kNone
                                          : find_pair(problem.row_start,
                                                      problem.column,
                                                      i,
                                                      static_cast<std::uint32_t>(mate),
                                                      pair_of_row_[i]);
    result.u[i] = least == kInfinity ? 0 : least;
    result.column_of_row[i] = kUnassigned;
    if (least == kInfinity) continue;
    if (k == kNone || offer(k) > least + rounding(least, k)) {
      if (best >= problem.row_outside[i]) continue;
      for (k = problem.row_start[i]; offer(k) != best;) ++k;
    }
    const std::uint32_t j = problem.column[k];
    if (result.row_of_column[j] != kUnassigned) continue;
    result.row_of_column[j] = static_cast<std::int32_t>(i);
    result.column_of_row[i] = static_cast<std::int32_t>(j);
    pair_of_row_[i] = k;
  }
}

bool SparseSolver::serve(const Assign2dProblem& problem, Assign2dResult& result) {
  const Side rows = row_side(problem, result);
  const Side columns = column_side(problem, result);
  const Phase<RowView> by_rows{
      {problem.row_start, problem.column, problem.cost}, rows, columns, pair_of_row_};
  std::size_t unserved = paths_.bid(by_rows);
  const bool columns_served = !anyone_in_want(columns);
  if (columns_served) return unserved == 0 || paths_.search(by_rows, result.hall_rows);

  const Phase<ColumnView> by_columns{transpose_.view(problem), columns, rows, pair_of_row_};
  for (int round = 1; round < kBidRounds && unserved > 0; ++round) {
    if (paths_.bid(by_columns) == 0) break;
    const std::size_t before = std::exchange(unserved, paths_.bid(by_rows));
    if (unserved >= before) break;
  }
  if (!paths_.search(by_rows, result.hall_rows)) return false;
  return paths_.bid(by_columns) == 0 || paths_.search(by_columns, result.hall_columns);
}

void SparseSolver::do_solve(const Assign2dProblem& problem, Assign2dResult& result, bool warm) {
  paths_.resize(std::max(problem.num_rows(), problem.num_columns()));
  pair_of_row_.resize(problem.num_rows(), kNone);
  start(RowView{problem.row_start, problem.column, problem.cost},
        problem.cost,
        problem.row_outside,
        problem.column_outside,
        ColdStart::kMiddle,
        result,
        warm);
  match_tight_pairs(problem, result);
  const bool feasible = serve(problem, result);
  finish(problem.row_outside, problem.column_outside, feasible, result, [&](std::uint32_t i) {
    return problem.cost[pair_of_row_[i]];
  });
}

}  // namespace nda::lap
