#include "recovery/local_search.hpp"

#include <cmath>
#include <numeric>

// The report (4.6) leaves local search to Robertson's thesis.  This is the simplest that works on
// sparse arcs: a table of owners makes the gain of forcing an arc in an O(N) question, no conflict
// graph is stored. Equal cost is accepted, which lets the search drift along plateaus; ties abound
// in tracking costs.

namespace nda::recovery {

using core::ArcId;

LocalSearch::LocalSearch(const core::Component& component)
    : component_(component),
      slot_arcs_(component),
      state_(component),
      candidates_(component.num_arcs()) {
  std::iota(candidates_.begin(), candidates_.end(), 0u);
}

void LocalSearch::improve(core::Packing& packing,
                          std::int64_t kicks,
                          double goal,
                          core::Random& random,
                          const core::Deadline& deadline) {
  state_.assign(packing);
  descend(deadline);
  for (std::int64_t kick = 0; kick < kicks && !candidates_.empty(); ++kick) {
    if (state_.cost() <= goal || (kick % 64 == 0 && deadline.reached())) break;
    try_force(candidates_[random.below(candidates_.size())]);
  }
  core::Packing result = state_.packing();
  if (result.cost < packing.cost) packing = std::move(result);
}

void LocalSearch::descend(const core::Deadline& deadline) {
  for (bool improved = true; improved;) {
    improved = false;
    for (std::size_t c = 0; c < candidates_.size(); ++c) {
      if (c % 256 == 0 && deadline.reached()) return;
      const double before = state_.cost();
      if (try_force(candidates_[c]) && state_.cost() < before - 1e-12 * std::abs(before))
        improved = true;
    }
  }
}

bool LocalSearch::try_force(ArcId a) {
  if (state_.contains(a)) return false;
  const double before = state_.cost();
  state_.conflicts(a, removed_);
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

// Fills the freed slots, always with the cheapest arc that fits on any of them.
void LocalSearch::repair() {
  while (true) {
    ArcId best = kNoArc;
    for (const std::uint32_t slot : freed_) {
      if (state_.owner(slot) != kNoArc) continue;
      for (const ArcId b : slot_arcs_[slot]) {
        if (component_.costs[b] >= 0) break;
        if (best != kNoArc && component_.costs[b] >= component_.costs[best]) break;
        if (!state_.fits(b)) continue;
        best = b;
        break;
      }
    }
    if (best == kNoArc) return;
    state_.insert(best);
    inserted_.push_back(best);
  }
}

void LocalSearch::undo() {
  for (const ArcId b : inserted_) state_.remove(b);
  for (const ArcId b : removed_) state_.insert(b);
}

}  // namespace nda::recovery
