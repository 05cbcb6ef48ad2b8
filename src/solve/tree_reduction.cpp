#include "solve/tree_reduction.hpp"

#include "decompose/components.hpp"
#include "decompose/reduced_cost_fixing.hpp"

namespace nda::pipeline {

using core::ArcId;
using core::Component;

bnb::Reduction reduce_node(const Component& component, const bnb::NodeBound& bound, double cutoff) {
  const decompose::Fixing fixing = decompose::fix(component, bound.u, bound.lower, cutoff);
  bnb::Reduction reduction;
  for (std::size_t n = 0; n < fixing.taken.size(); ++n) {
    const ArcId a = fixing.taken[n];
    reduction.taken.arcs.push_back(core::original_arc(component, a));
    reduction.taken.cost += component.costs[a];
    reduction.forced.push_back({a, fixing.forcing[n]});
  }
  core::Cutter cutter;
  const Component live = cutter.cut(component, fixing.live);
  const std::vector<double> live_u = core::restrict_slots(component, bound.u, live);
  const decompose::Partition parts = decompose::partition(live);
  for (std::size_t c = 0; c < parts.num_components(); ++c) {
    reduction.parts.push_back(cutter.cut(live, parts.component(c)));
    reduction.u.push_back(core::restrict_slots(live, live_u, reduction.parts.back()));
  }
  return reduction;
}

}  // namespace nda::pipeline
