#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/component.hpp"

namespace nda::reduce {

/// The arcs of a component while reductions remove them.
///
/// Three things happen to it, and together they carry every reduction:
///   - an arc is *dropped*: some best packing does without it;
///   - an index is *charged*: its multiplier becomes so much lower, and what every arc on it costs
///     that much higher, as in the cost shift; arcs that no longer pay are dropped;
///   - an index is *relieved*: it is no longer counted among the indices of its arcs, since another
///     index forbids all that it forbids.
///
/// *Choices* are what has been put off until the rest is solved, undone last first (restore()).
class ArcPool {
 public:
  /// Arcs that do not pay (c' >= 0) are dropped at once.  Keeps its memory between calls.
  /// Cost O(A N).
  void reset(const core::Component& component);

  std::size_t num_arcs() const { return cost_.size(); }  ///< dropped ones too
  std::size_t num_slots() const { return charge_.size(); }
  std::size_t num_alive() const { return num_alive_; }

  bool alive(core::ArcId a) const { return alive_[a] != 0; }
  double cost(core::ArcId a) const { return cost_[a]; }
  /// The indices of an arc that are not relieved, ascending.
  std::span<const std::uint32_t> slots(core::ArcId a) const {
    return {slots_.data() + a * stride_, length_[a]};
  }
  /// The arcs alive that use this index, ascending; none where it is relieved.  Valid until the
  /// next call for the same index.
  std::span<const core::ArcId> arcs_at(std::uint32_t slot);

  void drop(core::ArcId a);
  /// Returns how many arcs that dropped.
  std::size_t charge(std::uint32_t slot, double amount);
  /// The same where all arcs on the index are dropped anyhow.
  void note_charge(std::uint32_t slot, double amount) { charge_[slot] += amount; }
  void relieve(std::uint32_t slot);

  /// Once the rest is solved, `arcs` are taken if all their indices are free then, else
  /// `otherwise`.
  void choose(std::span<const core::ArcId> arcs, std::span<const core::ArcId> otherwise = {});

  /// What has been charged, by slot.
  std::span<const double> charges() const { return charge_; }
  /// Completes a packing of the arcs that are alive to one of the component.
  core::Packing restore(const core::Component& component, std::vector<core::ArcId> arcs) const;

 private:
  struct Choice {
    std::uint32_t first;      // in chosen_
    std::uint32_t otherwise;  // where the second list begins
    std::uint32_t end;
  };

  void fill_arcs(const core::Component& component);
  void fill_lists();

  std::size_t stride_ = 0;
  std::size_t num_alive_ = 0;
  std::vector<char> alive_;            // [arc]
  std::vector<double> cost_;           // [arc]
  std::vector<std::uint8_t> length_;   // [arc]
  std::vector<std::uint32_t> slots_;   // [arc * stride_ ...]
  std::vector<std::uint32_t> start_;   // [slot]: its list in arcs_
  std::vector<std::uint32_t> degree_;  // [slot]: how long that is
  std::vector<char> stale_;            // [slot]: it holds arcs that were dropped
  std::vector<core::ArcId> arcs_;
  std::vector<double> charge_;  // [slot]
  std::vector<Choice> choices_;
  std::vector<core::ArcId> chosen_;
};

}  // namespace nda::reduce
