#pragma once

#include <cstdint>
#include <vector>

#include "bnb/slack_search.hpp"
#include "core/clock.hpp"
#include "core/for_all.hpp"
#include "core/lists.hpp"
#include "core/random.hpp"
#include "recovery/neighbourhood.hpp"
#include "recovery/slack_packing.hpp"

namespace nda::recovery {

/// Large-neighbourhood search with exact subproblems over the packings of a slack problem.
///
/// A neighbourhood is a few arcs of the packing that are taken out; the best way to fill the
/// indices they leave, together with the uncovered ones in reach, is found by search_slack()
/// (bnb/slack_search.hpp), which proves most neighbourhoods exhausted within a millisecond. The
/// better the multipliers, those of cuts among them, the less slack there is to look through.
/// Several are searched at once, as long as they stay out of each other's way.
class NeighbourhoodSearch {
 public:
  /// Keeps a reference to the problem.
  explicit NeighbourhoodSearch(const bnb::SlackProblem& problem);
  NeighbourhoodSearch(const NeighbourhoodSearch&) = delete;
  NeighbourhoodSearch& operator=(const NeighbourhoodSearch&) = delete;

  struct Limits {
    double max_work = 0;              ///< of subproblems (bnb::SlackLimits), some 3e8 a second
    double goal = 0;                  ///< a slack that ends the search
    double most_reduced = kInfinity;  ///< reduced cost of arcs that may come in
    core::Deadline deadline;
    core::ForAll for_all;  ///< of neighbourhoods
  };

  /// Improves a packing (arcs of the problem, ascending) in place; returns the work it took.
  /// Deterministic for a given state of `random`, whatever `limits.for_all` does at once.
  double improve(std::vector<std::uint32_t>& packing, const Limits& limits, core::Random& random);

 private:
  void list_arcs();
  std::uint32_t choose_seed(core::Random& random) const;
  double blame(std::uint32_t index) const;

  const bnb::SlackProblem& problem_;
  core::Lists<std::uint32_t> arcs_;   // of indices, by reduced cost
  std::vector<std::uint32_t> inner_;  // indices with arcs
  double arc_share_ = 0;              // of these, that an arc covers on average
  SlackPacking state_;
  std::vector<Neighbourhood> neighbourhoods_;  // that are searched at once
};

}  // namespace nda::recovery
