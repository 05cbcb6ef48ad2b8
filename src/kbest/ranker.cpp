#include "kbest/ranker.hpp"

#include "kbest/bounded_ranker.hpp"
#include "kbest/slack_ranker.hpp"

namespace nda::kbest {

std::unique_ptr<Ranker> make_ranker(const Problem& problem, const Solution& solution) {
  if (problem.is_many_to_one()) return std::make_unique<BoundedRanker>(problem, solution);
  return std::make_unique<SlackRanker>(problem, solution);
}

}  // namespace nda::kbest
