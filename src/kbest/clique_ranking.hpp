#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "bnb/slack_search.hpp"
#include "kbest/combinations.hpp"
#include "kbest/slack_ranking.hpp"

namespace nda::kbest {

/// Whether rank_cliques() is for it: few arcs, no cuts, no row that must be used up.
bool may_rank_cliques(const bnb::SlackProblem& problem);

/// As rank_slack(), by covers by cliques (bnb/clique_search.hpp): for problems with few arcs whose
/// multipliers leave a wide gap, whatever their prices.
/// @param problem  one that may_rank_cliques().
/// @param step     slacks of packings differ by multiples of it, but for rounding; 0 = by anything.
///                  What exceeds the budget by less than 1/64 of it may be listed.
///
/// Not complete where the search has hardly begun after an eighth of limits.max_work; one that is
/// well advanced may take sixteen times as long.
SlackRanking rank_cliques(const bnb::SlackProblem& problem,
                          double budget,
                          std::size_t k,
                          double step,
                          const bnb::SlackLimits& limits,
                          std::span<const std::uint32_t> names,
                          Combinations& combinations);

}  // namespace nda::kbest
