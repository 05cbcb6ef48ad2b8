#include "cutting/cut.hpp"

#include <numeric>

namespace nda::cutting {

using core::ArcId;

int Cut::right_side() const {
  return std::accumulate(weights.begin(), weights.end(), 0) / divisor;
}

Cut restrict_cut(const Cut& cut, std::span<const std::uint32_t> slots) {
  Cut restricted{{}, {}, cut.divisor};
  for (std::size_t i = 0; i < cut.slots.size(); ++i) {
    if (slots[cut.slots[i]] == 0) continue;
    restricted.slots.push_back(slots[cut.slots[i]]);
    restricted.weights.push_back(cut.weights[i]);
  }
  return restricted;
}

std::vector<ProofCut> proof_cuts(std::span<const CutRow> rows) {
  std::vector<ProofCut> cuts;
  for (const CutRow& row : rows) {
    if (row.multiplier != 0)
      cuts.push_back({row.cut.slots, row.cut.weights, row.cut.divisor, row.multiplier});
  }
  return cuts;
}

std::vector<CutEntry> CutLister::list(const Cut& cut, const SlotIndex& index) {
  touched_.clear();
  for (std::size_t i = 0; i < cut.slots.size(); ++i) {
    for (const ArcId a : index[cut.slots[i]]) {
      if (weight_[a] == 0) touched_.push_back(a);
      weight_[a] += cut.weights[i];
    }
  }
  std::vector<CutEntry> entries;
  for (const ArcId a : touched_) {
    if (weight_[a] >= cut.divisor) entries.push_back({a, weight_[a] / cut.divisor});
    weight_[a] = 0;
  }
  return entries;
}

}  // namespace nda::cutting
