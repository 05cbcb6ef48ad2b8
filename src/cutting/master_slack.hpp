#pragma once

#include <span>
#include <vector>

#include "bnb/slack_search.hpp"
#include "core/component.hpp"
#include "cutting/master.hpp"

namespace nda::cutting {

/// A solved master as a slack problem: the cost of a packing of its live arcs that are not
/// forbidden is base() plus its slack.
///
/// Slack is cost but for a constant only if no reduced cost is negative, and the simplex method
/// leaves some below 0 within its tolerance: the multipliers are made feasible first.  Keeps
/// references to both.  Cost: O(live arcs * N + entries of cuts) each for making it and for
/// problem().
class MasterSlack {
 public:
  MasterSlack(const core::Component& component, const Master& master);

  double base() const { return base_; }
  /// The feasible multipliers, by slot.
  std::span<const double> u() const { return u_; }

  /// Of a live arc.
  double reduced(core::ArcId a) const;
  /// The arcs that a budget pays for, ascending.
  std::vector<core::ArcId> affordable(double budget) const;
  /// The problem over these arcs, numbered in their order.  Rows are slots, then cuts with a price;
  /// the price of a forced slot is infinite.
  bnb::SlackProblem problem(const std::vector<core::ArcId>& arcs) const;

 private:
  void make_feasible();
  std::vector<std::vector<bnb::RowUse>> add_cuts(const std::vector<core::ArcId>& arcs,
                                                 bnb::SlackProblem& problem) const;

  const core::Component& component_;
  const Master& master_;
  std::vector<double> u_;
  double base_ = 0;
};

}  // namespace nda::cutting
