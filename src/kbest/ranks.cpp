#include "kbest/ranks.hpp"

#include <algorithm>

#include "core/shift.hpp"
#include "solve/component_solver.hpp"
#include "solve/costs.hpp"

namespace nda::kbest {
namespace {

// Proves the first, if the bound shows that no solution costs less, as precisely as a solve must
// know it: to less than a step where costs lie on a grid, which is a bound of the cost itself.
void prove_by_bound(const Problem& problem, Solution& solution, RankedSolution& first) {
  core::CostGrid grid = core::find_grid(problem);
  if (problem.is_many_to_one() && !grid.exact) grid = {};  // sums of many uses round otherwise
  const pipeline::Precision precision =
      pipeline::precision_of(problem.num_indices(), pipeline::largest_cost(problem), grid);
  const double open = first.cost - solution.lower_bound;
  const bool is_known = precision.on_grid() || pipeline::is_negligible(problem, open, first.cost);
  if (!is_known || open > precision.margin) return;
  solution.proven = first.proven = true;
  solution.status = Status::kOptimal;
  if (!precision.on_grid()) return;
  const double rounding = grid.exact ? 0.0 : pipeline::off_grid(problem, first.cost);
  solution.lower_bound = std::max(solution.lower_bound, first.cost - rounding);
  solution.stats.bound_by_branching = solution.lower_bound > solution.stats.certificate_bound;
}

// What was lost by rounding or overflow, no neighbour brings back.
void take_cost(const Problem& problem, Solution& solution, RankedSolution& first) {
  if (solution.status != Status::kPrecisionLost && first.cost < solution.cost)
    prove_by_bound(problem, solution, first);
  solution.cost = first.cost;
  solution.lower_bound = std::min(solution.lower_bound, first.cost);
}

}  // namespace

std::size_t first_pass(std::size_t least, std::size_t growth, std::size_t planned) {
  std::size_t count = planned;
  while (count / growth >= least) count = (count - 1) / growth + 1;
  return count;
}

void sort_by_cost(std::vector<RankedSolution>& ranks, std::size_t first) {
  const auto added = std::span(ranks).subspan(first);
  if (std::ranges::is_sorted(added, {}, &RankedSolution::cost)) return;
  std::ranges::stable_sort(added, {}, &RankedSolution::cost);
}

void number(std::vector<RankedSolution>& ranks) {
  for (std::size_t r = 0; r < ranks.size(); ++r) ranks[r].rank = static_cast<int>(r) + 1;
}

std::size_t num_proven(std::span<const RankedSolution> ranks) {
  const auto end = std::find_if_not(
      ranks.begin(), ranks.end(), [](const RankedSolution& rank) { return rank.proven; });
  return static_cast<std::size_t>(end - ranks.begin());
}

void adopt(const Problem& problem, Solution& solution, std::vector<RankedSolution> ranks) {
  sort_by_cost(ranks);
  ranks.front().proven = solution.proven;
  take_cost(problem, solution, ranks.front());
  number(ranks);
  solution.solutions = std::move(ranks);
}

}  // namespace nda::kbest
