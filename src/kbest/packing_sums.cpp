#include "kbest/packing_sums.hpp"

#include <cstdint>

namespace nda::kbest {

void PackingSums::add(const std::vector<core::Packing>& list) {
  RankedList ranked;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto leaf = static_cast<std::uint32_t>(members_.size());
    members_.emplace_back(num_lists_, i);
    ranked.push_back({list[i].cost, combinations_.single(leaf)});
  }
  sums_ = combine_ranked(sums_, ranked, k_, kInfinity, combinations_);
  ++num_lists_;
}

PackingSums::Choice PackingSums::choice(std::size_t n) const {
  Choice choice;
  for (const std::uint32_t leaf : combinations_.arcs(sums_[n].arcs))
    choice.push_back(members_[leaf]);
  return choice;
}

}  // namespace nda::kbest
