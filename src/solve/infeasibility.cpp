#include "solve/infeasibility.hpp"

#include <algorithm>

namespace nda::pipeline {
namespace {

constexpr std::size_t kMostNamed = 8;

std::string name(const RealIndex& index) {
  return "index " + std::to_string(index.index) + " of dimension " +
         std::to_string(index.dimension + 1);
}

}  // namespace

std::string infeasibility_reason(const Problem& problem, const std::vector<RealIndex>& uncovered) {
  const std::vector<RealIndex> lonely = indices_without_arcs(problem);
  if (!lonely.empty()) return name(lonely[0]) + " has no arc and its singleton is forbidden";
  std::string text = "not all indices with forbidden singletons can be covered at once: at least " +
                     std::to_string(uncovered.size()) +
                     (uncovered.size() == 1 ? " stays" : " stay") + " uncovered, for instance ";
  for (std::size_t i = 0; i < uncovered.size() && i < kMostNamed; ++i) {
    text += (i > 0 ? ", " : "") + name(uncovered[i]);
  }
  if (uncovered.size() > kMostNamed) {
    text += " and " + std::to_string(uncovered.size() - kMostNamed) + " more";
  }
  return text;
}

std::vector<RealIndex> indices_without_arcs(const Problem& problem) {
  std::vector<RealIndex> lonely;
  for (int k = 0; k < problem.num_dimensions(); ++k) {
    const auto costs = problem.singleton_costs(k);
    if (std::find(costs.begin(), costs.end(), kInfinity) == costs.end()) continue;
    std::vector<bool> used(problem.size(k) + std::size_t{1}, false);
    for (const Index i : problem.indices(k)) used[i] = true;
    for (Index i = 1; i <= problem.size(k); ++i) {
      if (!used[i] && costs[i] == kInfinity) lonely.push_back({k, i});
    }
  }
  return lonely;
}

}  // namespace nda::pipeline
