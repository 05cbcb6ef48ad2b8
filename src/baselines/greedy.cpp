#include <string>

#include "baselines/bounded.hpp"
#include "baselines/ranked_arcs.hpp"
#include "core/random.hpp"
#include "core/use_bounds.hpp"

// Greedy and its randomised sister.  With the arcs sorted, the restricted candidate list is a
// window over the ranking: filled from the front with arcs that fit, and swept after each choice.
// One construction therefore looks at every arc once and costs no more than greedy, save for the
// sweeps (a few arcs each).

namespace nda {
namespace {

using baselines::Cover;
using baselines::RankedArcs;
using baselines::Value;

// One construction, into `chosen`.
void construct(const RankedArcs& ranked,
               std::size_t num_candidates,
               core::Random& random,
               Cover& cover,
               std::vector<std::size_t>& chosen) {
  cover.clear();
  chosen.clear();
  std::vector<std::size_t> candidates;
  std::size_t next = 0;
  while (true) {
    for (; next < ranked.size() && candidates.size() < num_candidates; ++next) {
      if (cover.is_free(ranked.slots(next))) candidates.push_back(next);
    }
    if (candidates.empty()) return;
    const std::size_t rank = candidates[random.below(candidates.size())];
    cover.add(ranked.slots(rank));
    chosen.push_back(rank);
    std::erase_if(candidates, [&](std::size_t r) { return !cover.is_free(ranked.slots(r)); });
  }
}

void validate(const RandomizedGreedyOptions& options) {
  if (options.iterations < 1) {
    throw InputError("iterations is " + std::to_string(options.iterations) + ", at least 1 needed");
  }
  if (options.candidates < 1) {
    throw InputError("candidates is " + std::to_string(options.candidates) + ", at least 1 needed");
  }
}

}  // namespace

BaselineResult solve_greedy(const Problem& problem) {
  if (problem.is_many_to_one()) return baselines::bounded_greedy(problem);
  const RankedArcs ranked(problem);
  Cover cover(ranked.num_slots());
  std::vector<std::size_t> chosen;
  complete_greedily(ranked, cover, chosen);
  return make_result(problem, ranked, chosen);
}

BaselineResult solve_randomized_greedy(const Problem& problem,
                                       const RandomizedGreedyOptions& options) {
  validate(options);
  core::require_single_uses(problem, "randomised greedy");
  const RankedArcs ranked(problem);
  Cover cover(ranked.num_slots());
  core::Random random(options.seed);
  std::vector<std::size_t> best;
  complete_greedily(ranked, cover, best);
  std::vector<std::size_t> chosen;
  for (int i = 1; i < options.iterations; ++i) {
    construct(ranked, static_cast<std::size_t>(options.candidates), random, cover, chosen);
    if (total_value(ranked, chosen) < total_value(ranked, best)) best = chosen;
  }
  return make_result(problem, ranked, best);
}

}  // namespace nda
