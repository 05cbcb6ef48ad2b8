#pragma once

#include <vector>

#include "core/random.hpp"
#include "nda/check.hpp"
#include "nda/problem.hpp"
#include "nda/solution.hpp"
#include "support/brute_force.hpp"

namespace nda::core {

/// Multipliers between -10 and 10 times `size`, M_k a dimension.
inline std::vector<std::vector<double>> random_multipliers(const Problem& problem,
                                                           Random& random,
                                                           double size) {
  std::vector<std::vector<double>> multipliers;
  for (const Index count : problem.sizes()) {
    std::vector<double>& row = multipliers.emplace_back();
    for (Index i = 0; i < count; ++i) row.push_back(random.uniform(-10, 10) * size);
  }
  return multipliers;
}

/// A solution that is right in every respect, made without the solver: `best` by enumeration, the
/// bound is what the multipliers prove, so the status only says that a limit was hit.
inline Solution right_solution(const Problem& problem,
                               const support::ExactSolution& best,
                               std::vector<std::vector<double>> multipliers) {
  Solution solution;
  solution.sizes.assign(problem.sizes().begin(), problem.sizes().end());
  solution.num_arcs = problem.num_arcs();
  solution.status = Status::kIterationLimit;
  solution.multipliers = std::move(multipliers);
  solution.lower_bound = certificate_bound(problem, solution.multipliers);
  solution.stats.certificate_bound = solution.lower_bound;
  solution.cost = best.cost;
  solution.solutions.push_back({1, best.cost, false, best.arcs});
  return solution;
}

}  // namespace nda::core
