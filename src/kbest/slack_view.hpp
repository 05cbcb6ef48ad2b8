#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/clock.hpp"
#include "core/component.hpp"
#include "nda/problem.hpp"
#include "nda/solution.hpp"

namespace nda::kbest {

/// A problem and its best solution as the multipliers see them: every cost is a constant plus
/// reduced costs of the arcs used and prices of the indices left alone, all >= 0.
class SlackView {
 public:
  /// Of `solution` the first entry and the multipliers count.  Cost: O(A N).
  SlackView(const Problem& problem, const Solution& solution);

  const Problem& problem() const { return problem_; }
  double reduced(core::ArcId a) const { return reduced_[a]; }
  /// Of leaving an index alone, beyond its multiplier; +inf where that is forbidden.
  double price(std::size_t slot) const { return price_[slot]; }
  std::size_t num_slots() const { return price_.size(); }
  std::size_t slot(std::size_t k, Index i) const { return offset_[k] + i; }
  /// Arcs of the best solution.
  const std::vector<core::ArcId>& best() const { return best_; }
  /// Of the best solution.
  double slack() const { return slack_; }

  /// A neighbour of the best solution: it has one arc more, without those that exclude it, or one
  /// less.
  struct Neighbour {
    double rise;      ///< of the cost
    core::ArcId arc;  ///< put in, or taken out
  };
  /// The `most` cheapest neighbours, cheapest first, those before the deadline.  All are different.
  /// Cost: O(A N^2).
  std::vector<Neighbour> neighbours(std::size_t most, const core::Deadline& deadline) const;
  std::vector<core::ArcId> arcs_of(const Neighbour& neighbour) const;

  /// Its cost is recomputed from the arcs.
  RankedSolution solution_of(std::vector<core::ArcId> arcs) const;

 private:
  static constexpr core::ArcId kNone = ~core::ArcId{0};

  template <typename Visit>
  void for_each_slot(core::ArcId a, Visit&& visit) const {
    for (std::size_t k = 0; k < offset_.size(); ++k) {
      const Index i = problem_.indices(static_cast<int>(k))[a];
      if (i != 0) visit(slot(k, i));
    }
  }
  void price_indices(const Solution& solution);
  void reduce_costs(const Solution& solution);
  void take(const RankedSolution& best);
  double rise(core::ArcId a) const;
  double removal(core::ArcId b, std::span<const std::size_t> kept) const;
  std::vector<core::ArcId> excluders(core::ArcId a) const;

  const Problem& problem_;
  std::vector<std::size_t> offset_;  // [k]: first slot, that of the dummy
  std::vector<double> price_;        // [slot]
  std::vector<double> reduced_;      // [arc]
  std::vector<core::ArcId> best_;    // ascending
  std::vector<core::ArcId> owner_;   // [slot]: which of them covers it
  double slack_ = 0;
};

}  // namespace nda::kbest
