#pragma once

#include <span>
#include <vector>

#include "bnb/branch_and_bound.hpp"
#include "decompose/components.hpp"
#include "decompose/reduced_cost_fixing.hpp"
#include "support/components.hpp"

namespace nda::bnb {

// Collaborators that are fakes: each does as little, or as much, as its contract allows.

inline NodeBound keep_the_warm_multipliers(const core::Component&,
                                           std::span<const double> warm,
                                           double) {
  return {{warm.begin(), warm.end()}, support::sum_of(warm), {}};
}

inline NodeBound start_afresh_from_random_multipliers(const core::Component& component,
                                                      std::span<const double>,
                                                      double) {
  core::Random random(component.num_arcs());
  std::vector<double> u = support::feasible_multipliers(component, random);
  const double lower = support::sum_of(u);
  return {std::move(u), lower, {}};
}

// Offers the best packing, too, as a heuristic may.
inline NodeBound know_the_best_packing(const core::Component& component,
                                       std::span<const double> warm,
                                       double cutoff) {
  NodeBound bound = keep_the_warm_multipliers(component, warm, cutoff);
  for (const core::Packing& packing : support::all_packings(component)) {
    if (packing.cost < bound.packing.cost) bound.packing = packing;
  }
  return bound;
}

// Adds the connected parts of `arcs`, or these arcs as one part.
inline void add_parts(const core::Component& component,
                      std::span<const double> u,
                      const std::vector<core::ArcId>& arcs,
                      bool split,
                      Reduction& reduction) {
  core::Cutter cutter;
  const core::Component live = cutter.cut(component, arcs);
  const std::vector<double> live_u = core::restrict_slots(component, u, live);
  if (!split) {
    if (live.num_arcs() == 0) return;
    reduction.parts.push_back(live);
    reduction.u.push_back(live_u);
    return;
  }
  const decompose::Partition parts = decompose::partition(live);
  for (std::size_t c = 0; c < parts.num_components(); ++c) {
    reduction.parts.push_back(cutter.cut(live, parts.component(c)));
    reduction.u.push_back(core::restrict_slots(live, live_u, reduction.parts.back()));
  }
}

inline Reduction change_nothing(const core::Component& component, const NodeBound& bound, double) {
  Reduction reduction;
  add_parts(component, bound.u, all_arcs(component), false, reduction);
  return reduction;
}

inline Reduction split_only(const core::Component& component, const NodeBound& bound, double) {
  Reduction reduction;
  add_parts(component, bound.u, all_arcs(component), true, reduction);
  return reduction;
}

inline Reduction fix_and_split(const core::Component& component,
                               const NodeBound& bound,
                               double cutoff) {
  const decompose::Fixing fixing = decompose::fix(component, bound.u, bound.lower, cutoff);
  Reduction reduction;
  for (const core::ArcId a : fixing.taken) {
    reduction.taken.arcs.push_back(core::original_arc(component, a));
    reduction.taken.cost += component.costs[a];
    reduction.forced.push_back({a, fixing.forcing[reduction.forced.size()]});
  }
  add_parts(component, bound.u, fixing.live, true, reduction);
  return reduction;
}

inline constexpr double kTie = 1e-9;

inline BranchLimits branch_always() {
  BranchLimits limits;
  limits.enumeration_arcs = 0;
  limits.error = limits.margin = kTie;
  return limits;
}

}  // namespace nda::bnb
