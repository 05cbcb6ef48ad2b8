#include "bounded/bounded_component.hpp"

#include "core/double_double.hpp"

namespace nda::bounded {

using core::ArcId;

Index Row::best_uses(double u, Index uses) const {
  const double least = value(u);
  // f(n) + u n is flat between two corners where both attain the minimum.
  const Index from = single * lo == least ? 0 : u * lo == least ? lo : hi;
  const Index to = u * hi == least ? hi : u * lo == least ? lo : 0;
  return std::clamp(uses, std::min(from, to), std::max(from, to));
}

Choice make_choice(const BoundedComponent& component, std::vector<ArcId> arcs) {
  std::sort(arcs.begin(), arcs.end());
  core::DoubleDouble cost;
  for (const ArcId a : arcs) cost.add(component.graph.costs[a]);
  const std::vector<Index> uses = count_uses(component.graph, arcs);
  for (std::size_t slot = 0; slot < uses.size(); ++slot)
    cost.add(component.rows[slot].cost(uses[slot]));
  return {std::move(arcs), cost.high()};
}

std::vector<Index> count_uses(const core::Component& graph, std::span<const ArcId> arcs) {
  std::vector<Index> uses(graph.num_slots(), 0);
  for (const ArcId a : arcs)
    core::for_each_slot(graph, a, [&](std::uint32_t slot) { ++uses[slot]; });
  return uses;
}

std::size_t missing_uses(const BoundedComponent& component, std::span<const ArcId> arcs) {
  const std::vector<Index> uses = count_uses(component.graph, arcs);
  std::size_t missing = 0;
  for (std::size_t slot = 0; slot < uses.size(); ++slot) {
    const Row& row = component.rows[slot];
    if (row.is_forced && uses[slot] < row.lo) missing += row.lo - uses[slot];
  }
  return missing;
}

double most_uses(const BoundedComponent& component) {
  double sum = 0;
  for (const Row& row : component.rows) sum += row.hi;
  return sum;
}

}  // namespace nda::bounded
