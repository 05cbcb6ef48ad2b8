#include "recovery/local_search.hpp"

#include <algorithm>
#include <cmath>

// The report (4.6) leaves local search to Robertson's thesis.  This is the simplest that works on
// sparse arcs: a table of owners makes forcing an arc in an O(N) question, no conflict graph is
// stored. Equal cost is accepted, which lets the search drift along plateaus; ties abound in
// tracking costs. The test for hopeless moves looks at the forced arc only: a repair that covers
// further uncovered indices could gain more, but those pay little in a packing near the bound, and
// the test spares nine moves of ten.

namespace nda::recovery {

using core::ArcId;

LocalSearch::LocalSearch(const core::Component& component, std::span<const double> u)
    : component_(component),
      slot_arcs_(component),
      state_(component),
      reduced_(component.num_arcs()) {
  for (ArcId a = 0; a < reduced_.size(); ++a) {
    reduced_[a] = std::max(0.0, core::reduced_cost(component, u, a));
  }
  for (const double multiplier : u) price_.push_back(-multiplier);
}

void LocalSearch::improve(core::Packing& packing,
                          std::int64_t kicks,
                          double goal,
                          core::Random& random,
                          const core::Deadline& deadline) {
  state_.assign(packing);
  descend(deadline);
  for (std::int64_t kick = 0; kick < kicks; ++kick) {
    if (state_.cost() <= goal || (kick % 64 == 0 && deadline.reached())) break;
    try_force(static_cast<ArcId>(random.below(component_.num_arcs())));
  }
  core::Packing result = state_.packing();
  if (result.cost < packing.cost) packing = std::move(result);
}

void LocalSearch::descend(const core::Deadline& deadline) {
  for (bool improved = true; improved;) {
    improved = false;
    for (ArcId a = 0; a < component_.num_arcs(); ++a) {
      if (a % 256 == 0 && deadline.reached()) return;
      const double before = state_.cost();
      if (try_force(a) && state_.cost() < before - 1e-12 * std::abs(before)) improved = true;
    }
  }
}

bool LocalSearch::try_force(ArcId a) {
  if (state_.contains(a)) return false;
  const double before = state_.cost();
  state_.conflicts(a, removed_);
  if (hopeless(a)) return false;
  inserted_.clear();
  freed_.clear();
  for (const ArcId b : removed_) {
    core::for_each_slot(component_, b, [&](std::uint32_t slot) { freed_.push_back(slot); });
    state_.remove(b);
  }
  state_.insert(a);
  inserted_.push_back(a);
  repair();
  if (state_.cost() <= before) return true;
  undo();
  return false;
}

bool LocalSearch::hopeless(ArcId a) const {
  double gain = 0;
  for (const ArcId b : removed_) gain += reduced_[b];
  core::for_each_slot(component_, a, [&](std::uint32_t slot) {
    if (state_.owner(slot) == kNoArc) gain += price_[slot];
  });
  return reduced_[a] > gain * (1 + 1e-9);
}

// Fills the freed slots with arcs that fit, the cheapest first.
void LocalSearch::repair() {
  fitting_.clear();
  for (const std::uint32_t slot : freed_) {
    if (state_.owner(slot) != kNoArc) continue;
    for (const ArcId b : slot_arcs_[slot]) {
      if (component_.costs[b] >= 0) break;
      if (state_.fits(b)) fitting_.push_back(b);
    }
  }
  std::sort(fitting_.begin(), fitting_.end(), [&](ArcId a, ArcId b) {
    return component_.costs[a] != component_.costs[b] ? component_.costs[a] < component_.costs[b]
                                                      : a < b;
  });
  for (const ArcId b : fitting_) {
    if (!state_.fits(b)) continue;
    state_.insert(b);
    inserted_.push_back(b);
  }
}

void LocalSearch::undo() {
  for (const ArcId b : inserted_) state_.remove(b);
  for (const ArcId b : removed_) state_.insert(b);
}

}  // namespace nda::recovery
