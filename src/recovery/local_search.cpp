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

namespace {

// Mean accepted rise, relative to the mean cost of an arc, at the start and at the end of a cycle.
constexpr double kHot = 0.2;
constexpr double kCold = 0.002;
constexpr std::int64_t kCycles = 4;

}  // namespace

LocalSearch::LocalSearch(const core::Component& component,
                         std::span<const double> u,
                         const core::Deadline& deadline)
    : component_(component),
      slot_arcs_(component, component.costs, deadline),
      arc_slots_(component),
      state_(component),
      reduced_(reduced_costs(component, u)),
      seen_(component.num_arcs(), 0) {
  for (const double multiplier : u) price_.push_back(-multiplier);
}

void LocalSearch::improve(core::Packing& packing,
                          std::int64_t kicks,
                          double goal,
                          core::Random& random,
                          const core::Deadline& deadline) {
  state_.assign(packing);
  best_ = packing;
  descend(deadline);
  keep_best();
  anneal(kicks, goal, random, deadline);
  if (best_.cost < packing.cost) packing = best_;
}

void LocalSearch::keep_best() {
  if (state_.cost() < best_.cost - 1e-12 * std::abs(best_.cost)) best_ = state_.packing();
}

void LocalSearch::anneal(std::int64_t kicks,
                         double goal,
                         core::Random& random,
                         const core::Deadline& deadline) {
  if (best_.arcs.empty()) return;
  const double hot = kHot * std::abs(best_.cost) / static_cast<double>(best_.arcs.size());
  const std::int64_t cycle = std::max<std::int64_t>(1, kicks / kCycles);
  double temperature = hot;
  for (std::int64_t kick = 0; kick < kicks; ++kick) {
    if (kick % cycle == 0) state_.assign(best_);
    if (kick % 64 == 0) {
      if (best_.cost <= goal || deadline.reached()) return;
      const double phase = static_cast<double>(kick % cycle) / static_cast<double>(cycle);
      temperature = hot * std::pow(kCold / kHot, phase);
    }
    const ArcId a = static_cast<ArcId>(random.below(component_.num_arcs()));
    if (try_force(a, -temperature * std::log(1 - random.uniform()))) keep_best();
  }
}

void LocalSearch::descend(const core::Deadline& deadline) {
  for (bool improved = true; improved;) {
    improved = false;
    for (ArcId a = 0; a < component_.num_arcs(); ++a) {
      if (a % 256 == 0 && deadline.reached()) return;
      const double before = state_.cost();
      if (try_force(a, 0) && state_.cost() < before - 1e-12 * std::abs(before)) improved = true;
    }
  }
}

bool LocalSearch::try_force(ArcId a, double allowed_rise) {
  if (state_.contains(a)) return false;
  const double before = state_.cost();
  state_.conflicts(a, removed_);
  if (hopeless(a, allowed_rise)) return false;
  inserted_.clear();
  freed_.clear();
  for (const ArcId b : removed_) {
    core::for_each_slot(component_, b, [&](std::uint32_t slot) { freed_.push_back(slot); });
    state_.remove(b);
  }
  state_.insert(a);
  inserted_.push_back(a);
  repair();
  if (state_.cost() <= before + allowed_rise) return true;
  undo();
  return false;
}

bool LocalSearch::hopeless(ArcId a, double allowed_rise) const {
  double gain = 0;
  for (const ArcId b : removed_) gain += reduced_[b];
  core::for_each_slot(component_, a, [&](std::uint32_t slot) {
    if (state_.owner(slot) == kNoArc) gain += price_[slot];
  });
  return reduced_[a] > gain * (1 + 1e-9) + allowed_rise;
}

// Nine tenths of the time goes here; most arcs conflict early in their list.
bool LocalSearch::fits(ArcId a) const {
  for (const std::uint32_t slot : arc_slots_[a]) {
    if (state_.owner(slot) != kNoArc) return false;
  }
  return true;
}

// Fills the freed slots with arcs that fit, the cheapest first.
void LocalSearch::repair() {
  fitting_.clear();
  ++num_repairs_;
  for (const std::uint32_t slot : freed_) {
    if (state_.owner(slot) != kNoArc) continue;
    for (const ArcId b : slot_arcs_[slot]) {
      if (component_.costs[b] >= 0) break;
      if (seen_[b] == num_repairs_) continue;
      seen_[b] = num_repairs_;
      if (fits(b)) fitting_.push_back(b);
    }
  }
  std::sort(fitting_.begin(), fitting_.end(), [&](ArcId a, ArcId b) {
    return component_.costs[a] != component_.costs[b] ? component_.costs[a] < component_.costs[b]
                                                      : a < b;
  });
  for (const ArcId b : fitting_) {
    if (!fits(b)) continue;
    state_.insert(b);
    inserted_.push_back(b);
  }
}

void LocalSearch::undo() {
  for (const ArcId b : inserted_) state_.remove(b);
  for (const ArcId b : removed_) state_.insert(b);
}

}  // namespace nda::recovery
