#include "cutting/cut.hpp"

#include <numeric>

namespace nda::cutting {

using core::ArcId;

int Cut::right_side() const {
  return std::accumulate(weights.begin(), weights.end(), 0) / divisor;
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
