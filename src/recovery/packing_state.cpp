#include "recovery/packing_state.hpp"

#include <algorithm>
#include <numeric>

#include "core/reduced_costs.hpp"
#include "core/slices.hpp"

namespace nda::recovery {

using core::ArcId;
using core::Component;
using core::for_each_slot;

SlotArcs::SlotArcs(const Component& component,
                   std::span<const double> costs,
                   const core::Deadline& deadline) {
  std::vector<ArcId> order(component.num_arcs());
  std::iota(order.begin(), order.end(), 0u);
  core::sort_until(deadline, order, [&](ArcId a, ArcId b) {
    return costs[a] != costs[b] ? costs[a] < costs[b] : a < b;
  });
  arcs_ = core::list_by_slot(component, order);
}

ArcSlots::ArcSlots(const Component& component) {
  start_.reserve(component.num_arcs() + 1);
  start_.push_back(0);
  for (ArcId a = 0; a < component.num_arcs(); ++a) {
    for_each_slot(component, a, [&](std::uint32_t slot) { slots_.push_back(slot); });
    start_.push_back(static_cast<std::uint32_t>(slots_.size()));
  }
}

std::vector<double> reduced_costs(const Component& component, std::span<const double> u) {
  std::vector<double> reduced(component.num_arcs());
  core::reduced_costs(component, u, 0, reduced);
  for (double& r : reduced) r = std::max(0.0, r);
  return reduced;
}

bool PackingState::fits(ArcId a) const {
  for (int k = 0; k < component_.num_dimensions(); ++k) {
    if (component_.index(k, a) != 0 && owner_[component_.slot(k, a)] != kNoArc) return false;
  }
  return true;
}

void PackingState::insert(ArcId a) {
  for_each_slot(component_, a, [&](std::uint32_t slot) { owner_[slot] = a; });
  cost_ += component_.costs[a];
}

void PackingState::remove(ArcId a) {
  for_each_slot(component_, a, [&](std::uint32_t slot) { owner_[slot] = kNoArc; });
  cost_ -= component_.costs[a];
}

double PackingState::conflicts(ArcId a, std::vector<ArcId>& found) const {
  found.clear();
  double cost = 0;
  for_each_slot(component_, a, [&](std::uint32_t slot) {
    const ArcId b = owner_[slot];
    if (b == kNoArc || b == a || std::find(found.begin(), found.end(), b) != found.end()) return;
    found.push_back(b);
    cost += component_.costs[b];
  });
  return cost;
}

bool PackingState::contains(ArcId a) const {
  for (int k = 0; k < component_.num_dimensions(); ++k) {
    if (component_.index(k, a) != 0) return owner_[component_.slot(k, a)] == a;
  }
  return false;
}

core::Packing PackingState::packing() const {
  std::vector<ArcId> arcs;
  for (const ArcId a : owner_) {
    if (a != kNoArc) arcs.push_back(a);
  }
  std::sort(arcs.begin(), arcs.end());
  arcs.erase(std::unique(arcs.begin(), arcs.end()), arcs.end());
  return core::make_packing(component_, std::move(arcs));
}

void PackingState::assign(const core::Packing& packing) {
  std::fill(owner_.begin(), owner_.end(), kNoArc);
  cost_ = 0;
  for (const ArcId a : packing.arcs) insert(a);
}

}  // namespace nda::recovery
