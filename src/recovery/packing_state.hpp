#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/clock.hpp"
#include "core/component.hpp"

namespace nda::recovery {

/// For every slot its arcs, cheapest first by costs of any kind (in any order where the deadline
/// strikes).  4 bytes per (arc, real index).
class SlotArcs {
 public:
  SlotArcs(const core::Component& component,
           std::span<const double> costs,
           const core::Deadline& deadline = {});

  std::span<const core::ArcId> operator[](std::uint32_t slot) const { return arcs_[slot]; }

 private:
  core::Lists<core::ArcId> arcs_;
};

/// For every arc its slots of real indices, side by side in memory.  4 bytes per (arc, real index).
class ArcSlots {
 public:
  explicit ArcSlots(const core::Component& component);

  std::span<const std::uint32_t> operator[](core::ArcId a) const {
    return std::span(slots_).subspan(start_[a], start_[a + 1] - start_[a]);
  }

 private:
  std::vector<std::uint32_t> start_;
  std::vector<std::uint32_t> slots_;
};

/// Reduced costs of all arcs under feasible multipliers: what rounding leaves below 0 counts as 0.
std::vector<double> reduced_costs(const core::Component& component, std::span<const double> u);

/// No arc.
inline constexpr core::ArcId kNoArc = ~core::ArcId{0};

/// A packing under change: who covers every slot, and what it costs.  Every move is O(N).
class PackingState {
 public:
  explicit PackingState(const core::Component& component)
      : component_(component), owner_(component.num_slots(), kNoArc) {}

  core::ArcId owner(std::uint32_t slot) const { return owner_[slot]; }
  double cost() const { return cost_; }

  /// No index of the arc is covered.
  bool fits(core::ArcId a) const;
  /// The arc must fit.
  void insert(core::ArcId a);
  /// The arc must be in.
  void remove(core::ArcId a);
  /// Writes the distinct arcs that share an index with a (a itself not), returns their cost.
  double conflicts(core::ArcId a, std::vector<core::ArcId>& found) const;
  bool contains(core::ArcId a) const;

  /// The arcs in, ascending, and their cost summed afresh.
  core::Packing packing() const;
  void assign(const core::Packing& packing);

 private:
  const core::Component& component_;
  std::vector<core::ArcId> owner_;
  double cost_ = 0;
};

}  // namespace nda::recovery
