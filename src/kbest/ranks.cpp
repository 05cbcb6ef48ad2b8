#include "kbest/ranks.hpp"

#include <algorithm>
#include <cmath>

namespace nda::kbest {
namespace {

// A bound this close to the cost, as a share of it, proves it.
constexpr double kNegligible = 1e-9;

// What was lost by rounding or overflow, no neighbour brings back.
void take_cost(Solution& solution, RankedSolution& first) {
  if (solution.status != Status::kPrecisionLost && first.cost < solution.cost &&
      first.cost - solution.lower_bound <= kNegligible * std::abs(first.cost)) {
    solution.proven = first.proven = true;
    solution.status = Status::kOptimal;
    for (ComponentReport& component : solution.components) {
      component.proven = true;
      component.status = Status::kOptimal;
    }
  }
  solution.cost = first.cost;
  solution.lower_bound = std::min(solution.lower_bound, first.cost);
}

}  // namespace

void sort_by_cost(std::vector<RankedSolution>& ranks, std::size_t first) {
  std::stable_sort(
      ranks.begin() + static_cast<std::ptrdiff_t>(first),
      ranks.end(),
      [](const RankedSolution& a, const RankedSolution& b) { return a.cost < b.cost; });
}

void number(std::vector<RankedSolution>& ranks) {
  for (std::size_t r = 0; r < ranks.size(); ++r) ranks[r].rank = static_cast<int>(r) + 1;
}

std::size_t num_proven(std::span<const RankedSolution> ranks) {
  const auto end = std::find_if_not(
      ranks.begin(), ranks.end(), [](const RankedSolution& rank) { return rank.proven; });
  return static_cast<std::size_t>(end - ranks.begin());
}

void adopt(Solution& solution, std::vector<RankedSolution> ranks) {
  if (!solution.proven) sort_by_cost(ranks);
  take_cost(solution, ranks.front());
  number(ranks);
  solution.solutions = std::move(ranks);
}

}  // namespace nda::kbest
