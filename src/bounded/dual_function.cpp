#include "bounded/dual_function.hpp"

#include <algorithm>
#include <numeric>

namespace nda::bounded {
namespace {

using core::ArcId;
using lap::FlowEdge;
using lap::FlowNode;

std::vector<FlowNode> nodes_of(const BoundedComponent& component, std::size_t k) {
  std::vector<FlowNode> nodes;
  if (k >= component.graph.sizes.size()) return nodes;
  for (Index i = 1; i <= component.graph.sizes[k]; ++i) {
    const Row& row = component.rows[component.graph.offset[k] + i];
    nodes.push_back({row.single, row.lo, row.hi});
  }
  return nodes;
}

// What a use is worth at most.
double worth(std::span<const FlowNode> nodes, std::uint32_t node) {
  return node == FlowEdge::kOutside || nodes[node].lo == 0 ? 0 : nodes[node].single;
}

Index most_uses(std::span<const FlowNode> nodes, std::uint32_t node) {
  return node == FlowEdge::kOutside ? UseBounds::kUnlimited : nodes[node].hi;
}

// Index i as a node; index 0 is outside.
std::uint32_t node_of(Index i) {
  return i == 0 ? FlowEdge::kOutside : i - 1;
}

}  // namespace

DualFunction::DualFunction(const BoundedComponent& component)
    : component_(component),
      rows_(nodes_of(component, 0)),
      columns_(nodes_of(component, 1)),
      r_(component.num_arcs()),
      slot_u_(component.rows.size(), 0.0) {
  const core::Component& graph = component.graph;
  first_slot_ = graph.num_dimensions() > 2 ? graph.offset[2]
                                           : static_cast<std::uint32_t>(component.rows.size());
  find_cells();
}

void DualFunction::find_cells() {
  const core::Component& graph = component_.graph;
  by_cell_ = core::all_arcs(graph);
  const auto column = [&](ArcId a) { return graph.num_dimensions() < 2 ? 0 : graph.index(1, a); };
  std::stable_sort(by_cell_.begin(), by_cell_.end(), [&](ArcId a, ArcId b) {
    return std::pair(graph.index(0, a), column(a)) < std::pair(graph.index(0, b), column(b));
  });
  for (std::size_t n = 0; n < by_cell_.size(); ++n) {
    const ArcId a = by_cell_[n];
    const bool same = n > 0 && graph.index(0, by_cell_[n - 1]) == graph.index(0, a) &&
                      column(by_cell_[n - 1]) == column(a);
    if (!same) cell_.push_back(n);
  }
  cell_.push_back(by_cell_.size());
}

double DualFunction::evaluate(std::span<const double> u, std::span<double> subgradient) {
  std::copy(u.begin(), u.end(), slot_u_.begin() + first_slot_);
  std::fill(slot_u_.begin(), slot_u_.begin() + first_slot_, 0.0);
  for (ArcId a = 0; a < r_.size(); ++a) r_[a] = core::reduced_cost(component_.graph, slot_u_, a);
  chosen_.clear();
  collapse();
  double value = take_flow(lap::solve_flow(rows_, columns_, edges_));
  std::sort(chosen_.begin(), chosen_.end());
  const std::vector<Index> uses = count_uses(component_.graph, chosen_);
  for (std::size_t j = 0; j < u.size(); ++j) {
    const std::size_t slot = first_slot_ + j;
    const Row& row = component_.rows[slot];
    value += row.value(u[j]);
    subgradient[j] = static_cast<double>(row.best_uses(u[j], uses[slot])) - uses[slot];
  }
  return value;
}

// Edges: the cheapest arcs of every cell.  Those that use neither row nor column are chosen at once
// where they pay.
void DualFunction::collapse() {
  edges_.clear();
  edge_arc_.clear();
  for (std::size_t c = 0; c + 1 < cell_.size(); ++c) {
    const std::size_t first = cell_[c];
    const ArcId a = by_cell_[first];
    const core::Component& graph = component_.graph;
    const std::uint32_t row = node_of(graph.index(0, a));
    const std::uint32_t column =
        graph.num_dimensions() < 2 ? FlowEdge::kOutside : node_of(graph.index(1, a));
    keep_cheapest(
        first, cell_[c + 1], std::min(most_uses(rows_, row), most_uses(columns_, column)));
  }
}

void DualFunction::keep_cheapest(std::size_t first, std::size_t last, Index most) {
  const auto begin = by_cell_.begin() + static_cast<std::ptrdiff_t>(first);
  const auto end = by_cell_.begin() + static_cast<std::ptrdiff_t>(last);
  const auto count = std::min<std::size_t>(most, last - first);
  const auto kept = begin + static_cast<std::ptrdiff_t>(count);
  if (kept != end) {
    std::nth_element(
        begin, kept, end, [&](ArcId a, ArcId b) { return r_[a] != r_[b] ? r_[a] < r_[b] : a < b; });
  }
  // Where a cell is used once, its indices see to that: then what its other arcs cost more is above
  // what the duals ask.
  std::for_each(begin, kept, [&](ArcId a) { add_edge(a, most == 1 ? 2 : 1); });
}

void DualFunction::add_edge(ArcId a, Index most) {
  const core::Component& graph = component_.graph;
  const std::uint32_t row = node_of(graph.index(0, a));
  const std::uint32_t column =
      graph.num_dimensions() < 2 ? FlowEdge::kOutside : node_of(graph.index(1, a));
  if (r_[a] >= worth(rows_, row) + worth(columns_, column)) return;
  if (row == FlowEdge::kOutside && column == FlowEdge::kOutside) {
    chosen_.push_back(a);
    return;
  }
  edges_.push_back({row, column, r_[a], most});
  edge_arc_.push_back(a);
}

// Returns the cost of the flow and of the arcs that were chosen before.
double DualFunction::take_flow(const lap::FlowAnswer& answer) {
  for (const std::uint32_t edge : answer.chosen) chosen_.push_back(edge_arc_[edge]);
  const core::Component& graph = component_.graph;
  std::copy(answer.u.begin(), answer.u.end(), slot_u_.begin() + graph.offset[0] + 1);
  if (graph.num_dimensions() > 1)
    std::copy(answer.v.begin(), answer.v.end(), slot_u_.begin() + graph.offset[1] + 1);
  double value = 0;
  for (const ArcId a : chosen_) value += r_[a];
  const std::vector<Index> uses = count_uses(graph, chosen_);
  for (std::size_t slot = 0; slot < first_slot_; ++slot)
    value += component_.rows[slot].cost(uses[slot]);
  return value;
}

void DualFunction::multipliers(std::span<double> all) const {
  std::copy(slot_u_.begin(), slot_u_.end(), all.begin());
}

}  // namespace nda::bounded
