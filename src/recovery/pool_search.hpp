#pragma once

#include <cstdint>
#include <vector>

#include "bnb/slack_search.hpp"
#include "core/clock.hpp"
#include "core/for_all.hpp"
#include "core/random.hpp"

namespace nda::recovery {

struct PoolSearchOptions {
  double max_work = 0;  ///< of all searches (bnb::SlackLimits), some 3e8 a second
  /// From construction to merging; more where neighbourhoods must be large to be of use.
  double least_round_work = 0;
  /// Of it, for swaps before anything else, chosen by a tabu (recovery/swap_search.hpp), then at
  /// random where arcs exclude few others (recovery/annealing_search.hpp).
  double swap_work = 0;
  double goal = 0;  ///< a slack that ends the search
  /// Arcs that good packings might consist of, such as those that a relaxed point uses.
  std::vector<std::uint32_t> support;
  /// Packings to start from; after those, randomised greedy ones.
  std::vector<std::vector<std::uint32_t>> starts;
  core::Deadline deadline;
  core::ForAll for_all;  ///< of neighbourhoods, and of the parts of long merges
};

/// Searches the packings of a slack problem, improving `best` (arcs of the problem, ascending) in
/// place: constructs packings, improves each by neighbourhood search, and merges the last dozen of
/// them exactly.  Deterministic for a given state of `random`, whatever `options.for_all` does at
/// once.
void search_pool(const bnb::SlackProblem& problem,
                 std::vector<std::uint32_t>& best,
                 const PoolSearchOptions& options,
                 core::Random& random);

}  // namespace nda::recovery
