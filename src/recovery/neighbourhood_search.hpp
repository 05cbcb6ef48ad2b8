#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bnb/slack_search.hpp"
#include "core/clock.hpp"
#include "core/lists.hpp"
#include "core/random.hpp"
#include "recovery/slack_packing.hpp"

namespace nda::recovery {

/// Large-neighbourhood search with exact subproblems over the packings of a slack problem.
///
/// A neighbourhood is a few arcs of the packing that are taken out; the best way to fill the
/// indices they leave, together with the uncovered ones in reach, is found by search_slack()
/// (bnb/slack_search.hpp), which proves most neighbourhoods exhausted within a millisecond. The
/// better the multipliers, those of cuts among them, the less slack there is to look through.
class NeighbourhoodSearch {
 public:
  /// Keeps a reference to the problem.
  explicit NeighbourhoodSearch(const bnb::SlackProblem& problem);

  struct Limits {
    double max_work = 0;              ///< of subproblems (bnb::SlackLimits), some 3e8 a second
    double goal = 0;                  ///< a slack that ends the search
    double most_reduced = kInfinity;  ///< reduced cost of arcs that may come in
    core::Deadline deadline;
  };

  /// Improves a packing (arcs of the problem, ascending) in place; returns the work it took.
  /// Deterministic for a given state of `random`.
  double improve(std::vector<std::uint32_t>& packing, const Limits& limits, core::Random& random);

 private:
  struct Attempt {
    bool complete = false;
    double work = 0;
  };

  std::span<const std::uint32_t> arcs_of(std::uint32_t index) const { return arcs_[index]; }
  void list_arcs();

  std::uint32_t choose_seed(core::Random& random) const;
  double blame(std::uint32_t index) const;
  void free_around(std::uint32_t seed, std::size_t count, core::Random& random);
  void free_arc(std::uint32_t arc);
  bool fits(std::uint32_t arc) const;
  Attempt refill(std::uint32_t without, double allowed_rise, const Limits& limits);
  std::vector<std::uint32_t> candidates(std::uint32_t without, double most_reduced);
  bnb::SlackProblem subproblem(const std::vector<std::uint32_t>& arcs);
  void list_rows(const std::vector<std::uint32_t>& arcs);
  double slack_of_freed() const;

  const bnb::SlackProblem& problem_;
  core::Lists<std::uint32_t> arcs_;   // of indices, by reduced cost
  std::vector<std::uint32_t> inner_;  // indices with arcs

  SlackPacking state_;

  // The neighbourhood.
  std::vector<std::uint32_t> freed_;  // arcs
  std::vector<std::uint32_t> freed_indices_;
  std::vector<char> is_freed_;        // [index]
  std::vector<std::uint32_t> rows_;   // of the subproblem, indices first
  std::vector<std::uint32_t> row_;    // [row]: its number in the subproblem
  std::vector<std::uint32_t> taken_;  // [row]: what freed arcs use of it; 0 between attempts
  std::vector<char> listed_;          // [arc]; 0 between attempts
  std::size_t looked_at_ = 0;         // arcs, by the last candidates()
};

}  // namespace nda::recovery
