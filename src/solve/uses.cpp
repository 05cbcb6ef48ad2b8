#include "solve/uses.hpp"

#include <algorithm>

#include "core/double_double.hpp"
#include "core/use_bounds.hpp"

namespace nda::pipeline {

using core::ArcId;

std::optional<RankedSolution> solution_of_uses(const Problem& problem, std::vector<ArcId> arcs) {
  std::sort(arcs.begin(), arcs.end());
  RankedSolution solution;
  core::DoubleDouble cost;
  for (const ArcId a : arcs) {
    cost.add(problem.costs()[a]);
    solution.arcs.push_back(problem.arc(a));
  }
  for (int k = 0; k < problem.num_dimensions(); ++k) {
    std::vector<Index> uses(problem.size(k) + std::size_t{1}, 0);
    for (const ArcId a : arcs) ++uses[problem.indices(k)[a]];
    for (Index i = 1; i < uses.size(); ++i) {
      const double single = problem.singleton_costs(k)[i];
      const auto times = core::singleton_uses(problem.use_bounds(k, i), single, uses[i]);
      if (!times) return std::nullopt;
      if (*times > 0) cost.add(single * static_cast<double>(*times));
    }
  }
  solution.cost = cost.high();
  return solution;
}

void release_unusable(const Problem& problem, std::vector<std::vector<double>>& multipliers) {
  for (int k = 0; k < problem.num_dimensions(); ++k) {
    const std::span<const UseBounds> bounds = problem.use_bounds(k);
    if (std::none_of(bounds.begin(), bounds.end(), [](const UseBounds& of) { return of.hi == 0; }))
      continue;
    for (std::size_t a = 0; a < problem.num_arcs(); ++a) {
      const Index i = problem.indices(k)[a];
      if (i == 0 || bounds[i].hi != 0) continue;
      double r = problem.costs()[a];
      for (int other = 0; other < problem.num_dimensions(); ++other) {
        const Index j = problem.indices(other)[a];
        if (j != 0) r -= multipliers[static_cast<std::size_t>(other)][j - 1];
      }
      if (r < 0) multipliers[static_cast<std::size_t>(k)][i - 1] += 2 * r;
    }
  }
}

}  // namespace nda::pipeline
