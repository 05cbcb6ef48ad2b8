#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bnb/slack_search.hpp"
#include "core/clock.hpp"
#include "core/component.hpp"
#include "kbest/combinations.hpp"
#include "kbest/slack_ranking.hpp"
#include "kbest/slack_view.hpp"

namespace nda::kbest {

/// A part of a problem that shares no index with the rest, with the slack of its arcs and indices,
/// and what the best solution has of it.
class Part {
 public:
  /// @param component  cut out of the problem of `view`, which has the prices.
  Part(core::Component component, const SlackView& view);

  /// Looks for multipliers that leave the best solution less slack, where it has much.
  /// Not where singletons are forbidden.
  void tighten(const core::Deadline& deadline);

  /// Of the best solution.
  double least() const { return least_; }
  /// The sum of all finite terms of slack.
  double all() const;

  /// The k packings of least slack that exceed the best solution's by less than `reach`.
  SlackRanking rank(double reach,
                    std::size_t k,
                    const bnb::SlackLimits& limits,
                    Combinations& combinations) const;

 private:
  double slack_of_best() const;

  core::Component component_;
  std::vector<double> reduced_;    // [arc]
  std::vector<double> price_;      // [slot]
  std::vector<core::ArcId> best_;  // arcs of the best solution
  double error_;                   // of rounding
  double least_;
};

/// What lies above that is beyond a slack, whatever rounding did.
double beyond(double slack, double error);

}  // namespace nda::kbest
