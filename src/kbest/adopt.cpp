#include "kbest/adopt.hpp"

#include <algorithm>
#include <cmath>

#include "kbest/ranker.hpp"

namespace nda::kbest {
namespace {

// A bound this close to the cost, as a share of it, proves it.
constexpr double kNegligible = 1e-9;

void take_cost(Solution& solution, RankedSolution& first) {
  if (first.cost < solution.cost &&
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

void adopt(Solution& solution, std::vector<RankedSolution> ranks) {
  if (!solution.proven) {
    sort_by_cost(ranks);
    take_cost(solution, ranks.front());
  }
  for (std::size_t r = 0; r < ranks.size(); ++r) ranks[r].rank = static_cast<int>(r) + 1;
  solution.solutions = std::move(ranks);
}

}  // namespace nda::kbest
