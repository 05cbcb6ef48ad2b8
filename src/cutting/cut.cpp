#include "cutting/cut.hpp"

#include <numeric>

namespace nda::cutting {

using core::ArcId;

int Cut::right_side() const {
  return std::accumulate(weights.begin(), weights.end(), 0) / divisor;
}

SlotIndex::SlotIndex(const core::Component& component, std::span<const ArcId> arcs)
    : start_(component.num_slots() + 1, 0) {
  for (const ArcId a : arcs) {
    core::for_each_slot(component, a, [&](std::uint32_t slot) { ++start_[slot + 1]; });
  }
  std::partial_sum(start_.begin(), start_.end(), start_.begin());
  arcs_.resize(start_.back());
  std::vector<std::uint32_t> next(start_.begin(), start_.end() - 1);
  for (const ArcId a : arcs) {
    core::for_each_slot(component, a, [&](std::uint32_t slot) { arcs_[next[slot]++] = a; });
  }
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
