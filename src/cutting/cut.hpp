#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/component.hpp"
#include "nda/proof.hpp"

namespace nda::cutting {

/// A Chvatal-Gomory cut of rank 1 from the rows of a few indices: with integer weights p and a
/// divisor D > max p,
///
///     sum over arcs of floor(sum of p over the arc's slots / D) x[a] <= floor(sum p / D)
///
/// holds for every packing, since every row of it is at most 1.  p = (1, 1, 1), D = 2 is the
/// clique of Balas & Saltzman: of three indices, at most one arc uses two or more.
struct Cut {
  std::vector<std::uint32_t> slots;  ///< ascending
  std::vector<std::uint8_t> weights;
  std::uint8_t divisor = 2;

  /// floor(sum p / D).
  int right_side() const;
};

/// An arc of a cut and its coefficient, 1 or more.
struct CutEntry {
  core::ArcId arc;
  int coefficient;
};

/// A cut as a row of a relaxation.
struct CutRow {
  Cut cut;
  std::vector<CutEntry> entries;  ///< its arcs among those live when it was made
  double multiplier = 0;          ///< <= 0
  int idle = 0;                   ///< solves since its multiplier was not 0
};

/// Those that count, as bnb::ProofLog takes them.
std::vector<ProofCut> proof_cuts(std::span<const CutRow> rows);

/// What a cut says of arcs that use no other than these slots, and where: slots[slot] of its own;
/// 0 = not among them.
Cut restrict_cut(const Cut& cut, std::span<const std::uint32_t> slots);

/// The arcs in every slot: what cuts are made of.  4 bytes per (arc, real index).
class SlotIndex {
 public:
  SlotIndex(const core::Component& component, std::span<const core::ArcId> arcs)
      : arcs_(core::list_by_slot(component, arcs)) {}

  std::span<const core::ArcId> operator[](std::uint32_t slot) const { return arcs_[slot]; }

 private:
  core::Lists<core::ArcId> arcs_;
};

/// Lists the arcs of cuts; keeps its scratch memory, all 0, between calls.
class CutLister {
 public:
  explicit CutLister(std::size_t num_arcs) : weight_(num_arcs, 0) {}

  /// All arcs of `index` with a coefficient in the cut.
  std::vector<CutEntry> list(const Cut& cut, const SlotIndex& index);

 private:
  std::vector<int> weight_;  // [arc]
  std::vector<core::ArcId> touched_;
};

}  // namespace nda::cutting
