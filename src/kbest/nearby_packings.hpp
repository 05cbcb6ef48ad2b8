#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bnb/slack_search.hpp"
#include "core/component.hpp"
#include "core/lists.hpp"
#include "core/random.hpp"
#include "kbest/packing_buffer.hpp"

namespace nda::kbest {

/// The slack of a packing, arcs of a problem without cuts: always the same sum.  Cost: O(rows).
double slack_of_packing(const bnb::SlackProblem& problem, const std::vector<core::ArcId>& arcs);

/// Looks for packings of little slack near those that are known.  It claims nothing: what it finds
/// bounds the k-th best.
class NearbyPackings {
 public:
  /// @param problem  without cuts; must outlive it.
  explicit NearbyPackings(const bnb::SlackProblem& problem);

  /// Adds packings of less slack than `budget` to `known`, which holds one at least, slacks as
  /// costs: until all it wants have a slack of at most `goal`, a part of limits.max_work was spent
  /// without a find, or a limit strikes.  Deterministic unless the deadline strikes.  Returns the
  /// nodes of its searches.
  std::int64_t search(PackingBuffer& known,
                      double budget,
                      double goal,
                      const bnb::SlackLimits& limits);

 private:
  bool look_around(const core::Packing& base, double limit, PackingBuffer& known);
  void free_some(const std::vector<core::ArcId>& packing);
  void free(core::ArcId arc);
  void find_fitting(double limit);
  bnb::SlackProblem freed_problem() const;
  double freed_slack() const;
  void number_rows();
  core::Packing completed(const core::Packing& base, const std::vector<core::ArcId>& arcs) const;

  const bnb::SlackProblem& problem_;
  core::Lists<core::ArcId> arcs_of_;  // by row
  core::Random random_{1};
  std::size_t num_freed_ = 4;  // arcs, at a time
  bnb::SlackLimits left_;
  std::int64_t nodes_ = 0;
  // Of the packing at hand.
  std::vector<core::ArcId> owner_;  // [row]: arc that keeps it
  std::vector<core::ArcId> freed_;
  std::vector<std::uint32_t> touched_;  // rows that were freed, or are left alone nearby
  std::vector<core::ArcId> fitting_;    // arcs that touch them and no row that is kept
  std::vector<std::uint32_t> rows_;     // touched, or of arcs that fit
  std::vector<std::uint32_t> number_;   // [row]: among these
};

}  // namespace nda::kbest
