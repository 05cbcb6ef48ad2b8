#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/clock.hpp"
#include "core/component.hpp"
#include "core/random.hpp"
#include "recovery/packing_state.hpp"

namespace nda::recovery {

/// Iterated local search over packings of one component.
///
/// The one move: force an arc in, throw out what it conflicts with, and fill the freed indices with
/// the cheapest arcs that fit (ejection and repair).  A move that does not raise the cost is kept,
/// any other undone. improve() first tries every arc until none helps, then arcs drawn at random.
///
/// Multipliers tell most moves hopeless in O(N): in their terms a packing costs sum u + sum of r
/// over its arcs + sum of -u over its uncovered indices, and a move can gain at most what the arcs
/// it throws out and the uncovered indices it covers contribute.
class LocalSearch {
 public:
  /// Keeps a reference to the component.  u: feasible multipliers by slot (u <= 0, reduced costs >=
  /// 0).
  LocalSearch(const core::Component& component,
              std::span<const double> u,
              const core::Deadline& deadline = {});

  /// Improves a packing in place, stopping early at cost <= goal.  Deterministic for a given state
  /// of `random`.
  /// @param kicks  number of random moves; the descent before them is not counted.
  void improve(core::Packing& packing,
               std::int64_t kicks,
               double goal,
               core::Random& random,
               const core::Deadline& deadline);

 private:
  bool try_force(core::ArcId a, double allowed_rise);
  bool hopeless(core::ArcId a, double allowed_rise) const;
  bool fits(core::ArcId a) const;
  void repair();
  void undo();
  void descend(const core::Deadline& deadline);
  void anneal(std::int64_t kicks,
              double goal,
              core::Random& random,
              const core::Deadline& deadline);
  void keep_best();

  const core::Component& component_;
  SlotArcs slot_arcs_;
  ArcSlots arc_slots_;
  PackingState state_;
  std::vector<double> reduced_;  // [arc]
  std::vector<double> price_;    // [slot]: -u
  std::vector<core::ArcId> removed_;
  std::vector<core::ArcId> inserted_;
  std::vector<core::ArcId> fitting_;
  std::vector<std::uint32_t> freed_;
  std::vector<std::uint32_t> seen_;  // [arc]: number of the repair that looked at it last
  std::uint32_t num_repairs_ = 0;
  core::Packing best_;
};

}  // namespace nda::recovery
