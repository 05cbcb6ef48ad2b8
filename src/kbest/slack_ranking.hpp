#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "bnb/slack_search.hpp"
#include "kbest/combinations.hpp"

namespace nda::kbest {

struct SlackRanking {
  RankedList packings;    ///< of least slack, ascending
  bool complete = false;  ///< these are the k best below the budget, or all of them
  /// If complete: no packing that is not listed has less slack than this, or than the k-th one.
  double next = 0;
  std::int64_t nodes = 0;
  double work = 0;  ///< as limited
};

/// The k packings of least slack among those below a finite `budget`; packings are equal where
/// their arcs are.
/// @param names   [arc of the problem]: what it is called in `combinations`.
/// @param margin  >= 0: packings whose slacks differ by no more differ by rounding only, so nothing
///                that is not better than the k-th by more than this is looked for.
///
/// Deterministic unless the deadline strikes.  Cost: exponential in the worst case; memory
/// O(depth * (arcs + k)) and one pair for every packing of any part that was looked at.
SlackRanking rank_slack(const bnb::SlackProblem& problem,
                        double budget,
                        std::size_t k,
                        const bnb::SlackLimits& limits,
                        std::span<const std::uint32_t> names,
                        Combinations& combinations,
                        double margin = 0);

}  // namespace nda::kbest
