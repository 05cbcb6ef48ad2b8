#include "nda/k_best.hpp"

#include <algorithm>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

#include "core/use_bounds.hpp"
#include "kbest/near_optimal.hpp"
#include "kbest/ranker.hpp"
#include "kbest/ranking_progress.hpp"
#include "kbest/ranks.hpp"
#include "nda/solve.hpp"
#include "solve/costs.hpp"
#include "solve/process.hpp"
#include "solve/supervision.hpp"

namespace nda {
namespace {

// Ranks after solving, within what that left of the limits.
void rank(const Problem& problem, Solution& solution, std::size_t k, const Options& options) {
  pipeline::Supervision supervision(kbest::ranking_progress(solution, options.progress),
                                    options.stop,
                                    options.time_limit_s - solution.stats.solve_seconds);
  const core::Deadline& deadline = supervision.deadline();
  const std::unique_ptr<kbest::Ranker> ranker = kbest::make_ranker(problem, solution);
  const std::size_t enough = solution.proven ? k : 1;
  ranker->list(enough, k, {options.branch.max_nodes - solution.stats.nodes, deadline});
  const std::size_t listed = std::max<std::size_t>(1, ranker->listed().size());
  std::vector<RankedSolution> others;
  if (!ranker->has_all() && listed < k) others = ranker->unlisted(0, k - listed, deadline);
  solution.lists_all = ranker->has_all() && listed <= k;
  solution.stats.nodes += ranker->nodes();
  std::vector<RankedSolution> ranks = ranker->take();
  if (ranks.empty()) ranks = std::move(solution.solutions);
  if (ranks.size() > k) ranks.resize(k);
  std::ranges::move(others, std::back_inserter(ranks));
  kbest::adopt(problem, solution, std::move(ranks));
  solution.stats.solve_seconds += deadline.seconds();
}

}  // namespace

Solution solve_k_best(const Problem& problem, std::size_t k, const Options& options) {
  if (k == 0) throw InputError("k is 0; at least 1 solution must be asked for");
  if (options.ranking.method != RankingMethod::kExact)
    core::require_single_uses(problem, "ranking by alignments");
  Solution solution = solve(problem, options);
  if (solution.solutions.empty()) return solution;
  if (options.ranking.method != RankingMethod::kExact) {
    // Where costs overflow no dual function has values.
    if (pipeline::largest_cost(problem) > pipeline::kLargestCost) return solution;
    kbest::rank_near_optimal(problem, solution, k, options);
  } else if (k > 1) {
    rank(problem, solution, k, options);
  }
  solution.stats.peak_memory_bytes = pipeline::peak_memory_bytes();
  return solution;
}

std::size_t num_proven(const Solution& solution) {
  return kbest::num_proven(solution.solutions);
}

}  // namespace nda
