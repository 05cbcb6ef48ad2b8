#include "bounded/dual_function.hpp"

#include <algorithm>

namespace nda::bounded {

using core::ArcId;
using lap::FlowEdge;
using lap::FlowNode;

DualFunction::DualFunction(const BoundedComponent& component, int num_kept)
    : RelaxedDual(component, num_kept),
      rows_(nodes_of(0)),
      columns_(nodes_of(1)),
      kept_u_(first_slot(), 0.0) {}

std::vector<FlowNode> DualFunction::nodes_of(int k) const {
  std::vector<FlowNode> nodes;
  if (k >= num_kept()) return nodes;
  const auto dimension = static_cast<std::size_t>(k);
  for (Index i = 1; i <= component().graph.sizes[dimension]; ++i) {
    const Row& row = component().rows[component().graph.offset[dimension] + i];
    nodes.push_back({row.single, row.lo, row.hi});
  }
  return nodes;
}

// Index 0, and every index of a dimension that is not kept, is outside.
std::uint32_t DualFunction::node_of(int k, ArcId a) const {
  const Index i = k < num_kept() ? component().graph.index(k, a) : 0;
  return i == 0 ? FlowEdge::kOutside : i - 1;
}

RelaxedDual::KeptValue DualFunction::solve_kept(std::span<const ArcId> offered,
                                                std::vector<ArcId>& chosen) {
  edges_.clear();
  for (const ArcId a : offered) {
    // Where a cell is used once, its indices see to that: then what its other arcs cost more is
    // above what the duals ask.
    const Index most = most_uses_of_cell(component(), num_kept(), a) == 1 ? 2 : 1;
    edges_.push_back({node_of(0, a), node_of(1, a), reduced_costs()[a], most});
  }
  if (num_kept() > 0) {
    const lap::FlowAnswer answer = lap::solve_flow(rows_, columns_, edges_);
    for (const std::uint32_t edge : answer.chosen) chosen.push_back(offered[edge]);
    keep_duals(answer);
  }
  return {kept_cost(chosen), -kInfinity};
}

void DualFunction::keep_duals(const lap::FlowAnswer& answer) {
  const std::vector<std::uint32_t>& offset = component().graph.offset;
  std::copy(answer.u.begin(), answer.u.end(), kept_u_.begin() + offset[0] + 1);
  if (num_kept() > 1) std::copy(answer.v.begin(), answer.v.end(), kept_u_.begin() + offset[1] + 1);
}

void DualFunction::multipliers(std::span<double> all) const {
  std::copy(slot_values().begin(), slot_values().end(), all.begin());
  std::copy(kept_u_.begin(), kept_u_.end(), all.begin());
}

}  // namespace nda::bounded
