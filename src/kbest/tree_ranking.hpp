#pragma once

#include <cstdint>

#include "bnb/slack_search.hpp"
#include "core/component.hpp"
#include "kbest/packing_buffer.hpp"

namespace nda::kbest {

struct TreeRanking {
  bool complete = false;
  std::int64_t nodes = 0;  ///< those of searches included
  double work = 0;         ///< as limited
};

/// Looks for the packings of less slack than `budget`, as many as `known` holds, by branch and cut:
/// for what neither multipliers nor covers by cliques bound well, but cuts and branchings do.
/// Complete: they are all known, or those known are the best there are.
///
/// @param component  whose slots and arcs are the rows and arcs of `slack`, which has no cuts.
/// @param budget     finite.
/// @param margin     >= 0: what is not better by more than this than the last of a full buffer is
///                   not looked for.
/// @param known      by their slack (slack_of_packing); maybe some to begin with.
/// @param leaf_work  BranchAndCutLimits::leaf_work; 0 = nodes end by their bounds alone.
///
/// Not complete where hardly anything is done after a quarter of limits.max_work; a tree that is
/// well advanced may take four times as long.  Deterministic unless the deadline strikes.  Cost:
/// exponential in the worst case.
TreeRanking rank_by_tree(const core::Component& component,
                         const bnb::SlackProblem& slack,
                         double budget,
                         double margin,
                         const bnb::SlackLimits& limits,
                         PackingBuffer& known,
                         double leaf_work = 4e6);

}  // namespace nda::kbest
