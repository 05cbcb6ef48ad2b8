#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/clock.hpp"
#include "core/component.hpp"
#include "core/random.hpp"
#include "recovery/packing_state.hpp"

namespace nda::recovery {

/// Large-neighbourhood search with exact subproblems over packings of one component.
///
/// A neighbourhood is a few arcs of the packing that are taken out; the best way to fill the
/// indices they leave, together with the uncovered ones in reach, is found by search_slack()
/// (bnb/slack_search.hpp), which proves most neighbourhoods exhausted within a millisecond.
class NeighbourhoodSearch {
 public:
  /// Keeps a reference to the component.  u: feasible multipliers by slot (u <= 0, reduced costs >=
  /// 0); good ones keep the subproblems small.
  NeighbourhoodSearch(const core::Component& component,
                      std::span<const double> u,
                      const core::Deadline& deadline = {});

  /// Improves a packing in place, stopping early at cost <= goal.  Deterministic for a given state
  /// of `random`.
  /// @param max_work  of the subproblems (bnb::SlackLimits), some 3e8 a second.
  void improve(core::Packing& packing,
               double max_work,
               double goal,
               core::Random& random,
               const core::Deadline& deadline);

 private:
  struct Attempt {
    bool complete = false;
    double work = 0;
  };

  std::uint32_t choose_seed(core::Random& random) const;
  void free_around(std::uint32_t seed, std::size_t count, core::Random& random);
  void free_arc(core::ArcId a);
  bool is_free(std::uint32_t slot) const;
  bool fits(core::ArcId a) const;
  Attempt refill(core::ArcId without, double allowed_rise, const core::Deadline& deadline);
  std::vector<core::ArcId> candidates(core::ArcId without);
  double slack_of_freed() const;
  double blame(std::uint32_t slot) const;
  std::uint32_t row_of(std::uint32_t slot);

  const core::Component& component_;
  std::vector<double> reduced_;  // [arc]
  SlotArcs slot_arcs_;           // by reduced cost
  ArcSlots arc_slots_;
  PackingState state_;
  std::vector<double> price_;        // [slot]: -u
  std::vector<std::uint32_t> used_;  // slots with arcs
  std::vector<core::ArcId> freed_;   // arcs of the neighbourhood
  std::vector<std::uint32_t> freed_slots_;
  std::vector<char> is_freed_;       // [slot]
  std::vector<std::uint32_t> row_;   // [slot]: in the subproblem, kNoRow between attempts
  std::vector<std::uint32_t> rows_;  // slots of the subproblem
  std::size_t looked_at_ = 0;        // arcs, by the last candidates()
  std::vector<char> listed_;         // [arc], 0 between attempts
};

}  // namespace nda::recovery
