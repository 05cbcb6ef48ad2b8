#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "bnb/slack_search.hpp"
#include "core/clock.hpp"
#include "core/component.hpp"
#include "kbest/combinations.hpp"
#include "kbest/slack_view.hpp"

namespace nda::kbest {

/// A part of a problem that shares no index with the rest, with the slack of its arcs and indices,
/// what the best solution has of it, and its packings as far as they were ranked.
class Part {
 public:
  /// @param component  cut out of the problem of `view`, which has the prices.
  Part(core::Component component, const SlackView& view);

  /// Looks for multipliers that leave the best solution less slack, where it has much.
  void tighten(const core::Deadline& deadline);

  /// Of the problem, ascending.
  std::span<const core::ArcId> arcs() const { return component_.arc_origin; }
  /// Slack of the best solution.
  double least() const { return least_; }

  /// Ranks the packings whose slack exceeds the best solution's by no more than `reach`, or the k
  /// best of them; nothing is searched where it is known that there are no others.  Returns
  /// whether the limits let it; `nodes` grows by those searched.
  bool rank(double reach,
            std::size_t k,
            const bnb::SlackLimits& limits,
            Combinations& combinations,
            std::int64_t& nodes);

  /// The packings found, ascending: all those within the last reach, or the k best of them, and
  /// maybe others.
  const RankedList& list() const { return list_; }
  /// None that is not listed exceeds the best solution's slack by less than this.
  double reached() const;

 private:
  double slack_of_best() const;

  core::Component component_;
  std::vector<double> reduced_;    // [arc]
  std::vector<double> price_;      // [slot]
  std::vector<core::ArcId> best_;  // arcs of the best solution
  double error_;                   // of rounding
  double least_;
  RankedList list_;
  std::size_t listed_k_ = 0;  // of how many the list is
  double next_ = 0;           // slack that others have at least, if the list is shorter
};

/// What lies above that is beyond a slack, whatever rounding did.
double beyond(double slack, double error);

}  // namespace nda::kbest
