#include "solve/solutions.hpp"

#include "core/double_double.hpp"

namespace nda::pipeline {

using core::ArcId;

Solution solution_of(const Problem& problem) {
  Solution solution;
  solution.sizes.assign(problem.sizes().begin(), problem.sizes().end());
  solution.num_arcs = problem.num_arcs();
  return solution;
}

Coverage coverage(const Problem& problem, std::span<const ArcId> arcs) {
  Coverage covered;
  for (int k = 0; k < problem.num_dimensions(); ++k) {
    std::vector<bool>& used = covered.emplace_back(problem.size(k) + std::size_t{1}, false);
    for (const ArcId a : arcs) used[problem.indices(k)[a]] = true;
  }
  return covered;
}

RankedSolution make_solution(const Problem& problem,
                             std::span<const ArcId> arcs,
                             const Coverage& covered) {
  RankedSolution solution;
  core::DoubleDouble cost;
  for (const ArcId a : arcs) {
    cost.add(problem.costs()[a]);
    solution.arcs.push_back(problem.arc(a));
  }
  for (int k = 0; k < problem.num_dimensions(); ++k) {
    const auto singletons = problem.singleton_costs(k);
    for (Index i = 1; i < singletons.size(); ++i) {
      if (!covered[static_cast<std::size_t>(k)][i]) cost.add(singletons[i]);
    }
  }
  solution.cost = cost.high();
  return solution;
}

}  // namespace nda::pipeline
