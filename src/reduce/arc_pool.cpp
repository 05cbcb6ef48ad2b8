#include "reduce/arc_pool.hpp"

#include <algorithm>
#include <utility>

// An arc that is dropped stays in the lists of its indices until somebody reads them, so that
// dropping costs little and reading pays for every arc once.

namespace nda::reduce {

using core::ArcId;
using core::Component;

void ArcPool::reset(const Component& component) {
  stride_ = component.sizes.size();
  fill_arcs(component);
  charge_.assign(component.num_slots(), 0.0);
  fill_lists();
  choices_.clear();
  chosen_.clear();
}

void ArcPool::fill_arcs(const Component& component) {
  cost_.assign(component.costs.begin(), component.costs.end());
  alive_.resize(cost_.size());
  length_.assign(cost_.size(), 0);
  slots_.resize(cost_.size() * stride_);
  num_alive_ = 0;
  for (ArcId a = 0; a < cost_.size(); ++a) {
    alive_[a] = cost_[a] < 0;
    num_alive_ += cost_[a] < 0;
    std::uint32_t* slots = slots_.data() + a * stride_;
    core::for_each_slot(component, a, [&](std::uint32_t slot) { slots[length_[a]++] = slot; });
  }
}

void ArcPool::fill_lists() {
  degree_.assign(charge_.size(), 0);
  stale_.assign(charge_.size(), 0);
  for (ArcId a = 0; a < cost_.size(); ++a) {
    if (!alive_[a]) continue;
    for (const std::uint32_t slot : slots(a)) ++degree_[slot];
  }
  start_.resize(charge_.size());
  std::uint32_t next = 0;
  for (std::size_t slot = 0; slot < start_.size(); ++slot) {
    start_[slot] = next;
    next += std::exchange(degree_[slot], 0);
  }
  arcs_.resize(next);
  for (ArcId a = 0; a < cost_.size(); ++a) {
    if (!alive_[a]) continue;
    for (const std::uint32_t slot : slots(a)) arcs_[start_[slot] + degree_[slot]++] = a;
  }
}

std::span<const ArcId> ArcPool::arcs_at(std::uint32_t slot) {
  ArcId* const list = arcs_.data() + start_[slot];
  if (std::exchange(stale_[slot], 0) == 0) return {list, degree_[slot]};
  std::uint32_t kept = 0;
  for (std::uint32_t n = 0; n < degree_[slot]; ++n) {
    if (alive_[list[n]]) list[kept++] = list[n];
  }
  degree_[slot] = kept;
  return {list, kept};
}

void ArcPool::drop(ArcId a) {
  if (std::exchange(alive_[a], 0) == 0) return;
  --num_alive_;
  for (const std::uint32_t slot : slots(a)) stale_[slot] = 1;
}

std::size_t ArcPool::charge(std::uint32_t slot, double amount) {
  note_charge(slot, amount);
  const std::size_t before = num_alive_;
  for (const ArcId a : arcs_at(slot)) {
    cost_[a] -= amount;
    if (cost_[a] >= 0) drop(a);
  }
  return before - num_alive_;
}

void ArcPool::relieve(std::uint32_t slot) {
  for (const ArcId a : arcs_at(slot)) {
    std::uint32_t* const begin = slots_.data() + a * stride_;
    std::remove(begin, begin + length_[a], slot);
    --length_[a];
  }
  degree_[slot] = 0;
}

void ArcPool::choose(std::span<const ArcId> arcs, std::span<const ArcId> otherwise) {
  Choice choice{static_cast<std::uint32_t>(chosen_.size()), 0, 0};
  chosen_.insert(chosen_.end(), arcs.begin(), arcs.end());
  choice.otherwise = static_cast<std::uint32_t>(chosen_.size());
  chosen_.insert(chosen_.end(), otherwise.begin(), otherwise.end());
  choice.end = static_cast<std::uint32_t>(chosen_.size());
  choices_.push_back(choice);
}

core::Packing ArcPool::restore(const Component& component, std::vector<ArcId> arcs) const {
  std::vector<bool> covered(component.num_slots(), false);
  const auto cover = [&](ArcId a) {
    core::for_each_slot(component, a, [&](std::uint32_t slot) { covered[slot] = true; });
  };
  const auto is_free = [&](ArcId a) {
    bool free = true;
    core::for_each_slot(component, a, [&](std::uint32_t slot) { free = free && !covered[slot]; });
    return free;
  };
  std::for_each(arcs.begin(), arcs.end(), cover);
  for (auto choice = choices_.rbegin(); choice != choices_.rend(); ++choice) {
    const auto at = [&](std::uint32_t n) { return chosen_.begin() + n; };
    const bool free = std::all_of(at(choice->first), at(choice->otherwise), is_free);
    const auto begin = at(free ? choice->first : choice->otherwise);
    const auto end = at(free ? choice->otherwise : choice->end);
    std::for_each(begin, end, cover);
    arcs.insert(arcs.end(), begin, end);
  }
  return core::make_packing(component, std::move(arcs));
}

}  // namespace nda::reduce
