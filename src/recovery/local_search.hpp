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
/// the cheapest arcs that fit (ejection and repair, O(N) plus a look at the arcs of the freed
/// indices).  A move that does not raise the cost is kept, any other undone.  improve() first tries
/// every arc until none helps, then kicks with arcs drawn at random.
class LocalSearch {
 public:
  /// Keeps a reference to the component.
  explicit LocalSearch(const core::Component& component);

  /// Arcs that the search may force in; all arcs unless set.
  void set_candidates(std::vector<core::ArcId> candidates) { candidates_ = std::move(candidates); }

  /// Improves a packing in place, stopping early at cost <= goal.  Deterministic for a given state
  /// of `random`.
  /// @param kicks  number of random moves; the descent before them is not counted.
  void improve(core::Packing& packing,
               std::int64_t kicks,
               double goal,
               core::Random& random,
               const core::Deadline& deadline);

 private:
  bool try_force(core::ArcId a);
  void repair();
  void undo();
  void descend(const core::Deadline& deadline);

  const core::Component& component_;
  SlotArcs slot_arcs_;
  PackingState state_;
  std::vector<core::ArcId> candidates_;
  std::vector<core::ArcId> removed_;
  std::vector<core::ArcId> inserted_;
  std::vector<std::uint32_t> freed_;
};

}  // namespace nda::recovery
