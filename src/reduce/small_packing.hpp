#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "reduce/arc_pool.hpp"

namespace nda::reduce {

/// A few arcs that share one index, the gate, with the rest of a pool: their best packings with and
/// without it, and multipliers that prove both.
class SmallPacking {
 public:
  SmallPacking(const ArcPool& pool, std::span<const core::ArcId> arcs);

  /// False where the search is too long, or where the multipliers found do not prove the packings.
  /// The arcs need not use the gate.
  bool solve(std::uint32_t gate);

  double cost_with() const { return best_.cost; }  ///< gate used or not
  double cost_without() const { return best_without_.cost; }
  std::span<const core::ArcId> with() const { return best_.arcs; }
  std::span<const core::ArcId> without() const { return best_without_.arcs; }

  /// All indices of the arcs.
  std::span<const std::uint32_t> slots() const { return slots_; }
  /// By position in slots(): their sum is cost_without(), that of the gate is 0.  With the gate at
  /// cost_with() - cost_without() or lower no arc has a negative reduced cost.
  std::span<const double> multipliers() const { return multipliers_; }

 private:
  bool enumerate(std::size_t next);
  void note_packing();
  bool find_multipliers();
  void halve(std::size_t row);
  void tighten(std::size_t row);
  double reduced(std::size_t n) const;

  std::size_t row_of(std::uint32_t slot) const;

  const std::span<const core::ArcId> arcs_;
  std::vector<double> cost_;                       // of arc n of these
  std::vector<std::vector<std::size_t>> rows_;     // of arc n: positions in slots_
  std::vector<std::vector<std::size_t>> arcs_at_;  // [row]
  std::vector<std::uint32_t> slots_;
  std::size_t gate_row_ = 0;
  core::Packing best_;
  core::Packing best_without_;
  core::Packing current_;
  std::vector<char> used_;  // by row, and for a gate that no arc uses
  int steps_ = 0;
  double gate_price_ = 0;  // what arcs on the gate save by the gate's multiplier
  std::vector<double> multipliers_;
};

}  // namespace nda::reduce
