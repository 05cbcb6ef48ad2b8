#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/clock.hpp"
#include "core/component.hpp"
#include "core/shift.hpp"
#include "nda/problem.hpp"
#include "nda/solution.hpp"

namespace nda::kbest {

/// A problem and its best solution as the multipliers see them: every cost is a constant plus
/// reduced costs of the arcs used and prices of the indices left alone, all >= 0.
class SlackView {
 public:
  static constexpr core::ArcId kNone = ~core::ArcId{0};

  /// Of `solution` the first entry and the multipliers count.  The problem must outlive it.
  /// Good for nothing if the deadline strikes.  Cost: O(A N).
  SlackView(const Problem& problem, const Solution& solution, const core::Deadline& deadline);

  const Problem& problem() const { return problem_; }
  /// What multipliers charge indices, as singletons do.
  const core::Shift& multipliers() const { return multipliers_; }
  double reduced(core::ArcId a) const { return reduced_[a]; }
  /// Of leaving an index alone, beyond its multiplier; +inf where that is forbidden.
  double price(std::size_t slot) const { return price_[slot]; }
  std::size_t slot(std::size_t k, Index i) const { return offset_[k] + i; }
  /// Arcs of the best solution.
  const std::vector<core::ArcId>& best() const { return best_; }
  /// Of the best solution.
  double slack() const { return slack_; }

  /// A neighbour of the best solution: it has one arc more, without those that exclude it, or one
  /// less; or two more, where the second covers all that the first laid bare.
  struct Neighbour {
    double rise;                 ///< of the cost
    core::ArcId arc;             ///< put in, or taken out
    core::ArcId second = kNone;  ///< put in as well
  };
  /// All of one arc that leave no index alone that must not be, and of those with two arcs some
  /// that may be among the `wanted` cheapest; in no order.  All are different.  Cut short by the
  /// deadline.  Cost: O(A N^2 + wanted N log A).
  std::vector<Neighbour> neighbours(std::size_t wanted, const core::Deadline& deadline) const;
  std::vector<core::ArcId> arcs_of(const Neighbour& neighbour) const;

  /// Its cost is recomputed from the arcs.
  RankedSolution solution_of(std::vector<core::ArcId> arcs) const;

 private:
  Index index(std::size_t k, core::ArcId a) const {
    return problem_.indices(static_cast<int>(k))[a];
  }
  template <typename Visit>
  void for_each_index(core::ArcId a, Visit&& visit) const {
    for (std::size_t k = 0; k < offset_.size(); ++k) {
      if (const Index i = index(k, a); i != 0) visit(k, i);
    }
  }
  template <typename Visit>
  void for_each_slot(core::ArcId a, Visit&& visit) const {
    for_each_index(a, [&](std::size_t k, Index i) { visit(slot(k, i)); });
  }
  // The arcs of the best solution that share an index with an arc, each once.
  template <typename Visit>
  void for_each_excluder(core::ArcId a, Visit&& visit) const {
    for_each_index(a, [&](std::size_t k, Index i) {
      const core::ArcId owner = owner_[slot(k, i)];
      if (owner == kNone) return;
      bool seen = false;
      for (std::size_t d = 0; d < k; ++d)
        seen = seen || (index(d, a) != 0 && index(d, a) == index(d, owner));
      if (!seen) visit(owner);
    });
  }
  void price_indices(const Solution& solution);
  void reduce_costs(const core::Deadline& deadline);
  void take(const RankedSolution& best);
  double rise(core::ArcId a) const;
  double removal(core::ArcId b, core::ArcId next) const;
  void add_pairs(std::size_t wanted,
                 const core::Deadline& deadline,
                 std::vector<Neighbour>& found) const;
  std::optional<Neighbour> complete(core::ArcId a) const;
  std::vector<Index> laid_bare(core::ArcId a) const;
  bool is_best(core::ArcId a) const;

  const Problem& problem_;
  core::Shift multipliers_;
  std::vector<std::size_t> offset_;  // [k]: first slot, that of the dummy
  std::vector<double> price_;        // [slot]
  std::vector<double> reduced_;      // [arc]
  std::vector<core::ArcId> best_;    // ascending
  std::vector<core::ArcId> owner_;   // [slot]: which of them covers it
  double slack_ = 0;
};

}  // namespace nda::kbest
